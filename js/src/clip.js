/// A decoded animation, ready for the GPU: tables of coefficients, basis and frames, and the surface that wears them.
// SPDX-License-Identifier: MIT
import { ReelError } from './decoder.js';
import { areaNormals, shownSurface, tangentSums } from './surface.js';
import { Timeline } from './timeline.js';

/// Numbers in groups of four, as texels of a texture 2048 wide.
export const tableWidth = 2048;
class Table {
  constructor(texels) {
    this.height = Math.max(1, Math.ceil(texels / tableWidth));
    this.values = new Float32Array(4 * tableWidth * this.height);
  }
}

const fours = (K) => Math.ceil(K / 4);

export class ReelData {
  /// head and pieces of decodeReel(): all segments, in order.
  constructor(head, pieces) {
    if (pieces.some((piece) => piece.exact))
      throw new ReelError(`the codec ${head.codec} is exact: its frames can be decoded, not posed`, { code: 5, field: 'HEAD.codec' });
    this.head = head;
    this.pieces = pieces;
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

  /// Of each frame: where its coefficients begin, K / 4, where its basis begins; mean and time. Its basis: x, y, z of four
  /// components, then of the next four.
  #fillFrames({ K, mean, basis, firstFrame, frameCount: n }, texel, basisTexel) {
    for (let i = 0; i < n; ++i) {
      const at = basisTexel + 3 * fours(K) * i, f = firstFrame + i;
      this.frames.values.set([texel, fours(K), at, 0, mean[i], mean[n + i], mean[2 * n + i], this.head.times[f] - this.timeline.start], 8 * f);
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
