// The shape as the kind of mesh file it came in: obj, off or ply, with the vertices in the order of the file.

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

const writers = { obj: objText, off: offText, ply: plyBytes };

/** The ending of a mesh file that can be written again, or ''. */
export function meshFormat(name) {
  const ending = name.toLowerCase().split('.').pop();
  return ending in writers ? ending : '';
}

/** The bytes or the text of such a file. */
export const meshFile = (format, positions, triangles) => writers[format](positions, triangles);
