// Splits hf.wasm in two. hf.wasm holds what a first minute with poses and fields calls, and what that names in its code;
// rest.wasm holds all other functions. A function that is not there yet is a call to JavaScript, which loads the rest
// (src/worker_parts.js).
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { apiOf } from '../../bindings/js/src/wasm.js';
import { fieldOf } from './src/worker_field.js';
import { proposalsOf, surfaceOf } from './src/worker_open.js';
import { poseOf } from './src/worker_pose.js';

/** What the module may use, as bindings/js/wasm/CMakeLists.txt builds it. */
const features = 'simd exception-handling mutable-globals sign-ext bulk-memory nontrapping-float-to-int'
  .split(' ')
  .map((name) => `--enable-${name}`);
/** Where the profile is written in the module's memory: the surface is closed by then, so no byte there is used. */
const PROFILE_AT = 8 << 20;
const rest = { rotation: [0, 0, 0, 1], translation: [0, 0, 0] };

/**
 * What bodies of files have: tubes with a seam of double vertices, open ends and edges that are not Delaunay, two of them
 * that do not touch; with faults also an edge of three triangles and a triangle without an area.
 */
function body(faults) {
  const positions = [];
  const triangles = [];
  // every second row is shifted by half a triangle; the last column lies on the first
  const tube = (rows, columns, size, [x, y, z]) => {
    const first = positions.length / 3;
    const edge = (2 * Math.PI * 0.3) / columns;
    for (let i = 0; i < rows; ++i)
      for (let j = 0; j <= columns; ++j) {
        const along = 0.87 * edge * (i + ((i * j) % 499 === 5 ? 0.7 : 0));
        const [thick, angle] = [0.3 + 0.03 * Math.sin(3 * along), (2 * Math.PI * (j + i / 2)) / columns];
        const [up, out] = [thick * Math.cos(angle) + 0.2 * Math.sin(along), thick * Math.sin(angle)];
        positions.push(x + size * along, y + size * up, z + size * out);
      }
    for (let i = 0; i + 1 < rows; ++i)
      for (let j = 0; j < columns; ++j) {
        const [a, b] = [first + i * (columns + 1) + j, first + (i + 1) * (columns + 1) + j];
        triangles.push(a, a + 1, b, b, a + 1, b + 1);
      }
  };
  tube(80, 32, 1, [0, 0, 0]);
  tube(20, 12, 0.3, [1, 1.5, 0]);
  if (faults) {
    positions.push(2, 0, 3);
    triangles.push(1000, 1001, positions.length / 3 - 1, 500, 500, 501);
  }
  return { positions: Float32Array.from(positions), triangles: Uint32Array.from(triangles) };
}

/** Joints along the first tube, each with the vertices up to the next, and one for the second tube. */
function skeletonAlong(positions) {
  const names = ['Hips', 'Spine', 'Neck', 'Head', 'LeftHand'];
  const at = [0, 0.8, 2.4, 3.4];
  const rest = names.flatMap((_, i) => [i === 4 ? 1 : at[i] - (at[i - 1] ?? 0), i === 4 ? 1.5 : 0, 0, 0, 0, 0, 1, 1, 1, 1]);
  const moving = Uint16Array.from({ length: positions.length / 3 }, (_, v) =>
    v >= 80 * 33 ? 4 : at.findLastIndex((x) => positions[3 * v] >= x || x === 0),
  );
  const weights = Float32Array.from(moving, () => 1);
  return { names, parents: [0xffffffff, 0, 1, 2, 0], rest: Float32Array.from(rest), moving, weights };
}

function refused(act) {
  try {
    act();
  } catch {
    return;
  }
  throw new Error('nothing was refused');
}

