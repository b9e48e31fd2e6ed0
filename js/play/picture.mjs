/// Makes docs/play.png, the first picture of the README: a generated animation beside what is decoded of it, as the page shows them.
// SPDX-License-Identifier: MIT
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';

import { browse, command } from '../test/page.mjs';

const folder = mkdtempSync(`${tmpdir()}/meshreel-picture-`), [pc2, obj, reel] = ['cloth.pc2', 'cloth.obj', 'cloth.reel'].map((name) => `${folder}/${name}`);
const run = (...words) => execFileSync(command, words, { stdio: 'inherit' });
run('generate', 'cloth', pc2, '--mesh', obj, '--vertices', '5000', '--frames', '120', '-q');
run('encode', pc2, '--mesh', obj, '--fps', '25', reel, '-q');
const child = spawn(command, ['play', '--no-open', reel, '--against', pc2, '--mesh', obj, '--fps', '25'], { stdio: ['ignore', 'pipe', 'inherit'] });
let address = '';
for await (const part of child.stdout) if ((address += part).includes('\n')) break;
const browser = await browse();
const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, reducedMotion: 'reduce' });
await page.goto(address.trim());
await page.waitForFunction(() => window.meshreel?.state === 'ready', null, { timeout: 300000 });
await page.evaluate(() => {
  meshreel.player.seek(0.62 * meshreel.player.duration);
  while (meshreel.strip.draw(meshreel.stage, 'decoded'));
  meshreel.stage.render();
});
await page.screenshot({ path: new URL('../../docs/play.png', import.meta.url).pathname, timeout: 120000 });
await browser.close();
child.kill();
rmSync(folder, { recursive: true });
