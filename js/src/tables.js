/// What a clip is made of, as plain arrays: tables of coefficients, basis and frames for the GPU, and the geometry that wears them.
// SPDX-License-Identifier: MIT
import { ReelError } from './decoder.js';
import { areaNormals, numbers, shownSurface, tangentSums } from './surface.js';

/// Numbers in groups of four, as texels of a texture 2048 wide.
export const tableWidth = 2048;
const tallest = 16384; // texture that WebGL knows of

function table(texels) {
  const height = Math.max(1, Math.ceil(texels / tableWidth));
  if (height > tallest) throw new ReelError('too many frames of too many vertices for one texture', { code: 5 });
  return new Float32Array(4 * tableWidth * height);
}

const fours = (K) => Math.ceil(K / 4);
const sum = (values) => values.reduce((a, b) => a + b, 0);

/// A piece that has frames only, as pieces of one frame each, whose three components are x, y and z.
function posable(piece, rowOf, rows) {
  if (!piece.exact) return [piece];
  const n = piece.frames.length / piece.frameCount;
  return Array.from({ length: piece.frameCount }, (_, f) => {
    const coefficients = new Float32Array(3 * rows), frame = piece.frames.subarray(f * n, (f + 1) * n);
    for (let v = 0; v < rowOf.length; ++v) coefficients.set(frame.subarray(3 * v, 3 * v + 3), 3 * rowOf[v]);
    return { firstFrame: piece.firstFrame + f, frameCount: 1, K: 3, mean: new Float64Array(3),
      basis: Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1), coefficients };
  });
}

/// Positions of the rows in a piece's first frame, [3 rows].
function firstPose({ K, mean, basis, coefficients: C, frameCount: n }, rows) {
  const out = new Float64Array(3 * rows);
  for (let r = 0; r < rows; ++r)
    for (let c = 0; c < 3; ++c) {
      let x = mean[c * n];
      for (let k = 0; k < K; ++k) x += C[r * K + k] * basis[(k * 3 + c) * n];
      out[3 * r + c] = x;
    }
  return out;
}

/// Values of rows, three each, for whoever has them.
export function gatherRows(rows, rowOf) {
  const out = new Float32Array(3 * rowOf.length);
  for (let i = 0; i < rowOf.length; ++i) for (let c = 0; c < 3; ++c) out[3 * i + c] = rows[3 * rowOf[i] + c];
  return out;
}

/// What does not change as segments come: the surface shown, its pose at rest, normals, and the sums that make tangents.
class Still {
  constructor({ surface, rows, vertexCount }, piece) {
    this.rows = rows;
    this.surface = shownSurface(surface, vertexCount);
    this.rowOf = this.surface.vertexOf.map((v) => surface.rowOf[v]);
    this.rest = firstPose(piece, rows);
    this.#addNormals();
  }

  /// Where a file has normals, those are the ones at rest, corner by corner; else each row has that of its triangles.
  #addNormals() {
    const { rowOf, rest, surface: { index, count, attributes } } = this;
    const given = attributes.find((a) => a.name === 'normal' && a.components === 3 && a.values instanceof Float32Array);
    const rowIndex = index.map((i) => rowOf[i]), own = areaNormals(rest, rowIndex);
    this.normals = given ? given.values : gatherRows(own, rowOf);
    this.tangentOf = given ? numbers(count) : rowOf; // of each vertex shown
    this.ownerOf = given ? rowOf : numbers(this.rows); // the row of each pair of tangents
    this.sums = tangentSums(given ? { index, rowOf, rest, normals: Float64Array.from(given.values) }
      : { index: rowIndex, rowOf: this.ownerOf, rest, normals: own });
  }

  geometry() {
    const { rowOf, tangentOf, surface: { index, groups, attributes } } = this, reelRow = new Float32Array(2 * rowOf.length);
    for (let i = 0; i < rowOf.length; ++i) {
      reelRow[2 * i] = rowOf[i];
      reelRow[2 * i + 1] = tangentOf[i];
    }
    return { index, groups, attributes, position: gatherRows(this.rest, rowOf), normal: this.normals, reelRow };
  }

  /// Coefficients, a row after the other, then of the two tangents of each vertex: of a piece, in texels.
  block({ K, coefficients: C }) {
    const { rows, ownerOf, sums: { begin, row, u, v } } = this, width = 4 * fours(K);
    const out = new Float32Array((rows + 2 * ownerOf.length) * width);
    for (let r = 0; r < rows; ++r) out.set(C.subarray(r * K, (r + 1) * K), r * width);
    const along = new Float64Array(K), across = new Float64Array(K);
    for (let i = 0; i < ownerOf.length; ++i) {
      const own = ownerOf[i] * K;
      along.fill(0);
      across.fill(0);
      for (let j = begin[i]; j < begin[i + 1]; ++j) {
        const at = row[j] * K, a = u[j], b = v[j];
        for (let k = 0; k < K; ++k) {
          const edge = C[at + k] - C[own + k];
          along[k] += a * edge;
          across[k] += b * edge;
        }
      }
      out.set(along, (rows + 2 * i) * width);
      out.set(across, (rows + 2 * i + 1) * width);
    }
    return out;
  }
}

