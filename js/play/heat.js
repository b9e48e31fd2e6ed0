/// The error as colour: distances between two animations, a colour bar in units, and a material that shows them.
// SPDX-License-Identifier: MIT
import { BufferAttribute, DataTexture, DoubleSide, LinearFilter, MeshStandardMaterial, RGBAFormat, SRGBColorSpace } from 'three';

import { ReelError } from '../src/decode.js';

// viridis, by van der Walt and Smith
const viridis = ['#440154', '#482475', '#414487', '#355f8d', '#2a788e', '#21918c', '#22a884', '#44bf70', '#7ad151', '#bddf26', '#fde725'];

/// Red, green, blue of a share in [0, 1].
export function colourOf(share) {
  const x = Math.min(Math.max(share, 0), 1) * (viridis.length - 1), i = Math.min(Math.floor(x), viridis.length - 2);
  const channel = (n, c) => parseInt(viridis[n].slice(1 + 2 * c, 3 + 2 * c), 16);
  return [0, 1, 2].map((c) => Math.round(channel(i, c) * (1 - x + i) + channel(i + 1, c) * (x - i)));
}

/// A round number not below x: 1, 1.5, 2, 3, 5, 7.5 times a power of ten.
export function roundUp(x) {
  if (!(x > 0)) return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [1, 1.5, 2, 3, 5, 7.5, 10].find((step) => step * power >= x * (1 - 1e-9));
}

/// Frames of pieces one after the other, each [3 V].
export function framesOf(pieces) {
  return pieces.flatMap(({ frames, frameCount: F }) => Array.from({ length: F }, (_, f) => frames.subarray((f * frames.length) / F, ((f + 1) * frames.length) / F)));
}

/// Distance of every row in every frame: { values: [F x rows], largest: [F], mean: [F], top }; top: what one in a thousand exceeds,
/// rounded up. @throws ReelError where the two cannot be compared.
export async function distances(original, decoded, breathe = () => new Promise((next) => setTimeout(next))) {
  const { rowOf } = decoded.head.surface, rows = decoded.head.codedVertexCount;
  check(original.head, decoded.head);
  const firstOf = new Uint32Array(rows);
  for (let v = rowOf.length; v-- > 0;) firstOf[rowOf[v]] = v;
  const a = framesOf(original.pieces), b = framesOf(decoded.pieces), F = b.length;
  const all = { values: new Float32Array(F * rows), largest: new Float32Array(F), mean: new Float32Array(F), rows };
  for (let f = 0; f < F; ++f) {
    if (f % 16 === 15) await breathe();
    let sum = 0, most = 0;
    for (let r = 0; r < rows; ++r) {
      const i = 3 * firstOf[r];
      const d = Math.hypot(a[f][i] - b[f][i], a[f][i + 1] - b[f][i + 1], a[f][i + 2] - b[f][i + 2]);
      all.values[f * rows + r] = d;
      sum += d;
      most = Math.max(most, d);
    }
    all.largest[f] = most;
    all.mean[f] = sum / rows;
  }
  return { ...all, top: roundUp(nearlyAll(all)) };
}

function check(original, decoded) {
  for (const [count, name] of [['vertexCount', 'vertices'], ['triangleCount', 'triangles'], ['frameCount', 'frames']])
    if (original[count] !== decoded[count])
      throw new ReelError(`cannot be compared: the original has ${original[count]} ${name}, this file ${decoded[count]}`, { code: 3 });
}

/// The value that 99.9 % are below, by a histogram.
function nearlyAll({ values, largest }) {
  const most = largest.reduce((a, b) => Math.max(a, b), 0), bins = new Uint32Array(4096);
  if (most === 0) return 0;
  for (const d of values) ++bins[Math.min(4095, Math.floor((d / most) * 4096))];
  let left = values.length / 1000, i = 4095;
  while (i > 0 && (left -= bins[i]) > 0) --i;
  return ((i + 1) / 4096) * most;
}

/// The colours as a texture, made once.
let colours = null;
function ramp() {
  const bytes = Uint8Array.from({ length: 1024 }, (_, i) => (i % 4 === 3 ? 255 : colourOf((i >> 2) / 255)[i % 4]));
  colours ??= Object.assign(new DataTexture(bytes, 256, 1, RGBAFormat), { colorSpace: SRGBColorSpace, minFilter: LinearFilter, magFilter: LinearFilter, needsUpdate: true });
  return colours;
}

/// A material that shows the attribute `heat`, of distances.
export function heatMaterial(top) {
  const material = new MeshStandardMaterial({ side: DoubleSide, roughness: 0.9 });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, { heatRamp: { value: ramp() }, heatTop: { value: top } });
    shader.vertexShader = shader.vertexShader.replace('#include <common>', '#include <common>\nattribute float heat;\nvarying float vHeat;')
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvHeat = heat;');
    shader.fragmentShader = shader.fragmentShader.replace('#include <common>', '#include <common>\nuniform sampler2D heatRamp;\nuniform float heatTop;\nvarying float vHeat;')
      .replace('#include <color_fragment>', 'diffuseColor.rgb = texture2D( heatRamp, vec2( clamp( vHeat / heatTop, 0.0, 1.0 ) * 0.996 + 0.002, 0.5 ) ).rgb;');
  };
  return material;
}

/// Gives a clip's geometry the distances at a time, mixed of the two frames around it.
export function showHeat(clip, { values, rows }, time) {
  const { attributes } = clip.geometry, { times, start } = clip.timeline, row = attributes.reelRow;
  if (!attributes.heat) clip.geometry.setAttribute('heat', new BufferAttribute(new Float32Array(row.count), 1));
  const next = times.findIndex((t) => t - start > time), high = next < 0 ? times.length - 1 : next, low = Math.max(0, high - 1);
  const share = times[high] > times[low] ? Math.min(1, (time + start - times[low]) / (times[high] - times[low])) : 0;
  for (let i = 0; i < row.count; ++i) {
    const r = row.getX(i);
    attributes.heat.array[i] = (1 - share) * values[low * rows + r] + share * values[high * rows + r];
  }
  attributes.heat.needsUpdate = true;
}
