// build.mjs OUTDIR: copies what the page needs into a folder for any file host. HF_WASM: folder of hf.mjs and hf.wasm.
// HF_MODULES: the npm packages. HF_CREATURE: a glb file.
import { copyFileSync, cpSync, mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const out = process.argv[2];
const here = dirname(fileURLToPath(import.meta.url));
const root = join(here, '../..');
const three = join(process.env.HF_MODULES, 'three');
for (const folder of ['three/addons/controls', 'three/addons/loaders', 'shaders'])
  mkdirSync(join(out, folder), { recursive: true });
for (const name of ['index.html', 'crowd.js', 'worker.js', 'webgl.js', 'webgpu.js'])
  copyFileSync(join(here, name), join(out, name));
copyFileSync(join(process.env.HF_WASM, 'hf.mjs'), join(out, 'hf_module.js')); // hosts know .js
copyFileSync(join(process.env.HF_WASM, 'hf.wasm'), join(out, 'hf.wasm'));
copyFileSync(process.env.HF_CREATURE, join(out, 'creature.glb'));
for (const name of ['hf_blend.wgsl', 'hf_blend_textures.glsl'])
  copyFileSync(join(root, 'bindings/shaders', name), join(out, 'shaders', name));
cpSync(join(root, 'bindings/js/src'), join(out, 'hf'), { recursive: true });
cpSync(join(three, 'build'), join(out, 'three'), { recursive: true });
cpSync(join(three, 'examples/jsm/utils'), join(out, 'three/addons/utils'), { recursive: true });
for (const name of ['controls/OrbitControls.js', 'loaders/GLTFLoader.js'])
  copyFileSync(join(three, 'examples/jsm', name), join(out, 'three/addons', name));
