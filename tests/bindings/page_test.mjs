// The three.js page in Chromium, by real clicks: page_test.mjs MODEL.glb SCREENSHOT.png. Sites change the field, a
// handle is
// added and dragged, the surface follows; a screenshot is written. HF_WASM: folder of hf.mjs and hf.wasm.
import assert from 'node:assert/strict';
import { createReadStream, existsSync, readFileSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const [model, picture] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const modules = process.env.HF_NODE_MODULES ?? here;
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};
let chromium;
try {
  ({ chromium } = createRequire(join(modules, 'x.js'))('playwright-core'));
} catch {
  skip('the npm packages playwright-core and three are not here (HF_NODE_MODULES)');
}
const browserPath = process.env.HF_CHROMIUM ?? '/usr/bin/chromium';
if (!existsSync(browserPath)) skip('no chromium here');
if (!existsSync(join(modules, 'three'))) skip('the npm package three is not here');
if (!existsSync(join(process.env.HF_WASM ?? '', 'hf.wasm'))) skip('hf.wasm was not built (Debian: emscripten)');

const types = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.wasm': 'application/wasm',
  '.glb': 'model/gltf-binary',
};
const roots = {
  '/three/': join(modules, 'three') + '/',
  '/hf/dist/': process.env.HF_WASM + '/',
  '/hf/': join(here, '../../bindings/js') + '/',
};
const server = createServer((request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
  const root = Object.keys(roots).find((prefix) => path.startsWith(prefix));
  const file = path === '/model.glb' ? model : root && roots[root] + path.slice(root.length);
  if (!file || !existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
  response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
  createReadStream(file).pipe(response);
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));

const browser = await chromium.launch({
  executablePath: browserPath,
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'],
});
try {
  const page = await browser.newPage({ viewport: { width: 1000, height: 700 } });
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  await page.goto(`http://127.0.0.1:${server.address().port}/hf/page/index.html?model=/model.glb`);
  await page
    .waitForFunction(() => window.hfPage, null, { timeout: 120000 })
    .catch(() => {
      throw new Error(`the page did not start: ${complaints.join('; ')}`);
    });
  const figures = () => page.evaluate(() => ({ ...window.hfPage.figures }));
  assert.ok((await figures()).vertices > 100);

  // vertices that can be clicked: visible ones whose click lands on them, spread over the picture
  const extremes = await page.evaluate(() => {
    const { rest, vertexOnScreen } = window.hfPage;
    const n = rest.positions.length / 3;
    const spots = Array.from({ length: n }, (_, v) => ({ v, ...vertexOnScreen(v) }));
    const by = (key) => spots.reduce((best, spot) => (key(spot) > key(best) ? spot : best));
    const inside = (spot, other) => ({ x: spot.x + 0.12 * (other.x - spot.x), y: spot.y + 0.12 * (other.y - spot.y) });
    const [left, right, top, bottom] = [by((s) => -s.x), by((s) => s.x), by((s) => -s.y), by((s) => s.y)];
    return {
      spots: spots.map(({ x, y }) => [x, y]),
      left: inside(left, right),
      right: inside(right, left),
      top: inside(top, bottom),
      bottom: inside(bottom, top),
    };
  });
  // the place nearest to a wish where a click meets the surface
  const near = async (wish) => {
    const spots = extremes.spots
      .map(([x, y]) => [Math.round(x), Math.round(y), Math.hypot(x - wish.x, y - wish.y)])
      .sort((a, b) => a[2] - b[2])
      .slice(0, 2000);
    return page.evaluate((list) => list.find(([x, y]) => window.hfPage.vertexAt(x, y) !== null)?.slice(0, 2), spots);
  };
  const clickSite = async (button, wish) => {
    await page.click(`[data-mode=${button}]`);
    await page.mouse.click(...(await near(wish)));
  };
  await clickSite('high', extremes.left);
  await clickSite('low', extremes.right);
  await clickSite('high', extremes.top);
  let now = await figures();
  assert.equal(now.sites, 3, now.message);
  const range = await page.evaluate(() =>
    window.hfPage.field.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [Infinity, -Infinity]),
  );
  assert.ok(range[0] > -1e-3 && range[0] < 0.02 && range[1] > 0.98 && range[1] < 1.001, `field from ${range}`);
  console.log(
    `${now.vertices} vertices in Chromium: factor ${now.createMs.toFixed(0)} ms, site ${now.editMs.toFixed(2)} ms, field ${now.solveMs.toFixed(2)} ms`,
  );

  await page.click('[data-mode=handle]');
  for (const wish of [extremes.left, extremes.right, extremes.bottom]) {
    await page.mouse.click(...(await near(wish)));
    now = await figures();
  }
  now = await figures();
  assert.equal(now.handles, 3, now.message);
  await page.click('[data-mode=drag]');
  const from = await page.evaluate(() => window.hfPage.handleOnScreen(0));
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + 40, from.y - 110, { steps: 12 });
  await page.waitForTimeout(300);
  await page.mouse.up();
  const moved = await page.evaluate(() => {
    const { positions, rest, handles } = window.hfPage;
    let most = 0;
    let still = 0;
    for (let v = 0; v < positions.length; v += 3) {
      const d = Math.hypot(
        positions[v] - rest.positions[v],
        positions[v + 1] - rest.positions[v + 1],
        positions[v + 2] - rest.positions[v + 2],
      );
      most = Math.max(most, d);
      if (d < 1e-4) ++still;
    }
    return { most, still, handle: handles[0].move.length(), finite: positions.every(Number.isFinite) };
  });
  now = await figures();
  assert.ok(moved.finite && moved.handle > 0.1 && moved.most >= moved.handle * 0.99, JSON.stringify(moved));
  assert.ok(moved.still > 2, 'the other handles stay where they are');
  console.log(`dragged over ${now.frames} frames, last pose ${now.deformMs.toFixed(2)} ms`);
  assert.equal(await page.evaluate(() => window.hfPage.solver.statistics.factorisationCount), 0);
  await page.screenshot({ path: picture });
  assert.ok(readFileSync(picture).length > 20000);
  await page.click('#undo');
  await page.click('#remove');
  now = await figures();
  assert.deepEqual([now.sites, now.handles], [2, 2]);
  assert.deepEqual(complaints, []);
} finally {
  await browser.close();
  server.close();
}
