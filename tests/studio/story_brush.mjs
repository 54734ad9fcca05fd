// Stiffness brush: a belt is painted rigid and keeps its lengths in a pose; strokes are undone, done again and come back after a reload.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

/** A rigid belt keeps its edges to this part of their length; the same bend without it changes them at least so many times more. */
const [KEPT, TIMES] = [2e-3, 10];
/** In the page: how much the edges of the painted vertices changed at most, and how many they are. */
const stretched = (vertices) => {
  const { skin, body } = window.hfStudio;
  const inside = new Set(vertices);
  const length = (places, a, b) => Math.hypot(...[0, 1, 2].map((k) => places[3 * a + k] - places[3 * b + k]));
  let [most, count] = [0, 0];
  const { triangles } = body;
  for (let t = 0; t < triangles.length; ++t) {
    const [a, b] = [triangles[t], triangles[t % 3 === 2 ? t - 2 : t + 1]];
    const before = length(body.positions, a, b);
    if (!inside.has(a) || !inside.has(b) || !before) continue;
    most = Math.max(most, Math.abs(length(skin.positions, a, b) / before - 1));
    ++count;
  }
  return { most, count };
};
/** In the page: the vertices of a list of painted levels, with their levels. */
const painted = () => {
  let found = [];
  for (const [level, steps] of window.hfStudio.state.stiffness ?? []) {
    let v = 0;
    found = found.concat(steps.map((step) => [(v += step), level]));
  }
  return found;
};
/** Across the trunk of the body, from its back to its belly, in pixels of the page: the shortest way in the middle of its length. */
async function across(studio) {
  await studio.settle();
  const spots = await studio.spots(8);
  const middle = spots.reduce((sum, [x]) => sum + x, 0) / spots.length;
  const columns = [...new Set(spots.map(([x]) => x))].filter((x) => Math.abs(x - middle) < 100);
  const ways = columns.map((x) => spots.filter((spot) => spot[0] === x).sort((a, b) => a[1] - b[1]));
  const shortest = ways.sort((a, b) => a.at(-1)[1] - a[0][1] - (b.at(-1)[1] - b[0][1]))[0];
  return [shortest[1], shortest.at(-2)];
}
/** A stroke by the mouse from one place to another. */
const stroke = (studio, [x, y], [x1, y1]) => studio.drag(x, y, x1 - x, y1 - y);

