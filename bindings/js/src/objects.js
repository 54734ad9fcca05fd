// The classes, over a backend. Every object owns one handle: close() it, or leave it to the garbage collector.
import { callClass } from './call.js';
import { makeClasses } from './classes.js';
import { extend } from './extras.js';
import { HfError, Struct, fail, missing, read, scalar, written } from './marshal.js';
import { constants, functions, headerVersion } from './raw.js';

export function makeApi(backend) {
  const direct = (name, ...args) => backend.call(name, args);
  const call = (name, ...args) => {
    functions[name][1].forEach((kind, i) => {
      if (kind !== 'handle' && kind !== 'ptr') scalar(kind, args[i], `number ${i + 1} of ${name}`);
    });
    const code = backend.call(name, args);
    if (code === 0) return;
    const detail = new Struct(backend.width, 'hf_error_detail');
    direct('hf_error_get_detail', detail);
    const { message, index, function: of } = detail.toObject();
    throw new HfError(message, code, index === constants.HF_NO_INDEX ? null : index, of);
  };

  const bare = Symbol('an object whose handle is made elsewhere');
  const registry = new FinalizationRegistry(({ destroy, handle }) => direct(destroy, handle));

  /** Owns one handle. Objects may be closed in any order and more than once; a call on a closed one throws. */
  class Handle {
    constructor() {
      this.closed = true;
      // structuredClone, postMessage, JSON, spread and Object.assign read every property: a copy of the handle would be
      // a second owner, or a number without meaning in another thread's module
      const get = () => fail(`a ${this.constructor.name} cannot be copied or sent${this.clone ? '; clone() it' : ''}`);
      Object.defineProperty(this, '_owned', { enumerable: true, get });
    }
    /** Makes the object: the last argument of the function receives its handle. */
    _own(name, callOf, ...args) {
      const handle = backend.newHandle();
      call(name, ...args, written(handle));
      const { counts } = this.constructor;
      this._n = Object.fromEntries(Object.entries(callOf.n).filter(([key]) => counts.includes(key.split('.').pop())));
      this.closed = false;
      this._hold(handle[0]);
    }
    _hold(handle) {
      this._handle = handle;
      registry.unregister(this);
      registry.register(this, { destroy: this.constructor.destroy, handle }, this);
    }
    close() {
      if (this.closed) return;
      this.closed = true;
      registry.unregister(this);
      direct(this.constructor.destroy, this._handle);
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
      const before = state._handle;
      state._hold(this._handle);
      this._hold(before);
      to.push(state);
    }
  }

  const handleOf = (thing, kind, name) => {
    if (!missing(thing) && !(thing instanceof kind)) fail(`${name} must be a ${kind.name}`);
    return thing?._handle ?? 0;
  };
  /** Options that nothing takes are refused by name. */
  const none = (options) => Object.keys(options).forEach((key) => fail(`no option '${key}'; index.d.ts lists them`));
  const version = [1e6, 1e3, 1].map((unit) => Math.floor(direct('hf_version_get') / unit) % 1000);
  const [major, minor] = headerVersion.split('.').map(Number);
  if (version[0] !== major || version[1] < minor)
    throw new Error(`the hf library is of version ${version.join('.')}, this package of ${headerVersion}`);
  const own = { Handle, Recorded, Call: callClass(backend), bare, call, direct, handleOf, none, read, scalar, written };
  const classes = makeClasses({ ...own, newHandle: backend.newHandle });
  return Object.freeze({ ...extend(classes, bare), HfError, constants, backend: backend.name, version });
}
