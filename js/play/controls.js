/// Buttons, keys, pointers, colours and the size of the window.
// SPDX-License-Identifier: MIT
import { $ } from './element.js';

const option = (value, text) => Object.assign(document.createElement('option'), { value, textContent: text });

function choose(page) {
  const { items } = page.manifest;
  $('file').replaceChildren(...items.map((item, i) => option(i, item.name)));
  $('file-field').hidden = items.length < 2;
  const levels = (item) => {
    const count = item.original ? 1 : item.levels ?? 1;
    $('level').replaceChildren(...Array.from({ length: count }, (_, i) => option(i, i === 0 ? 'all' : `level ${i}`)));
    $('level-field').hidden = count < 2;
  };
  levels(items[0]);
  $('file').onchange = () => (levels(items[$('file').value]), page.open(items[$('file').value]));
  $('level').onchange = () => page.open(page.item, Number($('level').value));
}

function look(page, name) {
  const next = page.stage.look === name ? 'shaded' : name;
  for (const button of $('look').children) button.setAttribute('aria-pressed', String(button.dataset.look === next));
  page.stage.wear(next);
  page.strip.pictures = 0;
}

function flip(button, box) {
  $(box).hidden = !$(box).hidden;
  $(button).setAttribute('aria-expanded', String(!$(box).hidden));
}

function theme(page, dark) {
  document.documentElement.dataset.theme = dark ? 'dark' : 'light';
  if (page.shown.head) page.strip.again(page.pieces, page.shown.head.frameCount);
  page.stage.dirty = true;
}

function buttons(page) {
  const dark = () => document.documentElement.dataset.theme === 'dark';
  $('play').onclick = () => page.toggle();
  $('reverse').onclick = () => page.reverse();
  $('loop').onclick = () => page.nextLoop();
  $('speed').onchange = () => page.setSpeed(Number($('speed').value));
  $('theme').onclick = () => theme(page, !dark());
  $('facts').onclick = () => flip('facts', 'statistics');
  $('help').onclick = () => flip('help', 'keys');
  $('look').onclick = ({ target }) => target.dataset.look && look(page, target.dataset.look === 'shaded' ? page.stage.look : target.dataset.look);
  $('panes').onclick = ({ target: { dataset: { panes } } }) => panes && page.setPanes(panes === 'all' ? ['original', 'decoded', 'error'] : [panes]);
  let resumes = false;
  $('seek').oninput = () => page.player?.seek(Number($('seek').value));
  $('seek').onpointerdown = () => ((resumes = page.player?.playing), page.player?.pause(), page.tellState());
  $('seek').onpointerup = $('seek').onpointercancel = () => (resumes && page.player?.play(), (resumes = false), page.tellState());
}

function faster(page, by) {
  const { options, selectedIndex } = $('speed');
  $('speed').selectedIndex = Math.min(Math.max(selectedIndex + by, 0), options.length - 1);
  page.setSpeed(Number($('speed').value));
}

function keys(page) {
  const ends = (last) => (page.step(last ? Infinity : -Infinity));
  const does = {
    ' ': () => page.toggle(), ArrowLeft: (e) => page.step(e.shiftKey ? -10 : -1), ArrowRight: (e) => page.step(e.shiftKey ? 10 : 1),
    Home: () => ends(false), End: () => ends(true), r: () => page.reverse(), l: () => page.nextLoop(), '+': () => faster(page, 1), '=': () => faster(page, 1),
    '-': () => faster(page, -1), w: () => look(page, 'wire'), n: () => look(page, 'normals'), u: () => page.nextUp(), 0: () => page.stage.home(),
    i: () => $('facts').click(), d: () => $('theme').click(), '?': () => $('help').click(),
    f: () => (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen()),
    Escape: () => ($('keys').hidden ? page.pick(-1, -1) : $('help').click()),
  };
  addEventListener('keydown', (event) => {
    const { key, target } = event, run = does[key.length === 1 ? key.toLowerCase() : key];
    if (!run || event.ctrlKey || event.metaKey || event.altKey || target.tagName === 'SELECT') return;
    if (key === ' ' && target.tagName === 'BUTTON') return; // it presses the button
    event.preventDefault();
    run(event);
  });
}

/// A press that does not move picks a vertex.
function pointers(page) {
  const view = $('view');
  let down = null;
  view.addEventListener('pointerdown', ({ offsetX, offsetY, isPrimary }) => (down = isPrimary ? [offsetX, offsetY] : null));
  view.addEventListener('pointerup', ({ offsetX, offsetY }) => {
    if (down && Math.hypot(offsetX - down[0], offsetY - down[1]) < 4 && page.shown.clip) page.pick(offsetX, offsetY);
    down = null;
  });
}

export function controls(page) {
  choose(page);
  buttons(page);
  keys(page);
  pointers(page);
  const wish = matchMedia('(prefers-color-scheme: dark)');
  theme(page, wish.matches);
  wish.addEventListener('change', () => theme(page, wish.matches));
  if (matchMedia('(max-width: 700px)').matches) flip('facts', 'statistics');
  new ResizeObserver(() => {
    page.label();
    if (page.framed) page.stage.home();
    if (page.shown.head) page.strip.again(page.pieces, page.shown.head.frameCount);
    page.stage.dirty = true;
  }).observe($('stage'));
}