export default async function story(host) {
  const studio = await Studio.open(host, { query: '' });
  const { page } = studio;
  await page.click('#tour-skip');
  await page.click('#view-side');
  const start = await studio.bits();
  let belt = [];

  await check('a button of Pose takes the brush, and a stroke across the trunk paints vertices rigid as one step', async () => {
    await page.click('#brush');
    await page.waitForSelector('#stiffness');
    await page.waitForFunction(() => window.hfStudio.tool.net);
    const [from, to] = await across(studio);
    await stroke(studio, from, to);
    belt = await page.evaluate(painted);
    assert.ok(belt.length > 30, `${belt.length} painted`);
    assert.ok(belt.every(([, level]) => level === 4));
    assert.equal(await page.evaluate(() => window.hfStudio.history.past.length), 1);
    assert.equal((await studio.facts())['painted vertices'], belt.length.toLocaleString('en'));
    assert.ok(await page.locator('#legend').isVisible());
    assert.match(await page.textContent('#legend'), /soft.*normal.*rigid/);
    await studio.picture('brush_belt');
    return `${belt.length} vertices`;
  });

  await check('the stroke stays on its side of the body: it follows the surface', async () => {
    const far = await page.evaluate((vertices) => {
      const { body, view } = window.hfStudio;
      const eye = view.camera.position;
      const away = (v) => Math.hypot(eye.x - body.positions[3 * v], eye.y - body.positions[3 * v + 1], eye.z - body.positions[3 * v + 2]);
      const all = Float64Array.from({ length: body.vertexCount }, (_, v) => away(v));
      const middle = all.reduce((sum, x) => sum + x, 0) / all.length;
      return vertices.filter(([v]) => all[v] > middle).length / vertices.length;
    }, belt);
    assert.ok(far < 0.2, `${(100 * far).toFixed(0)} % of it is behind the middle of the body`);
  });

  await check('the belt keeps its lengths in a pose that stretches the same place without it', async () => {
    await page.click('#done');
    await studio.settle();
    assert.ok(await page.locator('#legend').isVisible(), 'Pose shows what is painted');
    const vertices = belt.map(([v]) => v);
    // the trunk is bent: its ends are turned against each other
    await page.evaluate(async () => {
      const app = window.hfStudio;
      const { view, body } = app;
      const box = app.skin.box(body.positions);
      const middle = [0, 1, 2].map((k) => (box.min.getComponent(k) + box.max.getComponent(k)) / 2);
      const ends = app.state.handles.map((handle) => {
        const side = Math.sign(handle.position[2] - middle[2]) || 1;
        return { ...handle, translation: [0, 0.12 * side * view.size, -0.12 * side * view.size], free: true };
      });
      await app.commit({ ...app.state, handles: ends }, 'bend');
    });
    await studio.settle();
    const rigid = await page.evaluate(stretched, vertices);
    await studio.picture('brush_posed');
    await page.evaluate(() => window.hfStudio.commit({ ...window.hfStudio.state, stiffness: null }, 'without'));
    await studio.settle();
    const plain = await page.evaluate(stretched, vertices);
    await page.keyboard.press('Control+z');
    await studio.settle();
    assert.ok(rigid.count > 50 && rigid.most < KEPT, `rigid edges change by ${rigid.most}`);
    assert.ok(plain.most > TIMES * rigid.most, `without it by ${plain.most}`);
    const again = await page.evaluate(stretched, vertices);
    assert.ok(again.most < KEPT);
    return `${rigid.count} edges: at most ${(100 * rigid.most).toFixed(3)} %, without it ${(100 * plain.most).toFixed(1)} %`;
  });

  await check('strokes are undone and done again, to the same bits, and the start is the start', async () => {
    await page.keyboard.press('Control+z'); // the bend
    await studio.settle();
    const before = await studio.bits();
    await page.keyboard.press('Control+z');
    await studio.settle();
    assert.equal(await page.evaluate(() => window.hfStudio.state.stiffness), null);
    assert.match(await studio.told(), /taken back: paint stiffness/);
    assert.ok(await page.locator('#legend').isHidden());
    assert.equal(await studio.bits(), start);
    await page.keyboard.press('Control+Shift+z');
    await studio.settle();
    assert.equal(await studio.bits(), before);
    assert.deepEqual(await page.evaluate(painted), belt);
  });

  await check('Erase takes a part back; a second finger gives a stroke up', async () => {
    await page.keyboard.press('b');
    await page.waitForSelector('#erase');
    await page.click('#erase');
    const [from] = await across(studio);
    await page.mouse.click(from[0], from[1]);
    await studio.settle();
    const left = (await page.evaluate(painted)).length;
    assert.ok(left < belt.length && left > 0, `${left} of ${belt.length}`);
    await page.click('#erase');
    const steps = await page.evaluate(() => window.hfStudio.history.past.length);
    await page.evaluate(([x, y]) => {
      const { tool } = window.hfStudio;
      const box = document.getElementById('canvas').getBoundingClientRect();
      tool.strokeStart([x - box.x, y - box.y]);
      tool.strokeCancel();
    }, from);
    await studio.settle();
    assert.equal((await page.evaluate(painted)).length, left);
    assert.equal(await page.evaluate(() => window.hfStudio.history.past.length), steps);
  });

  await check('by keys alone: Tab reaches the brush, arrows move it, Enter paints, what is there is said', async () => {
    const count = (await page.evaluate(painted)).length;
    await page.evaluate(() => document.activeElement.blur());
    for (let i = 0; i < 40; ++i) {
      await page.keyboard.press('Tab');
      if ((await page.evaluate(() => document.activeElement.getAttribute('aria-label') ?? '')).startsWith('brush, on')) break;
    }
    for (let i = 0; i < 12; ++i) await page.keyboard.press('ArrowLeft');
    assert.match(await studio.told(), /^here: normal/);
    await page.keyboard.press('Enter');
    await studio.settle();
    assert.ok((await page.evaluate(painted)).length > count);
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => /already\. Move the brush/.test(document.getElementById('told').textContent));
    await page.keyboard.press('Control+z');
    await studio.settle();
    assert.equal((await page.evaluate(painted)).length, count);
    const before = await page.evaluate(() => window.hfStudio.tool.radius);
    await page.evaluate(() => window.hfStudio.marksLayer.focus('brush'));
    await page.keyboard.press(']');
    assert.ok((await page.evaluate(() => window.hfStudio.tool.radius)) > before);
    await page.keyboard.press('[');
  });

  await check('the strokes, the brush and its settings are there after a reload, and in a link', async () => {
    const set = () => ({ stiffness: window.hfStudio.state.stiffness, brush: window.hfStudio.tools.brush.settings(), tool: window.hfStudio.tool.constructor.key });
    await page.locator('#stiffness').fill('-2');
    await page.locator('#stiffness').dispatchEvent('change');
    const [, to] = await across(studio);
    await page.mouse.click(to[0], to[1]);
    await studio.settle();
    const before = await page.evaluate(set);
    assert.ok(before.stiffness.length === 2 && before.brush.level === -2);
    await page.evaluate(() => window.hfStudio.session.changed());
    await studio.written();
    await page.reload();
    await studio.ready();
    await page.waitForFunction(() => window.hfStudio.tool?.constructor.key === 'brush' && window.hfStudio.tool.net);
    await studio.settle();
    assert.deepEqual(await page.evaluate(set), before);
    await page.click('#save');
    await page.click('#save-link');
    const link = await page.inputValue('#link');
    const other = await Studio.open(host, { query: new URL(link).search.slice(1) + new URL(link).hash });
    await other.page.waitForFunction(() => /as in the link/.test(document.getElementById('told').textContent));
    assert.deepEqual(await other.page.evaluate(set), before);
    await other.close();
    assert.deepEqual(studio.complaints, []);
    return `${link.length} letters`;
  });
  await studio.close();
}
