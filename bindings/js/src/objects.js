// The classes, over a backend. Every object owns one handle: close() it, or leave it to the garbage collector.
import { constants, headerVersion } from './raw.js';
import { HfError, Struct, checkNumbers, doubles, fail, integers, output, points, read, regions, rows, written } from './marshal.js';
import { solverClasses } from './solver.js';
import { surfaceClasses } from './surface.js';
import { detailClasses } from './detail.js';
import { fieldClasses } from './fields.js';
import { poseClasses } from './pose.js';
import { quadClasses } from './quads.js';
import { weightClasses } from './weights.js';

export function makeApi(backend) {
  const make = (type, fields) => new Struct(backend.width, type, fields);
  const call = (name, ...args) => {
    checkNumbers(name, args);
    const code = backend.call(name, args);
    if (code === 0) return;
    const detail = make('hf_error_detail');
    backend.call('hf_error_get_detail', [detail]);
    const index = detail.get('index');
    throw new HfError(
      detail.get('message'),
      code,
      index === constants.HF_NO_INDEX ? null : index,
      detail.get('function'),
    );
  };

  const bare = Symbol('an object whose handle is made elsewhere');
  const classes = {}; // all of them, for those that name each other
  const registry = new FinalizationRegistry(({ destroy, handle }) => backend.call(destroy, [handle]));

  /** Owns one handle. Objects may be closed in any order and more than once; a call on a closed one throws. */
  class Handle {
    #open = false;
    constructor() {
      // structuredClone, postMessage, spread and Object.assign read every property: a copy of the handle would be a
      // second owner, or a number without meaning in another thread's module
      Object.defineProperty(this, '_owned', {
        enumerable: true,
        get: () => fail(`a ${this.constructor.name} cannot be copied or sent${this.clone ? '; clone() it' : ''}`),
      });
    }
    toJSON() {
      fail(`a ${this.constructor.name} cannot be written as JSON`);
    }
    /** Takes the handle that PREFIX_verb(...args, out) makes (or the function the class names); PREFIX_destroy ends it. */
    _make(verb, ...args) {
      const { prefix, [verb]: name = `${prefix}_${verb}` } = this.constructor;
      const handle = backend.newHandle();
      call(name, ...args, written(handle));
      this._handle = handle[0];
      this.#open = true;
      registry.register(this, { destroy: `${prefix}_destroy`, handle: this._handle }, this);
    }
    /** A copy by PREFIX_clone, for classes whose constructor passes over `bare`. */
    _copy() {
      const copy = new this.constructor(bare);
      copy._make('clone', this._handle);
      for (const name of Object.keys(this)) if (!['_owned', '_handle'].includes(name)) copy[name] = this[name];
      return copy;
    }
    _swap(other) {
      [this._handle, other._handle] = [other._handle, this._handle];
      for (const one of [this, other]) {
        registry.unregister(one);
        registry.register(one, { destroy: `${one.constructor.prefix}_destroy`, handle: one._handle }, one);
      }
    }
    get closed() {
      return !this.#open;
    }
    close() {
      if (!this.#open) return;
      this.#open = false;
      registry.unregister(this);
      backend.call(`${this.constructor.prefix}_destroy`, [this._handle]);
    }
  }
  if (Symbol.dispose) Handle.prototype[Symbol.dispose] = Handle.prototype.close;

  /** An object made on one surface by PREFIX_create(surface, describe(), out), or without a desc. */
  class OnSurface extends Handle {
    constructor(surface, describe = null) {
      super();
      if (surface === bare) return;
      const parent = handleOf(surface, classes.Surface, 'surface');
      this._make('create', parent, ...(describe ? [describe()] : []));
      this.vertexCount = surface.vertexCount;
    }
  }

  /** An object on a surface with undo. A record is a clone, so it shares memory with the object. */
  class Recorded extends OnSurface {
    #past = [];
    #undone = [];
    record() {
      this.#past.push(this.clone());
      this.#undone = [];
    }
    undo() {
      this.#exchange(this.#past, this.#undone, 'nothing is recorded; call record() before the edits');
    }
    redo() {
      this.#exchange(this.#undone, this.#past, 'nothing was undone since the last record()');
    }
    #exchange(from, to, nothing) {
      if (this.closed) this.clone(); // throws what every call on a closed object throws
      if (!from.length) fail(nothing, 'HF_ERROR_EMPTY');
      const state = from.pop();
      this._swap(state);
      to.push(state);
    }
  }

  const handleOf = (thing, kind, name) => {
    if (thing === null || thing === undefined) return 0;
    if (!(thing instanceof kind)) fail(`${name} must be a ${kind.name}`);
    return thing._handle;
  };
  /** A struct the library fills, as a plain object. */
  const query = (type, name, ...args) => {
    const info = make(type);
    call(name, ...args, info);
    return info.toObject();
  };
  const watched = (desc, progress) =>
    progress ? desc.set('progress', handleOf(progress, classes.Progress, 'progress')) : desc;
  const table = (type, bytes, count) => rows(backend.width, type, bytes, count);
  const rowSize = (type) => make(type).bytes.length;
  const direct = (name, ...args) => backend.call(name, args);

  /** Elements of a list; a missing list counts one, so that the library says what is missing. */
  const counted = (array) => (array === null ? 1 : array.length);
  const solveName = (base, out) => (out instanceof Float32Array ? base : base + '_f64');
  const pairOf = (sites, vertices) => {
    const [numbers, at] = [integers(sites, 'sites') ?? [], integers(vertices, 'vertices') ?? []];
    if (numbers.length !== at.length) fail('sites and vertices must be of one length');
    return [numbers, at];
  };
  /** A field as hf_scalars, or null. */
  const scalarsOf = (field, vertexCount) => {
    if (field === null || field === undefined) return null;
    const array = field instanceof Float32Array ? field : doubles(field, 'field');
    if (array.length !== vertexCount) fail(`field must hold ${vertexCount} numbers, not ${array.length}`);
    return make('hf_scalars').set(array instanceof Float32Array ? 'values' : 'values_f64', read(array));
  };

  const tools = {
    backend,
    make,
    call,
    direct,
    handleOf,
    query,
    watched,
    table,
    rowSize,
    Handle,
    OnSurface,
    Recorded,
    doubles,
    fail,
    integers,
    output,
    points,
    read,
    regions,
    written,
    bare,
    classes,
    counted,
    pairOf,
    scalarsOf,
    solveName,
  };
  const number = direct('hf_version_get');
  const [major, minor] = headerVersion.split('.').map(Number);
  if (Math.floor(number / 1000000) !== major || number < major * 1000000 + minor * 1000) {
    throw new Error(`the hf library is of version ${number}, this package of ${headerVersion}; use matching ones`);
  }
  for (const more of [surfaceClasses, solverClasses, fieldClasses, quadClasses, detailClasses, poseClasses, weightClasses])
    Object.assign(classes, more(tools));
  return Object.freeze({
    ...classes,
    HfError,
    constants,
    backend: backend.name,
    version: [Math.floor(number / 1000000), Math.floor(number / 1000) % 1000, number % 1000],
  });
}
