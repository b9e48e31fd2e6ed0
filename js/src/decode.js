/// decodeReel: a file's head, coarse level and segments one after the other, out of a worker.
// SPDX-License-Identifier: MIT
import { ReelError } from './decoder.js';
import { chunksOf, eventsOf } from './job.js';

let modules = new Map(); // compiled, by where they came from
let workers = new Map(); // by script
let waiting = new Map(); // for the workers' messages, by number
let count = 0;

const made = (name) => new URL(`../dist/${name}`, import.meta.url).href;

/// Where decoder and workers come from. src/inline.js replaces it by what it carries itself.
const places = {
  module: (all) => WebAssembly.compileStreaming(fetch(made(all ? 'meshreel-all.wasm' : 'meshreel.wasm'))),
  worker: (script) => new Worker(made(script)),
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

/// Ends the workers; the next decodeReel() starts another.
export function disposeDecoder() {
  for (const worker of workers.values()) worker.terminate();
  workers = new Map();
  for (const told of waiting.values()) told({ error: { message: 'the decoder was disposed of', code: 1 } });
  waiting = new Map();
}

/// The worker of a way, or one that knows more.
export function startWorker({ script }) {
  const running = workers.get(script) ?? workers.get('clip-worker.js');
  if (running || typeof Worker === 'undefined') return running;
  const worker = places.worker(script);
  workers.set(script, worker);
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
export const decodeReel = (source, options = {}) => runApart({ script: 'worker.js', events: eventsOf }, source, options);

/// The events of a file by a way to make them: in the worker of that script, else here. Worker, decoder and file are fetched at
/// the same time.
export async function* runApart(way, source, { worker: apart = true, all = false, signal, ...options }) {
  const module = decoderModule(all);
  if (!apart || typeof Worker === 'undefined') {
    yield* way.events(chunksOf(source, signal), module, options);
    return;
  }
  if (typeof source === 'string' || source instanceof URL) source = new URL(source, globalThis.location?.href).href;
  const worker = startWorker(way);
  if (source instanceof Response) source = source.body ?? new Uint8Array(await source.arrayBuffer());
  yield* toldBy(worker, { source, options, script: way.script }, module, signal);
}

/// The events that a worker tells of a task.
async function* toldBy(worker, task, module, signal) {
  const id = ++count, told = [];
  let wake = () => {};
  const tell = (message) => {
    told.push(message);
    wake();
  };
  waiting.set(id, tell);
  const fail = (error) => tell({ error }), abort = () => fail(signal.reason);
  signal?.addEventListener('abort', abort);
  try {
    signal?.throwIfAborted();
    worker.postMessage({ id, ...task }, task.source instanceof ReadableStream ? [task.source] : []);
    module.then((compiled) => waiting.has(id) && worker.postMessage({ id, module: compiled }), fail);
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
    worker.postMessage({ id, abort: true });
  }
}

export { ReelError };
