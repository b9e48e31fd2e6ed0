/// Where the page's animations come from: a server's list, or the page itself.
// SPDX-License-Identifier: MIT
import { ReelClip } from '../src/clip.js';
import { decodeClips } from '../src/clips.js';
import { ReelError } from '../src/decode.js';
import { readSheet } from './sheet.js';

/// What is to be played: { items: [{ name, kind, url, bytes, levels, original }] }.
export async function readManifest() {
  const within = JSON.parse(document.getElementById('manifest').textContent);
  if (within) return within;
  const response = await fetch('manifest.json');
  if (!response.ok) throw new ReelError('this page has nothing to play: it is shown by meshreel play, or made by meshreel export');
  return response.json();
}

/// The bytes of an item, or where they come from.
async function bytesOf({ url, name }, signal) {
  if (url.startsWith('#')) {
    const text = document.getElementById(url.slice(1)).textContent.trim();
    return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  }
  const response = await fetch(url, { signal });
  if (!response.ok) throw new ReelError(`${name}: ${await response.text()}`, { code: 2 });
  return response;
}

/// Clips of an item, each of more than the one before: { clip, head, pieces, whole }. The pieces have their exact frames where
/// `frames` asks for them. @throws ReelError, after what could be shown
export async function* clipsOf(item, { level = 0, frames = false, signal }) {
  const source = await bytesOf(item, signal);
  if (item.kind === 'sheet') {
    const { head, piece } = readSheet(await source.arrayBuffer());
    yield { clip: new ReelClip(head, [piece]), head, pieces: [piece], whole: true };
    return;
  }
  let head = null;
  const pieces = [], shown = level > 0 ? 'level' : 'segment';
  for await (const event of decodeClips(source, { all: true, steps: true, frames, signal, coarseLevel: level || 2, levelAlone: level > 0 })) {
    if (event.type === 'head') head = event.head;
    if (event.type === shown) pieces.push(event.piece);
    if (event.type !== 'clip') continue;
    const clip = new ReelClip(head, event.data), whole = pieces.length > 0 && clip.head.frameCount === head.frameCount;
    yield { clip, head, pieces, whole };
  }
}
