/// meshoptimizer's vertex and index codecs on numbers of 16 or 32 bits a coordinate; prints the codec's seconds.
// SPDX-License-Identifier: MIT
import fs from 'fs';
import { MeshoptEncoder, MeshoptDecoder } from 'meshoptimizer';

const [verb, width, input, output] = process.argv.slice(2);
const bytesOf = array => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
const wordsOf = path => {
  const bytes = fs.readFileSync(path);
  return new Uint32Array(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength));
};
// 16 bits a coordinate leave two bytes of a vertex over: its size must divide by four.
const stride = width === '16' ? 8 : 12;

function packed(levels, V, f) {
  const frame = levels.subarray(3 * V * f, 3 * V * (f + 1));
  if (stride === 12) return frame;
  const short = new Uint16Array(4 * V);
  for (let v = 0; v < V; ++v) for (let axis = 0; axis < 3; ++axis) short[4 * v + axis] = frame[3 * v + axis];
  return short;
}

function encode(numbers) {
  const [V, F, T] = numbers;
  const triangles = numbers.subarray(3, 3 + 3 * T), levels = numbers.subarray(3 + 3 * T);
  const parts = [MeshoptEncoder.encodeIndexBuffer(bytesOf(triangles), 3 * T, 4)];
  for (let f = 0; f < F; ++f) parts.push(MeshoptEncoder.encodeVertexBufferLevel(bytesOf(packed(levels, V, f)), V, stride, 3, 1));
  return [bytesOf(Uint32Array.of(V, F, T, ...parts.map(part => part.length))), ...parts];
}

function decode(file) {
  const [V, F, T] = new Uint32Array(file.slice(0, 12).buffer);
  const lengths = new Uint32Array(file.slice(12, 12 + 4 * (F + 1)).buffer);
  const numbers = new Uint32Array(3 + 3 * T + 3 * V * F), frame = new Uint8Array(stride * V);
  numbers.set([V, F, T]);
  let at = 12 + 4 * (F + 1);
  MeshoptDecoder.decodeIndexBuffer(bytesOf(numbers.subarray(3, 3 + 3 * T)), 3 * T, 4, file.subarray(at, at + lengths[0]));
  at += lengths[0];
  for (let f = 0; f < F; ++f) {
    MeshoptDecoder.decodeVertexBuffer(frame, V, stride, file.subarray(at, at + lengths[f + 1]));
    at += lengths[f + 1];
    const levels = numbers.subarray(3 + 3 * T + 3 * V * f), source = stride === 12 ? new Uint32Array(frame.buffer) : new Uint16Array(frame.buffer);
    for (let v = 0; v < V; ++v) for (let axis = 0; axis < 3; ++axis) levels[3 * v + axis] = source[(stride === 12 ? 3 : 4) * v + axis];
  }
  if (at !== file.length) throw new Error(`${file.length} bytes, but the parts end at ${at}`);
  return [bytesOf(numbers)];
}

await Promise.all([MeshoptEncoder.ready, MeshoptDecoder.ready]);
const given = verb === 'encode' ? wordsOf(input) : new Uint8Array(fs.readFileSync(input));
const start = performance.now();
const parts = verb === 'encode' ? encode(given) : decode(given);
const seconds = (performance.now() - start) / 1000;
fs.writeFileSync(output, Buffer.concat(parts));
console.log(seconds);
