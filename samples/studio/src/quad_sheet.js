// The sheet of Quads: how many, creases, a mirror, strokes and poles, and what was made.

/** What the slider offers, as powers of two: 500 to 16,000 or so. */
const [LOW, HIGH] = [9, 14];

/** Two digits: 'about 2,000' says what is known before. */
export const rounded = (count) => Number(count.toPrecision(2));

export function quadSheet({ button, facts, make, mirrorChoice, ms, slider, whole }, tool) {
  const { app, result, busy } = tool;
  const disabled = Boolean(busy);
  return [
    make(
      'p',
      {},
      tool.drawing
        ? 'Draw on the body: edges follow the stroke. Drag its dot, and the quads follow.'
        : tool.placing
          ? `Click on the body: ${tool.placing} quads meet there. Drag the dot, and the quads follow.`
          : 'Covers the body with quads that follow its shape. More quads take longer.',
    ),
    make(
      'div',
      { class: 'row' },
      button('Make quads', () => tool.run(), { class: 'main', id: 'make', disabled }),
      busy && button('Cancel', () => tool.cancel(), { id: 'cancel' }),
    ),
    busy &&
      make(
        'div',
        { class: 'row', role: 'status' },
        make('progress', { 'aria-label': 'making quads' }),
        make('span', { id: 'quads-clock' }, '0 s'),
        result && make('span', {}, 'The quads are evened out and fitted now.'),
      ),
    tool.error && make('p', { class: 'warn' }, tool.error),
    slider(
      'Quads',
      {
        value: Math.log2(tool.count),
        low: LOW,
        high: HIGH,
        step: 0.05,
        id: 'count',
        disabled,
        words: (power) => `about ${whole(rounded(2 ** power))}`,
      },
      (power) => (tool.count = rounded(2 ** power)),
    ),
    slider(
      'Creases from, degrees',
      { value: tool.crease, low: 0, high: 180, step: 5, digits: 0, id: 'crease', disabled },
      (value) => (tool.crease = value),
    ),
    mirrorChoice(tool.mirror, (value) => (tool.mirror = value), { disabled }),
    make(
      'div',
      { class: 'row' },
      button(
        'Draw strokes',
        () => {
          tool.drawing = !tool.drawing;
          tool.placing = 0;
          app.refresh();
        },
        { id: 'draw', 'aria-pressed': String(Boolean(tool.drawing)), disabled },
      ),
      tool.strokes.length > 0 &&
        button('Remove strokes', () => tool.set({ strokes: [] }, 'remove all strokes'), { id: 'clear', disabled }),
    ),
    make(
      'div',
      { class: 'row' },
      ...[3, 5].map((quads) =>
        button(
          `Pole of ${quads}`,
          () => {
            tool.placing = tool.placing === quads ? 0 : quads;
            tool.drawing = false;
            app.refresh();
          },
          { id: `pole-${quads}`, 'aria-pressed': String(tool.placing === quads), disabled },
        ),
      ),
      tool.poles.length > 0 &&
        button('Remove poles', () => tool.set({ poles: [] }, 'remove all poles'), { id: 'clear-poles', disabled }),
    ),
    result &&
      facts([
        ['quads', whole(result.info.faceCount)],
        ['corners', whole(result.info.vertexCount)],
        ['edge', result.info.edgeLength.toPrecision(3)],
        ['time', ms(result.milliseconds)],
      ]),
  ];
}
