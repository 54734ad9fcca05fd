// The rows of figures: bytes and requests at the start, times, long tasks, poses a second, memory. Times of a shared machine
// are printed and judged by wide bounds; counts are exact.
import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { brotliCompressSync } from 'node:zlib';
import { Studio, check, folder, passOver, processor, shared } from './harness.mjs';

/** Bounds: what the goal of the design says, and what this test refuses on a busy machine without a graphics card. */
const [BYTES, REQUESTS] = [0.9e6, 6];
const SLOW = 10;
/** A first call beside a later one. */
const FIRST = 1.5;

const longTasks = (page) =>
  page.addInitScript(() => {
    window.longTasks = [];
    new PerformanceObserver((list) =>
      window.longTasks.push(
        ...list.getEntries().map(({ duration, startTime }) => [Math.round(startTime), Math.round(duration)]),
      ),
    ).observe({ type: 'longtask', buffered: true });
  });

/** The part of the Worker that builds the tree for picking: it passes on a function of the page's own files, and no more. */
const isTree = (name) => {
  const text = /^shared-/.test(name) ? readFileSync(join(folder, name), 'utf8') : '';
  return text.length < 200 && /^import\{[^}]*\}from"[^"]*";export\{[^}]* as buildBvh[^}]*\};?\s*$/.test(text);
};

/** In the page: a handle more, a pose of it, a field of two sites, or the pose at rest. The Worker's milliseconds. */
const ask = async (what) => {
  const { client, state, tools, body, view } = window.hfStudio;
  if (what === 'field') {
    const sites = [0, 900].map((triangle, id) => ({
      id,
      corners: Array.from(body.triangles.subarray(3 * triangle, 3 * triangle + 3)),
      barycentrics: [1, 0, 0],
      value: id,
      soft: false,
    }));
    return (await client.ask('field', { sites, at: true })).told.milliseconds;
  }
  const offer = tools.pose.offers.find(({ id }) => !state.handles.some((handle) => handle.id === id));
  const x = { more: 0.01, pose: 0.02 }[what];
  const handles = x ? [...state.handles, { ...offer, translation: [0, x * view.size, 0] }] : state.handles;
  return (await client.ask('shape', { handles, detail: null, way: x ? 'follow' : 'exact' })).told.milliseconds;
};

/** Poses a second of the Worker and time of the main thread for each. */
const poses = (page, count) =>
  page.evaluate(async (count) => {
    const app = window.hfStudio;
    const {
      tools: { pose },
      state,
      client,
    } = app;
    const offer = pose.offers.find(({ id }) => !state.handles.some((handle) => handle.id === id)) ?? pose.offers[0];
    const others = state.handles.filter(({ id }) => id !== offer.id);
    const ask = (i) =>
      client.ask('shape', {
        handles: [...others, { ...offer, translation: [0, 0.01 * i, 0.005 * i] }],
        detail: null,
        way: 'follow',
      });
    const first = performance.now();
    await ask(0);
    const added = performance.now() - first;
    const begin = performance.now();
    for (let i = 1; i <= count; ++i) app.skin.set(await ask(i));
    const time = performance.now() - begin;
    await client.ask('shape', { handles: state.handles, detail: null, way: 'exact' });
    return { added, perSecond: (1000 * count) / time };
  }, count);

