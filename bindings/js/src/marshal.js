// Between JavaScript and the C ABI: arrays, structs in the memory layout of the backend, errors. A backend is
// { width: 0 | 1 (pointers of 4 or 8 bytes), call(name, args), newHandle() }; arguments are numbers, handles, null,
// structs, and arrays marked as read or written.
import { constants, functions, layouts } from './raw.js';

const names = new Map(
  Object.entries(constants)
    .filter(([name]) => name === 'HF_OK' || name.startsWith('HF_ERROR_'))
    .map(([name, code]) => [code, name]),
);

/** A failed call: code, codeName (HF_ERROR_*), index (or null), functionName. */
export class HfError extends Error {
  constructor(message, code, index = null, functionName = '') {
    super(`${functionName ? functionName + ': ' : ''}${message} (${names.get(code) ?? code})`);
    this.name = 'HfError';
    this.code = code;
    this.codeName = names.get(code) ?? 'unknown';
    this.index = index;
    this.functionName = functionName;
  }
}

export function fail(message, code = 'HF_ERROR_INVALID_ARGUMENT', index = null) {
  throw new HfError(message, constants[code], index);
}

const wholeRanges = {
  i32: [-0x80000000, 0x7fffffff],
  u32: [0, 0xffffffff],
  size: [0, Number.MAX_SAFE_INTEGER],
};
const largestFloat = 3.4028234663852886e38;

/** A number as a field or parameter of that kind takes it; what a DataView or the call would wrap is refused by name.
 * Flags (int32) take booleans. */
export function scalar(kind, value, name) {
  if (kind === 'i32' && typeof value === 'boolean') return Number(value);
  const range = wholeRanges[kind];
  if (range ? !Number.isInteger(value) : typeof value !== 'number')
    fail(`${name} must be a ${range ? 'whole ' : ''}number, not ${String(value)}`);
  if (range && (value < range[0] || value > range[1]))
    fail(`${name} is ${value}; it must lie in ${range[0]} to ${range[1]}`, 'HF_ERROR_OUT_OF_RANGE');
  if (kind === 'f32' && Number.isFinite(value) && Math.abs(value) > largestFloat)
    fail(`${name} is ${value}; it must lie within ${largestFloat}`, 'HF_ERROR_OUT_OF_RANGE');
  return value;
}

/** Checks the numbers among the arguments of a function of the C ABI. */
export function checkNumbers(name, args) {
  functions[name][1].forEach((kind, i) => {
    if (kind in wholeRanges || kind === 'f64') scalar(kind, args[i], `number ${i + 1} of ${name}`);
  });
}

/** An array the library reads, or writes (copied back from WebAssembly's memory). */
export class Memory {
  constructor(array, written) {
    this.array = array;
    this.written = written;
  }
}
export const read = (array) => (array === null || array.length === 0 ? null : new Memory(array, false));
export const written = (array) => (array === null || array.length === 0 ? null : new Memory(array, true));

const isArray = (values) => Array.isArray(values) || (ArrayBuffer.isView(values) && !(values instanceof DataView));

/** uint32 numbers: a Uint32Array is used as it is, others are checked and converted; null stays null. */
export function integers(values, name) {
  if (values === null || values === undefined) return null;
  if (values instanceof Uint32Array) return values;
  if (!isArray(values)) fail(`${name} must be an array of whole numbers`);
  const flat = Array.isArray(values) && Array.isArray(values[0]) ? values.flat() : values;
  for (let i = 0; i < flat.length; ++i) {
    if (!Number.isInteger(flat[i])) fail(`${name}[${i}] must be a whole number, not ${String(flat[i])}`);
    if (flat[i] < 0 || flat[i] > 0xffffffff) fail(`${name}[${i}] is ${flat[i]}`, 'HF_ERROR_OUT_OF_RANGE', i);
  }
  return Uint32Array.from(flat);
}

/** float64 numbers, count of them when given; a Float64Array is used as it is. */
export function doubles(values, name, count) {
  if (values === null || values === undefined) return null;
  if (!isArray(values)) fail(`${name} must be an array of numbers`);
  let array = values;
  if (!(values instanceof Float64Array)) {
    const flat = Array.isArray(values) && isArray(values[0]) ? values.map((row) => Array.from(row)).flat() : values;
    for (let i = 0; i < flat.length; ++i)
      if (typeof flat[i] !== 'number') fail(`${name}[${i}] must be a number, not ${String(flat[i])}`);
    array = Float64Array.from(flat);
  }
  if (count !== undefined && array.length !== count) fail(`${name} must hold ${count} numbers, not ${array.length}`);
  return array;
}

