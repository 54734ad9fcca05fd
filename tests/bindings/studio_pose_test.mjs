// The pose of the studio (samples/studio/src/worker_pose.js) in node, with the native library: free and given rotations,
// and how much follows a handle.
// HF_LIBRARY: the shared library; HF_NODE_MODULES: where koffi is.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { loadBackend } from './backend.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const { poseOf } = await import(pathToFileURL(join(root, 'samples/studio/src/worker_pose.js')));
const { api: hf } = await loadBackend('native');
const { positions, triangles } = JSON.parse(readFileSync(join(root, 'bindings/golden/meshes/bar.json'), 'utf8'));
const surface = new hf.Surface(Float32Array.from(positions), triangles);
const box = surface.report.boundingBoxDiagonal;
const body = { hf, surface, positions: Float32Array.from(positions) };

// two ends of the bar
const middle = (count, from) =>
  [0, 1, 2].map((k) => Array.from({ length: count }, (_, i) => positions[3 * (from + i) + k]).reduce((a, b) => a + b) / count);
const along = [0, 1, 2]
  .map((k) => {
    const of = positions.filter((_, i) => i % 3 === k);
    return { k, low: Math.min(...of), high: Math.max(...of) };
  })
  .sort((a, b) => b.high - b.low - (a.high - a.low))[0];
const ends = [along.low, along.high].map((at) => {
  const place = [0, 1, 2].map((k) => (k === along.k ? at : middle(positions.length / 3, 0)[k]));
  return { position: place, radius: 0.2 * (along.high - along.low), translation: [0, 0, 0], rotation: [0, 0, 0, 1] };
});
const side = (along.k + 1) % 3;
const step = (amount) => [0, 1, 2].map((k) => (k === side ? amount * box : k === along.k ? -0.3 * amount * box : 0));
const far = (a, b) => a.reduce((most, x, i) => Math.max(most, Math.abs(x - b[i])), 0) / box;
const turnedBy = (pose) => 2 * Math.acos(Math.min(1, Math.abs(pose.told().handles[1].rotation[3])));

const pose = poseOf(body);
const [foot, hand] = ends.map((end, i) => ({ ...end, id: `h${i}` }));
const dragged = (amount, more = {}) => [foot, { ...hand, free: true, translation: step(amount), ...more }];
// the first drag: every frame follows, then the drag comes to rest
let last = pose.deform([foot, hand], 'exact');
for (let i = 1; i <= 20; ++i) {
  const shown = pose.deform(dragged(0.01 * i), 'follow');
  assert.ok(far(shown, last) < 0.03, `frame ${i} jumps by ${far(shown, last)} of the box`);
  last = shown;
}
const rest = pose.deform(dragged(0.2), 'rest');
const found = turnedBy(pose);
assert.ok(found > 0.1, `the pose turned the handle by ${found}`);
const exact = poseOf(body);
assert.ok(far(exact.deform(dragged(0.2), 'exact'), rest) < 1e-5, 'the same handles from the start give the same body');
assert.ok(far(exact.deform(dragged(0.2, { free: false }), 'exact'), rest) > 0.01, 'with a given rotation it is another');
exact.close();
// a ring gives the rotation from where the handle stands
const rotation = Array.from(pose.told().handles[1].rotation);
const given = pose.deform(dragged(0.2, { free: false, rotation }), 'rest');
assert.ok(far(given, rest) < 1e-5, `a rotation that is given as it stands moves the body by ${far(given, rest)}`);
const half = Math.sin(0.2);
const ring = [0, 0, 0, Math.cos(0.2)];
ring[(along.k + 2) % 3] = half;
const times = ([a, b, c, d], [x, y, z, w]) => [
  d * x + a * w + b * z - c * y,
  d * y - a * z + b * w + c * x,
  d * z + a * y - b * x + c * w,
  d * w - a * x - b * y - c * z,
];
const turned = { free: false, rotation: times(ring, rotation) };
last = pose.deform(dragged(0.2, turned), 'rest');
assert.ok(far(last, given) > 0.01, 'the ring turns');
// a drag frees it again; the body goes on from where it stands
for (let i = 0; i <= 20; ++i) {
  const shown = pose.deform(dragged(0.2 + 0.005 * i), 'follow');
  assert.ok(far(shown, last) < 0.03, `frame ${i} of the second drag jumps by ${far(shown, last)} of the box`);
  last = shown;
}
// the dial: what does not belong to the limb of the hand stays nearer to rest, and the handles alone decide
const mean = (shown) => shown.reduce((sum, x, i) => sum + Math.abs(x - positions[i]), 0) / shown.length / box;
const dial = (following, limb = false) => dragged(0.2, { following, limb });
const [all, part] = [1, 0.25].map((following) => pose.deform(dial(following), 'rest'));
assert.ok(mean(part) < 0.8 * mean(all), `with .25 the body goes ${mean(part)} of the box, with 1 ${mean(all)}`);
assert.ok(far(pose.deform(dragged(0.2), 'rest'), all) < 1e-5, 'a handle without a dial, as in an old session, has all');
// a handle that is grabbed stands: its dial counts from its first move on. A link and a session keep it as text
const third = { id: 'h2', radius: 0.3 * ends[0].radius, following: 0.25 };
third.position = ends[0].position.map((x, k) => (x + ends[1].position[k]) / 2);
const before = pose.deform(dial(1), 'rest');
const grabbed = { ...third, ...JSON.parse(JSON.stringify(pose.grab(dial(1), [third])))[0] };
const [x, y, z] = grabbed.translation;
const stood = pose.deform([...dial(1), grabbed], 'rest');
assert.ok(far(stood, before) < 1e-3, `a grabbed handle moves the body by ${far(stood, before)}`);
const moved = [1, 0.25].map((following) => pose.deform([...dial(1), { ...grabbed, following, translation: [x, y + 1e-6, z] }], 'rest'));
assert.ok(far(...moved) > 1e-4, 'moved, it has its dial');
pose.deform(dial(0.25, true), 'rest');
const kept = pose.deform(dial(0.25, true), 'exact');
assert.ok(far(kept, part) > 1e-4, 'a limb that keeps its lengths is another');
const fresh = poseOf(body);
assert.ok(far(fresh.deform(dial(0.25, true), 'exact'), kept) < 1e-9, 'the same dial from the start gives the same body');
fresh.close();
assert.throws(() => pose.deform(dial(2), 'rest'), /following/);
assert.ok(far(pose.deform(dial(0.25, true), 'exact'), kept) < 1e-9, 'a refused dial changes nothing');
pose.close();
surface.close();
console.log(`studio pose: the drag turned the handle by ${((found * 180) / Math.PI).toFixed(0)} degrees`);
