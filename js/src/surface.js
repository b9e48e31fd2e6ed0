/// A decoded surface as a GPU wants it: vertices split where corners differ, triangles by material, normals and tangents at rest.
// SPDX-License-Identifier: MIT

/// 0, 1, ..., n - 1.
export function numbers(n) {
  const all = new Uint32Array(n);
  for (let i = 0; i < n; ++i) all[i] = i;
  return all;
}

/// Vertices of the mesh shown. surface: of a head; returns { count, vertexOf, index, groups, attributes }: vertexOf: the file's
/// vertex of each; index: [3 T] sorted by material; groups: { start, count, material }; attributes: by name.
export function shownSurface(surface, vertexCount) {
  const corner = surface.attributes.filter((a) => a.domain === 'corner');
  const { index, vertexOf, cornerOf } = splitCorners(surface.triangles, corner, vertexCount);
  const attributes = surface.attributes.filter((a) => a.domain !== 'triangle')
    .map((a) => ({ ...a, indices: null, values: gathered(a, a.domain === 'corner' ? cornerOf : vertexOf) }));
  const material = surface.attributes.find((a) => a.domain === 'triangle' && a.name === 'material');
  return { count: vertexOf.length, vertexOf, attributes, ...byMaterial(index, material) };
}

const place = (attribute, element) => (attribute.indices ? attribute.indices[element] : element);

/// One vertex shown for each vertex and combination of its corners' values.
function splitCorners(triangles, attributes, vertexCount) {
  if (attributes.length === 0) return { index: triangles, vertexOf: numbers(vertexCount), cornerOf: null };
  const index = new Uint32Array(triangles.length), vertexOf = [], cornerOf = [];
  const firstOf = new Int32Array(vertexCount).fill(-1), nextOf = []; // those shown of a vertex, in a chain
  const alike = (c, d) => attributes.every((a) => place(a, c) === place(a, d));
  for (let c = 0; c < triangles.length; ++c) {
    const v = triangles[c];
    let i = firstOf[v];
    while (i >= 0 && !alike(c, cornerOf[i])) i = nextOf[i];
    if (i < 0) {
      i = vertexOf.push(v) - 1;
      cornerOf.push(c);
      nextOf.push(firstOf[v]);
      firstOf[v] = i;
    }
    index[c] = i;
  }
  return { index, vertexOf: Uint32Array.from(vertexOf), cornerOf: Uint32Array.from(cornerOf) };
}

/// Values of elements; where one has none, zeros.
function gathered(attribute, elements) {
  const { components: n, values } = attribute, out = new values.constructor(elements.length * n);
  for (let i = 0; i < elements.length; ++i) {
    const from = place(attribute, elements[i]) * n;
    for (let c = 0; c < n; ++c) out[i * n + c] = values[from + c] ?? 0;
  }
  return out;
}

function byMaterial(index, attribute) {
  const T = index.length / 3;
  if (!attribute) return { index, groups: [] };
  const of = (t) => attribute.values[place(attribute, t)] ?? 0xffffffff;
  const order = numbers(T).sort((a, b) => of(a) - of(b) || a - b), sorted = new Uint32Array(index.length), groups = [];
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
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ex = positions[b] - positions[a], ey = positions[b + 1] - positions[a + 1], ez = positions[b + 2] - positions[a + 2];
    const fx = positions[c] - positions[a], fy = positions[c + 1] - positions[a + 1], fz = positions[c + 2] - positions[a + 2];
    const x = ey * fz - ez * fy, y = ez * fx - ex * fz, z = ex * fy - ey * fx;
    add(normals, a, x, y, z);
    add(normals, b, x, y, z);
    add(normals, c, x, y, z);
  }
  for (let v = 0; v < normals.length; v += 3) {
    const length = Math.hypot(normals[v], normals[v + 1], normals[v + 2]) || 1;
    for (let c = 0; c < 3; ++c) normals[v + c] /= length;
  }
  return normals;
}

function add(out, at, x, y, z) {
  out[at] += x;
  out[at + 1] += y;
  out[at + 2] += z;
}

/// Rows along edges around each of n vertices, each row once: those of vertex i stand in row[begin[i]], ..., row[begin[i + 1] - 1].
function rings(index, n, rowOf) {
  const { begin: first, row: all } = neighbours(index, n, rowOf), row = new Uint32Array(all.length), begin = new Uint32Array(n + 1);
  const seenBy = new Int32Array(rowOf.reduce((most, r) => Math.max(most, r), 0) + 1).fill(-1);
  let count = 0;
  for (let i = 0; i < n; ++i) {
    seenBy[rowOf[i]] = i;
    for (let j = first[i]; j < first[i + 1]; ++j) {
      const r = all[j];
      if (seenBy[r] !== i) row[count++] = r;
      seenBy[r] = i;
    }
    begin[i + 1] = count;
  }
  return { begin, row: row.subarray(0, count) };
}

