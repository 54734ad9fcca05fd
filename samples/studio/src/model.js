// Models: a glTF document is the truth. All triangles of its scene make one body in the frame of the scene; parts say which
// primitive each range of vertices belongs to, and how to take it back there.
import { Document, WebIO } from '@gltf-transform/core';
import {
  EXTMeshoptCompression,
  KHRDracoMeshCompression,
  KHRTextureBasisu,
  KHRMaterialsUnlit,
  KHRMeshQuantization,
  KHRTextureTransform,
  KHRMaterialsClearcoat,
  KHRMaterialsEmissiveStrength,
  KHRMaterialsIOR,
  KHRMaterialsSheen,
  KHRMaterialsSpecular,
  KHRMaterialsTransmission,
  KHRMaterialsVolume,
  KHRMaterialsPBRSpecularGlossiness,
  EXTTextureWebP,
} from '@gltf-transform/extensions';
import { Matrix4, Quaternion, Vector3 } from 'three';
import { ModelError } from './model_error.js';

/** Larger models are refused: WebAssembly has 2 GB, and a factor of 2 million vertices takes more. */
const VERTEX_LIMIT = 2_000_000;

/** Compressions: what decodes them is loaded when a file uses one. Nothing is written in them. */
const COMPRESSIONS = [KHRDracoMeshCompression, EXTMeshoptCompression].map(({ EXTENSION_NAME }) => EXTENSION_NAME);

const io = (decoders = {}) =>
  new WebIO()
    .registerExtensions([
      EXTMeshoptCompression,
      KHRDracoMeshCompression,
      KHRTextureBasisu,
      KHRMaterialsUnlit,
      KHRMeshQuantization,
      KHRTextureTransform,
      KHRMaterialsClearcoat,
      KHRMaterialsEmissiveStrength,
      KHRMaterialsIOR,
      KHRMaterialsSheen,
      KHRMaterialsSpecular,
      KHRMaterialsTransmission,
      KHRMaterialsVolume,
      KHRMaterialsPBRSpecularGlossiness,
      EXTTextureWebP,
    ])
    .registerDependencies(decoders);

export const writeGlb = (document) => io().writeBinary(document);

const endingOf = (name) => name.toLowerCase().split('.').pop();

/** Files that hold one mesh and nothing else, which the Worker reads, and those that three.js reads. */
const MESHES = ['ply', 'obj', 'off', 'stl'];
const FOREIGN = ['fbx', 'dae'];
/** What a menu of files offers. */
export const formats = ['glb', 'gltf', 'vrm', ...FOREIGN, ...MESHES].map((ending) => `.${ending}`).join();

/** Reads the bytes of a file of any of these formats. readMesh: how MESHES are read, by the Worker. */
export async function readModel(bytes, name, readMesh = null) {
  if (!bytes.length) throw new ModelError(`${name} is empty.`, 'Export it again, or take one of the samples.');
  const ending = endingOf(name);
  if (FOREIGN.includes(ending)) return readForeign(bytes, name, ending);
  let document;
  if (readMesh && MESHES.includes(ending)) document = documentOf(await readMesh(bytes, name));
  else if (bytes[0] === 0x67 && bytes[1] === 0x6c && bytes[2] === 0x54 && bytes[3] === 0x46)
    document = await readGlb(bytes, name);
  else if (ending === 'gltf' || bytes[0] === 0x7b) document = await readGltf(bytes, name);
  else
    throw new ModelError(
      `${name} is not a glb, gltf, vrm, fbx, dae, stl, obj, off or ply file.`,
      'Export it as glb: every modelling program can.',
    );
  const body = bodyOf(document, name);
  // what names nodes and pictures by number is not understood here: the file itself is kept, to be written with another shape
  if (ending === 'vrm') body.vrm = bytes;
  return body;
}

/** A file of another program becomes glTF. */
async function readForeign(bytes, name, ending) {
  let loaders = null;
  try {
    loaders = await import(new URL('loaders/loaders.js', document.baseURI).href);
  } catch {
    throw new ModelError(`What reads ${name} could not be loaded.`, 'Open it when the network is there, or export it as glb.');
  }
  const read = await translated(async () => {
    try {
      return await loaders.readForeign(bytes, ending);
    } catch (error) {
      // a loader that stumbles over what is not there says so in words of JavaScript
      throw error instanceof TypeError || error instanceof RangeError ? new Error(`it is not what a ${ending} file should be`) : error;
    }
  }, name);
  const body = bodyOf(await readGlb(read.bytes, name), name);
  body.notes.push(...read.notes);
  return body;
}

