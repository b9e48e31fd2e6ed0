/// The frame at any time: a cubic between stored frames and exactly through them, as `meshreel decode --fps` (mesh/frame_mix.h).
// SPDX-License-Identifier: MIT

const sameTime = 1e-6; // of the distance of two frames

/// times: [F] strictly increasing. loop: the first frame follows the last one, after 1 / fps or the mean distance of frames.
export class Timeline {
  constructor(times, loop = false, fps = 0) {
    this.times = times;
    const F = times.length, length = times[F - 1] - times[0];
    this.period = loop && F > 1 ? length + (fps > 0 ? 1 / fps : length / (F - 1)) : 0;
    this.start = times[0];
    this.duration = this.period || length;
  }

  #has(f) {
    return this.period > 0 || (f >= 0 && f < this.times.length);
  }
  #number(f) {
    const F = this.times.length;
    return ((f % F) + F) % F;
  }
  #time(f) {
    const number = this.#number(f);
    return this.times[number] + ((f - number) / this.times.length) * this.period;
  }

  /// Fills frames[0..3] and weights[0..3]; those not needed have the weight 0.
  mix(t, frames, weights) {
    const times = this.times;
    let low = -1, high = times.length; // times[low] <= t < times[high]
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= t) low = middle;
      else high = middle;
    }
    const only = (f) => {
      frames.fill(this.#number(f));
      weights.fill(0);
      weights[0] = 1;
    };
    if (low < 0) return only(0);
    if (!this.#has(low + 1)) return only(low);
    const h = this.#time(low + 1) - this.#time(low), u = (t - this.#time(low)) / h;
    if (!(u > sameTime)) return only(low);
    if (!(u < 1 - sameTime)) return only(low + 1);
    const before = this.#has(low - 1) ? (this.#time(low) - this.#time(low - 1)) / h : 0;
    const after = this.#has(low + 2) ? (this.#time(low + 2) - this.#time(low + 1)) / h : 0;
    cubic(u, before, after, weights);
    for (let i = 0; i < 4; ++i) frames[i] = weights[i] === 0 ? this.#number(low) : this.#number(low - 1 + i);
  }
}

/// Adds `scale` times the speed at place p[1], whose neighbours are p[0] (r intervals away, 0: none), p[2] and, after it, p[3].
function addSpeed(w, p, scale, r, s) {
  if (r > 0) {
    w[p[0]] -= scale / (r * (1 + r));
    w[p[1]] += (scale * (1 - r)) / r;
    w[p[2]] += (scale * r) / (1 + r);
  } else if (s > 0) {
    w[p[1]] -= (scale * (2 + s)) / (1 + s);
    w[p[2]] += (scale * (1 + s)) / s;
    w[p[3]] -= scale / (s * (1 + s));
  } else {
    w[p[1]] -= scale;
    w[p[2]] += scale;
  }
}

function cubic(u, before, after, w) {
  const v = 1 - u;
  w[0] = w[3] = 0;
  w[1] = (1 + 2 * u) * v * v;
  w[2] = u * u * (3 - 2 * u);
  addSpeed(w, [0, 1, 2, 3], u * v * v, before, after);
  addSpeed(w, [3, 2, 1, 0], u * u * v, after, before);
  if (w.every((weight) => Math.abs(weight) <= 16)) return;
  w[0] = w[3] = 0;
  w[1] = v;
  w[2] = u;
}
