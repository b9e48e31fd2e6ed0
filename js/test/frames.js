/// In the page: what the decoder gives, and how far the GPU is from it.
// SPDX-License-Identifier: MIT
import { decodeReel } from '../src/decode.js';

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
