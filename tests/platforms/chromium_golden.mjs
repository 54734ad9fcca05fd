// The golden scenes and bad calls in headless Chromium, through the package's web entry: chromium_golden.mjs WASM_FOLDER
// SCENES. HF_NODE_MODULES: where playwright-core is. 77 (skipped) without Chromium.
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { basename, dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const [wasm, scenesFile] = process.argv.slice(2);
const browserPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
if (!browserPath) {
  console.log('skipped: no Chromium here (Debian: chromium)');
  process.exit(77);
}
const { chromium } = createRequire(join(process.env.HF_NODE_MODULES, 'x.js'))('playwright-core');
const golden = join(root, 'bindings/golden');
const json = (path) => JSON.parse(readFileSync(path, 'utf8'));
const meshes = Object.fromEntries(readdirSync(join(golden, 'meshes')).map((name) => [basename(name, '.json'), json(join(golden, 'meshes', name))]));
const scenes = [...json(scenesFile).scenes, ...json(join(golden, 'bad_input.json')).scenes];

// the package as npm lays it out: src beside dist
const folders = { src: join(root, 'bindings/js/src'), dist: wasm, tests: join(root, 'tests/bindings') };
const types = { '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
const server = createServer((request, response) => {
  const [, folder, name] = request.url.split('/');
  const file = folders[folder] && name && join(folders[folder], basename(name));
  if (request.url === '/') return response.writeHead(200, { 'content-type': 'text/html' }).end('<!doctype html>');
  if (!file || !existsSync(file)) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': types[extname(file)] ?? 'text/plain' });
  response.end(readFileSync(file));
});
await new Promise((done) => server.listen(0, '127.0.0.1', done));
const browser = await chromium.launch({ executablePath: browserPath, args: ['--no-sandbox', '--js-flags=--expose-gc'] });
try {
  const page = await browser.newPage();
  page.on('pageerror', (error) => console.error(String(error)));
  await page.goto(`http://127.0.0.1:${server.address().port}/`);
  const found = await page.evaluate(
    async ({ meshes, scenes }) => {
      const { load } = await import('/src/web.js');
      const { run } = await import('/tests/golden.mjs');
      const hf = await load();
      return { backend: hf.backend, failures: run(hf, meshes, scenes).map(String) };
    },
    { meshes, scenes },
  );
  for (const failure of found.failures.slice(0, 20)) console.error(failure);
  const wrong = scenes.flatMap((scene) => scene.steps).filter((step) => step.error).length;
  console.log(`${browser.version()}: ${found.backend}, ${scenes.length} scenes, ${wrong} bad calls, ${found.failures.length} failures`);
  process.exitCode = found.failures.length || found.backend !== 'wasm' ? 1 : 0;
} finally {
  await browser.close();
  server.close();
}
