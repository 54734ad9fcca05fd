// The stiffness of the body: a surface beside the one that was opened, made by edits. Poses and fields move to it.
import { normalGroups } from './normals.js';
import { unpack } from './stiffness.js';

export function stiffnessOf({ surface: plain, positions }) {
  const count = positions.length / 3;
  const none = new Float64Array(count);
  let surface = plain;
  let held = none; // the level of each vertex
  let direct = true; // made from the plain surface by one edit: its bits depend on the list alone

  const shut = (old) => old !== plain && old.close(); // what stands on it keeps it alive
  /** Vertices whose level differs. Plain loops: this runs for every frame. */
  const changes = (was, wanted) => {
    const vertices = [];
    for (let v = 0; v < count; ++v) if (was[v] !== wanted[v]) vertices.push(v);
    return vertices;
  };
  return {
    get surface() {
      return surface;
    },
    /** Brings the surface to a list of stiffness.js. exact: by one edit of the plain one. A refusal changes nothing. */
    hold(list, exact = false) {
      const wanted = new Float64Array(count);
      let empty = true;
      const strange = []; // a list of another body: the library says what is wrong
      unpack(list, (v, level) => {
        empty = false;
        if (v in wanted) wanted[v] = level;
        else strange.push(v);
      });
      let vertices = changes(held, wanted).concat(strange);
      if (!vertices.length && (direct || !exact)) return;
      const whole = exact || empty;
      if (whole) vertices = changes(none, wanted).concat(strange);
      const from = whole ? plain : surface;
      const stiffness = vertices.map((v) => 10 ** (wanted[v] ?? 0));
      const next = vertices.length ? from.edit({ vertices, stiffness }) : from;
      if (next !== surface) shut(surface);
      direct = from === plain || (direct && next === from);
      [surface, held] = [next, wanted];
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
