// The legend of a field: its strips, the ends of its range, and what is hatched.
import { ramp, STRIPS } from './skin_view.js';
import { $, make } from './ui.js';

/** The colour at a part of the range, 0 to 1, in linear light. */
export function colourAt(t) {
  const [a, b, part] = t < 0.5 ? [ramp[0], ramp[1], 2 * t] : [ramp[1], ramp[2], 2 * t - 1];
  return a.map((x, k) => x + part * (b[k] - x));
}

/** content: { low, high, hatch, note }, or { words, strips, note } with the words below, or null for none. */
export function drawLegend(content) {
  const box = $('legend');
  box.hidden = !content;
  if (!content) return;
  const { low, high, hatch, note, strips: count = STRIPS } = content;
  const words = content.words ?? [low, (low + high) / 2, high].map((x) => x.toFixed(2));
  // the strips of the body, with their colours
  const strips = Array.from({ length: count }, (_, i) => {
    const colour = `rgb(${colourAt((i + 0.5) / count).map((x) => Math.round(255 * x ** (1 / 2.2))).join(' ')})`;
    return `${colour} ${(100 * i) / count}% ${(100 * (i + 1)) / count}%`;
  }).join(', ');
  box.replaceChildren(
    make('div', { class: 'ramp', style: `background: linear-gradient(90deg, ${strips})` }),
    make('div', { class: 'ends' }, ...words.map((word) => make('span', {}, word))),
  );
  if (hatch) box.append(make('div', {}, make('span', { class: 'hatch' }), 'no site reaches it'));
  if (note) box.append(make('div', {}, note));
}
