/// gltfpack on a GLB file, and back: what a viewer computes from meshopt-compressed morph targets, in the order of _ID.
// SPDX-License-Identifier: MIT
import fs from 'fs';
import { pack } from 'gltfpack';
import { MeshoptDecoder } from 'meshoptimizer';

const arrays = { 5120: Int8Array, 5121: Uint8Array, 5122: Int16Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };
const widths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
const largest = { 5120: 127, 5121: 255, 5122: 32767, 5123: 65535 };

function demand(condition, sentence) {
  if (!condition) throw new Error(sentence);
}

/// The two chunks of a GLB file.
function chunksOf(file) {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  demand(view.getUint32(0, true) === 0x46546c67, 'no GLB file');
  const size = view.getUint32(12, true), text = file.subarray(20, 20 + size);
  return [JSON.parse(new TextDecoder().decode(text)), file.subarray(28 + size, 28 + size + view.getUint32(20 + size, true))];
}

function viewBytes(document, binary, index) {
  const view = document.bufferViews[index];
  const packed = view.extensions?.EXT_meshopt_compression ?? view.extensions?.KHR_meshopt_compression;
  if (!packed) return binary.slice(view.byteOffset ?? 0, (view.byteOffset ?? 0) + view.byteLength);
  const target = new Uint8Array(packed.count * packed.byteStride), start = packed.byteOffset ?? 0;
  MeshoptDecoder.decodeGltfBuffer(target, packed.count, packed.byteStride, binary.subarray(start, start + packed.byteLength), packed.mode, packed.filter);
  return target;
}

/// Reads accessors as numbers, one after the other; a view is unpacked once.
function reader(document, binary) {
  const views = document.bufferViews.map((_, index) => viewBytes(document, binary, index));
  return index => {
    const { bufferView, byteOffset = 0, componentType, count, type, normalized } = document.accessors[index];
    const width = widths[type], kind = arrays[componentType];
    const stride = (document.bufferViews[bufferView].byteStride ?? width * kind.BYTES_PER_ELEMENT) / kind.BYTES_PER_ELEMENT;
    const bytes = views[bufferView], source = new kind(bytes.buffer, bytes.byteOffset + byteOffset, (bytes.byteLength - byteOffset) / kind.BYTES_PER_ELEMENT | 0);
    const values = new Float64Array(count * width), scale = normalized ? 1 / largest[componentType] : 1;
    for (let i = 0; i < count; ++i) for (let c = 0; c < width; ++c) values[i * width + c] = source[i * stride + c] * scale;
    return values;
  };
}

/// Scale and translation of all nodes above and at the mesh's.
function transformOf(document, node) {
  let scale = [1, 1, 1], shift = [0, 0, 0];
  for (let at = node; at >= 0; at = document.nodes.findIndex(other => other.children?.includes(at))) {
    const { rotation, matrix, scale: s = [1, 1, 1], translation: t = [0, 0, 0] } = document.nodes[at];
    demand(!rotation && !matrix, 'a node turns the mesh');
    scale = scale.map((value, axis) => value * s[axis]);
    shift = shift.map((value, axis) => value * s[axis] + t[axis]);
  }
  return { scale, shift };
}

/// Weights at each key [F x K].
function weightsOf(document, read, node, K) {
  const { samplers, channels } = document.animations[0];
  const channel = channels.find(({ target }) => target.node === node && target.path === 'weights');
  demand(channel && (samplers[channel.sampler].interpolation ?? 'LINEAR') === 'LINEAR', 'no linear track of weights');
  const weights = read(samplers[channel.sampler].output), F = document.accessors[samplers[channel.sampler].input].count;
  demand(weights.length === F * K, `${weights.length} weights are not ${K} in each of ${F} frames`);
  return { weights, F };
}

function posed(frame, base, targets, weights) {
  frame.set(base);
  targets.forEach((target, k) => {
    const weight = weights[k];
    if (weight !== 0) for (let i = 0; i < frame.length; ++i) frame[i] += weight * target[i];
  });
}

function decode(file) {
  const [document, binary] = chunksOf(file), read = reader(document, binary);
  const node = document.nodes.findIndex(({ mesh }) => mesh === 0), [primitive, ...more] = document.meshes[0].primitives;
  demand(document.meshes.length === 1 && more.length === 0 && node >= 0, 'not one mesh of one primitive');
  const ids = read(primitive.attributes._ID), base = read(primitive.attributes.POSITION);
  const targets = primitive.targets.map(({ POSITION }) => read(POSITION)), triangles = read(primitive.indices);
  const { weights, F } = weightsOf(document, read, node, targets.length), { scale, shift } = transformOf(document, node);
  const V = ids.length, T = triangles.length / 3;
  demand(new Set(ids).size === V && ids.every(id => Number.isInteger(id) && id < V), `the numbers in _ID are not those of ${V} vertices`);
  const numbers = new Uint32Array(3 + 3 * T + 3 * V * F), positions = new Float32Array(numbers.buffer, 4 * (3 + 3 * T));
  numbers.set([V, F, T]);
  for (let i = 0; i < 3 * T; ++i) numbers[3 + i] = ids[triangles[i]];
  const frame = new Float64Array(3 * V);
  for (let f = 0; f < F; ++f) {
    posed(frame, base, targets, weights.subarray(f * targets.length, (f + 1) * targets.length));
    for (let v = 0; v < V; ++v) for (let axis = 0; axis < 3; ++axis) positions[3 * (V * f + ids[v]) + axis] = frame[3 * v + axis] * scale[axis] + shift[axis];
  }
  return numbers;
}

async function encode(file, options) {
  let written;
  const files = { read: () => file, write: (path, data) => { if (path === 'out.glb') written = data; } };
  await pack(['-i', 'in.glb', '-o', 'out.glb', ...options], files);
  demand(written, 'gltfpack wrote nothing');
  return written;
}

// gltfpack's WebAssembly is compiled and MeshoptDecoder made ready before the clock starts.
const [verb, ...words] = process.argv.slice(2), [input, output] = words.slice(-2);
await MeshoptDecoder.ready;
if (verb === 'encode') await pack(['-v'], { read: () => {}, write: () => {} });
const given = new Uint8Array(fs.readFileSync(input));
const start = process.cpuUsage(); // processor seconds, V8's own threads included
const result = verb === 'encode' ? await encode(given, words.slice(0, -2)) : decode(given);
const { user, system } = process.cpuUsage(start), seconds = (user + system) / 1e6;
fs.writeFileSync(output, new Uint8Array(result.buffer, result.byteOffset, result.byteLength));
console.log(seconds);
