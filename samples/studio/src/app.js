// What all tools share: the body, its state with history, the Worker, the panels.
import { Client } from './client.js';
import { History } from './history.js';
import { ModelError } from './model_error.js';
import { formats, readModel, skeletonOf } from './model.js';
import { Marks } from './marks.js';
import { Timeline } from './timeline.js';
import { drawLegend } from './legend.js';
import { show } from './show.js';
import { adoptSettings, settingsOf } from './settings.js';
import { View } from './view.js';
import { listen } from './input.js';
import { $, button, card, make, ms, say, whole } from './ui.js';

/** Larger bodies get their tree of boxes from a Worker of its own: it takes longer to make than a Worker to start. */
const TREE_APART = 30000;
/** A drag that pauses for so long comes to rest. Shorter asks between two moves of a hand, longer is seen. */
const PAUSE_MS = 80;

const empty = { handles: [], lengths: false, sites: [], detail: null, keys: [], pins: [], stiffness: null };

export class App {
  constructor(toolClasses, samples) {
    this.samples = samples;
    this.formats = formats;
    this.ui = { $, button, card, make, say }; // for modules that are loaded later
    this.matters = ''; // a sentence that stays in the sheet until something else is done
    this.client = new Client();
    this.view = new View($('canvas'));
    this.history = new History(empty);
    this.timeline = new Timeline(this);
    this.marksLayer = new Marks(this, $('marks'));
    this.centres = new Map();
    this.turns = new Map(); // rotations of the handles in the picture
    this.ids = 0;
    this.tools = {};
    this.later = {};
    for (const Tool of toolClasses) {
      if (Tool.load) this.later[Tool.key] = Tool.load;
      else this.tools[Tool.key] = new Tool(this);
    }
    this.figures = { open: 0, shape: 0, field: 0, frames: 0 };
    listen(this, $('canvas'));
    this.#rail(toolClasses);
  }
  get state() {
    return this.live ?? this.history.state;
  }
  /** A handle with the rotation that it has in the picture: where it is free, the pose has found it. */
  standing(handle) {
    return handle.free ? { ...handle, rotation: this.turns.get(handle.id) ?? handle.rotation } : handle;
  }
  /** All that is set, for a link or a session, and a body brought to it. */
  settings() {
    return settingsOf(this);
  }
  adopt(settings) {
    return adoptSettings(this, settings);
  }
  nextId() {
    return ++this.ids;
  }
  /** A vertex as a place in a triangle. */
  cornerOf(vertex) {
    const { triangles } = this.body;
    const at = triangles.indexOf(vertex);
    const first = at - (at % 3);
    const corners = Array.from(triangles.subarray(first, first + 3));
    return { corners, barycentrics: corners.map((v) => Number(v === vertex)) };
  }

  // ---- the body
  /** Opens a model; what was there stays when it cannot be opened, and a card says why. */
  async open(bytes, name) {
    try {
      await this.bring(bytes, name);
    } catch (error) {
      this.failed(`${name} was not opened`, error);
    }
  }
  /** The same for who says by himself what went wrong. */
  async bring(bytes, name) {
    say(`opening ${name}`, { stays: true });
    document.body.setAttribute('aria-busy', 'true');
    const begin = performance.now();
    let showing = null;
    try {
      const body = await readModel(bytes, name, (data) => this.client.ask('read', { bytes: data, name }));
      const { positions, triangles, fileNormals } = body;
      const skeleton = (body.skeleton = skeletonOf(body));
      // the tree for picking is made beside the factorisation, or after the first picture: the first pull needs none
      const apart = body.vertexCount > TREE_APART;
      this.treeJob?.cancel();
      this.treeJob = apart ? this.client.job('tree', { positions, triangles }) : null;
      this.treeJob?.answer.catch(() => {});
      showing = this.view.ready(body);
      showing.catch(() => {});
      const opened = await this.client.ask('open', { positions, triangles, fileNormals, skeleton });
      const skin = await showing;
      showing = null;
      skin.group.visible = true;
      this.skin?.dispose();
      Object.assign(this, { body, opened, skin, told: null, fieldTold: null, shownState: null });
      this.centres.clear();
      this.turns.clear();
      this.shape = { positions: body.positions.slice(), normals: opened.normals };
      skin.set(this.shape);
      this.view.stand(skin.box());
      this.matters = '';
      this.timeline.opened(body);
      for (const tool of Object.values(this.tools)) tool.opened?.();
      this.session?.opened(bytes, name);
      this.live = null;
      this.history.reset({ ...empty, handles: this.tools.pose.first() });
      const shaped = this.#apply(this.state, 'exact');
      (this.treeJob?.answer ?? this.client.ask('tree')).then(
        (tree) => this.skin === skin && (skin.useTree(tree), this.refresh(), this.client.ask('rest', { handles: this.tools.pose.offers })),
        () => {},
      );
      await shaped;
      this.figures.open = performance.now() - begin;
      await this.use(this.tool?.constructor.key ?? 'pose');
      body.notes.push(...opened.notes);
      const { componentCount } = opened.report;
      const { pieceCount } = opened.linksInfo;
      const linked = pieceCount > componentCount ? `, ${pieceCount} pieces linked to ${componentCount}` : '';
      say([`${name}: ${whole(body.vertexCount)} vertices${linked}; ready in ${ms(this.figures.open)}`, ...body.notes].join('; '));
      // a link holds settings for a body that is opened later
      if (this.pending && (await this.pending())) this.pending = null;
    } catch (error) {
      say('');
      showing?.then(
        (skin) => skin.dispose(),
        () => {},
      );
      throw error;
    } finally {
      document.body.removeAttribute('aria-busy');
    }
  }
  /** moving: it plays its clip until someone acts, unless less motion is wished. */
  async openSample(name, moving = true) {
    try {
      const answer = await fetch(`samples/${name}.glb`);
      if (!answer.ok)
        throw new ModelError(`The sample ${name} is not there (${answer.status}).`, 'Open a file of your own.');
      await this.open(new Uint8Array(await answer.arrayBuffer()), `${name}.glb`);
      if (moving && this.body?.name === `${name}.glb`) this.timeline.greet();
    } catch (error) {
      this.failed(`${name} was not opened`, error);
    }
  }
  failed(title, error) {
    const codes = {
      HF_ERROR_OUT_OF_MEMORY: 'Make the mesh coarser, or close other pages.',
      HF_ERROR_TOO_LARGE: 'Make the mesh coarser first.',
    };
    const advice =
      error.advice ?? codes[error.codeName] ?? 'Repair the mesh where it was made, or take one of the samples.';
    const ways = [['Open another file', () => $('file').click(), true]];
    if (this.samples.length) ways.push([`Take the ${this.samples[0]}`, () => this.openSample(this.samples[0])]);
    ways.push(['Close', null]);
    card(title, [make('p', {}, error.message), make('p', {}, advice)], ways);
  }

