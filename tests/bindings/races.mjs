// races.mjs native|wasm: objects made, used, closed and dropped while the collector runs. Native: threads of
// node share handles by number, so that one closes what another uses. Only the library's own errors may come out.
// 4,000 calls, 100,000 with HF_FULL_TESTS.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { Worker, isMainThread, workerData } from 'node:worker_threads';
import { loadBackend } from './backend.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const THREADS = 3;
const SLOTS = 16;
const mesh = JSON.parse(readFileSync(join(here, '../../bindings/golden/meshes/bar.json'), 'utf8'));
const positions = Float64Array.from(mesh.positions);
const triangles = Uint32Array.from(mesh.triangles);
const n = positions.length / 3;

async function race(kind, calls, seed, shared) {
  const { api: hf, backend } = await loadBackend(kind);
  const { Struct, written } = await import(pathToFileURL(join(here, '../../bindings/js/src/marshal.js')));
  const handles = kind === 'native' ? new BigUint64Array(shared) : null;
  const draw = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  const pick = (count) => Math.floor(draw() * count);
  const slots = new Array(SLOTS).fill(null);
  const surfaces = [new hf.Surface(positions, triangles), new hf.Surface(positions, triangles)];
  const refused = {};
  const field = Float64Array.from(positions.filter((_, i) => i % 3 === 1));
  const make = () => {
    const surface = surfaces[pick(2)];
    const chosen = pick(7);
    if (chosen === 0) surfaces[pick(2)] = new hf.Surface(positions, triangles);
    const Kind = [hf.Solver, hf.Solver, hf.Pose, hf.Geodesics, hf.Region, hf.Direction, hf.Flow][chosen];
    const thing = new Kind(surface);
    if (Kind === hf.Pose) thing.addHandles([[0, 1, 2], [n - 2, n - 1]]);
    return thing;
  };
  const use = (thing) => {
    const actions =
      thing instanceof hf.Solver
        ? [
            () => thing.addSites([pick(n)], [1]),
            () => thing.solve(),
            () => thing.removeSites([0]),
            () => thing.clone().solve(),
            () => thing.record(),
            () => thing.undo(),
            () => thing.sites(),
          ]
        : [
            () =>
              thing.deform
                ? thing.deform()
                : thing.findPath
                  ? thing.solve([0])
                  : thing.edit
                    ? thing.edit({ addVertices: [pick(n)] })
                    : thing.addSites
                      ? thing.addSites([0], [1, 0, 0])
                      : thing.trace(field, { wantedCount: 2 }),
          ];
    actions[pick(actions.length)]();
  };
  // a handle of another thread, by its number; all meshes are the same, so the field fits whatever it names
  const useForeign = () => {
    const handle = Atomics.load(handles, pick(handles.length));
    const out = new Float64Array(n);
    const view = new Struct(backend.width, 'hf_array_out', { data: written(out), count: n, type: hf.constants.HF_TYPE_DOUBLE });
    const verb = pick(3);
    const code = verb
      ? backend.call('hf_solver_solve', [handle, view, null])
      : backend.call('hf_solver_destroy', [handle]);
    if (code) refused[`foreign ${code}`] = (refused[`foreign ${code}`] ?? 0) + 1;
    assert.notEqual(code, hf.constants.HF_ERROR_INTERNAL);
  };
  for (let i = 0; i < calls; ++i) {
    const at = pick(SLOTS);
    const action = draw();
    try {
      if (!slots[at] || action < 0.1) {
        slots[at] = make(); // what stood there is left to the collector
        if (handles) Atomics.store(handles, pick(handles.length), slots[at]._handle);
      } else if (action < 0.2) slots[at].close();
      else if (handles && action < 0.5) useForeign();
      else use(slots[at]);
    } catch (error) {
      if (!(error instanceof hf.HfError) || error.codeName === 'HF_ERROR_INTERNAL') throw error;
      refused[error.codeName] = (refused[error.codeName] ?? 0) + 1;
    }
    if (i % 500 === 0) {
      global.gc();
      await new Promise((resolve) => setTimeout(resolve)); // finalisers run between turns
    }
  }
  console.log(`${kind}: ${calls} calls; refused: ${JSON.stringify(refused)}`);
  assert.ok(refused.HF_ERROR_INVALID_OBJECT > 0);
}

if (!isMainThread) {
  await race('native', workerData.calls, workerData.seed, workerData.shared);
} else {
  const kind = process.argv[2];
  const calls = process.env.HF_FULL_TESTS ? 100000 : 4000;
  if (kind === 'wasm') {
    await race('wasm', calls, 11, null);
  } else {
    await loadBackend(kind); // skips where koffi is not
    const shared = new SharedArrayBuffer(8 * 8);
    const workers = Array.from(
      { length: THREADS },
      (_, i) =>
        new Worker(fileURLToPath(import.meta.url), {
          workerData: { calls: Math.ceil(calls / THREADS), seed: 7 + i, shared },
        }),
    );
    await Promise.all(
      workers.map(
        (worker) =>
          new Promise((resolve, reject) => {
            worker.on('error', reject);
            worker.on('exit', (code) => (code ? reject(new Error(`a thread ended with ${code}`)) : resolve()));
          }),
      ),
    );
  }
}
