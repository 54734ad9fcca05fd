// Weights: the weights of the file in colour, new ones from its bones, one bone alone.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { Studio, check, require } from './harness.mjs';

/** How far the picture is from the shape of the handles, as part of the body's size. */
const moved = async (studio) => {
  await studio.settle();
  return studio.page.evaluate(() => {
    const { skin, shape, view } = window.hfStudio;
    return skin.positions.reduce((most, x, i) => Math.max(most, Math.abs(x - shape.positions[i])), 0) / view.size;
  });
};

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
    await studio.picture('weights_file', { kept: false });
  });
  await check('new weights are computed: sum 1, every vertex has a bone', async () => {
    await page.click('#compute');
    await page.waitForFunction(() => window.hfStudio.tools.weights?.result, null, { timeout: 30000 });
    await studio.settle();
    const [worst, facts] = [
      await page.evaluate(() => {
        const { weights, influenceCount } = window.hfStudio.tools.weights.result;
        let worst = 0;
        for (let v = 0; v < weights.length; v += influenceCount)
          worst = Math.max(worst, Math.abs(1 - weights.slice(v, v + influenceCount).reduce((a, b) => a + b)));
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
  await check('the bones are seen through the body; a click on one shows its weights, and the others are dim', async () => {
    await page.selectOption('#bone', 'all');
    const found = await page.evaluate(() => {
      const { tools, view } = window.hfStudio;
      const { drawn, bones } = tools.weights;
      const box = document.getElementById('canvas').getBoundingClientRect();
      const middles = drawn.segments.map(({ bone, from, to }) => {
        const { x, y } = view.onScreen(from.clone().add(to).multiplyScalar(0.5));
        return { bone, at: [x, y], name: bones.names[bone], found: drawn.under([x, y]) };
      });
      const clear = middles.find(({ bone, found, name }) => bone === found && /leg/.test(name));
      return { seen: drawn.solid.visible && drawn.edges.visible, bones: new Set(middles.map(({ bone }) => bone)).size, clear, at: [box.x, box.y] };
    });
    assert.ok(found.seen);
    assert.equal(found.bones, 38);
    const { clear, at } = found;
    await studio.picture('weights_bones', { kept: false });
    await page.mouse.move(at[0] + clear.at[0], at[1] + clear.at[1]);
    assert.equal(await page.textContent('#tip'), `bone ${clear.name}`);
    await page.mouse.click(at[0] + clear.at[0], at[1] + clear.at[1]);
    await studio.settle();
    assert.equal(await page.inputValue('#bone'), String(clear.bone));
    assert.ok(await page.locator('#legend').isVisible());
    assert.equal(await page.evaluate(() => window.hfStudio.state.pins.length), 0);
    await page.selectOption('#bone', { index: 5 });
    return clear.name;
  });
  await check(
    'a click pins a place to the bone that is shown, and the weights follow; undo takes it back',
    async () => {
      const shares = (vertex) =>
        page.evaluate((vertex) => {
          const { result, shown } = window.hfStudio.tools.weights;
          const { influenceCount, joints, weights } = result;
          let sum = 0;
          for (let i = influenceCount * vertex; i < influenceCount * (vertex + 1); ++i)
            if (joints[i] === Number(shown)) sum += weights[i];
          return sum;
        }, vertex);
      // the first place of the picture that the bone does not hold, and where no bone lies under it
      const bone = ([x, y]) =>
        page.evaluate(([x, y]) => {
          const box = document.getElementById('canvas').getBoundingClientRect();
          return window.hfStudio.tools.weights.drawn.under([x - box.x, y - box.y]);
        }, [x, y]);
      const free = async (list) => {
        for (const spot of list) if ((await bone(spot)) < 0 && (await shares(spot[2])) < 0.1) return spot;
        throw new Error(`none of ${list.length} places is free of the bone that is shown and of bones under it`);
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
    },
  );
  await check('fewer bones: 8 are kept as 4, and the shares that go are told', async () => {
    await page.selectOption('#weight-count', '8');
    await page.waitForFunction(() => window.hfStudio.tools.weights.result?.influenceCount === 8);
    const most = await page.evaluate(() => {
      const { weights, influenceCount } = window.hfStudio.tools.weights.result;
      let most = 0;
      for (let v = 0; v < weights.length; v += influenceCount)
        most = Math.max(most, weights.slice(v, v + influenceCount).filter(Boolean).length);
      return most;
    });
    await page.selectOption('#weight-count', '4');
    await page.waitForFunction(() => window.hfStudio.tools.weights.result?.influenceCount === 4);
    assert.ok(most > 4, `a vertex has at most ${most} bones`);
    return `${most} bones at a vertex, then 4`;
  });
  await check('live test: a ring turns the bone, the skin follows, and Rest brings it back', async () => {
    // a bone of a leg, where its rings are free
    const bones = await page.$$eval('#bone option', (all) => all.map(({ textContent }) => textContent));
    await page.selectOption('#bone', { label: bones.find((name) => /front_lower_leg_L/.test(name)) });
    await studio.settle();
    const handleCount = () => page.evaluate(() => window.hfStudio.state.handles.length);
    const before = await handleCount();
    const ring = await studio.ring('weights.bend');
    await studio.drag(...ring, -60, 70);
    const bent = await moved(studio);
    assert.ok(bent > 0.01, `moved by ${bent}`);
    assert.equal(await page.evaluate(() => window.hfStudio.history.past.length), 0);
    assert.equal(await handleCount(), before);
    await page.click('#test-rest');
    assert.equal(await moved(studio), 0);
    return `moved by ${(100 * bent).toFixed(1)} % of the body`;
  });
  await check('the slider turns it by keys', async () => {
    await page.focus('#bend');
    for (let i = 0; i < 8; ++i) await page.keyboard.press('ArrowRight');
    const bent = await moved(studio);
    await studio.picture('weights_test');
    assert.ok(bent > 0.005, `moved by ${bent}`);
    await page.click('#test-rest');
    assert.equal(await moved(studio), 0);
  });
  await check('the clip plays with these weights; with those of the file it is the clip of the file', async () => {
    await page.click('#test-clip');
    await page.waitForTimeout(300);
    assert.ok((await moved(studio)) > 0.005);
    await page.click('#test-clip');
    assert.equal(await moved(studio), 0);
    await page.click('#file-weights');
    const off = await page.evaluate(() => {
      const app = window.hfStudio;
      const { bend } = app.tools.weights;
      [bend.clip, bend.time] = [app.timeline.clip, 0.4];
      bend.show();
      const mine = app.skin.positions.slice();
      bend.rest();
      app.timeline.time = 0.4;
      app.timeline.show();
      const most = mine.reduce((most, x, i) => Math.max(most, Math.abs(x - app.skin.positions[i])), 0) / app.view.size;
      app.timeline.stop();
      return most;
    });
    assert.ok(off < 1e-5, `${off} off the clip of the file`);
    return `${off.toExponential(1)} of the body off`;
  });
  await check('the handles as bones: weights are computed, and saved with the pose as a valid glb', async () => {
    await page.selectOption('#bones-of', 'handles');
    assert.equal((await studio.facts()).bones, '5');
    await page.click('#compute');
    await page.waitForFunction(() => window.hfStudio.tools.weights.result);
    await studio.settle();
    await studio.picture('weights_handles');
    const { worst, used } = await page.evaluate(() => {
      const { weights, joints, influenceCount } = window.hfStudio.tools.weights.result;
      let worst = 0;
      for (let v = 0; v < weights.length; v += influenceCount)
        worst = Math.max(worst, Math.abs(1 - weights.slice(v, v + influenceCount).reduce((a, b) => a + b)));
      return { worst, used: new Set(joints.filter((_, i) => weights[i] > 0)).size };
    });
    const handles = await page.evaluate(() => window.hfStudio.state.handles.length);
    assert.ok(worst < 1e-6 && used === handles, `sums off by ${worst}, ${used} of ${handles} bones used`);
    const { issues } = await require('gltf-validator').validateBytes(
      new Uint8Array(readFileSync(await studio.save('save-weights'))),
    );
    assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
  });
  await check('the colours go when the tool is left', async () => {
    await studio.tool('pose');
    assert.equal(await page.evaluate(() => window.hfStudio.skin.cover.visible), false);
    assert.equal(await page.evaluate(() => window.hfStudio.tools.weights.drawn.solid.visible), false);
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
