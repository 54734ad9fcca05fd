// Posed vertices of a glTF as three.js plays it: node read_three.mjs NODE_MODULES FILE.glb TIMES OUT.json
// OUT: {"frames": [[x, y, z, ...] per time]}, meshes in the order of the file's nodes.
import { readFileSync, writeFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';
import { join } from 'node:path';

const [modules, file, times, out] = process.argv.slice(2);
globalThis.self = globalThis;
globalThis.ProgressEvent = class {};
const from = (path) => import(pathToFileURL(join(modules, 'three', path)).href);
// the package's own names lead to node_modules beside this file; its files are named by path instead
const { register } = await import('node:module');
register('data:text/javascript,' + encodeURIComponent(
  `export function resolve(name, context, next) {
     return name === 'three' ? { url: ${JSON.stringify(pathToFileURL(join(modules, 'three/build/three.module.js')).href)}, shortCircuit: true } : next(name, context); }`), import.meta.url);
const THREE = await from('build/three.module.js');
const { GLTFLoader } = await from('examples/jsm/loaders/GLTFLoader.js');

const bytes = readFileSync(file);
// pictures cannot be decoded here and do not move vertices
const loader = new GLTFLoader();
loader.register((parser) => { parser.loadTexture = () => Promise.resolve(new THREE.Texture()); return { name: 'no_pictures' }; });
const gltf = await loader.parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), '');
const mixer = new THREE.AnimationMixer(gltf.scene);
const action = mixer.clipAction(gltf.animations[0]);
action.setLoop(THREE.LoopOnce);
action.clampWhenFinished = true;
action.play();
const frames = [];
for (const time of times.split(',').map(Number)) {
  mixer.setTime(time);
  gltf.scene.updateMatrixWorld(true);
  const positions = [];
  const p = new THREE.Vector3();
  gltf.scene.traverse((node) => {
    if (!node.isMesh) return;
    for (let v = 0; v < node.geometry.attributes.position.count; ++v) {
      node.getVertexPosition(v, p);
      p.applyMatrix4(node.matrixWorld);
      positions.push(p.x, p.y, p.z);
    }
  });
  frames.push(positions);
}
writeFileSync(out, JSON.stringify({ frames }));
