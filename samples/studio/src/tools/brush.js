// Stiffness brush, a part of Pose and of Field: where it paints, the body bends less or more than the rest.

/** Levels are exponents of the stiffness to base ten. The library takes 1e-4 to 1e4; from 100 on a pose keeps lengths to 0.1 %. */
const [MOST, RIGID] = [4, 2];
/** A colour for each level. */
const COLOURS = 2 * MOST + 1;
/** Radius of the brush from the start, the least, the most and a step, as parts of the size of the body: half a leg, and a trunk. */
const [RADIUS, LEAST, WIDEST, STEP] = [0.04, 0.01, 0.2, 0.005];
/** A stroke paints at places at most so many pixels apart: a quarter of a small brush. A faster hand leaves no gaps. */
const APART_PIXELS = 6;
/** A key moves the brush by this many pixels along the surface: as it moves a site. */
const NUDGE_PIXELS = 12;

const wordOf = (level) => (!level ? 'normal' : level < 0 ? 'soft' : level < RIGID ? 'stiff' : 'rigid');
const words = (level) => (level ? `${wordOf(level)}, ${(10 ** level).toLocaleString('en', { maximumFractionDigits: MOST })}` : 'normal');

/** `kit`: what the page has loaded already (studio.js). */
export const tool = (kit) => {
  const { $, button, choice, circleOf, colourAt, facts, make, pack, say, slider, touched, unpack, whole } = kit;
  const colours = Float32Array.from(Array.from({ length: COLOURS }, (_, i) => colourAt((i + 0.5) / COLOURS)).flat());
  return class {
    static key = 'brush';
    static title = 'Stiffness';
    constructor(app) {
      this.app = app;
      Object.assign(this, { radius: RADIUS, level: MOST, erasing: false, home: 'pose', seen: 'stiffness', worn: true });
      this.circle = circleOf(app.view);
    }
    opened() {
      Object.assign(this, { net: null, at: null, begin: null, levels: null, of: undefined });
    }
    /** What a link keeps beside what is painted. */
    settings() {
      const { radius, level, erasing, home, seen, worn } = this;
      return { radius, level, erasing, home, seen, worn };
    }
    adopt({ radius, level, erasing, home, seen, worn }) {
      Object.assign(this, { radius, level, erasing, home, seen, worn });
    }
    async enter() {
      const { app } = this;
      const { body, skin, view } = app;
      this.at ??= skin.pick(view.ray(view.width / 2, view.height / 2)) ?? app.cornerOf(body.triangles[0]);
      this.dress();
      if (this.net) return;
      const net = await app.client.ask('net');
      if (app.body === body) this.net = net;
    }
    leave() {
      this.circle.visible = false;
      this.app.legend(null);
    }

    // ---- the picture
    /** The level of every vertex in the present state. */
    now() {
      const { state, body } = this.app;
      if (this.levels && this.of === state.stiffness) return this.levels;
      const levels = new Float32Array(body.vertexCount);
      unpack(state.stiffness, (v, level) => (levels[v] = level));
      const places = this.app.timeline.places();
      for (let v = 0; v < levels.length; ++v) levels[v] = levels[places[v]];
      Object.assign(this, { levels, of: state.stiffness });
      return levels;
    }
    wear() {
      const { app } = this;
      const levels = this.now();
      const tint = new Float32Array(3 * levels.length);
      // plain numbers, no lists: this runs for every frame of a stroke
      for (let v = 0, at = 0; v < levels.length; ++v) {
        const colour = 3 * (levels[v] + MOST);
        tint[at++] = colours[colour];
        tint[at++] = colours[colour + 1];
        tint[at++] = colours[colour + 2];
      }
      app.skin.setTint(tint);
      app.skin.wear('tint');
      app.legend({ words: ['soft', 'normal', 'rigid'], strips: COLOURS });
    }
    /** Pose shows what is painted; false where nothing is, or it is not wished. */
    cover() {
      const shown = this.worn && Boolean(this.app.state.stiffness);
      if (shown) this.wear();
      return shown;
    }
    dress() {
      const { app } = this;
      if (this.seen === 'field' && app.state.sites.length) {
        app.tools.field.dress();
      } else this.wear();
      this.place();
    }
    place(hit = this.at) {
      this.circle.visible = this.app.tool === this && Boolean(hit);
      if (!this.circle.visible) return;
      this.circle.position.set(...this.app.skin.at(hit));
      this.circle.scale.setScalar(this.radius * this.app.view.size);
      this.app.view.draw();
    }
    shaped() {
      this.place();
    }
    refresh() {
      this.dress();
      this.app.panel();
    }
    here() {
      const { corners, barycentrics } = this.at;
      return this.now()[corners[barycentrics.indexOf(Math.max(...barycentrics))]];
    }
    get target() {
      return this.erasing ? 0 : this.level;
    }
    marks() {
      if (!this.at) return [];
      const label = `brush, on ${words(this.here())}; Enter paints ${words(this.target)}`;
      return [{ id: 'brush', place: this.app.skin.at(this.at), label, offer: true, colour: '#e0781e' }];
    }
    hover(at) {
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      if (!hit) return null;
      this.place(hit);
      return words(this.now()[hit.vertex]);
    }

    // ---- strokes
    /** Paints within the radius of a place, along the edges of the body at rest. */
    dab({ corners, barycentrics }) {
      const { app, net, levels, target } = this;
      const { positions } = app.body;
      const radius = this.radius * app.view.size;
      const far = new Map();
      const queue = [];
      const reach = (v, away) => {
        if (away > radius || away >= (far.get(v) ?? Infinity)) return;
        far.set(v, away);
        queue.push(v);
      };
      const between = ([x, y, z], v) => Math.hypot(x - positions[3 * v], y - positions[3 * v + 1], z - positions[3 * v + 2]);
      const middle = app.skin.at({ corners, barycentrics }, positions);
      for (const v of corners) reach(net.places[v], between(middle, v));
      if (!far.size) reach(net.places[corners[barycentrics.indexOf(Math.max(...barycentrics))]], 0); // a brush smaller than an edge
      for (const v of queue) {
        const from = positions.subarray(3 * v, 3 * v + 3);
        const away = far.get(v);
        for (let i = net.starts[v]; i < net.starts[v + 1]; ++i) reach(net.ends[i], away + between(from, net.ends[i]));
      }
      let changed = false;
      for (const v of far.keys()) {
        changed ||= levels[v] !== target;
        levels[v] = target;
      }
      return changed;
    }
    /** The state with what is painted now. */
    painted() {
      const { places } = this.net;
      for (let v = 0; v < places.length; ++v) this.levels[v] = this.levels[places[v]];
      const stiffness = pack(this.levels, places);
      this.of = stiffness;
      return { ...this.app.state, stiffness };
    }
    get name() {
      return this.erasing ? 'erase stiffness' : 'paint stiffness';
    }
    strokeStart(at) {
      const hit = this.net && this.app.skin.pick(this.app.view.ray(...at));
      if (!hit) return false;
      this.app.timeline.still();
      this.begin = { before: this.app.state, at };
      this.levels = this.now().slice();
      this.paint([hit]);
      return true;
    }
    paint(hits) {
      const changed = hits.map((hit) => this.dab(hit)).some(Boolean);
      this.at = hits.at(-1);
      if (changed) {
        this.app.preview(this.painted());
        this.dress();
      } else this.app.marksLayer.update();
      this.place();
    }
    stroke(at) {
      if (!this.begin) return;
      const { view, skin } = this.app;
      const from = this.begin.at;
      const count = Math.ceil(Math.hypot(at[0] - from[0], at[1] - from[1]) / APART_PIXELS);
      const hits = Array.from({ length: count }, (_, i) => from.map((x, k) => x + ((i + 1) / count) * (at[k] - x)))
        .map((place) => skin.pick(view.ray(...place)))
        .filter(Boolean);
      this.begin.at = at;
      if (hits.length) this.paint(hits);
    }
    strokeEnd() {
      this.begin = null;
      return this.app.commitPreview(this.name);
    }
    strokeCancel() {
      const { begin } = this;
      this.begin = null;
      this.levels = null;
      if (begin) this.app.giveUp(begin.before);
    }
    /** One place: a click, or a key. */
    click(at) {
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      return hit ? this.put(hit) : undefined;
    }
    async put(hit) {
      if (!this.net) return;
      this.app.timeline.still();
      this.at = hit;
      this.levels = this.now().slice();
      if (this.dab(hit)) await this.app.commit(this.painted(), this.name, this.name);
      else say(`This place is ${words(this.target)} already. Move the brush, or change its stiffness.`);
    }
    choose() {
      return this.put(this.at);
    }
    dragStart(mark, from) {
      this.strokeStart(from);
    }
    drag(mark, at) {
      this.stroke(at);
    }
    dragEnd() {
      return this.begin && this.strokeEnd();
    }
    dragCancel() {
      this.strokeCancel();
    }
    key(mark, event) {
      const { view, skin } = this.app;
      const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
      const step = { '[': -STEP, ']': STEP }[event.key];
      if (step) {
        this.radius = Math.min(WIDEST, Math.max(LEAST, this.radius + step));
        say(`radius ${this.radius.toFixed(3)}`);
      } else if (event.key.toLowerCase() === 'e') this.erase();
      else if (ways[event.key]) {
        const { x, y } = view.onScreen(mark.place);
        const [dx, dy] = ways[event.key];
        const hit = skin.pick(view.ray(x + dx * NUDGE_PIXELS, y + dy * NUDGE_PIXELS));
        if (hit) this.at = hit;
        say(hit ? `here: ${words(this.here())}` : 'The body ends here. Turn the view, or move the brush another way.');
      } else return false;
      this.app.refresh();
      return true;
    }
    erase() {
      this.erasing = !this.erasing;
      this.app.refresh();
    }
    sheet() {
      const { app } = this;
      const { stiffness, sites } = app.state;
      const back = app.tools[this.home].constructor.title;
      const count = (stiffness ?? []).reduce((sum, [, steps]) => sum + steps.length, 0);
      return [
        make(
          'p',
          {},
          stiffness
            ? `Rigid parts keep their shape, soft parts bend first. Go back to ${back} and pull.`
            : `Draw on the body where it should bend less or more than the rest.${touched() ? ' Drag beside it to turn it.' : ''}`,
        ),
        make(
          'div',
          { class: 'row' },
          button(`Back to ${back}`, () => app.use(this.home).then(() => $('brush')?.focus({ preventScroll: true })), { id: 'done', class: 'main' }),
          button('Erase', () => this.erase(), { id: 'erase', 'aria-pressed': String(this.erasing), title: 'E: strokes make it normal again' }),
          button('Remove all', () => app.commit({ ...app.state, stiffness: null }, 'remove all stiffness'), {
            id: 'clear',
            disabled: !stiffness,
          }),
        ),
        slider(
          'Stiffness',
          { value: this.level, low: -MOST, high: MOST, step: 1, id: 'stiffness', disabled: this.erasing, words },
          (level) => (this.level = level),
          () => app.refresh(),
        ),
        slider('Radius', { value: this.radius, low: LEAST, high: WIDEST, step: STEP, digits: 3, id: 'brush-radius' }, (radius) => {
          this.radius = radius;
          this.place();
        }),
        sites.length > 0 &&
          choice('See', [['stiffness', 'see the stiffness'], ['field', 'see the field follow']], this.seen, (seen) => {
            this.seen = seen;
            app.refresh();
          }, { id: 'see' }),
        button('Colours in Pose', () => ((this.worn = !this.worn), app.refresh()), { id: 'worn', 'aria-pressed': String(this.worn) }),
        facts([['painted vertices', whole(count)]]),
      ];
    }
  };
};
