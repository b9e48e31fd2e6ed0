/// A decoded surface as a GPU wants it: vertices split where corners differ, triangles by material, normals at rest.
// SPDX-License-Identifier: MIT

/// Vertices of the mesh shown. surface: of a head; returns { count, vertexOf, index, groups, attributes }: vertexOf: the file's
/// vertex of each; index: [3 T] sorted by material; groups: { start, count, material }; attributes: by name.
export function shownSurface(surface, vertexCount) {
  const corner = surface.attributes.filter((a) => a.domain === 'corner');
  const { index, vertexOf, cornerOf } = splitCorners(surface.triangles, corner, vertexCount);
  const attributes = surface.attributes.filter((a) => a.domain !== 'triangle').map((a) => {
    const element = a.domain === 'corner' ? (i) => cornerOf[i] : (i) => vertexOf[i];
    return { ...a, indices: null, values: gathered(a, vertexOf.length, element) };
  });
  const material = surface.attributes.find((a) => a.domain === 'triangle' && a.name === 'material');
  return { count: vertexOf.length, vertexOf, attributes, ...byMaterial(index, material) };
}

const place = (attribute, element) => (attribute.indices ? attribute.indices[element] : element);

/// One vertex shown for each vertex and combination of its corners' values.
function splitCorners(triangles, attributes, vertexCount) {
  if (attributes.length === 0) {
    const vertexOf = Uint32Array.from({ length: vertexCount }, (_, v) => v);
    return { index: triangles, vertexOf, cornerOf: vertexOf };
  }
  const numbers = new Map(), vertexOf = [], cornerOf = [];
  const index = triangles.map((v, c) => {
    const key = [v, ...attributes.map((a) => place(a, c))].join();
    let number = numbers.get(key);
    if (number === undefined) {
      numbers.set(key, (number = vertexOf.length));
      vertexOf.push(v);
      cornerOf.push(c);
    }
    return number;
  });
  return { index, vertexOf: Uint32Array.from(vertexOf), cornerOf: Uint32Array.from(cornerOf) };
}

/// Values of `count` elements; where an element has none, zeros.
function gathered(attribute, count, element) {
  const { components: n, values } = attribute;
  const out = new values.constructor(count * n);
  for (let i = 0; i < count; ++i) {
    const from = place(attribute, element(i)) * n;
    for (let c = 0; c < n; ++c) out[i * n + c] = values[from + c] ?? 0;
  }
  return out;
}

function byMaterial(index, attribute) {
  const T = index.length / 3;
  if (!attribute) return { index, groups: [] };
  const of = (t) => attribute.values[place(attribute, t)] ?? 0xffffffff;
  const order = Array.from({ length: T }, (_, t) => t).sort((a, b) => of(a) - of(b) || a - b);
  const sorted = new Uint32Array(index.length), groups = [];
  order.forEach((t, i) => {
    sorted.set(index.subarray(3 * t, 3 * t + 3), 3 * i);
    const material = of(t) === 0xffffffff ? 0 : of(t), last = groups.at(-1);
    if (last && last.material === material) last.count += 3;
    else groups.push({ start: 3 * i, count: 3, material });
  });
  return { index: sorted, groups };
}

/// Normals of rows, each triangle weighing as its area: [3 rows].
export function areaNormals(positions, triangles) {
  const normals = new Float64Array(positions.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const e = [0, 1, 2].map((x) => positions[b + x] - positions[a + x]), f = [0, 1, 2].map((x) => positions[c + x] - positions[a + x]);
    for (const v of [a, b, c]) {
      normals[v] += e[1] * f[2] - e[2] * f[1];
      normals[v + 1] += e[2] * f[0] - e[0] * f[2];
      normals[v + 2] += e[0] * f[1] - e[1] * f[0];
    }
  }
  for (let v = 0; v < normals.length; v += 3) {
    const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]) || 1;
    for (let c = 0; c < 3; ++c) normals[v + c] /= length;
  }
  return normals;
}

/// Neighbours along edges of each of `count` corners' ends; ends: what each index stands for.
function rings(index, count, endOf) {
  const found = Array.from({ length: count }, () => new Set());
  for (let t = 0; t < index.length; t += 3)
    for (let i = 0; i < 3; ++i) {
      const v = index[t + i];
      for (const other of [index[t + ((i + 1) % 3)], index[t + ((i + 2) % 3)]])
        if (endOf(other) !== endOf(v)) found[v].add(endOf(other));
    }
  return found;
}

/// Two directions along the surface for each of n vertices, as sums of edges: { begin: [n + 1], row, u, v }, with the edge to
/// row[j] weighing u[j] in the first and v[j] in the second. At rest they are at right angles to each other and to the normal
/// given; the edges' weights are those of the linear map that fits the ring best, so that, as the ring deforms, their cross
/// product is the normal of what that map makes of the tangent plane.
export function tangentSums({ index, rowOf, rest, normals }) {
  const n = normals.length / 3, around = rings(index, n, (v) => rowOf[v]);
  const begin = new Uint32Array(n + 1), row = [], u = [], v = [];
  for (let i = 0; i < n; ++i) {
    for (const [j, x, y] of fitted(around[i], rowOf[i], rest, normals.subarray(3 * i, 3 * i + 3))) {
      row.push(j);
      u.push(x);
      v.push(y);
    }
    begin[i + 1] = row.length;
  }
  return { begin, row: Uint32Array.from(row), u: Float64Array.from(u), v: Float64Array.from(v) };
}

/// [row, weight in u, weight in v] of a ring; none where the ring spans no plane.
function fitted(ring, own, rest, [nx, ny, nz]) {
  const side = Math.abs(nx) < 0.6 ? [1, 0, 0] : [0, 1, 0];
  let a = [side[1] * nz - side[2] * ny, side[2] * nx - side[0] * nz, side[0] * ny - side[1] * nx];
  const length = Math.hypot(...a) || 1;
  a = a.map((x) => x / length);
  const b = [ny * a[2] - nz * a[1], nz * a[0] - nx * a[2], nx * a[1] - ny * a[0]];
  const edges = [], G = new Float64Array(6); // xx, xy, xz, yy, yz, zz
  for (const j of ring) {
    const e = [0, 1, 2].map((c) => rest[3 * j + c] - rest[3 * own + c]);
    const square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    if (square === 0) continue;
    const [x, y, z] = [a, b, [nx, ny, nz]].map((d) => e[0] * d[0] + e[1] * d[1] + e[2] * d[2]);
    edges.push([j, x, y, z, 1 / square]);
    [x * x, x * y, x * z, y * y, y * z, z * z].forEach((product, i) => (G[i] += product / square));
  }
  G[5] += 0.0003 * edges.length; // a flat ring has no height to make up for
  const [xx, xy, xz, yy, yz, zz] = G;
  const A = yy * zz - yz * yz, B = xz * yz - xy * zz, C = xy * yz - xz * yy, D = xx * zz - xz * xz, E = xy * xz - xx * yz;
  const det = xx * A + xy * B + xz * C; // of G; its inverse is symmetric too: rows [A B C], [B D E]
  if (!(det > 1e-7 * edges.length ** 3)) return [];
  return edges.map(([j, x, y, z, w]) => [j, (w * (A * x + B * y + C * z)) / det, (w * (B * x + D * y + E * z)) / det]);
}
