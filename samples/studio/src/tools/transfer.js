// Transfer: a clip of another body played on this one, side by side. Pairs are proposed and can be left out.
import { lookAtBoth, openBeside, takeRow } from '../beside.js';

/** Frames a second of the saved walk: of animation files. */
const FRAME_RATE = 30;
/** Gaps between pieces below this part of the box are not said: 3 pixels of a body that fills the picture. */
const GAP_SAID = 0.005;
/** Hues of neighbouring pairs are this part of the circle apart: the golden ratio keeps all apart, however many there are. */
const HUE_STEP = 0.61803398875;
/**
 * What is turned without a new preparation: name, neutral, least and most value, and the part of the body that it needs. The library
 * takes a stride of 0.1 to 4, say: a slider of wider bounds is harder to set.
 */
const DIALS = [
  ['stride', 'Stride', 1, 0.5, 2, null],
  ['hipHeightShare', 'Hip height', 0, -0.3, 0.3, null],
  ['neckFollow', 'Neck follows', 0, -1, 1, 'neck'],
  ['tailFollow', 'Tail follows', 0, -1, 1, 'tail'],
  ['armSpace', 'Room at the arms', 0, -0.8, 0.8, 'arm'],
  ['longFollow', 'Long parts follow', 0, 0, 1, null],
];

