/// The decoder in WebAssembly gives the golden files' numbers bit for bit, whole or byte by byte, and refuses broken ones.
// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';

import { Decoder, ReelError } from '../src/decoder.js';

const root = new URL('../../', import.meta.url);
const compiled = (name) => WebAssembly.compile(readFileSync(new URL(`build-wasm/${name}.wasm`, root)));
const modules = { reel: await compiled('meshreel'), all: await compiled('meshreel-all') };
const folder = new URL('tests/golden/', root);
const names = readdirSync(folder).filter((name) => name.endsWith('.reel')).map((name) => name.slice(0, -5));
const bytesOf = (name) => readFileSync(new URL(`${name}.reel`, folder));
const meaningOf = (name) => JSON.parse(readFileSync(new URL(`${name}.json`, folder)));

/// The base mesh of files that need one: any golden file of the same triangles has it.
async function baseOf(meaning) {
  if (meaning.order !== 'base') return null;
  for (const name of names) {
    const other = meaningOf(name);
    if (other.order === 'base' || other.triangles !== meaning.triangles) continue;
    const { head } = await decoded(bytesOf(name), modules.all);
    return { vertexCount: head.vertexCount, triangles: head.surface.triangles };
  }
  throw new Error('no golden file has that base');
}

/// All that a file holds; slice: bytes that come at once.
async function decoded(bytes, module, { slice = bytes.length, ...options } = {}) {
  const decoder = await Decoder.create(module, options);
  const hex = (values) => (values === null ? null : decoder.hash(values).toString(16).padStart(16, '0'));
  const found = { head: null, level: null, frames: [], events: [], hex };
  const take = (complete) => {
    for (const event of decoder.take(complete)) {
      found.events.push(event.type);
      if (event.head) found.head = event.head;
      if (event.type === 'level') found.level = { piece: event.piece, frames: decoder.frames() };
      if (event.type === 'segment') found.frames.push(decoder.frames());
    }
  };
  for (let at = 0; at < bytes.length; at += slice) {
    decoder.push(bytes.subarray(at, at + slice));
    if (slice < bytes.length) take(false);
  }
  take(true);
  return found;
}

