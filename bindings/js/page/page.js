// Pick sites and handles on a glb, see the harmonic field in strips, drag handles: all on the factor made at the start.
// ?model=URL chooses the glb. Nothing here knows the library but through hf-fields' public API.
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { load } from '../src/web.js';

const status = document.getElementById('status');
const params = new URLSearchParams(location.search);
const figures = {
  vertices: 0,
  sites: 0,
  handles: 0,
  createMs: 0,
  editMs: 0,
  solveMs: 0,
  deformMs: 0,
  frames: 0,
  message: '',
};

/** All meshes of a glb in one list of positions and triangles, centred, two units high at most. */
async function readModel(url) {
  const gltf = await new GLTFLoader().loadAsync(url);
  gltf.scene.updateMatrixWorld(true);
  const positions = [];
  const triangles = [];
  const point = new THREE.Vector3();
  gltf.scene.traverse((node) => {
    if (!node.isMesh) return;
    const first = positions.length / 3;
    const place = node.geometry.getAttribute('position');
    for (let v = 0; v < place.count; ++v) {
      point.fromBufferAttribute(place, v);
      if (node.isSkinnedMesh) node.applyBoneTransform(v, point);
      point.applyMatrix4(node.matrixWorld);
      positions.push(point.x, point.y, point.z);
    }
    const index = node.geometry.index;
    for (let i = 0; i < (index ? index.count : place.count); ++i) triangles.push(first + (index ? index.getX(i) : i));
  });
  const box = new THREE.Box3().setFromArray(positions);
  const centre = box.getCenter(new THREE.Vector3());
  const scale = 2 / box.getSize(new THREE.Vector3()).length();
  return {
    positions: Float32Array.from(positions, (x, i) => (x - centre.getComponent(i % 3)) * scale),
    triangles: Uint32Array.from(triangles),
  };
}

