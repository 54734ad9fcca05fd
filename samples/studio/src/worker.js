// The Worker that owns every object of hf. A request says which list of handles or sites is wanted; the worker changes its
// objects until they hold that list. The main thread sends the newest list only, so a slow answer never queues.
import createHf from 'hf-glue';
import { apiOf } from '../../../bindings/js/src/wasm.js';
import { readMesh } from './mesh_files.js';
import { normalGroups, normalSums, smoothNormals } from './normals.js';
import { proposalsOf, sentenceOf, surfaceOf } from './worker_open.js';
import { poseOf } from './worker_pose.js';
import { stiffnessOf } from './worker_stiffness.js';
import { fieldOf } from './worker_field.js';
import { awayOf, detailOf } from './worker_detail.js';
import { inTwo } from './worker_parts.js';
import { prepare, warm } from './worker_warm.js';
import { weightsOf, quadsOf } from './worker_once.js';

/** Larger bodies take the build with threads where the page is isolated: smaller ones do not wait for it. */
const THREADED_VERTICES = 30000;
/** More threads than these gain little, and each is a Worker. */
const MOST_THREADS = 4;

const built = {}; // 'plain' and 'threads': the library, once loaded; 'rest' loads what the plain one lacks at first
const memory = []; // bytes of the heap of each
let body = null;

/** The library from a function that makes its module from the bytes of hf.wasm. */
function make(create, wasmBinary) {
  const factory = async (options) => {
    const module = await create(options);
    memory.push(() => (module.wasmMemory ?? module.HEAPU8).buffer.byteLength);
    return module;
  };
  return apiOf(factory, wasmBinary);
}
async function makePlain() {
  const parts = await inTwo(self.location);
  Object.assign(built, { rest: parts.rest, missed: parts.missed });
  return make(() => parts.make(createHf));
}
/** The build without threads. What could not be loaded is tried again by the next body. */
function plain() {
  built.plain ??= makePlain().catch((error) => {
    built.plain = null;
    throw error;
  });
  return built.plain;
}
/** What the build without threads lacks at first. */
const rest = () => (body?.hf && body.hf === built.threads ? null : built.rest?.());

/** The library for a body, and the threads that a surface of it may take. */
async function ready(vertexCount) {
  const threadCount = Math.min(MOST_THREADS, navigator.hardwareConcurrency ?? 1);
  if (HF_THREADS && self.crossOriginIsolated && threadCount > 1 && vertexCount > THREADED_VERTICES) {
    try {
      const at = (name) => new URL(`threads/${name}`, self.location);
      const { default: create } = await import(at('hf.js').href);
      built.threads ??= await make(create, await (await fetch(at('hf.wasm'))).arrayBuffer());
      return [built.threads, { threadCount }];
    } catch {
      // not there, or no room: one thread does the same
    }
  }
  return [await plain(), {}];
}

