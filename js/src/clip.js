/// A decoded animation, ready for the GPU: tables of coefficients, basis and frames, and the surface that wears them.
// SPDX-License-Identifier: MIT
import { ReelError } from './decoder.js';
import { areaNormals, shownSurface, tangentSums } from './surface.js';
import { Timeline } from './timeline.js';

/// Numbers in groups of four, as texels of a texture 2048 wide.
export const tableWidth = 2048;
const tallest = 16384; // texture that WebGL knows of
class Table {
  constructor(texels) {
    this.height = Math.max(1, Math.ceil(texels / tableWidth));
    if (this.height > tallest) throw new ReelError('too many frames of too many vertices for one texture', { code: 5 });
    this.values = new Float32Array(4 * tableWidth * this.height);
  }
}

const fours = (K) => Math.ceil(K / 4);

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

/// The head of what is there so far: the frames of pieces, which begin the file; of a level, its surface.
function headOf(head, pieces) {
  const { firstFrame, frameCount, surface, K, coefficients } = pieces.at(-1), F = firstFrame + frameCount;
  const whole = F === head.frameCount, rows = surface ? coefficients.length / K : head.codedVertexCount;
  const count = surface ? rows : head.vertexCount;
  return { ...head, frameCount: F, times: head.times.subarray(0, F), loop: head.loop && whole, codedVertexCount: rows, vertexCount: count,
    surface: surface ? { ...surface, rowOf: Uint32Array.from({ length: rows }, (_, r) => r) } : head.surface };
}

export class ReelData {
  /// head and pieces of decodeReel(): segments, or segments of one level, from the first, in order.
  constructor(file, given) {
    const head = headOf(file, given);
    this.head = head;
    this.pieces = given.flatMap((piece) => posable(piece, head.surface.rowOf, head.codedVertexCount));
    this.timeline = new Timeline(head.times, head.loop, head.fps);
    this.rows = head.codedVertexCount;
    this.surface = shownSurface(head.surface, head.vertexCount);
    this.rowOf = this.surface.vertexOf.map((v) => head.surface.rowOf[v]);
    this.rest = this.rowPositions(0);
    this.#addNormals();
    this.#makeTables();
  }

