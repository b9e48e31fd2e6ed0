/// The worker of decodeClips(), and of decodeReel() too.
// SPDX-License-Identifier: MIT
import { clipsOf } from './growing.js';
import { buffersOf, listen, plain } from './worker.js';

const clips = { events: clipsOf, moved: ({ data, piece }) => buffersOf([data?.tables, piece?.frames]) };

listen((script) => (script === 'clip-worker.js' ? clips : plain));
