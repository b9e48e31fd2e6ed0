/// The page of `meshreel play` and `meshreel export`: what is loaded, what is shown, and what keys and buttons do.
// SPDX-License-Identifier: MIT
import { LoopOnce, LoopPingPong, LoopRepeat } from 'three';

import { readBack } from '../src/readback.js';
import { ReelPlayer } from '../src/player.js';
import { Timeline } from '../src/timeline.js';
import { controls } from './controls.js';
import { $ } from './element.js';
import { figures, lengthText } from './figures.js';
import { colourOf, distances, heatMaterial, showHeat } from './heat.js';
import { clipsOf, readManifest } from './source.js';
import { Stage } from './stage.js';
import { Strip } from './strip.js';

const loops = [[LoopRepeat, '↻', 'loop'], [LoopPingPong, '⇋', 'to and fro'], [LoopOnce, '→', 'once']];
const axes = ['y', 'z', 'x'];

class Page {
  constructor(manifest) {
    this.manifest = manifest;
    this.stage = new Stage($('view'));
    this.strip = new Strip({ strip: $('strip'), curve: $('curve'), head: $('head'), seek: $('seek'), now: $('now') });
    this.stage.look = 'shaded';
    this.speed = 1;
    this.loop = 0;
    this.frameTimes = [];
    this.pieces = [];
  }

  get against() {
    return this.item?.original ?? null;
  }

  /// Shows one of the manifest's items from its beginning.
  async open(item, level = 0) {
    this.abort?.abort();
    const mine = (this.abort = new AbortController());
    this.close();
    Object.assign(this, { item, level, error: null, whole: false, state: 'loading' });
    $('title').textContent = document.title = item.name;
    try {
      const original = this.against && await this.openOriginal(mine.signal);
      for await (const loaded of clipsOf(item, { level, frames: !!original, signal: mine.signal })) {
        if (mine.signal.aborted) return loaded.clip.dispose();
        this.take(loaded);
      }
      if (original) await this.compare(original);
      this.state = 'ready';
    } catch (error) {
      if (mine.signal.aborted) return;
      this.state = 'failed';
      this.say(error);
    }
    this.figures();
  }

  async openOriginal(signal) {
    for await (const loaded of clipsOf(this.against, { signal })) {
      this.original = loaded;
      this.stage.put('original', loaded.clip);
    }
    return this.original;
  }

  close() {
    this.stage.unmark('decoded');
    this.stage.unmark('original');
    for (const pane of ['original', 'decoded', 'error']) this.stage.take(pane);
    for (const { clip } of [this.original, this.shown]) clip?.dispose();
    Object.assign(this, { original: {}, shown: {}, heat: null, pieces: [], player: null, framed: false });
    for (const id of ['message', 'legend', 'curve', 'tip', 'panes']) $(id).hidden = true;
    this.picked = null;
    this.strip.clear();
    this.setPanes(['decoded']);
  }
  original = {};
  shown = {};

  /// The next clip of the file on its way: more segments, or all of it.
  take({ clip, head, pieces, whole }) {
    const before = this.shown.clip;
    this.shown = { clip, head, pieces };
    Object.assign(this, { pieces, whole });
    this.stage.turn(this.up ?? head.up);
    this.stage.put('decoded', clip);
    before?.dispose();
    if (!this.framed) this.begin(clip);
    this.player.duration = clip.timeline.duration;
    this.strip.loaded(pieces, head.frameCount);
    this.figures();
  }

  begin(clip) {
    this.framed = true;
    if (this.against) this.setPanes(['original', 'decoded']);
    this.stage.frame(clip);
    this.player = new ReelPlayer(clip.timeline, (time) => this.seek(time));
    this.player.addEventListener('finished', () => this.tellState());
    const { times, loop, fps } = this.shown.head, whole = new Timeline(times, loop, fps);
    this.strip.begin(whole);
    this.setSpeed(this.speed);
    this.player.loop = loops[this.loop][0];
    this.player.seek(0);
    if (whole.duration > 0 && !matchMedia('(prefers-reduced-motion: reduce)').matches) this.player.play();
    this.tellState();
  }

