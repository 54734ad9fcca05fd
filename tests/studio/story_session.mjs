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

/**
 * In the page: what the session keeps under a key. value: is written before; bytes: as its bytes. drop: the fields of what is there
 * that are taken away.
 */
const kept = ({ key, value, bytes, drop = [] }) =>
  new Promise((done, failed) => {
    const request = indexedDB.open('hf-studio', 1);
    request.onerror = () => failed(request.error);
    request.onsuccess = () => {
      const store = request.result.transaction('session', 'readwrite').objectStore('session');
      if (bytes) value = { ...value, bytes: Uint8Array.from(bytes) };
      if (value !== undefined) store.put(value, key);
      const answer = store.get(key);
      answer.onsuccess = () => {
        const { result } = answer;
        for (const field of drop) delete result[field];
        if (drop.length) store.put(result, key);
      };
      store.transaction.oncomplete = () => (request.result.close(), done(JSON.parse(JSON.stringify(answer.result))));
      store.transaction.onabort = () => failed(store.transaction.error);
    };
  });
/** Pulls a free handle by a step, so that something is there to be kept. */
const pull = () => {
  const { state, tools, view } = window.hfStudio;
  const offer = tools.pose.offers.find(({ id }) => !state.handles.some((other) => other.id === id));
  return window.hfStudio.commit({ ...state, handles: [...state.handles, { ...offer, pinned: false, translation: [0, 0.1 * view.size, 0] }] }, 'pull');
};
/** A page with a session that is written, of a pulled horse. */
async function withSession(host, more = {}) {
  const studio = await Studio.open(host, { query: '', ...more });
  await studio.page.click('#tour-skip');
  await studio.page.evaluate(pull);
  await studio.page.evaluate(() => window.hfStudio.session.changed());
  await studio.written();
  return studio;
}

