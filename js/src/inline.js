/// A decoder and a worker that a page carries in itself, as text.
// SPDX-License-Identifier: MIT
import { usePlaces } from './decode.js';

/// From now on decodeReel() uses these. No eval: a page with a Content-Security-Policy allows script-src 'wasm-unsafe-eval'
/// and worker-src blob: (or decodes with worker: false).
export function carry(wasmBase64, workerScript) {
  const bytes = () => Uint8Array.from(atob(wasmBase64), (letter) => letter.charCodeAt(0));
  usePlaces({
    module: () => WebAssembly.compile(bytes()),
    worker: () => {
      const address = URL.createObjectURL(new Blob([workerScript], { type: 'text/javascript' }));
      const worker = new Worker(address);
      URL.revokeObjectURL(address);
      return worker;
    },
  });
}
