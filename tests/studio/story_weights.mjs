// Weights: the weights of the file in colour, new ones from its bones, one bone alone.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  await studio.tool('weights');
  await check('the weights of the file are shown, each bone in its colour', async () => {
    const colours = await page.evaluate(
      () =>
        new Set(Array.from({ length: 200 }, (_, i) => window.hfStudio.skin.tint.slice(90 * i, 90 * i + 3).join())).size,
    );
    assert.ok(colours > 50, `${colours} colours`);
    await studio.picture('weights_file');
  });
  await check('new weights are computed: sum 1, every vertex has a bone', async () => {
    await page.click('#compute');
    await page.waitForFunction(() => window.hfStudio.tools.weights.result, null, { timeout: 30000 });
    await studio.settle();
    const [worst, facts] = [
      await page.evaluate(() => {
        const { weights, weightCount } = window.hfStudio.tools.weights.result;
        let worst = 0;
        for (let v = 0; v < weights.length; v += weightCount)
          worst = Math.max(worst, Math.abs(1 - weights.slice(v, v + weightCount).reduce((a, b) => a + b)));
        return worst;
      }),
      await studio.facts(),
    ];
    assert.ok(worst < 1e-6, `sums differ from 1 by ${worst}`);
    assert.equal(facts.bones, '38');
    await studio.picture('weights_new');
  });
  await check('one bone is shown alone, with a legend', async () => {
    await page.selectOption('#bone', { index: 5 });
    await studio.settle();
    assert.ok(await page.locator('#legend').isVisible());
    await studio.picture('weights_bone');
  });
  await check('the colours go when the tool is left', async () => {
    await studio.tool('pose');
    assert.equal(await page.evaluate(() => window.hfStudio.skin.cover.visible), false);
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
