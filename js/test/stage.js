/// In the page: reads back from the GPU what a reel's materials make of its vertices.
// SPDX-License-Identifier: MIT
import * as THREE from 'three';

import { ReelLoader } from '../src/index.js';
import { decodeReel } from '../src/decode.js';
import { readBack as readFrom } from '../src/readback.js';
import { areaNormals } from '../src/surface.js';

export { THREE, ReelLoader, decodeReel };
export * from '../src/index.js';
export { decodedFrames, diagonalOf, difference } from './frames.js';

export const renderer = new THREE.WebGLRenderer({ canvas: document.querySelector('canvas') });
renderer.debug.checkShaderErrors = true;

/// [3 x vertices shown]: positions (0) or normals (1).
export const readBack = (mesh, what) => readFrom(renderer, mesh, what);

/// What is sent to the card to show a mesh at a time: how many numbers in a picture, and the names of other calls that send.
export function uploads(mesh, time) {
  const gl = renderer.getContext(), sent = [], calls = ['texImage2D', 'texSubImage2D', 'texStorage2D', 'bufferData', 'bufferSubData'];
  for (const name of calls) gl[name] = (...words) => (sent.push(words.at(-1)?.length ?? name), WebGL2RenderingContext.prototype[name].apply(gl, words));
  mesh.frustumCulled = false;
  mesh.player.seek(time);
  renderer.render(new THREE.Scene().add(mesh), new THREE.PerspectiveCamera());
  for (const name of calls) delete gl[name];
  return sent;
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
