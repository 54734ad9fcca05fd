// Readers of two text formats: obj and off. Faces of more corners are cut into fans.
import { ModelError } from './model_error.js';

const numbersOf = (text) => text.trim().split(/\s+/);

function finish(positions, corners, name) {
  if (!positions.length) throw new ModelError(`${name} holds no vertices.`);
  if (!corners.length) throw new ModelError(`${name} holds no faces.`);
  return { positions: Float32Array.from(positions), triangles: Uint32Array.from(corners) };
}

function fan(face, corners, count, name) {
  const bad = face.find((v) => !(v >= 0 && v < count));
  if (bad !== undefined) throw new ModelError(`A face of ${name} names vertex ${bad}; there are ${count}.`);
  for (let i = 2; i < face.length; ++i) corners.push(face[0], face[i - 1], face[i]);
}

export function readObj(text, name) {
  const [positions, corners] = [[], []];
  for (const line of text.split('\n')) {
    if (line.startsWith('v ')) positions.push(...numbersOf(line.slice(2)).slice(0, 3).map(Number));
    else if (line.startsWith('f ')) {
      const count = positions.length / 3;
      const face = numbersOf(line.slice(2)).map((word) => parseInt(word, 10));
      fan(
        face.map((v) => (v < 0 ? count + v : v - 1)),
        corners,
        count,
        name,
      );
    }
  }
  return finish(positions, corners, name);
}

export function readOff(text, name) {
  const words = text.replace(/#.*/g, '').split(/\s+/).filter(Boolean);
  if (!/OFF$/.test(words[0] ?? '')) throw new ModelError(`${name} does not begin with OFF.`);
  const [vertexCount, faceCount] = [Number(words[1]), Number(words[2])];
  const positions = words.slice(4, 4 + 3 * vertexCount).map(Number);
  if (positions.length !== 3 * vertexCount) throw new ModelError(`${name} ends within its vertices.`);
  const corners = [];
  let at = 4 + 3 * vertexCount;
  for (let f = 0; f < faceCount; ++f) {
    const size = Number(words[at]);
    if (!(size > 0)) throw new ModelError(`${name} ends within its faces.`);
    fan(words.slice(at + 1, at + 1 + size).map(Number), corners, vertexCount, name);
    at += 1 + size;
  }
  return finish(positions, corners, name);
}
