// Quad meshes and streamlines (hf/quads.h).
export function quadClasses(tools) {
  const {
    make,
    call,
    handleOf,
    query,
    watched,
    Handle,
    OnSurface,
    fail,
    doubles,
    integers,
    read,
    written,
    classes,
    scalarsOf,
  } = tools;
  const tooSmall = 'HF_ERROR_TOO_SMALL';

  const descOf = ({
    creaseEdges = null,
    guideVertices = null,
    guideVectors = null,
    guideWeights = null,
    irregularPoints = null,
    irregularValences = null,
    irregularDirections = null,
    symmetryPlane = null,
    progress = null,
    ...options
  } = {}) => {
    const desc = make('hf_quads_desc').options(options, ['crease_count', 'guide_count', 'irregular_count']);
    const edges = integers(creaseEdges, 'creaseEdges');
    if (edges) {
      if (edges.length % 2) fail(`creaseEdges must hold two vertices each, not ${edges.length} numbers`);
      desc.set('crease_count', edges.length / 2).set('crease_edges', read(edges));
    }
    const guided = integers(guideVertices, 'guideVertices') ?? [];
    const vectors = doubles(guideVectors, 'guideVectors', 3 * guided.length);
    const weights = doubles(guideWeights, 'guideWeights', guided.length);
    desc.set('guide_count', guided.length).set('guide_vertices', read(guided));
    desc.set('guide_vectors', vectors && read(vectors));
    desc.set('guide_weights', weights && read(Float32Array.from(weights)));
    const counts = integers(irregularValences, 'irregularValences') ?? [];
    const points = doubles(irregularPoints, 'irregularPoints', 3 * counts.length);
    const directions = doubles(irregularDirections, 'irregularDirections', 3 * counts.length);
    desc.set('irregular_count', counts.length).set('irregular_valences', read(counts));
    desc.set('irregular_points', points && read(points)).set('irregular_directions', directions && read(directions));
    desc.set('symmetry_plane', doubles(symmetryPlane, 'symmetryPlane', 4));
    return watched(desc, progress);
  };

  class Quads extends Handle {
    static prefix = 'hf_quads';
    constructor(surface, options) {
      super();
      const desc = descOf(options);
      this._make('create', handleOf(surface, classes.Surface, 'surface'), desc);
    }
    /** Makes the mesh again, with the options of a new one. After an error it is what it was. */
    update(options) {
      call('hf_quads_update', this._handle, descOf(options));
    }
    get info() {
      return query('hf_quads_info', 'hf_quads_get_info', this._handle);
    }
    /** Face i has the corners faces[4 * i] to faces[4 * i + 3], counter-clockwise. */
    mesh() {
      const { vertexCount: v, faceCount: f } = this.info;
      const mesh = {
        positions: new Float64Array(3 * v),
        faces: new Uint32Array(4 * f),
        triangles: new Uint32Array(v),
        barycentrics: new Float64Array(3 * v),
        corners: new Uint32Array(3 * v),
      };
      call(
        'hf_quads_get_mesh',
        this._handle,
        make('hf_quads_mesh', {
          vertex_capacity: v,
          face_capacity: f,
          positions: written(mesh.positions),
          faces: written(mesh.faces),
          triangles: written(mesh.triangles),
          barycentrics: written(mesh.barycentrics),
          corners: written(mesh.corners),
        }),
      );
      return mesh;
    }
  }

  /** A surface prepared for tracing streamlines, again and again. */
  class Flow extends OnSurface {
    static prefix = 'hf_flow';
    #points = 4096;
    #lines = 64;
    /** wantedCount lines of equal flux from the minima of a field, or one through every seed vertex. */
    trace(field, { wantedCount = 0, seeds = null } = {}) {
      const scalars = scalarsOf(field, this.vertexCount);
      const at = integers(seeds, 'seeds');
      if (!Number.isInteger(wantedCount) || wantedCount < 0 || wantedCount > 1000000)
        fail(`wantedCount is ${wantedCount}; it must be at most 1,000,000`);
      for (;;) {
        const [p, k] = [this.#points, this.#lines];
        const found = {
          positions: new Float64Array(3 * p),
          values: new Float64Array(p),
          lineStarts: new Uint32Array(k + 1),
          lineEnds: new Uint32Array(2 * k),
        };
        const out = make('hf_streamlines', {
          wanted_count: wantedCount,
          seed_count: at ? at.length : 0,
          seeds: at && read(at),
          point_capacity: p,
          line_capacity: k,
          positions: written(found.positions),
          values: written(found.values),
          line_starts: written(found.lineStarts),
          line_ends: written(found.lineEnds),
        });
        try {
          call('hf_flow_trace', this._handle, scalars, out);
        } catch (error) {
          if (error.codeName !== tooSmall) throw error;
          this.#points = out.get('point_count') + (out.get('point_count') >> 2);
          this.#lines = out.get('line_count');
          continue;
        }
        const [points, lines] = [out.get('point_count'), out.get('line_count')];
        return {
          positions: found.positions.subarray(0, 3 * points),
          values: found.values.subarray(0, points),
          lineStarts: found.lineStarts.subarray(0, lines + 1),
          lineEnds: found.lineEnds.subarray(0, 2 * lines),
        };
      }
    }
  }

  return { Quads, Flow };
}
