// The JavaScript package in node: js_test.mjs native | wasm. Golden scenes, bad input, lifetime, memory.
// HF_LIBRARY: the shared library (native); HF_WASM: folder of hf.mjs and hf.wasm (wasm); HF_NODE_MODULES: where koffi
// is.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { loadBackend } from './backend.mjs';
import { run } from './golden.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const golden = join(here, '../../bindings/golden');
const js = join(here, '../../bindings/js/src');
const json = (path) => JSON.parse(readFileSync(path, 'utf8'));
const kind = process.argv[2];
const { api: hf } = await loadBackend(kind);
const meshes = Object.fromEntries(
  readdirSync(join(golden, 'meshes')).map((name) => [name.replace('.json', ''), json(join(golden, 'meshes', name))]),
);

// ---- scenes
const scenes = [
  ...json(process.env.HF_SCENES ?? join(golden, 'scenes.json')).scenes,
  ...json(join(golden, 'bad_input.json')).scenes,
];
const failures = run(hf, meshes, scenes);
assert.deepEqual(failures, []);
const wrongCalls = scenes.flatMap((scene) => scene.steps).filter((step) => step.error).length;
console.log(`${hf.backend}: ${scenes.length} scenes agree, ${wrongCalls} wrong calls answered`);
assert.ok(wrongCalls >= 100);

// ---- the README names every class, and no class or method that is not there
const readme = readFileSync(join(js, '../README.md'), 'utf8');
const isClass = (name) => typeof hf[name] === 'function';
/** An object and what it inherits from: statics of a class are inherited too. */
const chainOf = (thing) =>
  [null, Object.prototype, Function.prototype].includes(thing) ? [] : [thing, ...chainOf(Object.getPrototypeOf(thing))];
const members = (name) =>
  new Set([hf[name], hf[name].prototype].flatMap(chainOf).flatMap((thing) => Object.getOwnPropertyNames(thing)));