const tasks = {
  /** Places and triangles of a file that holds one mesh and nothing else. */
  async read({ bytes, name }) {
    const mesh = await readMesh(bytes, name);
    return [mesh, [mesh.positions.buffer, mesh.triangles.buffer]];
  },
  /** Opens a body: factorises once. Answers with what the page can offer at once. */
  async open({ positions, triangles, fileNormals, skeleton }) {
    const [hf, threads] = await ready(positions.length / 3);
    const begin = performance.now();
    const notes = [];
    const surface = surfaceOf(hf, { positions, triangles, skeleton }, threads, notes);
    const sums = normalSums(triangles, normalGroups(positions, fileNormals));
    const next = { hf, threads, surface, positions, triangles, sums, normals: new Float32Array(positions.length) };
    const { proposals, regions } = proposalsOf(hf, surface, { positions, triangles, skeleton }, notes);
    closeBody();
    body = Object.assign(next, { proposals, regions });
    body.stiffness = stiffnessOf(body);
    body.pose = poseOf(body);
    body.field = fieldOf(body);
    body.detail = detailOf(body);
    smoothNormals(positions, sums, body.normals);
    const report = surface.report;
    const [linksInfo, components] = [surface.linksInfo, surface.components()];
    const answer = { proposals, report, linksInfo, notes, normals: body.normals.slice(), components };
    answer.openMs = performance.now() - begin;
    return [answer, [answer.normals.buffer, answer.components.buffer]];
  },
  /** The tree for picking, made here so that the page never stops for it: of the body, or of given arrays. */
  tree({ positions = body.positions, triangles = body.triangles }) {
    return treeOf(positions, triangles);
  },
  /** Positions and normals of the body under handles and detail. */
  shape({ handles, detail, way, lengths, stiffness }) {
    const begin = performance.now();
    body.stiffness.hold(stiffness, way === 'exact');
    const positions = body.pose.deform(handles, way, lengths);
    const told = body.pose.told();
    told.detail = detail ? body.detail.apply(positions, detail) : null;
    const normals = new Float32Array(positions.length);
    smoothNormals(positions, body.sums, normals);
    if (detail) {
      told.detail.away = awayOf(told.detail, positions, normals);
      delete told.detail.before;
    }
    told.milliseconds = performance.now() - begin;
    return [{ positions, normals, told }, [positions.buffer, normals.buffer]];
  },
  /** Where handles stand that are added in mid-pose. */
  grab({ handles, added, lengths }) {
    return [body.pose.grab(handles, added, lengths), []];
  },
  /** Another body whose detail can be taken, and the tree for picking on it. */
  detailSource({ name, positions, triangles }) {
    body.detail.addSource(name, positions, triangles);
    return treeOf(positions, triangles);
  },
  field({ sites, at, stiffness }) {
    const begin = performance.now();
    body.stiffness.hold(stiffness, at);
    const { values, reached, told } = body.field.solve(sites, at);
    told.milliseconds = performance.now() - begin;
    return [{ values, reached, told }, [values.buffer, ...(reached ? [reached.buffer] : [])]];
  },
  /** A stroke of the brush that moves nothing yet. */
  stiffen({ stiffness }) {
    body.stiffness.hold(stiffness);
    return [null, []];
  },
  /** What the brush walks on. */
  net() {
    const net = body.stiffness.net(body.triangles);
    return [net, Object.values(net).map(({ buffer }) => buffer)];
  },
  extremities() {
    return [body.surface.findExtremities().map(({ vertex, position }) => ({ vertex, position })), []];
  },
  weights({ bones, influenceCount, pins }) {
    return [weightsOf(body, bones, influenceCount, pins), []];
  },
  skin({ handles, way = 'exact' }) {
    body.pose.deform(handles, way);
    return [body.pose.skin(), []];
  },
  factor() {
    const bytes = body.surface.save();
    return [bytes, [bytes.buffer]];
  },
  /** Quads run in a Worker of their own (client.js): it opens the same body from the saved factor. */
  async quadsOpen({ positions, triangles, skeleton, factor }) {
    const [hf, threads] = await ready(positions.length / 3);
    await built.rest?.();
    body = { hf, surface: surfaceOf(hf, { positions, triangles, skeleton }, { savedFactor: factor, ...threads }) };
    return [null, []];
  },
  quads(options) {
    return [quadsOf(body, options), []];
  },
  async transferOpen({ positions, triangles, glb }) {
    const { transferOf } = await import('./worker_transfer.js');
    body.sourcePositions = positions;
    body.sourceTriangles = triangles;
    body.transfer?.close();
    const { hf, threads } = body;
    body.transfer = transferOf(body, new hf.Surface(positions, triangles, { linkPieces: true, ...threads }));
    return [await body.transfer.proposals(glb), []];
  },
  transferPairs({ pairs }) {
    return [body.transfer.setPairs(pairs), []];
  },
  transferDials({ dials }) {
    body.transfer.setDials(dials);
    return [null, []];
  },
  transferFrame({ positions }) {
    const begin = performance.now();
    const posed = body.transfer.apply(positions);
    const normals = new Float32Array(posed.length);
    smoothNormals(posed, body.sums, normals);
    const milliseconds = performance.now() - begin;
    body.surface.measureGaps(posed);
    const gap = body.surface.gapsInfo.worst / body.surface.report.boundingBoxDiagonal;
    return [{ positions: posed, normals, milliseconds, gap }, [posed.buffer, normals.buffer]];
  },
  transferSkin({ positions }) {
    body.transfer.apply(positions);
    return [body.transfer.skin(), []];
  },
  sourceTree() {
    return treeOf(body.sourcePositions, body.sourceTriangles);
  },
  /** What a pull and a tool will need: code that is compiled well, and the rest of the library. Nothing waits for it. */
  rest({ handles }) {
    rest()?.catch(() => {}); // the tool that needs it says so
    const mine = body;
    // another body may be opened meanwhile
    const myTurn = async () => {
      await turn();
      if (body !== mine) throw new Error('closed');
    };
    warm(body.hf, turn)
      .then(() => prepare(mine, handles ?? [], myTurn))
      .catch(() => {}); // closed, or no room: the first pull is slower, and no more
    return [null, []];
  },
  memory() {
    const heap = memory.reduce((sum, bytes) => sum + bytes(), 0);
    const held = body?.surface.statistics.memoryBytes ?? 0;
    return [{ held, heap, threads: body?.threads.threadCount ?? 1, missed: built.missed }, []];
  },
};

/** The tree for picking. three.js comes with it, which the first picture needs nothing of in a Worker. */
async function treeOf(positions, triangles) {
  const { buildBvh } = await import('./bvh.js');
  const { answer, buffers } = buildBvh(positions, triangles);
  return [answer, buffers];
}

function closeBody() {
  if (!body) return;
  for (const part of [body.transfer, body.pose, body.field, body.detail, body.stiffness, body.surface]) part?.close();
  body = null;
}

/** Work that nobody asked for starts when the page has asked for nothing for so long: longer than between two frames. */
const QUIET_MS = 60;
let asked = 0;
async function turn() {
  do await new Promise((done) => setTimeout(done, asked + QUIET_MS - performance.now()));
  while (performance.now() - asked < QUIET_MS);
}

/** What the first file of the library does; all other tasks wait for the rest of it. */
const early = new Set(['read', 'open', 'tree', 'shape', 'grab', 'field', 'extremities', 'memory', 'rest', 'quadsOpen', 'stiffen', 'net']);

// Requests are answered in the order they came, also where one of them waits.
let last = Promise.resolve();
self.onmessage = ({ data: { id, task, args } }) => {
  if (task === 'begin') return void plain().catch(() => {}); // the first body says what is wrong
  last = last.then(async () => {
    asked = performance.now();
    try {
      if (!early.has(task) || args?.detail || args?.lengths || args?.stiffness || args?.handles?.some(({ limb }) => limb)) await rest();
      const [answer, buffers] = await tasks[task](args ?? {});
      self.postMessage({ id, answer }, buffers);
      asked = performance.now();
    } catch (error) {
      const { codeName = null, index = null, advice } = error;
      self.postMessage({ id, error: { message: sentenceOf(error), codeName, index, advice } });
    }
  });
};