async function readGlb(bytes, name) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length < 20 || view.getUint32(8, true) > bytes.length)
    throw new ModelError(
      `${name} is cut off: it says ${bytes.length < 12 ? 'nothing of its length' : `${view.getUint32(8, true)} bytes`} and has ${bytes.length}.`,
      'Copy or download it again.',
    );
  if (view.getUint32(4, true) !== 2)
    throw new ModelError(`${name} is glTF version ${view.getUint32(4, true)}.`, 'Export it as glTF 2.0.');
  const json = new TextDecoder().decode(bytes.subarray(20, 20 + view.getUint32(12, true)));
  const decoders = await decodersFor(json, name);
  return translated(async () => plain(await io(decoders).readBinary(bytes)), name);
}

async function readGltf(bytes, name) {
  const text = new TextDecoder().decode(bytes);
  const decoders = await decodersFor(text, name);
  return translated(async () => {
    const json = JSON.parse(text);
    const outside = [...(json.buffers ?? []), ...(json.images ?? [])].find(
      ({ uri }) => uri && !uri.startsWith('data:'),
    );
    if (outside)
      throw new ModelError(
        `${name} needs the file ${outside.uri}, which a page cannot read.`,
        'Export it as one glb file.',
      );
    return plain(await io(decoders).readJSON({ json, resources: {} }));
  }, name);
}

/** What decodes the compressions that a file uses. */
async function decodersFor(text, name) {
  let used = [];
  try {
    used = (JSON.parse(text).extensionsUsed ?? []).filter((extension) => COMPRESSIONS.includes(extension));
  } catch {
    throw new ModelError(`${name} holds no readable JSON.`, 'Copy or download it again.');
  }
  if (!used.length) return {};
  try {
    return await (await import('./compressed.js')).decoders(used.includes(KHRDracoMeshCompression.EXTENSION_NAME));
  } catch {
    throw new ModelError(
      `${name} is compressed (${used[0]}), and what reads it could not be loaded.`,
      'Open it when the network is there, or export it without compression.',
    );
  }
}

/** The document without compression: it is written plain. */
function plain(document) {
  for (const extension of document.getRoot().listExtensionsUsed())
    if (COMPRESSIONS.includes(extension.extensionName)) extension.dispose();
  return document;
}

async function translated(read, name) {
  try {
    return await read();
  } catch (error) {
    if (error instanceof ModelError) throw error;
    throw new ModelError(
      `${name} cannot be read: ${error.message}`,
      'Export it again as glb, or take one of the samples.',
    );
  }
}

/** A document around one mesh of a text format. */
function documentOf({ positions, triangles }) {
  const document = new Document();
  const buffer = document.createBuffer();
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const material = document
    .createMaterial('clay')
    .setBaseColorFactor([0.72, 0.7, 0.66, 1])
    .setRoughnessFactor(0.8)
    .setMetallicFactor(0);
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', accessor('VEC3', positions))
    .setIndices(accessor('SCALAR', triangles))
    .setMaterial(material);
  const node = document.createNode('mesh').setMesh(document.createMesh('mesh').addPrimitive(primitive));
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  return document;
}

