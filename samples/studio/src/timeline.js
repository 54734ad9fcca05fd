// The clips of a file, played on the processor: every vertex moves by its joints, or with its node. The pose made by
// handles is played under the clip, because it is a change of the shape at rest.
import { Matrix4, Quaternion, Vector3 } from 'three';
import { blendMatrices, jointMatrices } from './model.js';
import { normalGroups, normalSums, smoothNormals } from './normals.js';
import { blended, keyNear, withKey } from './keys.js';
import { $, button, choice, make } from './ui.js';

/** Seconds of a timeline without a clip: of a step or a nod. Keys cannot be set beyond. */
const KEY_SECONDS = 2;

/** The value of a sampler at a time: steps, lines (quaternions along the arc), or cubic splines. */
function sampled(sampler, time, isTurn) {
  const [times, values] = [sampler.getInput(), sampler.getOutput()];
  const count = times.getCount();
  const cubic = sampler.getInterpolation() === 'CUBICSPLINE';
  const at = (i) => values.getElement(cubic ? 3 * i + 1 : i, []);
  let i = 0;
  while (i + 1 < count && times.getScalar(i + 1) <= time) ++i;
  if (i + 1 >= count || time <= times.getScalar(0) || sampler.getInterpolation() === 'STEP') return at(i);
  const [t0, t1] = [times.getScalar(i), times.getScalar(i + 1)];
  const [a, b, t] = [at(i), at(i + 1), (time - t0) / (t1 - t0)];
  if (cubic) {
    const [out, into] = [values.getElement(3 * i + 2, []), values.getElement(3 * i + 3, [])];
    const [t2, t3, step] = [t * t, t * t * t, t1 - t0];
    return a.map(
      (x, k) =>
        (2 * t3 - 3 * t2 + 1) * x +
        step * (t3 - 2 * t2 + t) * out[k] +
        (3 * t2 - 2 * t3) * b[k] +
        step * (t3 - t2) * into[k],
    );
  }
  if (isTurn) return new Quaternion(...a).slerp(new Quaternion(...b), t).toArray();
  return a.map((x, k) => x + t * (b[k] - x));
}

export const lengthOf = (clip) =>
  Math.max(0, ...clip.listSamplers().map((sampler) => sampler.getInput()?.getMax([])[0] ?? 0));

/** World matrices of all nodes at a time of a clip. */
export function worldsAt(body, clip, time) {
  const changed = new Map();
  for (const channel of clip.listChannels()) {
    const node = channel.getTargetNode();
    const path = channel.getTargetPath();
    if (!node || !['translation', 'rotation', 'scale'].includes(path)) continue;
    if (!changed.has(node)) changed.set(node, {});
    changed.get(node)[path] = sampled(channel.getSampler(), time, path === 'rotation');
  }
  const worlds = new Map();
  const worldOf = (node) => {
    if (worlds.has(node)) return worlds.get(node);
    const {
      translation = node.getTranslation(),
      rotation = node.getRotation(),
      scale = node.getScale(),
    } = changed.get(node) ?? {};
    const local = new Matrix4().compose(
      new Vector3(...translation),
      new Quaternion(...rotation).normalize(),
      new Vector3(...scale),
    );
    const above = node.getParentNode();
    const world = above ? worldOf(above).clone().multiply(local) : local;
    worlds.set(node, world);
    return world;
  };
  return worldOf;
}

/** Where the vertices of a shape (in the frame of the scene, at rest) are in the frame of their primitives. */
export function localsOf(body, shape, out = null) {
  out ??= new Float64Array(shape.length);
  const matrix = new Matrix4();
  for (const part of body.parts) {
    if (!part.inverses) {
      // kept: keys ask for them in every frame
      part.inverses = new Float64Array(part.matrices.length);
      for (let m = 0; m < part.matrices.length; m += 16)
        matrix.fromArray(part.matrices, m).invert().toArray(part.inverses, m);
    }
    const { inverses } = part;
    for (let v = 0; v < part.count; ++v) {
      const [at, m] = [3 * (part.first + v), part.skin ? 16 * v : 0];
      for (let k = 0; k < 3; ++k)
        out[at + k] =
          inverses[m + k] * shape[at] +
          inverses[m + 4 + k] * shape[at + 1] +
          inverses[m + 8 + k] * shape[at + 2] +
          inverses[m + 12 + k];
    }
  }
  return out;
}