/// The rows of both other corners of every triangle at a vertex, likewise.
function neighbours(index, n, rowOf) {
  const begin = new Uint32Array(n + 1), row = new Uint32Array(2 * index.length);
  for (let c = 0; c < index.length; ++c) begin[index[c] + 1] += 2;
  for (let i = 0; i < n; ++i) begin[i + 1] += begin[i];
  const at = begin.slice(0, n);
  for (let t = 0; t < index.length; t += 3)
    for (let i = 0; i < 3; ++i) {
      const v = index[t + i];
      row[at[v]++] = rowOf[index[t + ((i + 1) % 3)]];
      row[at[v]++] = rowOf[index[t + ((i + 2) % 3)]];
    }
  return { begin, row };
}

/// Two directions along the surface for each of n vertices, as sums of edges: { begin: [n + 1], row, u, v }, with the edge to
/// row[j] weighing u[j] in the first and v[j] in the second. At rest they are at right angles to each other and to the normal
/// given; the edges' weights are those of the linear map that fits the ring best, so that, as the ring deforms, their cross
/// product is the normal of what that map makes of the tangent plane.
export function tangentSums({ index, rowOf, rest, normals }) {
  const n = normals.length / 3, { begin, row } = rings(index, n, rowOf);
  const sums = { begin, row, u: new Float64Array(row.length), v: new Float64Array(row.length) }, edges = [];
  for (let i = 0; i < n; ++i) {
    const axes = plane(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    for (let j = begin[i]; j < begin[i + 1]; ++j) setEdge(edges, 4 * (j - begin[i]), { axes, rest, from: 3 * rowOf[i], to: 3 * row[j] });
    fit(sums, begin[i], begin[i + 1], edges);
  }
  return sums;
}

/// Two unit vectors at right angles to a unit normal, and it: [9].
function plane(x, y, z) {
  const steep = Math.abs(x) >= 0.6; // then y is aside, else x
  let ax = steep ? z : 0, ay = steep ? 0 : -z, az = steep ? -x : y;
  const length = Math.hypot(ax, ay, az) || 1;
  ax /= length;
  ay /= length;
  az /= length;
  return [ax, ay, az, y * az - z * ay, z * ax - x * az, x * ay - y * ax, x, y, z];
}

/// An edge in axes of its vertex, and what it weighs: one over its square; nothing where it has no length.
function setEdge(edges, at, { axes, rest, from, to }) {
  const x = rest[to] - rest[from], y = rest[to + 1] - rest[from + 1], z = rest[to + 2] - rest[from + 2], square = x * x + y * y + z * z;
  for (let i = 0; i < 3; ++i) edges[at + i] = axes[3 * i] * x + axes[3 * i + 1] * y + axes[3 * i + 2] * z;
  edges[at + 3] = square > 0 ? 1 / square : 0;
}

/// Weights of the edges from `first` to `end`: the inverse of the sum of their outer products. A ring that spans no plane has none.
function fit({ u, v }, first, end, edges) {
  let xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, count = 0;
  for (let e = 0; e < 4 * (end - first); e += 4) {
    const x = edges[e], y = edges[e + 1], z = edges[e + 2], weight = edges[e + 3];
    xx += weight * x * x;
    xy += weight * x * y;
    xz += weight * x * z;
    yy += weight * y * y;
    yz += weight * y * z;
    zz += weight * z * z;
    if (weight > 0) ++count;
  }
  zz += 0.0003 * count; // a flat ring has no height to make up for
  const A = yy * zz - yz * yz, B = xz * yz - xy * zz, C = xy * yz - xz * yy, D = xx * zz - xz * xz, E = xy * xz - xx * yz;
  const det = xx * A + xy * B + xz * C; // the inverse is symmetric too: rows [A B C], [B D E]
  if (!(det > 1e-7 * count ** 3)) return;
  for (let j = first, e = 0; j < end; ++j, e += 4) {
    const x = edges[e], y = edges[e + 1], z = edges[e + 2], scale = edges[e + 3] / det;
    u[j] = scale * (A * x + B * y + C * z);
    v[j] = scale * (B * x + D * y + E * z);
  }
}
