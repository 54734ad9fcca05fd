// Files that hold one mesh and nothing else. The Worker reads them: a large one takes longer than a picture may wait.
import { readPly } from './ply_mesh.js';
import { readObj, readOff } from './text_mesh.js';

const readers = {
  ply: readPly,
  obj: (bytes, name) => readObj(new TextDecoder().decode(bytes), name),
  off: (bytes, name) => readOff(new TextDecoder().decode(bytes), name),
};

/** { positions, triangles } of the bytes of such a file. */
export const readMesh = (bytes, name) => readers[name.toLowerCase().split('.').pop()](bytes, name);
