// Drives the studio in headless Chromium: a server for the folder, pages, real pointers and keys, counted checks, pictures.
import { spawn } from 'node:child_process';
import { existsSync, mkdirSync, readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Pictures } from './pictures.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const modules = process.env.HF_NODE_MODULES ?? join(here, '../../build/npm/node_modules');
export const require = createRequire(join(modules, 'x.js'));
/** Data that is not the project's: tests that use it are passed over without it. */
export const shared = process.env.HF_SHARED ?? join(here, '../../../shared');
// whole paths: a browser drops no file with a relative one
export const [folder, pictures] = process.argv.slice(2, 4).map((path) => resolve(path));

export function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(77);
}

/** A pose of the largest body comes to rest within so many looks at it, of so many milliseconds: one second in all. */
const [LOOKS, LOOK_MS] = [100, 10];
/** A busy machine may take so long to load a page or to find what is clicked. No goal is measured by it. */
const WAIT_MS = 180000;

let [passed, failed, passedOver] = [0, 0, 0];
/** Runs one check: its name is the sentence it proves. */
export async function check(name, act) {
  const begin = performance.now();
  try {
    const told = await act();
    ++passed;
    console.log(`ok      ${name}${told ? `: ${told}` : ''} (${Math.round(performance.now() - begin)} ms)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}: ${error.message.split('\n').slice(0, 6).join(' | ')}`);
  }
}
export function passOver(name, why) {
  ++passedOver;
  console.log(`skipped ${name}: ${why}`);
}
export function finish() {
  console.log(`${passed} passed, ${failed} failed${passedOver ? `, ${passedOver} skipped` : ''}`);
  return failed ? 1 : 0;
}

export async function start() {
  let chromium;
  try {
    ({ chromium } = require('playwright-core'));
  } catch {
    skip('the npm package playwright-core is not here (HF_NODE_MODULES)');
  }
  const path = process.env.HF_CHROMIUM ?? '/usr/bin/chromium';
  if (!existsSync(path)) skip('no chromium here');
  if (!existsSync(join(folder ?? '', 'hf.wasm')))
    skip('the folder of the studio is not there; samples/studio/run --build DIR makes it');
  mkdirSync(pictures, { recursive: true });
  const server = spawn(process.execPath, [join(here, '../../bindings/js/studio/bin/hf-studio.mjs'), '0', folder], {
    stdio: ['ignore', 'pipe', 'inherit'],
  });
  const address = await new Promise((resolve) => server.stdout.on('data', (text) => resolve(/http\S+/.exec(text)[0])));
  const browser = await chromium.launch({
    executablePath: path,
    args: [
      '--no-sandbox',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--ignore-gpu-blocklist',
      '--js-flags=--expose-gc',
    ],
  });
  const kept = new Pictures(browser, pictures);
  return { address, browser, kept, close: async () => (await browser.close(), server.kill()) };
}

/**
 * Processor time that each Worker of the open pages has taken, in milliseconds: other work beside does not count. Null where
 * the system does not tell (all but Linux).
 */
export function workerTimes() {
  if (!existsSync('/proc/self/schedstat')) return null;
  const read = (path) => readFileSync(path, 'utf8');
  const times = new Map();
  const parentOf = (id) => read(`/proc/${id}/stat`).split(') ').pop().split(' ')[1];
  const ours = (id) => id === String(process.pid) || (Number(id) > 1 && ours(parentOf(id)));
  for (const id of readdirSync('/proc').filter((name) => /^\d+$/.test(name)))
    try {
      if (!read(`/proc/${id}/cmdline`).includes('--type=renderer') || !ours(id)) continue;
      for (const thread of readdirSync(`/proc/${id}/task`))
        if (/^Dedicated/.test(read(`/proc/${id}/task/${thread}/comm`)))
          times.set(thread, Number(read(`/proc/${id}/task/${thread}/schedstat`).split(' ')[0]) / 1e6);
    } catch {
      // it has ended
    }
  return times;
}
/** What act() takes of a processor: { all, busiest } of the Workers, in milliseconds, and what it answers. */
export async function processor(act) {
  const before = workerTimes();
  const answer = await act();
  const after = workerTimes();
  const each = after ? Array.from(after, ([thread, time]) => time - (before.get(thread) ?? 0)) : [NaN];
  return { answer, all: each.reduce((sum, time) => sum + time, 0), busiest: Math.max(...each) };
}

