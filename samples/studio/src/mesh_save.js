// The shape as the kind of mesh file it came in: obj, off, ply or stl, with the vertices in the order of the file.

const rows = (numbers, size, line) => {
  const out = [];
  for (let i = 0; i < numbers.length; i += size) out.push(line(numbers.subarray(i, i + size)));
  return out;
};

function objText(positions, triangles) {
  return [
    ...rows(positions, 3, ([x, y, z]) => `v ${x} ${y} ${z}`),
    ...rows(triangles, 3, ([a, b, c]) => `f ${a + 1} ${b + 1} ${c + 1}`),
    '',
  ].join('\n');
}

function offText(positions, triangles) {
  return [
    'OFF',
    `${positions.length / 3} ${triangles.length / 3} 0`,
    ...rows(positions, 3, (p) => p.join(' ')),
    ...rows(triangles, 3, (t) => `3 ${t.join(' ')}`),
    '',
  ].join('\n');
}

/** Binary, little endian: floats, and three numbers a face. */
function plyBytes(positions, triangles) {
  const [vertexCount, faceCount] = [positions.length / 3, triangles.length / 3];
  const head = new TextEncoder().encode(
    `ply\nformat binary_little_endian 1.0\nelement vertex ${vertexCount}\nproperty float x\nproperty float y\n` +
      `property float z\nelement face ${faceCount}\nproperty list uchar uint vertex_indices\nend_header\n`,
  );
  const bytes = new Uint8Array(head.length + 12 * vertexCount + 13 * faceCount);
  bytes.set(head);
  const view = new DataView(bytes.buffer);
  let at = head.length;
  for (const x of positions) {
    view.setFloat32(at, x, true);
    at += 4;
  }
  for (let i = 0; i < triangles.length; i += 3) {
    view.setUint8(at, 3);
    for (let k = 0; k < 3; ++k) view.setUint32(at + 1 + 4 * k, triangles[i + k], true);
    at += 13;
  }
  return bytes;
}

/** Binary: a normal, three corners and two bytes of nothing for each triangle. */
function stlBytes(positions, triangles) {
  const bytes = new Uint8Array(84 + (50 * triangles.length) / 3);
  const view = new DataView(bytes.buffer);
  view.setUint32(80, triangles.length / 3, true);
  for (let t = 0; t < triangles.length / 3; ++t) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * triangles[3 * t + k], 3 * triangles[3 * t + k] + 3));
    const [u, v] = [b, c].map((corner) => [0, 1, 2].map((k) => corner[k] - a[k]));
    const normal = [0, 1, 2].map((k) => u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    const length = Math.hypot(...normal) || 1;
    [...normal.map((x) => x / length), ...a, ...b, ...c].forEach((x, i) => view.setFloat32(84 + 50 * t + 4 * i, x, true));
  }
  return bytes;
}

const writers = { obj: objText, off: offText, ply: plyBytes, stl: stlBytes };

/** The ending of a mesh file that can be written again, or ''. */
export function meshFormat(name) {
  const ending = name.toLowerCase().split('.').pop();
  return ending in writers ? ending : '';
}

/** The bytes or the text of such a file. */
export const meshFile = (format, positions, triangles) => writers[format](positions, triangles);
