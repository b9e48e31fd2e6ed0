#!/usr/bin/env node
/// The decoder for JavaScript: its bytes beside draco3d's and meshoptimizer's, and how long it takes to open files:
/// bench/wasm.mjs [FILE.reel...] (after make wasm and tools/install.sh --with-wasm).
// SPDX-License-Identifier: MIT
import { execFileSync } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';

import { Decoder } from '../js/src/decoder.js';

const at = (path) => new URL(`../${path}`, import.meta.url);
const gzipped = (bytes) => execFileSync('gzip', ['-9c'], { input: bytes }).length; // which node:zlib is not: 1 % more
const brotli = (bytes) => brotliCompressSync(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } }).length;
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

/// What a page loads to decode: files together.
const sets = [
  ['meshreel, decoder and worker', ['js/dist/meshreel.wasm', 'js/dist/worker.js']],
  ['meshreel, every codec, and worker', ['js/dist/meshreel-all.wasm', 'js/dist/worker.js']],
  ['draco3d, decoder', ['js/node_modules/draco3d/draco_decoder.wasm', 'js/node_modules/draco3d/draco_decoder_nodejs.js']],
  ['meshoptimizer, decoder', ['js/node_modules/meshoptimizer/meshopt_decoder.mjs']],
];

console.log('| | bytes | gzip -9 | brotli -11 |\n|---|---|---|---|');
for (const [title, paths] of sets) {
  if (!paths.every((path) => existsSync(at(path)))) {
    console.log(`| ${title} | not installed | | |`);
    continue;
  }
  const files = paths.map((path) => readFileSync(at(path)));
  const sum = (size) => files.reduce((all, bytes) => all + size(bytes), 0);
  console.log(`| ${title} | ${sum((bytes) => bytes.length)} | ${sum(gzipped)} | ${sum(brotli)} |`);
}

/// Milliseconds of processor time from bytes to coefficients and basis, all of the file verified.
async function opened(module, bytes) {
  const decoder = await Decoder.create(module);
  const start = process.cpuUsage();
  decoder.push(bytes);
  for (const event of decoder.take(true)) if (event.type === 'done') break;
  decoder.close();
  return process.cpuUsage(start).user / 1000;
}

/// The same of the command, one thread, with its start and the writing of one frame.
function openedNatively(file) {
  const command = at('build/meshreel');
  if (!existsSync(command)) return NaN;
  const out = join(tmpdir(), 'meshreel-bench.ply');
  const line = 'TIMEFORMAT=%U; time "$0" decode "$1" "$2" --frames 0:0 --threads 1 --yes > /dev/null 2> /dev/null';
  return 1000 * parseFloat(execFileSync('bash', ['-c', `{ ${line}; } 2>&1`, command.pathname, file, out]).toString());
}

const files = process.argv.slice(2);
if (files.length > 0) {
  const module = await WebAssembly.compile(readFileSync(at('js/dist/meshreel-all.wasm')));
  console.log('\n| file | bytes | opened in WebAssembly, ms | natively, ms |\n|---|---|---|---|');
  for (const file of files) {
    const bytes = readFileSync(file);
    const times = [], native = [];
    for (let i = 0; i < 5; ++i) {
      times.push(await opened(module, bytes));
      native.push(openedNatively(file));
    }
    console.log(`| ${basename(file)} | ${bytes.length} | ${median(times).toFixed(0)} | ${median(native).toFixed(0)} |`);
  }
}
