// Detail of regions: each region is drawn as a closed curve of vertices. Its own detail is smoothed or exaggerated by a weight,
// or that of a region of another body takes its place.
import { normalGroups } from './normals.js';

/**
 * The vertices around a region, on the border of its triangles. The rim has more where the curve went into the region and
 * back: such places lie inside.
 */
function borderOf(region, triangles, groups) {
  const inside = new Uint8Array(groups.length);
  for (const v of region.vertices(0)) inside[v] = 1;
  const edges = new Set();
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [groups[triangles[t]], groups[triangles[t + 1]], groups[triangles[t + 2]]];
    if (!corners.some((v) => inside[v])) continue;
    corners.forEach((a, k) => {
      const b = corners[(k + 1) % 3];
      const key = Math.min(a, b) * groups.length + Math.max(a, b);
      // an edge of two such triangles lies inside
      if (!edges.delete(key)) edges.add(key);
    });
  }
  return [...new Set([...edges].flatMap((key) => [Math.floor(key / groups.length), key % groups.length]))];
}

/** A region that stays while its curve and its shape stay. */
function keeper(hf, surface, rest, triangles) {
  let region = null;
  let key = '';
  let shape = null;
  let version = 0;
  let groups = null; // the first vertex at the place of each
  let starts = new Map(); // of this region
  const same = (positions) => shape === positions || (shape && positions && shape.every((x, i) => x === positions[i]));
  return {
    /** positions: a pose, or null for the body at rest. Made anew for other rings: the bits depend on no history. */
    at({ curve, seedVertex = 0, rings = 0 }, positions = null) {
      const wish = JSON.stringify([curve, seedVertex, rings]);
      if (!region || wish !== key || !same(positions)) {
        const next = new hf.Region(surface, { positions });
        try {
          next.edit({ curve: curve && { vertices: curve, seedVertex }, ringCount: rings });
        } catch (error) {
          next.close();
          throw error;
        }
        region?.close();
        region = next;
        key = wish;
        shape = positions?.slice() ?? null;
        starts = new Map();
        ++version;
      }
      return region;
    },
    /** The vertex around the region that is nearest to a vertex. */
    start(vertex) {
      if (!starts.has(vertex)) {
        groups ??= normalGroups(rest, null);
        const away = (v) => [0, 1, 2].reduce((sum, k) => sum + (rest[3 * v + k] - rest[3 * vertex + k]) ** 2, 0);
        const border = borderOf(region, triangles, groups);
        starts.set(
          vertex,
          border.reduce((best, v) => (away(v) < away(best) ? v : best)),
        );
      }
      return starts.get(vertex);
    },
    version: () => version,
    close: () => region?.close(),
  };
}

export function detailOf(body) {
  const { hf, surface } = body;
  const target = keeper(hf, surface, body.positions, body.triangles);
  const sources = new Map(); // name -> { surface, number, kept: its region }
  let carried = null; // { detail, of }

  /** Detail of a source on the target. Its curve begins where that of the target does; turn moves its beginning on (0 to 1). */
  const carry = (region, { curve }, { from, curve: other, turn }) => {
    const source = sources.get(from);
    const taken = source.kept.at({ curve: other });
    const of = [target.version(), from, source.number, source.kept.version(), turn].join();
    if (carried?.of !== of) {
      const first = other[Math.round(turn * other.length) % other.length];
      const detail = new hf.Detail(taken, region, {
        sourceVertices: [source.kept.start(first)],
        targetVertices: [target.start(curve[0])],
      });
      carried?.detail.close();
      carried = { detail, of };
    }
    return {
      detail: carried.detail,
      source: { inside: taken.vertices(0), rim: taken.vertices(1), curve: Float32Array.from(taken.curve()) },
    };
  };

  return {
    /** A body whose detail can be taken. */
    addSource(name, positions, triangles) {
      const added = new hf.Surface(positions, triangles, { linkPieces: true, ...body.threads });
      sources.get(name)?.kept.close();
      sources.get(name)?.surface.close();
      const number = (sources.get(name)?.number ?? 0) + 1;
      sources.set(name, { surface: added, number, kept: keeper(hf, added, positions, triangles) });
    },
    /** Changes the positions in place. detail: { curve, seedVertex, rings, weight, carry }. */
    apply(positions, detail) {
      const region = target.at(detail, positions);
      const { vertexCount, rimCount, area } = region.info;
      const told = { vertexCount, rimCount, area, inside: region.vertices(0), rim: region.vertices(1) };
      told.curve = Float32Array.from(region.curve());
      told.before = new Float32Array(3 * told.inside.length);
      told.inside.forEach((v, i) => told.before.set(positions.subarray(3 * v, 3 * v + 3), 3 * i));
      const { carry: wanted, weight } = detail;
      // a body that is not here any more: the surface as it is, and a word
      if (wanted && !sources.has(wanted.from)) return { ...told, missing: wanted.from };
      if (wanted) {
        const found = carry(region, detail, wanted);
        told.source = { from: wanted.from, ...found.source };
        positions.set(found.detail.morph(1 - weight));
      } else positions.set(region.morph(weight));
      return told;
    },
    close() {
      carried?.detail.close();
      target.close();
      for (const { surface: source, kept } of sources.values()) {
        kept.close();
        source.close();
      }
    },
  };
}

/** How far each vertex inside went, along its normal: out is above 0. */
export function awayOf({ inside, before }, positions, normals) {
  return Float32Array.from(inside, (v, i) => {
    const step = [0, 1, 2].map((k) => positions[3 * v + k] - before[3 * i + k]);
    const along = step.reduce((sum, x, k) => sum + x * normals[3 * v + k], 0);
    return Math.hypot(...step) * Math.sign(along);
  });
}
