// How many quads a body starts with: its thin parts need a few quads around them, or hands become spikes.

/** Bounds of the number to start with. Twice as many quads take twice as long. */
const [FEWEST, MOST] = [1500, 3000];
/** Places where the thickness is measured, equally spread over the area: THIN of them are 8. Twice as many rays take twice as long. */
const PLACES = 400;
/** A part is thin when so much of the area is thinner: fingers, ears, a tail. Less is one ray, more is a leg. */
const THIN = 0.02;
/** Quads around a thin part: with 4 it is a spike of square section, with 12 a body has four times as many quads. */
const AROUND = 6;
/** A ray into the body starts so far under the surface, as part of its size: above single precision, far below an ear. */
const UNDER = 1e-4;

/** The normal of a triangle, as long as twice its area, and that length. */
function normalOf(p, triangles, t, out) {
  const [a, b, c] = [3 * triangles[3 * t], 3 * triangles[3 * t + 1], 3 * triangles[3 * t + 2]];
  const ux = p[b] - p[a];
  const uy = p[b + 1] - p[a + 1];
  const uz = p[b + 2] - p[a + 2];
  const vx = p[c] - p[a];
  const vy = p[c + 1] - p[a + 1];
  const vz = p[c + 2] - p[a + 2];
  out[0] = uy * vz - uz * vy;
  out[1] = uz * vx - ux * vz;
  out[2] = ux * vy - uy * vx;
  return Math.sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
}

export function areaOf({ positions, triangles }) {
  const normal = [0, 0, 0];
  let area = 0;
  for (let t = 0; 3 * t < triangles.length; ++t) area += normalOf(positions, triangles, t, normal) / 2;
  return area;
}

/** The thickness of the body under places spread over its area, in rising order. */
function thicknesses({ skin, view, body: { triangles } }, area, size) {
  const found = [];
  const p = skin.positions;
  const ray = view.ray(0, 0);
  let [sum, next] = [0, 0.5];
  const normal = [0, 0, 0];
  for (let t = 0; 3 * t < triangles.length; ++t) {
    const length = normalOf(p, triangles, t, normal);
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