  #pieceOf(f) {
    return this.pieces.findLast((piece) => piece.firstFrame <= f);
  }

  /// Positions of the rows in a stored frame, [3 rows].
  rowPositions(f) {
    const { K, mean, basis, coefficients, firstFrame, frameCount: n } = this.#pieceOf(f);
    const out = new Float64Array(3 * this.rows);
    for (let c = 0; c < 3; ++c) {
      const at = c * n + f - firstFrame;
      for (let r = 0; r < this.rows; ++r) {
        let sum = mean[at];
        for (let k = 0; k < K; ++k) sum += coefficients[r * K + k] * basis[k * 3 * n + at];
        out[3 * r + c] = sum;
      }
    }
    return out;
  }

  /// Where a file has normals, those are the ones at rest, corner by corner; else each row has that of its triangles.
  #addNormals() {
    const { index, count, attributes } = this.surface;
    const given = attributes.find((a) => a.name === 'normal' && a.components === 3 && a.values instanceof Float32Array);
    const rowIndex = index.map((i) => this.rowOf[i]);
    const own = areaNormals(this.rest, rowIndex);
    this.normals = given ? given.values : Float32Array.from({ length: 3 * count }, (_, i) => own[3 * this.rowOf[(i / 3) | 0] + (i % 3)]);
    this.tangentRowOf = given ? Uint32Array.from({ length: count }, (_, i) => i) : this.rowOf;
    const all = Uint32Array.from({ length: this.rows }, (_, r) => r);
    this.sums = tangentSums(given ? { index, rowOf: this.rowOf, rest: this.rest, normals: Float64Array.from(this.normals) }
      : { index: rowIndex, rowOf: all, rest: this.rest, normals: own });
  }

  #makeTables() {
    const tangents = this.sums.begin.length - 1, F = this.head.frameCount;
    const sizes = this.pieces.map((piece) => (this.rows + 2 * tangents) * fours(piece.K));
    this.coefficients = new Table(sizes.reduce((a, b) => a + b, 0));
    this.basis = new Table(this.pieces.reduce((sum, piece) => sum + 3 * fours(piece.K) * piece.frameCount, 0));
    this.frames = new Table(2 * F);
    let texel = 0, basisTexel = 0;
    for (const [s, piece] of this.pieces.entries()) {
      this.#fillCoefficients(piece, texel);
      this.#fillFrames(piece, texel, basisTexel);
      texel += sizes[s];
      basisTexel += 3 * fours(piece.K) * piece.frameCount;
    }
    this.texels = texel;
  }

  /// A row after the other, then the two tangents of each vertex.
  #fillCoefficients({ K, coefficients: C }, texel) {
    const out = this.coefficients.values, width = 4 * fours(K);
    for (let r = 0; r < this.rows; ++r) out.set(C.subarray(r * K, (r + 1) * K), 4 * texel + r * width);
    const { begin, row, u, v } = this.sums, own = this.#tangentOwners();
    for (let i = 0; i + 1 < begin.length; ++i) {
      const at = 4 * texel + (this.rows + 2 * i) * width;
      for (let j = begin[i]; j < begin[i + 1]; ++j)
        for (let k = 0; k < K; ++k) {
          const edge = C[row[j] * K + k] - C[own[i] * K + k];
          out[at + k] += u[j] * edge;
          out[at + width + k] += v[j] * edge;
        }
    }
  }
  #tangentOwners() {
    if (this.tangentRowOf === this.rowOf) return Uint32Array.from({ length: this.rows }, (_, r) => r);
    return this.rowOf;
  }

  /// Of each frame: where its coefficients begin (below 2^20, and how many of those: float32 holds no more than 24 bits), K / 4,
  /// where its basis begins; mean and time. Its basis: x, y, z of four components, then of the next four.
  #fillFrames({ K, mean, basis, firstFrame, frameCount: n }, texel, basisTexel) {
    for (let i = 0; i < n; ++i) {
      const at = basisTexel + 3 * fours(K) * i, f = firstFrame + i;
      this.frames.values.set([texel % 2 ** 20, fours(K), at, Math.floor(texel / 2 ** 20), mean[i], mean[n + i], mean[2 * n + i], this.head.times[f] - this.timeline.start], 8 * f);
      for (let k = 0; k < K; ++k)
        for (let c = 0; c < 3; ++c) this.basis.values[4 * (at + 3 * (k >> 2) + c) + (k & 3)] = basis[(k * 3 + c) * n + i];
    }
  }

  /// A box that holds every stored frame: { min, max }.
  bounds() {
    const min = [Infinity, Infinity, Infinity], max = [-Infinity, -Infinity, -Infinity];
    for (const { K, mean, basis, coefficients: C, frameCount: n } of this.pieces) {
      const least = new Float64Array(K).fill(Infinity), most = new Float64Array(K).fill(-Infinity);
      for (let i = 0; i < C.length; ++i) {
        least[i % K] = Math.min(least[i % K], C[i]);
        most[i % K] = Math.max(most[i % K], C[i]);
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
    return { min, max };
  }
}

/// The basis mixed of four frames by their weights, and before it the mean, into out: four numbers of the mean, then of every four
/// components x, y and z. Returns where their coefficients begin; -1: they are of more than one segment, or do not fit.
export function mixedBasis({ basis, frames }, frameOf, weightOf, out) {
  const first = 8 * frameOf[weightOf.findIndex((weight) => weight !== 0)], begin = frames[first] + frames[first + 3] * 2 ** 20;
  const size = 12 * frames[first + 1];
  if (out.length < 4 + size) return -1;
  out.fill(0);
  for (let n = 0; n < 4; ++n) {
    const at = 8 * frameOf[n], weight = weightOf[n];
    if (weight === 0) continue;
    if (frames[at] + frames[at + 3] * 2 ** 20 !== begin) return -1;
    for (let c = 0; c < 3; ++c) out[c] += weight * frames[at + 4 + c];
    for (let i = 0, from = 4 * frames[at + 2]; i < size; ++i) out[4 + i] += weight * basis[from + i];
  }
  return begin;
}

/// Positions of the rows for four frames and their weights, [3 rows]: what the shader does (src/shader.js), on the CPU. The
/// basis is mixed before the coefficients are met. tables: { coefficients, basis, frames }, arrays of numbers.
export function mixedRows({ coefficients: C, basis, frames }, frameOf, weightOf, out) {
  const mixes = new Map(); // one for each segment in it, by where its coefficients begin
  for (let n = 0; n < 4; ++n) {
    if (weightOf[n] === 0) continue;
    const at = 8 * frameOf[n], begin = frames[at] + frames[at + 3] * 2 ** 20, count = frames[at + 1];
    if (!mixes.has(begin)) mixes.set(begin, { count, mean: new Float64Array(3), mixed: new Float64Array(12 * count) });
    const { mean, mixed } = mixes.get(begin), first = 4 * frames[at + 2];
    for (let i = 0; i < 12 * count; ++i) mixed[i] += weightOf[n] * basis[first + i];
    for (let c = 0; c < 3; ++c) mean[c] += weightOf[n] * frames[at + 4 + c];
  }
  out.fill(0);
  for (const [begin, mix] of mixes) addRows(C, 4 * begin, mix, out);
  return out;
}

function addRows(C, begin, { count, mean, mixed }, out) {
  for (let r = 0; r < out.length / 3; ++r) {
    let [x, y, z] = mean;
    for (let k = 0, c = begin + 4 * count * r; k < count; ++k)
      for (let j = 12 * k; j < 12 * k + 4; ++j, ++c) {
        x += C[c] * mixed[j];
        y += C[c] * mixed[j + 4];
        z += C[c] * mixed[j + 8];
      }
    out[3 * r] += x;
    out[3 * r + 1] += y;
    out[3 * r + 2] += z;
  }
}
