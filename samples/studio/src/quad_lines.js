// The picture of a quad mesh: lines along its edges, and faces a little behind them.

/** Lines with the faces as their child. kit: three's classes. */
export function drawQuads(kit, { faces, positions }) {
  const { BufferAttribute, BufferGeometry, DoubleSide, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial } =
    kit;
  const edges = new Set();
  const count = positions.length / 3;
  for (let i = 0; i < faces.length; ++i) {
    const [a, b] = [faces[i], faces[i % 4 === 3 ? i - 3 : i + 1]];
    edges.add(Math.min(a, b) * count + Math.max(a, b));
  }
  const pairs = new Uint32Array(2 * edges.size);
  let at = 0;
  for (const key of edges) {
    pairs[at++] = Math.floor(key / count);
    pairs[at++] = key % count;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions.length), 3));
  geometry.setIndex(new BufferAttribute(pairs, 1));
  const lines = new LineSegments(geometry, new LineBasicMaterial({ color: 0x1c2733 }));
  lines.frustumCulled = false;
  const corners = [];
  for (let i = 0; i < faces.length; i += 4) {
    const [a, b, c, d] = faces.subarray(i, i + 4);
    corners.push(a, b, c, a, c, d);
  }
  const surface = new BufferGeometry();
  surface.setAttribute('position', geometry.getAttribute('position'));
  surface.setIndex(corners);
  // faces lie a little behind their lines
  const paint = new MeshLambertMaterial({
    color: 0xd9d4c8,
    side: DoubleSide,
    flatShading: true,
    polygonOffset: true,
    polygonOffsetFactor: 1,
    polygonOffsetUnits: 1,
  });
  const shown = new Mesh(surface, paint);
  shown.frustumCulled = false;
  lines.add(shown);
  return lines;
}

/** The lines follow the body: every corner is a place in a triangle. positions: of the body as it stands. */
export function placeQuads(lines, { corners, barycentrics }, positions) {
  const place = lines.geometry.getAttribute('position');
  for (let v = 0; v < place.count; ++v)
    for (let k = 0; k < 3; ++k) {
      let sum = 0;
      for (let i = 0; i < 3; ++i) {
        const c = 3 * corners[3 * v + i] + k;
        sum += barycentrics[3 * v + i] * positions[c];
      }
      place.array[3 * v + k] = sum;
    }
  place.needsUpdate = true;
}

export function dropQuads(lines) {
  for (const thing of [lines, ...lines.children]) {
    thing.geometry.dispose();
    thing.material.dispose();
  }
  lines.removeFromParent();
}