/** `kit`: what the page has loaded already (studio.js). */
export const tool = (kit) => {
  const { readModel, writeGlb, smoothNormals, lengthOf, localsOf, playedAt, skinnedGlb } = kit;
  const { $, button, choice, facts, make, ms, say, slider } = kit;
  return class {
    static key = 'transfer';
    static title = 'Transfer';
    constructor(app) {
      this.app = app;
    }
    opened() {
      this.#drop();
      this.chosenPair = null;
    }
    #drop() {
      this.playing = false;
      this.source?.skin.dispose();
      this.source = null;
      this.info = null;
      this.time = 0;
      this.gap = 0;
      this.dials = {};
    }
    ready() {
      return Boolean(this.info);
    }
    /** What a link and a session keep: the name of the source, its pairs and dials. A link has a sample as its source. */
    settings() {
      const { source, pairs, dials, clip } = this;
      return source ? { source: source.body.name, pairs, dials, clip: source.body.clips.indexOf(clip) } : {};
    }
    async adopt({ sample, source = sample && `${sample}.glb`, pairs, dials = {}, clip = 0 }) {
      if (!source) return;
      const bytes = await this.app.bytesOf(source, 'transfer');
      if (!bytes) throw new Error(`${source} is not here; open it again in Transfer`);
      await this.#bring(bytes, source);
      this.clip = this.source.body.clips[clip] ?? this.clip;
      const taken = !pairs || (await this.set(pairs));
      await this.app.client.ask('transferDials', { dials });
      this.dials = dials;
      if (!taken) throw new Error('its pairs were refused; choose them again');
    }
    enter() {
      this.app.skin.wear('own');
      if (!this.source) return;
      this.source.skin.group.visible = true;
      this.#rest();
      this.look();
    }
    /** The body at rest, where the places of the pairs are: a walk begins there, whatever the pose is. */
    #rest() {
      this.app.skin.set({ positions: this.app.body.positions, normals: this.app.opened.normals });
    }
    leave() {
      this.playing = false;
      if (!this.source) return;
      this.source.skin.group.visible = false;
      this.app.skin.set(this.app.shape);
      this.app.view.frame(this.app.skin.box());
    }
    look() {
      lookAtBoth(kit, this.app, this.source);
    }
    frame() {
      if (this.source) this.look();
      else this.app.view.frame(this.app.skin.box());
    }
    /** The pose has changed: an act was taken back. What is shown here does not follow it. */
    shaped() {
      if (!this.source || this.playing) return;
      if (this.time) this.seek(this.time);
      else this.#rest();
    }
    refresh() {
      this.app.panel();
    }
    colour(i) {
      return `hsl(${Math.round(360 * ((i * HUE_STEP) % 1))} 65% 45%)`;
    }
    marks() {
      if (!this.source || this.playing || this.time) return [];
      return this.pairs.flatMap((pair, i) => {
        const shown = { offer: pair.off, colour: this.colour(i), chosen: this.chosenPair === i };
        const at = this.source.shown(pair.source.position);
        const name = `pair ${i + 1}, ${pair.name ? `${pair.name}, ` : ''}${pair.kind}${pair.off ? ', left out' : ''}`;
        return [
          { id: `a${i}`, place: at, label: `${name}, source`, pair: i, ...shown },
          { id: `b${i}`, place: pair.target.position, label: `${name}, target`, pair: i, ...shown },
        ];
      });
    }
    /** A click on a mark leaves its pair out, or takes it in again. */
    async choose({ pair }) {
      this.chosenPair = pair;
      await this.set(this.pairs.map((other, i) => (i === pair ? { ...other, off: !other.off } : other)));
    }
    async dragEnd() {
      if (!this.moved) return;
      const { pair, side, place } = this.moved;
      this.moved = null;
      await this.set(
        this.pairs.map((other, i) => (i === pair ? { ...other, [side]: { ...other[side], position: place } } : other)),
      );
    }
    dragCancel() {
      this.moved = null;
      this.pairs = this.good;
      this.app.marksLayer.update();
    }
    drag({ id, pair }, [x, y]) {
      const side = id.startsWith('a') ? 'source' : 'target';
      const { pick } = side === 'source' ? this.source : { pick: (ray) => this.app.skin.pick(ray) };
      const hit = pick(this.app.view.ray(x, y));
      if (!hit) return;
      this.moved = { pair, side, place: hit.position };
      this.pairs = this.pairs.map((other, i) =>
        i === pair ? { ...other, [side]: { ...other[side], position: hit.position } } : other,
      );
      this.app.marksLayer.update();
    }
    /** Takes a list of pairs; one that the library refuses leaves the list that was there. */
    async set(pairs) {
      const { app } = this;
      try {
        this.info = await app.client.ask('transferPairs', { pairs: pairs.filter(({ off }) => !off) });
        this.pairs = pairs;
        this.good = pairs;
        this.gap = 0;
        app.matters = '';
        say('');
        return true;
      } catch (error) {
        this.pairs = this.good;
        app.warn(`pairs: ${error.message}`);
        return false;
      } finally {
        app.refresh();
      }
    }
    /** Reads a source and makes it known to the Worker; its pairs are proposed. */
    async #bring(bytes, name) {
      const { app } = this;
      const body = await readModel(bytes, name, (data) => app.client.ask('read', { bytes: data, name }));
      const clip = body.clips.find((other) => lengthOf(other) > 0);
      if (!clip)
        throw Object.assign(new Error(`${name} has no clip to play.`), { advice: 'Take a file with an animation.' });
      this.#drop();
      const { positions, triangles } = body;
      const [of, target] = [body, app.body].map(({ document }) => writeGlb(document));
      const glb = { source: await of, target: await target };
      const pairs = await app.client.ask('transferOpen', { positions, triangles, glb });
      const beside = await openBeside(kit, app, body);
      const { skin } = beside;
      this.source = {
        ...beside,
        posed: new Float32Array(positions.length),
        locals: localsOf(body, positions),
      };
      app.client.ask('sourceTree').then(
        (tree) => this.source?.skin === skin && skin.useTree(tree),
        () => {},
      );
      this.clip = clip;
      this.pairs = this.good = pairs;
      this.time = 0;
      if (app.tool === this) {
        this.#rest();
        this.look();
      } else skin.group.visible = false; // a session comes back, or another tool was opened meanwhile
      app.session?.keep('transfer', { bytes, name });
      if (pairs.length) await this.set(pairs);
    }
    /** Takes a source and plays its clip at once, unless less motion is wished. */
    async open(bytes, name) {
      const { app } = this;
      try {
        await this.#bring(bytes, name);
        if (this.info && app.tool === this && !matchMedia('(prefers-reduced-motion: reduce)').matches)
          return this.play();
      } catch (error) {
        app.failed(`${name} was not taken`, error);
      }
      return app.refresh();
    }
    /** Source at a time, and this body moved like it. */
    async seek(time) {
      const { app, source, run } = this;
      this.time = time;
      playedAt(source.body, this.clip, time, source.locals, source.posed);
      smoothNormals(source.posed, source.sums, source.normals);
      const answer = await app.client.frame('transferFrame', { positions: source.posed });
      if (!answer || this.source !== source || app.tool !== this || this.run !== run) return;
      source.skin.set({ positions: source.posed, normals: source.normals });
      app.skin.set(answer);
      this.milliseconds = answer.milliseconds;
      this.gap = Math.max(this.gap, answer.gap);
      this.sayGap($('transfer-gap'));
      const scrub = $('transfer-time');
      if (scrub) scrub.value = time;
    }
    /** The largest gap of the frames that were shown. The panel stays, so that a dragged slider does. */
    sayGap(line) {
      if (!line) return line;
      line.hidden = !(this.gap > GAP_SAID);
      line.textContent = `Linked pieces are up to ${(100 * this.gap).toFixed(1)} % of the box apart.`;
      return line;
    }
    /** Sets one dial and shows the frame again. */
    async turn(name, value) {
      const dials = { ...this.dials, [name]: value };
      try {
        await this.app.client.ask('transferDials', { dials });
        this.dials = dials;
      } catch (error) {
        this.app.warn(error.message);
      }
      if (!this.playing) await this.seek(this.time);
    }
    dialRows() {
      const parts = new Set(this.pairs.filter(({ off }) => !off).map(({ part }) => part));
      return DIALS.filter(([, , , , , part]) => !part || parts.has(part)).map(([name, text, neutral, low, high]) =>
        slider(text, { value: this.dials[name] ?? neutral, low, high, id: `dial-${name}` }, (value) =>
          this.turn(name, value),
        ),
      );
    }
    play() {
      this.playing = true;
      const run = (this.run = {}); // it ends with Stop and with the next Play: no frame that comes later is shown
      let last = performance.now();
      const step = async (now) => {
        if (!this.playing || !this.source || this.run !== run) return;
        await this.seek((this.time + Math.max(0, now - last) / 1000) % lengthOf(this.clip)).catch((error) => {
          this.playing = false;
          this.app.warn(error.message);
        });
        last = now;
        requestAnimationFrame(step);
      };
      requestAnimationFrame(step);
      this.app.refresh();
    }
    async stop() {
      this.playing = false;
      this.run = null;
      this.time = 0;
      const { source } = this;
      source.posed.set(source.body.positions);
      smoothNormals(source.posed, source.sums, source.normals);
      source.skin.set({ positions: source.posed, normals: source.normals });
      this.#rest();
      this.app.refresh();
    }
    /** This body with a skin whose joints replay the transferred clip. */
    async glb() {
      const { app, source } = this;
      const length = lengthOf(this.clip);
      const count = Math.max(2, Math.round(length * FRAME_RATE) + 1);
      const seconds = Array.from({ length: count }, (_, f) => (length * f) / (count - 1));
      const frames = [];
      let skin = null;
      for (const time of seconds) {
        const posed = playedAt(source.body, this.clip, time, source.locals, new Float32Array(source.posed.length));
        skin = await app.client.ask('transferSkin', { positions: posed });
        frames.push(skin);
      }
      return skinnedGlb(app, skin, frames, seconds, this.clip.getName() || 'clip');
    }
    sheet() {
      const { source, app } = this;
      const take = takeRow(kit, app, (bytes, name) => this.open(bytes, name), app.formats);
      if (!source) return [make('p', {}, 'Take another body with a clip: its motion plays on this one.'), take];
      const active = this.pairs.filter(({ off }) => !off).length;
      return [
        make(
          'p',
          {},
          this.pairs.length
            ? this.playing || this.time
              ? 'Left the source, right your body. Stop shows the pairs: a click on a dot leaves its pair out.'
              : 'Left the source, right your body. A click on a dot leaves its pair out; a drag moves it.'
            : 'No places of the two bodies are alike; take another source.',
        ),
        this.info &&
          make(
            'div',
            { class: 'row' },
            button(
              this.playing ? 'Pause' : 'Play',
              () => (this.playing ? ((this.playing = false), app.refresh()) : this.play()),
              { class: 'main', id: 'transfer-play' },
            ),
            button('Stop', () => this.stop(), { id: 'transfer-stop' }),
            choice(
              'Clip of the source',
              source.body.clips.map((clip, i) => [i, clip.getName() || `clip ${i + 1}`]),
              source.body.clips.indexOf(this.clip),
              (i) => ((this.clip = source.body.clips[Number(i)]), (this.gap = 0)),
              { id: 'transfer-clip' },
            ),
          ),
        this.info &&
          make(
            'label',
            { class: 'slide' },
            make('span', {}, 'Time'),
            make('span'),
            (() => {
              const input = make('input', {
                type: 'range',
                min: 0,
                max: lengthOf(this.clip),
                step: 0.01,
                value: this.time,
                id: 'transfer-time',
              });
              input.oninput = () => {
                this.playing = false;
                this.seek(Number(input.value));
                app.marksLayer.update();
              };
              return input;
            })(),
          ),
        this.info &&
          make(
            'details',
            { open: this.dialsOpen, ontoggle: (event) => (this.dialsOpen = event.target.open), id: 'dials' },
            make('summary', {}, 'Dials'),
            ...this.dialRows(),
          ),
        this.info && this.sayGap(make('p', { class: 'warn', id: 'transfer-gap' })),
        take,
        facts([['pairs', `${active} of ${this.pairs.length}`], this.milliseconds && ['frame', ms(this.milliseconds)]]),
      ];
    }
  };
};