/// A box that holds every frame of a piece: widens min and max.
function widen({ min, max }, { K, mean, basis, coefficients: C, frameCount: n }) {
  const least = new Float64Array(K).fill(Infinity), most = new Float64Array(K).fill(-Infinity);
  for (let at = 0; at < C.length; at += K)
    for (let k = 0; k < K; ++k) {
      least[k] = Math.min(least[k], C[at + k]);
      most[k] = Math.max(most[k], C[at + k]);
    }
  for (let i = 0; i < 3 * n; ++i) {
    let low = mean[i], high = mean[i];
    for (let k = 0; k < K; ++k) {
      const b = basis[k * 3 * n + i];
      low += b * (b > 0 ? least[k] : most[k]);
      high += b * (b > 0 ? most[k] : least[k]);
    }
    const c = (i / n) | 0;
    min[c] = Math.min(min[c], low);
    max[c] = Math.max(max[c], high);
  }
}

/// The surface of a piece: the head's, or its own where it is of a level.
function wornBy({ surface, codedVertexCount, vertexCount }, { surface: level, coefficients, K }) {
  if (!level) return { surface, rows: codedVertexCount, vertexCount };
  const rows = coefficients.length / K;
  return { surface: { ...level, rowOf: numbers(rows) }, rows, vertexCount: rows };
}

/// The head of what made() gave: of its frames, and of its level's surface.
export function headOf(head, { frameCount, rows, level }) {
  return { ...head, frameCount, times: head.times.subarray(0, frameCount), loop: head.loop && frameCount === head.frameCount, codedVertexCount: rows,
    vertexCount: level ? rows : head.vertexCount, surface: level ? { ...level, rowOf: numbers(rows) } : head.surface };
}

/// Takes the pieces of decodeReel() from the first, in order: segments, or segments of one level.
export class ClipMaker {
  #still = null;
  #parts = []; // pieces with their blocks of texels
  #box = { min: [Infinity, Infinity, Infinity], max: [-Infinity, -Infinity, -Infinity] };

  constructor(head) {
    this.head = head;
  }

  add(piece) {
    const worn = wornBy(this.head, piece);
    for (const part of posable(piece, worn.surface.rowOf, worn.rows)) {
      this.#still ??= new Still(worn, part);
      this.#parts.push({ ...part, block: this.#still.block(part) });
      widen(this.#box, part);
    }
    this.level = piece.surface;
  }

  /// All that is there so far: { frameCount, rows, level, fours, tables: { coefficients, basis, frames }, geometry, box }, without
  /// what three.js makes of it.
  made() {
    const parts = this.#parts, last = parts.at(-1), frameCount = last.firstFrame + last.frameCount;
    const tables = { coefficients: table(sum(parts.map(({ block }) => block.length / 4))),
      basis: table(sum(parts.map((part) => 3 * fours(part.K) * part.frameCount))), frames: table(2 * frameCount) };
    let texel = 0, basisTexel = 0;
    for (const part of parts) {
      tables.coefficients.set(part.block, 4 * texel);
      this.#fillFrames(tables, part, texel, basisTexel);
      texel += part.block.length / 4;
      basisTexel += 3 * fours(part.K) * part.frameCount;
    }
    return { frameCount, rows: this.#still.rows, level: this.level, fours: Math.max(...parts.map(({ K }) => fours(K))), tables,
      geometry: this.#still.geometry(), box: this.#box };
  }

  /// Of each frame: where its coefficients begin (below 2^20, and how many of those: float32 holds no more than 24 bits), K / 4,
  /// where its basis begins; mean and time. Its basis: x, y, z of four components, then of the next four.
  #fillFrames({ frames, basis: B }, { K, mean, basis, firstFrame, frameCount: n }, texel, basisTexel) {
    const { times } = this.head;
    for (let i = 0; i < n; ++i) {
      const at = basisTexel + 3 * fours(K) * i, f = firstFrame + i;
      frames.set([texel % 2 ** 20, fours(K), at, Math.floor(texel / 2 ** 20), mean[i], mean[n + i], mean[2 * n + i], times[f] - times[0]], 8 * f);
      for (let k = 0; k < K; ++k)
        for (let c = 0; c < 3; ++c) B[4 * (at + 3 * (k >> 2) + c) + (k & 3)] = basis[(k * 3 + c) * n + i];
    }
  }
}

/// made() of pieces that are all there.
export function clipData(head, pieces) {
  const maker = new ClipMaker(head);
  for (const piece of pieces) maker.add(piece);
  return maker.made();
}
