// One call of the library: arrays in and out, and the counts that follow from them and from the objects.
import { constants } from './raw.js';
import { Struct, doubles, fail, integers, read, rows, scalar, written } from './marshal.js';

const types = { f4: Float32Array, f8: Float64Array, u4: Uint32Array, u2: Uint16Array, u1: Uint8Array, i4: Int32Array };
const suffix = { f8: '_f64', u2: '_u16' }; // the field that takes the other type of array

const split = new Map(); // 'f4 f8' -> its parts, read once
function parts(text, separator) {
  let found = split.get(text);
  if (!found) split.set(text, (found = text.split(separator)));
  return found;
}

/** An array of a type that the library takes ('f4 f8'), as given when it is one. */
function converted(values, name, kinds) {
  const [first, second] = parts(kinds, ' ');
  if (values instanceof types[first] || (second && values instanceof types[second])) return values;
  if (kinds[0] === 'f') {
    const array = doubles(values, name);
    return kinds === 'f4' ? Float32Array.from(array) : array;
  }
  return first === 'u4' ? integers(values, name) : types[first].from(integers(values, name));
}

export function callClass(backend) {
  const make = (type, fields) => new Struct(backend.width, type, fields);
  const rowSize = (type) => make(type).bytes.length;
  const told = new WeakMap(); // object -> struct -> what the last call told

  return class Call {
    static told(owner, type) {
      return told.get(owner)?.[type]?.toObject() ?? make(type).toObject();
    }

    constructor(owner, named) {
      this.n = { ...owner?._n };
      for (const name in named)
        for (const [key, value] of Object.entries(named[name]?._n ?? {})) this.n[`${name}.${key}`] = this.n[key] = value;
    }

    told(owner, type) {
      let structs = told.get(owner);
      if (!structs) told.set(owner, (structs = {}));
      return (structs[type] ??= make(type));
    }

    known(key, value) {
      if (scalar('u32', value, key)) this.n[key] = value;
    }

    struct(type, fields) {
      const made = make(type);
      for (const name in fields) {
        const value = fields[name];
        if (value === 0 || value === false) continue; // the default of every field
        const shown = name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());
        if (value === null || value === undefined) fail(`option '${shown}' must be a number, not ${value}`);
        made.set(name, value, `option '${shown}'`);
      }
      return made;
    }

    size(dim) {
      if (typeof dim === 'number') return dim;
      const known = this.n[dim];
      if (known !== undefined) return known;
      const [base, more] = parts(dim, ' + ');
      return base in this.n ? this.n[base] + Number(more ?? 0) : null;
    }

    /** Checks how many numbers there are; a dimension that is not known yet becomes known. */
    fit(length, name, dims) {
      let known = 1;
      let loose = null;
      for (const dim of dims) {
        const size = this.size(dim);
        if (size !== null) known *= size;
        else if (loose === null) loose = dim;
        else fail(`${name} cannot be read without what it belongs to`);
      }
      if (loose === null) {
        if (length !== known) fail(`${name} must hold ${known} numbers, not ${length}`);
        return;
      }
      if (known ? length % known : length) fail(`${name} must hold ${known} numbers for each, not ${length}`);
      const [base, more] = parts(loose, ' + ');
      this.n[base] = known ? Math.max(length / known - Number(more ?? 0), 0) : 0;
    }

    array(name, values, kind, dims) {
      if (values === null || values === undefined) return null;
      if (typeof values === 'number' && dims.every((dim) => this.size(dim) !== null))
        values = new Array(dims.reduce((product, dim) => product * this.size(dim), 1)).fill(values); // one number for all
      const array = converted(values, name, kind);
      this.fit(array.length, name, dims);
      return read(array);
    }

    rows(struct, field, name, values, kinds, dims) {
      if (values === null || values === undefined) return;
      const array = converted(values, name, kinds);
      this.fit(array.length, name, dims);
      const [, second] = parts(kinds, ' ');
      struct.set(second && array instanceof types[second] ? field + suffix[second] : field, read(array));
    }

    counts(struct, fields) {
      for (const field in fields) struct.set(field, (this.n[fields[field][0]] ??= fields[field][1]));
    }

    /** Lists of different lengths, one after the other. */
    ragged(struct, counts, field, name, lists, key) {
      if (lists === null || lists === undefined) return;
      if (!Array.isArray(lists)) fail(`${name} must be a list of lists`);
      const missing = (i) => fail(`${name}[${i}] is null`, 'HF_ERROR_NULL_POINTER');
      const arrays = lists.map((list, i) => integers(list, `${name}[${i}]`) ?? missing(i));
      if ((this.n[key] ??= arrays.length) !== arrays.length)
        fail(`${name} must hold ${this.n[key]} lists, not ${arrays.length}`);
      const all = new Uint32Array(arrays.reduce((sum, array) => sum + array.length, 0));
      let at = 0;
      for (const array of arrays) {
        all.set(array, at);
        at += array.length;
      }
      struct.set(counts, read(Uint32Array.from(arrays, (array) => array.length))).set(field, read(all));
    }

    fixed(struct, field, name, values) {
      if (values === null || values === undefined) return;
      const [kind, , count] = struct.layout.fields[field];
      const array = kind[0] === 'f' ? doubles(values, name) : integers(values, name);
      if (array.length !== count) fail(`${name} must hold ${count} numbers, not ${array.length}`);
      struct.set(field, array, name);
    }

    /** Rows of a plain struct, given field by field: field -> [name, values]. */
    records(type, dims, fields) {
      const row = make(type);
      const given = Object.entries(fields).filter(([, [, values]]) => values !== null && values !== undefined);
      const arrays = given.map(([field, [name, values]]) => {
        const [kind, , count] = row.layout.fields[field];
        const array = kind[0] === 'f' ? doubles(values, name) : integers(values, name);
        this.fit(array.length, name, [...dims, count || 1]);
        return [field, array, count || 1];
      });
      const bytes = new Uint8Array((this.n[dims[0]] ?? 0) * row.bytes.length);
      for (let i = 0; i < bytes.length / row.bytes.length; ++i) {
        for (const [field, array, count] of arrays)
          row.set(field, count > 1 ? array.subarray(i * count, (i + 1) * count) : array[i]);
        bytes.set(row.bytes, i * row.bytes.length);
      }
      return read(bytes);
    }

    /** Rows that the library wrote, given back to it. */
    written(name, values, type, dims) {
      if (values === null || values === undefined) return null;
      if (!Array.isArray(values)) fail(`${name} must be a list of what the library wrote`);
      this.fit(values.length, name, dims);
      const size = rowSize(type);
      const bytes = new Uint8Array(values.length * size);
      values.forEach((value, i) => bytes.set(make(type).options(value).bytes, i * size));
      return read(bytes);
    }

    /** Lines in UTF-8: a string, or a list of one for each. */
    text(values, name) {
      if (values === null || values === undefined) return null;
      if (typeof values !== 'string' && !Array.isArray(values)) fail(`${name} must be a string or a list of strings`);
      const lines = typeof values === 'string' ? values : values.map((line) => `${String(line).replace(/[\0\n]/g, ' ')}\n`).join('');
      return read(new TextEncoder().encode(`${lines}\0`));
    }

    bytes(struct, field, count, value, name) {
      if (value === null || value === undefined) return;
      if (!(value instanceof Uint8Array)) fail(`${name} must be a Uint8Array`);
      struct.set(field, read(value)).set(count, value.length);
    }

    /** A desc inside a desc: an object of its options, or its first array alone. */
    inner(given, first, fill, prefix) {
      if (given === null || given === undefined) return null;
      return fill(this, prefix, Array.isArray(given) || ArrayBuffer.isView(given) ? { [first]: given } : given);
    }

    /** One place: a vertex, a hit, or three corners of a triangle and their barycentrics. */
    place(value, name) {
      const { corners, barycentrics } = Number.isInteger(value)
        ? { corners: [value, value, value], barycentrics: [1, 0, 0] }
        : (value?.place ?? value ?? {});
      if (corners?.length !== 3 || barycentrics?.length !== 3)
        fail(`${name} must be a vertex, a hit, or an object with three corners and three barycentrics`);
      return make('hf_place').set('corners', corners).set('barycentrics', barycentrics);
    }

    places(name, values, dims) {
      if (values === null || values === undefined) return null;
      if (!Array.isArray(values)) fail(`${name} must be a list of places`);
      this.fit(values.length, name, dims);
      const size = rowSize('hf_place');
      const bytes = new Uint8Array(values.length * size);
      values.forEach((value, i) => bytes.set(this.place(value, `${name}[${i}]`).bytes, i * size));
      return read(bytes);
    }

    /** The caller's array, or a new one. */
    out(given, kinds, dims, Type, name = 'out') {
      let count = 1;
      for (const dim of dims) count *= this.size(dim) ?? 0;
      const allowed = parts(kinds, ' ');
      if (given === null || given === undefined) return new (Type ?? types[allowed[0]])(count);
      if (!allowed.some((kind) => given instanceof types[kind]))
        fail(`${name} must be a ${allowed.map((kind) => types[kind].name).join(' or ')}`);
      if (given.length !== count) fail(`${name} must hold ${count} numbers, not ${given.length}`, 'HF_ERROR_TOO_SMALL');
      return given;
    }

    sizes() {
      return backend.width ? new BigUint64Array(1) : new Uint32Array(1);
    }

    into(struct, room, arrays) {
      for (const [key, value] of Object.entries(room)) struct.set(key, value);
      struct.pointers = struct.pointers.filter(([at]) => !Object.keys(arrays).some((key) => struct.layout.fields[fieldOf(key)][1][struct.width] === at));
      for (const [key, array] of Object.entries(arrays)) struct.set(fieldOf(key), array && written(array));
    }

    /** Arrays of lengths that the library tells. run(room, arrays) calls it, and again with more room when that was too
     * little; tell() gives the counts. The room that sufficed is remembered. */
    grow(owner, name, run, tell, rooms, arrays) {
      const memory = (owner._rooms ??= new Map());
      const keys = Object.keys(rooms);
      let room = Object.fromEntries(keys.map((key) => [key, rooms[key] ?? memory.get(name + key) ?? 1024]));
      for (;;) {
        Object.assign(this.n, room);
        const blind = Object.values(arrays).some(([, dims]) => dims.some((dim) => this.size(dim) === null));
        const made = {};
        for (const [key, [kind, dims]] of Object.entries(arrays)) {
          const count = dims.reduce((product, dim) => product * (this.size(dim) ?? 0), 1);
          made[key] = blind ? null : types[kind] ? new types[kind](count) : new Uint8Array(count * rowSize(kind));
        }
        let counts;
        try {
          run(blind ? Object.fromEntries(keys.map((key) => [key, 0])) : room, made);
          counts = tell();
          if (!blind && keys.every((key) => counts[key] <= room[key])) {
            for (const key of keys) memory.set(name + key, Math.max(room[key], 1));
            Object.assign(this.n, counts);
            return Object.fromEntries(Object.entries(made).map(([key, array]) => [key, this.cut(array, ...arrays[key])]));
          }
        } catch (error) {
          counts = tell();
          if (error.code !== constants.HF_ERROR_TOO_SMALL || keys.every((key) => counts[key] <= room[key])) throw error;
        }
        room = Object.fromEntries(keys.map((key) => [key, blind ? counts[key] : Math.max(room[key], counts[key] + (counts[key] >> 3))]));
        for (const [key, value] of Object.entries(counts)) if (!(key in room)) this.n[key] = value;
      }
    }

    cut(array, kind, dims) {
      const count = dims.reduce((product, dim) => product * this.size(dim), 1);
      return types[kind] ? array.subarray(0, count) : rows(backend.width, kind, array, count);
    }
  };
}

const fieldOf = (name) => name.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);