const strips = new THREE.ShaderMaterial({
  side: THREE.DoubleSide,
  vertexShader: `attribute float field; varying float vField; varying vec3 vNormal;
    void main() { vField = field; vNormal = normalMatrix * normal; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
  fragmentShader: `uniform float shown; varying float vField; varying vec3 vNormal;
    void main() {
      float light = 0.35 + 0.65 * abs(normalize(vNormal).z);
      vec3 warm = mix(vec3(0.16, 0.36, 0.72), vec3(0.93, 0.55, 0.18), clamp(vField, 0.0, 1.0));
      float t = fract(vField * 12.0 - 0.001);
      vec3 strip = t < 0.5 ? warm : mix(warm, vec3(1.0), 0.6);
      gl_FragColor = vec4(light * mix(vec3(0.75), strip, shown), 1.0);
    }`,
  uniforms: { shown: { value: 0 } },
});

const hf = await load({
  factory: (await import(params.get('glue') ?? '../dist/hf.mjs')).default,
  wasmBinary: await (await fetch(params.get('wasm') ?? '../dist/hf.wasm')).arrayBuffer(),
});
const rest = await readModel(params.get('model') ?? 'model.glb');
let begin = performance.now();
const surface = new hf.Surface(rest.positions, rest.triangles);
const solver = new hf.Solver(surface);
const pose = new hf.Pose(surface);
figures.createMs = performance.now() - begin;
figures.vertices = solver.vertexCount;

const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setSize(innerWidth, innerHeight);
document.body.prepend(renderer.domElement);
const scene = new THREE.Scene();
scene.background = new THREE.Color(0x23262b);
const camera = new THREE.PerspectiveCamera(40, innerWidth / innerHeight, 0.01, 50);
camera.position.set(2.2, 0.8, 1.8);
const controls = new OrbitControls(camera, renderer.domElement);
controls.target.set(0, 0, 0);
controls.update();

const geometry = new THREE.BufferGeometry();
const positions = rest.positions.slice();
const normals = new Float32Array(positions.length);
const field = new Float32Array(solver.vertexCount);
geometry.setIndex(new THREE.BufferAttribute(rest.triangles, 1));
geometry.setAttribute('position', new THREE.BufferAttribute(positions, 3));
geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
geometry.setAttribute('field', new THREE.BufferAttribute(field, 1));
geometry.computeVertexNormals();
const mesh = new THREE.Mesh(geometry, strips);
mesh.frustumCulled = false;
scene.add(mesh);

const sites = []; // { number, vertex, ball }
const handles = []; // { number, centroid, move, ball }
const ball = (colour, size) =>
  new THREE.Mesh(
    new THREE.SphereGeometry(size, 20, 12),
    new THREE.MeshBasicMaterial({ color: colour, depthTest: false }),
  );

function show(error) {
  figures.sites = sites.length;
  figures.handles = handles.length;
  figures.message = error ? error.message : '';
  status.textContent =
    `${figures.vertices} vertices, factor ${figures.createMs.toFixed(0)} ms (once)\n${sites.length} sites: edit ${figures.editMs.toFixed(1)} ms, field ${figures.solveMs.toFixed(1)} ms\n` +
    `${handles.length} handles: pose ${figures.deformMs.toFixed(1)} ms${error ? '\n' + error.message : ''}`;
}

function guarded(action) {
  try {
    action();
    show();
  } catch (error) {
    if (!(error instanceof hf.HfError)) throw error;
    show(error); // the library's own sentence; nothing has changed
  }
}

function refreshField() {
  strips.uniforms.shown.value = sites.length ? 1 : 0;
  if (!sites.length) return;
  begin = performance.now();
  solver.solve(field);
  figures.solveMs = performance.now() - begin;
  geometry.attributes.field.needsUpdate = true;
  for (const site of sites) site.ball.position.fromArray(positions, 3 * site.vertex);
}

function refreshPose() {
  if (!handles.length) {
    positions.set(rest.positions);
    geometry.attributes.position.needsUpdate = true;
    geometry.computeVertexNormals();
    return;
  }
  begin = performance.now();
  pose.deform(positions, { normals });
  figures.deformMs = performance.now() - begin;
  ++figures.frames;
  geometry.attributes.position.needsUpdate = true;
  geometry.attributes.normal.needsUpdate = true;
  geometry.boundingSphere = null;
  for (const site of sites) site.ball.position.fromArray(positions, 3 * site.vertex);
}

function addSite(vertex, value) {
  begin = performance.now();
  const number = solver.addSite(vertex, value);
  figures.editMs = performance.now() - begin;
  const site = { number, vertex, ball: ball(value ? 0xffd060 : 0x4060ff, 0.018) };
  sites.push(site);
  scene.add(site.ball);
  refreshField();
}

function addHandle(vertex) {
  const at = Array.from(rest.positions.subarray(3 * vertex, 3 * vertex + 3));
  const number = pose.addHandleAt(at, Number(document.getElementById('radius').value));
  const handle = {
    number,
    centroid: new THREE.Vector3().fromArray(pose.handleInfo(number).centroid),
    move: new THREE.Vector3(),
    ball: ball(0xff4040, 0.03),
  };
  handles.push(handle);
  scene.add(handle.ball);
  handle.ball.position.copy(handle.centroid);
  refreshPose();
}

function moveHandle(handle, place) {
  handle.move.copy(place).sub(handle.centroid);
  handle.ball.position.copy(place);
  pose.setTransform(handle.number, { translation: handle.move.toArray() });
  refreshPose();
}

// ---- picking
const caster = new THREE.Raycaster();
const pointer = new THREE.Vector2();
function cast(event) {
  pointer.set((event.clientX / innerWidth) * 2 - 1, 1 - (event.clientY / innerHeight) * 2);
  caster.setFromCamera(pointer, camera);
}
function vertexUnder(event) {
  cast(event);
  const { origin, direction } = caster.ray;
  const hit = surface.castRay(origin.toArray(), direction.toArray(), { positions });
  return hit && hit.vertex;
}

let mode = 'high';
function setMode(next) {
  mode = next;
  controls.enabled = mode === 'orbit';
  document
    .querySelectorAll('[data-mode]')
    .forEach((button) => button.classList.toggle('on', button.dataset.mode === mode));
}
document
  .querySelectorAll('[data-mode]')
  .forEach((button) => button.addEventListener('click', () => setMode(button.dataset.mode)));
setMode('high');

let dragged = null;
const plane = new THREE.Plane();
renderer.domElement.addEventListener('pointerdown', (event) => {
  if (mode === 'drag') {
    cast(event);
    const [hit] = caster.intersectObjects(handles.map((handle) => handle.ball));
    dragged = hit ? handles.find((handle) => handle.ball === hit.object) : null;
    if (dragged)
      plane.setFromNormalAndCoplanarPoint(camera.getWorldDirection(new THREE.Vector3()), dragged.ball.position);
  } else if (mode !== 'orbit') {
    const vertex = vertexUnder(event);
    if (vertex !== null)
      guarded(() => (mode === 'handle' ? addHandle(vertex) : addSite(vertex, mode === 'high' ? 1 : 0)));
  }
});
let wanted = null; // the last place asked for; one pose per picture, however fast the pointer moves
renderer.domElement.addEventListener('pointermove', (event) => {
  if (!dragged) return;
  cast(event);
  wanted = caster.ray.intersectPlane(plane, new THREE.Vector3());
});
addEventListener('pointerup', () => {
  if (dragged && wanted) guarded(() => moveHandle(dragged, wanted));
  dragged = wanted = null;
});
document.getElementById('undo').addEventListener('click', () =>
  guarded(() => {
    const site = sites.pop();
    if (!site) return;
    solver.removeSites([site.number]);
    scene.remove(site.ball);
    refreshField();
  }),
);
document.getElementById('remove').addEventListener('click', () =>
  guarded(() => {
    const handle = handles.pop();
    if (!handle) return;
    pose.removeHandles([handle.number]);
    scene.remove(handle.ball);
    refreshPose();
  }),
);
document
  .getElementById('reset')
  .addEventListener('click', () => guarded(() => handles.forEach((handle) => moveHandle(handle, handle.centroid))));
addEventListener('resize', () => {
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  renderer.setSize(innerWidth, innerHeight);
});

renderer.setAnimationLoop(() => {
  if (dragged && wanted) {
    const place = wanted;
    wanted = null;
    guarded(() => moveHandle(dragged, place));
  }
  renderer.render(scene, camera);
});
show();

// for tests and the curious: figures, and where a vertex or a handle is on the screen
const onScreen = (place) => {
  const p = place.clone().project(camera);
  return { x: ((p.x + 1) / 2) * innerWidth, y: ((1 - p.y) / 2) * innerHeight };
};
window.hfPage = {
  hf,
  figures,
  surface,
  solver,
  pose,
  field,
  positions,
  rest,
  sites,
  handles,
  vertexOnScreen: (v) => onScreen(new THREE.Vector3().fromArray(positions, 3 * v)),
  vertexAt: (x, y) => vertexUnder({ clientX: x, clientY: y }),
  handleOnScreen: (i) => onScreen(handles[i].ball.position),
};