export default async function story(host) {
  await check(`the first picture takes at most ${BYTES / 1e6} MB (brotli) and ${REQUESTS} requests`, async () => {
    const seen = [];
    const studio = await Studio.open(host, {
      before: (page) => page.on('request', (request) => seen.push(new URL(request.url()))),
    });
    // the Worker takes what the page has already from the browser's store
    const files = [
      ...new Set(
        seen
          .filter(({ protocol }) => protocol.startsWith('http'))
          .map(({ pathname }) => (pathname === '/' ? 'index.html' : pathname.slice(1)))
          // Asked for when the body can be pulled; the next check shows that nothing needs it before. And what finds
          // the triangle under the pointer, which comes after the first picture.
          .filter((name) => name !== 'rest.wasm' && !isTree(name)),
      ),
    ];
    const bytes = files.reduce((sum, name) => sum + brotliCompressSync(readFileSync(join(folder, name))).length, 0);
    await studio.close();
    assert.ok(files.length <= REQUESTS, files.join(', '));
    assert.ok(
      bytes <= BYTES,
      `${bytes} bytes: ${files.map((name) => `${name} ${brotliCompressSync(readFileSync(join(folder, name))).length}`).join(', ')}`,
    );
    return `${(bytes / 1e6).toFixed(3)} MB, ${files.length} requests`;
  });
  await check(
    'poses and fields need no more of the library than hf.wasm; what a tool lacks it says, and gets',
    async () => {
      let blocked = true;
      const studio = await Studio.open(host, {
        before: (page) => page.route('**/rest.wasm', (route) => (blocked ? route.abort() : route.continue())),
      });
      const { page } = studio;
      for (const name of ['bull', 'biped']) {
        await page.evaluate((name) => window.hfStudio.openSample(name), name);
        await studio.ready();
        await poses(page, 3);
      }
      await studio.tool('field');
      for (const i of [3, 40]) {
        const spots = await studio.spots(16);
        await page.mouse.click(...spots[Math.min(i, spots.length - 1)].slice(0, 2));
        await studio.settle();
      }
      assert.equal((await page.evaluate(() => window.hfStudio.state.sites)).length, 2);
      assert.equal(await studio.told(), '');
      // a refused call says why, and what is done for a body ends with it
      const refusal = await page.evaluate(async () => {
        const { client, state } = window.hfStudio;
        const twice = [state.handles[0], { ...state.handles[0], id: 'twice' }];
        const said = client.ask('shape', { handles: twice, detail: null, way: 'exact' }).catch(({ message }) => message);
        await window.hfStudio.openSample('bull');
        return said;
      });
      assert.match(refusal, /a handle overlaps another/);
      await studio.ready();
      await page.waitForTimeout(500);
      const { missed } = await page.evaluate(() => window.hfStudio.client.ask('memory'));
      assert.deepEqual(missed, []);
      const ask = () =>
        page.evaluate(() =>
          window.hfStudio.client.ask('skin', { handles: window.hfStudio.state.handles }).then(
            () => '',
            ({ message }) => message,
          ),
        );
      assert.match(await ask(), /could not be loaded. Try again/);
      blocked = false;
      assert.equal(await ask(), '');
      await studio.close();
    },
  );
  await check("no request leaves the page's own host", async () => {
    const seen = new Set();
    const studio = await Studio.open(host, {
      before: (page) => page.on('request', (request) => seen.add(new URL(request.url()).host)),
    });
    await studio.close();
    assert.equal([...seen].filter(Boolean).length, 1, [...seen].join(', '));
  });
  await check('the second start needs no network', async () => {
    const studio = await Studio.open(host, { query: '' });
    await studio.page.evaluate(async () => {
      await navigator.serviceWorker.ready;
      await fetch('samples/horse.glb');
    });
    await studio.page.waitForTimeout(500);
    await studio.page.reload();
    await studio.ready();
    await studio.page.context().setOffline(true);
    await studio.page.reload();
    await studio.ready();
    // tools that load when they are opened are kept too
    for (const [key, title] of [
      ['transfer', 'Transfer'],
      ['weights', 'Weights'],
      ['quads', 'Quads'],
      ['detail', 'Detail'],
    ]) {
      await studio.page.click(`#tool-${key}`);
      await studio.page.waitForFunction(
        (title) => document.getElementById('sheet-name')?.textContent === title,
        title,
        { timeout: 5000 },
      );
    }
    await studio.close();
  });
  await check('a tool that cannot be loaded says so, and the present one stays', async () => {
    const studio = await Studio.open(host);
    await studio.page.route('**/*.js', (route) => route.abort());
    await studio.page.click('#tool-quads');
    await studio.page.waitForFunction(() => /could not be loaded/.test(document.getElementById('told').textContent));
    assert.equal(await studio.page.textContent('#sheet-name'), 'Pose');
    assert.match(await studio.page.textContent('#matters'), /could not be loaded/);
    await studio.close();
  });
  await check('the horse can be pulled', async () => {
    const studio = await Studio.open(host, { before: longTasks });
    const time = await studio.page.evaluate(() => window.hfStudio.figures.open);
    const start = await studio.page.evaluate(() => performance.now());
    const { perSecond, added } = await poses(studio.page, 120);
    const long = await studio.page.evaluate((start) => window.longTasks.filter(([time]) => time > start), start);
    await studio.close();
    assert.ok(time < 1500 * SLOW && perSecond > 60 / SLOW);
    return `open ${Math.round(time)} ms, a handle more ${Math.round(added)} ms, ${Math.round(perSecond)} poses a second, long tasks ${long.length}`;
  });
  await check('the first pull is possible soon, and sooner the second time', async () => {
    const studio = await Studio.open(host, { query: '', wait: false });
    const { page } = studio;
    // from the address to a body that can be pulled
    const time = async () => {
      const answer = await page.waitForFunction(
        () => window.hfStudio?.skin && !document.body.hasAttribute('aria-busy') && performance.now(),
      );
      return answer.jsonValue();
    };
    const first = await time();
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.waitForTimeout(1000);
    const later = [];
    for (let i = 0; i < 5; ++i) {
      await page.reload({ waitUntil: 'commit' });
      later.push(await time());
      await page.waitForTimeout(500);
    }
    await studio.close();
    later.sort((a, b) => a - b);
    assert.ok(first < 1500 * SLOW && later[2] < 800 * SLOW);
    return `${Math.round(first)} ms, and then ${later.map(Math.round).join(', ')} ms`;
  });
  const meshes = [
    ['meshes/armadillo_50k.obj', 50000, 50],
    ['meshes/armadillo_200k_loop.ply', 200000, 150],
  ];
  const middle = join(shared, 'data', meshes[0][0]);
  for (const path of [null, middle]) {
    const of = path ? '50,000 vertices' : 'the horse';
    if (path && !existsSync(path)) {
      passOver(`${of}: first calls`, 'the shared meshes are not here');
      continue;
    }
    await check(`${of}: first calls take at most ${FIRST} times a later one, of a processor`, async () => {
      const studio = await Studio.open(host);
      if (path) await studio.open(path);
      await studio.page.waitForTimeout(2000); // the Worker warms up
      const found = { more: [], pose: [], field: [] };
      for (let round = 0; round < 9; ++round)
        for (const name of Object.keys(found)) {
          found[name].push(await processor(() => studio.page.evaluate(ask, name)));
          if (name === 'pose') await studio.page.evaluate(ask, 'rest');
        }
      await studio.close();
      const told = Object.entries(found).map(([name, [first, ...later]]) => {
        const median = (of) => later.map(of).sort((a, b) => a - b)[later.length >> 1];
        const wall = median(({ answer }) => answer);
        assert.ok(first.answer < FIRST * SLOW * wall, `${name}: ${first.answer} and then ${wall} ms`);
        const all = median(({ all }) => all);
        // calls of less than a millisecond are measured with the messages around them
        assert.ok(!(first.all > FIRST * all + 1), `${name}: ${first.all} and then ${all} ms of a processor`);
        return `${name} ${first.all.toFixed(1)}, then ${all.toFixed(1)} ms of a processor (${first.answer.toFixed(1)}, then ${wall.toFixed(1)} ms passed)`;
      });
      return told.join('; ');
    });
  }
  for (const [name, vertices, more] of meshes) {
    const path = join(shared, 'data', name);
    if (!existsSync(path)) {
      passOver(`${vertices} vertices`, 'the shared meshes are not here');
      continue;
    }
    await check(`${vertices} vertices: opened, pulled, no long task while it is pulled`, async () => {
      const studio = await Studio.open(host, { before: longTasks });
      const begin = Date.now();
      await studio.open(path);
      const time = Date.now() - begin;
      const handle = await processor(() => studio.page.evaluate(ask, 'more'));
      await studio.page.evaluate(ask, 'rest');
      assert.ok(!(handle.busiest > more), `a handle more takes ${handle.busiest} ms of a processor`);
      const start = await studio.page.evaluate(() => performance.now());
      const { perSecond, added } = await poses(studio.page, 40);
      const long = await studio.page.evaluate((start) => window.longTasks.filter(([time]) => time > start), start);
      await studio.picture(`figures_${vertices}`, { kept: false });
      await studio.close();
      assert.ok(perSecond > 60 / SLOW, `${perSecond} poses a second`);
      return [
        `open ${time} ms`,
        `a handle more ${handle.busiest.toFixed(0)} ms of the busiest processor (${Math.round(added)} ms passed)`,
        `${Math.round(perSecond)} poses a second, long tasks ${JSON.stringify(long)}`,
      ].join(', ');
    });
  }
  if (!existsSync(join(folder, 'threads'))) passOver('threads', 'the page was built without');
  else if (!existsSync(middle)) passOver('threads', 'the shared meshes are not here');
  else
    await check(
      'threads: a large body takes them, one without gives the same bits, the first picture asks for none',
      async () => {
        const told = [];
        for (const without of [false, true]) {
          const asked = [];
          const studio = await Studio.open(host, {
            before: (page) =>
              page.on('request', (request) => /threads/.test(request.url()) && asked.push(request.url())),
          });
          assert.deepEqual(asked, []);
          if (without) await studio.page.route('**/threads/*', (route) => route.abort());
          await studio.open(middle);
          told.push(
            await studio.page.evaluate(async () => {
              const { client, tools, state } = window.hfStudio;
              const offer = tools.pose.offers.find(({ id }) => !state.handles.some((handle) => handle.id === id));
              const handles = [...state.handles, { ...offer, translation: [0.05, 0.1, 0] }];
              const { positions } = await client.ask('shape', { handles, detail: null, way: 'exact' });
              const hash = new Uint8Array(await crypto.subtle.digest('SHA-256', positions));
              const { threads } = await client.ask('memory');
              return { hash: hash.join(), threads, cores: navigator.hardwareConcurrency };
            }),
          );
          await studio.close();
        }
        const [many, one] = told;
        assert.equal(many.threads, Math.min(4, many.cores));
        assert.equal(one.threads, 1);
        assert.equal(many.hash, one.hash);
        return `${many.threads} threads`;
      },
    );
  const gltf = join(shared, 'data/gltf');
  if (!existsSync(gltf)) passOver('every shared glb', 'the shared files are not here');
  else {
    const studio = await Studio.open(host);
    for (const name of readdirSync(gltf)
      .filter((file) => file.endsWith('.glb'))
      .slice(0, Number(process.env.HF_FULL_TESTS ? 100 : 6)))
      await check(`${name}: opens, its proposed handle is pulled, near vertices stay near`, async () => {
        await studio.open(join(gltf, name)).catch(async (error) => {
          await studio.page.keyboard.press('Escape');
          // what the studio does not read is said on a card; the test knows two reasons
          if (!/compressed|holds no triangles/.test(error.message)) throw error;
        });
        if ((await studio.page.evaluate(() => window.hfStudio.body.name)) !== name) return 'refused by a sentence';
        return pulled(studio);
      });
    await studio.close();
  }
  await check('ten models in turn leave the memory of the first', async () => {
    const studio = await Studio.open(host);
    const held = async () => (await studio.page.evaluate(() => window.hfStudio.client.ask('memory'))).heap;
    const sizes = [];
    for (let i = 0; i < 10; ++i) {
      const name = ['bull', 'horse'][i % 2];
      await studio.page.evaluate((name) => window.hfStudio.openSample(name), name);
      sizes.push(await held());
    }
    await studio.close();
    assert.ok(sizes.at(-1) <= sizes[1] * 1.05, sizes.join(', '));
    return `${(sizes[1] / 2 ** 20).toFixed(1)} MB after two, ${(sizes.at(-1) / 2 ** 20).toFixed(1)} MB after ten`;
  });
}

