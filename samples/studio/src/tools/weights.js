// Weights: skin weights for the bones of the file, coloured by bone; one bone alone as a field.

/** The angle between the hues of neighbouring bones, as part of the circle: the golden ratio keeps all apart. */
const HUE_STEP = 0.61803398875;

/** A pin holds what lies within this part of the size of the body: a knee of our own creatures. */
const PIN_RADIUS = 0.02;

/** `kit`: what the page has loaded already (studio.js). */
export const tool = ({ Color, bonesOf, button, choice, facts, influencesOf, make, ms, say, touched, whole }) =>
  class {
    static key = 'weights';
    static title = 'Weights';
    constructor(app) {
      this.app = app;
      this.weightCount = 4;
    }
    opened() {
      this.chosen = null;
      this.busy = false;
      this.fileWeights = null;
      this.bones = bonesOf(this.app.body);
      this.result = null;
      this.shown = 'all';
      this.colours = this.bones.names.map((_, i) => new Color().setHSL((i * HUE_STEP) % 1, 0.6, 0.52));
    }
    enter() {
      this.dress();
    }
    leave() {
      this.app.legend(null);
      this.restoreField();
    }
    refresh() {
      // undo and redo bring other pins
      if (this.result && !this.busy && !this.setting && this.pinned !== this.app.state.pins) this.compute();
      this.app.panel();
    }
    get pins() {
      return this.app.state.pins;
    }
    marks() {
      return this.pins.map(({ id, vertex, bone }, i) => ({
        id,
        place: this.app.skin.at({ corners: [vertex], barycentrics: [1] }),
        label: `pin ${i + 1}, ${this.bones.names[bone]}`,
        colour: this.colours[bone].getStyle(),
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
        this.pins.filter((pin) => pin.id !== id),
        'remove a pin',
      );
      return true;
    }
    /** A click pins the place to the bone that is shown. */
    click(at) {
      const hit = this.shown !== 'all' && this.app.skin.pick(this.app.view.ray(...at));
      if (!hit) return undefined;
      const pin = {
        id: `w${this.app.nextId()}`,
        vertex: hit.vertex,
        bone: Number(this.shown),
        radius: PIN_RADIUS * this.app.view.size,
      };
      this.chosen = pin.id;
      return this.setPins([...this.pins, pin], 'pin a place');
    }
    /** Pins that the library refuses change nothing. */
    async setPins(pins, name) {
      if (this.busy) return;
      this.setting = true;
      if (await this.compute(pins)) await this.app.commit({ ...this.app.state, pins }, name);
      else say(`${name}: ${this.error}`);
      this.setting = false;
      this.app.refresh();
    }
    /** Weights of the file, in the form of a result. */
    ofFile() {
      const { body } = this.app;
      const size = 4;
      const found = {
        weightCount: size,
        joints: new Uint32Array(size * body.vertexCount),
        weights: new Float32Array(size * body.vertexCount),
      };
      for (const part of body.parts) {
        if (!part.skin) continue;
        const numbers = part.skin.listJoints().map((joint) => this.bones.joints.indexOf(joint));
        const { size: sets, joints, weights } = influencesOf(part);
        for (let v = 0; v < part.count; ++v)
          for (let k = 0; k < size; ++k) {
            found.joints[size * (part.first + v) + k] = numbers[joints[sets * v + k]];
            found.weights[size * (part.first + v) + k] = weights[sets * v + k];
          }
      }
      return found;
    }
    dress() {
      const { skin, body } = this.app;
      if (!this.bones.joints.length) return skin.wear('own');
      const { weightCount, joints, weights } = this.result ?? this.ofFile();
      if (this.shown === 'all') {
        const tint = new Float32Array(3 * body.vertexCount);
        for (let v = 0; v < body.vertexCount; ++v)
          for (let k = 0; k < weightCount; ++k) {
            const weight = weights[weightCount * v + k];
            if (!weight) continue;
            const { r, g, b } = this.colours[joints[weightCount * v + k]];
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
      for (let i = 0; i < joints.length; ++i) if (joints[i] === bone) field[Math.floor(i / weightCount)] += weights[i];
      skin.lend(field);
      skin.wear('field');
      this.app.legend({ low: 0, high: 1 });
      return undefined;
    }
    restoreField() {
      this.app.skin.lend(null);
    }
    hover(at) {
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      if (!hit || !this.bones.joints.length) return null;
      const { weightCount, joints, weights } = this.result ?? (this.fileWeights ??= this.ofFile());
      const rows = [];
      for (let k = 0; k < weightCount; ++k) {
        const weight = weights[weightCount * hit.vertex + k];
        if (weight >= 0.01) rows.push(`${this.bones.names[joints[weightCount * hit.vertex + k]]} ${weight.toFixed(2)}`);
      }
      return rows.join(', ') || 'no bone';
    }
    async compute(pins = this.pins) {
      const { heads, parents } = this.bones;
      const { app, weightCount } = this;
      const mine = app.body;
      this.busy = true;
      app.refresh();
      this.error = null;
      try {
        const result = await app.client.ask('weights', { bones: { heads, parents }, weightCount, pins });
        if (mine === app.body) [this.result, this.pinned] = [result, pins];
      } catch (error) {
        this.error = error.message;
        this.pinned = this.pins; // asked for once
      }
      this.busy = false;
      if (app.tool === this) this.dress();
      app.refresh();
      return !this.error;
    }
    sheet() {
      if (!this.bones.joints.length)
        return [make('p', {}, 'This file has no bones. Save a rig by handles from Pose, or open a file with a skin.')];
      const { result } = this;
      const info = result?.info;
      const guessed = info && info.rigidCount + info.isolatedCount;
      return [
        make(
          'p',
          {},
          result
            ? `Computed from the bones.${touched() ? '' : ' Hover over the body to read a vertex.'}`
            : 'These are the weights of the file. Compute new ones from its bones.',
        ),
        make(
          'div',
          { class: 'row' },
          button(this.busy ? 'Computing' : 'Compute weights', () => this.compute(), {
            class: 'main',
            id: 'compute',
            disabled: this.busy,
          }),
          button(
            'Weights of the file',
            () => {
              this.result = null;
              this.dress();
              this.app.refresh();
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
          this.weightCount,
          (value) => (this.weightCount = Number(value)),
          { id: 'weight-count' },
        ),
        choice(
          'Bone to show',
          [['all', 'all bones, each its colour'], ...this.bones.names.map((name, i) => [i, name])],
          this.shown,
          (value) => {
            this.shown = value;
            if (value === 'all') this.restoreField();
            this.dress();
            this.app.panel();
          },
          { id: 'bone' },
        ),
        make(
          'p',
          {},
          this.shown === 'all'
            ? 'Show one bone to pin places to it.'
            : 'Click the body: the place belongs to this bone, and the weights follow.',
        ),
        this.pins.length > 0 &&
          button('Remove all pins', () => this.setPins([], 'remove all pins'), { id: 'no-pins', disabled: this.busy }),
        this.error && make('p', { class: 'warn' }, this.error),
        guessed > 0 &&
          make(
            'p',
            { class: 'warn' },
            `${whole(guessed)} vertices take their weights from the nearest part: no bone is near them.`,
          ),
        facts([
          ['bones', this.bones.joints.length],
          this.pins.length > 0 && ['pins', this.pins.length],
          result && ['time', ms(result.milliseconds)],
          info && ['vertices that see their bone', whole(info.informedCount)],
          info && info.outsideCount > 0 && ['bones outside the skin', info.outsideCount],
        ]),
      ];
    }
  };
