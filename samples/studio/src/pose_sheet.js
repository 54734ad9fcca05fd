// The sheet of Pose: what the chosen handle does, what all do, and what the file and the library say.
import { mirrorChoice } from './mirror.js';
import { brushButton, button, facts, make, ms, slider, whole } from './ui.js';

/** Gaps between pieces below this part of the box are not said: 3 pixels of a body that fills the picture. */
const GAP_SAID = 0.005;

/** A handle that moves nothing. */
export const rest = { rotation: [0, 0, 0, 1], translation: [0, 0, 0], free: false };

export function poseSheet(tool) {
  const { app } = tool;
  const handle = tool.present();
  const moved = tool.posed();
  const unreached = app.told?.unreachedVertexCount ?? 0;
  const waiting = tool.offers.filter(({ id }) => !tool.handles.some((other) => other.id === id));
  return [
    make(
      'p',
      {},
      handle
        ? `${handle.label}: drag it, or turn it by its rings.${tool.twin() ? ` ${tool.twin().label} mirrors it.` : ''}`
        : 'Drag a dot: squares hold, circles move. Click the body for a new handle.',
    ),
    handle &&
      make(
        'div',
        { class: 'row' },
        button(handle.pinned ? 'Unpin' : 'Pin', () => tool.pin(handle), {
          id: 'pin',
          'aria-pressed': String(handle.pinned),
        }),
        button('Back to rest', () => app.commit(tool.with(handle.id, rest), 'back to rest'), { id: 'back' }),
        button('Remove', () => tool.remove(handle), { id: 'remove' }),
        button('Keep limb lengths', () => app.commit(tool.with(handle.id, { limb: !handle.limb }), 'keep the limb'), {
          id: 'limb',
          'aria-pressed': String(Boolean(handle.limb)),
          title: 'The limb of this handle keeps its lengths and bends like two bones; the body stays as it is',
        }),
      ),
    handle &&
      slider(
        'How much follows',
        { value: handle.following ?? 1, low: 0, high: 1, step: 0.05, id: 'follows' },
        (following) => app.preview(tool.with(handle.id, { following })),
        // other poses of least energy can be near: the one that an undo and a saved session show
        () => app.commitPreview('how much follows').then(() => app.again()),
      ),
    make(
      'div',
      { class: 'row' },
      button('Add all proposed', () => tool.addAll(waiting, 'add handles'), {
        id: 'propose',
        disabled: !waiting.length,
      }),
      button(
        'Rest pose',
        () =>
          app.commit({ ...app.state, handles: tool.handles.map((other) => ({ ...other, ...rest })) }, 'rest pose'),
        { id: 'rest', disabled: !moved },
      ),
      button(
        'Ghost',
        () => {
          tool.ghost = !tool.ghost;
          app.refresh();
        },
        {
          id: 'ghost',
          'aria-pressed': String(tool.ghost),
          disabled: !moved,
          title: 'Shows the body at rest around the pose',
        },
      ),
      button('Keep lengths', () => app.commit({ ...app.state, lengths: !app.state.lengths }, 'keep lengths'), {
        id: 'lengths',
        'aria-pressed': String(Boolean(app.state.lengths)),
        title: 'Limbs keep their length and thickness; bends get sharper, and a pose takes longer',
      }),
      brushButton(app),
    ),
    mirrorChoice(tool.mirror.axis, (axis) => {
      tool.mirror.set(axis);
      app.refresh();
    }),
    slider(
      'Size of a new handle',
      { value: tool.radius, low: 0.01, high: 0.15, step: 0.005, digits: 3, id: 'radius' },
      (value) => (tool.radius = value),
    ),
    unreached > 0 &&
      tool.handles.length > 0 &&
      make(
        'p',
        { class: 'warn' },
        `${whole(unreached)} vertices belong to pieces without a handle; they stay where they are.`,
      ),
    app.body.notes.length > 0 && make('p', {}, `Of the file: ${app.body.notes.join('; ')}.`),
    app.told?.gap > GAP_SAID &&
      make('p', { class: 'warn' }, `Linked pieces are up to ${(100 * app.told.gap).toFixed(1)} % of the box apart.`),
    facts([
      ['handles', tool.handles.length],
      app.told && [app.told.added ? 'a handle more' : 'pose', ms(app.told.milliseconds)],
    ]),
  ];
}
