/// decodeClips: a file's head, and tables of more and more of it, out of a worker.
// SPDX-License-Identifier: MIT
import { runApart, startWorker } from './decode.js';
import { clipsOf } from './growing.js';

const way = { script: 'clip-worker.js', events: clipsOf };

/// decodeReel()'s events, pieces without their numbers, and between them { type: 'clip', data }, what ReelClip takes instead of
/// pieces: when all is there, and before an error. options.steps: as more comes, too (growing.js). @throws ReelError
export const decodeClips = (source, options = {}) => runApart(way, source, { ...options, single: true });

/// Starts the worker, so that the first file need not wait for it.
export const startClipWorker = () => startWorker(way);
