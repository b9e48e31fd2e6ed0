/// meshreel for three.js' WebGPURenderer; what it makes can be shown by WebGLRenderer too.
// SPDX-License-Identifier: MIT
import { ReelLoader as Loader } from './loader.js';
import { NodeWardrobe } from './nodes.js';
import { ReelCrowd as Crowd, ReelMesh as Mesh } from './reel.js';

export { ReelClip } from './clip.js';
export { ReelError, decodeReel } from './decode.js';
export { ReelPlayer } from './player.js';

export class ReelMesh extends Mesh {
  static Wardrobe = NodeWardrobe;
}

export class ReelCrowd extends Crowd {
  static Wardrobe = NodeWardrobe;
}

export class ReelLoader extends Loader {
  static Mesh = ReelMesh;
}