  /// Original, decoded, and the error.
  async compare(original) {
    this.heat = await distances(original, this.shown);
    this.stage.put('error', this.shown.clip, heatMaterial(this.heat.top));
    for (const id of ['panes', 'legend', 'curve']) $(id).hidden = false;
    const unit = lengthText(1, this.shown.head).unit, most = this.heat.largest.reduce((a, b) => Math.max(a, b), 0);
    this.strip.errors(this.heat, `error, ${unit}: largest (up to ${lengthText(most, this.shown.head).text}) and mean`);
    this.legend(unit);
    this.setPanes(['original', 'decoded', 'error']);
    this.seek(this.player.time);
  }

  legend(unit) {
    const context = $('ramp').getContext('2d'), { top, largest } = this.heat;
    for (let i = 0; i < 256; ++i) {
      context.fillStyle = `rgb(${colourOf(i / 255)})`;
      context.fillRect(i, 0, 1, 1);
    }
    $('unit').textContent = `error, ${unit}`;
    const beyond = largest.some((d) => d > top);
    $('ticks').replaceChildren(...[0, 0.5, 1].map((share) => {
      const tick = Object.assign(document.createElement('span'), { textContent: `${share === 1 && beyond ? '≥ ' : ''}${+(share * top * lengthText(1, this.shown.head).scale).toPrecision(3)}` });
      tick.style.left = `${100 * share}%`;
      return tick;
    }));
  }

  say(error) {
    const shown = this.shown.clip ? ` ${this.shown.clip.head.frameCount} of ${this.shown.head.frameCount} frames are shown.` : '';
    const what = error.code === 3 ? 'damaged, or not all there; ' : '';
    $('message').textContent = `${this.item.name}: ${what}${error.message}.${shown}`.replace('..', '.');
    $('message').classList.toggle('aside', shown !== '');
    $('message').hidden = false;
    this.error = error;
  }

  seek(time) {
    this.stage.seek(time);
    if (this.heat) showHeat(this.shown.clip, this.heat, time);
    this.frame = this.strip.show(time);
    this.tellMark();
  }

  setPanes(panes) {
    this.stage.panes = panes;
    const chosen = panes.length > 1 ? 'all' : panes[0];
    for (const button of $('panes').children) button.setAttribute('aria-pressed', String(button.dataset.panes === chosen));
    this.label();
    $('stage').classList.toggle('several', panes.length > 1);
    $('legend').hidden = !this.heat || !panes.includes('error');
    if (this.framed) this.stage.home();
  }
  label() {
    const names = { original: `original: ${this.against?.name}`, decoded: this.item?.name, error: 'error' };
    $('labels').replaceChildren(...(this.stage.panes.length < 2 ? [] : this.stage.places().map(({ pane, x, y }) => {
      const label = Object.assign(document.createElement('span'), { textContent: names[pane] });
      Object.assign(label.style, { left: `${x + 10}px`, top: `${y + 8}px` });
      return label;
    })));
    const error = this.stage.places().find(({ pane }) => pane === 'error');
    if (error) Object.assign($('legend').style, { left: `${error.x + 8}px`, bottom: `${$('stage').clientHeight - error.y - error.height + 8}px` });
  }