/** The vertices at a time of a clip, from their places in the frame of their primitives. */
export function playedAt(body, clip, time, locals, out) {
  const worldOf = worldsAt(body, clip, time);
  for (const part of body.parts) {
    let matrices = null;
    if (part.skin) {
      part.played ??= new Float64Array(16 * part.count);
      matrices = blendMatrices(part, jointMatrices(part.skin, worldOf), part.played);
    } else matrices = worldOf(part.node).elements;
    for (let v = 0; v < part.count; ++v) {
      const [at, m] = [3 * (part.first + v), part.skin ? 16 * v : 0];
      for (let k = 0; k < 3; ++k)
        out[at + k] =
          matrices[m + k] * locals[at] +
          matrices[m + 4 + k] * locals[at + 1] +
          matrices[m + 8 + k] * locals[at + 2] +
          matrices[m + 12 + k];
    }
  }
  return out;
}

export class Timeline {
  constructor(app) {
    this.app = app;
    this.element = $('timeline');
    this.time = 0;
    this.playing = false;
    this.held = false; // a pointer is near the mark of a body that greets: it waits
    this.clip = null;
  }
  /** The first vertex at the place of each vertex. */
  places() {
    return (this.placeGroups ??= normalGroups(this.body.positions, null));
  }
  get keys() {
    return this.app.history.state.keys ?? [];
  }
  get length() {
    return this.clip ? lengthOf(this.clip) : KEY_SECONDS;
  }
  /** True where the clip moves the body away from the shape that the handles make. */
  away() {
    return Boolean(this.clip) && (this.playing || this.time > 0);
  }
  opened(body) {
    this.playing = false;
    this.time = 0;
    this.locals = null;
    this.of = null;
    this.body = body;
    this.placeGroups = null;
    this.clips = body.clips.filter((clip) => lengthOf(clip) > 0);
    this.clip = this.clips[0] ?? null;
    this.sums = null;
    this.draw();
  }
  draw() {
    // also before the first tool is chosen, so that the stage keeps its size
    this.element.hidden = !this.body || (this.app.tool?.constructor.key ?? 'pose') !== 'pose';
    if (!this.body) return;
    this.shown = make('span', {});
    this.scrub = make('input', {
      type: 'range',
      min: 0,
      max: this.length,
      step: this.length / 240,
      value: this.time,
      'aria-label': 'Time',
      id: 'scrub',
    });
    this.scrub.oninput = () => {
      this.playing = false;
      this.seek(Number(this.scrub.value));
      this.label();
    };
    this.track = make('div', { class: 'track' }, this.scrub);
    this.playButton = button('', () => (this.playing ? this.pause() : this.play()), { id: 'play' });
    this.restButton = button('', () => this.begin(), { id: 'to-rest' });
    this.keyButton = button('Key', () => this.setKey(), {
      id: 'key',
      title: 'Keeps the handles as they are at this time (K)',
    });
    this.noKeyButton = button('Remove key', () => this.removeKey(), { id: 'no-key' });
    this.element.replaceChildren(
      this.playButton,
      this.restButton,
      this.clips.length
        ? choice(
            'Clip',
            [...this.clips.map((clip, i) => [i, clip.getName() || `clip ${i + 1}`]), ['none', 'keys alone']],
            this.clip ? this.clips.indexOf(this.clip) : 'none',
            (i) => {
              this.stop();
              this.clip = this.clips[Number(i)] ?? null;
              this.draw();
            },
            { id: 'clip' },
          )
        : '',
      this.track,
      this.shown,
      this.keyButton,
      this.noKeyButton,
    );
    this.label();
  }
  /** The words and the dots of the keys, at the present time. */
  label() {
    const { keys, app } = this;
    this.playButton.textContent = this.playing ? 'Pause' : 'Play';
    this.restButton.textContent = keys.length ? 'Start' : 'Rest';
    this.playButton.disabled = !this.clip && keys.length < 2;
    this.shown.textContent = `${this.time.toFixed(2)} / ${this.length.toFixed(2)} s`;
    this.scrub.value = this.time;
    this.scrub.setAttribute(
      'aria-valuetext',
      `${this.time.toFixed(2)} seconds, ${keys.length} ${keys.length === 1 ? 'key' : 'keys'}`,
    );
    this.keyButton.disabled = !app.state.handles.length || this.playing;
    this.noKeyButton.hidden = !keys.length;
    this.noKeyButton.disabled = this.playing || !keyNear(keys, this.time, this.length);
    const dots = keys.map(({ time }) => make('i', { style: `--at: ${Math.min(1, time / this.length).toFixed(4)}` }));
    this.track.replaceChildren(this.scrub, ...dots);
  }
  /** A sample shows how it moves, until someone acts. */
  greet() {
    if (this.clip && this.app.tool === this.app.tools.pose && !matchMedia('(prefers-reduced-motion: reduce)').matches)
      this.play(true);
  }
  /** Ends the greeting: the body stands at rest. True when there was one. */
  still() {
    if (!this.greeting) return false;
    this.stop();
    return true;
  }
  get greeting() {
    return this.playing && this.greets;
  }
  play(greets = false) {
    this.greets = greets;
    if (this.playing) return;
    this.playing = true;
    let last = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      if (!this.greeting || !this.held) this.seek((this.time + Math.max(0, now - last) / 1000) % this.length);
      last = now;
      this.label();
      requestAnimationFrame(step);
    };
    this.seek(this.time || 1e-6);
    this.label();
    this.app.refresh();
    requestAnimationFrame(step);
  }
  pause() {
    this.playing = false;
    this.label();
    this.app.refresh();
  }
  /** The handles at a time: between its keys, or as they are. */
  handlesAt(time) {
    return blended(this.app.history.state.handles, this.keys, time);
  }
  seek(time) {
    const { app } = this;
    const away = this.away();
    this.time = time;
    if (this.keys.length) app.preview({ ...app.history.state, handles: this.handlesAt(time), time });
    else this.show();
    if (away !== this.away()) app.refresh();
    else app.marksLayer.update();
  }
  /** Draws the shape that the handles make, and the clip on it. */
  show() {
    const { app } = this;
    if (!this.away()) return app.skin.set(app.shape);
    if (this.of !== app.shape) {
      this.locals = localsOf(this.body, app.shape.positions, this.locals);
      this.of = app.shape;
    }
    if (!this.sums) {
      this.sums = normalSums(this.body.triangles, normalGroups(this.body.positions, this.body.fileNormals));
      this.posed = new Float32Array(this.locals.length);
      this.normals = new Float32Array(this.locals.length);
    }
    playedAt(this.body, this.clip, this.time, this.locals, this.posed);
    smoothNormals(this.posed, this.sums, this.normals);
    return app.skin.set({ positions: this.posed, normals: this.normals });
  }
  /** What the clip does at a vertex, at the present time: a matrix from the shape of the handles to the picture. */
  carrier(vertex) {
    if (!this.away()) return null;
    const part = this.body.parts.find(({ first, count }) => vertex >= first && vertex < first + count);
    const now = new Matrix4();
    if (part.skin) now.fromArray(part.played ?? part.matrices, part.played ? 16 * (vertex - part.first) : 0);
    else now.copy(worldsAt(this.body, this.clip, this.time)(part.node));
    return now.multiply(new Matrix4().fromArray(part.matrices, part.skin ? 16 * (vertex - part.first) : 0).invert());
  }
  setKey() {
    const { app } = this;
    const state = app.state;
    const keys = withKey(this.keys, this.time, this.length, state.handles.map((handle) => app.standing(handle)));
    return app.commit({ ...state, keys, time: this.time }, 'set a key');
  }
  removeKey() {
    const key = keyNear(this.keys, this.time, this.length);
    if (!key) return undefined;
    const { app, time } = this;
    const keys = this.keys.filter((other) => other !== key);
    return app.commit({ ...app.state, handles: blended(app.state.handles, keys, time), keys, time }, 'remove a key');
  }
  /** What a step keeps: where there are keys, an act at a time is a key at that time. */
  keyed(state) {
    const { handles: before, keys } = this.app.history.state;
    if (!keys.length || state.keys !== keys || state.handles === before) return state;
    const handles = state.handles.map((handle) => this.app.standing(handle));
    return { ...state, keys: withKey(this.keys, this.time, this.length, handles), time: this.time };
  }
  /** Another state is shown: with keys it says at which time it was made. */
  arrive({ keys = [], time = 0 }) {
    this.playing = false;
    this.time = keys.length ? Math.min(time, this.length) : 0;
    if (this.body) this.draw();
  }
  /** Back to the shape at rest, or to the first moment of the keys. */
  begin() {
    this.playing = false;
    if (this.time > 0) this.seek(0);
    this.label();
    this.app.refresh();
  }
  /** Ends what plays: the handles of the last step, and no clip. */
  stop() {
    this.playing = false;
    this.time = 0;
    this.app.settle();
    this.show();
    this.app.refresh();
  }
}
