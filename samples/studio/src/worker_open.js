// Opens a body for the library: its surface, and the handles that are proposed on it. A skeleton of the file says which pieces
// belong together, and which handle is a hand, a foot or a head.

/**
 * skeleton: as skeletonOf gives it (model.js), or null. The pieces of one character are linked: hair and clothes follow. A
 * skeleton that the library refuses links nothing: then the pieces are linked as those of a body without one. notes: receives a
 * sentence that says so.
 */
export function surfaceOf(hf, { positions, triangles, skeleton }, threads, notes = []) {
  const plain = () => new hf.Surface(positions, triangles, { linkPieces: true, ...threads });
  if (!skeleton) return plain();
  const { moving: joints, weights, parents: jointParents } = skeleton;
  try {
    return new hf.Surface(positions, triangles, { linkPieces: { joints, weights, jointParents }, ...threads });
  } catch (error) {
    if (!isRefused(error)) throw error;
    const surface = plain(); // throws the same where the mesh is what is refused
    notes.push(`pieces are linked without the bones of the file (${sentenceOf(error)})`);
    return surface;
  }
}

/** True where what was given is refused: no memory, say, is another matter. */
const isRefused = ({ codeName }) =>
  ['HF_ERROR_INVALID_ARGUMENT', 'HF_ERROR_OUT_OF_RANGE', 'HF_ERROR_NON_FINITE'].includes(codeName);

/** The library's own sentence, without the name of the function and the code. */
export function sentenceOf({ message, functionName = '', codeName = null }) {
  return codeName ? message.replace(`${functionName}: `, '').replace(` (${codeName})`, '') : message;
}

/**
 * { proposals, regions }. With a skeleton regions gives each vertex the number of its proposal, HF_NO_INDEX for none: a head
 * is a whole head there. Without one it is null, and a region is what lies within the radius.
 */
export function proposalsOf(hf, surface, { positions, triangles, skeleton }, notes = []) {
  const made = skeleton && skeletonIn(hf, positions, triangles, skeleton, notes);
  try {
    const regions = new Uint32Array(positions.length / 3);
    return { proposals: surface.proposeHandles({ skeleton: made, regions }), regions: made && regions };
  } finally {
    made?.close();
  }
}

/** null: the library refuses the skeleton of the file, and the shape alone tells; a note says so. */
function skeletonIn(hf, positions, triangles, { names, parents, rest, moving: joints, weights }, notes) {
  try {
    return new hf.Skeleton(names, parents, rest, { skin: { positions, triangles, joints, weights } });
  } catch (error) {
    if (!isRefused(error)) throw error;
    notes.push(`handles are proposed by shape, without the bones of the file (${sentenceOf(error)})`);
    return null;
  }
}
