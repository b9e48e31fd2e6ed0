/// meshreel for three.js.
// SPDX-License-Identifier: MIT
export { ReelLoader } from './loader.js';
export { ReelClip, ReelCrowd, ReelMesh, ReelPlayer } from './reel.js';
export { ReelError, decodeReel } from './decode.js';
