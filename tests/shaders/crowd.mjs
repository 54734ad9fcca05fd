// crowd.mjs WASM CREATURE FOLDER: samples/crowd in headless Chromium, with few creatures. WebGPU and WebGL 2 draw the same
// picture, and the creatures move. The pictures are left in FOLDER. 77 (skipped) without what it needs.
import { execFileSync, spawn } from 'node:child_process';
import { existsSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '../..');
const [wasm, creature, folder] = process.argv.slice(2);
const modules = process.env.HF_NODE_MODULES ?? join(root, 'build/npm/node_modules');
const executablePath = process.env.HF_CHROMIUM ?? '/usr/bin/chromium';
function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}
for (const name of ['playwright-core', 'three'])
  if (!existsSync(join(modules, name))) skip(`the npm package ${name} is not here (HF_NODE_MODULES)`);
if (!existsSync(executablePath)) skip('no chromium here');
if (!existsSync(join(wasm, 'hf.wasm'))) skip('hf.wasm is not built');
if (!existsSync(creature)) skip('hf_make_assets made no creature');
const { chromium } = createRequire(join(modules, 'x.js'))('playwright-core');

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
execFileSync(process.execPath, [join(root, 'samples/crowd/build.mjs'), join(folder, 'page')], {
  env: { ...process.env, HF_WASM: wasm, HF_MODULES: modules, HF_CREATURE: creature },
});
const server = spawn(process.execPath, [join(root, 'bindings/js/studio/bin/hf-studio.mjs'), '0', join(folder, 'page')], {
  stdio: ['ignore', 'pipe', 'inherit'],
});
const address = await new Promise((done) => server.stdout.on('data', (text) => done(/http\S+/.exec(text)[0])));
const args = ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
args.push('--enable-unsafe-webgpu', '--enable-features=Vulkan', '--use-vulkan=swiftshader'); // a canvas of WebGPU, too
const browser = await chromium.launch({ executablePath, args });

/** The share of pixels of two pictures that differ by more than 64 of 255 in a channel: edges are smoothed otherwise. Runs in a page. */
async function difference([a, b]) {
  const [one, other] = await Promise.all(
    [a, b].map(async (base64) => {
      const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
      const context = new OffscreenCanvas(picture.width, picture.height).getContext('2d');
      context.drawImage(picture, 0, 0);
      return context.getImageData(0, 0, picture.width, picture.height).data;
    }),
  );
  let different = 0;
  for (let i = 0; i < one.length; i += 4) different += [0, 1, 2].some((k) => Math.abs(one[i + k] - other[i + k]) > 64);
  return (4 * different) / one.length;
}

let failed = 0;
function check(sentence, holds, told) {
  console.log(`${holds ? 'ok     ' : 'FAILED '} ${sentence}: ${told}`);
  failed += !holds;
}
try {
  const pictures = {};
  const times = [0.5, 1.5, 2.5];
  for (const kind of ['webgl', '']) {
    const page = await browser.newPage({ viewport: { width: 640, height: 400 } });
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(error.message));
    page.on('console', (said) => said.type() === 'error' && !/404/.test(said.text()) && complaints.push(said.text()));
    await page.goto(`${address}?count=4&still&${kind}`, { waitUntil: 'commit', timeout: 240000 });
    await page.waitForSelector('body[data-ready]', { timeout: 240000 });
    const name = await page.evaluate(() => window.hfCrowd.name);
    for (const time of times) {
      await page.evaluate((seconds) => window.hfCrowd.show(seconds), time);
      const shot = await page.screenshot();
      writeFileSync(join(folder, `${name.replace(' ', '_')}_${time}.png`), shot);
      (pictures[name] ??= []).push(shot.toString('base64'));
    }
    check(`${name} draws without a complaint`, !complaints.length, complaints[0] ?? 'none');
    const moved = await page.evaluate(difference, [pictures[name][0], pictures[name][1]]);
    check(`${name}: creatures move`, moved > 0.005, `${(100 * moved).toFixed(2)} % of the pixels`);
    if (kind === '') {
      if (name !== 'WebGPU') console.log('passed over: no WebGPU here');
      else
        for (const [i, time] of times.entries()) {
          const off = await page.evaluate(difference, [pictures['WebGL 2'][i], pictures.WebGPU[i]]);
          check(
            `WebGPU and WebGL 2 draw the same picture at ${time} s`,
            off < 0.002,
            `${(100 * off).toFixed(3)} % of the pixels differ`,
          );
        }
    }
    await page.close();
  }
} finally {
  await browser.close();
  server.kill();
}
process.exit(failed ? 1 : 0);
