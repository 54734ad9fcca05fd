// How many quads a body starts with: its thin parts need a few quads around them, or hands become spikes.

/** Bounds of the number to start with. Twice as many quads take twice as long. */
const [FEWEST, MOST] = [1500, 3000];
/** Places where the thickness is measured, equally spread over the area. */
const PLACES = 400;
/** A part is thin when so much of the area is thinner: fingers, ears, a tail. */
const THIN = 0.02;
/** Quads around a thin part. */
const AROUND = 6;
/** A ray into the body starts so far under the surface, as part of its size. */
const UNDER = 1e-4;

/** Twice the normal of a triangle as long as its area. */
function normalOf(p, triangles, t) {
  const [a, b, c] = [0, 1, 2].map((k) => 3 * triangles[3 * t + k]);
  const [u, v] = [b, c].map((corner) => [0, 1, 2].map((k) => p[corner + k] - p[a + k]));
  return [0, 1, 2].map((k) => u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
}

export function areaOf({ positions: p, triangles }) {
  let area = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [3 * triangles[i], 3 * triangles[i + 1], 3 * triangles[i + 2]];
    const [ux, uy, uz] = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
    const [vx, vy, vz] = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
    area += Math.hypot(uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx) / 2;
  }
  return area;
}

/** The thickness of the body under places spread over its area, in rising order. */
function thicknesses({ skin, view, body: { triangles } }, area, size) {
  const found = [];
  const p = skin.positions;
  const ray = view.ray(0, 0);
  let [sum, next] = [0, 0.5];
  for (let t = 0; 3 * t < triangles.length; ++t) {
    const normal = normalOf(p, triangles, t);
    const length = Math.hypot(...normal);
    sum += length / 2;
    if (!(sum > (next * area) / PLACES)) continue;
    next = Math.ceil((sum * PLACES) / area) + 0.5;
    const middle = [0, 1, 2].map((k) => (p[3 * triangles[3 * t] + k] + p[3 * triangles[3 * t + 1] + k] + p[3 * triangles[3 * t + 2] + k]) / 3);
    ray.direction.fromArray(normal).divideScalar(-length);
    ray.origin.fromArray(middle).addScaledVector(ray.direction, UNDER * size);
    const hit = skin.pick(ray);
    if (hit) found.push(hit.distance);
  }
  return found.sort((a, b) => a - b);
}

/** The number of quads to start with; the least one while nothing can be picked on the body yet. */
export function startCount(app, area) {
  if (!app.skin.bvh) return FEWEST;
  const all = thicknesses(app, area, app.opened.report.boundingBoxDiagonal);
  const thin = all[Math.floor(THIN * all.length)];
  if (!(thin > 0)) return FEWEST;
  return Math.max(FEWEST, Math.min(MOST, area / ((Math.PI * thin) / AROUND) ** 2));
}
