/// Makes js/dist/play.html, the page of `meshreel play` and `meshreel export`: style, script, decoder and worker in one file.
// SPDX-License-Identifier: MIT
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';

import { build } from 'esbuild';

const here = new URL('./', import.meta.url);
const read = (name) => readFileSync(new URL(name, here), 'utf8');
const { outputFiles } = await build({
  entryPoints: [new URL('page.js', here).pathname], bundle: true, minify: true, format: 'esm', target: 'es2022', write: false, legalComments: 'inline',
});
// Within a page a script must not seem to end.
const script = outputFiles[0].text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--').trim();
const style = read('style.css').trim();
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;
const policy = `default-src 'none'; script-src ${hash(script)} 'wasm-unsafe-eval'; style-src ${hash(style)}; style-src-attr 'unsafe-inline'; ` +
  "worker-src blob:; connect-src 'self'; img-src data: blob:; base-uri 'none'; form-action 'none'";
const parts = { policy, style, script };
const page = read('index.html').replace(/@(policy|style|script)@/g, (_, name) => parts[name]);
writeFileSync(new URL('../dist/play.html', here), page);
console.log(`js/dist/play.html: ${Buffer.byteLength(page)} bytes`);
