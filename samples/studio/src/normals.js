// Normals of a surface in any pose. Copies of a vertex share a normal if the file gave them the same one, so smooth places
// stay smooth over texture seams and hard edges stay hard.

// Normals of a file are told apart in steps of this part of 1: coarser than single precision, finer than an eye sees.
const NORMAL_STEPS = 64;

/** groups[v]: the first vertex that shares place and file normal with v. A table of open addresses finds it. */
export function normalGroups(positions, fileNormals) {
  const count = positions.length / 3;
  const groups = new Uint32Array(count);
  const bits = new Uint32Array(positions.buffer, positions.byteOffset, positions.length);
  const steps = fileNormals ? Int8Array.from(fileNormals, (x) => Math.round(x * NORMAL_STEPS)) : null;
  let size = 4;
  while (size < 2 * count) size *= 2;
  const table = new Uint32Array(size); // 0: free, else a vertex + 1
  for (let v = 0; v < count; ++v) {
    const a = 3 * v;
    let hash = Math.imul(bits[a], 0x9e3779b1) ^ Math.imul(bits[a + 1], 0x85ebca6b) ^ Math.imul(bits[a + 2], 0xc2b2ae35);
    if (steps) hash ^= Math.imul(steps[a] * 5 + steps[a + 1] * 17 + steps[a + 2] * 257, 0x27d4eb2f);
    hash = Math.imul(hash ^ (hash >>> 15), 0x2c1b3c6d);
    let at = (hash ^ (hash >>> 13)) & (size - 1);
    for (; table[at]; at = (at + 1) & (size - 1)) {
      const b = 3 * (table[at] - 1);
      if (bits[a] !== bits[b] || bits[a + 1] !== bits[b + 1] || bits[a + 2] !== bits[b + 2]) continue;
      if (!steps || (steps[a] === steps[b] && steps[a + 1] === steps[b + 1] && steps[a + 2] === steps[b + 2])) break;
    }
    if (!table[at]) table[at] = v + 1;
    groups[v] = table[at] - 1;
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
