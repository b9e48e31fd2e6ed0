/// Tables of a file on its way, for as much of it as is there.
// SPDX-License-Identifier: MIT
import { eventsOf } from './job.js';
import { ClipMaker, clipData } from './tables.js';

/// When a clip is worth its making: tables are made anew for each. options.steps: not only when all is there, but of a level,
/// when there is twice as much as before, and when a second has gone by. levelAlone: levels are all there is.
class Growing {
  #head = null;
  #pieces = [];
  #shown = 0;
  #at = 0;

  constructor({ steps = false, levelAlone = false }) {
    Object.assign(this, { steps, levelAlone });
  }

  *take({ type, head, piece }) {
    if (type === 'head') this.#begin(head);
    else if (type === 'done') yield* this.rest();
    else if (type === 'level' && !this.levelAlone) yield clipData(this.#head, [piece]);
    else {
      this.#pieces.push(piece);
      this.maker.add(piece);
      const whole = piece.firstFrame + piece.frameCount === this.#head.frameCount, sooner = this.steps && this.#sooner();
      if (whole || sooner) yield* this.rest();
    }
  }

  /// A file may have more to say of its surface behind its segments: then all is made again.
  #begin(head) {
    this.#head = head;
    this.maker = new ClipMaker(head);
    for (const piece of this.#pieces) this.maker.add(piece);
    this.#shown = 0;
  }
  #sooner() {
    return this.#pieces.length >= 2 * this.#shown || performance.now() > this.#at + 1000;
  }

  /// What is there that no clip has yet.
  *rest() {
    if (this.#pieces.length <= this.#shown) return;
    this.#shown = this.#pieces.length;
    this.#at = performance.now();
    yield this.maker.made();
  }
}

/// A piece without what only its tables need.
function light(event, { frames }) {
  if (!event.piece) return event;
  const { mean, basis, coefficients, ...piece } = event.piece;
  return { ...event, piece: frames ? piece : { ...piece, frames: null } };
}

/// The events of a file, pieces without their numbers, and { type: 'clip', data } where a clip is worth it: before 'done' the last
/// one; before an error that of what was whole.
export async function* clipsOf(chunks, module, options = {}) {
  const growing = new Growing(options), clip = (data) => ({ type: 'clip', data });
  try {
    for await (const event of eventsOf(chunks, module, options)) {
      const made = [...growing.take(event)].map(clip), told = light(event, options);
      yield* event.type === 'done' ? [...made, told] : [told, ...made];
    }
  } catch (error) {
    for (const data of growing.rest()) yield clip(data);
    throw error;
  }
}
