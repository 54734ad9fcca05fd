// The card of help: what a finger or a mouse and keys do.
import { $, card, make, touched } from './ui.js';

export function help(app) {
  const rows = touched()
    ? [
        ['Turn', 'drag beside the body, or two fingers'],
        ['Zoom', 'pinch'],
        ['Pose', 'drag a dot; tap it for its rings; tap the body for a new one'],
        ['Field', 'tap the body for a site; drag it'],
        ['Detail', 'draw a loop around a part'],
        ['Stiffness', 'Stiffness brush in Pose or Field; draw on the body'],
      ]
    : [
        ['Turn', 'drag beside the body, right drag, or two fingers'],
        ['Zoom', 'wheel or pinch'],
        ['Move the view', 'middle drag, or Shift and drag'],
        ['Views', 'Home, F frames; 1, 3, 7 of the number pad or with Shift: front, side, top'],
        ['Handles and sites', 'Tab walks them, Enter chooses, arrows move, Delete removes'],
        ['Pose', '[ and ] turn a handle, P pins it, K sets a key'],
        ['Stiffness', 'B takes the brush and lays it down; Enter paints, [ and ] change its radius, E erases'],
        ['Undo, redo', 'Ctrl+Z, Ctrl+Shift+Z'],
        ['Save, open', 'Ctrl+S, Ctrl+O'],
        ['Tools', '1 to 6'],
      ];
  card(
    'hf studio',
    [
      make('p', {}, 'Drop a creature, pull its leg, save it. Nothing leaves your machine.'),
      make(
        'table',
        {},
        ...rows.map(([a, b]) => make('tr', {}, make('td', {}, make('strong', {}, a)), make('td', {}, b))),
      ),
    ],
    [
      ['Tour', () => app.skin && import('./tour.js').then(({ tour }) => tour(app), () => {})],
      ['Light or dark', () => $('theme').click()],
      ['Close', null, true],
    ],
  );
}