function joined(parts) {
  const all = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

function expectMeaning(found, meaning) {
  const { head, hex } = found;
  assert.equal(head.codec, meaning.codec);
  assert.equal(head.order, meaning.order);
  assert.equal(head.vertexCount, meaning.vertices);
  assert.equal(head.codedVertexCount, meaning.coded_vertices);
  assert.equal(head.triangleCount, meaning.triangle_count);
  assert.equal(head.frameCount, meaning.frames);
  assert.equal(hex(head.surface.triangles), meaning.triangles, 'triangles');
  assert.equal(hex(joined(found.frames)), meaning.positions, 'positions');
  assert.equal(hex(head.times), meaning.times, 'times');
  assert.deepEqual(head.materials, meaning.materials);
  assert.deepEqual(head.groups, meaning.groups);
  assert.equal(head.name, meaning.meta.name);
  assert.equal(head.loop, meaning.meta.loop);
  assert.equal(head.fps, meaning.meta.fps);
  assert.deepEqual(head.surface.attributes.map((a) => [a.name, a.domain, a.components, a.normalized, hex(a.values), hex(a.indices)]),
    meaning.attributes.map((a) => [a.name, a.domain, a.components, a.normalized, a.values, a.indices]));
  assert.equal(head.assets.length, meaning.assets.length);
}

for (const name of names) {
  test(`${name} decodes to its golden numbers bit for bit`, async () => {
    const meaning = meaningOf(name);
    const base = await baseOf(meaning);
    const found = await decoded(bytesOf(name), modules.all, { base });
    expectMeaning(found, meaning);
    if (meaning.codec === 'reel') expectMeaning(await decoded(bytesOf(name), modules.reel, { base }), meaning);
  });
}

for (const name of names.filter((each) => meaningOf(each).levels.length > 0)) {
  test(`${name} shows each coarse level as it is golden`, async () => {
    const meaning = meaningOf(name);
    const base = await baseOf(meaning);
    for (const [i, level] of meaning.levels.entries()) {
      const found = await decoded(bytesOf(name), modules.reel, { base, coarseLevel: i + 1 });
      assert.equal(found.hex(found.level.piece.surface.triangles), level.triangles);
      const segments = found.events.filter((type) => type === 'segment').length;
      if (segments === 1) assert.equal(found.hex(found.level.frames), level.positions);
    }
  });
}

test('every segment of a file can be had of one level, and nothing else', async () => {
  for (const name of names.filter((each) => meaningOf(each).levels.length > 0)) {
    const meaning = meaningOf(name), options = { base: await baseOf(meaning), coarseLevel: 1, frames: true };
    const decoder = await Decoder.create(modules.reel, { ...options, levelAlone: true }), found = [];
    decoder.push(bytesOf(name));
    for (const event of decoder.take(true)) found.push(event.type === 'level' ? [...decoder.frames()] : event.type);
    const positions = Float32Array.from(found.filter(Array.isArray).flat());
    assert.deepEqual(found.filter((each) => !Array.isArray(each)), ['head', 'done']);
    assert.equal(decoder.hash(positions).toString(16).padStart(16, '0'), meaning.levels[0].positions);
  }
});

test('a file that comes in small pieces gives head, level, segments in order, and the same numbers', async () => {
  for (const name of ['reel_v1_range', 'coddyac_v1_cobra_huffman', 'reel_v1_dressed']) {
    const meaning = meaningOf(name);
    for (const slice of [1, 7, 1000]) {
      const found = await decoded(bytesOf(name), modules.all, { slice, coarseLevel: 1 });
      expectMeaning(found, meaning);
      assert.equal(found.events[0], 'head');
      assert.equal(found.events.at(-1), 'done');
      assert.equal(found.events.includes('level'), meaning.levels.length > 0);
    }
  }
});

test('a coarse level is there before the segment has all its bytes', async () => {
  const bytes = bytesOf('reel_v1_range');
  const decoder = await Decoder.create(modules.reel, { coarseLevel: 1 });
  const seen = [];
  let at = 0;
  while (!seen.includes('level')) {
    decoder.push(bytes.subarray(at, ++at));
    for (const event of decoder.take()) seen.push(event.type);
  }
  assert.deepEqual(seen, ['head', 'level']);
  assert.ok(at < 0.9 * bytes.length, `after ${at} of ${bytes.length} bytes`);
});

test('every truncation is an error that names what is missing', async () => {
  const bytes = bytesOf('reel_v1_dressed');
  for (let size = 0; size < bytes.length; size += 13)
    await assert.rejects(decoded(bytes.subarray(0, size), modules.reel), (error) => error instanceof ReelError && error.code === 3);
});

test('a flipped byte is an error that names byte and field, or nothing that the decoder reads', async () => {
  const bytes = bytesOf('reel_v1_range');
  for (let at = 0; at < bytes.length; at += 11) {
    const broken = Uint8Array.from(bytes);
    broken[at] ^= 1 << (at % 8);
    await assert.rejects(decoded(broken, modules.reel), (error) => error instanceof ReelError && error.message.length > 10);
  }
});

/// Where the chunks of a file are, INDX and TAIL left out.
function chunksOf(bytes) {
  const found = [];
  for (let at = 16; ; ) {
    let size = 0, payload = at + 4;
    for (let shift = 1; ; shift *= 128) {
      size += (bytes[payload] & 127) * shift;
      if (bytes[payload++] < 128) break;
    }
    if (String.fromCharCode(...bytes.slice(at, at + 4)) === 'INDX') return found;
    found.push({ at, payload, size });
    at = payload + size + 4;
  }
}

test('wrong payloads behind right checksums are refused or decoded, and never stop the machine', async () => {
  const hasher = await Decoder.create(modules.all), files = names.filter((name) => /^(reel|coddyac|lsp|lossless)_/.test(name));
  let seed = 1, refused = 0;
  const random = (count) => ((seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) >>> 4) % count;
  for (let i = 0; i < 600; ++i) {
    const bytes = Uint8Array.from(bytesOf(files[random(files.length)])), chunks = chunksOf(bytes).filter((chunk) => chunk.size > 0);
    const { at, payload, size } = chunks[random(chunks.length)];
    for (let flips = 1 + random(3); flips > 0; --flips)
      bytes[payload + random(random(2) ? Math.min(size, 40) : size)] ^= 1 << random(8);
    const checksum = Number(hasher.hash(bytes.slice(at, payload + size)) & 0xffffffffn);
    new DataView(bytes.buffer).setUint32(payload + size, checksum, true);
    try {
      await decoded(bytes, modules.all, { coarseLevel: random(3), slice: random(2) ? 500 : bytes.length, maxMemory: 2 ** 28 });
    } catch (error) {
      assert.ok(error instanceof ReelError && error.code !== 4, error.stack);
      ++refused;
    }
  }
  assert.ok(refused > 100 && refused < 600, `${refused} refused`);
});

test('a codec that the small decoder lacks is named', async () => {
  await assert.rejects(decoded(bytesOf('lsp_v1_cobra_range'), modules.reel), (error) => error.code === 5 && error.field === 'HEAD.codec');
});
