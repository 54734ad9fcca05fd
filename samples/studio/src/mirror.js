// Mirrored handles: a plane across the middle of the body, images of places, steps and turns, and the twin of a handle.
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineLoop, Quaternion } from 'three';
import { choice } from './ui.js';

const options = [
  ['', 'no mirror'],
  [0, 'mirror in x'],
  [1, 'mirror in y'],
  [2, 'mirror in z'],
];

export const mirrorChoice = (value, onchange, attributes) =>
  choice('Mirror', options, value, (axis) => onchange(axis === '' ? '' : Number(axis)), {
    id: 'mirror',
    ...attributes,
  });

/** Where the plane across the middle of a body meets its axis. */
export function middleOf({ positions, triangles }, axis) {
  let [low, high] = [Infinity, -Infinity];
  for (const v of triangles) {
    low = Math.min(low, positions[3 * v + axis]);
    high = Math.max(high, positions[3 * v + axis]);
  }
  return (low + high) / 2;
}

const imageOfStep = (step, axis) => step.map((x, k) => (k === axis ? -x : x));
const imageOfPlace = (place, axis, middle) => place.map((x, k) => (k === axis ? 2 * middle - x : x));
/** The image of a turn: its axis keeps what lies along the normal of the plane, and changes the sign of the rest. */
const imageOfTurn = ({ x, y, z, w }, axis) =>
  new Quaternion(...[x, y, z].map((part, k) => (k === axis ? part : -part)), w);

/** Of a step and a turn what leaves the plane in place: for a handle in the middle of the body. */
const inPlane = (step, axis) => step.map((x, k) => (k === axis ? 0 : x));
const aboutNormal = (turn, axis) => {
  const parts = [turn.x, turn.y, turn.z].map((part, k) => (k === axis ? part : 0));
  return new Quaternion(...parts, turn.w).normalize();
};

/** A handle so near to the plane that its image would overlap it. */
const inMiddle = ({ position, radius }, axis, middle) => Math.abs(position[axis] - middle) < radius;

/** The handle of a list whose sphere holds the image of a handle's middle, the nearest; or null. */
function twinOf(handle, handles, axis, middle) {
  const image = imageOfPlace(handle.position, axis, middle);
  let [least, twin] = [Infinity, null];
  for (const other of handles) {
    const away = Math.hypot(...image.map((x, k) => x - other.position[k]));
    if (other.id !== handle.id && away < other.radius && away < least) [least, twin] = [away, other];
  }
  return twin;
}

/** The vertex of a triangle nearest to a place, and how far it is. */
function nearestVertex({ positions, triangles }, place) {
  let [least, vertex] = [Infinity, 0];
  for (const v of triangles) {
    const away = [0, 1, 2].reduce((sum, k) => sum + (positions[3 * v + k] - place[k]) ** 2, 0);
    if (away < least || (away === least && v < vertex)) [least, vertex] = [away, v];
  }
  return { vertex, away: Math.sqrt(least) };
}

/** A handle moved by a step, which frees its rotation, or turned by a quaternion, which gives it. */
function shifted(handle, step, turn) {
  const translation = handle.translation.map((t, k) => t + step[k]);
  if (!turn) return { ...handle, pinned: false, free: true, translation };
  const rotation = turn
    .clone()
    .multiply(new Quaternion(...handle.rotation))
    .normalize()
    .toArray();
  return { ...handle, pinned: false, free: false, rotation, translation };
}

/** The mirror of the Pose tool, and its plane in the picture. axis: 0 to 2, or '' for none. */
export class Mirror {
  constructor(app) {
    this.app = app;
    this.axis = '';
    this.frame = new LineLoop(
      new BufferGeometry(),
      new LineBasicMaterial({ color: 0x3b6ea8, transparent: true, opacity: 0.7 }),
    );
    this.frame.frustumCulled = false;
    this.shown = false;
    app.view.extras.add(this.frame);
  }
  opened() {
    this.set(this.axis);
  }
  set(axis) {
    this.axis = axis;
    const { body } = this.app;
    if (axis !== '' && body) {
      this.middle = middleOf(body, axis);
      const { min, max } = this.app.skin.box(body.positions);
      const [low, high] = [min.toArray(), max.toArray()];
      const [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
      const corners = [
        [low[u], low[v]],
        [high[u], low[v]],
        [high[u], high[v]],
        [low[u], high[v]],
      ].flatMap(([a, b]) => {
        const corner = [0, 0, 0];
        [corner[axis], corner[u], corner[v]] = [this.middle, a, b];
        return corner;
      });
      this.frame.geometry.dispose();
      this.frame.geometry = new BufferGeometry().setAttribute(
        'position',
        new BufferAttribute(Float32Array.from(corners), 3),
      );
    }
    this.show(this.shown);
  }
  show(shown) {
    this.shown = shown;
    this.frame.visible = shown && this.axis !== '';
    this.app.view.draw();
  }
  /** The handle that mirrors another, or null. */
  twin(handle, handles) {
    const { axis, middle } = this;
    return axis === '' || inMiddle(handle, axis, middle) ? null : twinOf(handle, handles, axis, middle);
  }
  /** The handles with one moved and turned, and its twin the other way. One in the middle stays there. */
  moved(handles, id, step, turn = null) {
    const { axis, middle } = this;
    const handle = handles.find((other) => other.id === id);
    const twin = this.twin(handle, handles);
    const held = axis !== '' && inMiddle(handle, axis, middle);
    const moved = held
      ? shifted(handle, inPlane(step, axis), turn && aboutNormal(turn, axis))
      : shifted(handle, step, turn);
    return handles.map((other) => {
      if (other.id === id) return moved;
      if (other !== twin) return other;
      const image = shifted(other, imageOfStep(step, axis), turn && imageOfTurn(turn, axis));
      // a rotation that was free is given as the image of the handle's, so that both go on as one
      return turn && handle.free
        ? { ...image, rotation: imageOfTurn(new Quaternion(...moved.rotation), axis).toArray() }
        : image;
    });
  }
  /**
   * Handles that are added, with their twins: those that are there or are proposed, or new ones (made by `fresh`). alone: the
   * id of one that gets none, because the body has no surface at its image.
   */
  withTwins(added, handles, offers, fresh) {
    this.alone = null;
    const { axis, middle } = this;
    if (axis === '') return added;
    const { body } = this.app;
    const all = added.slice();
    for (const handle of added) {
      if (inMiddle(handle, axis, middle) || this.twin(handle, [...handles, ...all])) continue;
      const offer = this.twin(handle, offers);
      if (offer) {
        all.push({ ...offer, pinned: false });
        continue;
      }
      const position = imageOfPlace(handle.position, axis, middle);
      const { vertex, away } = nearestVertex(body, position);
      if (away < handle.radius) all.push(fresh({ ...handle, position, vertex }));
      else this.alone = handle.id;
    }
    return all;
  }
}