const code = [...readme.matchAll(/`([^`\n]+)`/g)].map(([, text]) => text);
const named = new Set(code.flatMap((text) => text.match(/\b[A-Z][a-z]\w*\b/g) ?? []));
assert.deepEqual(Object.keys(hf).filter((name) => isClass(name) && !named.has(name)), [], 'classes that the README lacks');
const owners = Object.keys(hf).filter(isClass);
for (const text of code)
  for (const [, owner, member] of text.matchAll(/\b([A-Za-z]+)\.(\w+)/g)) {
    const name = owners.find((one) => one.toLowerCase() === owner.toLowerCase());
    if (name) assert.ok(members(name).has(member), `the README names ${owner}.${member}`);
  }

// ---- wrong arguments
const { positions, triangles } = meshes.torus;
const n = positions.length / 3;
const surface = new hf.Surface(Float32Array.from(positions), triangles);
const solver = new hf.Solver(surface);
const pose = new hf.Pose(surface);
solver.addSites([0], [1]);
const wrong = [
  () => new hf.Surface('text', triangles),
  () => new hf.Surface([1, 2], triangles),
  () => new hf.Surface(positions, 'text'),
  () => new hf.Surface(positions, [0.5, 1, 2]),
  () => new hf.Surface(positions, [-1, 1, 2]),
  () => new hf.Surface(positions, [0, 1]),
  () => new hf.Surface(undefined, triangles),
  () => new hf.Surface(positions, triangles, { threads: 2 }),
  () => new hf.Surface(positions, triangles, { threadCount: 'many' }),
  () => new hf.Surface(positions, triangles, { savedFactor: 'x' }),
  () => new hf.Surface(positions, triangles, { savedFactor: new Uint8Array(7) }),
  () => solver.solve(new Float32Array(3)),
  () => solver.solve([]),
  () => solver.solve(new Int32Array(n)),
  () => solver.addSites([1], ['x']),
  () => solver.addSites(1, [1]),
  () => solver.addSites([1], [1, 2]),
  () => solver.addSites([Number.MAX_VALUE], [1]),
  () => solver.addSites(['a'], [1]),
  () => new hf.Pose(null),
  () => new hf.Pose(3),
  () => new hf.Pose(new hf.Progress()),
  () => new hf.Pose(solver),
  () => new hf.Solver(solver),
  () => new hf.Solver(surface, { operatorKind: 0 }),
  () => new hf.Transfer(surface, {}),
  () => new hf.Transfer(solver, solver),
  () => new hf.Geodesics(undefined),
  () => new hf.Direction(surface, { degree: 3 }),
  () => new hf.Pose(surface, { mode: 8 }),
  () => pose.deform(),
  () => pose.addHandles([[0]], { layer: -1 }),
  () => pose.addHandles([[0]], { inPlace: 2 }),
  () => pose.addHandles([[0]], { inPlace: 'yes' }),
  () => surface.castRay([0, 0], [0, 0, 1]),
  () => surface.findVertex('x'),
];
for (const [i, call] of wrong.entries()) assert.throws(call, hf.HfError, `case ${i}`);

// ---- faces: a quad by offsets and by sizes; a hit in it is a site
const square = new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]);
for (const rest of [{ starts: [0, 4] }, { sizes: [4] }, { starts: [0], sizes: [4] }]) {
  const quad = new hf.Surface(square, null, { faces: { corners: [0, 1, 2, 3], ...rest } });
  assert.equal(quad.meshStatistics.polygonCount, 1);
  const hit = quad.castRay([0.3, 0.6, 1], [0, 0, -1]);
  assert.equal(hit.triangle, 0);
  const held = new hf.Solver(quad);
  held.addSites(null, [2], { places: [hit] });
  assert.ok(held.solve().every((value) => Math.abs(value - 2) < 1e-6));
}
assert.throws(() => new hf.Surface(square, null, { faces: { corners: [0, 1, 2, 3] } }), hf.HfError);

// ---- fields of a desc that an array already answers are no options: they would read or write beyond it
const posed = new hf.Pose(surface);
posed.addHandleAt([0, 0, 0], 1);
for (const option of ['positionStride', 'normalStride'])
  assert.throws(() => posed.deform(null, { [option]: 400 }), /no option/, option);
for (const option of ['positionStride', 'triangleStride', 'vertexCount', 'triangleCount'])
  assert.throws(() => new hf.Surface(positions, triangles, { [option]: 400 }), /no option/, option);
for (const option of ['guideCount', 'irregularCount'])
  assert.throws(() => new hf.Quads(surface, { [option]: 2 }), /no option/);
assert.ok(Math.abs(solver.solve()[5] - 1) < 1e-6);

// ---- numbers that a DataView or the call would wrap, and arrays that are none
const region = new hf.Region(surface);
const makers = {
  threadCount: (o) => new hf.Surface(positions, triangles, o),
  siteLimit: (o) => new hf.Solver(surface, o),
  bandCount: (o) => new hf.Pose(surface, o),
  clusterCount: (o) => new hf.Transfer(surface, surface, o),
  relaxCount: (o) => new hf.Quads(surface, o),
  sourceCount: (o) => surface.findExtremities(o),
};
const slips = [2 ** 32, 2 ** 32 + 1, -1, 1.5, NaN, Infinity, true, '1', null, 1n, [1], {}];
for (const [option, maker] of Object.entries(makers))
  for (const slip of slips)
    assert.throws(() => maker({ [option]: slip }), (e) => e instanceof hf.HfError && e.message.includes(option));
for (const slip of [2 ** 32, 2 ** 31, -(2 ** 31) - 1, 0.5, NaN, '0'])
  assert.throws(() => new hf.Surface(positions, triangles, { weld: slip }), /option 'weld'/);
for (const slip of [NaN, Infinity, 1e300, -1, true, '1'])
  assert.throws(() => new hf.Surface(positions, triangles, { weld: 2, weldTolerance: slip }), hf.HfError);
for (const slip of [2 ** 32, -1, 1.5, NaN, '1', true, 1n])
  for (const call of [
    () => surface.spaceLevels(solver.solve(), slip),
    () => surface.spaceLevels(solver.solve(), 3, slip === true ? 9 : slip),
    () => surface.save(slip === true ? 9 : slip),
    () => solver.addSite(slip),
    () => solver.solvePreview(undefined, { correctionCount: slip }),
    () => pose.addHandleAt([0, 0, 0], slip === 1.5 ? '1' : slip === 2 ** 32 ? NaN : slip),
  ])
    assert.throws(call, hf.HfError, String(slip));
pose.addHandleAt([0, 0, 0], 1e4);
pose.deform(null, { restart: true, refine: false }); // flags are booleans
const bytes = new DataView(new ArrayBuffer(24));
for (const wrongArray of [bytes, new BigInt64Array(3), new BigUint64Array(3), [1n, 2n, 3n], [0, , 1], new Set([0, 1, 2])]) {
  assert.throws(() => new hf.Surface(wrongArray, triangles), /positions/);
  assert.throws(() => new hf.Surface(positions, wrongArray), /triangles/);
  assert.throws(() => solver.addSites([5, 6, 7], wrongArray), /values/);
}
for (const wrongOut of [bytes, new BigInt64Array(n), new Float32Array(n + 1)])
  assert.throws(() => solver.solve(wrongOut), /out/);

// ---- a list of vertices is edited on a mesh of more: its length is not the surface's vertexCount
if (surface.edit) {
  const edited = surface.edit({ vertices: [3, 4, 5], stiffness: [1e4, 1e4, 1e4] });
  assert.deepEqual([...edited.stiffness()].flatMap((s, v) => (s === 1 ? [] : [v])), [3, 4, 5]);
  assert.ok(edited.edit({ vertices: [2, 3, 4, 5], stiffness: [1, 1, 1, 1] }).stiffness().every((s) => s === 1));
  const moved = new hf.Solver(edited);
  moved.addSites([0, 150], [0, 1]);
  assert.equal(moved.solve().length, n);
  assert.throws(() => surface.edit({ vertices: [3, 4], stiffness: [2] }), /stiffness/);
  const link = { vertex: 3, corners: [90, 91, 92], barycentrics: [0.5, 0.25, 0.25], weight: 2 };
  const linked = surface.edit({ links: [link] });
  assert.deepEqual(linked.links().map((l) => [l.vertex, ...l.corners, l.weight]), [[3, 90, 91, 92, 2]]);
  moved.moveTo(linked);
  assert.ok(moved.solve().some((u, v) => u !== 0 && v > 0));
  assert.equal(linked.edit({ removedLinks: [0] }).links().length, 0);
  assert.throws(() => linked.edit({ removedLinks: [1] }), /the surface has 1 links/);
}

// ---- objects are cloned or refuse to be copied, sent and written, by name
region.edit({ addVertices: [0, 1, 2, 12, 13, 14] });
for (const thing of [
  surface,
  solver,
  pose,
  region,
  new hf.Transfer(surface, surface),
  new hf.Geodesics(surface),
  new hf.Direction(surface),
  new hf.Detail(region, region.clone()),
  new hf.Flow(surface),
  new hf.Quads(surface),
  new hf.Weights(surface, { heads: [0, 0, 0], tails: [1, 0, 0] }),
  new hf.Progress(),
]) {
  const name = thing.constructor.name;
  for (const copy of [
    () => structuredClone(thing),
    () => structuredClone({ deep: [thing] }),
    () => ({ ...thing }),
    () => Object.assign({}, thing),
    () => JSON.stringify(thing),
    () => JSON.stringify([thing]),
    () => new MessageChannel().port1.postMessage(thing),
  ])
    assert.throws(copy, (e) => e instanceof hf.HfError && e.message.includes(`a ${name} cannot be`), name);
  if (thing.clone) assert.notEqual(thing.clone()._handle, thing._handle);
}
assert.deepEqual([...solver.clone().solve()], [...solver.solve()]);

// ---- the caller's arrays, also views into larger buffers
const buffer = new Float32Array(n + 10);
const view = buffer.subarray(5, 5 + n);
assert.equal(solver.solve(view), view);
assert.ok(Math.abs(view[n - 1] - 1) < 1e-6 && buffer[4] === 0 && buffer[5 + n] === 0);

// ---- closing and collecting in any order
let seed = 1;
const draw = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
let calls = 0;
for (let round = 0; round < 120; ++round) {
  const own = new hf.Surface(Float64Array.from(meshes.bar.positions), meshes.bar.triangles);
  const field = new hf.Solver(own);
  const things = [
    own,
    field,
    new hf.Pose(own),
    new hf.Transfer(own, own),
    new hf.Geodesics(own),
    new hf.Progress(),
    field.clone(),
  ];
  things[2].addHandles([
    [0, 1, 2],
    [280, 281],
  ]);
  things.push(things[2].clone());
  things.sort(() => draw() - 0.5);
  for (const thing of things) {
    if (draw() < 0.6) {
      thing.close();
      thing.close();
      assert.throws(
        () =>
          thing.castRay
            ? thing.report
            : thing.addSites
              ? thing.solve()
              : thing.deform
                ? thing.deform()
                : thing.findPath
                  ? thing.solve([0])
                  : thing.apply
                    ? thing.info
                    : thing.fraction,
        (error) => error.codeName === 'HF_ERROR_INVALID_OBJECT',
      );
      ++calls;
    } else if (thing.deform) {
      assert.equal(thing.deform().length, meshes.bar.positions.length);
    } // the others are left to the garbage collector
  }
  if (global.gc && round % 20 === 0) {
    global.gc();
    await new Promise((resolve) => setTimeout(resolve));
  }
}
assert.ok(calls > 100);

// ---- memory comes back
const work = async (count) => {
  for (let i = 0; i < count; ++i) {
    const own = new hf.Surface(Float32Array.from(positions), triangles);
    const pose = new hf.Pose(own);
    pose.addHandles([
      [0, 1],
      [140, 141],
    ]);
    pose.deform();
    if (i % 2) own.close(); // the rest by the garbage collector
    if (i % 10 === 0 && global.gc) {
      global.gc();
      await new Promise((resolve) => setTimeout(resolve));
    }
  }
  global.gc?.();
  await new Promise((resolve) => setTimeout(resolve, 20));
};
if (global.gc) {
  await work(50);
  const before = process.memoryUsage().rss;
  await work(200);
  const grown = process.memoryUsage().rss - before;
  console.log(`memory after 200 more surfaces and poses: ${(grown / 1e6).toFixed(1)} MB`);
  assert.ok(grown < 30e6, 'memory does not come back'); // 200 of them hold more than 100 MB
}

// ---- what the last call told, links and weights: two boxes apart, one of them without a site or handle
{
  const box = (x) => Array.from({ length: 8 }, (_, i) => [x + (i & 1), (i >> 1) & 1, (i >> 2) & 1]).flat();
  const faces = [0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5];
  const places = Float32Array.from([...box(0), ...box(1.2)]);
  const triangles = Uint32Array.from([...faces, ...faces.map((v) => v + 8)]);
  const apart = new hf.Surface(places, triangles);
  const solver = new hf.Solver(apart);
  solver.addSite(0, 1);
  solver.solve();
  assert.deepEqual([solver.solveInfo.unreachedVertexCount, solver.solveInfo.unreachedComponentCount], [8, 1]);
  solver.solvePreview();
  assert.equal(solver.previewInfo.unreachedComponentCount, 1);
  const along = new hf.Direction(apart);
  along.addSites([0], [[0, 1, 1]]);
  along.solve();
  assert.equal(along.solveInfo.unreachedVertexCount, 8);
  const pose = new hf.Pose(apart);
  pose.addHandleAt([0, 0, 0], 0.1);
  pose.deform();
  assert.equal(pose.deformInfo.unreachedVertexCount, 8);
  pose.deform(null, { normals: new Float32Array(48) });
  assert.equal(pose.deformInfo.unreachedVertexCount, 8);

  const linked = new hf.Surface(places, triangles, { linkPieces: { distance: 0.5 } });
  assert.equal(linked.report.componentCount, 1);
  assert.deepEqual(new Set(linked.pieces().pieces), new Set([0, 1]));
  const opened = Float32Array.from(places, (x, i) => x + (i >= 24 && i % 3 === 2 ? 3 : 0));
  linked.measureGaps(Float32Array.from(places));
  assert.equal(linked.gapsInfo.worst, 0);
  assert.equal(linked.measureGaps(opened).length, linked.linksInfo.linkCount);
  const gaps = linked.gapsInfo;
  assert.ok(gaps.worst > 1 && gaps.worst <= 3 && gaps.linkCount === linked.linksInfo.linkCount, `${gaps.worst}`);
  assert.throws(() => linked.measureGaps([0, 0, 0]), /positions must hold 48/);
  const tags = Uint32Array.from({ length: 16 }, (_, v) => Number(v > 7));
  const strangers = new hf.Surface(places, triangles, { linkPieces: { distance: 0.5 }, tags });
  assert.equal(strangers.report.componentCount, 2);
  assert.throws(() => new hf.Surface(places, triangles, { linkPieces: true, tags: [1] }), /tags must hold 16 numbers/);

  const joints = { heads: [0.2, 0.5, 0.5, 1.4, 0.5, 0.5], tails: [0.8, 0.5, 0.5, 2, 0.5, 0.5] };
  const weights = new hf.Weights(apart, joints);
  const found = weights.get();
  assert.deepEqual([found.influenceCount, found.joints[0], found.joints[4 * 15]], [4, 0, 1]);
  for (let v = 0; v < 16; ++v) assert.ok(Math.abs(1 - found.weights.subarray(4 * v, 4 * v + 4).reduce((a, b) => a + b)) < 1e-6);
  assert.deepEqual([weights.info.jointCount, Array.from(weights.joints().flags)], [2, [0, 0]]);
  weights.record();
  weights.setPins([0], { joints: [1], weights: [1] });
  assert.deepEqual([weights.get().joints[0], weights.info.pinCount], [1, 1]);
  weights.undo();
  assert.equal(weights.get().joints[0], 0);
  weights.setLocks([0]);
  assert.equal(weights.info.lockCount, 1);
  const copy = weights.clone();
  copy.setJoints({ heads: [0, 0, 0], tails: [1, 0, 0], sources: [0] });
  assert.deepEqual([copy.info.jointCount, weights.info.jointCount], [1, 2]);
  assert.throws(() => new hf.Weights(apart, { heads: [0, 0] }), /heads must hold 3 numbers for each/);
  assert.throws(() => weights.setPins([0], { joints: [0, 1], weights: [1] }), /weights must hold 2 numbers/);
  console.log(`${hf.backend}: reports of calls, links and weights`);
}
