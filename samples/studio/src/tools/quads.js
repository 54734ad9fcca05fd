// Quads: a quad mesh of the body, made in a Worker of its own; it can be cancelled.
/** Length of an edge as part of the size of the body: the library's own default. */
const EDGE = 0.022;
/** Quads whose edges follow the curvature: HF_QUADS_FIELD. They alone take creases. */
const FIELD = 2;

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
      this.kind = 0;
      this.crease = 0;
    }
    opened() {
      this.cancel();
      this.result = null;
      this.#clear();
    }
    enter() {
      this.dress();
    }
    leave() {
      if (this.lines) this.lines.visible = false;
      this.app.skin.group.visible = true;
    }
    dress() {
      const { skin } = this.app;
      skin.group.visible = !this.result;
      if (!this.result) return skin.wear('own');
      this.#place();
      this.lines.visible = true;
      return undefined;
    }
    refresh() {
      this.app.panel();
    }
    marks() {
      return [];
    }
    shaped() {
      if (this.result) this.#place();
    }
    async run() {
      const { app } = this;
      const { positions, triangles } = app.body;
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
        const factor = await app.client.ask('factor');
        if (mine.cancelled) return;
        const job = app.client.job(
          'quads',
          {
            positions,
            triangles,
            factor,
            edgeLength: this.edge * app.opened.report.boundingBoxDiagonal,
            kind: this.kind,
            creaseAngle: this.kind === FIELD ? this.crease : 0,
          },
          [factor.buffer],
        );
        mine.job = job;
        const result = await job.answer;
        if (mine.cancelled) return;
        this.result = result;
        this.#draw();
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
      this.busy.job?.cancel();
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
      const { faceStarts, faceCorners, positions } = this.result.mesh;
      const edges = new Set();
      const count = positions.length / 3;
      for (let f = 0; f + 1 < faceStarts.length; ++f)
        for (let i = faceStarts[f]; i < faceStarts[f + 1]; ++i) {
          const [a, b] = [faceCorners[i], faceCorners[i + 1 < faceStarts[f + 1] ? i + 1 : faceStarts[f]]];
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
      for (let f = 0; f + 1 < faceStarts.length; ++f)
        for (let i = faceStarts[f] + 2; i < faceStarts[f + 1]; ++i)
          corners.push(faceCorners[faceStarts[f]], faceCorners[i - 1], faceCorners[i]);
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
      return [
        make('p', {}, 'Covers the body with quads that follow its shape. A finer size takes longer.'),
        slider(
          'Size of a quad',
          { value: this.edge, low: 0.01, high: 0.06, step: 0.001, digits: 3, id: 'edge', disabled: Boolean(busy) },
          (value) => (this.edge = value),
        ),
        choice(
          'Kind',
          [
            [0, 'even size'],
            [1, 'quads alone, sizes vary'],
            [FIELD, 'along the curvature'],
          ],
          this.kind,
          (value) => {
            this.kind = Number(value);
            this.app.panel();
          },
          { id: 'kind', disabled: Boolean(busy) },
        ),
        this.kind === FIELD &&
          slider(
            'Creases from, degrees',
            { value: this.crease, low: 0, high: 180, step: 5, digits: 0, id: 'crease', disabled: Boolean(busy) },
            (value) => (this.crease = value),
          ),
        make(
          'div',
          { class: 'row' },
          button('Make quads', () => this.run(), { class: 'main', id: 'make', disabled: Boolean(busy) }),
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
            ['quads', whole(result.info.quadCount)],
            ['faces', whole(result.info.faceCount)],
            ['corners', whole(result.info.vertexCount)],
            ['edge', result.info.edgeLength.toPrecision(3)],
            ['time', ms(result.milliseconds)],
          ]),
      ];
    }
  };
};
