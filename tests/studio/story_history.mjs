// History: a hundred random acts and a hundred undos give the bits of the start; redo gives those of the end.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';
import { loopAround } from './story_detail.mjs';

const ACTS = 100;

/** The same numbers in every run. */
function numbers(seed) {
  return () => (seed = (Math.imul(seed, 1664525) + 1013904223) >>> 0) / 2 ** 32;
}

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  await check(`${ACTS} random acts and as many undos give the bits of the start`, async () => {
    const random = numbers(7);
    const path = await loopAround(studio);
    await page.evaluate((path) => {
      const { view, skin } = window.hfStudio;
      const box = document.getElementById('canvas').getBoundingClientRect();
      const loop = path.flatMap(([x, y]) => skin.pick(view.ray(x - box.x, y - box.y))?.vertex ?? []);
      window.hfStudio.loop = loop.filter((v, i) => i === 0 || v !== loop[i - 1]);
    }, path);
    let regions = 0;
    await page.evaluate(() =>
      window.hfStudio.commit(
        { ...window.hfStudio.state, sites: [{ id: 's0', ...window.hfStudio.cornerOf(5), value: 1, soft: false }] },
        'a site',
      ),
    );
    await page.evaluate(() => (window.hfStudio.history.past = []));
    const bits = async () => (await studio.settle(), studio.bits());
    // the start as undo shows it: bits that do not depend on the way there
    await page.evaluate(() =>
      window.hfStudio.commit({ ...window.hfStudio.state, handles: window.hfStudio.state.handles.slice(1) }, 'an act'),
    );
    await page.keyboard.press('Control+z');
    const first = await bits();
    for (let act = 0; act < ACTS; ++act) {
      const [done, region] = await page.evaluate(
        async ([kind, a, b, c]) => {
          const app = window.hfStudio;
          const { state } = app;
          const vertex = Math.floor(a * app.body.vertexCount);
          const steps = app.history.past.length;
          if (kind < 0.15)
            await app.commit(
              {
                ...state,
                sites: [...state.sites, { id: `s${app.nextId()}`, ...app.cornerOf(vertex), value: b, soft: c < 0.2 }],
              },
              'add a site',
            );
          else if (kind < 0.25 && state.sites.length > 1)
            await app.tools.field.remove(state.sites[Math.floor(b * state.sites.length)].id);
          else if (kind < 0.4 && state.sites.length)
            await app.commit(app.tools.field.with(state.sites[0].id, app.cornerOf(vertex)), 'move a site');
          else if (kind < 0.5)
            await app.tools.pose.add({
              id: `h${app.nextId()}`,
              position: Array.from(app.body.positions.subarray(3 * vertex, 3 * vertex + 3)),
              radius: 0.02 * app.view.size,
              vertex,
              label: 'h',
              rotation: [0, 0, 0, 1],
              translation: [0, 0, 0],
            });
          else if (kind < 0.58 && state.handles.length > 1)
            await app.tools.pose.remove(state.handles[Math.floor(b * state.handles.length)]);
          else if (kind < 0.62) await app.commit({ ...state, lengths: !state.lengths }, 'keep lengths');
          else if (kind < 0.7)
            await app.commit(
              { ...state, detail: state.detail ? null : { curve: app.loop, seedVertex: 0, rings: 0, weight: b } },
              'detail',
            );
          else if (state.handles.length) {
            const handle = state.handles[Math.floor(b * state.handles.length)];
            await app.commit(
              app.tools.pose.with(handle.id, { translation: [a, b, c].map((x) => (x - 0.5) * 0.2 * app.view.size) }),
              'move a handle',
            );
          }
          return [app.history.past.length - steps, Boolean(app.state.detail)];
        },
        [random(), random(), random(), random()],
      );
      regions += region;
      // a refused act is none
      if (!done) --act;
    }
    const last = await page.evaluate(() => window.hfStudio.history.past.length);
    assert.equal(last, ACTS);
    assert.ok(regions > 5, 'some acts have a region');
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+Shift+z');
    const end = await bits();
    for (let act = 0; act < ACTS; ++act) await page.evaluate(() => window.hfStudio.step('undo'));
    assert.equal(await bits(), first);
    for (let act = 0; act < ACTS; ++act) await page.evaluate(() => window.hfStudio.step('redo'));
    assert.equal(await bits(), end);
  });
  await check('the buttons say when there is nothing to take back', async () => {
    assert.equal(await page.locator('#redo').isDisabled(), true);
    assert.equal(await page.locator('#undo').isDisabled(), false);
  });
  await check('a session survives a reload: the body, its handles and sites', async () => {
    const other = await Studio.open(host, { query: '' });
    await other.page.selectOption('#sample', 'bull');
    await other.page.waitForFunction(() => window.hfStudio.body.name === 'bull.glb' && window.hfStudio.skin.bvh);
    const box = await other.page.locator('.mark.pulse').boundingBox();
    await other.drag(box.x + 22, box.y + 22, 40, -80);
    const state = await other.page.evaluate(() => JSON.stringify(window.hfStudio.state));
    await other.written();
    await other.page.reload();
    await other.ready();
    await other.page.waitForFunction(() => window.hfStudio.state.handles.length > 5);
    assert.equal(await other.page.evaluate(() => window.hfStudio.body.name), 'bull.glb');
    assert.equal(await other.page.evaluate(() => JSON.stringify(window.hfStudio.state)), state);
    await other.close();
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
