/// meshreel for three.js.
// SPDX-License-Identifier: MIT
export { ReelClip } from './clip.js';
export { ReelError, decodeReel } from './decode.js';
export { ReelLoader } from './loader.js';
export { ReelPlayer } from './player.js';
export { ReelCrowd, ReelMesh } from './reel.js';