/** What the Worker asks for before any other tool is opened. */
function firstMinute(hf, faults) {
  const { positions, triangles } = body(faults);
  const character = { positions, triangles, skeleton: skeletonAlong(positions) };
  const skinned = surfaceOf(hf, character);
  proposalsOf(hf, skinned, character);
  skinned.close();
  const surface = new hf.Surface(positions, triangles, { linkPieces: true });
  const [pose, field] = [poseOf, fieldOf].map((make) => make({ hf, surface, positions }));
  void [surface.report, surface.linksInfo, surface.components(), surface.statistics];

  const place = ({ position, radius }, id) => ({ id, position, radius, ...rest });
  let handles = surface.proposeHandles().slice(0, 3).map(place);
  // a drag frees the rotation of a tip, and little follows it
  const tip = { following: 0.25, free: true };
  const pulled = (id, x) => handles.map((handle) => (handle.id === id ? { ...handle, ...tip, translation: [x, 0.2, 0] } : handle));
  pose.deform(handles, 'exact');
  for (const x of [0.1, 0.15]) pose.deform((handles = pulled(1, x)), 'follow');
  pose.deform(handles, 'rest');
  const added = [place({ position: Array.from(positions.subarray(900, 903)), radius: 0.2 }, 'added')];
  handles = [...handles, { ...added[0], ...pose.grab(handles, added)[0] }];
  pose.deform(handles, 'follow');
  pose.deform(handles, 'exact');
  for (const x of [0.1, 0.15]) pose.deform((handles = pulled('added', x)), 'follow');
  pose.deform(handles, 'exact');
  pose.deform(handles.map((handle) => ({ ...handle, free: false, following: 1 })), 'rest');
  pose.deform(handles.slice(1), 'rest');
  // so many sites that the library factorises the rest of the body: a handle around each twelfth ring of the first tube
  const middle = (ring) =>
    [0, 1, 2].map((k) => {
      let sum = 0;
      for (let v = 33 * ring; v < 33 * ring + 32; ++v) sum += positions[3 * v + k];
      return sum / 32;
    });
  const crowd = [6, 18, 30, 42, 54, 66, 76].map((ring) => place({ position: middle(ring), radius: 0.35 }, ring));
  pose.deform(crowd, 'exact');
  pose.deform(crowd.slice(1), 'rest');
  pose.deform(crowd.slice(1, 4), 'rest');

  const site = (triangle, id, soft = false) => ({
    id,
    corners: Array.from(triangles.subarray(3 * triangle, 3 * triangle + 3)),
    barycentrics: [0.2, 0.3, 0.5],
    value: id,
    soft,
  });
  field.solve([site(0, 0), site(500, 1)], true);
  field.solve([site(0, 0), site(700, 1)], false);
  field.solve([site(0, 0), site(700, 1, true)], false);
  field.solve([site(0, 0)], false);
  surface.findExtremities();
  // what is refused is said in a sentence
  refused(() => pose.deform([...handles, { ...handles[0], id: 'twice' }], 'follow'));
  refused(() => field.solve([site(0, 0), { ...site(0, 1), barycentrics: [NaN, 0, 0] }], true));
  refused(() => new hf.Surface(positions.slice(3), triangles, { linkPieces: true }));
  refused(() => new hf.Surface(positions.map(() => NaN), triangles, {}));
  for (const part of [pose, field, surface]) part.close();
  refused(() => surface.report);
}

/** The functions of a module that some of them reach by calls that name a function. */
function reached(text, some) {
  const calls = new Map();
  let list = null;
  for (const [, name, called] of text.matchAll(/^ \(func \$(\S+)|\((?:call|ref\.func) \$([^\s)]+)/gm))
    if (name) calls.set(name, (list = []));
    else list?.push(called);
  const found = new Set(some.filter((name) => calls.has(name)));
  for (const name of found) for (const called of calls.get(name)) if (calls.has(called)) found.add(called);
  return [...found];
}

/** Writes hf.wasm and rest.wasm to the folder out. Without wasm-split of Binaryen hf.wasm stays whole. */
export async function split(folder, out) {
  const whole = join(folder, 'hf.wasm');
  const run = (tool, ...given) =>
    execFileSync(`wasm-${tool}`, [...features, ...given], { encoding: 'utf8', maxBuffer: 2 ** 30 });
  try {
    run('split', '--help');
  } catch {
    console.log('hf.wasm stays whole: wasm-split (Binaryen) is not here');
    copyFileSync(whole, join(out, 'hf.wasm'));
    return;
  }
  const work = mkdtempSync(join(tmpdir(), 'hf-split-'));
  try {
    const [counting, profile, keep] = ['counting.wasm', 'profile', 'keep'].map((name) => join(work, name));
    run('split', '--instrument', whole, '-o', counting);
    const { default: createHf } = await import(pathToFileURL(join(folder, 'hf.mjs')).href);
    const wasmBinary = readFileSync(counting);
    let made = null;
    const instantiateWasm = (imports, done) => {
      made = new WebAssembly.Instance(new WebAssembly.Module(wasmBinary), imports).exports;
      done({ exports: made });
      return made;
    };
    const hf = await apiOf(() => createHf({ instantiateWasm }));
    for (const faults of [false, true]) firstMinute(hf, faults);
    const { buffer } = Object.values(made).find((thing) => thing instanceof WebAssembly.Memory);
    const length = made.__write_profile(PROFILE_AT, buffer.byteLength - PROFILE_AT);
    writeFileSync(profile, new Uint8Array(buffer, PROFILE_AT, length));
    const parts = ['-o1', join(out, 'hf.wasm'), '-o2', join(out, 'rest.wasm')];
    const told = run('split', '--verbose', '--split', `--profile=${profile}`, whole, ...parts);
    const [, called] = /Keeping functions: (.*)/.exec(told);
    writeFileSync(keep, reached(run('dis', whole), called.split(', ')).join('\n'));
    run('split', '--split', `--keep-funcs=@${keep}`, whole, ...parts);
  } finally {
    rmSync(work, { recursive: true });
  }
}
