// The views: buttons over the stage, and keys as in Blender.
import { $, button } from './ui.js';

const views = [
  ['home', 'Home', 'The whole body, as at first (Home; F keeps the direction)'],
  ['front', 'Front', 'From the front (1 of the number pad, or Shift+1)'],
  ['side', 'Side', 'From the side (3 of the number pad, or Shift+3)'],
  ['top', 'Top', 'From above (7 of the number pad, or Shift+7)'],
];
/** Digits of the upper row choose tools. With Shift they are those of the number pad, which many keyboards lack. */
const digits = { 1: 'front', 3: 'side', 7: 'top' };

const look = (app, side) => {
  app.view.look(side);
  app.frame();
};

export function viewButtons(app) {
  $('views').append(...views.map(([side, text, title]) => button(text, () => look(app, side), { id: `view-${side}`, title })));
}

/** True when the key was one of a view. */
export function viewKey(app, { key, code, shiftKey, target }) {
  const digit = /^Numpad\d$/.test(code) || (shiftKey && /^Digit\d$/.test(code)) ? code.at(-1) : null;
  if (digit) digits[digit] && look(app, digits[digit]);
  else if (key === 'Home' && target.type !== 'range') look(app, 'home');
  else if (key.toLowerCase() === 'f') app.frame();
  else return false;
  return true;
}
