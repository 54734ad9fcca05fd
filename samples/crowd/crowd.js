// A crowd of creatures that share one body; each has its own pose. Workers solve the poses. A frame uploads one array of
// transforms for all creatures, and the GPU computes the vertices.
//
// ?count=N creatures (1000), ?webgl: WebGL 2 even where the browser has WebGPU, ?still: nothing moves until show(seconds).
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

// what goes wrong from here on is said on the page (index.html)
const said = document.getElementById('said');
const query = new URLSearchParams(location.search);
/** As many as fit a texture of WebGL 2 almost everywhere, a row for each. More take seconds a frame, and twice the memory for twice as many. */
const MOST = 8192;
const count = Number(query.get('count') ?? 1000);
if (!Number.isInteger(count) || count < 1 || count > MOST)
  throw new Error(`count is "${query.get('count')}"; it must be a whole number from 1 to ${MOST}.`);
/** More Workers than these leave no core to the page and the GPU's driver. */
const MOST_WORKERS = 4;
const adapter = query.has('webgl') ? null : await navigator.gpu?.requestAdapter().catch(() => null);
const { makeRenderer, makeMaterial } = await import(adapter ? './webgpu.js' : './webgl.js');

// ---- the body, as hf takes it: the first mesh of a model
const file = query.get('model') ?? 'creature.glb';
const model = await new GLTFLoader().loadAsync(file).catch((error) => {
  throw new Error(`${file} could not be read: ${error.message}`);
});
let body = null;
model.scene.traverse((object) => (body ??= object.isMesh ? object.geometry : null));
if (!body) throw new Error(`${file} holds no mesh.`);
const place = body.attributes.position;
// also of attributes that are interleaved or packed
const positions = Float32Array.from({ length: 3 * place.count }, (_, i) => place.getComponent(Math.floor(i / 3), i % 3));
if (!body.index) body.setIndex(Array.from({ length: place.count }, (_, v) => v));
const triangles = new Uint32Array(body.index.array);

// ---- Workers: each makes the surface, and poses its share of the creatures
const workers = Array.from(
  { length: Math.min(count, MOST_WORKERS, navigator.hardwareConcurrency || 1) },
  () => new Worker('worker.js', { type: 'module' }),
);
const answer = (worker, question) =>
  new Promise((done, failed) => {
    worker.onmessage = ({ data }) => (data.error ? failed(new Error(data.error)) : done(data));
    worker.onerror = (event) => failed(new Error(event.message || 'a Worker did not start'));
    worker.postMessage(question);
  });
const shareOf = (w) => Math.floor((w * count) / workers.length);
const starts = await Promise.all(
  workers.map((worker, w) =>
    answer(worker, { positions, triangles, first: shareOf(w), count: shareOf(w + 1) - shareOf(w) }),
  ),
);
const { rows, clusterCount, centre } = starts[0];

// ---- what the GPU gets once: the rows. And in every frame: transforms of all creatures, one after the other
const transforms = new Float32Array(12 * clusterCount * count);
const geometry = new THREE.InstancedBufferGeometry();
geometry.instanceCount = count;
geometry.setIndex(body.index);
geometry.setAttribute('position', new THREE.BufferAttribute(rows.positions, 3));
geometry.setAttribute('normal', new THREE.BufferAttribute(rows.normals, 3));
if (body.attributes.color) geometry.setAttribute('color', body.attributes.color);
const row = new THREE.BufferAttribute(rows.rows, 2);
row.gpuType = THREE.IntType; // the shader reads whole numbers
geometry.setAttribute('hfRow', row);

const box = new THREE.Box3().setFromArray(rows.positions);
const side = Math.ceil(Math.sqrt(count));
const step = 1.1 * Math.max(box.max.x - box.min.x, box.max.z - box.min.z);
const places = new Float32Array(3 * count);
for (let i = 0; i < count; ++i)
  places.set([((i % side) - side / 2) * step, centre[1], (Math.floor(i / side) - side / 2) * step], 3 * i);
geometry.setAttribute('hfPlace', new THREE.InstancedBufferAttribute(places, 3));

const material = await makeMaterial({ rows, transforms, clusterCount, colours: Boolean(body.attributes.color) });
const crowd = new THREE.Mesh(geometry, material.material);
crowd.frustumCulled = false; // one draw for all

// ---- the picture
const scene = new THREE.Scene().add(crowd, new THREE.HemisphereLight('#ffffff', '#6a6255', 2.2));
const sun = new THREE.DirectionalLight('#fff3dd', 2);
sun.position.set(3, 5, 2);
scene.add(sun);
const ground = new THREE.Mesh(
  new THREE.PlaneGeometry(400 * step, 400 * step),
  new THREE.MeshBasicMaterial({ color: '#b9c2b0' }),
);
ground.rotation.x = -Math.PI / 2;
scene.add(ground);
scene.background = new THREE.Color('#dfe6ec');
scene.fog = new THREE.Fog('#dfe6ec', 2 * side * step, 6 * side * step);
const renderer = await makeRenderer();
document.body.append(renderer.domElement);
const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1000);
camera.position.set(0.6, 0.32, 0.7).multiplyScalar((side + 0.7) * step);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(-0.5 * step, centre[1] / 2, -0.5 * step);
controls.update();
function resize() {
  renderer.setSize(innerWidth, innerHeight);
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
}
addEventListener('resize', resize);
resize();

/** Poses all creatures for a time. fresh: without what the last frame left, so that the same time gives the same picture. */
async function pose(seconds, fresh = false) {
  const solved = await Promise.all(workers.map((worker) => answer(worker, { seconds, fresh })));
  solved.forEach((made, w) => transforms.set(made.transforms, 12 * clusterCount * shareOf(w)));
  material.update();
  return Math.max(...solved.map((made) => made.milliseconds));
}

const name = adapter ? 'WebGPU' : 'WebGL 2';
window.hfCrowd = {
  name,
  async show(seconds) {
    await pose(seconds, true);
    renderer.render(scene, camera);
  },
};
if (query.has('still')) {
  await window.hfCrowd.show(0);
} else {
  /** Pictures of which a rate is told: a second of them on most screens. */
  const COUNTED = 60;
  let [begun, drawn, solving] = [performance.now(), 0, false];
  /** Asks for the next pose when the last one is there: a picture never waits for one. */
  const solve = async (seconds) => {
    if (solving) return;
    solving = true;
    const milliseconds = await pose(seconds);
    const rate = (1000 * drawn) / (performance.now() - begun);
    said.textContent = `${count} creatures of ${rows.vertexCount} vertices, ${name}: poses ${milliseconds.toFixed(0)} ms on ${workers.length} Workers, ${rate.toFixed(0)} pictures a second`;
    solving = false;
  };
  // the browser asks for pictures, and for none of a page that is hidden: then nothing is solved either
  const picture = (now) => {
    solve(now / 1000);
    if (++drawn % COUNTED === 0) [begun, drawn] = [performance.now(), 0];
    controls.update();
    renderer.render(scene, camera);
    requestAnimationFrame(picture);
  };
  requestAnimationFrame(picture);
}
document.body.dataset.ready = name;
