/// What makes materials take their vertices from a clip, in WebGL: uniforms, and a function put into their vertex shaders.
// SPDX-License-Identifier: MIT
import { Vector2, Vector4 } from 'three';

import { texture } from './clip.js';
import { mixedBasis } from './mix.js';
import { reelVertexShader } from './shader.js';

const blendOf = ({ blendWidth }) => texture(new Float32Array(4 * blendWidth), blendWidth);

/// Materials of one object, each made to take its vertices from the clip.
export class Wardrobe {
  constructor(clip, crowd) {
    this.crowd = crowd;
    this.uniforms = { reelRows: { value: clip.rows } };
    for (const [name, value] of Object.entries(clip.textures)) this.uniforms[name] = { value };
    if (crowd) {
      const { timeline } = clip;
      Object.assign(this.uniforms, { reelTime: { value: 0 }, reelPeriod: { value: timeline.period },
        reelDuration: { value: timeline.duration }, reelFrameCount: { value: timeline.times.length } });
    } else {
      Object.assign(this.uniforms, { reelFrame: { value: new Vector4() }, reelWeight: { value: new Vector4(1, 0, 0, 0) },
        reelBlend: { value: blendOf(clip) }, reelBlended: { value: new Vector2() } });
    }
  }

  /// Another clip from now on. Not of a crowd.
  change(clip) {
    this.uniforms.reelRows.value = clip.rows;
    for (const [name, value] of Object.entries(clip.textures)) this.uniforms[name].value = value;
    this.uniforms.reelBlend.value.dispose();
    this.uniforms.reelBlend.value = blendOf(clip);
  }

  /// Four frames and their weights. Within a segment the basis is mixed here, once, instead of for each vertex: 3 K + 4 numbers
  /// go to the card.
  show({ tables }, frames, weights) {
    const { reelFrame, reelWeight, reelBlend: { value: blend }, reelBlended } = this.uniforms;
    reelFrame.value.fromArray(frames);
    reelWeight.value.fromArray(weights);
    const begin = mixedBasis(tables, frames, weights, blend.image.data);
    reelBlended.value.set(begin, begin < 0 ? 0 : tables.frames[8 * frames[weights.findIndex((weight) => weight !== 0)] + 1]);
    if (begin >= 0) blend.needsUpdate = true;
  }

  /// A clone of a material, or of each of several, that this object alone wears.
  wear(material) {
    if (Array.isArray(material)) return material.map((each) => this.wear(each));
    const worn = material.clone(), before = material.onBeforeCompile, key = material.customProgramCacheKey;
    if (this.crowd) worn.defines = { ...worn.defines, REEL_CROWD: 1 };
    worn.onBeforeCompile = (shader, renderer) => {
      before.call(worn, shader, renderer);
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = reelVertexShader(shader.vertexShader);
    };
    worn.customProgramCacheKey = () => `reel ${this.crowd} ${key.call(material)}`;
    return worn;
  }

  dispose() {
    this.uniforms.reelBlend?.value.dispose();
  }
}
