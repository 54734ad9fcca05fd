// The views: buttons over the stage, and keys as in Blender. A digit is the place of its key (event.code): with the French
// keyboard a digit of the upper row is typed with Shift.
import { $, button } from './ui.js';

const views = [
  ['home', 'Home', 'The whole body, as at first (Home; F keeps the direction)'],
  ['front', 'Front', 'From the front (1 of the number pad, or Shift+1)'],
  ['side', 'Side', 'From the side (3 of the number pad, or Shift+3)'],
  ['top', 'Top', 'From above (7 of the number pad, or Shift+7)'],
];
/** Digits of the upper row choose tools (toolKey). With Shift they are those of the number pad, which many keyboards lack. */
const digits = { 1: 'front', 3: 'side', 7: 'top' };

const look = (app, side) => {
  app.view.look(side);
  app.frame();
};

export function viewButtons(app) {
  $('views').append(...views.map(([side, text, title]) => button(text, () => look(app, side), { id: `view-${side}`, title })));
}

/** True when the key was one of a view. A slider keeps the keys that move it: without NumLock the number pad has those too. */
export function viewKey(app, { key, code, shiftKey, target }) {
  if (target.type === 'range' && /^(Arrow|Page|Home|End)/.test(key)) return false;
  const side = /^Numpad\d$/.test(code) || (shiftKey && /^Digit\d$/.test(code)) ? digits[code.at(-1)] : null;
  if (side) look(app, side);
  else if (key === 'Home') look(app, 'home');
  else if (key.toLowerCase() === 'f') app.frame();
  else return false;
  return true;
}

/** The number of the tool that a key chooses, from 0 on; or null. */
export function toolKey({ code, key, shiftKey }) {
  if (shiftKey || /^Numpad/.test(code)) return null;
  const digit = /^Digit([1-6])$/.exec(code)?.[1] ?? /^[1-6]$/.exec(key)?.[0];
  return digit ? Number(digit) - 1 : null;
}
