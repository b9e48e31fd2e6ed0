/// In a browser, out of a worker, the decoder gives the golden files' numbers bit for bit; nothing is evaluated.
// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { after, before, test } from 'node:test';

import { browse, missing, serve } from './page.mjs';

const folder = new URL('../../tests/golden/', import.meta.url);
const meanings = Object.fromEntries(readdirSync(folder).filter((name) => name.endsWith('.json'))
  .map((name) => [name.slice(0, -5), JSON.parse(readFileSync(new URL(name, folder)))])
  .filter(([, meaning]) => meaning.order !== 'base'));

let server, browser, page;
const skip = missing || false;
before(async () => {
  if (skip) return;
  server = await serve();
  browser = await browse();
  page = await browser.newPage();
  page.on('console', (message) => message.type() === 'error' && console.error(message.text()));
  await page.goto(`${server.address}/empty.html`);
});
after(async () => {
  await browser?.close();
  server?.close();
});

/// In the page: hashes of positions and triangles of files, decoded by a module's decodeReel.
async function hashes([module, names, options]) {
  const { decodeReel, decoderModule } = await import(module);
  const { Decoder } = await import('/js/src/decoder.js');
  const hasher = await Decoder.create(await decoderModule(true));
  const hex = (values) => hasher.hash(values).toString(16).padStart(16, '0');
  const found = {};
  for (const name of names) {
    const frames = [];
    let triangles = null;
    for await (const event of decodeReel(`/tests/golden/${name}.reel`, { all: true, frames: true, ...options })) {
      if (event.head) triangles = hex(event.head.surface.triangles);
      if (event.type === 'segment') frames.push(event.piece.frames);
    }
    const all = new Float32Array(frames.reduce((sum, part) => sum + part.length, 0));
    frames.reduce((at, part) => (all.set(part, at), at + part.length), 0);
    found[name] = { positions: hex(all), triangles };
  }
  return found;
}

const golden = (names) => Object.fromEntries(names.map((name) =>
  [name, { positions: meanings[name].positions, triangles: meanings[name].triangles }]));

test('every golden file out of a worker, bit for bit', { skip }, async () => {
  const names = Object.keys(meanings);
  assert.ok(names.length > 20);
  assert.deepEqual(await page.evaluate(hashes, ['/js/src/decode.js', names, {}]), golden(names));
});

test('the decoder that a page carries gives the same, in its worker and without one', { skip }, async () => {
  const names = Object.keys(meanings).filter((name) => name.startsWith('reel_')).slice(0, 4);
  for (const worker of [true, false])
    assert.deepEqual(await page.evaluate(hashes, ['/js/dist/inline-all.js', names, { worker }]), golden(names));
});

test('the page forbids eval, and was not asked for it', { skip }, async () => {
  await assert.rejects(page.evaluate(() => import('/js/src/decode.js').then(() => new Function('return 1')())), /eval|Content Security/);
});

test('a broken and a truncated file say what is wrong; a missing one too', { skip }, async () => {
  const bytes = [...readFileSync(new URL('reel_v1_range.reel', folder))];
  const message = (kind) => page.evaluate(async ([values, what]) => {
    const { decodeReel } = await import('/js/src/decode.js');
    const file = Uint8Array.from(values);
    if (what === 'broken') file[file.length >> 1] ^= 4;
    const source = what === 'missing' ? '/no/such.reel' : file.slice(0, what === 'truncated' ? file.length >> 1 : file.length);
    try {
      for await (const event of decodeReel(source)) if (event.type === 'done') return 'done';
    } catch (error) {
      return `${error.name} ${error.code}: ${error.message}`;
    }
    return 'nothing';
  }, [bytes, kind]);
  assert.match(await message('whole'), /^done$/);
  assert.match(await message('broken'), /^ReelError 3: byte \d+: SEGM.checksum: .*damaged/);
  assert.match(await message('truncated'), /^ReelError 3: byte \d+: .+/);
  assert.match(await message('missing'), /^ReelError 2: .*404/);
});

test('decoding can be given up', { skip }, async () => {
  const name = await page.evaluate(async () => {
    const { decodeReel } = await import('/js/src/decode.js');
    const abort = new AbortController();
    try {
      for await (const event of decodeReel('/tests/golden/reel_v1_range.reel', { signal: abort.signal }))
        if (event.type === 'head') abort.abort();
    } catch (error) {
      return error.name;
    }
    return 'not given up';
  });
  assert.equal(name, 'AbortError');
});
