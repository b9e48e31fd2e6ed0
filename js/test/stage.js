/// In the page: reads back from the GPU what a reel's materials make of its vertices.
// SPDX-License-Identifier: MIT
import * as THREE from 'three';

import { ReelLoader } from '../src/index.js';
import { decodeReel } from '../src/decode.js';
import { readBack as readFrom } from '../src/readback.js';
import { areaNormals } from '../src/surface.js';

export { THREE, ReelLoader, decodeReel };
export * from '../src/index.js';

export const renderer = new THREE.WebGLRenderer({ canvas: document.querySelector('canvas') });
renderer.debug.checkShaderErrors = true;

/// [3 x vertices shown]: positions (0) or normals (1).
export const readBack = (mesh, what) => readFrom(renderer, mesh, what);

/// All frames of a file by the CPU decoder, as decodeReel gives them, and its head.
export async function decodedFrames(address) {
  const frames = [];
  let head = null;
  for await (const event of decodeReel(address, { frames: true })) {
    if (event.head) head = event.head;
    if (event.type !== 'segment') continue;
    const { frameCount, frames: all } = event.piece, n = all.length / frameCount;
    for (let f = 0; f < frameCount; ++f) frames.push(all.subarray(f * n, (f + 1) * n));
  }
  return { head, frames };
}

/// Largest distance of a component over the diagonal of the first frame; vertexOf: the file's vertex of each shown.
export function difference(shown, expected, diagonal) {
  let most = 0;
  for (let i = 0; i < shown.length; ++i) most = Math.max(most, Math.abs(shown[i] - expected[i]));
  return most / diagonal;
}

export function diagonalOf(frame) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  frame.forEach((x, i) => {
    low[i % 3] = Math.min(low[i % 3], x);
    high[i % 3] = Math.max(high[i % 3], x);
  });
  return Math.hypot(...high.map((x, c) => x - low[c]));
}

/// Angles in degrees between the normals that a mesh shows and those of the triangles around each vertex, sorted.
export function normalAngles(mesh, frame, { triangles, rowOf }) {
  const shown = readBack(mesh, 1), rows = new Float64Array(3 * mesh.clip.rows), angles = [];
  rowOf.forEach((row, v) => rows.set(frame.subarray(3 * v, 3 * v + 3), 3 * row));
  const own = areaNormals(rows, triangles.map((v) => rowOf[v]));
  for (let i = 0; i < shown.length; i += 3) {
    const v = 3 * mesh.geometry.attributes.reelRow.getX(i / 3);
    const dot = own[v] * shown[i] + own[v + 1] * shown[i + 1] + own[v + 2] * shown[i + 2];
    if (own[v] || own[v + 1] || own[v + 2]) angles.push((180 / Math.PI) * Math.acos(Math.min(1, Math.max(-1, dot))));
  }
  return angles.sort((a, b) => a - b);
}
