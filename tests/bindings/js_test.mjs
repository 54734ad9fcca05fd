// The JavaScript package in node: js_test.mjs native | wasm. Golden scenes, bad input, lifetime, memory.
// HF_LIBRARY: the shared library (native); HF_WASM: folder of hf.mjs and hf.wasm (wasm); HF_NODE_MODULES: where koffi
// is.
import assert from 'node:assert/strict';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { run } from './golden.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const golden = join(here, '../../bindings/golden');
const js = join(here, '../../bindings/js/src');
const json = (path) => JSON.parse(readFileSync(path, 'utf8'));
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};

export async function loadBackend(kind) {
  if (kind === 'native') {
    const { nativeBackend } = await import(pathToFileURL(join(js, 'native.js')));
    const { makeApi } = await import(pathToFileURL(join(js, 'objects.js')));
    let koffi;
    try {
      koffi = createRequire(join(process.env.HF_NODE_MODULES ?? here, 'x.js'))('koffi');
    } catch {
      skip('the npm package koffi is not here (HF_NODE_MODULES)');
    }
    return makeApi(nativeBackend(koffi, process.env.HF_LIBRARY));
  }
  const { load } = await import(pathToFileURL(join(js, 'web.js')));
  const folder = process.env.HF_WASM;
  try {
    statSync(join(folder, 'hf.wasm'));
  } catch {
    skip('hf.wasm was not built (Debian: emscripten)');
  }
  const bytes = readFileSync(join(folder, 'hf.wasm'));
  console.log(`hf.wasm: ${(bytes.length / 1e6).toFixed(2)} MB`);
  assert.ok(bytes.length < 2e6, 'the wasm file is to stay below 2 MB');
  return load({ factory: (await import(pathToFileURL(join(folder, 'hf.mjs')))).default, wasmBinary: bytes });
}

const kind = process.argv[2];
const hf = await loadBackend(kind);
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

// ---- layout (native): the offsets the package computes are those the C compiler pinned
if (kind === 'native') {
  const { layouts } = await import(pathToFileURL(join(js, 'raw.js')));
  const pinned = readFileSync(join(here, '../api/layout.txt'), 'utf8').split('\n');
  let struct = null;
  let checked = 0;
  for (const line of pinned) {
    const [, name, size] = line.match(/^(hf_\w+) size (\d+)/) ?? [];
    if (name) {
      struct = layouts[name];
      assert.equal(struct.size[1], Number(size), name);
    }
    const [, field, offset] = line.match(/^  (\w+) at (\d+),/) ?? [];
    if (field && struct) {
      assert.equal(struct.fields[field][1][1], Number(offset), field);
      ++checked;
    }
  }
  assert.ok(checked > 200);
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
  () => surface.castRay([0, 0], [0, 0, 1]),
  () => surface.findVertex('x'),
];
for (const [i, call] of wrong.entries()) assert.throws(call, hf.HfError, `case ${i}`);

// ---- fields of a desc that an array already answers are no options: they would read or write beyond it
const posed = new hf.Pose(surface);
posed.addHandleAt([0, 0, 0], 1);
for (const option of ['positionStride', 'normalStride', 'firstVertex', 'vertexCount'])
  assert.throws(() => posed.deform(null, { [option]: 400 }), /no option/, option);
for (const option of ['positionStride', 'triangleStride', 'vertexCount', 'triangleCount'])
  assert.throws(() => new hf.Surface(positions, triangles, { [option]: 400 }), /no option/, option);
assert.throws(() => new hf.Quads(surface, { siteCount: 2 }), /no option/);
assert.ok(Math.abs(solver.solve()[5] - 1) < 1e-6);

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
                : thing.distance
                  ? thing.distance([0])
                  : thing.apply
                    ? thing.info
                    : thing.fraction,
        (error) => error.codeName === 'HF_ERROR_INVALID_HANDLE',
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
