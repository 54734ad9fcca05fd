// Detail: draw around a part; smooth it, or exaggerate what is there, or give it the detail of a part of another body.
import { roughness } from '../roughness.js';
import { lookAtBoth, openBeside, takeRow } from '../beside.js';

/** Points of a lasso are at least so many pixels apart: what lies between is joined along the surface; a lasso of fewer points encloses nothing. */
const [STEP_PIXELS, LEAST_POINTS] = [8, 5];
/** Colours of a region: inside, its rim, and the rest. */
const [INSIDE, RIM, REST] = [[0.93, 0.62, 0.33], [0.35, 0.2, 0.12], 0.78];

/** Bodies less rough than this have nothing to smooth: those of the samples. Scans and low meshes of games are rougher. */
const ROUGH = 2.7;

/** Copies of a vertex take what the first at their place has. */
function shared(values, size, places) {
  for (let v = 0; v < places.length; ++v)
    if (places[v] !== v) values.copyWithin(size * v, size * places[v], size * (places[v] + 1));
  return values;
}

/** `kit`: what the page has loaded already (studio.js). */
export const tool = (kit) => {
  const { BufferAttribute, BufferGeometry, Line, LineBasicMaterial, LineLoop, normalGroups, readModel } = kit;
  const { button, facts, make, ms, say, slider, whole } = kit;
  return class {
    static key = 'detail';
    static title = 'Detail';
    constructor(app) {
      this.app = app;
      this.mapped = false; // the difference is shown
      this.line = new Line(new BufferGeometry(), new LineBasicMaterial({ color: 0xd8452e, depthTest: false }));
      this.line.frustumCulled = false;
      this.line.visible = false;
      app.view.extras.add(this.line);
      // the curves of the region and of the one that gives its detail
      this.curves = ['body', 'source'].map((side) => {
        const curve = new LineLoop(new BufferGeometry(), new LineBasicMaterial({ color: 0x1c2733 }));
        curve.frustumCulled = false;
        curve.visible = false;
        curve.side = side;
        app.view.extras.add(curve);
        return curve;
      });
    }
    opened() {
      this.points = [];
      this.line.visible = false;
      this.mapped = false;
      this.rough = null;
      this.source?.skin.dispose();
      this.source = null;
    }
    get detail() {
      return this.app.state.detail;
    }
    /** What a link keeps beside the region. */
    settings() {
      return { mapped: this.mapped, source: this.source?.name };
    }
    async adopt({ mapped, source }) {
      this.mapped = mapped;
      if (source && !this.source) {
        const bytes = await this.app.bytesOf(source, 'source');
        if (!bytes) throw new Error(`${source} is not here; open it again in Detail`);
        await this.bring(bytes, source);
      }
      if (this.app.tool === this) this.enter();
    }
    enter() {
      this.rough ??= roughness(
        this.app.body,
        this.app.opened.normals,
        this.app.timeline.places(),
        this.app.opened.report.boundingBoxDiagonal,
      );
      if (this.source) {
        this.source.skin.group.visible = true;
        lookAtBoth(kit, this.app, this.source);
      }
      this.dress();
    }
    leave() {
      this.line.visible = false;
      for (const curve of this.curves) curve.visible = false;
      this.app.legend(null);
      this.app.skin.lend(null);
      if (!this.source) return;
      this.source.skin.group.visible = false;
      this.app.view.frame(this.app.skin.box());
    }

    frame() {
      if (this.source) lookAtBoth(kit, this.app, this.source);
      else this.app.view.frame(this.app.skin.box());
    }

    // ---- the picture
    /** Regions in colour, or how far the surface went. */
    dress() {
      const { app, source } = this;
      const found = this.detail && app.told?.detail;
      const taken = found?.source?.from === source?.name ? found?.source : null;
      if (source && taken) {
        const tint = this.tinted(source.body.vertexCount, taken);
        source.skin.setTint(shared(tint, 3, (source.places ??= normalGroups(source.body.positions, null))));
        source.skin.wear('tint');
      } else source?.skin.wear('own');
      this.showCurves({ body: found?.curve, source: taken?.curve });
      if (!found || !this.mapped) app.legend(null);
      if (!found) {
        app.skin.lend(null);
        return app.skin.wear('own');
      }
      if (this.mapped) return this.map(found);
      app.skin.lend(null);
      app.skin.setTint(shared(this.tinted(app.body.vertexCount, found), 3, app.timeline.places()));
      return app.skin.wear('tint');
    }
    /** The curves as the library joined them: straight along the surface. */
    showCurves(found) {
      for (const curve of this.curves) {
        const points = found[curve.side];
        curve.visible = Boolean(points?.length);
        if (curve.side === 'source' && this.source) {
          const { position, scale } = this.source.skin.group;
          curve.position.copy(position);
          curve.scale.copy(scale);
        }
        if (!points || curve.points === points) continue;
        curve.points = points;
        curve.geometry.dispose();
        curve.geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(points, 3));
      }
    }
    tinted(vertexCount, { inside, rim }) {
      const tint = new Float32Array(3 * vertexCount).fill(REST);
      for (const v of inside) tint.set(INSIDE, 3 * v);
      for (const v of rim) tint.set(RIM, 3 * v);
      return tint;
    }
    /** Out of the surface warm, into it cold, in per cent of the body. */
    map({ inside, away }) {
      const { app } = this;
      const percent = 100 / app.view.size;
      const values = new Float32Array(app.body.vertexCount);
      let most = 0;
      inside.forEach((v, i) => {
        values[v] = percent * away[i];
        most = Math.max(most, Math.abs(values[v]));
      });
      most ||= 1;
      app.skin.lend(shared(values, 1, app.timeline.places()));
      app.skin.wear('field', { low: -most, high: most });
      app.legend({ low: -most, high: most, note: '% of the body, out of it above 0' });
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
    hover(at) {
      if (!this.mapped) return null;
      const hit = this.app.skin.pick(this.app.view.ray(...at));
      return hit && `${this.app.skin.field[hit.vertex].toFixed(2)} %`;
    }

    // ---- loops
    /** What lies under a pixel: of this body, or of the one beside it. */
    under(at, side = null) {
      const { app, source } = this;
      const own = side !== 'source' && app.skin.pick(app.view.ray(...at));
      if (own) return { side: 'body', vertex: own.vertex, position: own.position };
      if (!source || side === 'body') return null;
      const hit = source.pick(app.view.ray(...at));
      return hit && { side: 'source', vertex: hit.vertex, position: source.shown(hit.position) };
    }
    strokeStart(at) {
      const hit = this.under(at);
      if (!hit || (hit.side === 'source' && !this.detail)) return false;
      this.points = [{ at, hit }];
      return true;
    }
    stroke(at) {
      const last = this.points.at(-1);
      if (Math.hypot(at[0] - last.at[0], at[1] - last.at[1]) < STEP_PIXELS) return;
      const hit = this.under(at, last.hit.side);
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
      const { detail, points } = this;
      const curve = points.map(({ hit }) => hit.vertex).filter((v, i, all) => i === 0 || v !== all[i - 1]);
      if (curve.length < LEAST_POINTS) return;
      if (points[0].hit.side === 'source')
        await this.change({ carry: { from: this.source.name, curve, turn: 0 } }, 'carry detail');
      else
        await this.app.commit(
          { ...this.app.state, detail: { curve, seedVertex: 0, rings: 0, weight: detail?.weight ?? 0, carry: null } },
          'draw around a part',
        );
      this.app.view.draw();
    }

    // ---- the body beside
    /** Reads a body and makes it known to the Worker. */
    async bring(bytes, name) {
      const { app } = this;
      const body = await readModel(bytes, name, (data) => app.client.ask('read', { bytes: data, name }));
      const tree = await app.client.ask('detailSource', {
        name,
        positions: body.positions,
        triangles: body.triangles,
      });
      const beside = await openBeside(kit, app, body);
      beside.skin.useTree(tree);
      this.source?.skin.dispose();
      this.source = { ...beside, name };
      this.source.skin.group.visible = app.tool === this;
      app.session?.keep('source', { bytes, name });
    }
    async take(bytes, name) {
      const { app } = this;
      const { body } = app;
      try {
        await this.bring(bytes, name);
      } catch (error) {
        if (app.body === body) app.failed(`${name} was not taken`, error);
        return;
      }
      if (app.body !== body || app.tool !== this) return;
      lookAtBoth(kit, app, this.source);
      // a region that waits for this body gets its detail now
      if (this.detail?.carry?.from === name) await app.again();
      app.refresh();
    }
    change(more, name, join) {
      return this.app.commit({ ...this.app.state, detail: { ...this.detail, ...more } }, name, join);
    }
    sheet() {
      const { app, detail, source } = this;
      const found = detail && app.told?.detail;
      const carry = detail?.carry;
      const slide = (key, valueOf) => [
        (value) => app.preview({ ...app.state, detail: { ...this.detail, ...valueOf(value) } }),
        () => app.commitPreview(key),
      ];
      return [
        make(
          'p',
          {},
          !detail
            ? 'Draw a loop on the body around a part, such as its head.'
            : carry
              ? 'Move the slider: 1 as on the other body, 0 smooth, 2 twice the detail.'
              : 'Move the slider: 1 as it is, 0 smooth, 2 twice the detail.',
        ),
        this.rough < ROUGH &&
          !carry &&
          make(
            'p',
            { class: 'warn', id: 'smooth' },
            detail
              ? 'This body is smooth: the slider finds little to change. Take a body with detail below, such as a scan, and draw a loop on it: its detail comes here.'
              : 'This body is smooth: it has little detail of its own. Draw a loop, and then take a body with detail, such as a scan; or open one.',
          ),
        detail &&
          slider(
            'Detail',
            { value: 1 - detail.weight, low: -1, high: 2, step: 0.02, id: 'amount' },
            ...slide('change detail', (value) => ({ weight: 1 - value })),
          ),
        carry &&
          slider(
            'Turn of the other part',
            { value: carry.turn, low: 0, high: 1, step: 0.02, id: 'turn' },
            ...slide('turn detail', (turn) => ({ carry: { ...this.detail.carry, turn } })),
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
            button('Remove', () => app.commit({ ...app.state, detail: null }, 'remove the region'), { id: 'remove' }),
            button(
              'Difference',
              () => {
                this.mapped = !this.mapped;
                app.refresh();
              },
              { id: 'difference', 'aria-pressed': String(this.mapped) },
            ),
            carry && button('Own detail', () => this.change({ carry: null }, 'own detail'), { id: 'own' }),
          ),
        found?.missing && make('p', { class: 'warn' }, `The detail belongs to ${found.missing}. Choose that creature to see it here.`),
        detail &&
          make(
            'p',
            {},
            source
              ? 'Draw a loop on the left body: its detail goes to your region.'
              : 'Detail of another body: take it, and draw a loop on it.',
          ),
        detail && takeRow(kit, app, (bytes, name) => this.take(bytes, name), app.formats),
        found &&
          facts([
            ['vertices', whole(found.vertexCount)],
            ['rim', whole(found.rimCount)],
            ['time', ms(app.told.milliseconds)],
          ]),
      ];
    }
  };
};
