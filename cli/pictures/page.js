// Plays an animation whose vertices carry errors: WebGL 2, no library, no network.
// SPDX-License-Identifier: MIT
"use strict";
const $ = (id) => document.getElementById(id);
const meta = JSON.parse($("meta").textContent);
const { V, T, frames, times, tops, means, low, size, viridis } = meta;
const K = frames.length; // frames of which the page has positions, F of which it has the curve
const F = tops.length;

function bytesOf(id) {
  const text = atob($(id).textContent.replace(/\s+/g, ""));
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  $(id).remove();
  return bytes;
}
const triangles = new Uint32Array(bytesOf("triangles").buffer);
const levels = bytesOf("errors"); // [K x V], 255ths of tops[frames[k]]
const coloured = new Uint16Array(bytesOf("positions").buffer); // [K x V x 3]
const other = $("others") ? new Uint16Array(bytesOf("others").buffer) : null;

// What is on show.
const largest = Math.max(...tops);
const worst = tops.indexOf(largest);
const first = { yaw: 0.52, pitch: 0.4, distance: 2.7, pan: [0, 0] };
const view = structuredClone(first);
let k = nearest(worst), playing = false, show = "error", range = [0, meta.top], dirty = true, clock = 0;

function nearest(frame) {
  let best = 0;
  for (let i = 1; i < K; ++i) if (Math.abs(frames[i] - frame) < Math.abs(frames[best] - frame)) best = i;
  return best;
}
const number = (x) => (x === 0 ? "0" : Math.abs(x) >= 1e5 || Math.abs(x) < 1e-4 ? x.toExponential(2) : String(Number(x.toPrecision(4))));
const unit = meta.unit ? " " + meta.unit : "";

// Positions and normals of the frame on show, y up.
const positions = new Float32Array(3 * V), normals = new Float32Array(3 * V);
function pose() {
  const source = show === "error" || (show === "distorted") === meta.onDistorted || !other ? coloured : other;
  const at = 3 * V * k, turn = { x: [1, 0, 2, -1, 1, 1], y: [0, 1, 2, 1, 1, 1], z: [0, 2, 1, 1, 1, -1] }[meta.up];
  for (let v = 0; v < V; ++v)
    for (let c = 0; c < 3; ++c)
      positions[3 * v + c] = turn[3 + c] * (low[turn[c]] + (size[turn[c]] * source[at + 3 * v + turn[c]]) / 65535);
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2], p = positions;
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const wx = p[c] - p[a], wy = p[c + 1] - p[a + 1], wz = p[c + 2] - p[a + 2];
    const nx = uy * wz - uz * wy, ny = uz * wx - ux * wz, nz = ux * wy - uy * wx;
    for (const i of [a, b, c]) { normals[i] += nx; normals[i + 1] += ny; normals[i + 2] += nz; }
  }
}

// The middle and the half size of all frames, y up.
const centre = [0, 0, 0];
let radius = 1;
{
  const half = size.map((s) => s / 2), mid = low.map((l, i) => l + half[i]);
  const upright = { x: [-mid[1], mid[0], mid[2]], y: mid, z: [mid[0], mid[2], -mid[1]] }[meta.up];
  upright.forEach((x, i) => (centre[i] = x));
  radius = Math.hypot(...half) || 1;
}

// 4 x 4 matrices, column after column.
function product(a, b) {
  const m = new Float32Array(16);
  for (let j = 0; j < 4; ++j)
    for (let i = 0; i < 4; ++i)
      for (let n = 0; n < 4; ++n) m[4 * j + i] += a[4 * n + i] * b[4 * j + n];
  return m;
}
function matrices(aspect) {
  const cy = Math.cos(view.yaw), sy = Math.sin(view.yaw), cp = Math.cos(view.pitch), sp = Math.sin(view.pitch);
  const turn = [cy, sp * sy, -cp * sy, 0, 0, cp, sp, 0, sy, -sp * cy, cp * cy, 0, 0, 0, 0, 1];
  const move = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...centre.map((c) => -c), 1];
  const model = product(turn, move), d = view.distance * radius, focal = 1 / Math.tan(0.3);
  model[12] += view.pan[0] * radius; model[13] += view.pan[1] * radius; model[14] -= d;
  const near = Math.max(d - 2.5 * radius, 0.02 * radius), far = d + 2.5 * radius, fit = Math.min(1, aspect);
  const lens = [(focal * fit) / aspect, 0, 0, 0, 0, focal * fit, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
  return { model, all: product(lens, model) };
}

