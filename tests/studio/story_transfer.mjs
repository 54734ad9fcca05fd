// Transfer: the walk of the horse on the bull and on the biped; pairs proposed, left out; played, saved.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { Studio, check, require } from './harness.mjs';

/** How far the dots of the body are off it, and how far it is from rest, as parts of its size. */
const shown = () => {
  const { body, skin, tools, view } = window.hfStudio;
  const far = (place) => {
    let least = Infinity;
    for (let v = 0; v < body.vertexCount; ++v)
      least = Math.min(least, Math.hypot(...[0, 1, 2].map((k) => place[k] - skin.positions[3 * v + k])));
    return least / view.size;
  };
  const dots = (tools.transfer?.marks() ?? []).filter(({ id }) => id.startsWith('b'));
  const moved = skin.positions.reduce((most, x, i) => Math.max(most, Math.abs(x - body.positions[i])), 0) / view.size;
  return { off: Math.max(0, ...dots.map(({ place }) => far(place))), moved };
};

export default async function story(host) {
  const studio = await Studio.open(host, { query: 'fresh&sample=bull' });
  const { page } = studio;
  await studio.tool('transfer');
  await check(
    'the horse is taken as the source, and pairs are proposed: four feet, two places of the trunk, tips',
    async () => {
      await page.click('#take-horse');
      await page.waitForFunction(() => window.hfStudio.tools.transfer?.info, null, { timeout: 30000 });
      await studio.settle();
      const kinds = await page.evaluate(() =>
        window.hfStudio.tools.transfer.pairs
          .map(({ kind }) => kind)
          .sort()
          .join(),
      );
      assert.match(kinds, /^foot,foot,foot,foot,(tip,)+trunk,trunk$/);
      await studio.picture('transfer_pairs');
      return kinds;
    },
  );
  await check('feet are paired with feet of the same side and row', async () => {
    const wrong = await page.evaluate(
      () =>
        window.hfStudio.tools.transfer.pairs.filter(
          ({ kind, source, target }) =>
            kind === 'foot' &&
            (Math.sign(source.position[0]) !== Math.sign(target.position[0]) ||
              Math.sign(source.position[2]) !== Math.sign(target.position[2])),
        ).length,
    );
    assert.equal(wrong, 0);
  });
  await check('the walk moves the feet of the bull like those of the horse', async () => {
    const travel = await page.evaluate(async () => {
      const { tools, body, skin } = window.hfStudio;
      const tool = tools.transfer;
      const foot = tool.pairs.find(({ kind }) => kind === 'foot').target.position;
      let best = 0;
      for (let v = 1; v < body.vertexCount; ++v) {
        const away = (w) => Math.hypot(...foot.map((x, k) => x - body.positions[3 * w + k]));
        if (away(v) < away(best)) best = v;
      }
      const places = [];
      for (let i = 0; i < 8; ++i) {
        await tool.seek((i * 1.1) / 8);
        places.push([skin.positions[3 * best + 1], skin.positions[3 * best + 2]]);
      }
      const range = (k) => Math.max(...places.map((p) => p[k])) - Math.min(...places.map((p) => p[k]));
      return [range(0) / window.hfStudio.view.size, range(1) / window.hfStudio.view.size];
    });
    assert.ok(travel[1] > 0.05, `a foot travels ${travel}`);
    await page.evaluate(() => window.hfStudio.marksLayer.update());
    await studio.picture('transfer_walk');
    return `a foot travels ${travel.map((x) => x.toFixed(3))} of the picture, up and along`;
  });
  await check('gaps between pieces are measured in every frame and said in a sentence, and again none for other pairs', async () => {
    const said = await page.evaluate(async () => {
      const { transfer } = window.hfStudio.tools;
      const line = () => {
        const found = document.getElementById('transfer-gap');
        return found.hidden ? '' : found.textContent;
      };
      const whole = [transfer.gap, line()]; // a bull of one piece
      transfer.gap = 0.0234;
      await transfer.seek(0.4);
      const open = line();
      transfer.app.refresh();
      const kept = line();
      await transfer.set(transfer.pairs);
      return [...whole, open, kept, line()];
    });
    assert.deepEqual(said, [
      0,
      '',
      'Linked pieces are up to 2.3 % of the box apart.',
      'Linked pieces are up to 2.3 % of the box apart.',
      '',
    ]);
  });
  await check('dials: a longer stride moves a foot farther, the tail follows, and neutral dials give the same picture', async () => {
    await page.click('#dials summary');
    const names = await page.evaluate(() => [...document.querySelectorAll('#dials input')].map(({ id }) => id).join());
    assert.match(names, /^dial-stride,dial-hipHeightShare,dial-neckFollow/);
    const shape = (time) =>
      page.evaluate(async (time) => {
        const { tools, skin } = window.hfStudio;
        await tools.transfer.seek(time);
        return Array.from(skin.positions);
      }, time);
    const set = async (name, value) => {
      await page.evaluate(
        ([name, value]) => {
          const input = document.getElementById(`dial-${name}`);
          input.value = value;
          input.dispatchEvent(new Event('input'));
        },
        [name, value],
      );
      await studio.settle();
    };
    const feet = await page.evaluate(() => {
      const { tools, body } = window.hfStudio;
      const foot = tools.transfer.pairs.find(({ kind }) => kind === 'foot').target.position;
      const away = (w) => Math.hypot(...foot.map((x, k) => x - body.positions[3 * w + k]));
      let best = 0;
      for (let v = 1; v < body.vertexCount; ++v) if (away(v) < away(best)) best = v;
      return best;
    });
    const travel = async () => {
      const along = [];
      for (let i = 0; i < 8; ++i) along.push((await shape((i * 1.1) / 8))[3 * feet + 2]);
      return Math.max(...along) - Math.min(...along);
    };
    const neutral = await shape(0.4);
    const short = await travel();
    await set('stride', 1.4);
    const long = await travel();
    assert.ok(long > 1.2 * short && long < 1.6 * short, `${short} becomes ${long}`);
    await studio.picture('transfer_dials');
    await set('stride', 1);
    assert.deepEqual(await shape(0.4), neutral);
    return `a foot travels ${(long / short).toFixed(2)} times as far at 1.4; ${names}`;
  });
  await check('it plays, and stops at rest', async () => {
    await page.click('#transfer-play');
    await page.waitForTimeout(600);
    assert.ok((await page.evaluate(() => window.hfStudio.tools.transfer.time)) > 0);
    await page.click('#transfer-stop');
    await studio.settle();
    assert.ok((await studio.marks()).length >= 12);
  });
  await check('a frame that comes after Stop is not shown', async () => {
    // a slow Worker: answers wait until they are let go
    await page.evaluate(() => {
      const { client } = window.hfStudio;
      window.late = new Promise((done) => (window.letGo = done));
      client.frame = async (...given) => {
        const answer = await Object.getPrototypeOf(client).frame.apply(client, given);
        await window.late;
        return answer;
      };
    });
    await page.click('#transfer-play');
    await page.waitForFunction(() => window.hfStudio.tools.transfer.time > 0);
    await page.click('#transfer-stop');
    await page.evaluate(() => (delete window.hfStudio.client.frame, window.letGo()));
    await studio.settle();
    const moved = await page.evaluate(() => {
      const { skin, body } = window.hfStudio;
      return skin.positions.filter((x, i) => x !== body.positions[i]).length;
    });
    assert.equal(moved, 0, `${moved} coordinates are those of the walk`);
  });
  await check('a click on a dot leaves its pair out', async () => {
    const before = (await studio.facts()).pairs;
    const dot = await studio.mark('tip, target');
    await page.mouse.click(dot.x, dot.y);
    await studio.settle();
    assert.notEqual((await studio.facts()).pairs, before);
  });
  await check('the walk is saved as a valid glb', async () => {
    const path = await studio.save('save-transfer');
    const { issues } = await require('gltf-validator').validateBytes(new Uint8Array(readFileSync(path)));
    assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
  });
  await check('another tool brings the body back alone', async () => {
    await studio.tool('pose');
    assert.equal(await page.evaluate(() => window.hfStudio.tools.transfer.source.skin.group.visible), false);
  });
  await check('a source thirty times smaller is drawn as large as the body, with its dots on it', async () => {
    const obj = await page.evaluate(() => {
      const { positions, triangles } = window.hfStudio.body;
      const rows = (letter, list) =>
        Array.from({ length: list.length / 3 }, (_, i) => `${letter} ${list.slice(3 * i, 3 * i + 3).join(' ')}`);
      return [...rows('v', Array.from(positions, (x) => 30 * x)), ...rows('f', Array.from(triangles, (v) => v + 1))].join('\n');
    });
    await page.setInputFiles('#file', { name: 'large.obj', mimeType: 'text/plain', buffer: Buffer.from(obj) });
    await page.waitForFunction(() => window.hfStudio.body.name === 'large.obj');
    await studio.ready();
    await studio.tool('transfer');
    await page.click('#take-horse');
    await page.waitForFunction(() => window.hfStudio.tools.transfer.info && window.hfStudio.tools.transfer.source.skin.bvh);
    await studio.settle();
    const { high, off, away } = await page.evaluate(() => {
      const { tools, view, skin } = window.hfStudio;
      const { source, pairs } = tools.transfer;
      const heights = [skin, source.skin].map((one) => {
        const box = one.box();
        return (box.max.y - box.min.y) * one.group.scale.y;
      });
      // the middle of the dots lies on the body, and a dot is no farther from what is picked beside it than a few pixels
      let away = 0;
      let off = 0;
      for (const { source: place } of pairs) {
        const at = view.onScreen(source.shown(place.position));
        const hit = source.pick(view.ray(at.x, at.y));
        if (!hit) ++off;
        else {
          const there = view.onScreen(source.shown(hit.position));
          away = Math.max(away, Math.hypot(there.x - at.x, there.y - at.y));
        }
      }
      return { high: heights[1] / heights[0], off: off / pairs.length, away };
    });
    assert.ok(high > 0.5 && high < 2, `${high} times as high`);
    // tips of horns and tails may lie a pixel beside the body
    assert.ok(off < 0.5 && away < 1, `${off} of the dots lie beside the body, ${away} pixels`);
    await studio.picture('transfer_small_source', { kept: false });
    return `${high.toFixed(2)} times as high`;
  });
  await check('a posed body stands at rest beside the source, its dots on it, and is posed again after', async () => {
    const posed = await Studio.open(host, { query: 'fresh&sample=bull' });
    try {
      const { page } = posed;
      const box = await page.locator('.mark.pulse').boundingBox();
      await posed.drag(box.x + 22, box.y + 22, 30, -90);
      assert.ok((await page.evaluate(shown)).moved > 0.03);
      await posed.tool('transfer');
      await page.click('#take-horse');
      await page.waitForFunction(() => window.hfStudio.tools.transfer?.info, null, { timeout: 30000 });
      await posed.settle();
      for (const act of [null, '#undo', '#redo']) {
        if (act) await page.click(act);
        await posed.settle();
        const { off, moved } = await page.evaluate(shown);
        assert.ok(off < 0.01 && moved === 0, `${act}: dots are ${off} off, the body moved by ${moved}`);
      }
      await posed.tool('pose');
      assert.ok((await page.evaluate(shown)).moved > 0.03);
    } finally {
      await posed.close();
    }
  });
  await check('the clip plays at once when a source is taken, where motion is welcome; Stop shows the pairs', async () => {
    const moving = await Studio.open(host, { reducedMotion: 'no-preference' });
    try {
      const { page } = moving;
      await page.click('#tool-transfer');
      await page.click('#take-bull');
      await page.waitForFunction(() => window.hfStudio.tools.transfer?.playing && window.hfStudio.tools.transfer.time > 0);
      assert.equal(await page.textContent('#transfer-play'), 'Pause');
      await page.click('#transfer-stop');
      await page.waitForFunction(() => document.querySelectorAll('.mark').length >= 12);
    } finally {
      await moving.close();
    }
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
