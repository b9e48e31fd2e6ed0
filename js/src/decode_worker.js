/// The worker of decodeReel().
// SPDX-License-Identifier: MIT
import { listen, plain } from './worker.js';

listen(() => plain);