export class Studio {
  constructor(page, complaints, kept) {
    this.page = page;
    this.complaints = complaints;
    this.kept = kept;
  }
  /**
   * A page of the studio. size: [width, height]; options go to the browser's context. Less motion is wished, so that samples
   * stand still.
   */
  static async open(
    { browser, address, kept },
    { size = [1280, 800], query = 'fresh', wait = true, before = null, reducedMotion = 'reduce', ...options } = {},
  ) {
    const context = await browser.newContext({
      viewport: { width: size[0], height: size[1] },
      reducedMotion,
      ...options,
    });
    context.setDefaultTimeout(WAIT_MS);
    const page = await context.newPage();
    const complaints = [];
    page.on('pageerror', (error) => complaints.push(error.message));
    page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
    await before?.(page);
    await page.goto(`${address}?${query}`);
    const studio = new Studio(page, complaints, kept);
    if (wait) await studio.ready();
    return studio;
  }
  close() {
    return this.page.context().close();
  }
  ready() {
    return this.page.waitForFunction(
      () => window.hfStudio?.skin?.bvh && !document.body.hasAttribute('aria-busy'),
      null,
      { timeout: 120000 },
    );
  }
  /** Until nothing is on its way to the Worker, the pose rests, and the picture is drawn. */
  async settle() {
    await this.page.evaluate(async ([looks, time]) => {
      for (let wait = 0; window.hfStudio.moving && wait < looks; ++wait)
        await new Promise((done) => setTimeout(done, time));
      await window.hfStudio.client.ask('memory');
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      await window.hfStudio.client.ask('memory');
    }, [LOOKS, LOOK_MS]);
    await this.page.waitForTimeout(30);
  }
  /** Until the session is written. */
  written() {
    return this.page.waitForFunction(() => !window.hfStudio.session.busy);
  }
  /** Opens a file by the menu, until it can be pulled. Throws what the card says if it is refused. */
  async open(path, timeout = 180000) {
    const name = path.split('/').pop();
    await this.page.setInputFiles('#file', path);
    await this.page.waitForFunction(
      (name) =>
        document.querySelector('#card[open]') ||
        (window.hfStudio.body?.name === name && window.hfStudio.skin.bvh && !document.body.hasAttribute('aria-busy')),
      name,
      { timeout },
    );
    const card = await this.page.$eval('#card', (dialog) => (dialog.open ? dialog.textContent : ''));
    if (card) throw new Error(card);
  }
  /** A place on the page where a ring of a gizmo can be taken. part: of the tools, with dots: pose, weights.bend. */
  async ring(part) {
    const found = await this.page.evaluate((part) => {
      const { view, tools } = window.hfStudio;
      const { gizmo } = part.split('.').reduce((thing, name) => thing[name], tools);
      const box = document.getElementById('canvas').getBoundingClientRect();
      for (let angle = 0; angle < 6.28; angle += 0.1) {
        const point = gizmo.centre.slice();
        point[0] += gizmo.size() * Math.cos(angle);
        point[1] += gizmo.size() * Math.sin(angle);
        const { x, y } = view.onScreen(point);
        const clear = document.elementFromPoint(box.x + x, box.y + y)?.id === 'canvas';
        if (clear && gizmo.under([x, y]) >= 0) return [box.x + x, box.y + y];
      }
      return null;
    }, part);
    if (!found) throw new Error(`no ring of ${part} can be reached`);
    return found;
  }
  async tool(key) {
    await this.page.click(`#tool-${key}`);
    await this.settle();
  }
  marks() {
    return this.page.$$eval('.mark', (all) =>
      all.map((element) => ({
        label: element.getAttribute('aria-label'),
        classes: element.className,
        x: element.getBoundingClientRect().x + 22,
        y: element.getBoundingClientRect().y + 22,
      })),
    );
  }
  async mark(part) {
    const found = (await this.marks()).find(({ label }) => label.includes(part));
    if (!found) throw new Error(`no mark named ${part}: ${(await this.marks()).map(({ label }) => label).join('; ')}`);
    return found;
  }
  /** A real drag by the mouse. */
  async drag(x, y, dx, dy, { steps = 12, hold = false } = {}) {
    await this.page.mouse.move(x, y);
    await this.page.mouse.down();
    // Each step has its frame: a pose that has not settled depends on their number, so a busy machine would show another.
    for (let step = 1; step <= steps; ++step) {
      await this.page.mouse.move(x + (dx * step) / steps, y + (dy * step) / steps);
      await this.page.evaluate(async () => {
        await new Promise((done) => requestAnimationFrame(done));
        await window.hfStudio.client.ask('memory');
      });
    }
    if (!hold) await this.page.mouse.up();
    await this.settle();
  }
  /** Pixels of a grid where a ray meets the body and a pointer meets the canvas: [x, y, vertex, position]. */
  spots(step = 24) {
    return this.page.evaluate((step) => {
      const { view, skin } = window.hfStudio;
      const box = document.getElementById('canvas').getBoundingClientRect();
      const busy = [...document.querySelectorAll('.mark, #told, #legend')].map((element) =>
        element.getBoundingClientRect(),
      );
      const found = [];
      for (let y = step; y < box.height - step; y += step)
        for (let x = step; x < box.width - step; x += step) {
          const [cx, cy] = [box.x + x, box.y + y];
          if (
            busy.some(
              (other) => cx > other.left - 4 && cx < other.right + 4 && cy > other.top - 4 && cy < other.bottom + 4,
            )
          )
            continue;
          if (document.elementFromPoint(cx, cy)?.id !== 'canvas') continue; // a button of the views, say, takes the finger
          const hit = skin.pick(view.ray(x, y));
          if (hit) found.push([cx, cy, hit.vertex, hit.position]);
        }
      return found;
    }, step);
  }
  facts() {
    return this.page.$$eval('#sheet dl dt', (all) =>
      Object.fromEntries(all.map((name) => [name.textContent, name.nextSibling.textContent])),
    );
  }
  told() {
    return this.page.textContent('#told');
  }
  /** A hash of what is shown: state, positions and field, bit by bit. */
  bits() {
    return this.page.evaluate(async () => {
      const app = window.hfStudio;
      const arrays = [app.skin.positions, app.state.sites.length ? app.skin.field : new Float32Array(1)];
      const bytes = new Uint8Array(await new Blob([...arrays, JSON.stringify(app.state)]).arrayBuffer());
      return Array.from(new Uint8Array(await crypto.subtle.digest('SHA-256', bytes)), (b) => b.toString(16)).join('');
    });
  }
  /** A picture of the page for who looks at it. kept: it is compared with the kept one, without the times in its text. */
  async picture(name, { kept = true } = {}) {
    await this.settle();
    // marks behind the body are dimmed a moment after the last picture
    if (kept) await this.page.waitForTimeout(250);
    if (kept)
      await this.page.evaluate(() => {
        // messages go after a while: no picture depends on when it was taken
        document.getElementById('told').textContent = '';
        for (const element of document.querySelectorAll('#sheet dd, #quads-clock'))
          if (!element.children.length) element.textContent = element.textContent.replace(/\d[\d,.]* m?s\b/g, '0 ms');
      });
    const shot = await this.page.screenshot({ path: join(pictures, `${name}.png`), animations: 'disabled' });
    if (kept) await this.kept.compare(name, shot);
  }
  /** What a click on an entry of the save menu downloads. */
  async save(id) {
    await this.page.click('#save');
    const [file] = await Promise.all([
      this.page.waitForEvent('download', { timeout: 60000 }),
      this.page.click(`#${id}`),
    ]);
    const path = join(pictures, file.suggestedFilename());
    await file.saveAs(path);
    return path;
  }
}
