/// meshreel play and meshreel export in a browser: what they show, what they say of bad files, and what the server refuses.
// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { get } from 'node:http';
import { tmpdir } from 'node:os';
import { after, before, test } from 'node:test';

import { browse, command, missing } from './page.mjs';

const built = existsSync(new URL('../dist/play.html', import.meta.url)) ? '' : 'js/dist/play.html is not built (make page)';
const skip = missing || (command ? '' : 'the command is not built (make build)') || built || false;
const golden = (name) => new URL(`../../tests/golden/${name}.reel`, import.meta.url).pathname;
const folder = mkdtempSync(`${tmpdir()}/meshreel-play-`), file = (name) => `${folder}/${name}`;
const run = (...words) => JSON.parse(execFileSync(command, [...words, '--json'], { encoding: 'utf8' }));
const servers = [];
let browser, encoded;

/// A running `meshreel play`: its address.
async function playing(...words) {
  const child = spawn(command, ['play', '--no-open', ...words], { stdio: ['ignore', 'pipe', 'inherit'] });
  servers.push(child);
  let said = '';
  for await (const part of child.stdout) if ((said += part).includes('\n')) break;
  return said.trim();
}

/// A page, when all that it loads is there; complaints: what it wrote to the console.
async function opened(address, { width = 420, height = 420, ...options } = {}) {
  const page = await browser.newPage({ viewport: { width, height }, reducedMotion: 'reduce', ...options });
  page.complaints = [];
  page.on('console', (message) => ['error', 'warning'].includes(message.type()) && page.complaints.push(message.text()));
  page.on('pageerror', (error) => page.complaints.push(error.message));
  await page.goto(address);
  await page.waitForFunction(() => ['ready', 'failed'].includes(window.meshreel?.state));
  return page;
}

before(async () => {
  if (skip) return;
  run('generate', 'walker', file('walk.pc2'), '--mesh', file('walk.obj'), '--vertices', '600', '--frames', '24');
  encoded = run('encode', file('walk.pc2'), '--mesh', file('walk.obj'), file('walk.reel'), '--kg', '0.3', '--fps', '24');
  browser = await browse();
});
after(async () => {
  await browser?.close();
  for (const child of servers) child.kill();
  rmSync(folder, { recursive: true });
});

/// Largest distance over the diagonal, of the card's vertices from the decoder's, on the way to the end and back.
const toTheEndAndBack = (page) => page.evaluate(() => {
  const { shown: { clip, pieces }, player } = meshreel, { times, start } = clip.timeline, F = times.length;
  const there = [...times.keys()].filter((f) => f % 8 === 0 || f === times.length - 1), order = [...there, ...there.reverse()], frames = pieces.flatMap(({ frames: all, frameCount }) =>
    Array.from({ length: frameCount }, (_, f) => all.subarray((f * all.length) / frameCount, ((f + 1) * all.length) / frameCount)));
  const diagonal = 2 * clip.geometry.boundingSphere.radius, wide = clip.geometry.attributes.position.count;
  let most = 0;
  for (const f of order) {
    player.seek(times[f] - start);
    meshreel.readBack().forEach((x, i) => (most = Math.max(most, Math.abs(x - frames[f][i]))));
  }
  return { most: most / diagonal, F, wide };
});

