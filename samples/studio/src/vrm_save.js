// A vrm file with another shape: its JSON and its data stay as they are, and places and normals are added at their end. So all
// that names nodes, meshes and pictures by number (the map of the humanoid, expressions, springs) stays true.

// words of the format glb 2 (Khronos): "glTF", its version, the kinds of chunks, and the component type of floats
const [MAGIC, VERSION] = [0x46546c67, 2];
const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;
const FLOAT = 5126;
/** Bytes of the file's head, and of the head of a chunk. */
const [HEAD, CHUNK_HEAD] = [12, 8];
const SPACE = 0x20;
/** Chunks and accessors begin at multiples of four bytes. */
const padded = (length) => (length + 3) & ~3;

const unwritten = (message) => Object.assign(new Error(message), { advice: 'Save it as glb.' });

/** { json, binary } of the bytes of a glb file. */
function chunksOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const found = {};
  for (let at = HEAD; at + CHUNK_HEAD <= bytes.length; ) {
    const [length, kind] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    found[kind] ??= bytes.subarray(at + CHUNK_HEAD, at + CHUNK_HEAD + length);
    at += CHUNK_HEAD + length;
  }
  if (!found[JSON_CHUNK]) throw unwritten('The file is glTF as text, which is not written as vrm.');
  const json = JSON.parse(new TextDecoder().decode(found[JSON_CHUNK]));
  // what is added goes to the end of the binary part, which is the first buffer without an address
  if (json.buffers?.[0] && (json.buffers[0].uri || !found[BINARY_CHUNK]))
    throw unwritten('The file keeps its data outside of its binary part, where the studio cannot add to it.');
  json.buffers ??= [];
  json.buffers[0] ??= {};
  for (const list of ['bufferViews', 'accessors']) json[list] ??= [];
  return { json, binary: found[BINARY_CHUNK] ?? new Uint8Array(0) };
}

function glbOf(json, pieces, length) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const first = HEAD + CHUNK_HEAD;
  let at = first + padded(text.length);
  const bytes = new Uint8Array(at + CHUNK_HEAD + length);
  const view = new DataView(bytes.buffer);
  const words = [MAGIC, VERSION, bytes.length, padded(text.length), JSON_CHUNK];
  words.forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(SPACE, first, at).set(text, first);
  view.setUint32(at, length, true);
  view.setUint32(at + 4, BINARY_CHUNK, true);
  at += CHUNK_HEAD;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += padded(piece.length);
  }
  return bytes;
}

export function shapedVrm(app, { localNormals, localsOf }) {
  const { body, shape } = app;
  const { json, binary } = chunksOf(body.vrm);
  const root = body.document.getRoot();
  const [meshes, nodes] = [root.listMeshes(), root.listNodes()];
  const locals = localsOf(body, shape.positions);
  const pieces = [binary];
  let length = padded(binary.length);
  const add = (array, bounds) => {
    const bytes = new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
    pieces.push(bytes);
    const bufferView = json.bufferViews.push({ buffer: 0, byteOffset: length, byteLength: bytes.length }) - 1;
    length += padded(bytes.length);
    return json.accessors.push({ bufferView, componentType: FLOAT, count: array.length / 3, type: 'VEC3', ...bounds }) - 1;
  };
  const boundsOf = (array) => {
    const [min, max] = [Array(3).fill(Infinity), Array(3).fill(-Infinity)];
    array.forEach((x, i) => ([min[i % 3], max[i % 3]] = [Math.min(min[i % 3], x), Math.max(max[i % 3], x)]));
    return { min, max };
  };
  // nodes that share a mesh get one each, because their shapes may differ now
  const owners = new Map();
  const meshOf = (node, number) => {
    const own = [...owners].find(([, owner]) => owner.node === node)?.[0];
    if (own !== undefined) return own;
    const mine = owners.has(number) ? json.meshes.push(structuredClone(json.meshes[number])) - 1 : number;
    owners.set(mine, { node });
    json.nodes[nodes.indexOf(node)].mesh = mine;
    return mine;
  };
  for (const part of body.parts) {
    const mesh = part.node.getMesh();
    const primitive = json.meshes[meshOf(part.node, meshes.indexOf(mesh))].primitives[mesh.listPrimitives().indexOf(part.primitive)];
    if (primitive.extensions?.KHR_draco_mesh_compression)
      throw unwritten('The file is compressed by Draco, which the studio cannot write.');
    const places = Float32Array.from(locals.subarray(3 * part.first, 3 * (part.first + part.count)));
    primitive.attributes = { ...primitive.attributes, POSITION: add(places, boundsOf(places)) };
    if ('NORMAL' in primitive.attributes) primitive.attributes.NORMAL = add(localNormals(part, shape.normals), {});
  }
  json.buffers[0].byteLength = length;
  return glbOf(json, pieces, length);
}