function bodyOf(document, name) {
  const root = document.getRoot();
  const scene = root.getDefaultScene() ?? root.listScenes()[0];
  if (!scene) throw new ModelError(`${name} holds no scene.`, 'Export it with the objects you want to pose.');
  const parts = [];
  const notes = [];
  let [vertexCount, cornerCount] = [0, 0];
  scene.traverse((node) => {
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const place = primitive.getAttribute('POSITION');
      if (!place?.getCount()) continue;
      if (primitive.getMode() !== 4) {
        notes.push('lines, points and strips are kept but not shown');
        continue;
      }
      if (primitive.listTargets().length) notes.push('morph targets stay in the file and are not played');
      const corners = primitive.getIndices()?.getCount() ?? place.getCount();
      const skinned = node.getSkin() && primitive.getAttribute('JOINTS_0') && primitive.getAttribute('WEIGHTS_0');
      parts.push({
        node,
        primitive,
        skin: skinned ? node.getSkin() : null,
        first: vertexCount,
        count: place.getCount(),
        firstCorner: cornerCount,
        cornerCount: corners - (corners % 3),
      });
      vertexCount += place.getCount();
      cornerCount += corners - (corners % 3);
    }
  });
  if (!cornerCount)
    throw new ModelError(
      `${name} holds no triangles.`,
      'Export a mesh: a skeleton or a camera alone has nothing to pose.',
    );
  if (vertexCount > VERTEX_LIMIT)
    throw new ModelError(
      `${name} has ${vertexCount.toLocaleString('en')} vertices; the studio takes ${VERTEX_LIMIT.toLocaleString('en')}.`,
      'Make it coarser first.',
    );
  const body = { document, scene, name, parts, notes: [...new Set(notes)], vertexCount, clips: root.listAnimations() };
  body.triangles = new Uint32Array(cornerCount);
  for (const part of parts) readCorners(part, body.triangles, name);
  body.positions = new Float32Array(3 * vertexCount);
  body.fileNormals = parts.every(({ primitive }) => primitive.getAttribute('NORMAL'))
    ? new Float32Array(3 * vertexCount)
    : null;
  for (const part of parts) part.matrices = readPart(part, body);
  const bad = body.positions.findIndex((x) => !Number.isFinite(x));
  if (bad >= 0)
    throw new ModelError(
      `Vertex ${Math.floor(bad / 3)} of ${name} has a place that is not a number.`,
      'Repair the mesh where it was made, and export it again.',
    );
  return body;
}

function readCorners(part, triangles, name) {
  const indices = part.primitive.getIndices()?.getArray();
  for (let i = 0; i < part.cornerCount; ++i) {
    const v = indices ? indices[i] : i;
    if (v >= part.count)
      throw new ModelError(
        `A triangle of ${name} names vertex ${v}; there are ${part.count}.`,
        'Export it again: the file contradicts itself.',
      );
    triangles[part.firstCorner + i] = part.first + v;
  }
}

/** Writes the places of a part in the frame of the scene. Returns the matrix of each vertex (skins) or of all (16 numbers). */
function readPart(part, { positions, fileNormals }) {
  const places = part.primitive.getAttribute('POSITION');
  const normals = part.primitive.getAttribute('NORMAL');
  const matrices = part.skin ? skinMatrices(part) : Float64Array.from(part.node.getWorldMatrix());
  const plain = places.getArray();
  if (
    !part.skin &&
    !fileNormals &&
    plain instanceof Float32Array &&
    matrices.every((x, k) => x === Number(k % 5 === 0))
  ) {
    positions.set(plain, 3 * part.first); // a scan: nothing to work out
    return matrices;
  }
  const element = [0, 0, 0];
  for (let v = 0; v < part.count; ++v) {
    const m = part.skin ? 16 * v : 0;
    places.getElement(v, element);
    const at = 3 * (part.first + v);
    for (let k = 0; k < 3; ++k)
      positions[at + k] =
        matrices[m + k] * element[0] +
        matrices[m + 4 + k] * element[1] +
        matrices[m + 8 + k] * element[2] +
        matrices[m + 12 + k];
    if (!fileNormals) continue;
    normals.getElement(v, element);
    for (let k = 0; k < 3; ++k)
      fileNormals[at + k] =
        matrices[m + k] * element[0] + matrices[m + 4 + k] * element[1] + matrices[m + 8 + k] * element[2];
  }
  return matrices;
}

/** joint world matrix times inverse bind matrix, for each joint. worlds: node -> Matrix4, or the rest. */
export function jointMatrices(skin, worldOf = (node) => new Matrix4().fromArray(node.getWorldMatrix())) {
  const binds = skin.getInverseBindMatrices();
  const element = new Array(16);
  return skin.listJoints().map((joint, j) => {
    const world = worldOf(joint).clone();
    return binds ? world.multiply(new Matrix4().fromArray(binds.getElement(j, element))) : world;
  });
}

function skinMatrices(part) {
  return blendMatrices(part, jointMatrices(part.skin), new Float64Array(16 * part.count));
}

