/// A reel in three.js: meshes and crowds that wear any material and play a clip.
// SPDX-License-Identifier: MIT
import { BufferAttribute, BufferGeometry, InstancedBufferAttribute, InstancedMesh, Mesh, MeshDepthMaterial, MeshDistanceMaterial, RGBADepthPacking } from 'three';

import { emptyClip } from './clip.js';
import { ReelPlayer } from './player.js';
import { gatherRows } from './tables.js';
import { Wardrobe } from './wardrobe.js';

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
  const wardrobe = new mesh.constructor.Wardrobe(clip, crowd);
  mesh.clip = clip;
  mesh.wardrobe = wardrobe;
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
  mesh.wardrobe.dispose();
}

/// One mesh playing a clip. material: any of three.js, or several; it wears clones (mesh.material); without any, the clip's own.
/// Without a clip nothing is to be seen until change(), but what is drawn before makes the shaders ready. dispose() frees the
/// materials, not the clip, which others may share.
export class ReelMesh extends Mesh {
  static Wardrobe = Wardrobe;
  #waiting = null;
  #plain = false; // it wears the clip's own materials
  #posed = null;

  constructor(clip, material) {
    const waiting = clip ? null : emptyClip();
    super((clip ?? waiting).geometry, []);
    this.isReelMesh = true;
    this.#waiting = waiting;
    this.#plain = !material;
    furnish(this, clip ?? waiting, material, false);
    const frames = new Int32Array(4), weights = new Float64Array(4);
    this.player = new ReelPlayer(this.clip.timeline, (time) => {
      const { timeline } = this.clip;
      timeline.mix(timeline.start + time, frames, weights);
      this.wardrobe.show(this.clip, frames, weights);
    });
    this.player.seek(0);
  }

  /// Shows another clip from now on: more segments of the same file, another level; or one of a surface with as many materials.
  change(clip) {
    this.clip = clip;
    this.geometry = clip.geometry;
    this.wardrobe.change(clip);
    if (this.#waiting) this.#begin(clip);
    this.player.duration = clip.timeline.duration;
    this.player.seek(this.player.time);
    return this;
  }

  /// What the material that it wears already is good for stays.
  #begin(clip) {
    const own = this.#plain ? clip.materials() : [];
    if (own.vertexColors || own.length > 0) this.wear(own);
    else if (this.#plain) this.material.name = own.name;
    this.#waiting.dispose();
    this.#waiting = null;
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

  dispose() {
    undress(this);
    this.#waiting?.dispose();
  }
}

/// Many instances of a clip, each at its own phase, in one draw call. setMatrixAt() places them.
export class ReelCrowd extends InstancedMesh {
  static Wardrobe = Wardrobe;

  constructor(clip, material, count) {
    const geometry = clip.geometry.clone();
    geometry.setAttribute('reelPhase', new InstancedBufferAttribute(new Float32Array(count), 1));
    super(geometry, [], count);
    this.isReelCrowd = true;
    furnish(this, clip, material, true);
    this.player = new ReelPlayer(clip.timeline, (time) => (this.wardrobe.uniforms.reelTime.value = time));
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
