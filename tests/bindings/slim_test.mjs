// The small WebAssembly build: what it plays of the golden scenes has the bits of the whole one, and its size.
// HF_WASM: folder of both.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { brotliCompressSync } from 'node:zlib';
import { run } from './golden.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const golden = join(here, '../../bindings/golden');
const folder = process.env.HF_WASM;
const json = (path) => JSON.parse(readFileSync(path, 'utf8'));
try {
  statSync(join(folder, 'hf_slim.wasm'));
} catch {
  console.log('skipped: hf_slim.wasm was not built (Debian: emscripten)');
  process.exit(77);
}
const { apiOf } = await import(pathToFileURL(join(here, '../../bindings/js/src/wasm.js')));
const load = async (name) => apiOf((await import(pathToFileURL(join(folder, `${name}.mjs`)))).default, readFileSync(join(folder, `${name}.wasm`)));
const [whole, slim] = [await load('hf'), await load('hf_slim')];

const meshes = Object.fromEntries(readdirSync(join(golden, 'meshes')).map((name) => [name.replace('.json', ''), json(join(golden, 'meshes', name))]));
/** A hash of all numbers but times. */
const bits = (result) =>
  createHash('sha256')
    .update(JSON.stringify(result, (key, value) => (/Ms$/.test(key) ? 0 : ArrayBuffer.isView(value) ? Array.from(new Uint8Array(value.buffer, value.byteOffset, value.byteLength)) : value)))
    .digest('hex');
const played = [];
for (const scene of json(process.env.HF_SCENES ?? join(golden, 'scenes.json')).scenes) {
  const [wanted, found] = [[], []];
  assert.deepEqual(run(whole, meshes, [scene], (result) => wanted.push(bits(result))), []);
  const failures = run(slim, meshes, [scene], (result) => found.push(bits(result)));
  if (failures.some((failure) => failure.includes('not in the slim build'))) continue;
  assert.deepEqual(failures, []);
  assert.deepEqual(found, wanted, scene.name);
  played.push(scene.name);
}
console.log(`${played.length} scenes have the bits of the whole build: ${played.join(', ')}`);

const file = readFileSync(join(folder, 'hf_slim.wasm'));
const compressed = brotliCompressSync(file).length;
console.log(`hf_slim.wasm: ${(file.length / 1e6).toFixed(2)} MB, ${(compressed / 1e3).toFixed(0)} kB with brotli`);
assert.ok(compressed < 350e3, 'the small build is to stay below 350 kB with brotli');
