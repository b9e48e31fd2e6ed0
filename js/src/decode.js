/// decodeReel: a file's head, coarse level and segments one after the other, out of a worker.
// SPDX-License-Identifier: MIT
import { ReelError } from './decoder.js';
import { chunksOf, eventsOf } from './job.js';

let modules = new Map(); // compiled, by where they came from
let worker = null;
let waiting = new Map(); // for the worker's messages, by number
let count = 0;

const made = (name) => new URL(`../dist/${name}`, import.meta.url).href;

/// Where decoder and worker come from. src/inline.js replaces it by what it carries itself.
const places = {
  module: (all) => WebAssembly.compileStreaming(fetch(made(all ? 'meshreel-all.wasm' : 'meshreel.wasm'))),
  worker: () => new Worker(made('worker.js')),
};

export function usePlaces(others) {
  disposeDecoder();
  Object.assign(places, others);
  modules = new Map();
}

/// The compiled decoder: of what `meshreel encode` writes by default, or of every codec.
export function decoderModule(all = false) {
  if (!modules.has(all)) modules.set(all, Promise.resolve(places.module(all)));
  return modules.get(all);
}

/// Ends the worker; the next decodeReel() starts another.
export function disposeDecoder() {
  worker?.terminate();
  worker = null;
  for (const told of waiting.values()) told({ error: { message: 'the decoder was disposed of', code: 1 } });
  waiting = new Map();
}

function theWorker() {
  if (worker) return worker;
  worker = places.worker();
  worker.onmessage = ({ data }) => waiting.get(data.id)?.(data);
  worker.onerror = (event) => {
    for (const told of waiting.values()) told({ error: { message: event.message || 'the worker cannot run', code: 4 } });
  };
  return worker;
}

/// Decodes a file: the address, ArrayBuffer, Response, ReadableStream or Blob of one.
/// Yields { type: 'head', head }, perhaps { type: 'level', piece }, then { type: 'segment', piece } in the order of time,
/// { type: 'done' }. options: coarseLevel, maxMemory, base (see Decoder.create); all: every codec; frames, single (see
/// eventsOf); worker: false decodes in this thread; signal: an AbortSignal.
/// @throws ReelError
export async function* decodeReel(source, { worker: apart = true, all = false, signal, ...options } = {}) {
  const module = await decoderModule(all);
  if (!apart || typeof Worker === 'undefined') {
    yield* eventsOf(chunksOf(source, signal), module, options);
    return;
  }
  if (typeof source === 'string' || source instanceof URL) source = new URL(source, globalThis.location?.href).href;
  if (source instanceof Response) source = source.body ?? new Uint8Array(await source.arrayBuffer());
  yield* apartEvents(source, module, options, signal);
}

async function* apartEvents(source, module, options, signal) {
  const id = ++count, told = [];
  let wake = () => {};
  const tell = (message) => {
    told.push(message);
    wake();
  };
  waiting.set(id, tell);
  const abort = () => tell({ error: signal.reason });
  signal?.addEventListener('abort', abort);
  try {
    signal?.throwIfAborted();
    const own = theWorker();
    own.postMessage({ id, source, module, options }, source instanceof ReadableStream ? [source] : []);
    for (;;) {
      while (told.length === 0) await new Promise((done) => (wake = done));
      const { event, error } = told.shift();
      if (error instanceof Error) throw error;
      if (error) throw Object.assign(new ReelError(''), error);
      yield event;
      if (event.type === 'done') return;
    }
  } finally {
    signal?.removeEventListener('abort', abort);
    waiting.delete(id);
    worker?.postMessage({ id, abort: true });
  }
}

export { ReelError };
