// The sheet of the Weights tool.

function testRows({ button, lengthOf, make, slider }, tool) {
  const { bend, app, shown } = tool;
  if (!tool.present()) return [];
  const clip = tool.of === 'file' && app.timeline.clip;
  return [
    make('h3', {}, 'Test'),
    make(
      'p',
      {},
      shown === 'all'
        ? 'Click a bone to bend it. The test changes nothing.'
        : 'Turn the bone by its rings or the slider: the skin follows.',
    ),
    shown !== 'all' &&
      slider(
        'Turn the bone, degrees',
        { value: bend.degrees, low: -120, high: 120, step: 5, digits: 0, id: 'bend', disabled: Boolean(bend.clip) },
        (value) => bend.slide(value),
        () => app.panel(),
      ),
    make(
      'div',
      { class: 'row' },
      clip &&
        button(
          bend.clip ? 'Stop the clip' : 'Play the clip',
          () => (bend.clip ? bend.rest() : bend.play(clip, lengthOf(clip))),
          { id: 'test-clip' },
        ),
      button('Rest', () => bend.rest(), { id: 'test-rest', disabled: !bend.active }),
    ),
  ];
}

export function weightsSheet(kit, tool) {
  const { button, choice, facts, make, ms, touched, whole } = kit;
  const { result, app } = tool;
  const info = result?.info;
  const guessed = info && info.rigidCount + info.isolatedCount;
  const own = tool.fileBones.joints.length > 0;
  const lost = !result && tool.of === 'file' && own ? tool.present().lost : 0;
  const source = own
    ? choice(
        'Bones',
        [
          ['file', 'bones of the file'],
          ['handles', 'the handles as bones'],
        ],
        tool.of,
        (value) => {
          tool.of = value;
          tool.clear();
          tool.dress();
          tool.bend.show();
          app.refresh();
        },
        { id: 'bones-of', disabled: tool.busy },
      )
    : make('p', {}, 'This file has no bones: the handles of Pose are the bones.');
  if (!tool.bones.names.length) return [source, make('p', {}, 'Add handles in Pose first: each becomes a bone.')];
  return [
    make(
      'p',
      {},
      result
        ? `Computed from the bones.${touched() ? '' : ' Hover over the body to read a vertex.'}`
        : tool.of === 'file'
          ? 'These are the weights of the file. Compute new ones from its bones.'
          : 'Compute weights: each handle is a bone.',
    ),
    source,
    make(
      'div',
      { class: 'row' },
      button(tool.busy ? 'Computing' : 'Compute weights', () => tool.compute(), {
        class: 'main',
        id: 'compute',
        disabled: tool.busy,
      }),
      tool.of === 'file' &&
        button(
          'Weights of the file',
          () => {
            tool.result = null;
            tool.dress();
            tool.bend.show();
            app.refresh();
          },
          { id: 'file-weights', disabled: !result },
        ),
    ),
    choice(
      'Bones for each vertex',
      [
        [4, '4 bones for each vertex'],
        [8, '8 bones for each vertex'],
      ],
      tool.influenceCount,
      (value) => {
        tool.influenceCount = Number(value);
        if (result) return tool.compute();
        tool.dress();
        tool.bend.show();
        return app.refresh();
      },
      { id: 'weight-count', disabled: tool.busy },
    ),
    choice(
      'Bone to show',
      [['all', 'all bones, each its colour'], ...tool.bones.names.map((name, i) => [i, name])],
      tool.shown,
      (value) => tool.look(value),
      { id: 'bone' },
    ),
    make(
      'p',
      {},
      tool.shown === 'all'
        ? 'Click a bone to see its weights and to pin places to it.'
        : 'Click the body beside the bones: the place belongs to this bone, and the weights follow.',
    ),
    tool.pins.length > 0 && button('Remove all pins', () => tool.unpin(), { id: 'no-pins', disabled: tool.busy }),
    tool.error && make('p', { class: 'warn' }, tool.error),
    guessed > 0 &&
      make(
        'p',
        { class: 'warn' },
        `${whole(guessed)} vertices take their weights from the nearest part: no bone is near them.`,
      ),
    lost > 0 &&
      make('p', { class: 'warn' }, `Fewer bones: a vertex loses at most ${(100 * lost).toFixed(1)} % of its weight.`),
    ...testRows(kit, tool),
    facts([
      ['bones', tool.bones.names.length],
      tool.pins.length > 0 && ['pins', tool.pins.length],
      result && ['time', ms(result.milliseconds)],
      info && ['vertices with their bone in sight', whole(info.informedCount)],
      info && info.outsideCount > 0 && ['bones outside the skin', info.outsideCount],
    ]),
  ];
}
