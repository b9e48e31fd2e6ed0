/// A reel in three.js: meshes and crowds that wear any material and play a clip.
// SPDX-License-Identifier: MIT
import {
  BufferAttribute, BufferGeometry, InstancedBufferAttribute, InstancedMesh, Mesh, MeshDepthMaterial, MeshDistanceMaterial, RGBADepthPacking,
  Vector2, Vector4,
} from 'three';

import { texture } from './clip.js';
import { mixedBasis } from './mix.js';
import { ReelPlayer } from './player.js';
import { reelVertexShader } from './shader.js';
import { gatherRows } from './tables.js';

/// Materials of one object, each made to take its vertices from the clip.
class Wardrobe {
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
        reelBlend: { value: null }, reelBlended: { value: new Vector2() } });
    }
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
}

/// The vertices shown at a time, as a geometry that rays can meet.
function posed(clip, time) {
  const { index, groups, attributes: { reelRow, uv } } = clip.geometry, geometry = new BufferGeometry();
  const rowOf = reelRow.array.filter((_, i) => i % 2 === 0);
  geometry.setIndex(index).setAttribute('position', new BufferAttribute(gatherRows(clip.rowsAt(time), rowOf), 3));
  if (uv) geometry.setAttribute('uv', uv);
  geometry.groups = groups;
  return geometry;
}

/// Gives an object its wardrobe, its shadows' materials, and its player.
function furnish(mesh, clip, material, crowd) {
  const wardrobe = new Wardrobe(clip, crowd);
  mesh.clip = clip;
  mesh.uniforms = wardrobe.uniforms;
  mesh.wear = (next) => {
    for (const each of [mesh.material].flat()) each.dispose();
    mesh.material = wardrobe.wear(next);
    return mesh;
  };
  mesh.worn = (other) => wardrobe.wear(other);
  mesh.material = wardrobe.wear(material ?? clip.materials());
  mesh.customDepthMaterial = wardrobe.wear(new MeshDepthMaterial({ depthPacking: RGBADepthPacking }));
  mesh.customDistanceMaterial = wardrobe.wear(new MeshDistanceMaterial());
}

function undress(mesh) {
  for (const each of [mesh.material, mesh.customDepthMaterial, mesh.customDistanceMaterial].flat()) each.dispose();
}

/// One mesh playing a clip. material: any of three.js, or several; it wears clones (mesh.material). dispose() frees those, not
/// the clip, which others may share.
export class ReelMesh extends Mesh {
  constructor(clip, material) {
    super(clip.geometry, []);
    this.isReelMesh = true;
    furnish(this, clip, material, false);
    const frames = new Int32Array(4), weights = new Float64Array(4);
    this.player = new ReelPlayer(clip.timeline, (time) => {
      const { timeline } = this.clip;
      timeline.mix(timeline.start + time, frames, weights);
      this.uniforms.reelFrame.value.fromArray(frames);
      this.uniforms.reelWeight.value.fromArray(weights);
      this.#blend(frames, weights);
    });
    this.#makeBlend();
    this.player.seek(0);
  }

  /// Within a segment the basis is mixed here, once, instead of for each vertex: 3 K + 4 numbers go to the card.
  #blend(frames, weights) {
    const { reelBlend, reelBlended } = this.uniforms, { image } = reelBlend.value, { tables } = this.clip;
    const begin = mixedBasis(tables, frames, weights, image.data);
    reelBlended.value.set(begin, begin < 0 ? 0 : tables.frames[8 * frames[weights.findIndex((weight) => weight !== 0)] + 1]);
    if (begin >= 0) reelBlend.value.needsUpdate = true;
  }
  #makeBlend() {
    const { reelBlend } = this.uniforms, width = this.clip.blendWidth;
    reelBlend.value?.dispose();
    reelBlend.value = texture(new Float32Array(4 * width), width);
  }

  /// Shows another clip from now on, of a surface with as many materials: more segments of the same file, or another level.
  change(clip) {
    this.clip = clip;
    this.geometry = clip.geometry;
    this.uniforms.reelRows.value = clip.rows;
    for (const [name, value] of Object.entries(clip.textures)) this.uniforms[name].value = value;
    this.#makeBlend();
    this.player.duration = clip.timeline.duration;
    this.player.seek(this.player.time);
    return this;
  }

  /// Rays meet what is shown.
  raycast(raycaster, found) {
    const { time } = this.player;
    if (this.#posed?.time !== time || this.#posed.clip !== this.clip) this.#posed = { time, clip: this.clip, geometry: posed(this.clip, time) };
    const shown = new Mesh(this.#posed.geometry, this.material), hits = [];
    shown.matrixWorld = this.matrixWorld;
    shown.raycast(raycaster, hits);
    for (const hit of hits) found.push({ ...hit, object: this });
  }
  #posed = null;

  dispose() {
    undress(this);
    this.uniforms.reelBlend.value.dispose();
  }
}

/// Many instances of a clip, each at its own phase, in one draw call. setMatrixAt() places them.
export class ReelCrowd extends InstancedMesh {
  constructor(clip, material, count) {
    const geometry = clip.geometry.clone();
    geometry.setAttribute('reelPhase', new InstancedBufferAttribute(new Float32Array(count), 1));
    super(geometry, [], count);
    this.isReelCrowd = true;
    furnish(this, clip, material, true);
    this.player = new ReelPlayer(clip.timeline, (time) => (this.uniforms.reelTime.value = time));
  }

  /// Seconds by which instance i is ahead.
  setPhaseAt(i, seconds) {
    const phases = this.geometry.attributes.reelPhase;
    phases.setX(i, seconds);
    phases.needsUpdate = true;
  }

  dispose() {
    undress(this);
    this.geometry.dispose();
    return super.dispose();
  }
}
