// Keys: the handles at times; between two keys they move; a pose edited on top of a clip; saved as a clip of a glb.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { Studio, check, require } from './harness.mjs';

/** The file plays what its skin says to this part of the body: places and times are single precision. */
const EQUAL = 1e-4;
/** Four joints a vertex follow the body that closely: measured 3.9 % in the most bent place of this pose. */
const NEAR = 0.05;

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  const keys = () => page.evaluate(() => window.hfStudio.history.state.keys.map(({ time }) => time));
  const last = () => page.evaluate(() => window.hfStudio.state.handles.at(-1).translation);
  const scrub = async (time) => {
    await page.locator('#scrub').fill(String(time));
    await studio.settle();
  };
  const pull = async (dx, dy) => {
    const dot = await page.locator('.mark.chosen, .mark.pulse').first().boundingBox();
    await studio.drag(dot.x + 22, dot.y + 22, dx, dy);
  };
  await page.selectOption('#clip', 'none');
  await check('a key keeps the handles of its time', async () => {
    await pull(60, -140);
    await page.click('#key');
    await studio.settle();
    assert.deepEqual(await keys(), [0]);
    assert.equal(await page.locator('.track i').count(), 1);
  });
  let [first, second] = [await last(), null];
  await check('a drag at another time is a key there, in one step', async () => {
    const steps = await page.evaluate(() => window.hfStudio.history.past.length);
    await scrub(1);
    await pull(-120, 60);
    second = await last();
    assert.deepEqual(await keys(), [0, 1]);
    assert.equal(await page.evaluate(() => window.hfStudio.history.past.length), steps + 1);
    // the pose settles in ten frames: then it does not depend on how quick the drags were
    for (let frame = 0; frame < 20; ++frame) await scrub(1);
    await studio.picture('keys_two');
  });
  await check('half-way between two keys the handle is half-way, and the body follows it', async () => {
    await scrub(0.5);
    const middle = await last();
    middle.forEach((x, k) => assert.ok(Math.abs(x - (first[k] + second[k]) / 2) < 1e-6, `${middle}`));
    // the vertex under the handle turns about the middle of its region
    const { away, radius } = await page.evaluate(() => {
      const { skin, body, state } = window.hfStudio;
      const { vertex, translation, radius } = state.handles.at(-1);
      const off = (k) => skin.positions[3 * vertex + k] - body.positions[3 * vertex + k] - translation[k];
      return { away: Math.hypot(off(0), off(1), off(2)), radius };
    });
    assert.ok(away < radius, `the vertex under the handle is off by ${away}, its region by ${radius}`);
  });
  await check('it plays, and the start is the first key', async () => {
    await page.click('#play');
    await page.waitForTimeout(500);
    assert.equal((await studio.marks()).length, 0);
    assert.ok((await page.evaluate(() => window.hfStudio.timeline.time)) > 0.5);
    await page.click('#play');
    await page.click('#to-rest');
    await studio.settle();
    (await last()).forEach((x, k) => assert.ok(Math.abs(x - first[k]) < 1e-9));
  });
  await check('a key is removed and taken back; the picture is that of its time', async () => {
    await scrub(1);
    await page.click('#no-key');
    await studio.settle();
    assert.deepEqual(await keys(), [0]);
    (await last()).forEach((x, k) => assert.ok(Math.abs(x - first[k]) < 1e-9));
    await page.keyboard.press('Control+z');
    await studio.settle();
    assert.deepEqual(await keys(), [0, 1]);
    assert.equal(await page.evaluate(() => window.hfStudio.timeline.time), 1);
    (await last()).forEach((x, k) => assert.ok(Math.abs(x - second[k]) < 1e-9));
  });
  await check('another tool shows the body without the time line, and the keys stay', async () => {
    await scrub(0.5);
    await studio.tool('field');
    assert.ok(await page.locator('#timeline').isHidden());
    assert.equal(await page.evaluate(() => window.hfStudio.live ?? null), null);
    await studio.tool('pose');
    assert.deepEqual(await keys(), [0, 1]);
  });
  await check('the keys are saved as a clip of a valid glb, which plays the same', async () => {
    await scrub(0.5);
    const [shape, skinned, size] = await page.evaluate(async () => {
      const { shape, view, body, client, timeline } = window.hfStudio;
      const { pivots, rotations, translations, joints, weights } = await client.ask('skin', {
        handles: timeline.handlesAt(0.5),
      });
      // the skin by hand: the sum of weight times (rotation of the place about the pivot, and the translation)
      const turned = ([x, y, z, w], p) => {
        const cross = (a, b) => [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
        const t = cross([x, y, z], p).map((c) => 2 * c);
        const u = cross([x, y, z], t);
        return p.map((c, k) => c + w * t[k] + u[k]);
      };
      const skinned = [];
      for (let v = 0; v < body.vertexCount; ++v) {
        const sum = [0, 0, 0];
        for (let i = 4 * v; i < 4 * v + 4; ++i) {
          const j = joints[i];
          if (!(weights[i] > 0)) continue;
          const from = [0, 1, 2].map((k) => body.positions[3 * v + k] - pivots[3 * j + k]);
          turned(Array.from(rotations.subarray(4 * j, 4 * j + 4)), from).forEach(
            (x, k) => (sum[k] += weights[i] * (x + translations[3 * j + k])),
          );
        }
        skinned.push(...sum);
      }
      return [Array.from(shape.positions), skinned, view.size];
    });
    const path = await studio.save('save-keys');
    const { issues } = await require('gltf-validator').validateBytes(new Uint8Array(readFileSync(path)));
    assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
    const other = await Studio.open(host);
    await other.page.setInputFiles('#file', path);
    await other.page.waitForFunction(() => window.hfStudio.body.name === 'horse_keys.glb' && window.hfStudio.skin.bvh);
    assert.equal(await other.page.evaluate(() => window.hfStudio.body.clips.map((clip) => clip.getName()).join()), 'keys');
    await other.page.locator('#scrub').fill('0.5');
    await other.settle();
    const played = await other.page.evaluate(() => Array.from(window.hfStudio.skin.positions));
    await other.close();
    const away = (from) => from.reduce((most, x, i) => Math.max(most, Math.abs(x - played[i])), 0) / size;
    assert.ok(away(skinned) < EQUAL, `a place differs from the skin by ${away(skinned)} of the body`);
    assert.ok(away(shape) < NEAR, `a place differs from the pose by ${away(shape)} of the body`);
    return `from the skin ${away(skinned).toExponential(1)}, from the pose ${(100 * away(shape)).toFixed(2)} % of the body`;
  });
  await check('a pose is edited on top of a clip: the dot stays under the pointer', async () => {
    const other = await Studio.open(host);
    await other.page.locator('#scrub').fill('0.56');
    await other.settle();
    const dot = await other.mark('foot 1');
    const rest = await other.page.evaluate(() => Array.from(window.hfStudio.skin.positions));
    await other.drag(dot.x, dot.y, 40, -50);
    await other.page.waitForTimeout(200);
    const now = await other.mark('foot 1');
    assert.ok(
      Math.hypot(now.x - dot.x - 40, now.y - dot.y + 50) < 2,
      `the dot went from ${dot.x}, ${dot.y} to ${now.x}, ${now.y}`,
    );
    const [moved, time, size] = await other.page.evaluate((rest) => {
      const { skin, timeline, view } = window.hfStudio;
      return [skin.positions.reduce((most, x, i) => Math.max(most, Math.abs(x - rest[i])), 0), timeline.time, view.size];
    }, rest);
    assert.ok(moved > 0.02 * size && Math.abs(time - 0.56) < 1e-6, `${moved} at ${time}`);
    // the vertex under the dot is where the dot is
    const off = await other.page.evaluate(() => {
      const { skin, state, tools, view } = window.hfStudio;
      const handle = state.handles.find(({ label }) => label.endsWith('foot 1'));
      const a = view.onScreen(tools.pose.placeOf(handle));
      const b = view.onScreen(skin.at({ corners: [handle.vertex], barycentrics: [1] }));
      return Math.hypot(a.x - b.x, a.y - b.y);
    });
    assert.ok(off < 30, `${off} pixels from its vertex`);
    await other.picture('keys_on_clip');
    assert.deepEqual(other.complaints, []);
    await other.close();
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
