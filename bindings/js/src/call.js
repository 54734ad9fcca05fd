// One call of the library: arrays in and out, and the counts that follow from them and from the objects.
import { constants, layouts } from './raw.js';
import { Struct, camel, fail, isArray, missing, numbers, read, rows, types } from './marshal.js';

const mapped = (all, change) => Object.fromEntries(Object.entries(all).map(([key, one]) => [key, change(one, key)]));

export function callClass({ width }) {
  const make = (type, fields) => new Struct(width, type, fields);

  return class Call {
    /** A struct of figures that the object keeps. */
    static told(owner, type) {
      return ((owner._told ??= {})[type] ??= make(type));
    }

    constructor(owner, named) {
      this.n = { ...owner?._n };
      for (const name in named)
        for (const key in named[name]?._n) this.n[`${name}.${key}`] = this.n[key] = named[name]._n[key];
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
      return typeof dim === 'number' ? dim : base in this.n ? this.n[base] + Number(more) : (this.n[dim] ?? null);
    }

    product(dims) {
      return dims.reduce((product, dim) => product * (this.size(dim) ?? 0), 1);
    }

    /** Checks how many numbers there are; a dimension that is not known yet becomes known. */
    fit(length, name, dims) {
      const loose = dims.filter((dim) => this.size(dim) === null);
      const known = this.product(dims.filter((dim) => !loose.includes(dim)));
      if (loose.length > 1) fail(`${name} cannot be read without what it belongs to`);
      if (!loose.length && length !== known) fail(`${name} must hold ${known} numbers, not ${length}`);
      if (known ? length % known : length) fail(`${name} must hold ${known} numbers for each, not ${length}`);
      for (const dim of loose) this.n[dim] = length / (known || 1);
    }

    // ---- what goes in

    numbers(name, values, kinds, dims) {
      const array = numbers(values, name, kinds);
      this.fit(array.length, name, dims);
      return array;
    }

    array(name, values, kinds, dims) {
      if (missing(values)) return null;
      const all = typeof values === 'number' && dims.every((dim) => this.size(dim) !== null); // one number for all
      return read(this.numbers(name, all ? new Array(this.product(dims)).fill(values) : values, kinds, dims));
    }

    /** An hf_array or hf_array_out of numbers, or null. */
    viewOf(struct, mark, array, dims) {
      if (!array) return null;
      const type = { 8: 'HF_TYPE_DOUBLE', 2: 'HF_TYPE_UINT16' }[array.BYTES_PER_ELEMENT];
      return make(struct, { data: mark(array), count: this.size(dims[0]) ?? 0, type: constants[type] ?? 0 });
    }

    /** Lists of different lengths, one after the other: their lengths, and they. */
    lists(name, lists, dims) {
      if (missing(lists)) return [null, null];
      if (!Array.isArray(lists)) fail(`${name} must be a list of lists`);
      const refuse = (i) => fail(`${name}[${i}] is null`, 'HF_ERROR_NULL_POINTER');
      const arrays = lists.map((list, i) => numbers(list ?? refuse(i), `${name}[${i}]`, 'u4'));
      this.fit(arrays.length, name, dims);
      return [arrays.map((a) => a.length), arrays.flatMap((a) => [...a])].map((all) => read(Uint32Array.from(all)));
    }

    /** Rows of a struct, one after the other. make(value, name): its struct. */
    rows(name, values, dims, row) {
      if (missing(values)) return null;
      if (!Array.isArray(values)) fail(`${name} must be a list`);
      this.fit(values.length, name, dims);
      const structs = values.map((value, i) => row(value, `${name}[${i}]`).bytes);
      const bytes = new Uint8Array(structs.length && structs.length * structs[0].length);
      structs.forEach((struct, i) => bytes.set(struct, i * struct.length));
      return read(bytes);
    }

    /** One place: a vertex, a hit, or three corners of a triangle and their barycentrics. */
    place(value, name) {
      const vertex = Number.isInteger(value) && { corners: [value, value, value], barycentrics: [1, 0, 0] };
      const { corners, barycentrics } = vertex || (value?.place ?? value ?? {});
      if (corners?.length !== 3 || barycentrics?.length !== 3)
        fail(`${name} must be a vertex, a hit, or an object with three corners and three barycentrics`);
      return make('hf_place', { corners, barycentrics });
    }

    /** Lines in UTF-8: a string, or a list of one for each. */
    text(values, name) {
      if (missing(values)) return null;
      if (typeof values !== 'string' && !Array.isArray(values)) fail(`${name} must be a string or a list of strings`);
      const clean = (line) => `${String(line).replace(/[\0\n]/g, ' ')}\n`;
      return read(new TextEncoder().encode(`${Array.isArray(values) ? values.map(clean).join('') : values}\0`));
    }

    /** A desc inside a desc: an object of its options, or its first array alone. */
    inner(given, first, fill, prefix) {
      return missing(given) ? null : fill(this, prefix, isArray(given) ? { [first]: given } : given);
    }

    // ---- what comes out

    /** The caller's array, or a new one. */
    out(given, kinds, dims, Type, name = 'out') {
      const count = this.product(dims);
      const allowed = kinds.split(' ').map((kind) => types[kind]);
      const array = given ?? new (Type ?? allowed[0])(count);
      const right = allowed.some((kind) => array instanceof kind);
      if (!right) fail(`${name} must be a ${allowed.map((kind) => kind.name).join(' or ')}`);
      if (array.length !== count) fail(`${name} must hold ${count} numbers, not ${array.length}`, 'HF_ERROR_TOO_SMALL');
      return array;
    }

    /** Arrays of lengths that the library tells. run(room, arrays) calls it, and again with more room when that was too
     * little; tell() gives the counts. The room that sufficed is remembered. */
    grow(owner, name, run, tell, rooms, arrays) {
      const memory = (owner._rooms ??= {});
      let room = mapped(rooms, (known, key) => known ?? memory[name + key] ?? 1024);
      for (;;) {
        Object.assign(this.n, room);
        const size = (kind, dims) => this.product(dims) * (layouts[kind]?.size[width] ?? 1);
        const made = mapped(arrays, ([kind, dims]) => new (types[kind] ?? Uint8Array)(size(kind, dims)));
        const fits = () => Object.keys(room).every((key) => tell()[key] <= room[key]);
        try {
          run(room, made);
        } catch (error) {
          if (error.code !== constants.HF_ERROR_TOO_SMALL || fits()) throw error;
        }
        const counts = tell();
        const done = fits() && Object.keys(counts).every((key) => key in room || counts[key] === this.n[key]);
        Object.assign(this.n, counts);
        room = mapped(room, (_, key) => counts[key]);
        for (const key in room) memory[name + key] = Math.max(1024, counts[key] + (counts[key] >> 3));
        if (done) return mapped(arrays, ([kind, dims], key) => rows(width, kind, made[key], this.product(dims)));
      }
    }
  };
}
