// build.mjs OUTDIR: bundles the page and its Worker. HF_WASM: folder of hf.mjs, hf_gltf.mjs and their wasm files. HF_MODULES: the npm packages.
// HF_WASM_MT: folder of those with threads; without it the page has none.
import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { split } from './split.mjs';

const out = resolve(process.argv[2]);
const here = dirname(fileURLToPath(import.meta.url));
const { build } = createRequire(join(process.env.HF_MODULES, 'x.js'))('esbuild');

/**
 * The glue of emscripten has a function of 120 characters for each function of the library. A list of their names does the
 * same and saves 0.7 kB of what a browser fetches. Glue that looks otherwise stays as it is.
 */
const shortGlue = {
  name: 'short-glue',
  setup: ({ onLoad }) =>
    onLoad({ filter: /hf\.mjs$/ }, ({ path }) => {
      const names = [];
      const each =
        /var _hf_(\w+)=Module\["_hf_\1"\]=function\(\)\{return\(_hf_\1=Module\["_hf_\1"\]=Module\["asm"\]\["(\w+)"\]\)\.apply\(null,arguments\)\};/g;
      const rest = readFileSync(path, 'utf8').replace(each, (_, name, key) => (names.push(`${name} ${key}`), ''));
      const list = `for(const entry of"${names}".split(",")){const[name,key]=entry.split(" ");Module["_hf_"+name]=(...given)=>Module["asm"][key](...given)}var calledRun;`;
      return { contents: rest.replace('var calledRun;', () => list) };
    }),
};

/** Small modules that the page and the Worker both use: each has its own, for one request less. */
const ownCopies = {
  name: 'own-copies',
  setup: ({ onResolve }) =>
    onResolve({ filter: /\/(normals|model_error|stiffness)\.js$/ }, ({ path, importer, resolveDir }) =>
      /(worker\w*|_mesh|mesh_files)\.js$/.test(importer) ? { path: join(resolveDir, path), suffix: '?worker' } : null,
    ),
};

// no browser needs what the loader of WebAssembly and the reader of glTF have for node; what three.js would tell a developer
// is 0.2 kB of what a browser fetches
const common = {
  bundle: true,
  absWorkingDir: here, // names hold a hash of paths as seen from here: the same bytes wherever the page is built from
  format: 'esm',
  target: 'es2022',
  minify: true,
  pure: ['console.warn', 'console.log', 'console.info', 'console.debug'],
  legalComments: 'linked',
  nodePaths: [process.env.HF_MODULES],
  external: ['node:*', 'fs', 'path', 'module', 'url'],
  logLevel: 'warning',
};

mkdirSync(out, { recursive: true });
for (const name of readdirSync(out)) if (/\.(js|html|wasm|txt)$/.test(name)) rmSync(join(out, name));
await build({
  entryPoints: { studio: join(here, 'src/studio.js'), worker: join(here, 'src/worker.js') },
  outdir: out,
  splitting: true,
  chunkNames: 'shared-[hash]',
  ...common,
  define: { HF_THREADS: JSON.stringify(Boolean(process.env.HF_WASM_MT)) },
  alias: {
    'hf-glue': join(process.env.HF_WASM, 'hf.mjs'),
    'hf-gltf-glue': join(process.env.HF_WASM, 'hf_gltf.mjs'),
  },
  plugins: [shortGlue, ownCopies],
});
// the loaders of other formats with a three.js of their own: in one bundle they would lengthen what every visitor fetches
await build({ entryPoints: { loaders: join(here, 'src/foreign.js') }, outdir: join(out, 'loaders'), ...common });
const style = (await build({ entryPoints: [join(here, 'src/studio.css')], minify: true, write: false })).outputFiles[0]
  .text;
const page = readFileSync(join(here, 'index.html'), 'utf8').replace('/*STYLE*/', () => style.trim());
const [, inline] = /<script>([^]*?)<\/script>/.exec(page);
// nothing runs that is not the page's own, and the page talks to its own host alone; three.js reads textures of a glb as blob:
const policy = [
  "default-src 'none'",
  `script-src 'self' 'wasm-unsafe-eval' 'sha256-${createHash('sha256').update(inline).digest('base64')}'`,
  "style-src 'unsafe-inline'",
  "img-src 'self' data: blob:",
  "media-src data: blob:",
  "connect-src 'self' data: blob:",
  "worker-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join('; ');
writeFileSync(join(out, 'index.html'), page.replace('<!--POLICY-->', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`));
await split(process.env.HF_WASM, out);
copyFileSync(join(process.env.HF_WASM, 'hf_gltf.wasm'), join(out, 'gltf.wasm'));
// what is bundled is under the MIT licence, which goes along
const licences = [
  'three',
  'three-mesh-bvh',
  '@gltf-transform/core',
  '@gltf-transform/extensions',
  'property-graph',
  'ktx-parse',
].map((name) => {
  const file = readdirSync(join(process.env.HF_MODULES, name)).find((entry) => /^licen[cs]e/i.test(entry));
  return `${name}\n\n${readFileSync(join(process.env.HF_MODULES, name, file), 'utf8')}`;
});
// and what is compiled into gltf.wasm
for (const name of ['libtinygltf-dev', 'libglm-dev', 'nlohmann-json3-dev']) {
  const file = join('/usr/share/doc', name, 'copyright');
  licences.push(`${name}\n\n${existsSync(file) ? readFileSync(file, 'utf8') : 'MIT licence'}`);
}
writeFileSync(join(out, 'licences.txt'), licences.join('\n\n'));

// the decoder of Draco as three has it, as a module
const draco = join(process.env.HF_MODULES, 'three/examples/jsm/libs/draco/gltf');
mkdirSync(join(out, 'draco'), { recursive: true });
const wrapper = readFileSync(join(draco, 'draco_wasm_wrapper.js'), 'utf8');
writeFileSync(join(out, 'draco', 'decoder.js'), `${wrapper}\nexport default DracoDecoderModule;\n`);
copyFileSync(join(draco, 'draco_decoder.wasm'), join(out, 'draco', 'decoder.wasm'));

// the build with threads as it is, in a folder of its own: its threads are Workers that load it by its name
rmSync(join(out, 'threads'), { recursive: true, force: true });
if (process.env.HF_WASM_MT) {
  mkdirSync(join(out, 'threads'));
  for (const name of ['hf.mjs', 'hf.worker.js']) {
    const text = readFileSync(join(process.env.HF_WASM_MT, name), 'utf8');
    // hosts that do not know .mjs send it as plain text, which is no module
    writeFileSync(join(out, 'threads', name.replace('.mjs', '.js')), text.replaceAll('./hf.mjs', './hf.js'));
  }
  copyFileSync(join(process.env.HF_WASM_MT, 'hf.wasm'), join(out, 'threads', 'hf.wasm'));
}

// what the page keeps for a start without network: all files but the samples, named by their content
const kept = readdirSync(out)
  .filter((name) => /\.(js|html|wasm)$/.test(name) && name !== 'keep.js')
  .sort();
const hash = createHash('sha256');
for (const name of kept) hash.update(name).update(readFileSync(join(out, name)));
const keep = readFileSync(join(here, 'src/keep.js'), 'utf8');
writeFileSync(
  join(out, 'keep.js'),
  keep.replace("'VERSION'", JSON.stringify(hash.digest('hex').slice(0, 16))).replace("['FILES']", JSON.stringify(kept)),
);
