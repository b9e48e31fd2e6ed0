/// What the page tells of an animation in numbers.
// SPDX-License-Identifier: MIT

const grouped = (n) => String(n).replace(/\B(?=(\d{3})+$)/g, '\u202f');

export function bytesText(bytes) {
  const step = bytes >= 1e9 ? [1e9, 'GB'] : bytes >= 1e6 ? [1e6, 'MB'] : bytes >= 1e3 ? [1e3, 'kB'] : [1, 'bytes'];
  return `${step[0] === 1 ? bytes : (bytes / step[0]).toPrecision(3)} ${step[1]}`;
}

/// A length of an animation: in mm where its unit is known. { text, unit, scale }
export function lengthText(length, { metresPerUnit }) {
  const [scale, unit] = metresPerUnit > 0 ? [1000 * metresPerUnit, 'mm'] : [1, 'units'];
  return { text: `${+(length * scale).toPrecision(3)} ${unit}`, unit, scale };
}

/// Bytes that the graphics card holds of a clip: tables, and what the geometry has.
export function cardBytes({ gpuBytes, geometry }) {
  const arrays = [geometry.index, ...Object.values(geometry.attributes)].map(({ array }) => array.byteLength);
  return arrays.reduce((a, b) => a + b, gpuBytes);
}

export function figures(list, page) {
  const { clip, head, pieces } = page.shown, { item } = page;
  if (!clip) return list.replaceChildren();
  const K = pieces.filter((piece) => !piece.exact).map((piece) => piece.K), F = head.frameCount, V = head.vertexCount;
  const rows = [['vertices V', grouped(V)]];
  if (clip.head.vertexCount !== V) rows.push(['shown of them', grouped(clip.head.vertexCount)]);
  rows.push(['triangles T', grouped(clip.head.triangleCount === head.triangleCount ? head.triangleCount : clip.geometry.index.count / 3)],
    ['frames F', clip.head.frameCount === F ? grouped(F) : `${clip.head.frameCount} of ${F}`]);
  if (K.length > 0) rows.push(['bases K', Math.min(...K) === Math.max(...K) ? K[0] : `${Math.min(...K)} to ${Math.max(...K)}`]);
  if (pieces.length > 1) rows.push(['segments loaded', pieces.length]);
  rows.push([item.raw ? 'as float32' : 'file', bytesText(item.bytes)]);
  if (!item.raw) rows.push(['bits / frame / vertex', ((8 * item.bytes) / (F * V)).toPrecision(3)]);
  rows.push(['on the card', bytesText(cardBytes(clip))]);
  if (page.frameTimes.length > 0) {
    const sorted = [...page.frameTimes].sort((a, b) => a - b);
    page.frameTime = `${sorted[sorted.length >> 1].toFixed(1)} ms`;
  }
  rows.push(['frame time', page.frameTime ?? '–']);
  list.replaceChildren(...rows.flatMap(([name, value]) =>
    [Object.assign(document.createElement('dt'), { textContent: name }), Object.assign(document.createElement('dd'), { textContent: value })]));
}
