/// differential.mjs PROGRAM FOLDER: the decoder in WebAssembly beside the library's, of all files of a folder: what the fuzzer found.
// SPDX-License-Identifier: MIT
//
// PROGRAM is the library's golden_files (tools/foreign). Both must refuse the same files, and read the others to the same bits.
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

import { Decoder, ReelError } from '../src/decoder.js';

const [program, folder] = process.argv.slice(2);
const module = await WebAssembly.compile(readFileSync(new URL('../../build-wasm/meshreel-all.wasm', import.meta.url)));
const files = readdirSync(folder).map((name) => join(folder, name));
const lines = execFileSync(program, files, { encoding: 'latin1', maxBuffer: 2 ** 30 }).split('\n');

/// What the library tells of a file, as far as both do; an Error where it is refused.
async function meaningOf(bytes) {
  const decoder = await Decoder.create(module, { coarseLevel: 1 }), parts = [];
  const hex = (values) => decoder.hash(values).toString(16).padStart(16, '0');
  let head;
  try {
    decoder.push(bytes);
    for (const event of decoder.take(true)) {
      head = event.head ?? head;
      if (event.type === 'segment') parts.push(Buffer.from(decoder.frames().buffer));
    }
  } catch (error) {
    return error;
  }
  return { triangles: hex(head.surface.triangles), positions: hex(Buffer.concat(parts)), times: hex(head.times) };
}

/// Both refuse it, this one in an error of its own and not by a trap; or both have the same.
function agree(line, found) {
  if (found instanceof Error) return line.startsWith('refused') && found instanceof ReelError && found.code !== 4;
  if (line.startsWith('refused')) return false;
  const expected = JSON.parse(line);
  return Object.entries(found).every(([key, value]) => expected[key] === value);
}

let refused = 0, different = 0;
for (const [i, file] of files.entries()) {
  const found = await meaningOf(readFileSync(file));
  refused += found instanceof Error;
  if (agree(lines[i], found)) continue;
  ++different;
  console.log(`${file}:\n  ${lines[i].slice(0, 300)}\n  ${found.message ?? JSON.stringify(found)}`);
}
console.log(`${files.length} files, ${refused} refused by WebAssembly, ${different} read differently`);
process.exit(files.length > 0 && different === 0 ? 0 : 1);
