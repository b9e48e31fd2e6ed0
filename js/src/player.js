/// The control of a clip's time.
// SPDX-License-Identifier: MIT
import { EventDispatcher, LoopOnce, LoopPingPong, LoopRepeat } from 'three';

/// Plays: time, direction, speed, ends. update(seconds) every frame, as an AnimationMixer.
/// Dispatches 'loop' and 'finished'.
export class ReelPlayer extends EventDispatcher {
  constructor(timeline, show) {
    super();
    this.duration = timeline.duration;
    this.time = 0; ///< seconds from the first frame
    this.speed = 1; ///< below 0: backwards
    this.loop = LoopRepeat; ///< or LoopOnce, LoopPingPong
    this.playing = false;
    this.show = show;
  }

  play() {
    this.playing = true;
    return this;
  }
  pause() {
    this.playing = false;
    return this;
  }
  reverse() {
    this.speed = -this.speed;
    return this;
  }
  /// Goes to a time, at once.
  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.duration);
    this.show(this.time);
    return this;
  }

  update(seconds) {
    if (!this.playing || this.duration === 0) return;
    let time = this.time + seconds * this.speed;
    if (time < 0 || time > this.duration) time = this.#turned(time);
    this.seek(time);
  }

  #turned(time) {
    if (this.loop === LoopOnce) {
      this.playing = false;
      this.dispatchEvent({ type: 'finished', direction: Math.sign(this.speed) });
      return time;
    }
    this.dispatchEvent({ type: 'loop', direction: Math.sign(this.speed) });
    const length = this.duration, turns = Math.floor(time / length), rest = time - turns * length;
    if (this.loop !== LoopPingPong || turns % 2 === 0) return rest;
    this.reverse();
    return length - rest;
  }
}
