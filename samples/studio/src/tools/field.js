// Field: sites with values; drag one and the field follows.
import { brushButton, button, facts, make, ms, slider, touched, whole } from '../ui.js';

/** A key moves a site by this many pixels along the surface: half of its dot, so that it is seen and can be aimed. */
const NUDGE_PIXELS = 12;

export class FieldTool {
  static key = 'field';
  static title = 'Field';
  static icon = 'M4 16c4-6 12-6 16 0M6 11c3-4 9-4 12 0M9 7c2-2 4-2 6 0M12 19.5v.1';
  constructor(app) {
    this.app = app;
  }
  opened() {
    this.chosen = null;
    this.ends = null;
  }
  get sites() {
    return this.app.state.sites;
  }
  present() {
    return this.sites.find(({ id }) => id === this.chosen) ?? null;
  }
  async enter() {
    this.dress();
    if (!this.ends) {
      this.ends = await this.app.client.ask('extremities');
      this.app.refresh();
    }
  }
  leave() {
    this.app.legend(null);
  }
  range() {
    const values = this.sites.map(({ value }) => value);
    return [Math.min(0, ...values), Math.max(1, ...values)];
  }
  dress() {
    const [low, high] = this.range();
    this.app.skin.wear(this.sites.length ? 'field' : 'own', { low, high });
    this.app.legend(this.sites.length ? { low, high, hatch: this.app.fieldTold?.unreachedVertexCount > 0 } : null);
  }
  refresh() {
    this.dress();
    this.app.panel();
  }
  marks() {
    const free = (this.ends ?? []).filter(
      ({ vertex }) => !this.sites.some(({ corners, barycentrics }) => corners[barycentrics.indexOf(1)] === vertex),
    );
    return [
      ...this.sites.map((site, i) => ({
        id: site.id,
        place: this.app.skin.at(site),
        label: `site ${i + 1}, value ${site.value.toFixed(2)}`,
        chosen: site.id === this.chosen,
        colour: this.colour(site.value),
      })),
      ...free.map(({ vertex }, i) => ({
        id: `e${vertex}`,
        vertex,
        place: this.app.skin.at({ corners: [vertex], barycentrics: [1] }),
        label: `end ${i + 1}, proposed site`,
        offer: true,
        pulse: !this.sites.length && i === 0,
        say: !this.sites.length && i === 0 ? 'click me' : null,
        colour: '#777',
      })),
    ];
  }
  colour(value) {
    const [low, high] = this.range();
    const t = (value - low) / (high - low);
    return t < 0.34 ? '#2d5fb8' : t < 0.67 ? '#b9b2a0' : '#d2691e';
  }
  next() {
    return this.sites.length && this.sites.at(-1).value > 0.5 ? 0 : 1;
  }
  add(place) {
    const id = `s${this.app.nextId()}`;
    this.chosen = id;
    return this.app.commit(
      { ...this.app.state, sites: [...this.sites, { id, value: this.next(), soft: false, ...place }] },
      'add a site',
    );
  }
  hit([x, y]) {
    const hit = this.app.skin.pick(this.app.view.ray(x, y));
    return hit && { corners: hit.corners, barycentrics: hit.barycentrics };
  }
  click(at) {
    const place = this.hit(at);
    if (place) return this.add(place);
    this.chosen = null;
    return this.app.refresh();
  }
  choose(mark) {
    if (mark.offer) return this.add(this.app.cornerOf(mark.vertex));
    this.chosen = this.chosen === mark.id ? null : mark.id;
    return this.app.refresh();
  }
  with(id, change) {
    return { ...this.app.state, sites: this.sites.map((site) => (site.id === id ? { ...site, ...change } : site)) };
  }
  dragStart(mark) {
    if (!mark.offer) this.chosen = mark.id;
  }
  drag(mark, at) {
    const place = mark.offer ? null : this.hit(at);
    if (place) this.app.preview(this.with(mark.id, place));
  }
  dragEnd(mark) {
    return mark.offer ? this.choose(mark) : this.app.commitPreview('move a site');
  }
  dragCancel() {
    this.app.giveUp();
  }
  key(mark, event) {
    const ways = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    if (mark.offer) return false;
    if (ways[event.key]) {
      const { x, y } = this.app.view.onScreen(mark.place);
      const [dx, dy] = ways[event.key];
      const place = this.hit([x + dx * NUDGE_PIXELS, y + dy * NUDGE_PIXELS]);
      if (place) this.app.commit(this.with(mark.id, place), 'move a site', `site ${mark.id}`);
      return true;
    }
    if (event.key === 'Delete' || event.key === 'Backspace') return (this.remove(mark.id), true);
    return false;
  }
  remove(id) {
    this.chosen = null;
    return this.app.commit({ ...this.app.state, sites: this.sites.filter((site) => site.id !== id) }, 'remove a site');
  }
  hover(at) {
    if (!this.sites.length) return null;
    const hit = this.app.skin.pick(this.app.view.ray(...at));
    if (!hit) return null;
    const { field, reached } = this.app.skin;
    if (!reached[hit.vertex]) return 'no site reaches this piece';
    return hit.corners.reduce((sum, v, i) => sum + hit.barycentrics[i] * field[v], 0).toFixed(3);
  }
  sheet() {
    const site = this.present();
    const told = this.app.fieldTold;
    return [
      make(
        'p',
        {},
        this.sites.length
          ? `Drag a site: the field follows.${touched() ? '' : ' Hover over the body to read a value.'}`
          : 'Click the body, or a proposed end, to put the first site there.',
      ),
      site &&
        slider(
          'Value',
          { value: site.value, low: -1, high: 2, id: 'value' },
          (value) => this.app.preview(this.with(site.id, { value })),
          () => this.app.commitPreview('set a value'),
        ),
      make(
        'div',
        { class: 'row' },
        site &&
          button(
            site.soft ? 'Make it hard' : 'Make it soft',
            () => this.app.commit(this.with(site.id, { soft: !site.soft }), 'hard or soft'),
            { id: 'soft' },
          ),
        site && button('Remove', () => this.remove(site.id), { id: 'remove' }),
        this.sites.length > 0 &&
          button('Remove all sites', () => this.app.commit({ ...this.app.state, sites: [] }, 'remove all sites'), {
            id: 'clear',
          }),
        brushButton(this.app),
      ),
      told?.unreachedVertexCount > 0 &&
        this.sites.length > 0 &&
        make(
          'p',
          { class: 'warn' },
          `${whole(told.unreachedVertexCount)} vertices belong to pieces without a site; they are hatched. Add a site there.`,
        ),
      facts([['sites', this.sites.length], this.sites.length && told && ['field', ms(told.milliseconds)]]),
    ];
  }
}
