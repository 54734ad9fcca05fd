// Files of other programs by three.js's own loaders: FBX and DAE become glTF by three.js's exporter, STL becomes one mesh.
// A bundle of its own (build.mjs), with its own three.js: it comes when such a file is opened.
import { BufferAttribute, BufferGeometry, LoadingManager, MeshStandardMaterial, PropertyBinding, SkinnedMesh, Mesh } from 'three';
import { GLTFExporter } from 'three/examples/jsm/exporters/GLTFExporter.js';
import { ColladaLoader } from 'three/examples/jsm/loaders/ColladaLoader.js';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { STLLoader } from 'three/examples/jsm/loaders/STLLoader.js';

/** What stands in for a picture that lies beside the file. */
const PIXEL = 'data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP4z8DwHwAFAAH/iZk9HQAAAABJRU5ErkJggg==';
const KEPT = ['position', 'normal', 'uv', 'uv1', 'color', 'skinIndex', 'skinWeight'];
const MOVED = ['position', 'quaternion', 'scale'];

const bufferOf = (bytes) => bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);

/** Corners that are the same in all numbers become one vertex: { first, corners }, the first corner of each vertex. */
function welded(lists, count) {
  // -0 and 0 are one place with two patterns of bits: a sum with 0 has one
  const bitsOf = (array) => new Uint32Array(Float32Array.from(array, (x) => x + 0).buffer);
  const words = lists.map(({ array, size }) => ({ bits: bitsOf(array), size }));
  const same = (a, b) =>
    words.every(({ bits, size }) => {
      for (let k = 0; k < size; ++k) if (bits[size * a + k] !== bits[size * b + k]) return false;
      return true;
    });
  const mask = 2 ** Math.ceil(Math.log2(2 * count + 2)) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  const first = [];
  const corners = new Uint32Array(count);
  for (let i = 0; i < count; ++i) {
    let hash = 17;
    for (const { bits, size } of words) for (let k = 0; k < size; ++k) hash = Math.imul(hash ^ bits[size * i + k], 0x9e3779b1);
    let at = (hash ^ (hash >>> 15)) & mask;
    while (table[at] >= 0 && !same(first[table[at]], i)) at = (at + 1) & mask;
    if (table[at] < 0) table[at] = first.push(i) - 1;
    corners[i] = table[at];
  }
  return { first, corners };
}

/** The corners of one group of a geometry without index, as a geometry with one. */
function pieceOf(geometry, { start, count }) {
  const lists = KEPT.filter((name) => geometry.hasAttribute(name)).map((name) => {
    const { array, itemSize: size, normalized } = geometry.getAttribute(name);
    return { name, size, normalized, array: array.subarray(size * start, size * (start + count)) };
  });
  const { first, corners } = welded(lists, count);
  const piece = new BufferGeometry().setIndex(new BufferAttribute(corners, 1));
  for (const { name, size, normalized, array } of lists) {
    const out = new array.constructor(size * first.length);
    first.forEach((from, v) => out.set(array.subarray(size * from, size * (from + 1)), size * v));
    piece.setAttribute(name, new BufferAttribute(out, size, normalized));
  }
  return piece;
}

/** Meshes of one material each, with an index, without morph targets. */
function plainMeshes(scene, notes) {
  const meshes = [];
  const materials = new Map();
  scene.traverse((thing) => thing.isMesh && meshes.push(thing));
  const standard = (given) => {
    if (!materials.has(given)) {
      const { name, color, emissive, side, opacity, transparent, alphaTest, vertexColors } = given;
      const map = given.map?.image && given.map.image.src !== PIXEL ? given.map : null;
      const made = new MeshStandardMaterial({ name, map, side, opacity, transparent, alphaTest, vertexColors, roughness: 0.8, metalness: 0 });
      if (color) made.color.copy(color);
      if (emissive) made.emissive.copy(emissive);
      materials.set(given, made);
    }
    return materials.get(given);
  };
  for (const mesh of meshes) {
    if (mesh.morphTargetInfluences?.length) notes.add('morph targets are left out');
    mesh.morphTargetInfluences = mesh.morphTargetDictionary = undefined;
    const whole = mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry;
    const all = [{ start: 0, count: whole.getAttribute('position').count, materialIndex: 0 }];
    const groups = Array.isArray(mesh.material) && whole.groups.length ? whole.groups.filter(({ count }) => count > 0) : all;
    const given = [mesh.material].flat();
    groups.forEach((group, i) => {
      const geometry = pieceOf(whole, group);
      const material = standard(given[group.materialIndex] ?? given[0]);
      if (i === 0) return void Object.assign(mesh, { geometry, material });
      const piece = mesh.isSkinnedMesh ? new SkinnedMesh(geometry, material) : new Mesh(geometry, material);
      piece.name = `${mesh.name} ${i + 1}`;
      if (mesh.isSkinnedMesh) piece.bind(mesh.skeleton, mesh.bindMatrix);
      mesh.add(piece);
      return undefined;
    });
  }
}

/** Clips with the tracks that glTF can hold. */
const plainClips = (scene, clips) =>
  clips
    .map((clip) => {
      const known = ({ name }) => {
        const { nodeName, propertyName } = PropertyBinding.parseTrackName(name);
        return MOVED.includes(propertyName) && PropertyBinding.findNode(scene, nodeName);
      };
      clip.tracks = clip.tracks.filter(known);
      return clip;
    })
    .filter(({ tracks }) => tracks.length);

/** { bytes, notes }: the glb of an fbx or a dae file. Throws what the loader says. */
export async function readForeign(bytes, ending) {
  const notes = new Set();
  const manager = new LoadingManager();
  manager.setURLModifier((url) => {
    if (/^(blob|data):/.test(url)) return url;
    notes.add('pictures beside the file are not read');
    return PIXEL;
  });
  let pictures = null;
  manager.onStart = () => (pictures ??= new Promise((done) => (manager.onLoad = done)));
  const scene =
    ending === 'fbx'
      ? new FBXLoader(manager).parse(bufferOf(bytes), '')
      : new ColladaLoader(manager).parse(new TextDecoder().decode(bytes), '')?.scene;
  if (!scene) throw new Error('it is no XML of COLLADA');
  await pictures;
  scene.updateMatrixWorld(true);
  const animations = plainClips(scene, scene.animations ?? []);
  plainMeshes(scene, notes);
  const glb = await new GLTFExporter().parseAsync(scene, { binary: true, trs: true, onlyVisible: false, animations });
  return { bytes: new Uint8Array(glb), notes: [...notes] };
}

/** { positions, triangles } of an stl file: its triangles share their corners again. */
export function readStl(bytes) {
  const array = new STLLoader().parse(bufferOf(bytes)).getAttribute('position')?.array ?? [];
  const { first, corners } = welded([{ array, size: 3 }], array.length / 3);
  const positions = new Float32Array(3 * first.length);
  first.forEach((from, v) => positions.set(array.subarray(3 * from, 3 * from + 3), 3 * v));
  return { positions, triangles: corners };
}
