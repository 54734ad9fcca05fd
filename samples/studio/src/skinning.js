// A body bent by its bones: what a game engine does with skin weights (linear blend skinning).

/** The largest `count` shares of every vertex, of sum 1. lost: the largest share that a vertex loses. */
export function pruned({ influenceCount, joints, weights }, count) {
  const vertexCount = weights.length / influenceCount;
  const out = {
    influenceCount: count,
    joints: new Uint32Array(count * vertexCount),
    weights: new Float32Array(count * vertexCount),
    lost: 0,
  };
  const order = Array.from({ length: influenceCount }, (_, k) => k);
  for (let v = 0; v < vertexCount; ++v) {
    const at = influenceCount * v;
    order.sort((a, b) => weights[at + b] - weights[at + a] || a - b);
    let [all, kept] = [0, 0];
    for (let k = 0; k < influenceCount; ++k) {
      all += weights[at + k];
      if (k < count) kept += weights[at + order[k]];
    }
    if (!(kept > 0)) continue;
    out.lost = Math.max(out.lost, 1 - kept / all);
    for (let k = 0; k < Math.min(count, influenceCount); ++k) {
      out.joints[count * v + k] = joints[at + order[k]];
      out.weights[count * v + k] = weights[at + order[k]] / kept;
    }
  }
  return out;
}

/** The matrices of bones that are turned about their heads, with what hangs on them. turns: bone -> Quaternion. */
export function turnedBones({ Matrix4, Vector3 }, { heads, parents }, turns) {
  const found = new Array(parents.length);
  const of = (bone) => {
    if (found[bone]) return found[bone];
    const above = parents[bone] < parents.length ? of(parents[bone]) : new Matrix4();
    const turn = turns.get(bone);
    if (!turn) return (found[bone] = above);
    const head = new Vector3().fromArray(heads, 3 * bone);
    const own = new Matrix4().makeRotationFromQuaternion(turn);
    own.setPosition(head.clone().sub(head.clone().applyQuaternion(turn)));
    return (found[bone] = above.clone().multiply(own));
  };
  return parents.map((_, bone) => of(bone));
}

/** The places of vertices under the matrices of their bones. A vertex without a bone stays. */
export function skinned(positions, { influenceCount, joints, weights }, matrices, out) {
  const flat = new Float64Array(12 * matrices.length);
  matrices.forEach(({ elements: e }, j) => {
    for (let k = 0; k < 3; ++k) flat.set([e[k], e[4 + k], e[8 + k], e[12 + k]], 12 * j + 4 * k);
  });
  for (let v = 0; 3 * v < positions.length; ++v) {
    const x = positions[3 * v];
    const y = positions[3 * v + 1];
    const z = positions[3 * v + 2];
    let a = 0;
    let b = 0;
    let c = 0;
    let sum = 0;
    for (let i = influenceCount * v; i < influenceCount * (v + 1); ++i) {
      const share = weights[i];
      if (!share) continue;
      const m = 12 * joints[i];
      sum += share;
      a += share * (flat[m] * x + flat[m + 1] * y + flat[m + 2] * z + flat[m + 3]);
      b += share * (flat[m + 4] * x + flat[m + 5] * y + flat[m + 6] * z + flat[m + 7]);
      c += share * (flat[m + 8] * x + flat[m + 9] * y + flat[m + 10] * z + flat[m + 11]);
    }
    out[3 * v] = sum ? a / sum : x;
    out[3 * v + 1] = sum ? b / sum : y;
    out[3 * v + 2] = sum ? c / sum : z;
  }
  return out;
}
