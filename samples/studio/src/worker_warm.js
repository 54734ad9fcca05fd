// A browser compiles WebAssembly fast first and well later, function by function, once they have run for a while. Poses and
// fields of a small body make it compile what the first pull needs, while the page asks for nothing.
import { normalGroups, normalSums, smoothNormals } from './normals.js';
import { fieldOf } from './worker_field.js';
import { poseOf } from './worker_pose.js';

/**
 * Rounds of poses and fields. After 10 the first pose of the horse takes 1.0 to 3.3 times a later one and the first field 3.8
 * to 6.9 times, after 20 0.9 to 1.4 and 1.2 to 1.8 (three starts each, load 6). Twenty take 0.3 to 0.4 s of a Worker there.
 */
const ROUNDS = 30;
/** Rounds on the body itself: with them first calls take up to 1.44 times later ones. Other numbers were not tried. */
const PREPARE_ROUNDS = 3;
/** Rings and corners of a ring. */
const [RINGS, CORNERS] = [40, 24];

function tube() {
  const positions = new Float32Array(3 * RINGS * CORNERS);
  const triangles = new Uint32Array(6 * (RINGS - 1) * CORNERS);
  for (let i = 0, at = 0; i < RINGS; ++i)
    for (let j = 0; j < CORNERS; ++j) {
      const angle = (2 * Math.PI * (j + i / 2)) / CORNERS;
      positions.set([0.22 * i, Math.cos(angle), Math.sin(angle)], 3 * (i * CORNERS + j));
      if (i + 1 === RINGS) continue;
      const [a, b] = [i * CORNERS + j, i * CORNERS + ((j + 1) % CORNERS)];
      triangles.set([a, b, a + CORNERS, a + CORNERS, b, b + CORNERS], at);
      at += 6;
    }
  return { positions, triangles };
}

/** Makes sites at the first corners of triangles. */
const sitesOf = (triangles) => (id, triangle) => ({
  id,
  corners: Array.from(triangles.subarray(3 * triangle, 3 * triangle + 3)),
  barycentrics: [1, 0, 0],
  value: id,
  soft: false,
});

const warmed = new Set();
/** Once for each build of the library. turn: resolves when the page asks for nothing; awaited before every call. */
export async function warm(hf, turn) {
  if (warmed.has(hf)) return;
  warmed.add(hf);
  const { positions, triangles } = tube();
  const surface = new hf.Surface(positions, triangles, { linkPieces: true });
  const [pose, field] = [poseOf, fieldOf].map((make) => make({ hf, surface, positions }));
  const sums = normalSums(triangles, normalGroups(positions, null));
  const normals = new Float32Array(positions.length);
  const ends = [0, RINGS - 1].map((ring, id) => ({
    id,
    position: [0.22 * ring, 0, 0],
    radius: 1.2,
    rotation: [0, 0, 0, 1],
    translation: [0, 0, 0],
  }));
  const site = sitesOf(triangles);
  for (let round = 0; round < ROUNDS; ++round) {
    const pulled = (x) => [ends[0], { ...ends[1], following: 0.25, free: true, translation: [0, x, 0] }];
    const calls = [
      () => pose.deform(ends.slice(0, 1), 'exact'),
      () => pose.deform(pulled(0.5), 'follow'),
      // the page's own code runs slowly at first too
      ...[0.7, 0.9].map((x) => () => smoothNormals(pose.deform(pulled(x), 'follow'), sums, normals)),
      () => pose.deform(pulled(0.9), 'rest'),
      () => field.solve([site(0, 0), site(1, 900)], true),
      () => field.solve([site(0, 0), site(1, 500 + 10 * round)], false),
    ];
    for (const call of calls) {
      await turn();
      call();
    }
  }
  for (const part of [pose, field, surface]) part.close();
}

/** A larger body would keep its first pull waiting for as long as it saves there. */
const PREPARED_VERTICES = 30000;

/**
 * Does once what the first pull and the first field of a body do, on objects of its own: code and memory of that size are
 * ready then. handles: those that the library proposes.
 */
export async function prepare({ hf, surface, positions, triangles }, handles, turn) {
  if (positions.length > 3 * PREPARED_VERTICES || !handles.length) return;
  await turn();
  const [pose, field] = [poseOf, fieldOf].map((make) => make({ hf, surface, positions }));
  const sums = normalSums(triangles, normalGroups(positions, null));
  const normals = new Float32Array(positions.length);
  const site = sitesOf(triangles);
  try {
    for (let round = 0; round < PREPARE_ROUNDS; ++round) {
      await turn();
      pose.deform(handles.slice(0, -1), 'exact');
      for (const list of [handles, handles]) smoothNormals(pose.deform(list, 'follow'), sums, normals);
      field.solve([site(0, 0), site(1, Math.floor(triangles.length / 6))], true);
    }
  } finally {
    for (const part of [pose, field]) part.close();
  }
}
