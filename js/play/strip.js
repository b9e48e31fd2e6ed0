/// The timeline: small pictures, what is loaded, where segments meet, the error over time, and the time.
// SPDX-License-Identifier: MIT

/// A canvas with as many pixels as it is shown with; its context, scaled to CSS pixels.
function fitted(canvas) {
  const ratio = devicePixelRatio || 1, width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return context;
}
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

export class Strip {
  constructor({ strip, curve, head, seek, now }) {
    Object.assign(this, { strip, curve, head, input: seek, now });
    this.duration = 1;
    this.pictures = 0;
  }

  /// A new animation: its times, its length.
  begin(timeline) {
    this.clear();
    this.timeline = timeline;
    this.duration = timeline.duration || 1;
    this.input.max = String(timeline.duration);
  }

  /// Nothing is there to be seen.
  clear() {
    Object.assign(this, { timeline: null, pictures: 0, known: null });
    fitted(this.strip).clearRect(0, 0, this.strip.clientWidth, this.strip.clientHeight);
    this.now.textContent = '';
    this.head.style.left = '0';
  }

  /// Segments loaded so far, of F frames: a line below, with a gap where two meet.
  loaded(pieces, F) {
    const context = fitted(this.strip), { clientWidth: W, clientHeight: H } = this.strip;
    context.clearRect(0, H - 3, W, 3);
    context.fillStyle = colour('--line');
    const at = (f) => Math.round((f / F) * W);
    for (const { firstFrame: f, frameCount } of pieces) context.fillRect(at(f), H - 3, Math.max(1, at(f + frameCount) - at(f) - 1), 3);
  }

  /// Draws the next picture that is missing; false: there is none.
  draw(stage, pane) {
    const { clientWidth: W, clientHeight: H } = this.strip, width = Math.round(H * 0.95), count = Math.max(1, Math.ceil(W / width));
    if (this.pictures >= count || !this.timeline) return false;
    const x = this.pictures * width, middle = Math.min((x + width / 2) / W, 1) * this.timeline.duration;
    const context = this.strip.getContext('2d');
    context.clearRect(x, 0, width, H - 4);
    stage.thumbnail(pane, middle, context, { x, y: 0, width, height: H - 4 });
    ++this.pictures;
    return true;
  }

  /// The largest and the mean error of each frame.
  errors({ largest, mean }, label) {
    this.known = { largest, mean, label };
    const context = fitted(this.curve), { clientWidth: W, clientHeight: H } = this.curve;
    const most = largest.reduce((a, b) => Math.max(a, b), 0) || 1, { times, start } = this.timeline;
    const x = (f) => ((times[f] - start) / this.duration) * W, y = (d) => H - 3 - (d / most) * (H - 20);
    context.clearRect(0, 0, W, H);
    const curve = (values) => {
      context.beginPath();
      values.forEach((d, f) => context.lineTo(x(f), y(d)));
    };
    curve(mean);
    context.lineTo(x(mean.length - 1), H);
    context.lineTo(0, H);
    context.globalAlpha = 0.25;
    context.fillStyle = colour('--line');
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = 1.5;
    for (const [values, name] of [[mean, '--line'], [largest, '--mark']]) {
      curve(values);
      context.strokeStyle = colour(name);
      context.stroke();
    }
    context.font = '11.5px system-ui, "DejaVu Sans", sans-serif';
    context.fillStyle = colour('--soft');
    context.fillText(label, 8, 13);
  }

  /// The window has another size, or other colours.
  again(pieces, F) {
    this.pictures = 0;
    fitted(this.strip);
    this.loaded(pieces, F);
    if (this.known && !this.curve.hidden) this.errors(this.known, this.known.label);
  }

  show(time) {
    const share = Math.min(1, time / this.duration);
    this.head.style.left = `${100 * share}%`;
    const { times, start } = this.timeline, frame = Math.max(0, times.findLastIndex((t) => t - start <= time + 1e-9));
    const text = `${time.toFixed(2)} of ${this.timeline.duration.toFixed(2)} s, frame ${frame + 1} of ${times.length}`;
    if (document.activeElement !== this.input || Number(this.input.value) !== time) this.input.value = String(time);
    this.input.setAttribute('aria-valuetext', text);
    this.now.textContent = matchMedia('(max-width: 700px)').matches ? `${time.toFixed(2)} s` : text;
    return frame;
  }
}