  // ---- states
  /** Shows a state that is not a step yet: a drag on its way. A drag that pauses comes to rest. */
  preview(state) {
    this.live = state;
    clearTimeout(this.pause);
    this.#apply(state, 'follow').then(
      () =>
        (this.pause = setTimeout(() => this.live === state && this.#apply(state, 'rest').catch(() => {}), PAUSE_MS)),
      (error) => {
        if (this.live === state) this.live = null;
        this.warn(error.message);
      },
    );
    this.marksLayer.update();
  }
  async commitPreview(name) {
    if (!this.live) return;
    const state = this.timeline.keyed(this.live);
    this.live = null;
    await this.commit(state, name, null, true);
  }
  /** A drag is given up: the picture is that of the state in which it began, which may be a moment between keys. */
  giveUp(before = this.history.state) {
    if (this.live && before !== this.history.state) this.preview(before);
    else this.settle();
    this.refresh();
  }
  /** Leaves what is not a step: the picture is that of the last step. */
  settle() {
    if (!this.live) return;
    this.live = null;
    this.#apply(this.state, 'rest').catch(({ message }) => this.warn(message));
  }
  /** A step. When the library refuses it, nothing has changed and its sentence is shown. */
  async commit(state, name, join = null, dragged = false) {
    if (!this.timeline.still() && this.timeline.playing) this.timeline.pause();
    state = this.timeline.keyed(state);
    this.live = null;
    this.matters = '';
    const before = this.history.state;
    const kept = { past: this.history.past.slice(), future: this.history.future };
    this.history.push(state, name, join);
    try {
      await this.#apply(state, 'rest');
      say('');
    } catch (error) {
      if (this.history.state === state) Object.assign(this.history, kept, { state: before });
      // what a drag has shown on its way goes; else the picture has not changed
      if (dragged) await this.#apply(this.state, 'exact').catch(() => {});
      this.warn(`${name}: ${error.message}`);
    }
    this.refresh();
  }
  async step(way) {
    const name = this.history[way]();
    if (!name) return;
    this.live = null;
    this.matters = '';
    this.timeline.arrive(this.state);
    await this.#apply(this.state, 'exact');
    say(`${way === 'undo' ? 'taken back' : 'done again'}: ${name}`);
    this.refresh();
  }
  /** A state from outside: of a session that was kept, or a link. The history begins anew. Throws, and changes nothing, when it is refused. */
  async take(state) {
    document.body.setAttribute('aria-busy', 'true');
    try {
      await this.#take(state);
    } finally {
      document.body.removeAttribute('aria-busy');
    }
  }
  async #take(state) {
    const [before, ids] = [this.history.state, this.ids];
    const from = state.detail?.carry?.from;
    if (from) await this.#source(from).catch(() => {}); // the tool says that it is missing
    try {
      this.history.reset({ ...empty, ...state });
      this.timeline.arrive(this.state);
      // numbers of new marks go on after those that are there
      const { handles, sites, pins } = this.state;
      this.ids = Math.max(0, ...[...handles, ...sites, ...pins].map(({ id }) => Number(id.slice(1)) || 0));
      await this.#apply(this.state, 'exact');
    } catch (error) {
      this.history.reset(before);
      this.timeline.arrive(before);
      this.ids = ids;
      await this.#apply(before, 'exact');
      this.refresh();
      throw error;
    }
    this.tools.pose.pulled = state.handles.some(({ pinned }) => !pinned);
    this.refresh();
  }
  /** The picture of the present state anew. */
  again() {
    return this.#apply(this.state, 'exact').catch(({ message }) => this.warn(message));
  }
  /** The bytes of a second body: those that the session keeps under a key, or of a sample; or null. */
  async bytesOf(name, key) {
    const kept = await this.session?.kept(key);
    if (kept?.name === name) return kept.bytes;
    if (!this.samples.includes(name.replace(/\.glb$/, ''))) return null;
    const answer = await fetch(`samples/${name}`);
    return answer.ok ? new Uint8Array(await answer.arrayBuffer()) : null;
  }
  /** The body whose detail a state takes. */
  async #source(name) {
    const bytes = await this.bytesOf(name, 'source');
    if (bytes) await (await this.need('detail')).bring(bytes, name);
  }
  #apply(state, way) {
    return show(this, state, way);
  }

  // ---- tools and panels
  #rail(toolClasses) {
    for (const Tool of toolClasses) {
      if (!Tool.icon) continue; // a part of other tools
      const tab = make('button', {
        type: 'button',
        role: 'tab',
        id: `tool-${Tool.key}`,
        'aria-selected': 'false',
        'aria-controls': 'sheet',
        onclick: () => this.use(Tool.key),
      });
      tab.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true"><path d="${Tool.icon}"/></svg><span>${Tool.title}</span>`;
      $('rail').append(tab);
    }
  }
  /** A tool that is loaded when it is wanted. */
  async need(key) {
    if (!this.tools[key]) {
      const Tool = await this.later[key]();
      if (!this.tools[key]) {
        this.tools[key] = new Tool(this);
        if (this.skin) this.tools[key].opened?.();
      }
    }
    return this.tools[key];
  }
  async use(key) {
    this.wanted = key;
    if (!this.tools[key]) {
      try {
        await this.need(key);
      } catch {
        return this.warn('This tool could not be loaded. Load the page again when the network is there.');
      }
      if (this.wanted !== key) return;
    }
    if (this.tool !== this.tools[key]) {
      if (this.tool) {
        this.matters = '';
        say('');
      }
      if (this.skin) this.timeline.stop();
      this.tool?.leave?.();
      $('sheet').parentElement.scrollTop = 0;
    }
    this.tool = this.tools[key];
    const shown = this.tool.home ?? key;
    for (const tab of $('rail').children) tab.setAttribute('aria-selected', String(tab.id === `tool-${shown}`));
    if (!this.skin) return;
    this.legend(null);
    this.timeline.draw();
    this.refresh();
    try {
      await this.tool.enter?.();
    } catch (error) {
      this.warn(error.message);
    }
    this.refresh();
  }
  /** A message that matters: it is said, and stays in the sheet until something else is done. */
  warn(text) {
    this.matters = text;
    say(text);
    if (this.tool && this.skin) this.panel();
  }
  /** Fills the picture: with the body, or with both where there are two. */
  frame() {
    if (!this.skin) return;
    if (this.tool?.frame) this.tool.frame();
    else this.view.frame(this.skin.box());
  }
  refresh() {
    $('undo').disabled = !this.history.past.length;
    $('redo').disabled = !this.history.future.length;
    if (!this.skin || !this.tool) return;
    this.tool.refresh?.();
    this.session?.changed();
    if (!this.timeline.element.hidden) this.timeline.label();
    this.marksLayer.update();
    this.view.draw();
  }
  /** Draws the sheet of the tool; what has the focus keeps it. */
  panel() {
    const focused = document.activeElement?.id;
    const held = document.activeElement?.closest?.('#sheet') && document.activeElement.type === 'range' && this.live;
    if (held) return;
    const title = this.tool.constructor.title;
    $('sheet').replaceChildren(
      make('h2', { id: 'sheet-name' }, title),
      ...(this.matters ? [make('p', { class: 'warn', id: 'matters' }, this.matters)] : []),
      ...this.tool.sheet().filter((child) => child !== null && child !== undefined && child !== false),
    );
    if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
  }
  legend(content) {
    drawLegend(content);
  }
  hover(at) {
    const tip = $('tip');
    const text = at && this.skin && !this.live ? this.tool?.hover?.(at) : null;
    tip.hidden = !text;
    if (!text) return;
    tip.textContent = text;
    tip.style.left = `${Math.min(at[0] + 14, this.view.width - 120)}px`;
    tip.style.top = `${at[1] + 14}px`;
  }
}
