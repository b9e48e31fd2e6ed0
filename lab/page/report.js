/// The chart of a lab report: curves by sequence, any measure on either axis, by mouse, touch or keyboard.
// SPDX-License-Identifier: MIT
"use strict";
const facts = JSON.parse(document.getElementById("facts").textContent);
const at = (id) => document.getElementById(id);
const chart = at("chart"), told = at("told"), legend = at("legend");
const margin = { left: 64, right: 18, top: 16, bottom: 54 };
const hidden = new Set();
let shown = [];    // curves of the chart as drawn: { coding, index, points: [{ row, x, y }] }
let cursor = null; // { curve, point }: numbers into shown

const SVG = "http://www.w3.org/2000/svg";
function make(name, attributes = {}, text = "") {
  const node = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text) node.textContent = text;
  return node;
}

/// A number with four digits that matter, without the zeros that do not.
function number(value) {
  if (value === 0 || !Number.isFinite(value)) return String(value);
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-4) return value.toExponential(2);
  return size >= 1000 ? value.toLocaleString("en", { maximumFractionDigits: 0 }) : String(Number(value.toPrecision(4)));
}

const axisOf = (key) => facts.axes.find((axis) => axis.key === key);
const titleOf = (axis) => axis.unit ? `${axis.title}, ${axis.unit}` : axis.title;
const state = () => ({ sequence: at("sequence").value, x: at("x").value, y: at("y").value, xlog: at("xlog").checked, ylog: at("ylog").checked });

/// Round numbers between two values: 1, 2 and 5 of each decade where the axis is logarithmic.
function ticks(low, high, log) {
  const found = [];
  if (log) {
    for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); ++decade)
      for (const digit of high / low > 2e4 ? [1] : [1, 2, 5]) found.push(digit * 10 ** decade);
    const inside = found.filter((value) => value >= low * 0.999 && value <= high * 1.001);
    if (inside.length > 1) return inside;
  }
  const rough = (high - low) / 6, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((digit) => digit * power >= rough);
  const linear = [];
  for (let value = Math.ceil(low / step) * step; value <= high * (1 + 1e-9); value += step) linear.push(Number(value.toPrecision(12)));
  return linear;
}

/// From values to pixels, with a little room at both ends.
function scale(values, from, to, log) {
  let low = Math.min(...values), high = Math.max(...values);
  if (low === high) { low *= 0.8; high = high * 1.25 || 1; }
  if (log) { const room = (high / low) ** 0.04; low /= room; high *= room; } else { low = Math.min(0, low); high *= 1.04; }
  const place = log ? Math.log : (value) => value;
  const map = (value) => from + (to - from) * (place(value) - place(low)) / (place(high) - place(low));
  return { map, ticks: ticks(low, high, log) };
}

/// The curves of a sequence: points that can be drawn (a logarithm needs more than 0), in the order of their rates.
function curvesOf({ sequence, x, y, xlog, ylog }) {
  const usable = (row, key, log) => Number.isFinite(row[key]) && (!log || row[key] > 0);
  return facts.codings.map((coding, index) => ({
    coding, index,
    points: facts.rows.filter((row) => row.sequence === sequence && row.coding === coding.name && usable(row, x, xlog) && usable(row, y, ylog))
      .sort((a, b) => a.bpfv - b.bpfv).map((row) => ({ row })),
  }));
}

function drawAxes(svg, axes, width, height, now) {
  const bottom = height - margin.bottom, right = width - margin.right;
  let last = -Infinity;
  for (const value of axes.x.ticks) {
    const x = axes.x.map(value);
    svg.append(make("line", { class: "grid", x1: x, x2: x, y1: margin.top, y2: bottom }));
    if (x - last < 42) continue;
    last = x;
    svg.append(make("text", { class: "axis", x, y: bottom + 18, "text-anchor": "middle" }, number(value)));
  }
  last = Infinity;
  for (const value of axes.y.ticks) {
    const y = axes.y.map(value);
    svg.append(make("line", { class: "grid", x1: margin.left, x2: right, y1: y, y2: y }));
    if (last - y < 16) continue;
    last = y;
    svg.append(make("text", { class: "axis", x: margin.left - 8, y: y + 4, "text-anchor": "end" }, number(value)));
  }
  svg.append(make("rect", { class: "frame", x: margin.left, y: margin.top, width: right - margin.left, height: bottom - margin.top }));
  svg.append(make("text", { class: "axis name", x: (margin.left + right) / 2, y: height - 12, "text-anchor": "middle" }, titleOf(axisOf(now.x))));
  svg.append(make("text", { class: "axis name", transform: `translate(15 ${(margin.top + bottom) / 2}) rotate(-90)`, "text-anchor": "middle" }, titleOf(axisOf(now.y))));
}

