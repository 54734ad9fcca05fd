// Skin weights of a surface for a skeleton (hf/weights.h).
export function weightClasses(tools) {
  const { make, call, handleOf, query, watched, Recorded, bare, classes, doubles, fail, integers, read, written } =
    tools;

  /** The joints as hf_joints_desc. */
  const bonesOf = ({
    heads,
    tails = null,
    axes = null,
    parents = null,
    deforms = null,
    sources = null,
    progress = null,
  }) => {
    const starts = doubles(heads, 'heads');
    if (!starts || starts.length % 3) fail('heads must hold three numbers for each joint');
    const count = starts.length / 3;
    const ends = doubles(tails, 'tails', 3 * count);
    const along = doubles(axes, 'axes', 3 * count);
    const listOf = (values, name) => {
      const list = integers(values, name);
      if (list && list.length !== count) fail(`${name} must hold ${count} numbers, not ${list.length}`);
      return list;
    };
    const [above, before, moves] = [listOf(parents, 'parents'), listOf(sources, 'sources'), listOf(deforms, 'deforms')];
    const desc = make('hf_joints_desc', { joint_count: count, heads: read(starts) });
    desc
      .set('tails', ends && read(ends))
      .set('axes', along && read(along))
      .set('parents', above && read(above));
    desc.set('sources', before && read(before)).set('deforms', moves && read(Int32Array.from(moves)));
    return watched(desc, progress);
  };

  /** Names of joints as the library takes them: one line for each. */
  const linesOf = (names, count) => {
    if (names === null || names === undefined) return null;
    if (!Array.isArray(names) || names.length !== count) fail(`names must be a list of ${count} names`);
    const text = names.map((name) => `${String(name).replace(/[\0\n]/g, ' ')}\n`).join('');
    return new TextEncoder().encode(`${text}\0`);
  };

  /** Joints and shares of every vertex, descending; origins: HF_WEIGHTS_* of each vertex. */
  const room = (count, size) => {
    const found = {
      joints: new Uint32Array(count * size),
      weights: new Float32Array(count * size),
      origins: new Uint8Array(size),
    };
    const out = make('hf_weights_out', { vertex_capacity: size });
    for (const [name, array] of Object.entries(found)) out.set(name, written(array));
    return [{ influenceCount: count, ...found }, out];
  };

  /** Sets the given weights of a desc, and what the calls that carry and mirror share. */
  const describe = (type, surface, { joints, weights }, { distance = 0, angle = 0, influenceCount = 4, progress = null }) => {
    const [numbers, shares] = [integers(joints, 'joints'), weights && Float32Array.from(weights)];
    const size = surface.vertexCount;
    if (!numbers || !shares || numbers.length !== shares.length || numbers.length % size)
      fail(`joints and weights must hold as many numbers for each of ${size} vertices`);
    const desc = make(type, { source_influence_count: numbers.length / size, distance, angle, influence_count: influenceCount });
    desc.set('joints', read(numbers)).set('weights', read(shares));
    return watched(desc, progress);
  };

  /** Carries weights to another surface: clothes, levels of detail. given: { joints, weights } of the source. */
  const transferWeights = (source, given, target, options = {}) => {
    const from = handleOf(source, classes.Surface, 'source');
    const to = handleOf(target, classes.Surface, 'target');
    if (!from || !to) fail('transferWeights needs two surfaces', 'HF_ERROR_NULL_POINTER');
    const desc = describe('hf_weights_transfer_desc', source, given ?? {}, options);
    const [found, out] = room(desc.get('influence_count') || 4, target.vertexCount);
    const info = make('hf_weights_transfer_info');
    call('hf_weights_transfer', from, to, desc, out, info);
    return { ...found, info: info.toObject() };
  };

  /** Mirrors weights of one side to the other. heads: three numbers for each joint. partners: HF_NO_INDEX: find it. */
  const mirrorWeights = (surface, given, heads, options = {}) => {
    const { names = null, partners = null, plane = null, to = 0, ...more } = options;
    const on = handleOf(surface, classes.Surface, 'surface');
    if (!on) fail('mirrorWeights needs a surface', 'HF_ERROR_NULL_POINTER');
    const places = doubles(heads, 'heads');
    if (!places || places.length % 3) fail('heads must hold three numbers for each joint');
    const count = places.length / 3;
    const pairs = integers(partners, 'partners');
    if (pairs && pairs.length !== count) fail(`partners must hold ${count} numbers, not ${pairs.length}`);
    const desc = describe('hf_weights_mirror_desc', surface, given ?? {}, more);
    const [flat, lines] = [doubles(plane, 'plane', 6), linesOf(names, count)];
    desc.set('joint_count', count).set('to', to).set('heads', read(places)).set('names', lines && read(lines));
    desc.set('partners', pairs && read(pairs)).set('plane', flat && read(flat));
    const [found, out] = room(desc.get('influence_count') || 4, surface.vertexCount);
    const [others, pairings] = [new Uint32Array(count), new Uint32Array(count)];
    const info = make('hf_weights_mirror_info');
    call('hf_weights_mirror', on, desc, out, written(others), written(pairings), info);
    return { ...found, partners: others, pairings, info: info.toObject() };
  };

  /** Weights of the joints at every vertex. joints: { heads, tails, axes, parents, deforms }. */
  class Weights extends Recorded {
    static prefix = 'hf_weights';
    constructor(surface, joints, { influenceCount = 0 } = {}) {
      super(bare);
      if (surface === bare) return;
      this._make('create', handleOf(surface, classes.Surface, 'surface'), bonesOf(joints ?? {}), influenceCount);
      this.vertexCount = surface.vertexCount;
    }
    clone() {
      return this._copy();
    }
    setJoints(joints) {
      call('hf_weights_set_joints', this._handle, bonesOf(joints));
    }
    /** Places with given weights: `joints` and `weights` hold as many numbers for each. Replaces all pins. */
    setPins(vertices, { joints = [], weights = [], radii = null, progress = null } = {}) {
      const at = integers(vertices ?? [], 'vertices');
      const [numbers, shares] = [integers(joints, 'joints'), Float32Array.from(weights)];
      if (numbers.length !== shares.length) fail('joints and weights must be of one length');
      if (at.length && numbers.length % at.length) fail('joints must hold as many numbers for each pin');
      const discs = doubles(radii, 'radii', at.length);
      const desc = make('hf_pins_desc', {
        pin_count: at.length,
        influence_count: at.length ? numbers.length / at.length : 0,
      });
      desc.set('vertices', read(at)).set('radii', discs && read(discs));
      desc.set('joints', read(numbers)).set('weights', read(shares));
      call('hf_weights_set_pins', this._handle, watched(desc, progress));
    }
    /** Replaces all locks; values: a number for each vertex and lock, or null for the present ones. */
    setLocks(joints, values = null) {
      const numbers = integers(joints, 'joints') ?? new Uint32Array(0);
      if (values && !(values instanceof Float32Array && values.length === numbers.length * this.vertexCount))
        fail(`values must be a Float32Array of ${numbers.length * this.vertexCount} numbers`);
      call('hf_weights_set_locks', this._handle, numbers.length, read(numbers), values && read(values));
    }
    /** Joints and shares of every vertex, descending; origins: HF_WEIGHTS_* of each vertex. */
    weights() {
      const ask = make('hf_weights_out');
      call('hf_weights_get', this._handle, ask);
      const [found, out] = room(ask.get('influence_count'), this.vertexCount);
      call('hf_weights_get', this._handle, out);
      return found;
    }
    /** flags: bits HF_JOINT_* of each joint; vertexCounts: vertices that ask for it. */
    joints() {
      const count = new Uint32Array(1);
      call('hf_weights_get_joints', this._handle, 0, null, null, written(count));
      const [flags, vertexCounts] = [new Uint32Array(count[0]), new Uint32Array(count[0])];
      call('hf_weights_get_joints', this._handle, count[0], written(flags), written(vertexCounts), written(count));
      return { flags, vertexCounts };
    }
    /** Bits HF_HELPER_* of each joint: why it looks like a helper. names: of the joints, or null. */
    helpers(names = null) {
      const count = new Uint32Array(1);
      call('hf_weights_get_helpers', this._handle, null, 0, null, written(count));
      const [reasons, lines] = [new Uint32Array(count[0]), linesOf(names, count[0])];
      call('hf_weights_get_helpers', this._handle, lines && read(lines), count[0], written(reasons), null);
      return reasons;
    }
    get info() {
      return query('hf_weights_info', 'hf_weights_get_info', this._handle);
    }
  }

  return { Weights, transferWeights, mirrorWeights };
}
