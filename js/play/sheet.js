/// An animation as `meshreel play` sends it that is no .reel file (cli/web/sheet.h).
// SPDX-License-Identifier: MIT

const types = { f32: Float32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i8: Int8Array, i16: Int16Array };
const padded = (bytes) => Math.ceil(bytes / 4) * 4;

/// { head, piece } as decodeReel() gives them: one piece of all frames, exact.
export function readSheet(buffer) {
  const size = new DataView(buffer).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, size)));
  let at = 4 + padded(size);
  const take = (Type, count) => {
    const values = new Type(buffer, at, count);
    at += padded(values.byteLength);
    return values;
  };
  const triangles = take(Uint32Array, 3 * head.triangleCount), rowOf = take(Uint32Array, head.vertexCount);
  const attributes = head.attributes.map(({ type, bytes, indices, ...about }) => ({
    ...about,
    values: take(types[type], bytes / types[type].BYTES_PER_ELEMENT),
    indices: indices > 0 ? take(Uint32Array, indices) : null,
  }));
  const frames = take(Float32Array, 3 * head.vertexCount * head.frameCount);
  const surface = { triangles, rowOf, attributes };
  return {
    head: { codec: 'float32', encoder: '', order: 'keep', assets: [], ...head, times: Float64Array.from(head.times), surface },
    piece: { firstFrame: 0, frameCount: head.frameCount, exact: true, K: 0, frames, surface: null },
  };
}
