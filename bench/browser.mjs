#!/usr/bin/env node
/// Frame time, memory on the card, and time to the first picture, beside what else plays meshes in three.js: bench/browser.mjs [FOLDER of
/// dance: mesh.obj, motion.pc2] > docs/browser-speed.md's tables. Generated where there is no such folder.
// SPDX-License-Identifier: MIT
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, statSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';

import { browse, command, serve } from '../js/test/page.mjs';

const root = new URL('../', import.meta.url).pathname, folder = `${root}build-wasm/browser`, require = createRequire(`${root}js/package.json`);
mkdirSync(folder, { recursive: true });
const file = (name) => `${folder}/${name}`, run = (...words) => execFileSync(command, [...words, '-q', '-y'], { stdio: 'inherit' });
const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

function prepare(data) {
  let mesh = file('walker.obj'), motion = file('walker.pc2');
  if (data && existsSync(`${data}/motion.pc2`)) [mesh, motion] = [`${data}/mesh.obj`, `${data}/motion.pc2`];
  else run('generate', 'walker', motion, '--mesh', mesh, '--vertices', '7000', '--frames', '200');
  run('encode', motion, '--mesh', mesh, '--fps', '25', file('it.reel'));
  run('decode', file('it.reel'), file('it.glb'));
  run('decode', file('it.reel'), file('it.pc2'), '--mesh-out', file('it.obj'));
  return data ? 'dance' : 'walker, generated';
}

async function pack() {
  const { pack: gltfpack } = await import(`${root}lab/peers/node_modules/gltfpack/library.js`);
  let packed = null;
  await gltfpack(['-i', 'it.glb', '-o', 'packed.glb', '-cc'], { read: () => readFileSync(file('it.glb')), write: (_, bytes) => (packed = bytes) });
  writeFileSync(file('packed.glb'), packed);
}

/// The first frame as positions, the others' distances from it as attributes of up to 40 frames, 12 bits a coordinate: draco decodes
/// no more than a few attributes.
async function draco() {
  const module = await require('draco3d').createEncoderModule({});
  const pc2 = readFileSync(file('it.pc2')), view = new DataView(pc2.buffer, pc2.byteOffset), V = view.getUint32(16, true), F = view.getUint32(28, true);
  const triangles = readFileSync(file('it.obj'), 'utf8').split('\n').filter((line) => line.startsWith('f ')).flatMap((line) => line.slice(2).trim().split(/\s+/).map((word) => parseInt(word) - 1));
  const builder = new module.MeshBuilder(), mesh = new module.Mesh(), encoder = new module.Encoder(), out = new module.DracoInt8Array();
  builder.AddFacesToMesh(mesh, triangles.length / 3, Uint32Array.from(triangles));
  const frame = (f) => new Float32Array(pc2.buffer.slice(pc2.byteOffset + 32 + 12 * V * f, pc2.byteOffset + 32 + 12 * V * (f + 1)));
  const first = frame(0);
  builder.AddFloatAttributeToMesh(mesh, module.POSITION, V, 3, first);
  for (let f = 1; f < F; f += 40) {
    const some = Array.from({ length: Math.min(40, F - f) }, (_, i) => frame(f + i)), n = 3 * some.length, values = new Float32Array(n * V);
    some.forEach((each, i) => each.forEach((x, at) => (values[Math.floor(at / 3) * n + 3 * i + (at % 3)] = x - first[at])));
    builder.AddFloatAttributeToMesh(mesh, module.GENERIC, V, n, values);
  }
  encoder.SetAttributeQuantization(module.POSITION, 12);
  encoder.SetAttributeQuantization(module.GENERIC, 12);
  const size = encoder.EncodeMeshToDracoBuffer(mesh, out);
  writeFileSync(file('it.drc'), Int8Array.from({ length: size }, (_, i) => out.GetValue(i)));
}

async function newPage(browser, server) {
  const page = await browser.newPage();
  page.on('pageerror', (error) => console.error(error.message));
  await page.goto(`${server.address}/bench.html`);
  await page.evaluate(async () => (window.bench = await import('/bench/browser_page.js')));
  return page;
}

const name = prepare(process.argv[2]);
await pack();
await draco();
const server = await serve(), browser = await browse(), rounds = Number(process.env.ROUNDS ?? 7);
const page = await newPage(browser, server), times = await page.evaluate(([path, n]) => bench.frameTimes(path, n, 9), ['/build-wasm/browser/it.reel', rounds]);
await page.close();
console.log(`${name}; Chromium ${browser.version()}, ${rounds} rounds in turn, medians\n\n| | frames | on the card | a picture, ms |\n|---|---|---|---|`);
for (const [way, { ms, bytes, frames }] of Object.entries(times)) console.log(`| ${way} | ${frames} | ${(bytes / 1e6).toFixed(1)} MB | ${median(ms).toFixed(1)} |`);
const files = { reel: 'it.reel', coarse: 'it.reel', gltfpack: 'packed.glb', draco: 'it.drc' }, opened = Object.fromEntries(Object.keys(files).map((way) => [way, []]));
for (let r = 0; r < rounds; ++r)
  for (const [way, path] of Object.entries(files)) {
    const fresh = await newPage(browser, server);
    opened[way].push(await fresh.evaluate((words) => bench.firstPicture(...words), [way, `/build-wasm/browser/${path}`]));
    await fresh.close();
  }
console.log('\n| | file, bytes | first picture, ms |\n|---|---|---|');
for (const [way, ms] of Object.entries(opened)) console.log(`| ${way} | ${statSync(file(files[way])).size} | ${median(ms).toFixed(0)} |`);
await browser.close();
server.close();