// The graphics card.
const canvas = $("view");
const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
let card = null;
if (gl) card = setUp();
if (!card) {
  $("failure").hidden = false;
  $("failure").textContent = "This browser shows no WebGL 2, which the mesh needs. The curve below works without it.";
}
function setUp() {
  const vertex = `#version 300 es
    in vec3 position; in vec3 normal; in float error; uniform mat4 all, model; uniform float ball; out vec3 n; out float e;
    void main() { gl_Position = all * vec4(position, 1.0); gl_PointSize = max(2.0, ball / gl_Position.w); n = mat3(model) * normal; e = error; }`;
  const fragment = `#version 300 es
    precision highp float; in vec3 n; in float e; uniform sampler2D ramp; uniform float top, low, high, bare; uniform bool balls; out vec4 colour;
    vec3 linear(vec3 c) { return pow(c, vec3(2.2)); }
    void main() {
      vec3 normal = n;
      if (balls) { vec2 q = 2.0 * gl_PointCoord - 1.0; float s = 1.0 - dot(q, q); if (s < 0.0) discard; normal = vec3(q.x, -q.y, sqrt(s)); }
      normal = dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0, 0.0, 1.0);
      if (normal.z < 0.0) normal = -normal;
      vec3 base = bare > 0.5 ? linear(vec3(0.804, 0.725, 0.612)) : linear(texture(ramp, vec2(clamp((e * top - low) / (high - low), 0.0, 1.0) * 0.99609375 + 0.001953125, 0.5)).rgb);
      float relief = bare > 0.5 ? 1.0 : 0.45;
      float key = max(0.0, dot(normal, vec3(-0.48, 0.62, 0.62)));
      float light = 1.0 + relief * (0.18 + 0.15 * (1.0 + normal.y) + 0.74 * key - 1.0);
      float gloss = 0.1 * max(0.0, 2.0 * relief - 1.0) * pow(max(0.0, dot(normal, vec3(-0.27, 0.36, 0.89))), 24.0);
      colour = vec4(pow(light * base + gloss, vec3(1.0 / 2.2)), 1.0);
    }`;
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text); gl.compileShader(shader); gl.attachShader(program, shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) { console.error(gl.getShaderInfoLog(shader)); return null; }
  }
  gl.linkProgram(program); gl.useProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
  const buffer = (name, count, type, normalized) => {
    const b = gl.createBuffer(), place = gl.getAttribLocation(program, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, b);
    if (place >= 0) { gl.enableVertexAttribArray(place); gl.vertexAttribPointer(place, count, type, normalized, 0, 0); }
    return b;
  };
  const made = { buffers: { position: buffer("position", 3, gl.FLOAT, false), normal: buffer("normal", 3, gl.FLOAT, false), error: buffer("error", 1, gl.UNSIGNED_BYTE, true) } };
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, ramp());
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.enable(gl.DEPTH_TEST);
  for (const name of ["all", "model", "ball", "top", "low", "high", "bare", "balls"]) made[name] = gl.getUniformLocation(program, name);
  return made;
}
function ramp() {
  const bytes = new Uint8Array(1024);
  for (let i = 0; i < 256; ++i) {
    const x = (i / 255) * (viridis.length - 1), j = Math.min(Math.floor(x), viridis.length - 2);
    const channel = (n, c) => parseInt(viridis[n].slice(1 + 2 * c, 3 + 2 * c), 16);
    for (let c = 0; c < 3; ++c) bytes[4 * i + c] = Math.round(channel(j, c) * (1 - x + j) + channel(j + 1, c) * (x - j));
    bytes[4 * i + 3] = 255;
  }
  return bytes;
}

function fitCanvas(c) {
  const ratio = window.devicePixelRatio || 1, wide = Math.max(1, Math.round(c.clientWidth * ratio)), high = Math.max(1, Math.round(c.clientHeight * ratio));
  if (c.width !== wide || c.height !== high) { c.width = wide; c.height = high; }
  return ratio;
}

