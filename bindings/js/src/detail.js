// Regions of a surface, their smooth base, and detail carried to another region (hf/region.h).
export function detailClasses(tools) {
  const { make, call, handleOf, query, watched, Handle, Recorded, fail, integers, output, points, read, written } =
    tools;

  const morph = (name, thing, weight, out, { normals = null, Type = Float32Array } = {}) => {
    if (typeof weight !== 'number') fail('weight must be a number');
    out = output(out, 3 * thing.vertexCount, Type);
    const desc = make('hf_morph_desc', { weight });
    desc.set(out instanceof Float32Array ? 'positions' : 'positions_f64', written(out));
    if (normals) {
      if (!(normals instanceof Float32Array) || normals.length !== 3 * thing.vertexCount) {
        fail(`normals must be a Float32Array of ${3 * thing.vertexCount} numbers`);
      }
      desc.set('normals', written(normals));
    }
    call(name, thing._handle, desc);
    return out;
  };

  /** A region of a surface. `positions`: a pose to work on, null for the rest positions. `base`: HF_BASE_*. */
  class Region extends Recorded {
    static prefix = 'hf_region';
    constructor(surface, { positions = null, base = 0, progress = null } = {}) {
      super(surface, () => {
        const desc = watched(make('hf_region_desc').options({ base }), progress);
        if (!positions) return desc;
        const given = points(positions, 'positions', 3 * surface.vertexCount);
        return desc.set(given instanceof Float32Array ? 'positions' : 'positions_f64', read(given));
      });
    }
    clone() {
      return this._copy();
    }
    /** One edit: what a closed curve (`curveKind`: HF_CURVE_*) encloses; rings; vertices added and removed. */
    edit({
      curve = null,
      side = 0,
      seedVertex = 0,
      curveKind = 0,
      rings = 0,
      add = null,
      remove = null,
      progress = null,
    } = {}) {
      const desc = make('hf_region_edit_desc').options({ ringCount: rings });
      const along = integers(curve, 'curve');
      if (along) {
        const line = make('hf_curve_desc').options({ side, seedVertex, kind: curveKind });
        desc.set('curve', line.set('point_count', along.length).set('vertices', read(along)));
      }
      const [added, removed] = [integers(add, 'add'), integers(remove, 'remove')];
      if (added) desc.set('add_count', added.length).set('add_vertices', read(added));
      if (removed) desc.set('remove_count', removed.length).set('remove_vertices', read(removed));
      watched(desc, progress);
      call('hf_region_edit', this._handle, desc);
    }
    get info() {
      return query('hf_region_info', 'hf_region_get_info', this._handle);
    }
    /** Vertices inside (0), on the rim (1), or the sites that hold the base (2). */
    vertices(list = 0) {
      const size = new Uint32Array(1);
      call('hf_region_get_vertices', this._handle, list, 0, null, written(size));
      const out = new Uint32Array(size[0]);
      call('hf_region_get_vertices', this._handle, list, out.length, written(out), written(size));
      return out;
    }
    /** xyz of the corners of the last closed curve, to draw it; the last is joined to the first. */
    curve() {
      const size = new Uint32Array(1);
      call('hf_region_get_curve', this._handle, 0, null, written(size));
      const out = new Float64Array(3 * size[0]);
      call('hf_region_get_curve', this._handle, size[0], written(out), written(size));
      return out;
    }
    /** Weight 0: the surface, 1: its smooth base; between and beyond in proportion. */
    morph(weight, out, options) {
      return morph('hf_region_morph', this, weight, out, options);
    }
  }

  /** The detail of one region on the base of another. */
  class Detail extends Handle {
    static prefix = 'hf_detail';
    constructor(source, target, { sourceVertices = null, targetVertices = null, scale = 0, progress = null } = {}) {
      super();
      const [starts, ends] = [integers(sourceVertices, 'sourceVertices'), integers(targetVertices, 'targetVertices')];
      if ((starts ?? []).length !== (ends ?? []).length)
        fail('sourceVertices and targetVertices must be of one length');
      const desc = make('hf_detail_desc').options({ scale });
      if (starts) {
        desc.set('pair_count', starts.length).set('source_vertices', read(starts)).set('target_vertices', read(ends));
      }
      watched(desc, progress);
      const [from, to] = [handleOf(source, Region, 'source'), handleOf(target, Region, 'target')];
      this._make('create', from, to, desc);
      this.vertexCount = target.vertexCount;
    }
    /** Weight 0: the target's smooth base, 1: with the source's detail; more exaggerates. */
    morph(weight, out, options) {
      return morph('hf_detail_morph', this, weight, out, options);
    }
  }

  return { Region, Detail };
}
