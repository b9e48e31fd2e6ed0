/// Types of decodeReel.
// SPDX-License-Identifier: MIT
import type { DecoderOptions, ReelEvent } from './decoder.js';

export { ReelError } from './decoder.js';
export type * from './decoder.js';

export type ReelSource = string | URL | ArrayBuffer | ArrayBufferView | Response | ReadableStream<Uint8Array> | Blob;

export interface DecodeOptions extends DecoderOptions {
  worker?: boolean;
  all?: boolean;
  frames?: boolean;
  single?: boolean;
  signal?: AbortSignal;
}

export declare function decodeReel(source: ReelSource, options?: DecodeOptions): AsyncGenerator<ReelEvent, void, void>;
export declare function decoderModule(all?: boolean): Promise<WebAssembly.Module>;
export declare function disposeDecoder(): void;
export declare function usePlaces(places: {
  module?: (all: boolean) => Promise<WebAssembly.Module>;
  /** The worker of that script, `worker.js` or `clip-worker.js`; the latter does the former's work too. */
  worker?: (script: string) => Worker;
}): void;
