// Between JavaScript and the C ABI: arrays, structs in the memory layout of the backend, errors. A backend is
// { width: 0 | 1 (pointers of 4 or 8 bytes), call(name, args), newHandle() }; arguments are numbers, handles, null,
// structs, and arrays marked as read or written.
import { constants, layouts } from './raw.js';

/** A failed call: code, codeName (HF_ERROR_*), index (or null), functionName. */
export class HfError extends Error {
  constructor(message, code, index = null, functionName = '') {
    const codeName = Object.keys(constants).find((name) => constants[name] === code);
    super(`${functionName ? functionName + ': ' : ''}${message} (${codeName ?? code})`);
    Object.assign(this, { name: 'HfError', code, codeName: codeName ?? 'unknown', index, functionName });
  }
}

export function fail(message, code = 'HF_ERROR_INVALID_ARGUMENT', index = null, functionName = '') {
  throw new HfError(message, constants[code], index, functionName);
}

export const missing = (value) => value === null || value === undefined;
export const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const snake = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);

const ranges = { i32: [-0x80000000, 0x7fffffff], u32: [0, 0xffffffff], size: [0, Number.MAX_SAFE_INTEGER] };

/** A number; what a DataView, an array or the call would wrap is refused by name. range: of whole numbers. */
function check(value, range, name, index = null) {
  if (range ? !Number.isInteger(value) : typeof value !== 'number')
    fail(`${name} must be a ${range ? 'whole ' : ''}number, not ${String(value)}`);
  if (value < range?.[0] || value > range?.[1])
    fail(`${name} is ${value}; it must lie in ${range.join(' to ')}`, 'HF_ERROR_OUT_OF_RANGE', index);
  return value;
}

/** A number as a field or parameter of that kind takes it. Flags (int32) take booleans. */
export function scalar(kind, value, name) {
  if (kind === 'i32' && typeof value === 'boolean') return Number(value);
  return check(value, ranges[kind], name);
}

/** An array the library reads, or writes (copied back from WebAssembly's memory). */
export const read = (array) => (array?.length ? { array, written: false } : null);
export const written = (array) => (array?.length ? { array, written: true } : null);

const wholes = { u4: Uint32Array, u2: Uint16Array, u1: Uint8Array, i4: Int32Array };
export const types = { f4: Float32Array, f8: Float64Array, ...wholes };
export const isArray = (list) => Array.isArray(list) || (ArrayBuffer.isView(list) && !(list instanceof DataView));

/** An array of a type that the library takes ('f4 f8'), as given when it is one; others are checked and converted. */
export function numbers(values, name, kinds) {
  const allowed = kinds.split(' ').map((kind) => types[kind]);
  if (allowed.some((Type) => values instanceof Type)) return values;
  if (!isArray(values)) fail(`${name} must be an array of numbers`);
  const flat = Array.isArray(values) && isArray(values[0]) ? values.flatMap((row) => Array.from(row)) : values;
  const Type = kinds[0] === 'f' ? allowed.at(-1) : allowed[0];
  const range = kinds[0] === 'f' ? null : [0, 2 ** (8 * Type.BYTES_PER_ELEMENT) - 1];
  const right = range ? (v) => Number.isInteger(v) && v >= 0 && v <= range[1] : (v) => typeof v === 'number';
  for (let i = 0; i < flat.length; ++i) if (!right(flat[i])) check(flat[i], range, `${name}[${i}]`, i);
  return Type.from(flat);
}

const accessors = { i32: 'Int32', u32: 'Uint32', f64: 'Float64' };

/** A struct in the layout of a backend. Pointers are kept beside it and filled in for the call. */
export class Struct {
  constructor(width, type, fields = {}, bytes = new Uint8Array(layouts[type].size[width])) {
    const pointers = new Map(); // offset -> array | Struct | handle
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    Object.assign(this, { width, layout: layouts[type], bytes, pointers, view });
    if (this.layout.fields.struct_size) this.set('struct_size', bytes.length);
    for (const [name, value] of Object.entries(fields)) this.set(name, value);
  }

  set(name, value, shown = name) {
    const { fields } = this.layout;
    const [kind, offsets, count] = fields[name] ?? fields[snake(name)] ?? fail(`no option '${name}'`);
    const at = offsets[this.width];
    if (missing(value)) return this;
    if (kind === 'ptr') this.pointers.set(at, value);
    else if (kind in layouts) {
      this.bytes.set(value.bytes, at); // a struct inside this one
      for (const [inside, target] of value.pointers) this.pointers.set(at + inside, target);
    } else if (kind === 'size' && this.width) this.view.setBigUint64(at, BigInt(scalar(kind, value, shown)), true);
    else
      for (let i = 0; i < (count || 1); ++i) {
        const number = scalar(kind, count ? value[i] : value, count ? `${shown}[${i}]` : shown);
        this.view[`set${accessors[kind] ?? 'Uint32'}`](at + i * (kind === 'f64' ? 8 : 4), number, true);
      }
    return this;
  }

  get(name) {
    const [kind, offsets, count] = this.layout.fields[name];
    const at = offsets[this.width];
    if (kind === 'char') return new TextDecoder().decode(this.bytes.slice(at, at + count)).split('\0')[0];
    if (kind in layouts) return new Struct(this.width, kind, {}, this.bytes.subarray(at)).toObject();
    const number = (i) => this.view[`get${accessors[kind]}`](at + i * (kind === 'f64' ? 8 : 4), true);
    return count ? Array.from({ length: count }, (_, i) => number(i)) : number(0);
  }

  /** The fields that are no pointers as a plain object with camelCase names. */
  toObject() {
    const { struct_size, reserved, ...fields } = this.layout.fields;
    this.layout.shown ??= Object.keys(fields).filter((n) => fields[n][0] !== 'ptr').map((n) => [camel(n), n]);
    return Object.fromEntries(this.layout.shown.map(([key, name]) => [key, this.get(name)]));
  }
}

/** The first rows of an array; of a packed array of structs as plain objects. */
export function rows(width, type, bytes, count) {
  if (types[type]) return bytes.subarray(0, count);
  const row = (i) => new Struct(width, type, {}, bytes.subarray(i * layouts[type].size[width]));
  return Array.from({ length: count }, (_, i) => row(i).toObject());
}
