/// meshoptimizer's vertex and index codecs on numbers of 16 or 32 bits a coordinate; prints the codec's processor seconds.
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

function packed(levels, order, f) {
  const V = order.length, frame = levels.subarray(3 * V * f, 3 * V * (f + 1));
  const room = stride === 12 ? new Uint32Array(3 * V) : new Uint16Array(4 * V), step = room.length / V;
  for (let v = 0; v < V; ++v) for (let axis = 0; axis < 3; ++axis) room[step * order[v] + axis] = frame[3 * v + axis];
  return room;
}

// Vertices in the order in which triangles, reordered for a vertex cache, meet them: what the codecs are made for.
function encode(numbers) {
  const [V, F, T] = numbers;
  const triangles = numbers.slice(3, 3 + 3 * T), levels = numbers.subarray(3 + 3 * T);
  const [order, met] = MeshoptEncoder.reorderMesh(triangles, true, true);
  if (met !== V) throw new Error(`${V} vertices, but triangles meet ${met}`);
  const parts = [MeshoptEncoder.encodeIndexBuffer(bytesOf(triangles), 3 * T, 4), MeshoptEncoder.encodeIndexSequence(bytesOf(order), V, 4)];
  for (let f = 0; f < F; ++f) parts.push(MeshoptEncoder.encodeVertexBufferLevel(bytesOf(packed(levels, order, f)), V, stride, 3, 1));
  return [bytesOf(Uint32Array.of(V, F, T, ...parts.map(part => part.length))), ...parts];
}

function* partsOf(file, lengths) {
  let at = 12 + 4 * lengths.length;
  for (const length of lengths) yield file.subarray(at, at += length);
  if (at !== file.length) throw new Error(`${file.length} bytes, but the parts end at ${at}`);
}

function decode(file) {
  const [V, F, T] = new Uint32Array(file.slice(0, 12).buffer);
  const parts = [...partsOf(file, new Uint32Array(file.slice(12, 12 + 4 * (F + 2)).buffer))];
  const numbers = new Uint32Array(3 + 3 * T + 3 * V * F), triangles = numbers.subarray(3, 3 + 3 * T);
  const order = new Uint32Array(V), back = new Uint32Array(V), frame = new Uint8Array(stride * V);
  numbers.set([V, F, T]);
  MeshoptDecoder.decodeIndexBuffer(bytesOf(triangles), 3 * T, 4, parts[0]);
  MeshoptDecoder.decodeIndexSequence(bytesOf(order), V, 4, parts[1]);
  order.forEach((place, v) => { back[place] = v; });
  for (let i = 0; i < 3 * T; ++i) triangles[i] = back[triangles[i]];
  const source = stride === 12 ? new Uint32Array(frame.buffer) : new Uint16Array(frame.buffer), step = source.length / V;
  for (let f = 0; f < F; ++f) {
    MeshoptDecoder.decodeVertexBuffer(frame, V, stride, parts[f + 2]);
    const levels = numbers.subarray(3 + 3 * T + 3 * V * f);
    for (let v = 0; v < V; ++v) for (let axis = 0; axis < 3; ++axis) levels[3 * v + axis] = source[step * order[v] + axis];
  }
  return [bytesOf(numbers)];
}

await Promise.all([MeshoptEncoder.ready, MeshoptDecoder.ready]);
const given = verb === 'encode' ? wordsOf(input) : new Uint8Array(fs.readFileSync(input));
const start = process.cpuUsage(); // processor seconds, V8's own threads included
const parts = verb === 'encode' ? encode(given) : decode(given);
const { user, system } = process.cpuUsage(start), seconds = (user + system) / 1e6;
fs.writeFileSync(output, Buffer.concat(parts));
console.log(seconds);
