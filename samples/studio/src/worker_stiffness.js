// The stiffness of the body: a surface beside the one that was opened, made by edits. Poses and fields move to it.
import { normalGroups } from './normals.js';
import { unpack } from './stiffness.js';

export function stiffnessOf({ surface: plain, positions }) {
  const count = positions.length / 3;
  let surface = plain;
  let held = new Map(); // vertex -> level, of what is not 0
  let text = 'null'; // the list that is held
  let direct = true; // made from the plain surface by one edit: its bits depend on the list alone
  let milliseconds = 0;

  const shut = (old) => old !== plain && old.close(); // what stands on it keeps it alive
  return {
    get surface() {
      return surface;
    },
    told: () => ({ milliseconds, vertexCount: held.size }),
    /** Brings the surface to a list of stiffness.js. exact: by one edit of the plain one. A refusal changes nothing. */
    hold(list, exact = false) {
      const wantedText = JSON.stringify(list ?? null);
      if (wantedText === text && (direct || !exact)) return;
      const begin = performance.now();
      const wanted = new Map();
      unpack(list, (v, level) => wanted.set(v, level));
      const [from, was] = exact || !wanted.size ? [plain, new Map()] : [surface, held];
      const vertices = [];
      for (const [v, level] of wanted) if (was.get(v) !== level) vertices.push(v);
      for (const v of was.keys()) if (!wanted.has(v)) vertices.push(v);
      const stiffness = vertices.map((v) => 10 ** (wanted.get(v) ?? 0));
      const next = vertices.length ? from.edit({ vertices, stiffness }) : from;
      if (next !== surface) shut(surface);
      direct = from === plain || (direct && next === from);
      [surface, held, text] = [next, wanted, wantedText];
      milliseconds = performance.now() - begin;
    },
    /** What the brush walks on: the neighbours of vertex v are ends[starts[v]] to ends[starts[v + 1] - 1], by first vertices of each place. */
    net(triangles) {
      const places = normalGroups(positions, null);
      const starts = new Uint32Array(count + 1);
      for (const v of triangles) starts[places[v] + 1] += 2;
      for (let v = 0; v < count; ++v) starts[v + 1] += starts[v];
      const [ends, at] = [new Uint32Array(2 * triangles.length), starts.slice()];
      for (let t = 0; t < triangles.length; t += 3)
        for (let k = 0; k < 3; ++k) {
          const v = places[triangles[t + k]];
          for (const other of [1, 2]) ends[at[v]++] = places[triangles[t + ((k + other) % 3)]];
        }
      return { places, starts, ends };
    },
    close: () => shut(surface),
  };
}
