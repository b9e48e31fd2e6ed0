/// The page's script: a decoder that it carries along, and the page.
// SPDX-License-Identifier: MIT
import '../dist/inline-all.js';
import './main.js';
