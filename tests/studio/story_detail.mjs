// Detail: a lasso around a part, the slider, larger and smaller, undo.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

/** A closed path of pixels around a spot that stays on the body, or null. */
export function loopAround(studio) {
  return studio.page.evaluate(() => {
    const { view, skin } = window.hfStudio;
    const box = document.getElementById('canvas').getBoundingClientRect();
    for (const radius of [46, 38, 30, 24])
      for (let y = 60; y < box.height - 60; y += 8)
        for (let x = 60; x < box.width - 60; x += 8) {
          const path = Array.from({ length: 33 }, (_, i) => [
            x + radius * Math.cos((2 * Math.PI * i) / 32),
            y + radius * Math.sin((2 * Math.PI * i) / 32),
          ]);
          if (
            path.every(
              ([a, b]) => skin.pick(view.ray(a, b)) && document.elementFromPoint(box.x + a, box.y + b)?.id === 'canvas',
            )
          )
            return path.map(([a, b]) => [box.x + a, box.y + b]);
        }
    return null;
  });
}

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  await studio.tool('detail');
  await studio.picture('detail_first');
  await check('a loop drawn on the body makes a region', async () => {
    const path = await loopAround(studio);
    assert.ok(path);
    await page.mouse.move(...path[0]);
    await page.mouse.down();
    for (const point of path) await page.mouse.move(...point);
    await page.mouse.up();
    await studio.settle();
    const facts = await studio.facts();
    assert.ok(Number(facts.vertices) > 10, `${JSON.stringify(facts)} ${await studio.told()}`);
    await studio.picture('detail_region');
  });
  await check('the slider smooths it: the surface inside moves, outside it stays', async () => {
    const slider = page.locator('#amount');
    await slider.fill('0');
    await slider.dispatchEvent('change');
    await studio.settle();
    const [inside, outside] = await page.evaluate(() => {
      const { skin, body, told } = window.hfStudio;
      const inner = new Set(told.detail.inside);
      const places = window.hfStudio.timeline.places();
      let [inside, outside] = [0, 0];
      for (let v = 0; v < body.vertexCount; ++v) {
        const away = Math.hypot(...[0, 1, 2].map((k) => skin.positions[3 * v + k] - body.positions[3 * v + k]));
        if (inner.has(places[v])) inside = Math.max(inside, away);
        else outside = Math.max(outside, away);
      }
      return [inside, outside];
    });
    assert.ok(inside > 1e-4 && outside < 1e-6, `inside ${inside}, outside ${outside}`);
    await studio.picture('detail_smooth');
  });
  await check('larger and smaller change the region by a ring', async () => {
    const before = Number((await studio.facts()).vertices);
    await page.click('#larger');
    await studio.settle();
    const more = Number((await studio.facts()).vertices);
    await page.click('#smaller');
    await studio.settle();
    assert.ok(more > before && Number((await studio.facts()).vertices) === before);
  });
  await check('a stroke that is no loop is refused by a sentence', async () => {
    await page.keyboard.press('Control+z');
    await studio.settle();
    const before = await studio.bits();
    const spots = await studio.spots();
    await page.mouse.move(spots[0][0], spots[0][1]);
    await page.mouse.down();
    await page.mouse.move(spots[0][0] + 3, spots[0][1] + 8);
    await page.mouse.up();
    await studio.settle();
    assert.equal(await studio.bits(), before);
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
