// The classes, over a backend. Every object owns one handle: close() it, or leave it to the garbage collector.
import { callClass } from './call.js';
import { makeClasses } from './classes.js';
import { extend } from './extras.js';
import { HfError, Struct, checkNumbers, fail, written } from './marshal.js';
import { constants, headerVersion } from './raw.js';

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
    /** Makes the object: the last argument of the function receives its handle. */
    _own(name, callOf, ...args) {
      const handle = backend.newHandle();
      call(name, ...args, written(handle));
      this._handle = handle[0];
      const { destroy, counts } = this.constructor;
      this._n = Object.fromEntries(Object.entries(callOf.n).filter(([key]) => counts.includes(key.split('.').pop())));
      this.#open = true;
      registry.register(this, { destroy, handle: this._handle }, this);
    }
    _swap(other) {
      [this._handle, other._handle] = [other._handle, this._handle];
      for (const one of [this, other]) {
        registry.unregister(one);
        registry.register(one, { destroy: one.constructor.destroy, handle: one._handle }, one);
      }
    }
    get closed() {
      return !this.#open;
    }
    close() {
      if (!this.#open) return;
      this.#open = false;
      registry.unregister(this);
      backend.call(this.constructor.destroy, [this._handle]);
    }
  }
  if (Symbol.dispose) Handle.prototype[Symbol.dispose] = Handle.prototype.close;

  /** An object with undo. A record is a clone, so it shares memory with the object. */
  class Recorded extends Handle {
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
  /** Options that nothing takes are refused by name. */
  const none = (options) => {
    for (const key of Object.keys(options)) fail(`no option '${key}'; index.d.ts lists them`);
  };
  const direct = (name, ...args) => backend.call(name, args);
  const number = direct('hf_version_get');
  const [major, minor] = headerVersion.split('.').map(Number);
  if (Math.floor(number / 1000000) !== major || number < major * 1000000 + minor * 1000) {
    throw new Error(`the hf library is of version ${number}, this package of ${headerVersion}; use matching ones`);
  }
  const classes = makeClasses({ Handle, Recorded, Call: callClass(backend), bare, call, direct, handleOf, none, written });
  return Object.freeze({
    ...extend(classes, bare),
    HfError,
    constants,
    backend: backend.name,
    version: [Math.floor(number / 1000000), Math.floor(number / 1000) % 1000, number % 1000],
  });
}
