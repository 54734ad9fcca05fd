// browser.mjs FOLDER SHADERS: runs the shaders in headless Chromium over FOLDER/scene.json, and writes FOLDER/webgl_N.bin and
// FOLDER/webgpu_N.bin, one file for each draw. 77 (skipped) without Chromium or playwright-core.
import { createReadStream, createWriteStream, existsSync } from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [folder, shaders] = process.argv.slice(2);
const modules = process.env.HF_NODE_MODULES ?? join(here, '../../build/npm/node_modules');
const executablePath = process.env.HF_CHROMIUM ?? '/usr/bin/chromium';
let chromium;
try {
  ({ chromium } = createRequire(join(modules, 'x.js'))('playwright-core'));
} catch {
  console.log('skipped: the npm package playwright-core is not here (HF_NODE_MODULES)');
  process.exit(77);
}
if (!existsSync(executablePath)) {
  console.log('skipped: no chromium here');
  process.exit(77);
}

const roots = { data: folder, shaders };
const server = http.createServer((request, response) => {
  const url = new URL(request.url, 'http://localhost');
  if (url.pathname === '/posed') {
    const file = `${url.searchParams.get('name')}_${url.searchParams.get('draw')}.bin`;
    request.pipe(createWriteStream(join(folder, basename(file)))).on('finish', () => response.end());
    return;
  }
  const [, root, name] = url.pathname.split('/');
  const path = url.pathname === '/page.js' ? join(here, 'page.js') : join(roots[root] ?? folder, basename(name ?? ''));
  response.setHeader('content-type', path.endsWith('.js') ? 'text/javascript' : 'text/html');
  if (url.pathname === '/') response.end('<!doctype html><title>shaders</title>');
  else
    createReadStream(path)
      .on('error', () => response.writeHead(404).end())
      .pipe(response);
});
await new Promise((done) => server.listen(0, done));
const args = [
  '--no-sandbox',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
  '--ignore-gpu-blocklist',
  '--enable-unsafe-webgpu',
];
const browser = await chromium.launch({ executablePath, args });
try {
  const page = await browser.newPage();
  await page.goto(`http://localhost:${server.address().port}/`);
  for (const name of ['webgl', 'webgpu'])
    console.log(`${name}: ${await page.evaluate(async (n) => (await import('/page.js'))[n](), name)}`);
} finally {
  await browser.close();
  server.close();
}
