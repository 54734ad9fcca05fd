// The legend of a field: its strips, the ends of its range, and what is hatched.
import { ramp, STRIPS } from './skin_view.js';
import { $, make } from './ui.js';

/** content: { low, high, hatch, note }, or null for none. */
export function drawLegend(content) {
  const box = $('legend');
  box.hidden = !content;
  if (!content) return;
  const { low, high, hatch, note } = content;
  // the strips of the body, with their colours
  const strips = Array.from({ length: STRIPS }, (_, i) => {
    const t = (i + 0.5) / STRIPS;
    const [a, b, part] = t < 0.5 ? [ramp[0], ramp[1], 2 * t] : [ramp[1], ramp[2], 2 * t - 1];
    const colour = `rgb(${a.map((x, k) => Math.round(255 * (x + part * (b[k] - x)) ** (1 / 2.2))).join(' ')})`;
    return `${colour} ${(100 * i) / STRIPS}% ${(100 * (i + 1)) / STRIPS}%`;
  }).join(', ');
  box.replaceChildren(
    make('div', { class: 'ramp', style: `background: linear-gradient(90deg, ${strips})` }),
    make(
      'div',
      { class: 'ends' },
      make('span', {}, low.toFixed(2)),
      make('span', {}, ((low + high) / 2).toFixed(2)),
      make('span', {}, high.toFixed(2)),
    ),
  );
  if (hatch) box.append(make('div', {}, make('span', { class: 'hatch' }), 'no site reaches it'));
  if (note) box.append(make('div', {}, note));
}