const colour = (index) => `var(--c${index % 16})`;
const corners = [0, 4, 3]; // a disc, a square, a triangle: colours come again after sixteen, and not all eyes tell them apart
function mark(index, x, y, size) {
  const style = `fill: ${colour(index)}`, sides = corners[index % 3];
  if (sides === 0) return make("circle", { cx: x, cy: y, r: size, style });
  const turn = sides === 4 ? Math.PI / 4 : -Math.PI / 2;
  const points = Array.from({ length: sides }, (_, i) => turn + 2 * Math.PI * i / sides).map((a) => `${x + 1.3 * size * Math.cos(a)},${y + 1.3 * size * Math.sin(a)}`);
  return make("polygon", { points: points.join(" "), style });
}

function drawCurve(svg, curve, dim) {
  const group = make("g", dim ? { class: "dim" } : {});
  const path = curve.points.map(({ x, y }, i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
  group.append(make("path", { class: curve.coding.peer ? "curve peer" : "curve", d: path, style: `stroke: ${colour(curve.index)}` }));
  for (const { x, y } of curve.points) group.append(mark(curve.index, x, y, 3.6));
  svg.append(group);
}

function draw() {
  const now = state(), width = chart.clientWidth || 700, height = Math.round(Math.min(560, Math.max(340, width * 0.56)));
  const all = curvesOf(now);
  shown = all.filter((curve) => !hidden.has(curve.coding.name) && curve.points.length);
  chart.replaceChildren();
  const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, height, "aria-hidden": "true" });
  chart.append(svg);
  const points = shown.flatMap((curve) => curve.points);
  if (!points.length) {
    svg.append(make("text", { class: "axis name", x: width / 2, y: height / 2, "text-anchor": "middle" }, "Nothing is chosen that can be drawn here"));
  } else {
    const axes = {
      x: scale(points.map(({ row }) => row[now.x]), margin.left, width - margin.right, now.xlog),
      y: scale(points.map(({ row }) => row[now.y]), height - margin.bottom, margin.top, now.ylog),
    };
    for (const point of points) { point.x = axes.x.map(point.row[now.x]); point.y = axes.y.map(point.row[now.y]); }
    drawAxes(svg, axes, width, height, now);
    shown.forEach((curve, i) => drawCurve(svg, curve, cursor && cursor.curve !== i));
  }
  drawLegend(all);
  history.replaceState(null, "", "#" + new URLSearchParams({ ...now, hidden: [...hidden].join("|") }));
}

/// bits per frame and vertex: bpfv; % of the body diagonal: %; M vertices a processor second: M/s.
const shortUnit = (unit) => unit.startsWith("bits") ? "bpfv" : unit.startsWith("%") ? "%" : unit.startsWith("M ") ? "M/s" : unit;

function tip(curve, point) {
  const box = document.createElement("div"), table = document.createElement("table"), name = document.createElement("b");
  box.className = "tip";
  name.textContent = point.row.setting ? `${curve.coding.name}: ${point.row.setting}` : curve.coding.name;
  for (const axis of facts.axes) {
    const line = table.insertRow();
    line.insertCell().textContent = axis.title;
    line.insertCell().textContent = `${number(point.row[axis.key])} ${shortUnit(axis.unit ?? "")}`;
  }
  box.append(name, table);
  chart.append(box);
  place(box, point);
}

/// Beside the point, where there is room, else above or below it.
function place(box, { x, y }) {
  const { offsetWidth: width, offsetHeight: height } = box, gap = 14;
  const right = x + gap + width <= chart.clientWidth, left = x - gap - width >= 0;
  const across = right ? x + gap : left ? x - gap - width : x - width / 2;
  const down = right || left ? y - height / 2 : y - gap - height >= 0 ? y - gap - height : y + gap;
  box.style.left = `${Math.max(4, Math.min(across, chart.clientWidth - width - 4))}px`;
  box.style.top = right || left ? `${Math.max(4, Math.min(down, chart.clientHeight - height - 4))}px` : `${down}px`;
}

