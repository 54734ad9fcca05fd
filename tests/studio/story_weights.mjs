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
    await page.waitForFunction(() => window.hfStudio.tools.weights?.result, null, { timeout: 30000 });
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
  await check('a click pins a place to the bone that is shown, and the weights follow; undo takes it back', async () => {
    const shares = (vertex) =>
      page.evaluate((vertex) => {
        const { result, shown } = window.hfStudio.tools.weights;
        const { weightCount, joints, weights } = result;
        let sum = 0;
        for (let i = weightCount * vertex; i < weightCount * (vertex + 1); ++i)
          if (joints[i] === Number(shown)) sum += weights[i];
        return sum;
      }, vertex);
    // the first place of the picture that the bone does not hold
    const free = async (list) => {
      for (const spot of list) if ((await shares(spot[2])) < 0.1) return spot;
      return list[0];
    };
    const spot = await free((await studio.spots()).slice(10));
    const before = await shares(spot[2]);
    await page.mouse.click(spot[0], spot[1]);
    await page.waitForFunction(() => window.hfStudio.state.pins.length === 1 && !window.hfStudio.tools.weights?.busy);
    assert.ok(before < 0.5 && (await shares(spot[2])) > 0.999, `${before} to ${await shares(spot[2])}`);
    assert.equal((await studio.marks()).length, 1);
    await studio.picture('weights_pin');
    await page.keyboard.press('Control+z');
    // the pins go first, the weights without them come later
    await page.waitForFunction(() => {
      const { state, tools } = window.hfStudio;
      return state.pins.length === 0 && tools.weights.pinned === state.pins;
    });
    assert.ok(Math.abs((await shares(spot[2])) - before) < 1e-6);
  });
  await check('the colours go when the tool is left', async () => {
    await studio.tool('pose');
    assert.equal(await page.evaluate(() => window.hfStudio.skin.cover.visible), false);
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