test('play beside the original: what the card shows is the decoder\'s, and the error that of the command', { skip }, async () => {
  const page = await opened(await playing(file('walk.reel'), '--against', file('walk.pc2'), '--mesh', file('walk.obj'), '--fps', '24'));
  const found = await toTheEndAndBack(page);
  assert.ok(found.most < 1e-4 && found.F === 24 && found.wide === 600, JSON.stringify(found));
  const worst = await page.evaluate(() => Math.max(...meshreel.heat.largest));
  assert.ok(Math.abs(worst / encoded.max_error - 1) < 1e-4, `${worst}, ${JSON.stringify(encoded)}`);
  assert.deepEqual(await page.evaluate(() => meshreel.stage.panes), ['original', 'decoded', 'error']);
  assert.match(await page.textContent('#unit'), /error, units/);
  assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll('#ticks span')].map((tick) => parseFloat(tick.textContent.replace('≥ ', '')))),
    await page.evaluate(() => [0, 0.5, 1].map((share) => +(share * meshreel.heat.top).toPrecision(3))));
  assert.ok(await page.evaluate(() => { // error over time, as high as it is
    const { width, height } = document.getElementById('curve'), { data } = document.getElementById('curve').getContext('2d').getImageData(0, 0, width, height);
    const { largest } = meshreel.heat, x = Math.round((largest.indexOf(Math.max(...largest)) / (largest.length - 1)) * (width - 1));
    return [17, 18, 19].some((y) => data[4 * (y * width + x) + 3] > 100);
  }));
  await page.click('[data-panes=error]');
  const { width, height } = await (await page.$('#view')).boundingBox();
  const vertices = await page.evaluate(([w, h]) => { // a click somewhere on the mesh
    for (let y = 0.3 * h; y < 0.9 * h; y += 9) for (let x = 0.3 * w; x < 0.7 * w; x += 9) if (meshreel.stage.pick(x, y)) return meshreel.pick(x, y), [...meshreel.stage.marks.keys()];
    return [];
  }, [width, height]);
  assert.deepEqual(vertices, ['decoded', 'original']);
  assert.match(await page.textContent('#tip'), /vertex \d+\n.*\nerror /);
  const astray = await page.evaluate(() => { // the paths are where the vertex is in every frame
    const { picked: { vertex }, stage: { marks }, shown, original } = meshreel, frames = ({ pieces }) => pieces.flatMap((piece) => [...piece.frames]);
    const far = (path, all) => Math.max(...path.map((x, i) => Math.abs(x - all[3 * 600 * Math.floor(i / 3) + 3 * vertex + (i % 3)])));
    return Math.max(far(marks.get('decoded').path, frames(shown)), far(marks.get('original').path, frames(original)));
  });
  assert.ok(astray < 1e-4, `${astray}`);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('play, by keys alone: time goes on, turns, stands still, and is told to whoever does not see it', { skip }, async () => {
  const page = await opened(await playing(golden('reel_v1_fast_walker'), golden('lossless_v1_floats'), golden('reel_v1_dressed')));
  const time = () => page.evaluate(() => meshreel.player.time);
  await page.keyboard.press('Space');
  await page.waitForFunction(() => meshreel.player.time > 0.02);
  assert.equal(await page.getAttribute('#play', 'aria-label'), 'pause');
  await page.keyboard.press('Space');
  await page.keyboard.press('End');
  const end = await time();
  await page.keyboard.press('ArrowLeft');
  assert.ok((await time()) < end);
  assert.match(await page.getAttribute('#seek', 'aria-valuetext'), /frame 11 of 12/);
  await page.keyboard.press('w');
  assert.equal(await page.getAttribute('[data-look=wire]', 'aria-pressed'), 'true');
  const nameless = await page.evaluate(() => [...document.querySelectorAll('button, select, input')].filter((each) =>
    !(each.ariaLabel || each.textContent.trim() || each.labels?.[0]?.textContent.trim())).map((each) => each.id));
  assert.deepEqual(nameless, []);
  await page.selectOption('#file', '1');
  await page.waitForFunction(() => meshreel.item.name === 'lossless_v1_floats.reel' && meshreel.state === 'ready');
  await page.selectOption('#file', '0');
  await page.waitForFunction(() => meshreel.item.name === 'reel_v1_fast_walker.reel' && meshreel.state === 'ready');
  await page.selectOption('#level', '1');
  await page.waitForFunction(() => meshreel.level === 1 && meshreel.state === 'ready');
  assert.ok(await page.evaluate(() => meshreel.shown.clip.head.vertexCount < meshreel.shown.head.vertexCount && meshreel.shown.clip.head.frameCount === 12));
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test('on a phone, in the dark, by touch: all is in the window, drawn, told, and turns under a finger', { skip }, async () => {
  const page = await opened(await playing(golden('reel_v1_segments_walker')), { width: 390, height: 780, colorScheme: 'dark', hasTouch: true, isMobile: true });
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark');
  assert.deepEqual(await page.evaluate(() => [document.documentElement.scrollWidth, document.documentElement.scrollHeight]), [390, 780]);
  await page.waitForFunction(() => !meshreel.strip.draw(meshreel.stage, 'decoded'));
  const strip = await page.evaluate(() => {
    const { width, height } = document.getElementById('strip'), { data } = document.getElementById('strip').getContext('2d').getImageData(0, 0, width, height);
    const filled = (x, y) => data[4 * (y * width + x) + 3] > 0, columns = [...Array(width).keys()], cell = Math.round(0.95 * height);
    const drawn = (x) => [...Array(height - 5).keys()].some((y) => filled(x, y));
    const cells = Array.from({ length: Math.ceil(width / cell) }, (_, i) => columns.slice(i * cell, (i + 1) * cell));
    return { pictures: cells.filter((cell) => cell.some(drawn)).length, cells: cells.length, gaps: columns.filter((x) => x > 0 && filled(x - 1, height - 2) && !filled(x, height - 2)).length };
  });
  assert.ok(strip.pictures >= strip.cells - 1 && strip.cells > 5 && strip.gaps === 3, JSON.stringify(strip)); // three segments
  await page.tap('#facts');
  assert.match(await page.textContent('#figures'), /V300triangles T596frames F12.*K\d.*segments loaded3.*file.*kB.*bits.*card.*frame time/);
  const spot = await page.evaluate(() => {
    for (let y = 200; y < 500; y += 5) for (let x = 100; x < 300; x += 5) if (meshreel.stage.pick(x, y)) return { x, y };
    return null;
  });
  await page.tap('#view', { position: spot });
  assert.match(await page.textContent('#tip'), /^vertex \d+\n/);
  assert.equal(await page.evaluate(() => meshreel.stage.marks.get('decoded').path.length), 3 * 12);
  const before = await page.evaluate(() => meshreel.stage.camera.position.toArray()), finger = await page.context().newCDPSession(page);
  for (const [type, x] of [['touchStart', 100], ['touchMove', 150], ['touchMove', 250], ['touchEnd']])
    await finger.send('Input.dispatchTouchEvent', { type, touchPoints: x ? [{ x, y: 400 }] : [] });
  await page.waitForFunction((was) => Math.hypot(...meshreel.stage.camera.position.toArray().map((x, i) => x - was[i])) > 0.1, before);
  await page.close();
});

test('a broken and a truncated file say what is wrong, and show what is whole', { skip }, async () => {
  const whole = readFileSync(golden('reel_v1_segments_walker')), broken = Buffer.from(whole);
  broken[whole.length >> 1] ^= 4;
  writeFileSync(file('broken.reel'), broken);
  writeFileSync(file('short.reel'), whole.subarray(0, 0.7 * whole.length));
  writeFileSync(file('text.reel'), 'this is no reel\n');
  const address = await playing(...['broken', 'short', 'text'].map((name) => file(`${name}.reel`)));
  const page = await opened(address), told = [];
  for (const i of [0, 1, 2]) {
    await page.selectOption('#file', String(i));
    await page.waitForFunction((n) => meshreel.item === meshreel.manifest.items[n] && meshreel.state === 'failed', i);
    told.push(await page.textContent('#message'));
  }
  assert.match(told[0], /^broken.reel: damaged, or not all there; byte \d+: SEGM.checksum: .*damaged.* 4 of 12 frames are shown\.$/);
  assert.match(told[1], /^short.reel: damaged, or not all there; byte \d+: .* [48] of 12 frames are shown\.$/);
  assert.match(told[2], /^text.reel: .*byte 0: /);
  assert.ok(await page.isVisible('#message'));
  await page.close();
});

/// What heap and card hold more after opening an item again so many times than after the first three.
const growth = (page, times) => page.evaluate(async (count) => {
  const used = async () => {
    for (let i = 0; i < 3; ++i) (gc(), await new Promise((next) => setTimeout(next, 30)));
    const { textures, geometries } = meshreel.stage.renderer.info.memory;
    return { heap: performance.memory.usedJSHeapSize, textures, geometries, programs: meshreel.stage.renderer.info.programs.length };
  };
  const again = async (n) => {
    for (let i = 0; i < n; ++i) {
      await meshreel.open(meshreel.item);
      meshreel.stage.render();
    }
    return used();
  };
  const first = await again(3), last = await again(count);
  return Object.fromEntries(Object.keys(first).map((key) => [key, last[key] - first[key]]));
}, times);

test('opened 60 times, and five times beside an original, nothing grows', { skip }, async () => {
  const beside = await playing(file('walk.reel'), '--against', file('walk.pc2'), '--mesh', file('walk.obj'), '--fps', '24');
  for (const [address, times] of [[await playing(golden('reel_v1_fast_walker')), 60], [beside, 5]]) {
    const page = await opened(address, { width: 300, height: 360 }), grown = await growth(page, times);
    assert.ok(grown.textures <= 0 && grown.geometries <= 0 && grown.programs <= 0 && grown.heap < 2e6, `${times}: ${JSON.stringify(grown)}`);
    await page.close();
  }
});

test('an exported page plays from disk, without a network, and fetches nothing', { skip }, async () => {
  const { bytes } = run('export', '--html', file('walk.html'), file('walk.reel'));
  assert.equal(bytes, readFileSync(file('walk.html')).length);
  const context = await browser.newContext({ viewport: { width: 390, height: 780 }, reducedMotion: 'reduce', offline: true });
  const page = await context.newPage(), asked = [], complaints = [];
  page.on('request', (request) => asked.push(request.url()));
  page.on('console', (message) => complaints.push(message.text()));
  await page.goto(`file://${file('walk.html')}`);
  await page.waitForFunction(() => window.meshreel?.state === 'ready');
  const same = await page.evaluate(() => {
    const { clip } = meshreel.shown, { duration } = clip.timeline, rows = new Float32Array(3 * clip.rows);
    let most = 0;
    for (const time of [0, 0.3 * duration, duration, 0]) {
      meshreel.player.seek(time);
      clip.rowsAt(time, rows);
      meshreel.readBack().forEach((x, i) => (most = Math.max(most, Math.abs(x - rows[3 * clip.geometry.attributes.reelRow.getX((i / 3) | 0) + (i % 3)]))));
    }
    return { most: most / (2 * clip.geometry.boundingSphere.radius), wide: document.documentElement.scrollWidth <= innerWidth };
  });
  assert.ok(same.most < 1e-4 && same.wide, JSON.stringify(same));
  assert.deepEqual(asked.filter((url) => !url.startsWith('blob:')), [`file://${file('walk.html')}`]);
  assert.deepEqual(complaints, []);
  await context.close();
});

/// Shares of pixels that differ by more than a little, of a picture from its reference.
const difference = (page, picture, reference) => page.evaluate(async (pictures) => {
  const [a, b] = await Promise.all(pictures.map(async (bytes) => {
    const image = await createImageBitmap(new Blob([Uint8Array.from(atob(bytes), (c) => c.charCodeAt(0))]));
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, image.width, image.height).data;
  }));
  return a.length !== b.length ? 1 : a.filter((x, i) => Math.abs(x - b[i]) > 24).length / a.length;
}, [picture.toString('base64'), reference.toString('base64')]);

test('it looks as it did: light, dark, normals', { skip }, async () => {
  const page = await opened(await playing(golden('reel_v1_fast_walker')), { width: 360, height: 420 });
  await page.evaluate(() => meshreel.player.seek(0.2 * meshreel.player.duration));
  for (const [name, keys] of [['light', []], ['dark', ['d']], ['normals', ['d', 'n']]]) {
    for (const key of keys) await page.keyboard.press(key);
    await page.evaluate(() => meshreel.stage.render());
    const picture = await page.screenshot({ clip: { x: 8, y: 112, width: 344, height: 176 } });
    const place = new URL(`reference/${name}.png`, import.meta.url);
    if (process.env.RENEW) writeFileSync(place, picture);
    const share = await difference(page, picture, readFileSync(place));
    if (share >= 0.01) writeFileSync(`${tmpdir()}/meshreel-${name}.png`, picture);
    assert.ok(share < 0.01, `${name}: ${share} of the pixels differ; see ${tmpdir()}/meshreel-${name}.png`);
  }
  await page.close();
});

test('the server answers to nobody else', { skip: command ? false : skip }, async () => {
  writeFileSync(file('page.html'), 'a page');
  const address = new URL(await playing(golden('reel_v1_range'), '--page', file('page.html')));
  const status = (path, options = {}) => new Promise((told, failed) => get({ host: '127.0.0.1', port: address.port, path, ...options },
    (response) => (response.resume(), told(response.statusCode))).on('error', failed));
  assert.equal(address.hostname, '127.0.0.1');
  assert.match(address.pathname, /^\/[0-9a-f]{32}\/$/);
  assert.equal(await status(address.pathname), 200);
  assert.equal(await status(`${address.pathname}item-0`), 200);
  assert.equal(await status('/'), 404);
  assert.equal(await status('/item-0'), 404);
  assert.equal(await status(`${address.pathname}../../etc/passwd`), 404);
  assert.equal(await status(`${address.pathname}item-1`), 404);
  assert.equal(await status(address.pathname, { headers: { Host: `evil.example:${address.port}` } }), 403);
  assert.equal(await status(address.pathname, { headers: { Host: `localhost:${address.port}` } }), 200);
  assert.ok([400, 405, 413].includes(await status(address.pathname, { method: 'POST' })));
});
