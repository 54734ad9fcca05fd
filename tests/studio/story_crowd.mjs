// The page of samples/crowd: it shows creatures, says what is wrong with what it is given, and solves for pictures alone.
import assert from 'node:assert/strict';
import { execFileSync, spawn } from 'node:child_process';
import { existsSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { check, folder, passOver, pictures } from './harness.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const wasm = process.env.HF_WASM ?? join(root, 'build/wasm');
const modules = process.env.HF_STUDIO_MODULES ?? join(root, 'build/studio/npm/node_modules');
/** A page on a busy machine without a graphics card is ready within so many milliseconds. */
const WAIT_MS = 120000;

export default async function story({ browser }) {
  if (!existsSync(join(wasm, 'hf.wasm')) || !existsSync(join(modules, 'three'))) {
    passOver('the crowd', 'WebAssembly or three.js is not here');
    return;
  }
  const out = join(pictures, 'crowd');
  const creature = process.env.HF_CREATURE ?? join(root, 'build/studio/samples/horse.glb');
  execFileSync(process.execPath, [join(root, 'samples/crowd/build.mjs'), out], {
    env: { ...process.env, HF_WASM: wasm, HF_MODULES: modules, HF_CREATURE: existsSync(creature) ? creature : join(folder, 'samples/horse.glb') },
  });
  const server = spawn(process.execPath, [join(root, 'bindings/js/studio/bin/hf-studio.mjs'), '0', out], { stdio: ['ignore', 'pipe', 'inherit'] });
  const address = await new Promise((resolve) => server.stdout.on('data', (text) => resolve(/http\S+/.exec(text)[0])));
  const open = async (query, before = () => {}) => {
    const context = await browser.newContext({ viewport: { width: 800, height: 500 } });
    context.setDefaultTimeout(WAIT_MS);
    const page = await context.newPage();
    await before(page);
    await page.goto(`${address}?webgl&${query}`);
    return page;
  };
  const said = async (query, before) => {
    const page = await open(query, before);
    await page.waitForSelector('#said.wrong');
    const text = await page.textContent('#said');
    await page.context().close();
    return text;
  };
  try {
    await check('a crowd of twelve is shown and told, and moves', async () => {
      const page = await open('count=12');
      await page.waitForFunction(() => document.body.dataset.ready && /^12 creatures of \d+ vertices, WebGL 2: poses/.test(document.getElementById('said').textContent));
      await page.screenshot({ path: join(pictures, 'crowd.png') });
      const text = await page.textContent('#said');
      await page.waitForFunction((before) => document.getElementById('said').textContent !== before, text);
      await page.context().close();
      return text;
    });
    await check('a count that is none is said', async () => {
      for (const count of ['0', '-3', '1.5', 'many', '', '99999']) assert.match(await said(`count=${count}`), /count is ".*"; it must be a whole number from 1 to \d+/, count);
    });
    await check('a body that is not there or holds no mesh, and a file of the page that does not come, are said', async () => {
      assert.match(await said('count=2&model=nothing.glb'), /nothing\.glb could not be read/);
      assert.match(await said('count=2&still', (page) => page.route('**/hf.wasm', (route) => route.fulfill({ status: 404 }))), /hf\.wasm could not be loaded \(404\)/);
      assert.match(await said('count=2&still', (page) => page.route('**/*.glsl', (route) => route.fulfill({ status: 404 }))), /hf_blend_textures\.glsl could not be loaded \(404\)/);
      assert.match(await said('count=2', (page) => page.route('**/crowd.js', (route) => route.abort())), /could not be loaded/);
    });
    await check('poses are asked for with pictures: a page that gets none solves nothing', async () => {
      const page = await open('count=4', (page) =>
        page.addInitScript(() => {
          const ask = window.requestAnimationFrame.bind(window);
          window.requestAnimationFrame = (act) => (window.stopped ? 0 : ask(act));
          const { postMessage } = Worker.prototype;
          window.asked = 0;
          Worker.prototype.postMessage = function (...given) {
            ++window.asked;
            return postMessage.apply(this, given);
          };
        }),
      );
      await page.waitForFunction(() => window.asked > 40);
      await page.evaluate(() => (window.stopped = true));
      await page.waitForTimeout(500);
      const before = await page.evaluate(() => window.asked);
      await page.waitForTimeout(700);
      assert.equal(await page.evaluate(() => window.asked), before);
      await page.context().close();
    });
  } finally {
    server.kill();
  }
}
