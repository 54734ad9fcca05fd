// The clips of a file, played on the processor: every vertex moves by its joints, or with its node. The pose made by
// handles is played under the clip, because it is a change of the shape at rest.
import { Matrix4, Quaternion, Vector3 } from 'three';
import { blendMatrices, jointMatrices } from './model.js';
import { normalGroups, normalSums, smoothNormals } from './normals.js';
import { $, button, choice, make } from './ui.js';

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
export function localsOf(body, shape) {
  const out = new Float64Array(shape.length);
  const [matrix, place] = [new Matrix4(), new Vector3()];
  for (const part of body.parts) {
    if (!part.skin) matrix.fromArray(part.matrices).invert();
    for (let v = 0; v < part.count; ++v) {
      if (part.skin) matrix.fromArray(part.matrices, 16 * v).invert();
      place
        .fromArray(shape, 3 * (part.first + v))
        .applyMatrix4(matrix)
        .toArray(out, 3 * (part.first + v));
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
    this.clip = null;
  }
  /** The first vertex at the place of each vertex. */
  places() {
    return (this.placeGroups ??= normalGroups(this.body.positions, null));
  }
  away() {
    return Boolean(this.clip) && (this.playing || this.time > 0);
  }
  opened(body) {
    this.stop(false);
    this.body = body;
    this.placeGroups = null;
    this.clip = body.clips.find((clip) => lengthOf(clip) > 0) ?? null;
    this.sums = null;
    this.draw();
  }
  draw() {
    this.element.hidden = !this.clip || this.app.tool?.constructor.key !== 'pose';
    if (!this.clip) return;
    const length = lengthOf(this.clip);
    this.shown = make('span', {});
    this.scrub = make('input', {
      type: 'range',
      min: 0,
      max: length,
      step: length / 240,
      value: this.time,
      'aria-label': 'Time of the clip',
      id: 'scrub',
    });
    this.scrub.oninput = () => {
      this.playing = false;
      this.seek(Number(this.scrub.value));
      this.label();
    };
    this.playButton = button('', () => (this.playing ? this.pause() : this.play()), { id: 'play' });
    this.element.replaceChildren(
      this.playButton,
      button('Rest', () => this.stop(), { id: 'to-rest' }),
      choice(
        'Clip',
        this.body.clips.map((clip, i) => [i, clip.getName() || `clip ${i + 1}`]),
        this.body.clips.indexOf(this.clip),
        (i) => {
          this.stop();
          this.clip = this.body.clips[Number(i)];
          this.draw();
        },
      ),
      this.scrub,
      this.shown,
    );
    this.label();
  }
  label() {
    this.playButton.textContent = this.playing ? 'Pause' : 'Play';
    this.shown.textContent = `${this.time.toFixed(2)} / ${lengthOf(this.clip).toFixed(2)} s`;
    this.scrub.value = this.time;
  }
  play() {
    this.playing = true;
    let last = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      this.seek((this.time + (now - last) / 1000) % lengthOf(this.clip));
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
  }
  seek(time) {
    const { app } = this;
    if (!this.locals) {
      this.locals = localsOf(this.body, app.shape.positions);
      this.sums ??= normalSums(this.body.triangles, normalGroups(this.body.positions, this.body.fileNormals));
      this.posed = new Float32Array(this.locals.length);
      this.normals = new Float32Array(this.locals.length);
    }
    const away = this.away();
    this.time = time;
    playedAt(this.body, this.clip, time, this.locals, this.posed);
    smoothNormals(this.posed, this.sums, this.normals);
    app.skin.set({ positions: this.posed, normals: this.normals });
    if (away !== this.away()) app.refresh();
  }
  /** Back to the shape at rest: handles can be dragged again. */
  stop(show = true) {
    const away = this.away();
    this.playing = false;
    this.time = 0;
    this.locals = null;
    if (!show || !away) return;
    this.app.skin.set(this.app.shape);
    this.label();
    this.app.refresh();
  }
}
