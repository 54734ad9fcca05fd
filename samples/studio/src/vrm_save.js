// A vrm file with another shape: its JSON and its data stay as they are, and places and normals are added at their end. So all
// that names nodes, meshes and pictures by number (the map of the humanoid, expressions, springs) stays true.

const JSON_CHUNK = 0x4e4f534a;
const BINARY_CHUNK = 0x004e4942;
const FLOAT = 5126;
const padded = (length) => (length + 3) & ~3;

/** { json, binary } of the bytes of a glb file. */
function chunksOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const found = {};
  for (let at = 12; at + 8 <= bytes.length; at += 8 + view.getUint32(at, true))
    found[view.getUint32(at + 4, true)] ??= bytes.subarray(at + 8, at + 8 + view.getUint32(at, true));
  return { json: JSON.parse(new TextDecoder().decode(found[JSON_CHUNK])), binary: found[BINARY_CHUNK] ?? new Uint8Array(0) };
}

function glbOf(json, pieces, length) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  const bytes = new Uint8Array(20 + padded(text.length) + 8 + length);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, padded(text.length), JSON_CHUNK].forEach((word, i) => view.setUint32(4 * i, word, true));
  bytes.fill(0x20, 20, 20 + padded(text.length)).set(text, 20);
  let at = 20 + padded(text.length);
  view.setUint32(at, length, true);
  view.setUint32(at + 4, BINARY_CHUNK, true);
  at += 8;
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
      throw Object.assign(new Error('The file is compressed by Draco, which the studio cannot write.'), { advice: 'Save it as glb.' });
    const places = Float32Array.from(locals.subarray(3 * part.first, 3 * (part.first + part.count)));
    primitive.attributes = { ...primitive.attributes, POSITION: add(places, boundsOf(places)) };
    if ('NORMAL' in primitive.attributes) primitive.attributes.NORMAL = add(localNormals(part, shape.normals), {});
  }
  json.buffers[0].byteLength = length;
  return glbOf(json, pieces, length);
}
