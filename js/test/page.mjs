/// For tests in a browser: files of this project on loopback, and Debian's Chromium.
// SPDX-License-Identifier: MIT
import { createServer } from 'node:http';
import { existsSync, readFileSync, statSync } from 'node:fs';
import { extname, normalize } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

import { chromium } from 'playwright-core';

const root = fileURLToPath(new URL('../../', import.meta.url));
const types = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };

/// What a page may do: run our files and WebAssembly, no eval.
export const policy = "default-src 'none'; script-src 'self' 'nonce-map' 'wasm-unsafe-eval'; worker-src 'self' blob:; connect-src 'self'; img-src blob: data:";

export async function serve() {
  const server = createServer((request, response) => {
    const path = normalize(root + decodeURIComponent(new URL(request.url, 'http://x').pathname));
    if (request.url === '/empty.html' || request.url === '/bench.html') {
      response.writeHead(200, { 'Content-Type': 'text/html', 'Content-Security-Policy': policy });
      response.end(`<!doctype html><meta charset=utf-8><title>meshreel</title><script type=importmap nonce=map>
        {"imports": {"three": "/js/node_modules/three/build/three.module.js", "three/webgpu": "/js/node_modules/three/build/three.webgpu.js", "three/tsl": "/js/node_modules/three/build/three.tsl.js",
        "three/addons/": "/js/node_modules/three/examples/jsm/",
        "meshoptimizer": "/js/node_modules/meshoptimizer/meshopt_decoder.mjs"}}</script><canvas width=256 height=256></canvas>
        ${request.url === '/bench.html' ? '<script src="/js/node_modules/draco3d/draco_decoder_nodejs.js"></script>' : ''}`);
    } else if (!path.startsWith(root) || !existsSync(path) || !statSync(path).isFile()) {
      response.writeHead(404).end();
    } else {
      response.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' });
      response.end(readFileSync(path));
    }
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { address: `http://127.0.0.1:${server.address().port}`, close: () => server.close() };
}

/// Why there is no browser, or ''.
export const missing = existsSync('/usr/bin/chromium') ? '' : 'Chromium is not installed (tools/install.sh --with-wasm)';

/// The command, where it is built: for what it shows in a browser.
export const command = [process.env.MESHREEL, ...['build-check', 'build', 'build-dev'].map((folder) => `${root}${folder}/meshreel`)]
  .find((path) => path && existsSync(path));

export async function browse() {
  const browser = await chromium.launch({
    executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
      '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist',
      '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--js-flags=--expose-gc'],
  });
  return browser;
}

/// Around a file's tests, unless they are skipped: an empty page, given to take() with what it complains of, with a module of ours as
/// window.stage.
export function stagedPage(module, take) {
  let server, browser;
  before(async () => {
    if (missing) return;
    server = await serve();
    browser = await browse();
    const page = await browser.newPage(), complaints = [];
    page.on('console', (message) => ['error', 'warning'].includes(message.type()) && complaints.push(message.text()));
    page.on('pageerror', (error) => complaints.push(error.message));
    await page.goto(`${server.address}/empty.html`);
    await page.evaluate(async (path) => (window.stage = await import(path)), module);
    await take(page, complaints);
  });
  after(async () => {
    await browser?.close();
    server?.close();
  });
}
