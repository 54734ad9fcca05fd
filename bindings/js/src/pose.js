// Poses and motion transfer (hf/pose.h, hf/transfer.h).
export function poseClasses(tools) {
  const {
    make,
    call,
    direct,
    handleOf,
    query,
    Handle,
    OnSurface,
    doubles,
    fail,
    integers,
    output,
    points,
    read,
    regions,
    written,
    counted,
    classes,
  } = tools;

  const skinOf = (name, handle, vertexCount, influenceCount) => {
    const ask = make('hf_skin_info', { influence_count: influenceCount });
    call(name, handle, ask);
    const n = ask.get('joint_count');
    const skin = {
      pivots: new Float64Array(3 * n),
      rotations: new Float64Array(4 * n),
      translations: new Float64Array(3 * n),
      joints: new Uint32Array(vertexCount * influenceCount),
      weights: new Float32Array(vertexCount * influenceCount),
    };
    call(
      name,
      handle,
      make('hf_skin_info', {
        influence_count: influenceCount,
        joint_capacity: n,
        vertex_capacity: vertexCount,
        pivots: written(skin.pivots),
        rotations: written(skin.rotations),
        translations: written(skin.translations),
        vertex_joints: written(skin.joints),
        vertex_weights: written(skin.weights),
      }),
    );
    return { jointCount: n, ...skin };
  };

  class Pose extends OnSurface {
    static prefix = 'hf_pose';
    #told = make('hf_deform_info');
    /** What the last deform told: iterations, clusters, vertices that no handle reaches, milliseconds by step. */
    get deformInfo() {
      return this.#told.toObject();
    }
    constructor(surface, options = {}) {
      super(surface, () => make('hf_pose_desc').options(options));
    }
    clone() {
      return this._copy();
    }
    /** The options it was made with, defaults filled in, and the number of its handles. */
    get info() {
      return query('hf_pose_info', 'hf_pose_get_info', this._handle);
    }
    /** inPlace: the handles start where the posed surface stands, not at rest; handleInfo says where. */
    addHandles(lists, { points: centres = null, radii = null, layer = 0, inPlace = false } = {}) {
      const desc = make('hf_handles_desc');
      if (centres) {
        const at = doubles(centres, 'points');
        if (at.length % 3) fail('points must hold three numbers each');
        const reach = doubles(radii, 'radii', at.length / 3);
        desc
          .set('handle_count', at.length / 3)
          .set('points', read(at))
          .set('radii', reach && read(reach));
      } else {
        const { counts, vertices } = regions(lists, 'regions');
        desc
          .set('handle_count', counted(counts))
          .set('region_counts', counts && read(counts))
          .set('region_vertices', vertices && read(vertices));
      }
      desc.options({ layer, inPlace });
      const out = new Uint32Array(desc.get('handle_count'));
      call('hf_pose_add_handles', this._handle, desc, written(out));
      return out;
    }
    /** One handle on layer 0: what is edge-connected within `radius` of a point at rest. Returns its number. */
    addHandleAt(point, radius) {
      if (typeof radius !== 'number') fail('radius must be a number');
      const at = doubles(point, 'point', 3);
      const out = new Uint32Array(1);
      call('hf_pose_add_handle_at', this._handle, at && read(at), radius, written(out));
      return out[0];
    }
    removeHandles(handles) {
      const numbers = integers(handles, 'handles');
      call('hf_pose_remove_handles', this._handle, counted(numbers), numbers && read(numbers));
    }
    /** Rigid motions from rest about the handles' centroids: quaternions x, y, z, w and translations, flat. */
    setTransforms(handles, { rotations = null, translations = null } = {}) {
      const numbers = integers(handles, 'handles');
      const count = counted(numbers);
      const turns = doubles(rotations, 'rotations', 4 * count);
      const shifts = doubles(translations, 'translations', 3 * count);
      const packed = new Float64Array(7 * count);
      for (let i = 0; i < count; ++i) {
        if (turns) packed.set(turns.subarray(4 * i, 4 * i + 4), 7 * i);
        if (shifts) packed.set(shifts.subarray(3 * i, 3 * i + 3), 7 * i + 4);
      }
      call('hf_pose_set_transforms', this._handle, count, numbers && read(numbers), read(packed));
    }
    /** Places one handle; see setTransforms. */
    setTransform(handle, { rotation = null, translation = null } = {}) {
      const turn = doubles(rotation, 'rotation', 4) ?? [0, 0, 0, 0];
      const shift = doubles(translation, 'translation', 3) ?? [0, 0, 0];
      const transform = make('hf_transform', { rotation: turn, translation: shift });
      call('hf_pose_set_transform', this._handle, integers([handle], 'handle')[0], transform);
    }
    /** 4 x 4 matrices rest -> posed, column by column as WebGL and three.js have them. */
    setMatrices(handles, matrices) {
      const numbers = integers(handles, 'handles');
      const given = doubles(matrices, 'matrices', 16 * counted(numbers));
      call('hf_pose_set_matrices', this._handle, counted(numbers), numbers && read(numbers), given && read(given));
    }
    handleInfo(handle) {
      return query('hf_handle_info', 'hf_pose_get_handle', this._handle, integers([handle], 'handle')[0]);
    }
    get handleCount() {
      return direct('hf_pose_get_handle_count', this._handle);
    }
    handleField(handle, out) {
      out = output(out, this.vertexCount, Float32Array);
      if (!(out instanceof Float32Array)) fail('out must be a Float32Array');
      call('hf_pose_get_field', this._handle, integers([handle], 'handle')[0], written(out), 0);
      return out;
    }
    deform(out, { normals = null, Type = Float32Array, ...options } = {}) {
      out = output(out, 3 * this.vertexCount, Type);
      if (out instanceof Float32Array && !normals && !Object.keys(options).length) {
        call('hf_deform', this._handle, written(out), this.#told);
        return out;
      }
      const desc = make('hf_deform_desc').options(options, ['first_vertex', 'vertex_count']);
      desc.set(out instanceof Float32Array ? 'positions' : 'positions_f64', written(out));
      if (normals) {
        if (!(normals instanceof Float32Array) || normals.length !== 3 * this.vertexCount)
          fail(`normals must be a Float32Array of ${3 * this.vertexCount} numbers`);
        desc.set('normals', written(normals));
      }
      call('hf_pose_deform', this._handle, desc, this.#told);
      return out;
    }
    skin(influenceCount = 4) {
      return skinOf('hf_pose_get_skin', this._handle, this.vertexCount, influenceCount);
    }
  }

  class Transfer extends Handle {
    static prefix = 'hf_transfer';
    constructor(source, target, options = {}) {
      super();
      this._make(
        'create',
        handleOf(source, classes.Surface, 'source'),
        handleOf(target, classes.Surface, 'target'),
        make('hf_transfer_desc').options(options),
      );
      this.sourceVertexCount = source.vertexCount;
      this.vertexCount = target.vertexCount;
    }
    addPairs(sourceRegions, targetRegions, flags = null) {
      const [source, target] = [regions(sourceRegions, 'sourceRegions'), regions(targetRegions, 'targetRegions')];
      if (!source.counts || !target.counts || source.counts.length !== target.counts.length)
        fail('sourceRegions and targetRegions must be of one length');
      const count = source.counts.length;
      const marks = integers(flags, 'flags');
      if (marks && marks.length !== count) fail(`flags must hold ${count} numbers, not ${marks.length}`);
      const out = new Uint32Array(count);
      call(
        'hf_transfer_add_pairs',
        this._handle,
        make('hf_pairs_desc', {
          pair_count: count,
          source_counts: read(source.counts),
          source_vertices: read(source.vertices),
          target_counts: read(target.counts),
          target_vertices: read(target.vertices),
          flags: marks && read(marks),
        }),
        written(out),
      );
      return out;
    }
    removePairs(pairs) {
      const numbers = integers(pairs, 'pairs');
      call('hf_transfer_remove_pairs', this._handle, counted(numbers), numbers && read(numbers));
    }
    pairInfo(pair) {
      return query('hf_pair_info', 'hf_transfer_get_pair', this._handle, integers([pair], 'pair')[0]);
    }
    get info() {
      return query('hf_transfer_info', 'hf_transfer_get_info', this._handle);
    }
    /** stride, hipHeight, neckFollow, tailFollow, armSpace, longFollow of the next frames; the others become neutral. */
    setDials(dials = {}) {
      call('hf_transfer_set_dials', this._handle, make('hf_transfer_dials').options(dials));
    }
    get dials() {
      return query('hf_transfer_dials', 'hf_transfer_get_dials', this._handle);
    }
    // 1 for every target vertex that may sink into the ground.
    sinking() {
      const out = new Uint8Array(this.vertexCount);
      call('hf_transfer_get_sinking', this._handle, written(out));
      return out;
    }
    apply(sourcePositions, out, { normals = null, Type = Float32Array, holds = null, holdPositions = null } = {}) {
      const posed = points(sourcePositions, 'sourcePositions', 3 * this.sourceVertexCount);
      out = output(out, 3 * this.vertexCount, Type);
      const frame = make('hf_transfer_frame');
      frame.set(posed instanceof Float32Array ? 'source_positions' : 'source_positions_f64', read(posed));
      frame.set(out instanceof Float32Array ? 'target_positions' : 'target_positions_f64', written(out));
      if (normals) {
        if (!(normals instanceof Float32Array) || normals.length !== 3 * this.vertexCount)
          fail(`normals must be a Float32Array of ${3 * this.vertexCount} numbers`);
        frame.set('target_normals', written(normals));
      }
      if (holds) {
        const numbers = integers(holds, 'holds');
        frame
          .set('hold_count', numbers.length)
          .set('hold_pairs', read(numbers))
          .set('hold_positions', read(doubles(holdPositions ?? [], 'holdPositions', 3 * numbers.length)));
      }
      call('hf_transfer_apply', this._handle, frame);
      return out;
    }
    skin(influenceCount = 4) {
      return skinOf('hf_transfer_get_skin', this._handle, this.vertexCount, influenceCount);
    }
  }

  return { Pose, Transfer };
}