  // What buttons and keys do.
  toggle() {
    if (!this.player) return;
    const { player } = this, atEnd = player.speed < 0 ? player.time <= 0 : player.time >= player.duration;
    if (!player.playing && player.loop === LoopOnce && atEnd) player.seek(player.speed < 0 ? player.duration : 0);
    if (player.playing) player.pause();
    else player.play();
    this.tellState();
  }
  setSpeed(speed) {
    this.speed = speed;
    if (this.player) this.player.speed = (this.player.speed < 0 ? -1 : 1) * speed;
  }
  reverse() {
    this.player?.reverse();
    this.tellState();
  }
  nextLoop() {
    this.loop = (this.loop + 1) % loops.length;
    if (this.player) this.player.loop = loops[this.loop][0];
    this.tellState();
  }
  step(frames) {
    if (!this.player) return;
    const { times, start } = this.shown.clip.timeline, f = Math.min(Math.max(this.frame + frames, 0), times.length - 1);
    this.player.pause().seek(times[f] - start);
    this.tellState();
  }
  nextUp() {
    this.up = axes[(axes.indexOf(this.up ?? this.shown.head.up) + 1) % 3];
    this.stage.turn(this.up);
    this.stage.frame(this.shown.clip);
    this.strip.pictures = 0;
  }
  tellState() {
    const playing = !!this.player?.playing, [, sign, name] = loops[this.loop];
    $('play').textContent = playing ? '❚❚' : '▶';
    $('play').setAttribute('aria-label', playing ? 'pause' : 'play');
    $('reverse').setAttribute('aria-pressed', String((this.player?.speed ?? 1) < 0));
    $('loop').textContent = sign;
    $('loop').setAttribute('aria-label', `repeat: ${name}`);
  }

  /// The path of the vertex under a point, in every pane that has it.
  pick(x, y) {
    const found = this.stage.pick(x, y), style = getComputedStyle(document.documentElement);
    for (const pane of ['decoded', 'original']) this.stage.unmark(pane);
    this.picked = null;
    if (found) {
      const { surface } = found.clip.head, vertex = surface.rowOf.indexOf(found.row);
      this.picked = { vertex, row: this.shown.clip.head.surface.rowOf[vertex] };
      this.stage.mark('decoded', this.shown.clip, this.picked.row, style.getPropertyValue('--mark').trim());
      const { clip } = this.original;
      if (clip) this.stage.mark('original', clip, clip.head.surface.rowOf[vertex], style.getPropertyValue('--line').trim());
    }
    this.tellMark();
  }
  tellMark() {
    $('tip').hidden = !this.picked;
    if (!this.picked) return;
    const { vertex, row } = this.picked, at = this.stage.marks.get('decoded').dot.geometry.attributes.position.array;
    let text = `vertex ${vertex}\n${[...at].map((x) => x.toPrecision(5)).join('  ')}`;
    if (this.heat) text += `\nerror ${lengthText(this.heat.values[this.frame * this.heat.rows + row], this.shown.head).text}`;
    $('tip').textContent = text;
  }

  /// For scripts and tests: where the graphics card puts the vertices of a pane, [3 V] as they are shown.
  readBack(pane = 'decoded') {
    this.stage.dirty = true;
    return readBack(this.stage.renderer, this.stage.meshes.get(pane), 0);
  }

  figures() {
    figures($('figures'), this);
  }

  /// Every frame of the screen.
  tick(now) {
    const seconds = Math.min(0.25, (now - (this.last ?? now)) / 1000);
    this.last = now;
    this.stage.controls.update();
    if (this.player?.playing) {
      this.player.update(seconds);
      this.frameTimes.push(1000 * seconds);
      if (this.frameTimes.length >= 20) (this.figures(), (this.frameTimes = []));
    }
    const drawn = this.whole && this.state !== 'loading' && this.strip.draw(this.stage, 'decoded');
    if (drawn || this.stage.dirty) this.stage.render();
  }
}

async function start() {
  let page = null;
  try {
    page = window.meshreel = new Page(await readManifest());
  } catch (error) {
    const why = /WebGL/i.test(error.message) ? 'This browser shows no WebGL 2, which the animation needs.' : error.message;
    Object.assign($('message'), { textContent: why, hidden: false });
    return;
  }
  controls(page);
  page.stage.renderer.setAnimationLoop((now) => page.tick(now));
  await page.open(page.manifest.items[0]);
}
start();
