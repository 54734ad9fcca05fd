// Painted stiffness as a list that a session and a link keep: [[level, steps], ...]. A level is the exponent of a stiffness to
// base ten; steps are its vertices in order, each as the step from the one before: short numbers, which a link packs well.

/** levels: [vertexCount]; 0 is as the body was made. places: the first vertex at the place of each; copies are left out. */
export function pack(levels, places) {
  const groups = new Map();
  for (let v = 0; v < levels.length; ++v) {
    const level = levels[v];
    if (!level || places[v] !== v) continue;
    if (!groups.has(level)) groups.set(level, { steps: [], last: 0 });
    const group = groups.get(level);
    group.steps.push(v - group.last);
    group.last = v;
  }
  return groups.size ? Array.from(groups, ([level, { steps }]) => [level, steps]).sort((a, b) => a[0] - b[0]) : null;
}

/** Calls each(vertex, level) for what is in a list; null holds nothing. */
export function unpack(list, each) {
  for (const [level, steps] of list ?? []) {
    let v = 0;
    for (const step of steps) each((v += step), level);
  }
}
