// How rough a body is: whether there is detail to smooth or to exaggerate.

/**
 * The height of a vertex over the middle of its neighbours, less what they have too (so that a bend of the surface does not
 * count), as part of the length of an edge: its mean over the body, for each length of an edge as part of the size. So a body
 * has the same roughness when it is meshed finer. places: the first vertex at the place of each.
 */
export function roughness({ positions: p, triangles }, normals, places, size) {
  const count = p.length / 3;
  const [heights, around, lengths, degrees] = [0, 1, 2, 3].map(() => new Float32Array(count));
  const edges = (act) => {
    for (let i = 0; i < triangles.length; i += 3)
      for (let k = 0; k < 3; ++k) act(places[triangles[i + k]], places[triangles[i + ((k + 1) % 3)]]);
  };
  edges((a, b) => {
    const [x, y, z] = [p[3 * b] - p[3 * a], p[3 * b + 1] - p[3 * a + 1], p[3 * b + 2] - p[3 * a + 2]];
    heights[a] -= x * normals[3 * a] + y * normals[3 * a + 1] + z * normals[3 * a + 2];
    heights[b] += x * normals[3 * b] + y * normals[3 * b + 1] + z * normals[3 * b + 2];
    const length = Math.sqrt(x * x + y * y + z * z);
    lengths[a] += length;
    lengths[b] += length;
    ++degrees[a];
    ++degrees[b];
  });
  for (let v = 0; v < count; ++v) if (degrees[v]) heights[v] /= degrees[v];
  edges((a, b) => {
    around[a] += heights[b];
    around[b] += heights[a];
  });
  let [sum, edge] = [0, 0];
  for (let v = 0; v < count; ++v) {
    if (!(lengths[v] > 0)) continue;
    sum += (degrees[v] * Math.abs(heights[v] - around[v] / degrees[v])) / lengths[v];
    edge += lengths[v] / degrees[v];
  }
  return edge > 0 ? (size * sum) / edge : 0;
}
