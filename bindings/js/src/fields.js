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
    fail,
    integers,
    output,
    read,
    written,
    counted,
    pairOf,
    solveName,
  } = tools;

  /** A place is a vertex, or three corners of a triangle and their barycentrics, as castRay gives them. */
  const placeOf = (place, name) => {
    const { corners, barycentrics } = Number.isInteger(place)
      ? { corners: [place, place, place], barycentrics: [1, 0, 0] }
      : (place ?? {});
    if (corners?.length !== 3 || barycentrics?.length !== 3)
      fail(`${name} must be a vertex, or an object with three corners and three barycentrics`);
    return make('hf_surface_point').set('corners', corners).set('barycentrics', barycentrics);
  };

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
    /** The shortest path between two places: xyz of its corners; empty where none leads. */
    path(from, to) {
      const [start, end, path] = [placeOf(from, 'from'), placeOf(to, 'to'), make('hf_path')];
      call('hf_geodesics_find_path', this._handle, start, end, path);
      const positions = new Float64Array(3 * path.get('point_count'));
      path.set('point_capacity', path.get('point_count')).set('positions', written(positions));
      call('hf_geodesics_find_path', this._handle, start, end, path);
      return positions;
    }
    /** The surface around a place laid out in a plane: two coordinates per vertex; NaN beyond the radius (0: no bound). */
    map(centre, radius = 0, out) {
      out = output(out, 2 * this.vertexCount, Float64Array);
      call('hf_geodesics_get_map', this._handle, placeOf(centre, 'centre'), radius, written(out), null);
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