/// Puts the cursor on a point, or takes it away.
function point(curve, index) {
  const same = cursor && curve !== null && cursor.curve === curve && cursor.point === index;
  if (same || (cursor === null && curve === null)) return;
  cursor = curve === null ? null : { curve, point: index };
  draw();
  if (!cursor) { told.textContent = ""; return; }
  const on = shown[curve].points[index];
  chart.querySelector("svg").append(make("circle", { class: "cursor", cx: on.x, cy: on.y, r: 6, style: `stroke: ${colour(shown[curve].index)}` }));
  tip(shown[curve], on);
  const { x, y } = state();
  told.textContent = `${shown[curve].coding.name}, ${on.row.setting}: ${axisOf(x).title} ${number(on.row[x])}, ${axisOf(y).title} ${number(on.row[y])}`;
}

function nearest(event, reach) {
  const frame = chart.getBoundingClientRect();
  let best = { distance: reach, curve: null, point: null };
  shown.forEach((curve, i) => curve.points.forEach(({ x, y }, j) => {
    const distance = Math.hypot(event.clientX - frame.left - x, event.clientY - frame.top - y);
    if (distance < best.distance) best = { distance, curve: i, point: j };
  }));
  point(best.curve, best.point);
}

function key(event) {
  const steps = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };
  if (event.key === "Escape") return point(null, null);
  if (!steps[event.key] || !shown.length) return undefined;
  event.preventDefault();
  if (!cursor) return point(0, 0);
  const [across, along] = steps[event.key];
  const curve = (cursor.curve + across + shown.length) % shown.length;
  const last = shown[curve].points.length - 1;
  return point(curve, Math.max(0, Math.min(last, cursor.point + along)));
}

function toggle(names) {
  const hide = names.some((name) => !hidden.has(name));
  for (const name of names) if (hide) hidden.add(name); else hidden.delete(name);
  cursor = null;
  draw();
}

function drawLegend(all) {
  const focused = document.activeElement && document.activeElement.dataset ? document.activeElement.dataset.name : undefined;
  const button = (name, names, pressed, enabled) => {
    const node = document.createElement("button");
    node.type = "button";
    node.dataset.name = name;
    node.disabled = !enabled;
    node.setAttribute("aria-pressed", String(pressed));
    node.addEventListener("click", () => toggle(names));
    node.append(name);
    legend.append(node);
    return node;
  };
  legend.replaceChildren();
  for (const { coding, index, points } of all) {
    const node = button(coding.name, [coding.name], !hidden.has(coding.name), points.length > 0);
    node.title = coding.counts;
    const sample = make("svg", { width: 28, height: 12, "aria-hidden": "true" });
    sample.append(make("path", { class: coding.peer ? "curve peer" : "curve", d: "M0 6H28", style: `stroke: ${colour(index)}` }), mark(index, 14, 6, 3.6));
    node.prepend(sample);
  }
  const peers = facts.codings.filter((coding) => coding.peer).map((coding) => coding.name);
  for (const [name, names] of [["all", facts.codings.map((coding) => coding.name)], ["peers", peers]])
    if (names.length > 1) button(name, names, names.some((n) => !hidden.has(n)), true).classList.add("all");
  if (focused) [...legend.children].find((node) => node.dataset.name === focused)?.focus();
}

function start() {
  const fill = (id, options) => at(id).replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  fill("sequence", facts.sequences.map((name) => [name, name]));
  for (const id of ["x", "y"]) fill(id, facts.axes.map((axis) => [axis.key, titleOf(axis)]));
  const asked = new URLSearchParams(location.hash.slice(1));
  const begin = { sequence: facts.sequences[0], x: "bpfv", y: facts.measures[0] };
  for (const [id, value] of Object.entries(begin)) {
    at(id).value = asked.get(id) ?? value;
    if (!at(id).value) at(id).value = value;
  }
  for (const id of ["xlog", "ylog"]) at(id).checked = asked.get(id) !== "false";
  for (const name of (asked.get("hidden") ?? "").split("|")) if (facts.codings.some((coding) => coding.name === name)) hidden.add(name);
  for (const id of ["sequence", "x", "y", "xlog", "ylog"]) at(id).addEventListener("change", () => { cursor = null; draw(); });
  chart.addEventListener("pointermove", (event) => nearest(event, 40));
  chart.addEventListener("pointerdown", (event) => nearest(event, 60));
  chart.addEventListener("pointerleave", (event) => { if (event.pointerType === "mouse") point(null, null); });
  chart.addEventListener("keydown", key);
  chart.addEventListener("blur", () => point(null, null));
  let width = chart.clientWidth;
  new ResizeObserver(() => {
    if (chart.clientWidth === width) return;
    const kept = cursor;
    width = chart.clientWidth;
    cursor = null;
    draw();
    if (kept) point(kept.curve, kept.point);
  }).observe(chart);
  draw();
}
start();
