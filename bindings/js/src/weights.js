// Skin weights of a surface for a skeleton (hf/weights.h).
export function weightClasses(tools) {
  const { make, call, handleOf, query, watched, Recorded, bare, classes, doubles, fail, integers, read, written } =
    tools;

  /** The bones as hf_bones_desc. */
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
    if (!starts || starts.length % 3) fail('heads must hold three numbers for each bone');
    const count = starts.length / 3;
    const ends = doubles(tails, 'tails', 3 * count);
    const along = doubles(axes, 'axes', 3 * count);
    const listOf = (values, name) => {
      const list = integers(values, name);
      if (list && list.length !== count) fail(`${name} must hold ${count} numbers, not ${list.length}`);
      return list;
    };
    const [above, before, moves] = [listOf(parents, 'parents'), listOf(sources, 'sources'), listOf(deforms, 'deforms')];
    const desc = make('hf_bones_desc', { bone_count: count, heads: read(starts) });
    desc
      .set('tails', ends && read(ends))
      .set('axes', along && read(along))
      .set('parents', above && read(above));
    desc.set('sources', before && read(before)).set('deforms', moves && read(Int32Array.from(moves)));
    return watched(desc, progress);
  };

  /** Weights of the bones at every vertex. bones: { heads, tails, axes, parents, deforms }. */
  class Weights extends Recorded {
    static prefix = 'hf_weights';
    constructor(surface, bones, { weightCount = 0 } = {}) {
      super(bare);
      if (surface === bare) return;
      this._make('create', handleOf(surface, classes.Surface, 'surface'), bonesOf(bones ?? {}), weightCount);
      this.vertexCount = surface.vertexCount;
    }
    clone() {
      return this._copy();
    }
    setBones(bones) {
      call('hf_weights_set_bones', this._handle, bonesOf(bones));
    }
    /** Places with given weights: `joints` and `weights` hold as many numbers for each. Replaces all pins. */
    setPins(vertices, { joints = [], weights = [], radii = null, progress = null } = {}) {
      const at = integers(vertices ?? [], 'vertices');
      const [bones, shares] = [integers(joints, 'joints'), Float32Array.from(weights)];
      if (bones.length !== shares.length) fail('joints and weights must be of one length');
      if (at.length && bones.length % at.length) fail('joints must hold as many numbers for each pin');
      const discs = doubles(radii, 'radii', at.length);
      const desc = make('hf_pins_desc', {
        pin_count: at.length,
        joint_count: at.length ? bones.length / at.length : 0,
      });
      desc.set('vertices', read(at)).set('radii', discs && read(discs));
      desc.set('joints', read(bones)).set('weights', read(shares));
      call('hf_weights_set_pins', this._handle, watched(desc, progress));
    }
    /** Replaces all locks; values: a number for each vertex and lock, or null for the present ones. */
    setLocks(bones, values = null) {
      const numbers = integers(bones, 'bones') ?? new Uint32Array(0);
      if (values && !(values instanceof Float32Array && values.length === numbers.length * this.vertexCount))
        fail(`values must be a Float32Array of ${numbers.length * this.vertexCount} numbers`);
      call('hf_weights_set_locks', this._handle, numbers.length, read(numbers), values && read(values));
    }
    /** Bones and shares of every vertex, descending; origins: HF_WEIGHTS_* of each vertex. */
    weights() {
      const ask = make('hf_weights_out');
      call('hf_weights_get', this._handle, ask);
      const [count, size] = [ask.get('weight_count'), this.vertexCount];
      const found = {
        joints: new Uint32Array(count * size),
        weights: new Float32Array(count * size),
        origins: new Uint8Array(size),
      };
      const out = make('hf_weights_out', { vertex_capacity: size });
      for (const [name, array] of Object.entries(found)) out.set(name, written(array));
      call('hf_weights_get', this._handle, out);
      return { weightCount: count, ...found };
    }
    /** flags: bits HF_BONE_* of each bone; vertexCounts: vertices that ask for it. */
    bones() {
      const count = new Uint32Array(1);
      call('hf_weights_get_bones', this._handle, 0, null, null, written(count));
      const [flags, vertexCounts] = [new Uint32Array(count[0]), new Uint32Array(count[0])];
      call('hf_weights_get_bones', this._handle, count[0], written(flags), written(vertexCounts), written(count));
      return { flags, vertexCounts };
    }
    get info() {
      return query('hf_weights_info', 'hf_weights_get_info', this._handle);
    }
  }

  return { Weights };
}
