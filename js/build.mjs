/// Makes js/dist from build-wasm: the decoder, classic workers, and decoder and worker within one module.
// SPDX-License-Identifier: MIT
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';

import { build } from 'esbuild';

const here = new URL('./', import.meta.url);
const read = (name) => readFileSync(new URL(name, here));
const write = (name, bytes) => writeFileSync(new URL(`dist/${name}`, here), bytes);

/// A module and what it imports as one script.
async function script(name) {
  const { outputFiles } = await build({ entryPoints: [new URL(`src/${name}`, here).pathname], bundle: true, minify: true, format: 'iife', target: 'es2022', write: false });
  return outputFiles[0].text;
}

mkdirSync(new URL('dist/', here), { recursive: true });
const worker = await script('clip_worker.js');
write('clip-worker.js', worker);
write('worker.js', await script('decode_worker.js'));
for (const name of ['meshreel', 'meshreel-all']) write(`${name}.wasm`, read(`../build-wasm/${name}.wasm`));
const carried = (name) => JSON.stringify(read(`../build-wasm/${name}.wasm`).toString('base64'));
for (const [name, wasm] of [['inline', 'meshreel'], ['inline-all', 'meshreel-all']])
  write(`${name}.js`, `/// The decoder and its worker, carried along: nothing is fetched. Made by js/build.mjs.
// SPDX-License-Identifier: MIT
import { carry } from '../src/inline.js';
carry(${carried(wasm)},
${JSON.stringify(worker)});
export * from '../src/decode.js';
`);
