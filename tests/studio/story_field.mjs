// Field: sites by clicks, a drag, the slider; the legend, the value under the pointer, hatch where no site reaches.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

/** A glTF file of two closed boxes far apart, so that a link between them is too long and one has no site. */
export function twoBoxes(distance) {
  const cube = (x) => {
    const places = [];
    for (let i = 0; i < 8; ++i) places.push(x + (i & 1), (i >> 1) & 1, (i >> 2) & 1);
    return places;
  };
  const faces = [
    0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5,
  ];
  const vertices = [...cube(0), ...cube(distance)];
  const all = [...faces, ...faces.map((v) => v + 8)];
  const lines = ['# two boxes'];
  for (let v = 0; v < vertices.length; v += 3) lines.push(`v ${vertices.slice(v, v + 3).join(' ')}`);
  for (let f = 0; f < all.length; f += 3)
    lines.push(
      `f ${all
        .slice(f, f + 3)
        .map((v) => v + 1)
        .join(' ')}`,
    );
  return lines.join('\n');
}

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  const values = () =>
    page.evaluate(() =>
      window.hfStudio.skin.field.reduce(
        ([low, high], x) => [Math.min(low, x), Math.max(high, x)],
        [Infinity, -Infinity],
      ),
    );
  await studio.tool('field');
  await page.waitForSelector('.mark.offer');
  await check('the ends of the body are proposed as sites', async () => {
    assert.ok((await studio.marks()).length >= 4);
    await studio.picture('field_first');
  });
  await check('two clicks give a field from 0 to 1, with a legend', async () => {
    const spots = await studio.spots();
    const sorted = spots.sort((a, b) => a[0] - b[0]);
    await page.mouse.click(sorted[2][0], sorted[2][1]);
    await studio.settle();
    await page.mouse.click(sorted.at(-3)[0], sorted.at(-3)[1]);
    await studio.settle();
    const [low, high] = await values();
    assert.ok(low > -0.05 && low < 0.05 && high > 0.95 && high < 1.05, `${low} to ${high}`);
    assert.ok(await page.locator('#legend').isVisible());
    await page.mouse.move(sorted[Math.floor(sorted.length / 2)][0], sorted[Math.floor(sorted.length / 2)][1]);
    await page.waitForTimeout(100);
    const tip = Number(await page.textContent('#tip'));
    assert.ok(tip > 0 && tip < 1, `value under the pointer ${tip}`);
    await studio.picture('field_two');
  });
  await check('a proposed end becomes a site by a click', async () => {
    const end = await studio.mark('end 1');
    await page.mouse.click(end.x, end.y);
    await studio.settle();
    assert.equal((await studio.facts()).sites, '3');
  });
  await check('a dragged site takes the field with it, in one step', async () => {
    const before = await page.evaluate(() => [
      window.hfStudio.history.past.length,
      Array.from(window.hfStudio.skin.field),
    ]);
    const site = await studio.mark('site 1');
    const spots = await studio.spots(12);
    const to = spots.sort(
      (a, b) =>
        Math.abs(Math.hypot(a[0] - site.x, a[1] - site.y) - 60) -
        Math.abs(Math.hypot(b[0] - site.x, b[1] - site.y) - 60),
    )[0];
    await studio.drag(site.x, site.y, to[0] - site.x, to[1] - site.y);
    const after = await page.evaluate(() => [
      window.hfStudio.history.past.length,
      Array.from(window.hfStudio.skin.field),
    ]);
    assert.equal(after[0], before[0] + 1);
    assert.ok(after[1].some((x, v) => Math.abs(x - before[1][v]) > 0.01));
  });
  await check('the slider sets the value of the chosen site', async () => {
    await page.locator('#value').focus();
    for (let i = 0; i < 20; ++i) await page.keyboard.press('ArrowRight');
    await studio.settle();
    const [, high] = await values();
    assert.ok(high > 1.05, `highest ${high}`);
    await studio.picture('field_slider');
  });
  await check('a soft site gives way', async () => {
    await page.click('#soft');
    await studio.settle();
    assert.equal(await page.evaluate(() => window.hfStudio.state.sites.filter(({ soft }) => soft).length), 1);
  });
  await check('pieces that no site reaches are hatched and counted', async () => {
    await page.setInputFiles('#file', { name: 'boxes.obj', mimeType: 'text/plain', buffer: Buffer.from(twoBoxes(60)) });
    await page.waitForFunction(() => window.hfStudio.body.name === 'boxes.obj' && window.hfStudio.skin.bvh);
    await studio.settle();
    const spots = await studio.spots(4);
    await page.mouse.click(spots[0][0], spots[0][1]);
    await studio.settle();
    assert.match(await page.textContent('#sheet'), /8 vertices belong to pieces without a site/);
    assert.match(await page.textContent('#legend'), /no site reaches it/);
    assert.equal(await page.evaluate(() => window.hfStudio.skin.reached.reduce((a, b) => a + b)), 8);
    await studio.picture('field_hatch');
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
