// Opens a body for the library: its surface, and the handles that are proposed on it. A skeleton of the file says which pieces
// belong together, and which handle is a hand, a foot or a head.

/** skeleton: as skeletonOf gives it (model.js), or null. The pieces of one character are linked: hair and clothes follow. */
export function surfaceOf(hf, { positions, triangles, skeleton }, threads) {
  const { moving: joints, weights, parents: jointParents } = skeleton ?? {};
  return new hf.Surface(positions, triangles, { linkPieces: skeleton ? { joints, weights, jointParents } : true, ...threads });
}

/**
 * { proposals, regions }. With a skeleton regions gives each vertex the number of its proposal, HF_NO_INDEX for none: a head
 * is a whole head there. Without one it is null, and a region is what lies within the radius.
 */
export function proposalsOf(hf, surface, { positions, triangles, skeleton }) {
  const made = skeleton && skeletonIn(hf, positions, triangles, skeleton);
  try {
    const regions = new Uint32Array(positions.length / 3);
    return { proposals: surface.proposeHandles({ skeleton: made, regions }), regions: made && regions };
  } finally {
    made?.close();
  }
}

/** null: the library refuses the skeleton of the file, and the shape alone tells. */
function skeletonIn(hf, positions, triangles, { names, parents, rest, moving: joints, weights }) {
  try {
    return new hf.Skeleton(names, parents, rest, { skin: { positions, triangles, joints, weights } });
  } catch (error) {
    if (error instanceof hf.HfError) return null;
    throw error;
  }
}
