/// Tables mixed at a time, on the CPU: what the shader does (src/shader.js).
// SPDX-License-Identifier: MIT

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

/// Positions of the rows for four frames and their weights, [3 rows]. The basis is mixed before the coefficients are met. tables:
/// { coefficients, basis, frames }, arrays of numbers.
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
