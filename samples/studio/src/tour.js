// The tour for who comes first: three acts on the body that is open. It comes once, can be skipped, and is in the help.

const KEPT = 'hf-studio-tour';
/** Whether an act is done is looked for every so many milliseconds: not seen as a wait, and no work. */
const LOOK_MS = 200;
/** Radians of turning that are a turn of the view: 17 degrees. A slip of the hand is less. */
const TURNED = 0.3;

/** [title, sentence, what is true before, whether it is done] */
const steps = [
  [
    'Pull',
    'Pull the dot that says "pull me". The body follows. Its feet stay in place.',
    (app) => app.history.past.length,
    (app, before) => app.history.past.length > before && !app.live,
  ],
  [
    'Turn',
    'Turn the view: drag beside the body. Home brings it back.',
    ({ view }) => view.turn,
    ({ view }, before) => Math.abs(view.turn - before) > TURNED,
  ],
  [
    'Field',
    'Open Field and click the body: a value spreads over it from there. A second site makes a blend.',
    (app) => app.state.sites.length,
    (app, before) => app.state.sites.length > before,
  ],
];

/** True once for a browser. One that keeps nothing has no tour: it would come at every start. */
export function first() {
  try {
    if (localStorage.getItem(KEPT)) return false;
    localStorage.setItem(KEPT, 'shown');
    return true;
  } catch {
    return false;
  }
}

export function tour(app) {
  const { $, button, make } = app.ui;
  $('tour')?.remove();
  const box = make('section', { id: 'tour', 'aria-label': 'Tour' });
  $('stage').append(box);
  let timer = 0;
  const end = () => {
    clearInterval(timer);
    $('tool-field').classList.remove('here');
    box.remove();
  };
  const show = (number) => {
    clearInterval(timer);
    $('tool-field').classList.toggle('here', number === 2);
    if (number === steps.length) {
      const text = 'The other tools work like this. The question mark has all keys, and this tour.';
      box.replaceChildren(make('p', { role: 'status' }, make('strong', {}, 'That is all. '), text), button('Close', end, { class: 'main', id: 'tour-end' }));
      return;
    }
    const [title, text, beforeOf, done] = steps[number];
    const before = beforeOf(app);
    box.replaceChildren(
      make('p', { role: 'status' }, make('strong', {}, `${number + 1} of ${steps.length}: ${title}. `), text),
      button('Skip the tour', end, { id: 'tour-skip' }),
      button('Next', () => show(number + 1), { id: 'tour-next' }),
    );
    timer = setInterval(() => (box.isConnected ? done(app, before) && show(number + 1) : end()), LOOK_MS);
  };
  show(0);
}
