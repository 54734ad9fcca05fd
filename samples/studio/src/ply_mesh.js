// Reader of ply files, as scanners write them: text or binary, vertices with any properties, faces as lists or strips.
import { ModelError } from './model_error.js';

const kinds = {
  char: ['getInt8', 1],
  uchar: ['getUint8', 1],
  short: ['getInt16', 2],
  ushort: ['getUint16', 2],
  int: ['getInt32', 4],
  uint: ['getUint32', 4],
  float: ['getFloat32', 4],
  double: ['getFloat64', 8],
  int8: ['getInt8', 1],
  uint8: ['getUint8', 1],
  int16: ['getInt16', 2],
  uint16: ['getUint16', 2],
  int32: ['getInt32', 4],
  uint32: ['getUint32', 4],
  float32: ['getFloat32', 4],
  float64: ['getFloat64', 8],
};
/** A header is shorter than this many bytes. */
const HEADER_LIMIT = 65536;

/** { format, elements: [{ name, count, properties: [{ name, kind, counted }] }], length } of the text before the data. */
function headerOf(bytes, name) {
  const text = new TextDecoder('latin1').decode(bytes.subarray(0, HEADER_LIMIT));
  const end = /end_header\r?\n/.exec(text);
  if (!text.startsWith('ply') || !end) throw new ModelError(`${name} has no header of a ply file.`);
  const header = { format: '', elements: [], length: end.index + end[0].length };
  for (const line of text.slice(0, end.index).split(/\r?\n/)) {
    const [word, a, b, c, d] = line.trim().split(/\s+/);
    if (word === 'format') header.format = a;
    else if (word === 'element') header.elements.push({ name: a, count: Number(b), properties: [] });
    else if (word === 'property')
      header.elements.at(-1)?.properties.push(a === 'list' ? { name: d, kind: c, counted: b } : { name: b, kind: a });
  }
  const strange = header.elements
    .flatMap(({ properties }) => properties)
    .find(({ kind, counted }) => !kinds[kind] || (counted && !kinds[counted]));
  if (strange) throw new ModelError(`${name} has a property of the unknown type ${strange.kind}.`);
  return header;
}

/** A function that gives the next number of the data. */
function numbersOf(bytes, header) {
  if (header.format === 'ascii') {
    const words = new TextDecoder('latin1').decode(bytes.subarray(header.length)).split(/\s+/).filter(Boolean);
    let at = 0;
    return () => (at < words.length ? Number(words[at++]) : Number.NaN);
  }
  const view = new DataView(bytes.buffer, bytes.byteOffset + header.length, bytes.length - header.length);
  const little = header.format === 'binary_little_endian';
  let at = 0;
  return (kind) => {
    const [get, size] = kinds[kind];
    if (at + size > view.byteLength) return Number.NaN;
    at += size;
    return view[get](at - size, little);
  };
}

/** Strips of triangles: -1 begins a new one, and every second triangle is turned round. */
function addStrips(list, corners) {
  let start = 0;
  list.forEach((v, k) => {
    if (v === -1) start = k + 1;
    else if (k >= start + 2)
      corners.push(list[k - 2], ...((k - start) % 2 ? [v, list[k - 1]] : [list[k - 1], v]));
  });
}

export function readPly(bytes, name) {
  const header = headerOf(bytes, name);
  const next = numbersOf(bytes, header);
  let positions = null;
  const corners = [];
  const list = []; // of one property, used again
  for (const element of header.elements) {
    if (element.name === 'vertex') positions = new Float32Array(3 * element.count);
    const axes = element.properties.map((property) =>
      element.name === 'vertex' ? ['x', 'y', 'z'].indexOf(property.name) : -1,
    );
    for (let i = 0; i < element.count; ++i)
      element.properties.forEach(({ name: property, kind, counted }, p) => {
        if (!counted) {
          const value = next(kind);
          if (Number.isNaN(value) && axes[p] < 0 && element.name !== 'vertex')
            throw new ModelError(`${name} ends within its data.`);
          if (axes[p] >= 0) positions[3 * i + axes[p]] = value;
          return;
        }
        const size = next(counted);
        if (!(size >= 0)) throw new ModelError(`${name} ends within its data.`);
        list.length = 0;
        for (let k = 0; k < size; ++k) list.push(next(kind));
        const strips = element.name === 'tristrips';
        if (!(strips || element.name === 'face') || !/^vertex_ind/.test(property)) return;
        for (const v of list)
          if (!(strips && v === -1) && !(v >= 0 && 3 * v < (positions?.length ?? 0)))
            throw new ModelError(`A face of ${name} names vertex ${v}; there are ${(positions?.length ?? 0) / 3}.`);
        if (strips) addStrips(list, corners);
        else for (let k = 2; k < size; ++k) corners.push(list[0], list[k - 1], list[k]);
      });
  }
  if (!positions?.length) throw new ModelError(`${name} holds no vertices.`);
  if (!corners.length)
    throw new ModelError(`${name} holds no faces: a cloud of points has no surface.`, 'Make a mesh of it first.');
  return { positions, triangles: Uint32Array.from(corners) };
}
