/// The worker: decodes one file after the other, or several at once, and posts what is there.
// SPDX-License-Identifier: MIT
import { chunksOf, eventsOf } from './job.js';

const running = new Map(); // by number: what aborts it

/// The memory of all arrays within a message goes over, it is not copied.
function buffersOf(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) found.add(value.buffer);
  else if (value && typeof value === 'object') for (const part of Object.values(value)) buffersOf(part, found);
  return found;
}

async function run({ id, source, module, options }) {
  const abort = new AbortController();
  running.set(id, abort);
  try {
    for await (const event of eventsOf(chunksOf(source, abort.signal), module, options)) {
      if (abort.signal.aborted) return;
      self.postMessage({ id, event }, [...buffersOf(event)]);
      await new Promise((next) => setTimeout(next)); // so that an abort is heard
    }
  } catch ({ message, code = 4, byte = -1, field = '' }) {
    self.postMessage({ id, error: { message, code, byte, field } });
  } finally {
    running.delete(id);
  }
}

self.onmessage = ({ data }) => {
  if (data.abort) running.get(data.id)?.abort();
  else run(data);
};
