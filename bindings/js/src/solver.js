// Solver and Progress.
export function solverClasses(tools) {
  const {
    make,
    call,
    direct,
    handleOf,
    query,
    table,
    rowSize,
    Handle,
    doubles,
    fail,
    integers,
    output,
    points,
    read,
    written,
    backend,
    bare,
    counted,
    pairOf,
    scalarsOf,
    solveName,
  } = tools;

  class Progress extends Handle {
    static prefix = 'hf_progress';
    constructor() {
      super();
      this._make('create');
    }
    get fraction() {
      const value = new Float32Array(1);
      call('hf_progress_get', this._handle, written(value));
      return value[0];
    }
    cancel() {
      call('hf_progress_cancel', this._handle);
    }
  }

  class Solver extends Handle {
    static prefix = 'hf';
    constructor(positions, triangles, { savedFactor = null, progress = null, ...options } = {}) {
      super();
      if (positions === bare) return;
      const xyz = points(positions, 'positions');
      const corners = integers(triangles, 'triangles');
      if (corners && corners.length % 3) fail(`triangles must hold three numbers each, not ${corners.length}`);
      const desc = make('hf_create_desc', {
        vertex_count: xyz.length / 3,
        triangle_count: corners ? corners.length / 3 : 0,
      });
      desc.options(options);
      desc.set(xyz instanceof Float32Array ? 'positions' : 'positions_f64', read(xyz));
      desc.set('triangles', corners && read(corners));
      if (progress) desc.set('progress', handleOf(progress, Progress, 'progress'));
      if (savedFactor) {
        if (!(savedFactor instanceof Uint8Array)) fail('savedFactor must be a Uint8Array');
        desc.set('saved_factor', make('hf_factor_desc', { bytes: read(savedFactor), byte_count: savedFactor.length }));
      }
      this._make('create', desc);
      this.vertexCount = xyz.length / 3;
      this.channelCount = desc.get('channel_count') || 1;
    }

    clone() {
      return this._copy();
    }
    get report() {
      return query('hf_mesh_report', 'hf_get_mesh_report', this._handle);
    }
    get statistics() {
      return query('hf_statistics', 'hf_get_statistics', this._handle);
    }
    get components() {
      const out = new Uint32Array(this.vertexCount);
      call('hf_get_components', this._handle, this.vertexCount, written(out));
      return out;
    }

    #places(vertices, values, { stiffness, radii, triangles, barycentrics } = {}) {
      const at = integers(vertices, 'vertices');
      const inside = integers(triangles, 'triangles');
      const count = counted(at ?? inside);
      if (at && inside && at.length !== inside.length) fail('vertices and triangles are given both');
      const desc = make('hf_sites_desc', { site_count: count });
      desc.set('vertices', at && read(at)).set('triangles', inside && read(inside));
      const numbers = {
        barycentrics: [barycentrics, 3 * count],
        values: [values, count * this.channelCount],
        stiffness: [stiffness, count],
        radii: [radii, count],
      };
      for (const [name, [given, size]] of Object.entries(numbers)) {
        const array = doubles(given, name, size);
        desc.set(name, array && read(array));
      }
      return { desc, count };
    }
    addSites(vertices, values, options) {
      const { desc, count } = this.#places(vertices, values, options);
      const out = new Uint32Array(count);
      call('hf_add_sites', this._handle, desc, written(out));
      return out;
    }
    removeSites(sites) {
      const numbers = integers(sites, 'sites');
      call('hf_remove_sites', this._handle, counted(numbers), numbers && read(numbers));
    }
    moveSites(sites, vertices, options) {
      const numbers = integers(sites, 'sites');
      call(
        'hf_move_sites',
        this._handle,
        counted(numbers),
        numbers && read(numbers),
        this.#places(vertices, null, options).desc,
      );
    }
    setSiteValues(sites, values) {
      const numbers = integers(sites, 'sites');
      const given = doubles(values, 'values', counted(numbers) * this.channelCount);
      call('hf_set_site_values', this._handle, counted(numbers), numbers && read(numbers), given && read(given));
    }
    editSites({
      remove = [],
      move = [],
      moveTo = null,
      set = [],
      setValues = null,
      add = null,
      addValues = null,
    } = {}) {
      const [removed, moved, changed] = [
        integers(remove ?? [], 'remove'),
        integers(move ?? [], 'move'),
        integers(set ?? [], 'set'),
      ];
      const values = doubles(setValues, 'setValues', changed.length * this.channelCount);
      const edit = make('hf_edit_desc', {
        remove_count: removed.length,
        move_count: moved.length,
        set_count: changed.length,
      });
      edit
        .set('remove_sites', read(removed))
        .set('move_sites', read(moved))
        .set('set_sites', read(changed))
        .set('set_values', values && read(values));
      if (moveTo) edit.set('move_to', this.#places(moveTo, null).desc);
      const added = add && this.#places(add, addValues);
      if (added) edit.set('add', added.desc);
      const out = new Uint32Array(added ? added.count : 0);
      call('hf_edit_sites', this._handle, edit, written(out));
      return out;
    }
    get siteCount() {
      return direct('hf_get_site_count', this._handle);
    }
    sites() {
      const n = this.siteCount;
      const arrays = {
        sites: new Uint32Array(n),
        vertices: new Uint32Array(n),
        components: new Uint32Array(n),
        values: new Float64Array(n * this.channelCount),
        stiffness: new Float64Array(n),
        flux: new Float64Array(n * this.channelCount),
        radii: new Float64Array(n),
      };
      const info = make('hf_site_info', { capacity: n });
      for (const [name, array] of Object.entries(arrays)) info.set(name, written(array));
      call('hf_get_sites', this._handle, info);
      return arrays;
    }
    record() {
      call('hf_record', this._handle);
    }
    undo() {
      call('hf_undo', this._handle);
    }
    redo() {
      call('hf_redo', this._handle);
    }
    prepareRebase() {
      call('hf_prepare_rebase', this._handle);
    }

    solve(out, Type = Float32Array) {
      out = output(out, this.vertexCount * this.channelCount, Type);
      call(solveName('hf_solve', out), this._handle, written(out), 0, null);
      return out;
    }
    solvePreview(out, { correctionCount = 0, Type = Float32Array } = {}) {
      out = output(out, this.vertexCount * this.channelCount, Type);
      call(solveName('hf_solve_preview', out), this._handle, written(out), 0, correctionCount, null);
      return out;
    }
    solveAt(vertices) {
      const at = integers(vertices, 'vertices');
      const out = new Float64Array(counted(at) * this.channelCount);
      call('hf_solve_at', this._handle, counted(at), at && read(at), written(out));
      return out;
    }
    solveVectors(out, Type = Float32Array) {
      out = output(out, 3 * this.vertexCount, Type);
      call(solveName('hf_solve_vectors', out), this._handle, written(out), 0, null, null);
      return out;
    }
    /** Measures the field on its own equations; fails when an error exceeds the tolerance (0: the default). */
    certify({ tolerance = 0 } = {}) {
      const certificate = make('hf_certificate').options({ tolerance });
      call('hf_certify', this._handle, certificate);
      return certificate.toObject();
    }
    releasePreview() {
      call('hf_release_preview', this._handle);
    }
    saveFactor() {
      const size = backend.newHandle();
      call('hf_get_factor_size', this._handle, written(size));
      const bytes = new Uint8Array(Number(size[0]));
      call('hf_save_factor', this._handle, written(bytes), bytes.length);
      return bytes;
    }

    spaceLevels(field, levelCount, spacing = 0) {
      const out = new Float64Array(Math.max(0, Math.min(levelCount, 1000000)));
      call(
        'hf_space_levels',
        this._handle,
        scalarsOf(field, this.vertexCount),
        spacing,
        Math.max(0, levelCount),
        written(out),
      );
      return out;
    }
    traceIsolines(field, levels) {
      const scalars = scalarsOf(field, this.vertexCount);
      const wanted = doubles(levels, 'levels');
      const count = counted(wanted);
      const ask = make('hf_isolines');
      call('hf_trace_isolines', this._handle, scalars, count, wanted && read(wanted), ask);
      const [p, k] = [ask.get('point_count'), ask.get('line_count')];
      const result = {
        positions: new Float64Array(3 * p),
        pointEdges: new Uint32Array(2 * p),
        parameters: new Float64Array(p),
        lineStarts: new Uint32Array(k + 1),
        lineLevels: new Uint32Array(k),
        lineClosed: new Int32Array(k),
      };
      if (k) {
        const lines = make('hf_isolines', {
          point_capacity: p,
          line_capacity: k,
          positions: written(result.positions),
          point_edges: written(result.pointEdges),
          parameters: written(result.parameters),
          line_starts: written(result.lineStarts),
          line_levels: written(result.lineLevels),
          line_closed: written(result.lineClosed),
        });
        call('hf_trace_isolines', this._handle, scalars, count, read(wanted), lines);
      }
      return result;
    }
    findCriticalPoints(field) {
      const scalars = scalarsOf(field, this.vertexCount);
      const info = make('hf_critical_info');
      call('hf_find_critical_points', this._handle, scalars, 0, null, info);
      const count = info.get('point_count');
      const bytes = new Uint8Array(count * rowSize('hf_critical_point'));
      if (count) call('hf_find_critical_points', this._handle, scalars, count, written(bytes), info);
      return table('hf_critical_point', bytes, count);
    }
    findExtremities({ geodesics = null, progress = null, ...options } = {}) {
      const desc = make('hf_extremities_desc').options(options);
      if (geodesics) desc.set('geodesics', handleOf(geodesics, tools.classes.Geodesics, 'geodesics'));
      if (progress) desc.set('progress', handleOf(progress, Progress, 'progress'));
      const count = new Uint32Array(1);
      call('hf_find_extremities', this._handle, desc, 0, null, written(count));
      const bytes = new Uint8Array(count[0] * rowSize('hf_extremity'));
      if (count[0]) call('hf_find_extremities', this._handle, desc, count[0], written(bytes), written(count));
      return table('hf_extremity', bytes, count[0]);
    }
    moveVectorSites(sites, vertices) {
      const [numbers, at] = pairOf(sites, vertices);
      call('hf_move_vector_sites', this._handle, numbers.length, read(numbers), read(at));
    }
    rotateVectorSites(sites, angles) {
      const numbers = integers(sites, 'sites');
      const turns = doubles(angles, 'angles', counted(numbers));
      call('hf_rotate_vector_sites', this._handle, counted(numbers), numbers && read(numbers), turns && read(turns));
    }
  }

  return { Solver, Progress };
}
