// An app that uses the types: `tsc --strict` takes it, and refuses each line under @ts-expect-error.
import { HfError, load } from 'hf-fields';
import type { Api, Surface, SurfaceReport } from 'hf-fields';
import wasm from 'hf-fields/hf.wasm';
import { load as loadSlim } from 'hf-fields/slim';
import { load as loadWasm } from 'hf-fields/wasm';

const hf: Api = await load();
const positions = new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0]);
const surface: Surface = new hf.Surface(positions, [[0, 1, 2]], { weld: hf.constants.HF_WELD_NONE, linkPieces: true });
const report: SurfaceReport = surface.report;
const isolated: number = report.isolatedVertexCount;
const vertexCount: number = surface.info.vertexCount;

const solver = new hf.Solver(surface, { channelCount: 1 });
const sites: Uint32Array = solver.addSites([0, 1], [0, 1]);
solver.setScreening(new Float64Array(3));
const single: Float32Array = solver.solve();
const double: Float64Array = solver.solve(new Float64Array(3));
const unreached: number = solver.solveInfo.unreachedVertexCount;

const pose = new hf.Pose(surface);
pose.record();
pose.setTransform(pose.addHandleAt([0, 0, 0], 1), { translation: [0, 0, 1] });
const posed: Float32Array = pose.deform();
const gaps: Float64Array = surface.measureGaps(posed);
const hit: number | undefined = surface.castRay([0, 0, 1], [0, 0, -1])?.vertex;
const invalid: -1 = hf.constants.HF_ERROR_INVALID_ARGUMENT;
const backend: 'native' | 'wasm' = hf.backend;

try {
  solver.removeSites(sites);
} catch (error) {
  if (error instanceof HfError) console.log(error.codeName.length, error.index ?? 0);
}

const slim = await loadSlim({ wasm });
new slim.Pose(new slim.Surface(positions, [0, 1, 2]));
await loadWasm({ wasm: new URL(wasm, import.meta.url) });

// @ts-expect-error: no such option
new hf.Surface(positions, [0, 1, 2], { threads: 2 });
// @ts-expect-error: no such constant
hf.constants.HF_WELD_NOTHING;
// @ts-expect-error: the report holds numbers
const text: string = report.isolatedVertexCount;
// @ts-expect-error: the slim build has no quads
new slim.Quads;
// @ts-expect-error: a library is a path
await load({ library: 3 });

export { backend, double, gaps, hit, invalid, isolated, single, text, unreached, vertexCount };
