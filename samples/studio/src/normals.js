// Normals of a surface in any pose. Copies of a vertex share a normal if the file gave them the same one, so smooth places
// stay smooth over texture seams and hard edges stay hard.

// Normals of a file are told apart in steps of this part of 1: coarser than single precision, finer than an eye sees.
const NORMAL_STEPS = 64;

/** groups[v]: the first vertex that shares place and file normal with v. */
export function normalGroups(positions, fileNormals) {
  const count = positions.length / 3;
  const groups = new Uint32Array(count);
  const first = new Map();
  const bits = new Uint32Array(positions.buffer, positions.byteOffset, positions.length);
  for (let v = 0; v < count; ++v) {
    let key = `${bits[3 * v]},${bits[3 * v + 1]},${bits[3 * v + 2]}`;
    if (fileNormals) for (let k = 0; k < 3; ++k) key += `,${Math.round(fileNormals[3 * v + k] * NORMAL_STEPS)}`;
    const known = first.get(key);
    if (known === undefined) first.set(key, v);
    groups[v] = known ?? v;
  }
  return groups;
}

/** Area-weighted normals of every group, written for every vertex. */
export function smoothNormals(positions, triangles, groups, out) {
  out.fill(0);
  // plain numbers, no arrays: this runs for every frame
  for (let t = 0; t < triangles.length; t += 3) {
    const v0 = triangles[t];
    const v1 = triangles[t + 1];
    const v2 = triangles[t + 2];
    const a = 3 * v0;
    const b = 3 * v1;
    const c = 3 * v2;
    const x0 = positions[a];
    const y0 = positions[a + 1];
    const z0 = positions[a + 2];
    const x1 = positions[b] - x0;
    const y1 = positions[b + 1] - y0;
    const z1 = positions[b + 2] - z0;
    const x2 = positions[c] - x0;
    const y2 = positions[c + 1] - y0;
    const z2 = positions[c + 2] - z0;
    const x = y1 * z2 - z1 * y2;
    const y = z1 * x2 - x1 * z2;
    const z = x1 * y2 - y1 * x2;
    const g0 = 3 * groups[v0];
    const g1 = 3 * groups[v1];
    const g2 = 3 * groups[v2];
    out[g0] += x;
    out[g0 + 1] += y;
    out[g0 + 2] += z;
    out[g1] += x;
    out[g1 + 1] += y;
    out[g1 + 2] += z;
    out[g2] += x;
    out[g2 + 1] += y;
    out[g2 + 2] += z;
  }
  for (let v = 0; v < groups.length; ++v) {
    const g = 3 * groups[v];
    if (g === 3 * v) {
      const length = Math.sqrt(out[g] * out[g] + out[g + 1] * out[g + 1] + out[g + 2] * out[g + 2]);
      if (length > 0) {
        out[g] /= length;
        out[g + 1] /= length;
        out[g + 2] /= length;
      } else out[g + 1] = 1;
    } else out.copyWithin(3 * v, g, g + 3);
  }
  return out;
}
