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

/** What smoothNormals goes through: offsets of the corners' coordinates (from) and of their groups' normals (to), triangles by
 * their smallest group: neighbours in memory come one after the other, which halves the time. Made once for a body. */
export function normalSums(triangles, groups) {
  const count = triangles.length / 3;
  const starts = new Uint32Array(groups.length + 1);
  const least = new Uint32Array(count);
  for (let t = 0; t < count; ++t) {
    least[t] = Math.min(groups[triangles[3 * t]], groups[triangles[3 * t + 1]], groups[triangles[3 * t + 2]]);
    ++starts[least[t] + 1];
  }
  for (let g = 0; g < groups.length; ++g) starts[g + 1] += starts[g];
  const from = new Uint32Array(3 * count);
  for (let t = 0; t < count; ++t) {
    const at = 3 * starts[least[t]]++;
    for (let k = 0; k < 3; ++k) from[at + k] = 3 * triangles[3 * t + k];
  }
  const to = groups.some((group, v) => group !== v) ? from.map((at) => 3 * groups[at / 3]) : from;
  return { from, to, groups };
}

/** Area-weighted normals of every group, written for every vertex. */
export function smoothNormals(positions, { from, to, groups }, out) {
  out.fill(0);
  // plain numbers, no arrays: this runs for every frame
  for (let t = 0; t < from.length; t += 3) {
    const a = from[t];
    const b = from[t + 1];
    const c = from[t + 2];
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
    const i = to[t];
    const j = to[t + 1];
    const k = to[t + 2];
    out[i] += x;
    out[i + 1] += y;
    out[i + 2] += z;
    out[j] += x;
    out[j + 1] += y;
    out[j + 2] += z;
    out[k] += x;
    out[k + 1] += y;
    out[k + 2] += z;
  }
  for (let v = 0; v < groups.length; ++v) {
    const g = 3 * groups[v];
    const at = 3 * v;
    if (g === at) {
      const length = Math.sqrt(out[g] * out[g] + out[g + 1] * out[g + 1] + out[g + 2] * out[g + 2]);
      if (length > 0) {
        out[g] /= length;
        out[g + 1] /= length;
        out[g + 2] /= length;
      } else out[g + 1] = 1;
    } else {
      out[at] = out[g];
      out[at + 1] = out[g + 1];
      out[at + 2] = out[g + 2];
    }
  }
  return out;
}