/** The matrix of every vertex: the sum of its joints' matrices by weight. */
export function blendMatrices(part, joints, out) {
  out.fill(0);
  const influences = influencesOf(part);
  for (let v = 0; v < part.count; ++v)
    for (let i = 0; i < influences.size; ++i) {
      const weight = influences.weights[v * influences.size + i];
      const matrix = weight && joints[influences.joints[v * influences.size + i]];
      if (matrix) for (let k = 0; k < 16; ++k) out[16 * v + k] += weight * matrix.elements[k];
    }
  return out;
}

/** Joints and weights of a part's vertices: weights of sum 1. */
export function influencesOf(part) {
  if (part.influences) return part.influences;
  const sets = [0, 1, 2, 3]
    .map((set) => [part.primitive.getAttribute(`JOINTS_${set}`), part.primitive.getAttribute(`WEIGHTS_${set}`)])
    .filter(([a, b]) => a && b);
  const size = 4 * sets.length;
  const [joints, weights] = [new Uint16Array(size * part.count), new Float32Array(size * part.count)];
  const element = [0, 0, 0, 0];
  for (let v = 0; v < part.count; ++v) {
    let sum = 0;
    sets.forEach(([joint, weight], set) => {
      joint.getElement(v, element).forEach((j, k) => (joints[v * size + 4 * set + k] = j));
      weight.getElement(v, element).forEach((w, k) => (sum += weights[v * size + 4 * set + k] = w));
    });
    if (!(sum > 0)) weights[v * size] = sum = 1;
    for (let k = 0; k < size; ++k) weights[v * size + k] /= sum;
  }
  return (part.influences = { size, joints, weights });
}

/** The bones of the file: every joint that moves vertices, with its place at rest. */
export function bonesOf(body) {
  const joints = [...new Set(body.parts.flatMap(({ skin }) => skin?.listJoints() ?? []))];
  const place = new Vector3();
  const heads = joints.flatMap((joint) =>
    place.setFromMatrixPosition(new Matrix4().fromArray(joint.getWorldMatrix())).toArray(),
  );
  const parents = joints.map((joint) => {
    let above = joint.getParentNode();
    while (above && !joints.includes(above)) above = above.getParentNode();
    return above ? joints.indexOf(above) : 0xffffffff;
  });
  return { joints, heads, parents, names: joints.map((joint, i) => joint.getName() || `bone ${i}`) };
}

/**
 * The skeleton of the file for the library: names, parents and rests of its joints, and the joints that move each vertex.
 * A part that has no skin follows the joint it hangs on. null: the file has no skin.
 */
export function skeletonOf(body) {
  const { joints, parents, names } = bonesOf(body);
  if (!joints.length) return null;
  const number = new Map(joints.map((joint, i) => [joint, i]));
  const worlds = joints.map((joint) => new Matrix4().fromArray(joint.getWorldMatrix()));
  const [place, turn, scale] = [new Vector3(), new Quaternion(), new Vector3()];
  const rest = worlds.flatMap((world, i) => {
    const above = worlds[parents[i]]?.clone().invert() ?? new Matrix4();
    above.multiply(world).decompose(place, turn, scale);
    return [...place.toArray(), ...turn.toArray(), ...scale.toArray()];
  });
  const size = Math.max(4, ...body.parts.map((part) => (part.skin ? influencesOf(part).size : 0)));
  const [moving, weights] = [new Uint16Array(size * body.vertexCount), new Float32Array(size * body.vertexCount)];
  for (const part of body.parts) {
    let above = part.node;
    while (above && !number.has(above)) above = above.getParentNode();
    const skin = part.skin?.listJoints().map((joint) => number.get(joint));
    const own = skin && influencesOf(part);
    for (let v = 0; v < part.count; ++v) {
      const at = size * (part.first + v);
      for (let i = 0; own && i < own.size; ++i) {
        moving[at + i] = skin[own.joints[v * own.size + i]] ?? 0;
        weights[at + i] = own.weights[v * own.size + i];
      }
      if (!own && above) [moving[at], weights[at]] = [number.get(above), 1];
    }
  }
  return { names: names.map((name) => name.replace(/\n/g, ' ')), parents, rest: Float32Array.from(rest), moving, weights };
}
