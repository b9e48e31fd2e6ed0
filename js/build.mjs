/// Makes js/dist from build-wasm: the decoder, a classic worker, and both within one module.
// SPDX-License-Identifier: MIT
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';

const here = new URL('./', import.meta.url);
const read = (name) => readFileSync(new URL(name, here));
const write = (name, bytes) => writeFileSync(new URL(`dist/${name}`, here), bytes);

/// Modules one after the other as one script: no imports, no exports, no line that says nothing.
function script(names) {
  const lines = names.flatMap((name) => read(`src/${name}`).toString().split('\n'))
    .filter((line) => !/^\s*\/\//.test(line) && !/^import .*;$/.test(line) && line.trim() !== '')
    .map((line) => line.replace(/^export /, ''));
  return `(() => {\n'use strict';\n${lines.join('\n')}\n})();\n`;
}

mkdirSync(new URL('dist/', here), { recursive: true });
const worker = script(['decoder.js', 'job.js', 'worker.js']);
write('worker.js', worker);
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
