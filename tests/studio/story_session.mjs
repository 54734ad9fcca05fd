// What stays and what goes: a session comes back whole after a reload, messages go, and the tour comes once.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

/** All that was set, and what each tool shows of it. */
const whole = () => {
  const app = window.hfStudio;
  const { tools } = app;
  return JSON.parse(
    JSON.stringify({
      ...app.settings(),
      weights: tools.weights && [tools.weights.of, tools.weights.influenceCount, String(tools.weights.shown), Boolean(tools.weights.result)],
      quads: tools.quads?.result && [tools.quads.result.info.faceCount, Math.round(tools.quads.count)],
      detail: tools.detail && [tools.detail.source?.name, tools.detail.mapped],
      transfer: tools.transfer?.source && [tools.transfer.source.body.name, tools.transfer.pairs.map(({ off }) => Boolean(off)), tools.transfer.dials],
    }),
  );
};

export default async function story(host) {
  await check('a session is whole after a reload: sites, the source of a transfer, weights, quads, detail, the view', async () => {
    const studio = await Studio.open(host, { query: '' });
    const { page } = studio;
    await page.waitForSelector('#tour-skip');
    await page.click('#tour-skip');
    await page.selectOption('#sample', 'bull');
    await page.waitForFunction(() => window.hfStudio.body.name === 'bull.glb');
    await studio.ready();
    await studio.tool('field');
    await page.evaluate(() => window.hfStudio.tools.field.add(window.hfStudio.cornerOf(5)));
    await studio.tool('weights');
    await page.click('#compute');
    await page.waitForFunction(() => window.hfStudio.tools.weights.result && !window.hfStudio.tools.weights.busy);
    await page.selectOption('#bone', { index: 4 });
    await studio.tool('quads');
    await page.locator('#count').fill('9');
    await page.click('#make');
    await page.waitForFunction(() => window.hfStudio.tools.quads.result && !window.hfStudio.tools.quads.busy);
    await page.locator('#crease').fill('40');
    await page.locator('#crease').dispatchEvent('change');
    await studio.tool('transfer');
    // not a sample: only the session has its bytes
    await page.evaluate(async () => {
      const bytes = new Uint8Array(await (await fetch('samples/horse.glb')).arrayBuffer());
      const { transfer } = window.hfStudio.tools;
      await transfer.open(bytes, 'a walk of mine.glb');
      await transfer.set(transfer.pairs.map((pair, i) => ({ ...pair, off: i === 1 })));
      await transfer.turn('stride', 1.5);
    });
    await studio.tool('detail');
    await page.evaluate(async () => {
      const bytes = new Uint8Array(await (await fetch('samples/biped.glb')).arrayBuffer());
      await window.hfStudio.tools.detail.take(bytes, 'a scan of mine.glb');
      window.hfStudio.tools.detail.mapped = true;
    });
    await page.click('#view-side');
    await studio.settle();
    const before = await page.evaluate(whole);
    assert.equal(before.weights[3], true);
    assert.ok(before.quads && before.transfer[1][1] && before.detail[0] && before.state.sites.length === 1);
    await page.evaluate(() => window.hfStudio.session.changed());
    await studio.written();
    await page.reload();
    await studio.ready();
    await page.waitForFunction(() => {
      const { tools, tool } = window.hfStudio;
      return tool?.constructor.key === 'detail' && tools.detail.source && tools.transfer?.info && tools.weights?.result && tools.quads?.result;
    });
    await studio.settle();
    assert.deepEqual(await page.evaluate(whole), before);
    await studio.tool('transfer');
    assert.ok((await studio.marks()).length >= 12);
    await studio.tool('quads');
    assert.equal((await studio.facts()).quads, before.quads[0].toLocaleString('en'));
    assert.deepEqual(studio.complaints, []);
    await studio.close();
  });

  const studio = await Studio.open(host);
  const { page } = studio;
  await check('a message goes after a while, and with the next act; one that matters stays in the sheet until then', async () => {
    await page.evaluate(() => window.hfStudio.ui.say('a message'));
    assert.equal(await studio.told(), 'a message');
    await page.waitForFunction(() => document.getElementById('told').textContent === '', null, { timeout: 15000 });
    await page.evaluate(() => {
      const { state } = window.hfStudio;
      return window.hfStudio.commit({ ...state, handles: [...state.handles, { ...state.handles[0], id: 'twice' }] }, 'add a handle');
    });
    assert.match(await page.textContent('#matters'), /overlap/);
    await studio.picture('message_matters');
    await page.waitForFunction(() => document.getElementById('told').textContent === '', null, { timeout: 30000 });
    assert.match(await page.textContent('#matters'), /overlap/);
    await studio.tool('field');
    assert.equal(await page.locator('#matters').count(), 0);
    await page.evaluate(() => window.hfStudio.ui.say('of Field'));
    await page.click('#tool-pose');
    await page.waitForFunction(() => document.getElementById('told').textContent === '');
  });
  await check('no tour for who wishes a fresh page; from the help it comes', async () => {
    assert.equal(await page.locator('#tour').count(), 0);
    await page.click('#help');
    await page.click('#card button:text-is("Tour")');
    await page.waitForSelector('#tour');
    await page.click('#tour-skip');
    assert.equal(await page.locator('#tour').count(), 0);
  });
  await studio.close();

  for (const [where, size, more] of [['desktop', [1280, 800], {}], ['phone', [390, 844], { hasTouch: true, isMobile: true, deviceScaleFactor: 1 }]])
    await check(`the tour comes once: a pull, a turn, a site, each seen when it is done (${where})`, async () => {
      const visit = await Studio.open(host, { query: '', size, ...more });
      const { page } = visit;
      const step = () => page.textContent('#tour');
      await page.waitForSelector('#tour');
      assert.match(await step(), /1 of 3/);
      await visit.picture(`tour_${where}`);
      const box = await page.locator('.mark.pulse').boundingBox();
      await visit.drag(box.x + 22, box.y + 22, 20, -30);
      await page.waitForFunction(() => /2 of 3/.test(document.getElementById('tour').textContent));
      const canvas = await page.locator('#canvas').boundingBox();
      await visit.drag(canvas.x + 20, canvas.y + 100, 80, 0);
      await page.waitForFunction(() => /3 of 3/.test(document.getElementById('tour').textContent));
      await page.click('#tool-field');
      await visit.settle();
      await page.evaluate(() => window.hfStudio.tools.field.add(window.hfStudio.cornerOf(5)));
      await page.waitForSelector('#tour-end');
      await page.click('#tour-end');
      await page.reload();
      await visit.ready();
      await page.waitForTimeout(1000);
      assert.equal(await page.locator('#tour').count(), 0);
      await visit.close();
    });
}
