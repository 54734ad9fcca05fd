// Pose: handles are proposed; drag one, turn one by its rings or keys, pin one, add one by a click on the body. With a mirror
// the twin of a handle on the other side does the same. A drag frees the rotation of a handle: the pose finds it. Rings and
// keys give it, from where it stands.
import { Matrix3, Quaternion, Vector3 } from 'three';
import { say } from '../ui.js';
import { circleOf } from '../circle.js';
import { Gizmo } from '../gizmo.js';
import { Mirror } from '../mirror.js';
import { poseSheet, rest } from '../pose_sheet.js';

const reasons = ['foot', 'tip', 'end', 'joint', 'middle'];
/** Words of HF_ROLE_* and HF_SIDE_*; 0 says nothing. */
const roles = [
  ...['', 'spine', 'neck', 'head', 'jaw', 'shoulder', 'arm', 'hand', 'finger', 'leg', 'foot', 'toe', 'tail', 'wing', 'ear'],
  ...['eye', 'antenna', 'fin'],
];
const sides = ['', 'left ', 'right '];
/** A key moves a handle by this part of the size of the body, 12 pixels, and turns it by ten degrees; with Shift it moves a quarter. */
const [NUDGE, TURN_STEP] = [0.02, Math.PI / 18];
/** Radius of a handle that a click makes, as part of the size of the body: of a leg's width on our own creatures. */
const RADIUS = 0.035;

