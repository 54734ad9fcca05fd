// Weights: skin weights for the bones of the file or for the handles, coloured by bone; one bone alone as a field; pins; a test
// that bends the bones.
import { Bend } from '../bend.js';
import { Bones } from '../bones.js';
import { pruned } from '../skinning.js';
import { weightsSheet } from '../weights_sheet.js';

/** The angle between the hues of neighbouring bones, as part of the circle: the golden ratio keeps all apart. */
const HUE_STEP = 0.61803398875;

/** A pin holds what lies within this part of the size of the body: a knee of our own creatures. */
const PIN_RADIUS = 0.02;

const NO_BONE = 0xffffffff;

/** `kit`: what the page has loaded already (studio.js). */
export const tool = (kit) => {
  const { Color, bonesOf, influencesOf, say } = kit;
  return class {
    static key = 'weights';
    static title = 'Weights';
    constructor(app) {
      this.app = app;
      this.influenceCount = 4;
      this.bend = new Bend(kit, this);
      this.drawn = new Bones(kit, this);
    }
    opened() {
      this.fileBones = bonesOf(this.app.body);
      this.of = this.fileBones.joints.length ? 'file' : 'handles';
      this.clear();
    }
    /** Other bones: nothing is computed yet. */
    clear() {
      this.chosen = null;
      this.busy = false;
      this.kept = null;
      this.result = null;
      this.error = null;
      this.shown = 'all';
      this.bend.opened();
      this.bones = this.of === 'file' ? this.fileBones : this.handleBones();
      this.colours = this.bones.names.map((_, i) => new Color().setHSL((i * HUE_STEP) % 1, 0.6, 0.52));
    }
    /** Every handle is a bone without a parent, at its middle. */
    handleBones() {
      const { state, centres } = this.app;
      const { handles } = state;
      return {
        handles,
        heads: handles.flatMap(({ id, position }) => centres.get(id) ?? position),
        parents: handles.map(() => NO_BONE),
        names: handles.map(({ label }) => label),
      };
    }
    /** Weights that can be seen: computed, or of the file with as many bones for a vertex as are wanted. */
    present() {
      if (this.result) return this.result;
      if (this.of === 'handles') return null;
      if (this.kept?.influenceCount !== this.influenceCount) this.kept = pruned(this.ofFile(), this.influenceCount);
      return this.kept;
    }
    /** Weights that the file does not have, or null. */
    changed() {
      return (
        this.result ??
        (this.of === 'file' && this.fileBones.joints.length && this.present().lost > 0 ? this.kept : null)
      );
    }
    /** What a link keeps beside the pins. */
    settings() {
      const { of, influenceCount, shown, result } = this;
      return { of, influenceCount, shown, computed: Boolean(result) };
    }
    async adopt({ of, influenceCount, shown, computed }) {
      Object.assign(this, { of, influenceCount });
      this.clear();
      const done = !computed || (await this.compute());
      if (this.app.tool === this) this.look(shown);
      else this.shown = shown;
      if (!done) throw new Error(this.error);
    }
    enter() {
      this.dress();
      this.bend.show();
    }
    leave() {
      this.app.legend(null);
      this.restoreField();
      this.bend.hide();
      this.drawn.hide();
    }
    shaped() {
      this.bend.show();
    }
    refresh() {
      // other handles are other bones
      if (
        this.of === 'handles' &&
        !this.busy &&
        this.bones.handles.map(({ id }) => id).join() !== this.app.state.handles.map(({ id }) => id).join()
      ) {
        this.clear();
        this.dress();
        this.bend.show();
      }
      // undo and redo bring other pins, and the brush another stiffness
      const { pins, stiffness } = this.app.state;
      if (this.result && !this.busy && !this.setting && (this.pinned !== pins || this.stiffness !== stiffness)) this.compute();
      this.app.panel();
    }
    /** Of a list the pins of these bones, with the numbers of their bones. */
    mine(pins) {
      const numberOf = ({ of = 'file', bone, handle }) =>
        of !== this.of ? -1 : of === 'file' ? bone : this.bones.handles.findIndex(({ id }) => id === handle);
      return pins.map((pin) => ({ ...pin, bone: numberOf(pin) })).filter(({ bone }) => bone >= 0);
    }
    get pins() {
      return this.mine(this.app.state.pins);
    }
    marks() {
      return this.pins.map(({ id, vertex, bone }, i) => ({
        id,
        place: this.app.skin.at({ corners: [vertex], barycentrics: [1] }),
        label: `pin ${i + 1}, ${this.bones.names[bone] ?? 'no bone'}`,
        colour: this.colours[bone]?.getStyle(),
        chosen: this.chosen === id,
      }));
    }
    choose({ id }) {
      this.chosen = this.chosen === id ? null : id;
      this.app.refresh();
    }
    key({ id }, event) {
      if (event.key !== 'Delete' && event.key !== 'Backspace') return false;
      this.setPins(
        this.app.state.pins.filter((pin) => pin.id !== id),
        'remove a pin',
      );
      return true;
    }
    /** A click on a bone shows it. Where one is shown, a click elsewhere on the body pins the place to it. */
    click(at) {
      const bone = this.busy ? -1 : this.drawn.under(at);
      if (bone >= 0 && String(bone) !== String(this.shown)) return this.look(bone);
      const hit = this.shown !== 'all' && !this.bend.clip && this.app.skin.pick(this.app.view.ray(...at));
      if (!hit) return undefined;
      const pin = {
        id: `w${this.app.nextId()}`,
        vertex: hit.vertex,
        of: this.of,
        bone: Number(this.shown),
        handle: this.bones.handles?.[Number(this.shown)].id,
        radius: PIN_RADIUS * this.app.view.size,
      };
      this.chosen = pin.id;
      return this.setPins([...this.app.state.pins, pin], 'pin a place');
    }
    strokeStart(at) {
      return this.shown !== 'all' && this.bend.gizmo.start(at);
    }
    stroke(at) {
      this.bend.gizmo.move(at);
    }
    strokeEnd() {
      this.bend.gizmo.end();
    }
    strokeCancel() {
      this.bend.cancel();
    }
    unpin() {
      const gone = new Set(this.pins.map(({ id }) => id));
      return this.setPins(
        this.app.state.pins.filter(({ id }) => !gone.has(id)),
        'remove all pins',
      );
    }
    /** Pins that the library refuses change nothing. */
    async setPins(pins, name) {
      if (this.busy) return;
      this.setting = true;
      if (await this.compute(pins)) await this.app.commit({ ...this.app.state, pins }, name);
      else this.app.warn(`${name}: ${this.error}`);
      this.setting = false;
      this.app.refresh();
    }
    /** Weights of the file, in the form of a result. */
    ofFile() {
      const { body } = this.app;
      const size = Math.max(4, ...body.parts.map((part) => (part.skin ? influencesOf(part).size : 0)));
      const found = {
        influenceCount: size,
        joints: new Uint32Array(size * body.vertexCount),
        weights: new Float32Array(size * body.vertexCount),
      };
      for (const part of body.parts) {
        if (!part.skin) continue;
        const numbers = part.skin.listJoints().map((joint) => this.bones.joints.indexOf(joint));
        const { size: sets, joints, weights } = influencesOf(part);
        for (let v = 0; v < part.count; ++v)
          for (let k = 0; k < sets; ++k) {
            found.joints[size * (part.first + v) + k] = numbers[joints[sets * v + k]];
            found.weights[size * (part.first + v) + k] = weights[sets * v + k];
          }
      }
      return found;
    }
    dress() {
      const { skin, body } = this.app;
      const present = this.bones.names.length ? this.present() : null;
      if (!present) {
        this.app.legend(null);
        this.restoreField();
        return skin.wear('own');
      }
      const { influenceCount, joints, weights } = present;
      if (this.shown === 'all') {
        const tint = new Float32Array(3 * body.vertexCount);
        for (let v = 0; v < body.vertexCount; ++v)
          for (let k = 0; k < influenceCount; ++k) {
            const weight = weights[influenceCount * v + k];
            if (!weight) continue;
            const { r, g, b } = this.colours[joints[influenceCount * v + k]];
            tint[3 * v] += weight * r;
            tint[3 * v + 1] += weight * g;
            tint[3 * v + 2] += weight * b;
          }
        skin.setTint(tint);
        skin.wear('tint');
        this.app.legend(null);
        return undefined;
      }
      const bone = Number(this.shown);
      const field = new Float32Array(body.vertexCount);
      for (let i = 0; i < joints.length; ++i) if (joints[i] === bone) field[Math.floor(i / influenceCount)] += weights[i];
      skin.lend(field);
      skin.wear('field');
      this.app.legend({ low: 0, high: 1 });
      return undefined;
    }
    restoreField() {
      this.app.skin.lend(null);
    }
    hover(at) {
      const bone = this.drawn.under(at);
      if (bone >= 0 && String(bone) !== String(this.shown)) return `bone ${this.bones.names[bone]}`;
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      const present = hit && this.bones.names.length ? this.present() : null;
      if (!present) return null;
      const { influenceCount, joints, weights } = present;
      const rows = [];
      for (let k = 0; k < influenceCount; ++k) {
        const weight = weights[influenceCount * hit.vertex + k];
        if (weight >= 0.01) rows.push(`${this.bones.names[joints[influenceCount * hit.vertex + k]]} ${weight.toFixed(2)}`);
      }
      return rows.join(', ') || 'no bone';
    }
    async compute(pins = this.app.state.pins) {
      const { heads, parents } = this.bones;
      const { app, influenceCount } = this;
      const mine = app.body;
      this.stiffness = app.state.stiffness;
      this.busy = true;
      app.refresh();
      this.error = null;
      try {
        const result = await app.client.ask('weights', {
          bones: { heads, parents },
          influenceCount,
          pins: this.mine(pins),
        });
        if (mine === app.body) [this.result, this.pinned] = [result, pins];
      } catch (error) {
        this.error = error.message;
        this.pinned = app.state.pins; // asked for once
      }
      this.busy = false;
      if (app.tool === this) {
        this.dress();
        this.bend.show();
      }
      app.refresh();
      return !this.error;
    }
    /** Shows one bone, or all. */
    look(value) {
      this.shown = value;
      this.bend.forget();
      if (value === 'all') this.restoreField();
      this.dress();
      this.bend.show();
      this.app.panel();
    }
    sheet() {
      return weightsSheet(kit, this);
    }
  };
};
