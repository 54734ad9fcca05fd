// One call of the library: arrays in and out, and the counts that follow from them and from the objects.
import { constants, layouts } from './raw.js';
import { Struct, camel, fail, missing, numbers, read, rows, scalar, types, written } from './marshal.js';

const snake = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
const mapped = (object, make) => Object.fromEntries(Object.entries(object).map(([key, value]) => [key, make(value, key)]));

/** Structs as one packed array. */
function packed(structs) {
  const bytes = new Uint8Array(structs.reduce((sum, struct) => sum + struct.bytes.length, 0));
  structs.forEach((struct, i) => bytes.set(struct.bytes, i * struct.bytes.length));
  return read(bytes);
}

export function callClass({ width }) {
  const make = (type, fields) => new Struct(width, type, fields);

  return class Call {
    static told(owner, type) {
      return (owner._told?.[type] ?? make(type)).toObject();
    }

    constructor(owner, named) {
      this.n = { ...owner?._n };
      for (const name in named)
        for (const [key, value] of Object.entries(named[name]?._n ?? {})) this.n[`${name}.${key}`] = this.n[key] = value;
    }

    /** A struct of figures that the object keeps. */
    told(owner, type) {
      return ((owner._told ??= {})[type] ??= make(type));
    }

    known(key, value) {
      if (scalar('u32', value, key)) this.n[key] = value;
    }

    struct(type, options) {
      const made = make(type);
      for (const [name, value] of Object.entries(options))
        if (value !== 0 && value !== false) made.set(name, value ?? String(value), `option '${camel(name)}'`);
      return made;
    }

    /** What a dimension such as 'face_count + 1' is; null: not known yet. */
    size(dim) {
      const [base, more = 0] = String(dim).split(' + ');
      return typeof dim === 'number' ? dim : base in this.n ? this.n[base] + Number(more) : null;
    }

    product(dims) {
      return dims.reduce((product, dim) => product * (this.size(dim) ?? 0), 1);
    }

    /** Checks how many numbers there are; a dimension that is not known yet becomes known. */
    fit(length, name, dims) {
      const loose = dims.filter((dim) => this.size(dim) === null);
      const known = this.product(dims.filter((dim) => this.size(dim) !== null));
      if (loose.length > 1) fail(`${name} cannot be read without what it belongs to`);
      if (!loose.length && length !== known) fail(`${name} must hold ${known} numbers, not ${length}`);
      if (known ? length % known : length) fail(`${name} must hold ${known} numbers for each, not ${length}`);
      if (!loose.length) return;
      const [base, more = 0] = loose[0].split(' + ');
      this.n[base] = known ? Math.max(length / known - more, 0) : 0;
    }

    // ---- what goes in

    numbers(name, values, kinds, dims) {
      const array = numbers(values, name, kinds);
      this.fit(array.length, name, dims);
      return array;
    }

    array(name, values, kinds, dims) {
      if (missing(values)) return null;
      const oneForAll = typeof values === 'number' && dims.every((dim) => this.size(dim) !== null);
      return read(this.numbers(name, oneForAll ? new Array(this.product(dims)).fill(values) : values, kinds, dims));
    }

    /** An hf_array of numbers, or null. */
    view(name, values, kinds, dims) {
      return missing(values) ? null : this.viewOf('hf_array', read, this.numbers(name, values, kinds, dims), dims);
    }

    viewOut(array, dims) {
      return this.viewOf('hf_array_out', written, array, dims);
    }

    viewOf(struct, mark, array, dims) {
      const type = array instanceof Float64Array ? 'HF_TYPE_DOUBLE' : array instanceof Uint16Array ? 'HF_TYPE_UINT16' : 'HF_TYPE_PLAIN';
      return make(struct, { data: mark(array), count: this.size(dims[0]) ?? 0, type: constants[type] });
    }

    /** Lists of different lengths, one after the other: their lengths, and they. */
    lists(name, lists, dims) {
      if (missing(lists)) return [null, null];
      if (!Array.isArray(lists)) fail(`${name} must be a list of lists`);
      const none = lists.findIndex(missing);
      if (none >= 0) fail(`${name}[${none}] is null`, 'HF_ERROR_NULL_POINTER');
      const arrays = lists.map((list, i) => numbers(list, `${name}[${i}]`, 'u4'));
      this.fit(arrays.length, name, dims);
      const all = arrays.flatMap((array) => Array.from(array));
      return [read(Uint32Array.from(arrays, (array) => array.length)), read(Uint32Array.from(all))];
    }

    /** Rows of a plain struct, given field by field: field -> [name, values]. */
    records(type, dims, fields) {
      const given = Object.entries(fields).filter(([, [, values]]) => !missing(values));
      const columns = given.map(([field, [name, values]]) => {
        const count = layouts[type].fields[field][2];
        return [field, this.numbers(name, values, 'f8', [...dims, count]), count];
      });
      const row = (i) => columns.map(([field, array, count]) => [field, array.subarray(i * count, (i + 1) * count)]);
      return packed(Array.from({ length: this.n[dims[0]] ?? 0 }, (_, i) => make(type, Object.fromEntries(row(i)))));
    }

    /** Rows that the library wrote, given back to it. */
    written(name, values, type, dims) {
      const row = (value) => make(type, Object.fromEntries(Object.entries(value).map(([key, field]) => [snake(key), field])));
      return this.rows(name, values, dims, row);
    }

    rows(name, values, dims, row) {
      if (missing(values)) return null;
      if (!Array.isArray(values)) fail(`${name} must be a list of objects`);
      this.fit(values.length, name, dims);
      return packed(values.map(row));
    }

    places(name, values, dims) {
      return this.rows(name, values, dims, (value, i) => this.place(value, `${name}[${i}]`));
    }

    /** One place: a vertex, a hit, or three corners of a triangle and their barycentrics. */
    place(value, name) {
      const { corners, barycentrics } = Number.isInteger(value)
        ? { corners: [value, value, value], barycentrics: [1, 0, 0] }
        : (value?.place ?? value ?? {});
      if (corners?.length !== 3 || barycentrics?.length !== 3)
        fail(`${name} must be a vertex, a hit, or an object with three corners and three barycentrics`);
      return make('hf_place', { corners, barycentrics });
    }

    /** Lines in UTF-8: a string, or a list of one for each. */
    text(values, name) {
      if (missing(values)) return null;
      if (typeof values !== 'string' && !Array.isArray(values)) fail(`${name} must be a string or a list of strings`);
      const lines = typeof values === 'string' ? values : values.map((line) => `${String(line).replace(/[\0\n]/g, ' ')}\n`).join('');
      return read(new TextEncoder().encode(`${lines}\0`));
    }

    /** A desc inside a desc: an object of its options, or its first array alone. */
    inner(given, first, fill, prefix) {
      return missing(given) ? null : fill(this, prefix, Array.isArray(given) || ArrayBuffer.isView(given) ? { [first]: given } : given);
    }

    // ---- what comes out

    /** The caller's array, or a new one. */
    out(given, kinds, dims, Type, name = 'out') {
      const count = this.product(dims);
      const allowed = kinds.split(' ').map((kind) => types[kind]);
      if (missing(given)) return new (Type ?? allowed[0])(count);
      if (!allowed.some((kind) => given instanceof kind)) fail(`${name} must be a ${allowed.map((kind) => kind.name).join(' or ')}`);
      if (given.length !== count) fail(`${name} must hold ${count} numbers, not ${given.length}`, 'HF_ERROR_TOO_SMALL');
      return given;
    }

    into(struct, room, arrays) {
      for (const key in room) struct.set(key, room[key]);
      for (const key in arrays) struct.set(snake(key), written(arrays[key]));
    }

    /** Arrays of lengths that the library tells. run(room, arrays) calls it, and again with more room when that was too
     * little; tell() gives the counts. The room that sufficed is remembered. */
    grow(owner, name, run, tell, rooms, arrays) {
      const memory = (owner._rooms ??= {});
      let room = mapped(rooms, (known, key) => known ?? memory[name + key] ?? 1024);
      for (;;) {
        Object.assign(this.n, room);
        const made = mapped(arrays, ([kind, dims]) => new (types[kind] ?? Uint8Array)(this.product(dims) * (layouts[kind]?.size[width] ?? 1)));
        let failure = null;
        try {
          run(room, made);
        } catch (error) {
          failure = error;
        }
        const counts = tell();
        const fits = Object.keys(room).every((key) => counts[key] <= room[key]);
        const known = Object.keys(counts).every((key) => key in room || counts[key] === this.n[key]);
        if (failure && (fits || failure.code !== constants.HF_ERROR_TOO_SMALL)) throw failure;
        Object.assign(this.n, counts);
        for (const key in room) memory[name + key] = Math.max(1024, counts[key] + (counts[key] >> 3));
        if (fits && known) return mapped(made, (array, key) => this.cut(array, ...arrays[key]));
        room = mapped(room, (_, key) => counts[key]);
      }
    }

    cut(array, kind, dims) {
      const count = this.product(dims);
      return types[kind] ? array.subarray(0, count) : rows(width, kind, array, count);
    }
  };
}
