// Quads: made in a Worker of their own, with counts; cancelled; they follow a pose.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  await studio.tool('quads');
  await check('quads are made and counted, and every face has four corners', async () => {
    await page.click('#make');
    await page.waitForFunction(() => window.hfStudio.tools.quads.result, null, { timeout: 60000 });
    await studio.settle();
    const facts = await studio.facts();
    assert.ok(Number(facts.quads.replace(/,/g, '')) > 300, JSON.stringify(facts));
    assert.equal(facts.quads, facts.faces);
    await studio.picture('quads_made');
  });
  await check('a run is cancelled: the last quads stay, and the next run works', async () => {
    const before = await studio.facts();
    await page.locator('#edge').fill('0.01');
    await page.click('#make');
    await page.waitForSelector('#cancel');
    await page.waitForTimeout(150);
    await studio.page.screenshot({ path: `${process.argv[3]}/quads_busy.png` });
    await page.click('#cancel');
    await studio.settle();
    assert.equal((await studio.facts()).quads, before.quads);
    await page.locator('#edge').fill('0.03');
    await page.click('#make');
    await page.waitForFunction(
      (old) => !document.querySelector('#cancel') && window.hfStudio.tools.quads.result.info.quadCount !== old,
      Number(before.quads.replace(/,/g, '')),
      { timeout: 60000 },
    );
  });
  await check('the quads lie on the body in a pose', async () => {
    await studio.tool('pose');
    const box = await page.locator('.mark.pulse').boundingBox();
    await studio.drag(box.x + 22, box.y + 22, 60, -140);
    await studio.tool('quads');
    const away = await page.evaluate(() => {
      const { tools, shape, view } = window.hfStudio;
      const { corners, barycentrics } = tools.quads.result.mesh;
      const place = tools.quads.lines.geometry.getAttribute('position').array;
      let most = 0;
      for (let v = 0; v < corners.length / 3; ++v) {
        const at = [0, 1, 2].map((k) =>
          [0, 1, 2].reduce((sum, i) => sum + barycentrics[3 * v + i] * shape.positions[3 * corners[3 * v + i] + k], 0),
        );
        most = Math.max(most, Math.hypot(...at.map((x, k) => x - place[3 * v + k])));
      }
      return most / view.size;
    });
    assert.ok(away < 0.005, `${away} of the body`);
    await studio.picture('quads_posed');
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
