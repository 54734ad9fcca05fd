// Quads: a quad mesh of the body along its curvature, made in a Worker of its own; it can be cancelled. Edges follow strokes
// that the user draws and drags: the mesh follows at once without relaxation, and with it at the end.
/** Length of an edge as part of the size of the body: the library's own default. */
const EDGE = 0.022;
/** HF_NO_INDEX: no relaxation and no fitting, which take most of the time. */
const NO_RELAXATION = 0xffffffff;
/** A stroke has a place every so many pixels: a fine body has a triangle about there. */
const STEP_PIXELS = 6;
/** Fewer places say no direction. */
const LEAST_PLACES = 3;
const INK = 0xd8452e;

/** `kit`: what the page has loaded already (studio.js). */
export const tool = (kit) => {
  const { BufferAttribute, BufferGeometry, DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial } =
    kit;
  const { button, choice, facts, make, ms, slider, whole } = kit;
  return class {
    static key = 'quads';
    static title = 'Quads';
    constructor(app) {
      this.app = app;
      this.edge = EDGE;
      this.crease = 0;
      this.mirror = '';
      this.relaxed = true; // what is shown
      this.followed = 0; // meshes made while a stroke was drawn or dragged
      this.ink = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ color: INK, depthTest: false }));
      this.ink.frustumCulled = false;
      this.ink.renderOrder = 1;
      app.view.extras.add(this.ink);
    }
    opened() {
      this.cancel();
      this.#end();
      this.result = null;
      this.chosen = null;
      this.shown = undefined;
      this.relaxed = true;
      this.#clear();
    }
    enter() {
      this.dress();
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
    /** After every step, undo and redo too: the mesh is that of the strokes that are there. */
    refresh() {
      this.#drawStrokes();
      const { live, state } = this.app;
      if (!live && !this.busy && (this.shown !== state.strokes || !this.relaxed)) this.#follow(true);
      this.app.panel();
    }
    shaped() {
      this.#drawStrokes();
      if (this.result) this.#place();
    }

    // ---- strokes
    get strokes() {
      return this.app.state.strokes ?? [];
    }
    #hit(at) {
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      return hit && { corners: hit.corners, barycentrics: hit.barycentrics };
    }
    #preview(strokes) {
      this.app.preview({ ...this.app.history.state, strokes });
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
      if (pen.places.length >= LEAST_PLACES) this.#preview([...pen.before, { id: pen.id, places: pen.places }]);
    }
    strokeCancel() {
      this.app.settle();
      this.refresh();
    }
    strokeEnd() {
      return this.app.commitPreview('draw a stroke');
    }
    marks() {
      return this.strokes.map(({ id, places }, i) => ({
        id,
        place: this.app.skin.at(places[places.length >> 1]),
        label: `stroke ${i + 1}`,
        chosen: id === this.chosen,
        colour: '#d8452e',
      }));
    }
    choose({ id }) {
      this.chosen = this.chosen === id ? null : id;
      this.app.refresh();
    }
    dragStart({ id }) {
      this.chosen = id;
      const { places } = this.strokes.find((stroke) => stroke.id === id);
      this.held = places.map((place) => this.app.view.onScreen(this.app.skin.at(place)));
    }
    /** The stroke moves over the picture and lies on the body where it arrives. */
    drag({ id }, [x, y], from) {
      const places = this.held.map((p) => this.#hit([p.x + x - from[0], p.y + y - from[1]])).filter(Boolean);
      if (places.length < LEAST_PLACES) return;
      this.#preview(this.strokes.map((stroke) => (stroke.id === id ? { id, places } : stroke)));
    }
    dragEnd() {
      return this.app.commitPreview('move a stroke');
    }
    key({ id }, { key }) {
      if (key !== 'Delete' && key !== 'Backspace') return false;
      this.#set(
        this.strokes.filter((stroke) => stroke.id !== id),
        'remove a stroke',
      );
      return true;
    }
    #set(strokes, name) {
      this.chosen = null;
      return this.app.commit({ ...this.app.state, strokes }, name);
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
    /** Directions along the strokes of the body at rest, at the corners of the triangles under them. */
    #guides() {
      const { positions } = this.app.body;
      const [guideVertices, guideVectors] = [[], []];
      for (const { places } of this.strokes) {
        const points = places.map((place) => this.app.skin.at(place, positions));
        points.slice(1).forEach((point, i) => {
          const vector = point.map((x, k) => x - points[i][k]);
          if (!Math.hypot(...vector)) return;
          for (const vertex of places[i].corners) {
            guideVertices.push(vertex);
            guideVectors.push(...vector);
          }
        });
      }
      return guideVertices.length ? { guideVertices, guideVectors } : {};
    }

    // ---- making
    #options(relaxed) {
      const { app, mirror } = this;
      const options = { edgeLength: this.edge * app.opened.report.boundingBoxDiagonal };
      if (mirror !== '') {
        const along = app.body.positions.filter((_, i) => i % 3 === Number(mirror));
        const [low, high] = along.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]);
        options.symmetryPlane = [0, 1, 2].map((k) => Number(k === Number(mirror))).concat((low + high) / 2);
      }
      return { ...options, creaseAngle: this.crease, relaxCount: relaxed ? 0 : NO_RELAXATION, ...this.#guides() };
    }
    /** Asks the Worker of the quads, which is started when it is needed; null when the body changed meanwhile. */
    async #ask(relaxed) {
      const { app } = this;
      if (!this.line) {
        const line = app.client.line();
        const { positions, triangles } = app.body;
        line.opened = app.client.ask('factor').then((factor) => {
          // a Worker that was ended never answers
          if (line !== this.line) throw Object.assign(new Error('cancelled'), { codeName: 'cancelled' });
          return line.ask('quadsOpen', { positions, triangles, factor }, [factor.buffer]);
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
      const strokes = app.state.strokes;
      const result = await line.ask('quads', this.#options(relaxed));
      if (line !== this.line) return null;
      this.result = result;
      this.shown = strokes;
      this.relaxed = relaxed;
      this.error = null;
      this.#draw();
      return result;
    }
    /** Follows the strokes: while a mesh is made, the newest strokes wait. */
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
        this.shown = this.app.state.strokes;
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
        await this.#ask(true);
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
      if (this.app.tool === this) this.app.refresh();
    }
    #clear() {
      if (!this.lines) return;
      for (const thing of [this.lines, this.faces]) {
        thing.geometry.dispose();
        thing.material.dispose();
        thing.removeFromParent();
      }
      this.lines = null;
    }
    #draw() {
      this.#clear();
      const { faces, positions } = this.result.mesh;
      const edges = new Set();
      const count = positions.length / 3;
      for (let i = 0; i < faces.length; ++i) {
        const [a, b] = [faces[i], faces[i % 4 === 3 ? i - 3 : i + 1]];
        edges.add(Math.min(a, b) * count + Math.max(a, b));
      }
      const pairs = new Uint32Array(2 * edges.size);
      let at = 0;
      for (const key of edges) {
        pairs[at++] = Math.floor(key / count);
        pairs[at++] = key % count;
      }
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions.length), 3));
      geometry.setIndex(new BufferAttribute(pairs, 1));
      this.lines = new LineSegments(geometry, new LineBasicMaterial({ color: 0x1c2733 }));
      this.lines.frustumCulled = false;
      const corners = [];
      for (let i = 0; i < faces.length; i += 4) {
        const [a, b, c, d] = faces.subarray(i, i + 4);
        corners.push(a, b, c, a, c, d);
      }
      const surface = new BufferGeometry();
      surface.setAttribute('position', geometry.getAttribute('position'));
      surface.setIndex(corners);
      // faces lie a little behind their lines
      const paint = new MeshLambertMaterial({
        color: 0xd9d4c8,
        side: DoubleSide,
        flatShading: true,
        polygonOffset: true,
        polygonOffsetFactor: 1,
        polygonOffsetUnits: 1,
      });
      this.faces = new Mesh(surface, paint);
      this.faces.frustumCulled = false;
      this.lines.add(this.faces);
      this.app.view.extras.add(this.lines);
      this.#place();
    }
    /** The lines follow the body: every corner is a place in a triangle. */
    #place() {
      const { corners, barycentrics } = this.result.mesh;
      const { positions } = this.app.shape;
      const place = this.lines.geometry.getAttribute('position');
      for (let v = 0; v < place.count; ++v)
        for (let k = 0; k < 3; ++k) {
          let sum = 0;
          for (let i = 0; i < 3; ++i) {
            const c = 3 * corners[3 * v + i] + k;
            sum += barycentrics[3 * v + i] * positions[c];
          }
          place.array[3 * v + k] = sum;
        }
      place.needsUpdate = true;
      this.app.view.draw();
    }
    sheet() {
      const { result, busy } = this;
      const disabled = Boolean(busy);
      return [
        make(
          'p',
          {},
          this.drawing
            ? 'Draw on the body: edges follow the stroke. Drag its dot, and the quads follow.'
            : 'Covers the body with quads that follow its shape. A finer size takes longer.',
        ),
        slider(
          'Size of a quad',
          { value: this.edge, low: 0.01, high: 0.06, step: 0.001, digits: 3, id: 'edge', disabled },
          (value) => (this.edge = value),
        ),
        slider(
          'Creases from, degrees',
          { value: this.crease, low: 0, high: 180, step: 5, digits: 0, id: 'crease', disabled },
          (value) => (this.crease = value),
        ),
        choice(
          'Mirror',
          [
            ['', 'no mirror'],
            [0, 'mirror in x'],
            [1, 'mirror in y'],
            [2, 'mirror in z'],
          ],
          this.mirror,
          (value) => (this.mirror = value),
          { id: 'mirror', disabled },
        ),
        make(
          'div',
          { class: 'row' },
          button(
            'Draw strokes',
            () => {
              this.drawing = !this.drawing;
              this.app.refresh();
            },
            { id: 'draw', 'aria-pressed': String(Boolean(this.drawing)), disabled },
          ),
          this.strokes.length > 0 &&
            button('Remove strokes', () => this.#set([], 'remove all strokes'), { id: 'clear', disabled }),
        ),
        make(
          'div',
          { class: 'row' },
          button('Make quads', () => this.run(), { class: 'main', id: 'make', disabled }),
          busy && button('Cancel', () => this.cancel(), { id: 'cancel' }),
        ),
        busy &&
          make(
            'div',
            { class: 'row', role: 'status' },
            make('progress', { 'aria-label': 'making quads' }),
            make('span', { id: 'quads-clock' }, '0 s'),
          ),
        this.error && make('p', { class: 'warn' }, this.error),
        result &&
          facts([
            ['quads', whole(result.info.faceCount)],
            ['corners', whole(result.info.vertexCount)],
            ['edge', result.info.edgeLength.toPrecision(3)],
            ['time', ms(result.milliseconds)],
          ]),
      ];
    }
  };
};
