// Pairs of two bodies: feet, head, tail, hands and the trunk, found by joint names and by shape (hf_gltf_pairs_propose).
import { gltf } from './worker_gltf.js';

/** HF_ERROR_EMPTY: the two bodies have too little in common. */
const NOTHING = -7;

/**
 * side: { glb, positions, triangles, surface }. Answers with pairs and the axes of both bodies. A file that hf_gltf does not
 * take is looked at by its shape alone.
 */
export async function proposedPairs({ constants }, source, target) {
  const { ok, text, within, word, doubles, module } = await gltf();
  return within((space, struct) => {
    const handles = [];
    const opened = ({ glb, positions, triangles }) => {
      const out = space(4);
      try {
        // struct_size, reserved, bytes, -, byte_count of 64 bits, file, -
        ok('model_read', struct(32, 0, space(glb), 0, glb.length, 0, 0, 0), out);
      } catch {
        const sizes = [positions.length / 3, triangles.length / 3, 0, 0];
        ok('model_create', struct(28, ...sizes, space(positions), space(triangles)), out);
      }
      handles.push(['model_destroy', word(out)]);
      return word(out);
    };
    /** The extremities of the surface, as vertices of the model: its vertices have an order of their own. */
    const tipsOf = (model, { surface }) => {
      const tips = surface.findExtremities({ kind: constants.HF_EXTREMITIES_GEODESIC }).map(({ position }) => position);
      const info = struct(32);
      ok('model_get_info', model, info);
      const count = word(info + 4);
      const places = space(24 * count);
      ok('model_get_surface', model, struct(24, 0, places));
      const at = module.HEAPF64.subarray(places >> 3, (places >> 3) + 3 * count);
      const away = ([x, y, z], v) => (at[3 * v] - x) ** 2 + (at[3 * v + 1] - y) ** 2 + (at[3 * v + 2] - z) ** 2;
      return Uint32Array.from(tips, (tip) => {
        let best = 0;
        for (let v = 1; v < count; ++v) if (away(tip, v) < away(tip, best)) best = v;
        return best;
      });
    };
    try {
      const [from, to] = [source, target].map(opened);
      const [a, b] = [tipsOf(from, source), tipsOf(to, target)];
      const out = space(4);
      ok('pairs_propose', from, to, struct(24, a.length, b.length, 0, space(a), space(b)), out);
      const pairs = word(out);
      handles.push(['pairs_destroy', pairs]);
      const info = struct(88);
      ok('pairs_get_info', pairs, info);
      const axes = (at) => Array.from(module.HEAPF32.subarray(at >> 2, (at >> 2) + 9));
      const found = Array.from({ length: word(info + 4) }, (_, i) => {
        const pair = struct(136);
        ok('pairs_get_pair', pairs, i, pair);
        const [sourceRadius, targetRadius] = doubles(pair + 64, 2);
        return {
          ...kindOf(constants, word(pair + 4)),
          name: text(pair + 88, 48),
          source: { position: doubles(pair + 16, 3), radius: sourceRadius },
          target: { position: doubles(pair + 40, 3), radius: targetRadius },
        };
      });
      const scale = module.HEAPF32[(info + 80) >> 2];
      const ground = word(info + 84);
      return { pairs: found, axes: { sourceAxes: axes(info + 8), targetAxes: axes(info + 44), scale, ground } };
    } catch (error) {
      if (error.code === NOTHING) return { pairs: [], axes: {} };
      throw error;
    } finally {
      for (const [destroy, handle] of handles.reverse()) module[`_hf_gltf_${destroy}`](handle);
    }
  });
}

/** What a pair is for the page, and its flags for the library. */
function kindOf({ HF_PAIR_FOOT, HF_PAIR_TRUNK, HF_PAIR_NECK, HF_PAIR_TAIL, HF_PAIR_ARM }, flags) {
  const parts = [
    [HF_PAIR_NECK, 'neck'],
    [HF_PAIR_TAIL, 'tail'],
    [HF_PAIR_ARM, 'arm'],
  ];
  return {
    kind: flags & HF_PAIR_FOOT ? 'foot' : flags & HF_PAIR_TRUNK ? 'trunk' : 'tip',
    part: parts.find(([flag]) => flags & flag)?.[1] ?? null,
    flags,
  };
}
