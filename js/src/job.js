/// A file's bytes, wherever they come from, through a decoder.
// SPDX-License-Identifier: MIT
import { Decoder, ReelError } from './decoder.js';

/// The bytes of an ArrayBuffer or a view, a Response, a ReadableStream, a Blob, or of an address.
export async function* chunksOf(source, signal) {
  if (source instanceof ArrayBuffer) source = new Uint8Array(source);
  if (ArrayBuffer.isView(source)) {
    yield new Uint8Array(source.buffer, source.byteOffset, source.byteLength);
    return;
  }
  if (typeof source === 'string' || source instanceof URL) source = await fetch(source, { signal });
  if (source instanceof Response) {
    if (!source.ok) throw new ReelError(`${source.url}: ${source.status} ${source.statusText}`.trim(), { code: 2 });
    source = source.body;
  }
  if (source instanceof Blob) source = source.stream();
  if (!source || !source.getReader) throw new ReelError('neither bytes nor where to get them', { code: 1 });
  const reader = source.getReader();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      if (signal && signal.aborted) throw signal.reason;
      yield part.value;
    }
  } finally {
    reader.cancel().catch(() => {});
  }
}

/// The events of a file, as Decoder.take() gives them. module: compiled, or a promise of it. options.frames: pieces have their
/// exact frames too, as those without coefficients always do; options.single: coefficients as float32.
export async function* eventsOf(chunks, module, options = {}) {
  const first = chunks.next(); // comes while the decoder is compiled
  first.catch(() => {}); // it is thrown below
  let decoder = null;
  const finished = (event) => {
    if (event.piece && options.single) event.piece.coefficients = new Float32Array(event.piece.coefficients);
    if (event.piece && (options.frames || event.piece.exact)) event.piece.frames = decoder.frames();
    return event;
  };
  try {
    decoder = await Decoder.create(await module, options);
    for (let part = await first; !part.done; part = await chunks.next()) {
      decoder.push(part.value);
      for (const event of decoder.take()) yield finished(event);
    }
    for (const event of decoder.take(true)) yield finished(event);
  } finally {
    decoder?.close();
    chunks.return().catch(() => {});
  }
}
