// The golden scenes and bad calls through the installed npm package: golden_package.mjs SPECIFIER MESHES FILE...
// SPECIFIER: hf-fields, or hf-fields/wasm. It stands beside a copy of golden.mjs in the folder of the installation.
import { readFileSync, readdirSync } from 'node:fs';
import { basename, join } from 'node:path';
import { run } from './golden.mjs';

const [specifier, folder, ...files] = process.argv.slice(2);
const json = (path) => JSON.parse(readFileSync(path, 'utf8'));
const meshes = Object.fromEntries(readdirSync(folder).map((name) => [basename(name, '.json'), json(join(folder, name))]));
const scenes = files.flatMap((file) => json(file).scenes);
const { load } = await import(specifier);
const hf = await load();
const failures = run(hf, meshes, scenes);
for (const failure of failures) console.error(failure);
const wrongCalls = scenes.flatMap((scene) => scene.steps).filter((step) => step.error).length;
console.log(`${hf.backend} ${scenes.length} scenes, ${wrongCalls} bad calls`);
process.exit(failures.length || wrongCalls < 100 ? 1 : 0);
