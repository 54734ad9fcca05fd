// Small helpers for the panels: elements, sliders, facts, cards.
export const $ = (name) => document.getElementById(name);

/** An element: make('button', { class: 'main', onclick }, 'Text', child). */
export function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) element[name] = value;
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

export const button = (text, onclick, attributes = {}) =>
  make('button', { type: 'button', onclick, ...attributes }, text);

/** From the tool that is open to the stiffness brush, which leads back to it. */
export const brushButton = (app) =>
  button(
    'Stiffness brush',
    async () => {
      const home = app.tool.constructor.key;
      await app.need('brush').then((brush) => (brush.home = home), () => {}); // what does not come is said by use()
      await app.use('brush');
      $('done')?.focus({ preventScroll: true }); // who came by keys goes on there
    },
    { id: 'brush', title: 'B: paints where the body bends less, or more, than the rest' },
  );

/** A slider with its value beside the name; onmove while it moves, onset at its end. words: of a value. */
export function slider(
  name,
  { value, low, high, step = 0.01, digits = 2, id = null, disabled = false, words = (x) => Number(x).toFixed(digits) },
  onmove,
  onset = () => {},
) {
  const shown = make('span', {}, words(Number(value)));
  const said = { 'aria-valuetext': words(Number(value)) };
  const input = make('input', { type: 'range', min: low, max: high, step, value, id, disabled, ...said });
  input.oninput = () => {
    shown.textContent = words(Number(input.value));
    input.setAttribute('aria-valuetext', shown.textContent);
    onmove(Number(input.value));
  };
  input.onchange = () => onset(Number(input.value));
  return make('label', { class: 'slide' }, make('span', {}, name), shown, input);
}

export const facts = (rows) =>
  make(
    'dl',
    { class: 'facts' },
    ...rows.filter(Boolean).flatMap(([name, value]) => [make('dt', {}, name), make('dd', {}, String(value))]),
  );

export function choice(name, options, value, onchange, attributes = {}) {
  const select = make(
    'select',
    { 'aria-label': name, ...attributes },
    ...options.map(([key, text]) => make('option', { value: key, selected: String(key) === String(value) }, text)),
  );
  select.onchange = () => onchange(select.value);
  return select;
}

/** A card with a title, content and ways on. ways: [text, action, main]. */
export function card(title, content, ways) {
  const dialog = $('card');
  dialog.replaceChildren(
    make('h2', { id: 'card-title' }, title),
    ...content,
    make(
      'div',
      { class: 'row' },
      ...ways.map(([text, action, main]) =>
        button(text, () => (dialog.close(), action?.()), main ? { class: 'main' } : {}),
      ),
    ),
  );
  if (!dialog.open) dialog.showModal();
  return dialog;
}

/** A message goes after so many milliseconds and some more for each letter: 17 letters a second, the pace of subtitles. */
const [SAID_MS, LETTER_MS] = [4000, 60];
let goes = 0;
/** stays: until the next message. */
export function say(text, { stays = false } = {}) {
  $('told').textContent = text;
  clearTimeout(goes);
  if (text && !stays) goes = setTimeout(() => say(''), SAID_MS + LETTER_MS * text.length);
}
export const whole = (number) => Math.round(number).toLocaleString('en');
/** A time that a person reads: 4.2 ms, 236 ms, 4.1 s. */
export const ms = (number) =>
  number < 10
    ? `${number.toFixed(1)} ms`
    : number < 1000
      ? `${Math.round(number)} ms`
      : `${(number / 1000).toFixed(1)} s`;
/** Fingers instead of a mouse: nothing can be hovered over. */
export const touched = () => matchMedia('(hover: none)').matches;

export function download(data, name, type) {
  const link = make('a', {
    href: URL.createObjectURL(data instanceof Blob ? data : new Blob([data], { type })),
    download: name,
  });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