export class PoseTool {
  static key = 'pose';
  static title = 'Pose';
  static icon = 'M6 20l4-7 3-3 5-6M10 13l6 7M13 10a2 2 0 1 0 .1 0';
  constructor(app) {
    this.app = app;
    this.gizmo = new Gizmo(
      app,
      (turn, done) => this.turned(turn, done),
      (handle) => this.placeOf(handle),
    );
    this.radius = RADIUS;
    this.mirror = new Mirror(app);
    this.ghost = true; // the body at rest is shown around the pose
    this.circle = circleOf(app.view); // how far the chosen handle reaches
  }
  opened() {
    this.mirror.opened();
    this.chosen = null;
    this.pulled = false;
    this.offers = this.app.opened.proposals.map(({ position, radius, reason, role, side, pinned, following, vertex }, i) => ({
      id: `p${i}`,
      position,
      radius,
      pinned: Boolean(pinned),
      following,
      label: `${roles[role] ? sides[side] + roles[role] : reasons[reason]} ${i + 1}`,
      vertex,
      ...rest,
    }));
  }
  /** What a link keeps beside the handles. */
  settings() {
    const { radius, ghost, chosen } = this;
    return { mirror: this.mirror.axis, radius, ghost, chosen };
  }
  adopt({ mirror, radius, ghost = true, chosen = null }) {
    Object.assign(this, { radius, ghost, chosen });
    this.mirror.set(mirror);
  }
  /** The handles that hold the body from the start. */
  first() {
    return this.offers.filter(({ pinned }) => pinned);
  }
  enter() {
    this.cover();
    this.app.timeline.arrive(this.app.state);
    this.dress();
    this.mirror.show(true);
  }
  /** Painted stiffness is shown, where there is some. */
  cover() {
    const { skin, tools } = this.app;
    if (tools.brush?.cover()) return;
    skin.wear('own');
    this.app.legend(null);
  }
  leave() {
    this.gizmo.show(null);
    this.circle.visible = false;
    this.app.skin.showGhost(false);
    this.mirror.show(false);
  }
  /** The rings and the reach of the chosen handle, and the ghost of rest. */
  dress() {
    const { app } = this;
    const away = app.timeline.away();
    this.gizmo.show(away ? null : this.present());
    this.placeCircle();
    app.skin.showGhost(this.ghost && !away && this.posed(), app.opened.normals);
  }
  placeCircle() {
    const handle = this.app.tool === this && this.present();
    this.circle.visible = Boolean(handle) && !this.app.timeline.away();
    if (!this.circle.visible) return;
    this.circle.position.set(...this.placeOf(handle));
    this.circle.scale.setScalar(handle.radius);
  }
  shaped() {
    this.dress();
  }
  get handles() {
    return this.app.state.handles;
  }
  present() {
    return this.handles.find(({ id }) => id === this.chosen) ?? null;
  }
  placeOf(handle) {
    const centre = this.app.centres.get(handle.id) ?? handle.position;
    const place = centre.map((x, k) => x + handle.translation[k]);
    const carrier = this.app.timeline.carrier(handle.vertex);
    return carrier ? new Vector3(...place).applyMatrix4(carrier).toArray() : place;
  }
  /** A step in the picture as a step of the handle, which lies under the clip. */
  under(handle, step) {
    const carrier = this.app.timeline.carrier(handle.vertex);
    if (!carrier) return step;
    const linear = new Matrix3().setFromMatrix4(carrier);
    return Math.abs(linear.determinant()) > 1e-9 ? new Vector3(...step).applyMatrix3(linear.invert()).toArray() : step;
  }
  marks() {
    const { greeting, playing } = this.app.timeline;
    if (playing && !greeting) return [];
    const held = new Set(this.handles.map(({ id }) => id));
    const waiting = this.offers.filter(({ id }) => !held.has(id));
    const pull = this.pulled ? null : waiting[0]?.id;
    const twin = this.twin()?.id;
    // a body that greets shows the one mark to pull
    const [shown, offered] = greeting ? [[], waiting.slice(0, 1)] : [this.handles, waiting];
    return [
      ...shown.map((handle) => ({
        id: handle.id,
        place: this.placeOf(handle),
        label: `${handle.label}${handle.pinned ? ', pinned' : ', handle'}`,
        chosen: handle.id === this.chosen,
        twin: handle.id === twin,
        pinned: handle.pinned,
      })),
      ...offered.map((offer) => ({
        id: offer.id,
        place: this.app.skin.at({ corners: [offer.vertex], barycentrics: [1] }),
        label: `${offer.label}, proposed`,
        offer: true,
        pulse: offer.id === pull,
        say: offer.id === pull ? 'pull me' : null,
      })),
    ];
  }
  refresh() {
    this.cover();
    this.dress();
    this.app.panel();
  }
  choose({ id }) {
    if (this.handles.some((handle) => handle.id === id)) {
      this.chosen = this.chosen === id ? null : id;
      this.app.refresh();
    } else this.add(this.offers.find((offer) => offer.id === id));
  }
  /** The twin of the chosen handle, or null. */
  twin() {
    const handle = this.present();
    return handle && this.mirror.twin(handle, this.handles);
  }
  /** The state with one handle changed, and its twin. */
  with(id, change) {
    const handle = this.handles.find((other) => other.id === id);
    const ids = [id, handle && this.mirror.twin(handle, this.handles)?.id];
    return {
      ...this.app.state,
      handles: this.handles.map((other) => (ids.includes(other.id) ? { ...other, ...change } : other)),
    };
  }
  /** A handle at rest would pull a posed body back to rest. */
  posed(handles = this.handles) {
    return handles.some(({ rotation, translation }) => translation.some(Boolean) || rotation[3] !== 1);
  }
  /** New handles, placed where the body stands. A refusal is left to the step that adds them. */
  async placed(added) {
    if (!this.posed()) return added;
    const { client, state } = this.app;
    const { handles, lengths } = state;
    const places = await client.ask('grab', { handles, added, lengths }).catch(() => []);
    return added.map((handle, i) => ({ ...handle, ...places[i] }));
  }
  /** What is added with some handles: with a mirror their twins too. */
  added(list) {
    return this.mirror.withTwins(
      list.map((handle) => ({ ...handle, pinned: false })),
      this.handles,
      this.offers,
      (twin) => this.fresh(twin),
    );
  }
  async addAll(offers, name) {
    const { body } = this.app;
    const placed = await this.placed(this.added(offers));
    // while the Worker answered, another body was opened or the same handle was added
    const known = new Set(this.handles.map(({ id }) => id));
    if (this.app.body !== body || placed.some(({ id }) => known.has(id))) return undefined;
    await this.app.commit({ ...this.app.state, handles: [...this.handles, ...placed] }, name);
    if (this.mirror.alone && this.handles.some(({ id }) => id === this.mirror.alone))
      say('The body has no surface at the mirror image: one handle was added.');
    return undefined;
  }
  add(offer) {
    this.pulled = true;
    this.chosen = offer.id;
    return this.addAll([offer], 'add a handle');
  }
  /** A handle of the user's own at a place of the body at rest. */
  fresh({ position, radius, vertex, following = 1 }) {
    const id = this.app.nextId();
    return { id: `h${id}`, position, radius, following, label: `handle ${id}`, vertex, pinned: false, ...rest };
  }
  click([x, y]) {
    const hit = this.app.skin.pick(this.app.view.ray(x, y));
    if (!hit) {
      this.chosen = null;
      return this.app.refresh();
    }
    const position = this.app.skin.at(hit, this.app.body.positions); // at rest, wherever the clip is
    return this.add(this.fresh({ position, radius: this.radius * this.app.view.size, vertex: hit.vertex }));
  }
  dragStart({ id }) {
    this.app.timeline.still();
    const begin = this.handles.find((handle) => handle.id === id);
    const offer = begin ? null : this.offers.find((other) => other.id === id);
    const { pulled, chosen } = this;
    this.pulled = true;
    this.chosen = id;
    this.from = {
      was: { pulled, chosen },
      added: begin ? [] : this.added([offer]),
      place: begin ? this.placeOf(begin) : this.app.skin.at({ corners: [offer.vertex], barycentrics: [1] }),
      before: this.app.state,
    };
    const { from } = this;
    if (offer && this.posed())
      from.waits = this.placed(from.added).then((added) => Object.assign(from, { added, waits: null }));
  }
  drag(mark, at, begin) {
    // nothing is shown until the Worker has said where the new handle stands
    this.from.last = [mark, at, begin];
    if (!this.from.waits) this.dragged(...this.from.last);
  }
  dragged({ id }, [x, y], [x0, y0]) {
    const { view } = this.app;
    const { added, place, before } = this.from;
    const handles = [...before.handles, ...added];
    const [to, at] = [view.onPlane(x, y, place), view.onPlane(x0, y0, place)];
    const step = this.under(
      handles.find((other) => other.id === id),
      to.map((p, k) => p - at[k]),
    );
    this.app.preview({ ...before, handles: this.mirror.moved(handles, id, step) });
  }
  async dragEnd() {
    const { from } = this;
    if (from.waits) {
      await from.waits;
      if (this.from !== from || this.app.state !== from.before) return undefined;
      this.dragged(...from.last);
    }
    return this.app.commitPreview('move a handle');
  }
  /** A drag that is given up: a second finger came, or the system took the pointer. */
  dragCancel() {
    const { was, before } = this.from;
    Object.assign(this, was);
    this.from = null;
    this.app.giveUp(before);
  }
  key({ id }, event) {
    if (event.key.startsWith('Arrow')) this.app.timeline.still();
    const handle = this.handles.find((other) => other.id === id);
    const { view } = this.app;
    const step = NUDGE * view.size * (event.shiftKey ? 0.25 : 1);
    const ways = {
      ArrowLeft: [view.camRight(), -step],
      ArrowRight: [view.camRight(), step],
      ArrowUp: [view.camUp(), step],
      ArrowDown: [view.camUp(), -step],
    };
    if (ways[event.key] && !handle && this.posed()) {
      this.add(this.offers.find((offer) => offer.id === id)).then(
        () => this.handles.some((other) => other.id === id) && this.key({ id }, event),
      );
      return true;
    }
    if (ways[event.key]) {
      const [way, length] = ways[event.key];
      const handles = handle
        ? this.handles
        : [...this.handles, ...this.added([this.offers.find((offer) => offer.id === id)])];
      const along = this.under(
        handles.find((other) => other.id === id),
        way.map((x) => x * length),
      );
      this.pulled = true;
      this.chosen = id;
      this.app.commit(
        { ...this.app.state, handles: this.mirror.moved(handles, id, along) },
        'move a handle',
        `move ${id}`,
      );
      return true;
    }
    if (!handle) return false;
    if (event.key === '[' || event.key === ']') {
      const axis = view.camera.getWorldDirection(new Vector3());
      this.turn(
        handle,
        new Quaternion().setFromAxisAngle(axis, event.key === '[' ? -TURN_STEP : TURN_STEP),
        `turn ${id}`,
      );
      return true;
    }
    if (event.key === 'Delete' || event.key === 'Backspace') return (this.remove(handle), true);
    if (event.key.toLowerCase() === 'p') return (this.pin(handle), true);
    return false;
  }
  /** The handles, the chosen one with the rotation that it has in the picture: there a given rotation begins. */
  standing(id) {
    return this.handles.map((handle) => (handle.id === id ? this.app.standing(handle) : handle));
  }
  turn(handle, by, join) {
    const handles = this.mirror.moved(this.standing(handle.id), handle.id, [0, 0, 0], by);
    return this.app.commit({ ...this.app.state, handles }, 'turn a handle', join);
  }
  /** The gizmo turned the chosen handle by a quaternion from where the drag began. */
  turned(by, done) {
    const handle = this.present();
    this.turnFrom ??= { handles: this.standing(handle.id), before: this.app.state };
    const handles = this.mirror.moved(this.turnFrom.handles, handle.id, [0, 0, 0], by);
    this.app.preview({ ...this.app.state, handles });
    if (done) {
      this.turnFrom = null;
      this.app.commitPreview('turn a handle');
    }
  }
  strokeStart(at) {
    return this.gizmo.start(at);
  }
  stroke(at) {
    this.gizmo.move(at);
  }
  strokeEnd() {
    this.gizmo.end();
  }
  strokeCancel() {
    this.gizmo.cancel();
    const { before } = this.turnFrom ?? {};
    this.turnFrom = null;
    this.app.giveUp(before);
  }
  remove(handle) {
    this.chosen = null;
    const twin = this.mirror.twin(handle, this.handles);
    return this.app.commit(
      { ...this.app.state, handles: this.handles.filter((other) => other !== handle && other !== twin) },
      'remove a handle',
    );
  }
  pin(handle) {
    return this.app.commit(this.with(handle.id, { pinned: !handle.pinned }), handle.pinned ? 'unpin' : 'pin');
  }
  sheet() {
    return poseSheet(this);
  }
}