function drawMesh() {
  fitCanvas(canvas);
  pose();
  if (!card) return;
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(0, 0, 0, 0); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  const fill = (name, data) => { gl.bindBuffer(gl.ARRAY_BUFFER, card.buffers[name]); gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW); };
  fill("position", positions); fill("normal", normals); fill("error", levels.subarray(k * V, (k + 1) * V));
  const m = matrices(canvas.width / canvas.height), points = T === 0;
  gl.uniformMatrix4fv(card.all, false, m.all); gl.uniformMatrix4fv(card.model, false, m.model);
  gl.uniform1f(card.ball, (0.9 * canvas.height * radius) / Math.sqrt(V) * 2.2); gl.uniform1i(card.balls, points ? 1 : 0);
  gl.uniform1f(card.top, tops[frames[k]]); gl.uniform1f(card.low, range[0]); gl.uniform1f(card.high, range[1]);
  gl.uniform1f(card.bare, show === "error" ? 0 : 1);
  if (points) gl.drawArrays(gl.POINTS, 0, V);
  else gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0);
}

// The colour bar.
function roundStep(span, parts) {
  const wanted = span / parts, decade = 10 ** Math.floor(Math.log10(wanted));
  return decade * ([1, 2, 2.5, 5].find((s) => s * decade >= wanted * (1 - 1e-9)) || 10);
}
function drawLegend() {
  const ticks = $("ticks"), [a, b] = range, step = roundStep(b - a, 5);
  ticks.textContent = "";
  for (let x = Math.ceil(a / step - 1e-9) * step; x <= b + 1e-9 * step; x += step) {
    const tick = document.createElement("span");
    tick.style.bottom = `${(100 * (x - a)) / (b - a)}%`;
    tick.textContent = number(Math.abs(x) < 1e-9 * step ? 0 : x) + (x + step > b + 1e-9 * step && largest > b ? " +" : "");
    ticks.append(tick);
  }
  for (const [id, value] of [["low", a], ["high", b]]) if (document.activeElement !== $(id)) $(id).value = number(value);
}
function setRange(a, b) {
  if (!(Number.isFinite(a) && Number.isFinite(b) && b > a)) return;
  range = [a, b]; dirty = true; drawLegend();
}

// The curve under the mesh, and the time line in it.
const curve = $("curve");
const edge = { left: 8, right: 8, top: 8, bottom: 18 };
const timeShare = (f) => (F > 1 ? (times[f] - times[0]) / (times[F - 1] - times[0]) : 0.5);
function drawCurve() {
  const ratio = fitCanvas(curve), c = curve.getContext("2d"), style = getComputedStyle(document.documentElement);
  const colour = (name) => style.getPropertyValue(name).trim(), wide = curve.clientWidth, high = curve.clientHeight;
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.fillStyle = colour("--stage"); c.fillRect(0, 0, wide, high);
  const x = (f) => edge.left + timeShare(f) * (wide - edge.left - edge.right), base = high - edge.bottom;
  const y = (value) => base - (largest > 0 ? value / largest : 0) * (base - edge.top);
  c.beginPath(); c.moveTo(x(0), base);
  for (let f = 0; f < F; ++f) c.lineTo(x(f), y(tops[f]));
  c.lineTo(x(F - 1), base); c.fillStyle = colour("--area"); c.fill();
  for (const [values, name, dash] of [[tops, "--line", []], [means, "--soft", [3, 3]]]) {
    c.beginPath(); c.setLineDash(dash); c.strokeStyle = colour(name); c.lineWidth = 1.6;
    values.forEach((value, f) => c.lineTo(x(f), y(value)));
    c.stroke();
  }
  c.setLineDash([]); c.font = "11px system-ui, sans-serif"; c.fillStyle = colour("--soft"); c.textAlign = "center";
  const span = times[F - 1] - times[0];
  if (span > 0) {
    const step = roundStep(span, Math.max(2, wide / 110));
    for (let t = Math.ceil(times[0] / step) * step; t <= times[F - 1] + 1e-9; t += step)
      c.fillText(`${number(t)} s`, Math.min(wide - 14, Math.max(14, edge.left + ((t - times[0]) / span) * (wide - edge.left - edge.right))), high - 5);
  }
  const now = x(frames[k]);
  c.strokeStyle = colour("--mark"); c.fillStyle = colour("--mark"); c.lineWidth = 1.5;
  c.beginPath(); c.moveTo(now, 2); c.lineTo(now, base); c.stroke();
  c.beginPath(); c.arc(now, y(tops[frames[k]]), 4, 0, 7); c.fill();
}
function drawNow() {
  const f = frames[k];
  $("now").textContent = `frame ${f}, ${times[f].toFixed(2)} s\nlargest ${number(tops[f])}${unit}\nmean ${number(means[f])}${unit}`;
  curve.setAttribute("aria-valuenow", f); curve.setAttribute("aria-valuemax", F - 1); curve.setAttribute("aria-valuetext", $("now").textContent);
}

