/// A worker: decodes one file after the other, or several at once, and posts what is there.
// SPDX-License-Identifier: MIT
import { chunksOf, eventsOf } from './job.js';

const running = new Map(); // by number: what aborts it, and takes its decoder

/// The memory of all arrays within a value.
export function buffersOf(value, found = new Set()) {
  if (ArrayBuffer.isView(value)) found.add(value.buffer);
  else if (value && typeof value === 'object') for (const part of Object.values(value)) buffersOf(part, found);
  return found;
}

/// Its events, and what of them goes over instead of being copied.
export const plain = { events: eventsOf, moved: buffersOf };

async function run({ events, moved }, { id, source, options }) {
  const abort = new AbortController(), module = new Promise((take, refuse) => running.set(id, { abort, take, refuse }));
  try {
    for await (const event of events(chunksOf(source, abort.signal), module, options)) {
      if (abort.signal.aborted) return;
      self.postMessage({ id, event }, [...moved(event)]);
      await new Promise((next) => setTimeout(next)); // so that an abort is heard
    }
  } catch ({ message, code = 4, byte = -1, field = '' }) {
    if (!abort.signal.aborted) self.postMessage({ id, error: { message, code, byte, field } });
  } finally {
    running.delete(id);
  }
}

/// Works from now on; wayOf: how a task, by its script, is to be done.
export function listen(wayOf) {
  self.onmessage = ({ data: { id, module, abort, ...task } }) => {
    if (module) running.get(id)?.take(module);
    else if (abort) stop(running.get(id));
    else run(wayOf(task.script), { id, ...task });
  };
}

/// One that still waits for its decoder ends too.
function stop(job) {
  job?.abort.abort();
  job?.refuse(new Error('given up'));
}