/** Pulls the first free handle by a tenth of the body; pairs nearer than 1 % at rest must stay within 5 %. */
async function pulled(studio) {
  const worst = await studio.page.evaluate(async () => {
    const app = window.hfStudio;
    const { pose } = app.tools;
    const offer = pose.offers.find(({ id }) => !app.state.handles.some((handle) => handle.id === id)) ?? pose.offers[0];
    if (!offer) return -1;
    const size = app.view.size;
    const handles = [
      ...app.state.handles.filter(({ id }) => id !== offer.id),
      { ...offer, pinned: false, translation: [0, 0.1 * size, 0] },
    ];
    await app.commit({ ...app.state, handles }, 'pull');
    const [rest, now] = [app.body.positions, app.skin.positions];
    const cell = 0.01 * size;
    const grid = new Map();
    const key = (x, y, z) => `${x},${y},${z}`;
    const step = Math.max(1, Math.floor(app.body.vertexCount / 6000));
    for (let v = 0; v < app.body.vertexCount; v += step) {
      const at = key(...[0, 1, 2].map((k) => Math.floor(rest[3 * v + k] / cell)));
      if (!grid.has(at)) grid.set(at, []);
      grid.get(at).push(v);
    }
    let [worst, moved] = [0, 0];
    for (let v = 0; v < app.body.vertexCount; ++v)
      moved = Math.max(moved, Math.hypot(...[0, 1, 2].map((k) => now[3 * v + k] - rest[3 * v + k])) / size);
    if (moved < 0.05) return { still: document.getElementById('told').textContent || 'no vertex moved' };
    const away = (p, a, b) => Math.hypot(p[3 * a] - p[3 * b], p[3 * a + 1] - p[3 * b + 1], p[3 * a + 2] - p[3 * b + 2]);
    for (const list of grid.values())
      for (const a of list)
        for (const b of list) if (a < b && away(rest, a, b) < cell) worst = Math.max(worst, away(now, a, b) / size);
    return worst;
  });
  if (worst.still) throw new Error(worst.still);
  if (worst < 0) return 'nothing is proposed';
  if (worst > 0.05)
    throw new Error(`two vertices nearer than 1 % at rest are ${(100 * worst).toFixed(1)} % of the body apart`);
  return `farthest ${(100 * worst).toFixed(1)} %`;
}
