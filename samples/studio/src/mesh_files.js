// Files that hold one mesh and nothing else. The Worker reads them: a large one takes longer than a picture may wait.
import { ModelError } from './model_error.js';
import { readPly } from './ply_mesh.js';
import { readObj, readOff } from './text_mesh.js';

const readers = {
  ply: readPly,
  obj: (bytes, name) => readObj(new TextDecoder().decode(bytes), name),
  stl: readStl,
  off: (bytes, name) => readOff(new TextDecoder().decode(bytes), name),
};

/** three.js's reader of stl, which comes when it is needed. */
async function readStl(bytes, name) {
  let loaders = null;
  try {
    loaders = await import(new URL('loaders/loaders.js', self.location).href);
  } catch {
    throw new ModelError(`What reads ${name} could not be loaded.`, 'Open it when the network is there.');
  }
  const mesh = loaders.readStl(bytes);
  if (!mesh.triangles.length) throw new ModelError(`${name} holds no triangles.`, 'Export it again, or take one of the samples.');
  return mesh;
}

/** { positions, triangles } of the bytes of such a file. */
export const readMesh = async (bytes, name) => readers[name.toLowerCase().split('.').pop()](bytes, name);
