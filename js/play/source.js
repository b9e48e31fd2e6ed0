/// Where the page's animations come from: a server's list, or the page itself.
// SPDX-License-Identifier: MIT
import { ReelClip } from '../src/reel.js';
import { ReelError, decodeReel } from '../src/decode.js';
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
  const options = { all: true, single: true, frames, signal, coarseLevel: level || 2, levelAlone: level > 0 };
  yield* growing(decodeReel(source, options), level);
}

/// Tables are made anew for each clip: not for each segment, but when there is twice as much, or a second has gone by.
async function* growing(events, level) {
  let head = null, pieces = [], shown = 0, at = 0;
  const made = () => {
    const { firstFrame, frameCount } = pieces.at(-1);
    [shown, at] = [pieces.length, performance.now()];
    return { clip: new ReelClip(head, pieces), head, pieces, whole: firstFrame + frameCount === head.frameCount };
  };
  try {
    for await (const { type, head: given, piece } of events) {
      if (type === 'head') head ??= given;
      if (type === 'level' && !level) yield { clip: new ReelClip(head, [piece]), head, pieces: [], whole: false };
      if (!piece || (type === 'level' && !level)) continue;
      pieces.push(piece);
      const whole = piece.firstFrame + piece.frameCount === head.frameCount;
      if (whole || pieces.length >= 2 * shown || performance.now() > at + 1000) yield made();
    }
  } catch (error) {
    if (pieces.length > shown) yield made();
    throw error;
  }
}
