// Geodesic distances and direction fields on a surface (hf/analysis.h, hf/direction.h).
export function fieldClasses(tools) {
  const {
    make,
    call,
    direct,
    query,
    watched,
    table,
    rowSize,
    OnSurface,
    Recorded,
    doubles,
    integers,
    output,
    read,
    written,
    counted,
    pairOf,
    solveName,
  } = tools;

  class Geodesics extends OnSurface {
    static prefix = 'hf_geodesics';
    constructor(surface, { progress = null, ...options } = {}) {
      super(surface, () => watched(make('hf_geodesics_desc').options(options), progress));
    }
    distance(sources, out, Type = Float32Array) {
      const at = integers(sources, 'sources');
      out = output(out, this.vertexCount, Type);
      call(solveName('hf_geodesics_solve', out), this._handle, counted(at), at && read(at), written(out), 0);
      return out;
    }
  }

  class Direction extends Recorded {
    static prefix = 'hf_direction';
    #told = make('hf_solve_info');
    /** What the last solve told: components and vertices that no site reaches. */
    get solveInfo() {
      return this.#told.toObject();
    }
    constructor(surface, { progress = null, ...options } = {}) {
      super(surface, () => watched(make('hf_direction_desc').options(options), progress));
    }
    /** A direction field with the same constraints; shares connection and factor. */
    clone() {
      return this._copy();
    }
    addSites(vertices, vectors) {
      const at = integers(vertices, 'vertices');
      const given = doubles(vectors, 'vectors', 3 * counted(at));
      const out = new Uint32Array(counted(at));
      call('hf_direction_add_sites', this._handle, counted(at), at && read(at), given && read(given), written(out));
      return out;
    }
    removeSites(sites) {
      const numbers = integers(sites, 'sites');
      call('hf_direction_remove_sites', this._handle, counted(numbers), numbers && read(numbers));
    }
    moveSites(sites, vertices) {
      const [numbers, at] = pairOf(sites, vertices);
      call('hf_direction_move_sites', this._handle, numbers.length, read(numbers), read(at));
    }
    setVectors(sites, vectors) {
      const numbers = integers(sites, 'sites');
      const given = doubles(vectors, 'vectors', 3 * counted(numbers));
      call('hf_direction_set_vectors', this._handle, counted(numbers), numbers && read(numbers), given && read(given));
    }
    rotateSites(sites, angles) {
      const numbers = integers(sites, 'sites');
      const turns = doubles(angles, 'angles', counted(numbers));
      call('hf_direction_rotate_sites', this._handle, counted(numbers), numbers && read(numbers), turns && read(turns));
    }
    sites() {
      const n = this.siteCount;
      const found = { sites: new Uint32Array(n), vertices: new Uint32Array(n), vectors: new Float64Array(3 * n) };
      call('hf_direction_get_sites', this._handle, n, ...Object.values(found).map(written), null);
      return found;
    }
    get siteCount() {
      return direct('hf_direction_get_site_count', this._handle);
    }
    get statistics() {
      return query('hf_direction_statistics', 'hf_direction_get_statistics', this._handle);
    }
    solve(out, Type = Float32Array) {
      out = output(out, 3 * this.vertexCount, Type);
      call(solveName('hf_direction_solve', out), this._handle, written(out), 0, this.#told);
      return out;
    }
    singularities() {
      const count = new Uint32Array(1);
      call('hf_direction_get_singularities', this._handle, 0, null, written(count));
      const bytes = new Uint8Array(count[0] * rowSize('hf_singularity'));
      if (count[0]) call('hf_direction_get_singularities', this._handle, count[0], written(bytes), written(count));
      return table('hf_singularity', bytes, count[0]);
    }
  }

  return { Geodesics, Direction };
}
