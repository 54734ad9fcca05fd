// Quads: a quad mesh of the body along its curvature, made in a Worker of its own; it can be cancelled. Edges follow strokes
// that the user draws and drags, and 3 or 5 quads meet at poles: the mesh follows at once without relaxation, and with it at
// the end.
import { quadOptions } from '../quad_options.js';
import { quadSheet, rounded } from '../quad_sheet.js';
import { areaOf, startCount } from '../quad_size.js';
import { drawQuads, dropQuads, placeQuads } from '../quad_lines.js';

/** A stroke has a place every so many pixels: a fine body has a triangle about there. */
const STEP_PIXELS = 6;
/** Fewer places say no direction. */
const LEAST_PLACES = 3;
const INK = 0xd8452e;
/** Colours of the dots of poles, by the number of quads that meet there. */
const DOTS = { 3: '#1f78b4', 5: '#7b3fa0' };
/** An arrow key moves a pole by so many pixels: less than a quad, which it would jump over. */
const NUDGE_PIXELS = 8;

/** `kit`: what the page has loaded already (studio.js). */
export const tool = (kit) => {
  const { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments } = kit;
  return class {
    static key = 'quads';
    static title = 'Quads';
    constructor(app) {
      this.app = app;
      this.edge = null; // the length of an edge as part of the size of the body
      this.crease = 0;
      this.mirror = '';
      this.relaxed = true; // what is shown
      this.followed = 0; // meshes made while a stroke or a pole was drawn or dragged
      this.placing = 0; // a click places a pole of that many quads; 0: none
      this.ink = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: INK, depthTest: false }));
      this.ink.frustumCulled = false;
      this.ink.renderOrder = 1;
      app.view.extras.add(this.ink);
    }
    opened() {
      this.result = null; // of another body: it is not kept
      this.cancel();
      this.#end();
      this.edge = null;
      this.area = areaOf(this.app.body);
      this.chosen = null;
      this.shown = {};
      this.relaxed = true;
      this.#clear();
    }
    /** What a link keeps beside strokes and poles. */
    settings() {
      const { edge, crease, mirror } = this;
      return { edge, crease, mirror };
    }
    async adopt({ edge, crease, mirror }) {
      Object.assign(this, { edge, crease, mirror });
      const kept = await this.app.session?.kept('quads');
      if (!kept) return;
      const { strokes, poles } = this.app.state;
      const { result, ...made } = kept;
      const same = JSON.stringify([made.strokes, made.poles]) === JSON.stringify([strokes, poles]);
      this.result = result;
      this.shown = same ? { strokes, poles } : made;
      this.#draw();
      if (this.app.tool === this) this.dress();
      // the mesh was on its way when the page was left: it is made again, as after an undo
      if (!same) this.#follow(true);
    }
    /** What is shown, with the strokes and poles that it was made of. */
    #keep() {
      this.app.session?.keep('quads', { result: this.result, ...this.shown });
    }
    enter() {
      this.dress();
    }
    /** The number of quads and the length of their edges are one: the area of the body stands between them. */
    get count() {
      if (this.edge === null) {
        const start = rounded(startCount(this.app, this.area));
        if (!this.app.skin.bvh) return start;
        this.count = start;
      }
      return this.area / (this.edge * this.app.opened.report.boundingBoxDiagonal) ** 2;
    }
    set count(count) {
      this.edge = Math.sqrt(this.area / count) / this.app.opened.report.boundingBoxDiagonal;
    }
    leave() {
      if (this.lines) this.lines.visible = false;
      this.ink.visible = false;
      this.app.skin.group.visible = true;
    }
    dress() {
      const { skin } = this.app;
      skin.group.visible = !this.result;
      this.#drawStrokes();
      if (!this.result) return skin.wear('own');
      this.#place();
      this.lines.visible = true;
      return undefined;
    }
    /** After every step, undo and redo too: the mesh is that of the strokes and poles that are there. */
    refresh() {
      this.#drawStrokes();
      const { live, state } = this.app;
      if (!live && !this.busy && !(this.shows(state) && this.relaxed)) this.#follow(true);
      this.app.panel();
    }
    shaped() {
      this.#drawStrokes();
      if (this.result) this.#place();
    }

    // ---- strokes and poles
    get strokes() {
      return this.app.state.strokes ?? [];
    }
    get poles() {
      return this.app.state.poles ?? [];
    }
    /** Whether the mesh is that of the strokes and poles of a state. */
    shows({ strokes, poles }) {
      return this.shown.strokes === strokes && this.shown.poles === poles;
    }
    #isPole(id) {
      return this.poles.some((pole) => pole.id === id);
    }
    #hit(at) {
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      return hit && { corners: hit.corners, barycentrics: hit.barycentrics };
    }
    #preview(change) {
      this.app.preview({ ...this.app.history.state, ...change });
      this.#drawStrokes();
      this.#follow(false);
    }
    strokeStart(at) {
      const place = this.drawing ? this.#hit(at) : null;
      if (!place) return false;
      const number = 1 + Math.max(0, ...this.strokes.map(({ id }) => Number(id.slice(1))));
      this.pen = { at, id: `k${number}`, places: [place], before: this.strokes };
      return true;
    }
    stroke(at) {
      const { pen } = this;
      const [dx, dy] = [at[0] - pen.at[0], at[1] - pen.at[1]];
      const steps = Math.floor(Math.hypot(dx, dy) / STEP_PIXELS);
      if (!steps) return;
      for (let i = 1; i <= steps; ++i) {
        const place = this.#hit([pen.at[0] + (dx * i) / steps, pen.at[1] + (dy * i) / steps]);
        if (place) pen.places = [...pen.places, place];
      }
      pen.at = at;
      this.chosen = pen.id;
      if (pen.places.length >= LEAST_PLACES)
        this.#preview({ strokes: [...pen.before, { id: pen.id, places: pen.places }] });
    }
    strokeCancel() {
      this.app.giveUp();
    }
    dragCancel() {
      this.strokeCancel();
    }
    strokeEnd() {
      return this.app.commitPreview('draw a stroke');
    }
    /** A pole is placed where the user clicks. */
    click(at) {
      const place = this.placing ? this.#hit(at) : null;
      if (!place) return undefined;
      const id = `q${1 + Math.max(0, ...this.poles.map((pole) => Number(pole.id.slice(1))))}`;
      const quads = this.placing;
      return this.set({ poles: [...this.poles, { id, quads, ...place }] }, `place a pole of ${quads}`, id);
    }
    #moved(id, place) {
      return { poles: this.poles.map((pole) => (pole.id === id ? { ...pole, ...place } : pole)) };
    }
    marks() {
      const poles = this.poles.map(({ id, quads, ...place }, i) => ({
        id,
        place: this.app.skin.at(place),
        label: `pole ${i + 1}, of ${quads} quads`,
        chosen: id === this.chosen,
        colour: DOTS[quads],
      }));
      const strokes = this.strokes.map(({ id, places }, i) => ({
        id,
        place: this.app.skin.at(places[places.length >> 1]),
        label: `stroke ${i + 1}`,
        chosen: id === this.chosen,
        colour: '#d8452e',
      }));
      return [...strokes, ...poles];
    }
    choose({ id }) {
      this.chosen = this.chosen === id ? null : id;
      this.app.refresh();
    }
    dragStart({ id }) {
      this.chosen = id;
      if (this.#isPole(id)) return;
      const { places } = this.strokes.find((stroke) => stroke.id === id);
      this.held = places.map((place) => this.app.view.onScreen(this.app.skin.at(place)));
    }
    /** A stroke moves over the picture and lies on the body where it arrives. A pole is where the pointer is. */
    drag({ id }, [x, y], from) {
      if (this.#isPole(id)) {
        const place = this.#hit([x, y]);
        if (place) this.#preview(this.#moved(id, place));
        return;
      }
      const places = this.held.map((p) => this.#hit([p.x + x - from[0], p.y + y - from[1]])).filter(Boolean);
      if (places.length < LEAST_PLACES) return;
      this.#preview({ strokes: this.strokes.map((stroke) => (stroke.id === id ? { id, places } : stroke)) });
    }
    dragEnd({ id }) {
      return this.app.commitPreview(this.#isPole(id) ? 'move a pole' : 'move a stroke');
    }
    key({ id, place }, { key }) {
      const others = (list) => list.filter((one) => one.id !== id);
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[key];
      if (way && this.#isPole(id)) {
        const { x, y } = this.app.view.onScreen(place);
        const hit = this.#hit([x + way[0] * NUDGE_PIXELS, y + way[1] * NUDGE_PIXELS]);
        if (hit) this.set(this.#moved(id, hit), 'move a pole', id, `pole ${id}`);
        return true;
      }
      if (key !== 'Delete' && key !== 'Backspace') return false;
      if (this.#isPole(id)) this.set({ poles: others(this.poles) }, 'remove a pole');
      else this.set({ strokes: others(this.strokes) }, 'remove a stroke');
      return true;
    }
    /** A step with other strokes or poles. */
    set(change, name, chosen = null, join = null) {
      this.chosen = chosen;
      return this.app.commit({ ...this.app.state, ...change }, name, join);
    }
    #drawStrokes() {
      const { app, ink } = this;
      ink.visible = app.tool === this;
      const ends = this.strokes.flatMap(({ places }) => {
        const points = places.map((place) => app.skin.at(place));
        return points.slice(1).flatMap((point, i) => [...points[i], ...point]);
      });
      ink.geometry.dispose();
      ink.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(Float32Array.from(ends), 3));
      app.view.draw();
    }
    // ---- making
    /** Asks the Worker of the quads, which is started when it is needed; null when the body changed meanwhile. */
    async #ask(relaxed) {
      const { app } = this;
      this.count = this.count; // a body that has just come: what it starts with
      if (!this.line) {
        const line = app.client.line();
        const { positions, triangles, skeleton } = app.body;
        line.opened = app.client.ask('factor').then((factor) => {
          // a Worker that was ended never answers
          if (line !== this.line) throw Object.assign(new Error('cancelled'), { codeName: 'cancelled' });
          return line.ask('quadsOpen', { positions, triangles, skeleton, factor }, [factor.buffer]);
        });
        this.line = line;
      }
      const { line } = this;
      try {
        // a stroke and a click can ask while it is opened
        await line.opened;
      } catch (error) {
        if (line === this.line) this.#end();
        throw error;
      }
      if (line !== this.line) return null;
      const { strokes, poles } = app.state;
      const result = await line.ask('quads', quadOptions(kit, this, relaxed));
      if (line !== this.line) return null;
      this.result = result;
      this.shown = { strokes, poles };
      this.relaxed = relaxed;
      this.error = null;
      if (relaxed) this.#keep();
      this.#draw();
      return result;
    }
    /** Follows the strokes and poles: while a mesh is made, the newest ones wait. */
    async #follow(relaxed) {
      this.wanted = { relaxed };
      if (this.following) return;
      this.following = true;
      try {
        while (this.wanted) {
          const { relaxed: now } = this.wanted;
          this.wanted = null;
          if (await this.#ask(now)) this.followed += !now;
          if (this.app.tool === this) this.dress();
        }
      } catch (error) {
        if (error.codeName !== 'cancelled') this.error = error.message;
        const { strokes, poles } = this.app.state;
        this.shown = { strokes, poles };
        this.relaxed = true;
      } finally {
        this.following = false;
        if (this.app.tool === this && !this.app.live) this.app.refresh();
      }
    }
    #end() {
      this.line?.end();
      this.line = null;
    }
    async run() {
      const { app } = this;
      const begin = performance.now();
      this.error = null;
      this.busy = { begin, cancelled: false };
      const mine = this.busy;
      app.refresh();
      const timer = setInterval(() => {
        const clock = document.getElementById('quads-clock');
        if (clock) clock.textContent = `${((performance.now() - begin) / 1000).toFixed(0)} s`;
      }, 250);
      try {
        // evening out and fitting take most of the time: what they start from is shown at once
        if (await this.#ask(false)) {
          if (app.tool === this) this.dress();
          app.panel();
          await this.#ask(true);
        }
      } catch (error) {
        if (!mine.cancelled) this.error = error.message;
      } finally {
        clearInterval(timer);
        if (this.busy === mine) this.busy = null;
        if (app.tool === this) {
          this.dress();
          app.refresh();
        }
      }
    }
    cancel() {
      if (!this.busy) return;
      this.busy.cancelled = true;
      this.#end();
      this.busy = null;
      this.relaxed = true; // the first form stays, where there is one
      if (this.result) this.#keep();
      if (this.app.tool === this) this.app.refresh();
    }
    #clear() {
      if (this.lines) dropQuads(this.lines);
      this.lines = null;
    }
    #draw() {
      this.#clear();
      this.lines = drawQuads(kit, this.result.mesh);
      this.app.view.extras.add(this.lines);
      this.lines.visible = this.app.tool === this; // they can come when another tool is open
      this.#place();
    }
    #place() {
      placeQuads(this.lines, this.result.mesh, this.app.shape.positions);
      this.app.view.draw();
    }
    sheet() {
      return quadSheet(kit, this);
    }
  };
};
