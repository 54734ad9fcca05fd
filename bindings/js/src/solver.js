// Solver: sites that come and go, and the smooth field through them (hf/solver.h).
export function solverClasses(tools) {
  const {
    make,
    call,
    direct,
    query,
    watched,
    Recorded,
    doubles,
    fail,
    integers,
    output,
    read,
    written,
    bare,
    counted,
    pairOf,
    solveName,
  } = tools;

  /** Sites on a surface, and the field through them. */
  class Solver extends Recorded {
    static prefix = 'hf_solver';
    static create = 'hf_create';
    #told = make('hf_solve_info');
    #preview = make('hf_preview_info');
    /** What the last solve or solveVectors told: components and vertices that no site reaches. */
    get solveInfo() {
      return this.#told.toObject();
    }
    /** What the last solvePreview told: the error estimate, and components that no site reaches. */
    get previewInfo() {
      return this.#preview.toObject();
    }
    constructor(surface, { progress = null, ...options } = {}) {
      super(surface, () => watched(make('hf_solver_desc').options(options), progress));
      if (surface !== bare) this.channelCount = this.info.channelCount;
    }

    clone() {
      return this._copy();
    }
    /** The options it was made with, defaults filled in, and the number of its sites. */
    get info() {
      return query('hf_solver_info', 'hf_solver_get_info', this._handle);
    }
    get statistics() {
      return query('hf_solver_statistics', 'hf_solver_get_statistics', this._handle);
    }

    #places(vertices, values, { stiffness, radii, triangles, barycentrics, corners } = {}) {
      const at = integers(vertices, 'vertices');
      const inside = integers(triangles, 'triangles');
      const between = integers(corners, 'corners');
      if (between && between.length % 3) fail(`corners must hold three vertices each, not ${between.length}`);
      const count = at || inside || !between ? counted(at ?? inside) : between.length / 3;
      if (at && inside && at.length !== inside.length) fail('vertices and triangles are given both');
      if (between && between.length !== 3 * count) fail('corners are given beside vertices or triangles');
      const desc = make('hf_sites_desc', { site_count: count });
      desc.set('vertices', at && read(at)).set('triangles', inside && read(inside));
      desc.set('corners', between && read(between));
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
    /** One hard site at a vertex; values: a number, or one for each channel. Returns its number. */
    addSite(vertex, values = null) {
      const given = doubles(typeof values === 'number' ? [values] : values, 'values', this.channelCount);
      const out = new Uint32Array(1);
      const at = integers([vertex], 'vertex')[0];
      call('hf_solver_add_site', this._handle, at, given && read(given), written(out));
      return out[0];
    }
    removeSites(sites) {
      const numbers = integers(sites, 'sites');
      call('hf_remove_sites', this._handle, counted(numbers), numbers && read(numbers));
    }
    moveSites(sites, vertices, options) {
      const numbers = integers(sites, 'sites');
      call(
        'hf_solver_move_sites',
        this._handle,
        counted(numbers),
        numbers && read(numbers),
        this.#places(vertices, null, options).desc,
      );
    }
    setValues(sites, values) {
      const numbers = integers(sites, 'sites');
      const given = doubles(values, 'values', counted(numbers) * this.channelCount);
      call('hf_solver_set_values', this._handle, counted(numbers), numbers && read(numbers), given && read(given));
    }
    /** (K + A H) u = A H p + W lambda: screening is H by vertex, targets is p, 0 if null. null removes the screening. */
    setScreening(screening, targets = null) {
      const strength = doubles(screening, 'screening', this.vertexCount);
      const wish = doubles(targets, 'targets', this.vertexCount * this.channelCount);
      call('hf_solver_set_screening', this._handle, strength && read(strength), wish && read(wish));
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
      call('hf_solver_edit_sites', this._handle, edit, written(out));
      return out;
    }
    get siteCount() {
      return direct('hf_solver_get_site_count', this._handle);
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
      const info = make('hf_sites_info', { capacity: n });
      for (const [name, array] of Object.entries(arrays)) info.set(name, written(array));
      call('hf_solver_get_sites', this._handle, info);
      return arrays;
    }
    prepareRebase() {
      call('hf_solver_prepare_rebase', this._handle);
    }

    solve(out, Type = Float32Array) {
      out = output(out, this.vertexCount * this.channelCount, Type);
      const name = out instanceof Float32Array ? 'hf_solve' : 'hf_solver_solve_f64';
      call(name, this._handle, written(out), 0, this.#told);
      return out;
    }
    solvePreview(out, { correctionCount = 0, Type = Float32Array } = {}) {
      out = output(out, this.vertexCount * this.channelCount, Type);
      call(solveName('hf_solver_solve_preview', out), this._handle, written(out), 0, correctionCount, this.#preview);
      return out;
    }
    solveAt(vertices) {
      const at = integers(vertices, 'vertices');
      const out = new Float64Array(counted(at) * this.channelCount);
      call('hf_solver_solve_at', this._handle, counted(at), at && read(at), written(out));
      return out;
    }
    solveVectors(out, Type = Float32Array) {
      out = output(out, 3 * this.vertexCount, Type);
      call(solveName('hf_solver_solve_vectors', out), this._handle, written(out), 0, null, this.#told);
      return out;
    }
    /** Measures the field on its own equations; fails when an error exceeds the tolerance (0: the default). */
    certify({ tolerance = 0 } = {}) {
      const certificate = make('hf_certificate').options({ tolerance });
      call('hf_solver_certify', this._handle, certificate);
      return certificate.toObject();
    }
    releasePreview() {
      call('hf_solver_release_preview', this._handle);
    }
    moveVectors(sites, vertices) {
      const [numbers, at] = pairOf(sites, vertices);
      call('hf_solver_move_vectors', this._handle, numbers.length, read(numbers), read(at));
    }
    rotateVectors(sites, angles) {
      const numbers = integers(sites, 'sites');
      const turns = doubles(angles, 'angles', counted(numbers));
      call('hf_solver_rotate_vectors', this._handle, counted(numbers), numbers && read(numbers), turns && read(turns));
    }
  }

  return { Solver };
}
