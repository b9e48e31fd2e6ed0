/// What the page is made of.
// SPDX-License-Identifier: MIT

/// An element of index.html, by its id.
export const $ = (id) => document.getElementById(id);
