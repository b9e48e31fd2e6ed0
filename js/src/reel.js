/// A reel in three.js: a clip on the GPU, meshes and crowds that wear any material, and the control of its time.
// SPDX-License-Identifier: MIT
import {
  Box3, BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, InstancedBufferAttribute, InstancedMesh, Mesh,
  MeshDepthMaterial, MeshDistanceMaterial, MeshStandardMaterial, NearestFilter, RGBADepthPacking, RGBAFormat, Sphere, Vector3, Vector4,
  EventDispatcher, LoopOnce, LoopPingPong, LoopRepeat, Vector2,
} from 'three';

import { ReelData, mixedBasis, mixedRows, tableWidth } from './clip.js';
import { reelVertexShader } from './shader.js';

const names = { normal: null, tangent: 'tangent', uv0: 'uv', uv1: 'uv1', uv2: 'uv2', uv3: 'uv3', color0: 'color' };

function texture({ values, height, width = tableWidth }) {
  const made = new DataTexture(values, width, height, RGBAFormat, FloatType);
  made.minFilter = made.magFilter = NearestFilter;
  made.needsUpdate = true;
  return made;
}

/// One decoded file on the GPU: as many meshes and crowds as wanted share it. dispose() frees it. pieces: the segments, or those
/// of one level, perhaps not yet all of them; the head is then that of what is there.
export class ReelClip {
  constructor(head, pieces) {
    const data = new ReelData(head, pieces);
    this.head = data.head;
    this.timeline = data.timeline;
    this.textures = { reelCoefficients: texture(data.coefficients), reelBasis: texture(data.basis), reelFrames: texture(data.frames) };
    this.rows = data.rows;
    this.blendWidth = 1 + 3 * Math.min(680, Math.ceil(Math.max(...data.pieces.map((piece) => piece.K)) / 4));
    this.geometry = ReelClip.#geometry(data);
    this.gpuBytes = Object.values(this.textures).reduce((sum, each) => sum + each.image.data.byteLength, 0);
  }

  static #geometry(data) {
    const { index, groups, count, attributes } = data.surface, geometry = new BufferGeometry();
    const rest = Float32Array.from({ length: 3 * count }, (_, i) => data.rest[3 * data.rowOf[(i / 3) | 0] + (i % 3)]);
    const rows = Float32Array.from({ length: 2 * count }, (_, i) => (i % 2 ? data.tangentRowOf : data.rowOf)[i >> 1]);
    geometry.setIndex(new BufferAttribute(index, 1));
    geometry.setAttribute('position', new BufferAttribute(rest, 3));
    geometry.setAttribute('normal', new BufferAttribute(data.normals, 3));
    geometry.setAttribute('reelRow', new BufferAttribute(rows, 2));
    for (const { name, components, normalized, values } of attributes) {
      const known = name in names ? names[name] : `reel_${name.replace(/\W/g, '_')}`;
      if (known && components <= 4) geometry.setAttribute(known, new BufferAttribute(values, components, normalized));
    }
    for (const { start, count: size, material } of groups) geometry.addGroup(start, size, material);
    const { min, max } = data.bounds();
    geometry.boundingBox = new Box3(new Vector3(...min), new Vector3(...max)).expandByScalar(0.02 * new Vector3(...max).distanceTo(new Vector3(...min)));
    geometry.boundingSphere = geometry.boundingBox.getBoundingSphere(new Sphere());
    return geometry;
  }

  /// Positions of the rows, [3 rows], at seconds from the first frame, as the GPU shows them.
  rowsAt(time, out = new Float32Array(3 * this.rows)) {
    const frames = new Int32Array(4), weights = new Float64Array(4);
    this.timeline.mix(this.timeline.start + time, frames, weights);
    return mixedRows(this.tables, frames, weights, out);
  }
  get tables() {
    const [coefficients, basis, frames] = Object.values(this.textures).map((each) => each.image.data);
    return { coefficients, basis, frames };
  }

  /// Where a row is in every stored frame, [3 F].
  pathOf(row) {
    const { coefficients: C, basis, frames: table } = this.tables, F = this.timeline.times.length;
    const path = new Float32Array(3 * F);
    for (let f = 0; f < F; ++f) {
      const count = table[8 * f + 1], at = 4 * (table[8 * f] + table[8 * f + 3] * 2 ** 20 + count * row);
      for (let c = 0; c < 3; ++c) {
        let sum = table[8 * f + 4 + c];
        for (let k = 0; k < 4 * count; ++k) sum += C[at + k] * basis[4 * (table[8 * f + 2] + 3 * (k >> 2) + c) + (k & 3)];
        path[3 * f + c] = sum;
      }
    }
    return path;
  }

  /// Standard materials, one for each that the file names.
  materials() {
    const of = (name) => Object.assign(new MeshStandardMaterial({ side: DoubleSide, vertexColors: 'color' in this.geometry.attributes }), { name });
    return this.geometry.groups.length > 0 ? this.head.materials.map(of) : of(this.head.materials[0] ?? '');
  }

  dispose() {
    for (const each of Object.values(this.textures)) each.dispose();
    this.geometry.dispose();
  }
}

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

/// Plays: time, direction, speed, ends. update(seconds) every frame, as an AnimationMixer.
/// Dispatches 'loop' and 'finished'.
export class ReelPlayer extends EventDispatcher {
  constructor(timeline, show) {
    super();
    this.duration = timeline.duration;
    this.time = 0; ///< seconds from the first frame
    this.speed = 1; ///< below 0: backwards
    this.loop = LoopRepeat; ///< or LoopOnce, LoopPingPong
    this.playing = false;
    this.show = show;
  }

  play() {
    this.playing = true;
    return this;
  }
  pause() {
    this.playing = false;
    return this;
  }
  reverse() {
    this.speed = -this.speed;
    return this;
  }
  /// Goes to a time, at once.
  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.duration);
    this.show(this.time);
    return this;
  }

  update(seconds) {
    if (!this.playing || this.duration === 0) return;
    let time = this.time + seconds * this.speed;
    if (time < 0 || time > this.duration) time = this.#turned(time);
    this.seek(time);
  }

  #turned(time) {
    if (this.loop === LoopOnce) {
      this.playing = false;
      this.dispatchEvent({ type: 'finished', direction: Math.sign(this.speed) });
      return time;
    }
    this.dispatchEvent({ type: 'loop', direction: Math.sign(this.speed) });
    const length = this.duration, turns = Math.floor(time / length), rest = time - turns * length;
    if (this.loop !== LoopPingPong || turns % 2 === 0) return rest;
    this.reverse();
    return length - rest;
  }
}

/// The vertices shown at a time, as a geometry that rays can meet.
function posed(clip, time) {
  const rows = clip.rowsAt(time), { index, groups, attributes: { reelRow, uv } } = clip.geometry, geometry = new BufferGeometry();
  const positions = Float32Array.from({ length: 3 * reelRow.count }, (_, i) => rows[3 * reelRow.getX((i / 3) | 0) + (i % 3)]);
  geometry.setIndex(index).setAttribute('position', new BufferAttribute(positions, 3));
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
    reelBlend.value = texture({ values: new Float32Array(4 * width), height: 1, width });
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
