/// A decoded file on the GPU, which meshes and crowds share.
// SPDX-License-Identifier: MIT
import { Box3, BufferAttribute, BufferGeometry, DataTexture, DoubleSide, FloatType, MeshStandardMaterial, NearestFilter, RGBAFormat, Sphere, Vector3 } from 'three';

import { mixedRows } from './mix.js';
import { clipData, headOf, tableWidth } from './tables.js';
import { Timeline } from './timeline.js';

// What three.js calls them, and of how many components they must be.
const known = { normal: [null, 3], tangent: ['tangent', 4], uv0: ['uv', 2], uv1: ['uv1', 2], uv2: ['uv2', 2], uv3: ['uv3', 2], color0: ['color', 3, 4] };

function nameOf({ name, components }) {
  const [theirs, ...counts] = known[name] ?? [];
  return counts.includes(components) ? theirs : `reel_${name.replace(/\W/g, '_')}`;
}

/// Texels of four numbers as a texture of a width.
export function texture(values, width = tableWidth) {
  const made = new DataTexture(values, width, values.length / 4 / width, RGBAFormat, FloatType);
  made.minFilter = made.magFilter = NearestFilter;
  made.needsUpdate = true;
  return made;
}

function geometryOf({ index, groups, attributes, position, normal, reelRow }, { min, max }) {
  const geometry = new BufferGeometry().setIndex(new BufferAttribute(index, 1));
  geometry.setAttribute('position', new BufferAttribute(position, 3));
  geometry.setAttribute('normal', new BufferAttribute(normal, 3));
  geometry.setAttribute('reelRow', new BufferAttribute(reelRow, 2));
  for (const attribute of attributes) {
    const name = nameOf(attribute), { components, normalized, values } = attribute;
    if (name && components <= 4) geometry.setAttribute(name, new BufferAttribute(values, components, normalized));
  }
  for (const { start, count, material } of groups) geometry.addGroup(start, count, material);
  const box = new Box3(new Vector3(...min), new Vector3(...max));
  geometry.boundingBox = box.expandByScalar(0.02 * box.min.distanceTo(box.max));
  geometry.boundingSphere = box.getBoundingSphere(new Sphere());
  return geometry;
}

/// One decoded file on the GPU: as many meshes and crowds as wanted share it. dispose() frees it. pieces: the segments, or those
/// of one level, perhaps not yet all of them; the head is then that of what is there. Or what ClipMaker.made() gave.
export class ReelClip {
  constructor(head, pieces) {
    const { rows, fours, tables, geometry, box, ...about } = Array.isArray(pieces) ? clipData(head, pieces) : pieces;
    this.head = headOf(head, { rows, ...about });
    this.timeline = new Timeline(this.head.times, this.head.loop, this.head.fps);
    this.textures = { reelCoefficients: texture(tables.coefficients), reelBasis: texture(tables.basis), reelFrames: texture(tables.frames) };
    this.tables = tables;
    this.rows = rows;
    this.blendWidth = 1 + 3 * Math.min(680, fours);
    this.geometry = geometryOf(geometry, box);
    this.gpuBytes = Object.values(tables).reduce((sum, values) => sum + values.byteLength, 0);
  }

  /// Positions of the rows, [3 rows], at seconds from the first frame, as the GPU shows them.
  rowsAt(time, out = new Float32Array(3 * this.rows)) {
    const frames = new Int32Array(4), weights = new Float64Array(4);
    this.timeline.mix(this.timeline.start + time, frames, weights);
    return mixedRows(this.tables, frames, weights, out);
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

/// A triangle of no size: it is drawn, so that what draws it is ready, and not seen.
export function emptyClip() {
  const surface = { triangles: Uint32Array.of(0, 1, 2), rowOf: Uint32Array.of(0, 1, 2), attributes: [] };
  const head = { vertexCount: 3, codedVertexCount: 3, triangleCount: 1, frameCount: 1, loop: false, fps: 0, times: Float64Array.of(0), materials: [], surface };
  const clip = new ReelClip(head, [{ firstFrame: 0, frameCount: 1, K: 1, mean: new Float64Array(3), basis: new Float64Array(3), coefficients: new Float32Array(3), surface: null }]);
  clip.geometry.boundingSphere.radius = Infinity; // wherever the camera looks
  return clip;
}
