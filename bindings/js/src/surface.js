// Surface and Progress: the mesh with its factor, what is read from it, and picking (hf/surface.h, hf/analysis.h).
import { constants } from './raw.js';

export function surfaceClasses(tools) {
  const {
    make,
    call,
    handleOf,
    query,
    watched,
    table,
    rowSize,
    Handle,
    doubles,
    fail,
    integers,
    points,
    read,
    written,
    backend,
    bare,
    classes,
    counted,
    scalarsOf,
  } = tools;

  class Progress extends Handle {
    static prefix = 'hf_progress';
    constructor() {
      super();
      this._make('create');
    }
    get fraction() {
      const value = new Float64Array(1);
      call('hf_progress_get_fraction', this._handle, written(value));
      return value[0];
    }
    cancel() {
      call('hf_progress_cancel', this._handle);
    }
  }

  /** Where a surface stands when it is picked: posed positions, or null for the rest positions. */
  const pickOf = (positions, vertexCount, frontOnly = false) => {
    const desc = make('hf_pick_desc', { front_only: Number(frontOnly) });
    if (!positions) return desc;
    const given = points(positions, 'positions', 3 * vertexCount);
    return desc.set(given instanceof Float32Array ? 'positions' : 'positions_f64', read(given));
  };

  /** Sets the faces of a desc: { starts, sizes, corners }; starts without sizes are offsets, one more than faces. */
  const facesInto = (desc, faces) => {
    const starts = integers(faces.starts, 'faces.starts');
    const sizes = integers(faces.sizes, 'faces.sizes');
    const corners = integers(faces.corners, 'faces.corners');
    if (starts && sizes && starts.length !== sizes.length) fail('faces.starts and faces.sizes must be of one length');
    const count = sizes ? sizes.length : Math.max(0, (starts?.length ?? 0) - 1);
    desc.set('face_count', count).set('corner_count', corners?.length ?? 0);
    desc.set('face_starts', starts && read(starts)).set('face_sizes', sizes && read(sizes));
    desc.set('corners', corners && read(corners));
  };

  /** The desc of automatic links between pieces. options: distance, stiffness, overlayDistance. tags: see Surface. */
  const linksOf = (options, tags, vertexCount) => {
    const desc = make('hf_links_desc', { mode: constants.HF_LINK_PIECES });
    if (typeof options === 'object') desc.options(options, ['mode', 'influence_count', 'link_count', 'light_count', 'heavy_count']);
    const groups = integers(tags, 'tags');
    if (groups && groups.length !== vertexCount) fail(`tags must hold one number for each of ${vertexCount} vertices`);
    return desc.set('tags', groups && read(groups));
  };

  /** Make one per mesh; solvers, poses and the rest are made on it. */
  class Surface extends Handle {
    static prefix = 'hf_surface';
    constructor(positions, triangles, given = {}) {
      const { savedFactor = null, progress = null, faces = null, linkPieces = false, tags = null, ...options } = given;
      super();
      if (positions === bare) return;
      const xyz = points(positions, 'positions');
      const short = triangles instanceof Uint16Array;
      const corners = short ? triangles : integers(triangles, 'triangles');
      if (corners && corners.length % 3) fail(`triangles must hold three numbers each, not ${corners.length}`);
      const desc = make('hf_surface_desc').options(options, [
        'vertex_count',
        'triangle_count',
        'face_count',
        'corner_count',
      ]);
      desc.set('vertex_count', xyz.length / 3).set('triangle_count', corners ? corners.length / 3 : 0);
      desc.set(xyz instanceof Float32Array ? 'positions' : 'positions_f64', read(xyz));
      desc.set(short ? 'triangles_u16' : 'triangles', corners && read(corners));
      if (faces) facesInto(desc, faces);
      if (tags && !linkPieces) fail('tags need linkPieces');
      if (linkPieces) desc.set('links', linksOf(linkPieces, tags, xyz.length / 3));
      this._finish('create', desc, savedFactor, progress);
    }
    /** A surface of a graph: two vertices for each edge, and its weight. What needs triangles throws. */
    static fromGraph(
      vertexCount,
      edges,
      weights,
      { masses = null, savedFactor = null, progress = null, ...options } = {},
    ) {
      const [ends, sizes] = [integers(edges, 'edges'), doubles(weights, 'weights')];
      if (ends && sizes && ends.length !== 2 * sizes.length)
        fail('edges must hold two vertices for each of the weights');
      const mass = masses && doubles(masses, 'masses', vertexCount);
      const desc = make('hf_graph_desc').options(options, ['vertex_count', 'edge_count']);
      desc.set('vertex_count', vertexCount).set('edge_count', sizes ? sizes.length : 1);
      desc
        .set('edges', ends && read(ends))
        .set('weights', sizes && read(sizes))
        .set('masses', mass && read(mass));
      const surface = new this(bare);
      surface._finish('create_graph', desc, savedFactor, progress);
      return surface;
    }
    _finish(verb, desc, savedFactor, progress) {
      watched(desc, progress);
      if (savedFactor) {
        if (!(savedFactor instanceof Uint8Array)) fail('savedFactor must be a Uint8Array');
        desc.set('saved_factor', make('hf_factor_desc', { bytes: read(savedFactor), byte_count: savedFactor.length }));
      }
      this._make(verb, desc);
      this.vertexCount = desc.get('vertex_count');
    }
    /** The options it was made with, defaults filled in. */
    get info() {
      return query('hf_surface_info', 'hf_surface_get_info', this._handle);
    }
    /** The piece of every vertex (HF_NO_INDEX for isolated ones), and 1 for each vertex of a light piece. */
    get pieces() {
      const [pieces, light] = [new Uint32Array(this.vertexCount), new Int32Array(this.vertexCount)];
      const count = new Uint32Array(1);
      const room = this.vertexCount;
      call('hf_surface_get_pieces', this._handle, room, written(pieces), written(light), written(count));
      return { pieces, light };
    }
    get report() {
      return query('hf_surface_report', 'hf_surface_get_report', this._handle);
    }
    /** How far a deformation has opened the links: `positions` posed. */
    measureGaps(positions) {
      const xyz = points(positions, 'positions', 3 * this.vertexCount);
      const desc = make('hf_gaps_desc').set(xyz instanceof Float32Array ? 'positions' : 'positions_f64', read(xyz));
      const info = make('hf_gaps_info');
      call('hf_surface_measure_gaps', this._handle, desc, 0, null, info);
      return info.toObject();
    }
    get statistics() {
      return query('hf_surface_statistics', 'hf_surface_get_statistics', this._handle);
    }
    get components() {
      const out = new Uint32Array(this.vertexCount);
      call('hf_surface_get_components', this._handle, this.vertexCount, written(out), null);
      return out;
    }
    /** The factor of one kind of field as bytes, for the option savedFactor. */
    save(fieldKind = 0) {
      const size = backend.newHandle();
      call('hf_surface_save', this._handle, fieldKind, null, 0, null, written(size));
      const bytes = new Uint8Array(Number(size[0]));
      call('hf_surface_save', this._handle, fieldKind, null, bytes.length, written(bytes), null);
      return bytes;
    }
    /** The first triangle on a ray, or null. `positions`: a pose of the surface, null for the rest positions. */
    castRay(origin, direction, { positions = null, frontOnly = false } = {}) {
      const [from, along] = [doubles(origin, 'origin', 3), doubles(direction, 'direction', 3)];
      const hit = make('hf_hit');
      const desc = pickOf(positions, this.vertexCount, frontOnly);
      call('hf_surface_cast_ray', this._handle, from && read(from), along && read(along), desc, hit);
      const { found, ...rest } = hit.toObject();
      return found ? rest : null;
    }
    /** The vertex nearest to a point, and its distance. */
    findVertex(point, { positions = null } = {}) {
      const at = doubles(point, 'point', 3);
      const [vertex, distance] = [new Uint32Array(1), new Float64Array(1)];
      const desc = pickOf(positions, this.vertexCount);
      call('hf_surface_find_vertex', this._handle, at && read(at), desc, written(vertex), written(distance));
      return { vertex: vertex[0], distance: distance[0] };
    }

    spaceLevels(field, levelCount, spacing = 0) {
      const out = new Float64Array(Number.isInteger(levelCount) && levelCount > 0 ? Math.min(levelCount, 1000000) : 0);
      call(
        'hf_surface_space_levels',
        this._handle,
        scalarsOf(field, this.vertexCount),
        spacing,
        levelCount,
        written(out),
      );
      return out;
    }
    traceIsolines(field, levels) {
      const scalars = scalarsOf(field, this.vertexCount);
      const wanted = doubles(levels, 'levels');
      const count = counted(wanted);
      const ask = make('hf_isolines');
      call('hf_surface_trace_isolines', this._handle, scalars, count, wanted && read(wanted), ask);
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
        call('hf_surface_trace_isolines', this._handle, scalars, count, read(wanted), lines);
      }
      return result;
    }
    findCriticalPoints(field) {
      const scalars = scalarsOf(field, this.vertexCount);
      const info = make('hf_critical_info');
      call('hf_surface_find_critical_points', this._handle, scalars, 0, null, info);
      const count = info.get('point_count');
      const bytes = new Uint8Array(count * rowSize('hf_critical_point'));
      if (count) call('hf_surface_find_critical_points', this._handle, scalars, count, written(bytes), info);
      return table('hf_critical_point', bytes, count);
    }
    findExtremities({ geodesics = null, progress = null, ...options } = {}) {
      const desc = make('hf_extremities_desc').options(options);
      if (geodesics) desc.set('geodesics', handleOf(geodesics, classes.Geodesics, 'geodesics'));
      watched(desc, progress);
      const count = new Uint32Array(1);
      call('hf_surface_find_extremities', this._handle, desc, 0, null, written(count));
      const bytes = new Uint8Array(count[0] * rowSize('hf_extremity'));
      if (count[0]) call('hf_surface_find_extremities', this._handle, desc, count[0], written(bytes), written(count));
      return table('hf_extremity', bytes, count[0]);
    }
    proposeHandles({ progress = null, ...options } = {}) {
      const desc = make('hf_handle_proposals_desc').options(options);
      watched(desc, progress);
      // room for all at once: a call that only counts would search the surface twice
      const room = Math.min(desc.get('limit') || 32, constants.HF_HANDLE_LIMIT);
      const count = new Uint32Array(1);
      const bytes = new Uint8Array(room * rowSize('hf_handle_proposal'));
      call('hf_surface_propose_handles', this._handle, desc, room, written(bytes), written(count));
      return table('hf_handle_proposal', bytes, count[0]);
    }
  }

  return { Surface, Progress };
}