export default async function story(host) {
  await check('while a session comes back in Pose, the source of its transfer is not seen and the body stands as it was left', async () => {
    const studio = await withSession(host, { size: [900, 600] });
    const { page } = studio;
    await studio.tool('transfer');
    await page.click('#take-bull');
    await page.waitForFunction(() => window.hfStudio.tools.transfer?.info);
    await studio.tool('pose');
    await page.evaluate(() => window.hfStudio.session.changed());
    await studio.written();
    const posed = await page.evaluate(() => Array.from(window.hfStudio.skin.positions));
    await page.addInitScript(() => {
      window.seen = { source: 0, rest: 0 };
      const look = () => {
        const { tool, tools, skin, body, state } = window.hfStudio ?? {};
        if (tools?.transfer?.source && tool !== tools.transfer) {
          window.seen.source += tools.transfer.source.skin.group.visible;
          window.seen.rest += tools.pose.posed(state.handles) && skin.positions.every((x, i) => x === body.positions[i]);
        }
        requestAnimationFrame(look);
      };
      look();
    });
    await page.reload();
    await studio.ready();
    await page.waitForFunction(() => window.hfStudio.tools.transfer?.info);
    await studio.settle();
    assert.deepEqual(await page.evaluate(() => window.seen), { source: 0, rest: 0 });
    assert.deepEqual(await page.evaluate(() => Array.from(window.hfStudio.skin.positions)), posed);
    assert.deepEqual(studio.complaints, []);
    await studio.close();
  });
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

  await check('what was set and is refused is not lost: a card says why, and nothing is written over it until it is given up', async () => {
    const studio = await withSession(host);
    const { page } = studio;
    const settings = await page.evaluate(kept, { key: 'settings' });
    const { handles } = settings.state;
    settings.state.handles = [...handles, { ...handles[0], id: 'twice' }];
    await page.evaluate(kept, { key: 'settings', value: settings });
    for (let visit = 0; visit < 2; ++visit) {
      await page.reload();
      await studio.ready();
      await page.waitForSelector('#card[open]');
      assert.match(await page.textContent('#card'), /last session with horse.glb is not whole.*a handle overlaps another/);
      if (!visit) await studio.picture('session_waits', { kept: false });
      await page.click('#card button:text-is("Close")');
      // the body is there, as it opens, and can be posed
      assert.equal(await page.evaluate(() => window.hfStudio.history.state.handles.length), 5);
      await page.evaluate(pull);
      await page.evaluate(() => window.hfStudio.session.changed());
      await page.waitForTimeout(600);
      await studio.written();
      assert.deepEqual(await page.evaluate(kept, { key: 'settings' }), settings);
    }
    await page.reload();
    await page.waitForSelector('#card[open]');
    await page.click('#card button:text-is("Give it up")');
    await page.evaluate(pull);
    await page.waitForTimeout(600);
    await studio.written();
    assert.equal((await page.evaluate(kept, { key: 'settings' })).state.handles.length, 6);
    await page.reload();
    await studio.ready();
    await page.waitForFunction(() => window.hfStudio.state.handles.length === 6);
    assert.equal(await page.locator('#card[open]').count(), 0);
    assert.deepEqual(studio.complaints, []);
    await studio.close();
  });
  await check('a kept body that does not open any more stays kept; given up, the sample in its place is', async () => {
    const studio = await withSession(host);
    const { page } = studio;
    const name = async () => (await page.evaluate(kept, { key: 'body' })).name;
    await page.evaluate(kept, { key: 'body', value: { name: 'mine.glb' }, bytes: [...Buffer.from('glTF, cut')] });
    await page.reload();
    await studio.ready();
    await page.waitForSelector('#card[open]');
    assert.match(await page.textContent('#card'), /last session with mine.glb is not whole/);
    assert.equal(await page.evaluate(() => window.hfStudio.body.name), 'horse.glb');
    assert.equal(await name(), 'mine.glb');
    assert.ok(await page.evaluate(kept, { key: 'settings' }));
    await page.click('#card button:text-is("Give it up")');
    await studio.written();
    assert.equal(await name(), 'horse.glb');
    await studio.close();
  });
  await check('a tool whose part cannot be brought back is named, and the session stays', async () => {
    const studio = await withSession(host);
    const { page } = studio;
    const settings = await page.evaluate(kept, { key: 'settings' });
    settings.tools.transfer = { source: 'a walk that is gone.glb', pairs: null, dials: {}, clip: 0 };
    await page.evaluate(kept, { key: 'settings', value: settings });
    await page.reload();
    await studio.ready();
    await page.waitForSelector('#card[open]');
    assert.match(await page.textContent('#card'), /transfer: a walk that is gone.glb is not here/);
    await page.click('#card button:text-is("Close")');
    assert.equal(await page.evaluate(() => window.hfStudio.history.state.handles.length), 6);
    assert.deepEqual(await page.evaluate(kept, { key: 'settings' }), settings);
    await studio.close();
  });
  for (const [what, error, said] of [['has no room', 'QuotaExceededError', /no room to keep/], ['keeps nothing', 'InvalidStateError', /keeps nothing/]])
    await check(`a browser that ${what} says so in the sheet`, async () => {
      const studio = await Studio.open(host, {
        query: '',
        before: (page) =>
          page.addInitScript((error) => {
            IDBObjectStore.prototype.put = () => {
              throw new DOMException('of the test', error);
            };
          }, error),
      });
      await studio.page.waitForSelector('#matters');
      assert.match(await studio.page.textContent('#matters'), said);
      assert.deepEqual(studio.complaints, []);
      await studio.close();
    });
  await check('quads that were on their way when the page was left are made for the strokes that came back', async () => {
    const studio = await withSession(host);
    const { page } = studio;
    await studio.tool('quads');
    await page.locator('#count').fill('9');
    await page.click('#make');
    await page.waitForFunction(() => window.hfStudio.tools.quads.result && !window.hfStudio.tools.quads.busy);
    await studio.written();
    const mesh = () => page.evaluate(() => window.hfStudio.tools.quads.result.mesh.positions.join());
    await page.evaluate(async () => {
      const app = window.hfStudio;
      const places = [0, 8, 16, 24, 32].map((vertex) => app.cornerOf(vertex));
      await app.commit({ ...app.state, strokes: [{ id: 'k1', places }] }, 'draw a stroke');
    });
    const still = () =>
      page.waitForFunction(() => {
        const { tools, history } = window.hfStudio;
        return !tools.quads.following && tools.quads.relaxed && tools.quads.shows(history.state);
      });
    await still();
    const stroked = await mesh();
    await page.evaluate(() => window.hfStudio.session.changed());
    await page.waitForTimeout(600);
    await studio.written();
    // as if the page had been left before the mesh of the stroke was there
    await page.evaluate(kept, { key: 'quads', drop: ['strokes'] });
    for (const agrees of [false, true]) {
      await page.reload();
      await studio.ready();
      await page.waitForFunction(() => window.hfStudio.tools.quads?.result);
      await still();
      assert.equal(await mesh(), stroked);
      // its Worker was started where it was made again
      assert.equal(Boolean(await page.evaluate(() => window.hfStudio.tools.quads.line)), !agrees);
      await studio.written();
    }
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
    assert.match(await page.textContent('#matters'), /^add a handle: a handle overlaps another; put it farther away/);
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
