// What JavaScript's users expect beyond the headers: faces as hosts store them, and pieces linked by one word.
import { fail, missing } from './marshal.js';
import { constants } from './raw.js';

export function extend(classes, bare) {
  class Surface extends classes.Surface {
    /** faces: { starts, sizes, corners }; starts without sizes are offsets, one more than faces. linkPieces: true, or
     * distance, stiffness and overlayDistance of the links. tags, with linkPieces: a number for each vertex. */
    constructor(positions, triangles = null, { linkPieces = false, tags = null, ...options } = {}) {
      if (positions === bare) return super(bare);
      if (missing(positions)) fail(`positions is ${positions}`, 'HF_ERROR_NULL_POINTER');
      if (tags && !linkPieces) fail('tags need linkPieces');
      if (linkPieces) options.links = { ...Object(linkPieces), mode: constants.HF_LINK_PIECES, tags };
      super(positions, triangles, options);
    }
  }
  return { ...classes, Surface };
}
