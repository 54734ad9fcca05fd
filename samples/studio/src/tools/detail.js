// Detail: draw around a part; smooth it, or exaggerate what is there.

/** Points of a lasso are at least so many pixels apart; a lasso of fewer points is no region. */
const [STEP_PIXELS, LEAST_POINTS] = [8, 5];

/** `kit`: what the page has loaded already (studio.js). */
export const tool = ({
  BufferAttribute,
  BufferGeometry,
  Line,
  LineBasicMaterial,
  button,
  facts,
  make,
  ms,
  slider,
  whole,
}) =>
  class {
    static key = 'detail';
    static title = 'Detail';
    constructor(app) {
      this.app = app;
      const geometry = new BufferGeometry();
      this.line = new Line(geometry, new LineBasicMaterial({ color: 0xd8452e, depthTest: false }));
      this.line.frustumCulled = false;
      this.line.visible = false;
      app.view.extras.add(this.line);
    }
    opened() {
      this.points = [];
      this.line.visible = false;
    }
    get detail() {
      return this.app.state.detail;
    }
    enter() {
      this.dress();
    }
    leave() {
      this.line.visible = false;
    }
    /** The region in colour: inside warm, its rim dark. */
    dress() {
      const { skin, body, told } = this.app;
      const found = this.detail && told?.detail;
      if (!found) return skin.wear('own');
      const tint = new Float32Array(3 * body.vertexCount).fill(0.78);
      for (const v of found.inside) tint.set([0.93, 0.62, 0.33], 3 * v);
      for (const v of found.rim) tint.set([0.35, 0.2, 0.12], 3 * v);
      // copies of a vertex take the colour of the first
      const groups = this.app.timeline.places();
      for (let v = 0; v < body.vertexCount; ++v)
        if (groups[v] !== v) tint.copyWithin(3 * v, 3 * groups[v], 3 * groups[v] + 3);
      skin.setTint(tint);
      return skin.wear('tint');
    }
    shaped() {
      this.dress();
      this.app.panel();
    }
    refresh() {
      this.dress();
      this.app.panel();
    }
    marks() {
      return [];
    }
    strokeStart(at) {
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      if (!hit) return false;
      this.points = [{ at, hit }];
      return true;
    }
    stroke(at) {
      const last = this.points.at(-1).at;
      if (Math.hypot(at[0] - last[0], at[1] - last[1]) < STEP_PIXELS) return;
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      if (!hit) return;
      this.points.push({ at, hit });
      this.line.geometry.dispose();
      this.line.geometry = new BufferGeometry().setAttribute(
        'position',
        new BufferAttribute(Float32Array.from(this.points.flatMap(({ hit: { position } }) => position)), 3),
      );
      this.line.visible = true;
      this.app.view.draw();
    }
    strokeCancel() {
      this.points = [];
      this.line.visible = false;
    }
    async strokeEnd() {
      this.line.visible = false;
      const curve = this.points.map(({ hit: { vertex } }) => vertex).filter((v, i, all) => i === 0 || v !== all[i - 1]);
      if (curve.length < LEAST_POINTS) return;
      await this.app.commit(
        { ...this.app.state, detail: { curve, seedVertex: 0, rings: 0, weight: this.detail?.weight ?? 0 } },
        'draw around a part',
      );
      this.app.view.draw();
    }
    change(more, name, join) {
      return this.app.commit({ ...this.app.state, detail: { ...this.detail, ...more } }, name, join);
    }
    sheet() {
      const { detail } = this;
      const found = detail && this.app.told?.detail;
      return [
        make(
          'p',
          {},
          detail
            ? 'Move the slider: 1 as it is, 0 smooth, 2 twice the detail.'
            : 'Draw a loop on the body around a part, such as its head.',
        ),
        detail &&
          slider(
            'Detail',
            { value: 1 - detail.weight, low: -1, high: 2, step: 0.02, id: 'amount' },
            (value) => this.app.preview({ ...this.app.state, detail: { ...detail, weight: 1 - value } }),
            () => this.app.commitPreview('change detail'),
          ),
        detail &&
          make(
            'div',
            { class: 'row' },
            button('Larger', () => this.change({ rings: detail.rings + 1 }, 'larger region', 'rings'), {
              id: 'larger',
            }),
            button('Smaller', () => this.change({ rings: detail.rings - 1 }, 'smaller region', 'rings'), {
              id: 'smaller',
            }),
            button('Remove', () => this.app.commit({ ...this.app.state, detail: null }, 'remove the region'), {
              id: 'remove',
            }),
          ),
        found &&
          facts([
            ['vertices', whole(found.vertexCount)],
            ['rim', whole(found.rimCount)],
            ['time', ms(this.app.told.milliseconds)],
          ]),
      ];
    }
  };