function go(place) { k = Math.min(K - 1, Math.max(0, place)); dirty = true; }
function setPlaying(on) {
  playing = on && K > 1; clock = performance.now() / 1000 - (times[frames[k]] - times[0]);
  if (playing && k === K - 1) { k = 0; clock = performance.now() / 1000; }
  $("play").textContent = playing ? "❚❚" : "▶";
}
function setShow(what) {
  show = what; dirty = true;
  for (const button of document.querySelectorAll("[data-show]")) button.setAttribute("aria-checked", String(button.dataset.show === what));
}
function setTheme(theme) { document.documentElement.dataset.theme = theme; dirty = true; }
const toggleTheme = () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
function reset() { Object.assign(view, structuredClone(first)); setRange(0, meta.top); }

function paint() { dirty = false; drawMesh(); drawCurve(); drawNow(); }
function tick() {
  if (playing) {
    const last = times[frames[K - 1]] - times[0], step = K > 1 ? last / (K - 1) : 0;
    let now = performance.now() / 1000 - clock;
    if (now > last + step) { clock += last + step; now = performance.now() / 1000 - clock; }
    let place = k;
    if (times[frames[place]] - times[0] > now) place = 0;
    while (place + 1 < K && times[frames[place + 1]] - times[0] <= now) ++place;
    if (place !== k) go(place);
  }
  if (dirty) paint();
  requestAnimationFrame(tick);
}

// Fingers, mouse, keys.
const fingers = new Map();
canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, e); $("tip").hidden = true; });
for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (e) => fingers.delete(e.pointerId));
canvas.addEventListener("pointermove", (e) => {
  const before = fingers.get(e.pointerId);
  if (!before) return point(e);
  const dx = e.clientX - before.clientX, dy = e.clientY - before.clientY, scale = (0.62 * view.distance) / canvas.clientHeight;
  if (fingers.size === 2) {
    const [a, b] = [...fingers.values()], apart = Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);
    fingers.set(e.pointerId, e);
    const [p, q] = [...fingers.values()], after = Math.hypot(p.clientX - q.clientX, p.clientY - q.clientY);
    if (after > 0) zoom(apart / after);
    view.pan[0] += (dx * scale) / 2; view.pan[1] -= (dy * scale) / 2;
  } else if (e.shiftKey || e.buttons & 6) {
    view.pan[0] += dx * scale; view.pan[1] -= dy * scale;
  } else {
    view.yaw += dx * 0.008; view.pitch = Math.min(1.55, Math.max(-1.55, view.pitch + dy * 0.008));
  }
  fingers.set(e.pointerId, e); dirty = true;
});
canvas.addEventListener("contextmenu", (e) => e.preventDefault());
canvas.addEventListener("pointerleave", () => ($("tip").hidden = true));
function zoom(factor) { view.distance = Math.min(12, Math.max(0.15, view.distance * factor)); dirty = true; }
canvas.addEventListener("wheel", (e) => { e.preventDefault(); zoom(Math.exp(e.deltaY * 0.001)); }, { passive: false });