const camel = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
const fieldNames = new Map(); // struct -> camelCase -> C name
function fieldsOf(struct) {
  let map = fieldNames.get(struct);
  if (!map)
    fieldNames.set(struct, (map = new Map(Object.keys(layouts[struct].fields).map((name) => [camel(name), name]))));
  return map;
}

const setters = {
  i32: (view, at, value) => view.setInt32(at, value, true),
  u32: (view, at, value) => view.setUint32(at, value, true),
  f32: (view, at, value) => view.setFloat32(at, value, true),
  f64: (view, at, value) => view.setFloat64(at, value, true),
};
const getters = {
  i32: (view, at) => view.getInt32(at, true),
  u32: (view, at) => view.getUint32(at, true),
  f32: (view, at) => view.getFloat32(at, true),
  f64: (view, at) => view.getFloat64(at, true),
};
const strides = { i32: 4, u32: 4, f32: 4, f64: 8 };

/** A struct in the layout of a backend. Pointers are kept beside it and filled in for the call. */
export class Struct {
  constructor(width, type, fields = {}) {
    this.width = width;
    this.layout = layouts[type];
    this.type = type;
    this.bytes = new Uint8Array(this.layout.size[width]);
    this.view = new DataView(this.bytes.buffer);
    this.pointers = []; // [offset, Memory | Struct | handle]
    if (this.layout.fields.struct_size) this.set('struct_size', this.bytes.length);
    for (const [name, value] of Object.entries(fields)) this.set(name, value);
  }

  set(name, value, shown = name) {
    const [kind, offsets, count] = this.layout.fields[name];
    const at = offsets[this.width];
    if (value === null || value === undefined) return this;
    if (kind === 'ptr') this.pointers.push([at, value]);
    else if (kind === 'size') {
      scalar('size', value, shown);
      this.width ? this.view.setBigUint64(at, BigInt(value), true) : this.view.setUint32(at, value, true);
    } else if (count)
      for (let i = 0; i < count; ++i)
        setters[kind](this.view, at + i * strides[kind], scalar(kind, value[i], `${shown}[${i}]`));
    else setters[kind](this.view, at, scalar(kind, value, shown));
    return this;
  }

  get(name) {
    const [kind, offsets, count] = this.layout.fields[name];
    const at = offsets[this.width];
    if (kind === 'char') {
      const text = this.bytes.subarray(at, at + count);
      const end = text.indexOf(0);
      return new TextDecoder().decode(text.slice(0, end < 0 ? count : end));
    }
    if (count) return Array.from({ length: count }, (_, i) => getters[kind](this.view, at + i * strides[kind]));
    if (layouts[kind]) return rows(this.width, kind, this.bytes.subarray(at), 1)[0];
    return getters[kind](this.view, at);
  }

  /** Sets scalar options by their camelCase names; an unknown one is an error that names it. Arrays are packed and
   * their lengths known, so strides and the fields of `own` are no options. */
  options(options = {}, own = []) {
    const map = fieldsOf(this.type);
    const taken = (name) => ['struct_size', 'reserved', ...own].includes(name) || name.endsWith('_stride');
    for (const [key, value] of Object.entries(options)) {
      const name = map.get(key);
      const kind = name && this.layout.fields[name][0];
      if (!setters[kind] || taken(name)) {
        const allowed = [...map].filter(([, field]) => setters[this.layout.fields[field][0]] && !taken(field));
        fail(`no option '${key}'; there are: ${allowed.map(([shown]) => shown).join(', ')}`);
      }
      const count = this.layout.fields[name][2];
      if (count && (!isArray(value) || value.length !== count)) fail(`option '${key}' must be ${count} numbers`);
      if (value === null || value === undefined) fail(`option '${key}' must be a number, not ${value}`);
      this.set(name, count ? Array.from(value) : value, `option '${key}'`);
    }
    return this;
  }

  /** The fields that are no pointers as a plain object with camelCase names. */
  toObject() {
    const result = {};
    for (const [shown, name] of fieldsOf(this.type)) {
      const kind = this.layout.fields[name][0];
      if ((getters[kind] || kind === 'char' || layouts[kind]) && name !== 'struct_size' && name !== 'reserved')
        result[shown] = this.get(name);
    }
    return result;
  }
}

/** Rows of a packed array of structs as plain objects. */
export function rows(width, type, bytes, count) {
  const row = new Struct(width, type);
  return Array.from({ length: count }, (_, i) => {
    row.bytes.set(bytes.subarray(i * row.bytes.length, (i + 1) * row.bytes.length));
    return row.toObject();
  });
}