// The vertex under the pointer: of those within a few pixels, the one in front.
function point(e) {
  const box = canvas.getBoundingClientRect(), { all } = matrices(canvas.width / canvas.height), tip = $("tip");
  const px = e.clientX - box.left, py = e.clientY - box.top;
  let best = -1, depth = Infinity;
  for (let v = 0; v < V; ++v) {
    const x = positions[3 * v], y = positions[3 * v + 1], z = positions[3 * v + 2], w = all[3] * x + all[7] * y + all[11] * z + all[15];
    const sx = (((all[0] * x + all[4] * y + all[8] * z + all[12]) / w) * 0.5 + 0.5) * box.width;
    const sy = (0.5 - ((all[1] * x + all[5] * y + all[9] * z + all[13]) / w) * 0.5) * box.height;
    if (w > 0 && w < depth && Math.abs(sx - px) < 7 && Math.abs(sy - py) < 7) { best = v; depth = w; }
  }
  tip.hidden = best < 0;
  if (best < 0) return;
  tip.textContent = `vertex ${best}: ${number((levels[k * V + best] / 255) * tops[frames[k]])}${unit}`;
  tip.style.left = `${Math.min(px + 14, box.width - 190)}px`; tip.style.top = `${Math.max(4, py - 34)}px`;
}

function scrub(e) {
  if (e.type === "pointermove" && !e.buttons) return;
  const box = curve.getBoundingClientRect(), share = (e.clientX - box.left - edge.left) / (box.width - edge.left - edge.right);
  const time = times[0] + share * (times[F - 1] - times[0]);
  setPlaying(false);
  let best = 0;
  for (let i = 1; i < K; ++i) if (Math.abs(times[frames[i]] - time) < Math.abs(times[frames[best]] - time)) best = i;
  go(best);
}
curve.addEventListener("pointerdown", (e) => { curve.setPointerCapture(e.pointerId); scrub(e); });
curve.addEventListener("pointermove", scrub);

const keys = {
  " ": () => setPlaying(!playing), ArrowLeft: () => go(k - 1), ArrowRight: () => go(k + 1), Home: () => go(0), End: () => go(K - 1),
  w: () => go(nearest(worst)), 1: () => setShow("error"), 2: () => has("distorted") && setShow("distorted"), 3: () => has("original") && setShow("original"),
  "+": () => zoom(1 / 1.15), "=": () => zoom(1 / 1.15), "-": () => zoom(1.15), "[": () => setRange(range[0], range[1] / 1.25),
  "]": () => setRange(range[0], range[1] * 1.25), r: reset, d: toggleTheme, "?": () => ($("keys").hidden = !$("keys").hidden),
};
addEventListener("keydown", (e) => {
  if (e.target.tagName === "INPUT" || e.ctrlKey || e.metaKey || e.altKey) return;
  if (e.key === " " && e.target.tagName === "BUTTON") return;
  const act = keys[e.key.length === 1 ? e.key.toLowerCase() : e.key];
  if (!act) return;
  e.preventDefault();
  if (e.key.startsWith("Arrow") || e.key === "Home" || e.key === "End") setPlaying(false);
  act();
});

// Words, and the start.
const has = (what) => other !== null || (what === "distorted") === meta.onDistorted;
for (const button of document.querySelectorAll("[data-show]")) {
  button.setAttribute("role", "radio");
  if (button.dataset.show !== "error" && !has(button.dataset.show)) button.hidden = true;
  button.addEventListener("click", () => setShow(button.dataset.show));
}
$("play").addEventListener("click", () => setPlaying(!playing));
$("theme").addEventListener("click", toggleTheme);
$("help").addEventListener("click", keys["?"]);
$("fit-all").addEventListener("click", () => setRange(0, meta.top));
$("fit-one").addEventListener("click", () => setRange(0, tops[frames[k]] || meta.top));
for (const id of ["low", "high"]) $(id).addEventListener("change", () => { setRange(Number($("low").value), Number($("high").value)); drawLegend(); });
$("title").textContent = meta.title;
$("subtitle").textContent = `${meta.distorted} against ${meta.original}`;
$("unit").textContent = meta.unit || "no unit";
$("note").textContent = meta.note;
$("ramp").getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(256 * 4).map((_, i) => ramp()[4 * (255 - (i >> 2)) + (i & 3)]), 1, 256), 0, 0);
const wanted = new URLSearchParams(location.hash.slice(1)); // #theme=dark&frame=12&show=original
setTheme(wanted.get("theme") || (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", (e) => setTheme(e.matches ? "dark" : "light"));
if (wanted.has("frame")) k = nearest(Number(wanted.get("frame")) || 0);
setShow(wanted.has("show") && has(wanted.get("show")) ? wanted.get("show") : "error");
new ResizeObserver(paint).observe($("stage")); // at once: what is stretched is never seen
drawLegend();
tick();
