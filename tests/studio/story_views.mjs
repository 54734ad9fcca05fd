// Views: the body is framed again by a key or a button, the eye stays above the floor, a drag near a mark means the mark, and
// the mark of a body that moves waits for the pointer.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

/** The direction of the view, the eye's height over the floor, and the box of the body in the picture, as parts of it. */
const seen = () => {
  const { view, skin } = window.hfStudio;
  const box = skin.box();
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) =>
    view.onScreen(['x', 'y', 'z'].map((axis, k) => (i & (1 << k) ? box.max : box.min)[axis])),
  );
  const [x, y] = ['x', 'y'].map((axis) => corners.map((corner) => corner[axis]));
  const eye = view.camera.position.clone().sub(box.getCenter(view.target.clone())).normalize().toArray();
  return {
    eye: eye.map((part) => Math.round(100 * part) / 100 + 0),
    above: (view.camera.position.y - box.min.y) / view.size,
    // the body does not reach the corners of its box: a hundredth may be cut off
    inside: [[x, view.width], [y, view.height]].every(([list, size]) => Math.min(...list) > -0.01 * size && Math.max(...list) < 1.01 * size),
    fills: Math.max((Math.max(...x) - Math.min(...x)) / view.width, (Math.max(...y) - Math.min(...y)) / view.height),
    turn: view.turn,
  };
};

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  const now = async () => (await studio.settle(), page.evaluate(seen));
  const canvas = await page.locator('#canvas').boundingBox();
  const beside = [canvas.x + canvas.width - 60, canvas.y + canvas.height / 2];
  /** Zoomed into nothing, turned and moved away. */
  const lost = async () => {
    await page.mouse.move(...beside);
    await page.mouse.wheel(0, 1500);
    await studio.drag(...beside, -90, -60);
    await page.keyboard.down('Shift');
    await studio.drag(...beside, -300, 200);
    await page.keyboard.up('Shift');
    assert.ok((await now()).fills < 0.4);
  };
  const first = await now();
  assert.ok(first.inside && first.fills > 0.5);

  await check('F, Home and a button bring back a body that was lost; Home and the button from the first direction', async () => {
    for (const act of ['f', 'Home', '#view-home']) {
      await lost();
      const { turn } = await now();
      if (act.startsWith('#')) await page.click(act);
      else await page.keyboard.press(act);
      const found = await now();
      assert.ok(found.inside && found.fills > 0.5, `${act}: ${JSON.stringify(found)}`);
      if (act === 'f') assert.equal(found.turn, turn);
      else assert.deepEqual(found.eye, first.eye);
    }
  });
  await check('front, side and top by buttons, by the number pad, and by Shift and a digit; digits alone choose tools', async () => {
    const sides = { front: [1, [0, 0, 1]], side: [3, [1, 0, 0]], top: [7, [0, 1, 0]] };
    for (const [side, [digit, eye]] of Object.entries(sides))
      for (const act of [`#view-${side}`, `Numpad${digit}`, `Shift+Digit${digit}`]) {
        await page.click('#view-home');
        if (act.startsWith('#')) await page.click(act);
        else await page.keyboard.press(act);
        const found = await now();
        assert.deepEqual(found.eye, eye, act);
        assert.ok(found.inside && found.fills > 0.3, `${act}: ${JSON.stringify(found)}`);
        assert.equal(await page.getAttribute('#tool-pose', 'aria-selected'), 'true');
        if (act.startsWith('#')) await studio.picture(`view_${side}`, { kept: false });
      }
    await page.click('#view-home');
  });
  await check('the eye stays above the floor, whatever is dragged', async () => {
    await studio.drag(...beside, 0, -400);
    assert.ok((await now()).above >= 0, `turned: ${(await now()).above}`);
    await page.mouse.wheel(0, 800);
    assert.ok((await now()).above >= 0, `away: ${(await now()).above}`);
    await page.keyboard.down('Shift');
    await studio.drag(...beside, 0, -350);
    await page.keyboard.up('Shift');
    const { above } = await now();
    assert.ok(above >= 0, `moved: ${above}`);
    await page.click('#view-home');
  });
  await check('a drag that begins on the body beside a mark pulls the mark, and the view stays', async () => {
    const mark = await studio.mark('pull me');
    const near = (await studio.spots(6)).find(([x, y]) => {
      const away = Math.hypot(x - mark.x, y - mark.y);
      return away > 26 && away < 40;
    });
    assert.ok(near, 'a place of the body near the mark');
    const { turn } = await now();
    const steps = await page.evaluate(() => window.hfStudio.history.past.length);
    await studio.drag(near[0], near[1], 40, -60);
    assert.equal((await now()).turn, turn);
    const { past, moved } = await page.evaluate(() => ({
      past: window.hfStudio.history.past.length,
      moved: Math.hypot(...window.hfStudio.state.handles.at(-1).translation) / window.hfStudio.view.size,
    }));
    assert.equal(past, steps + 1);
    assert.ok(moved > 0.02, `${moved}`);
    await page.keyboard.press('Control+z');
  });
  await check('the next file is looked at like the first, wherever the view was', async () => {
    await lost();
    await page.selectOption('#sample', 'biped');
    await page.waitForFunction(() => window.hfStudio.body.name === 'biped.glb');
    await studio.ready();
    const found = await now();
    assert.ok(found.inside && found.fills > 0.5, JSON.stringify(found));
    assert.deepEqual(found.eye, first.eye);
  });
  await check('with a source beside it, a view shows both bodies', async () => {
    await studio.tool('transfer');
    await page.click('#take-horse');
    await page.waitForFunction(() => window.hfStudio.tools.transfer?.info);
    for (const side of ['front', 'top', 'home']) {
      await page.click(`#view-${side}`);
      await studio.settle();
      const out = await page.evaluate(() => {
        const { tools, view } = window.hfStudio;
        return tools.transfer.marks().filter(({ place }) => {
          const { x, y } = view.onScreen(place);
          return !(x >= 0 && y >= 0 && x <= view.width && y <= view.height);
        }).length;
      });
      assert.equal(out, 0, side);
    }
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();

  await check('the "pull me" of a body that walks waits for the pointer, and goes on when it leaves', async () => {
    const moving = await Studio.open(host, { reducedMotion: 'no-preference' });
    try {
      const { page } = moving;
      await page.waitForFunction(() => window.hfStudio.timeline.greeting);
      const place = () =>
        page.evaluate(() => {
          const box = document.querySelector('.mark.pulse').getBoundingClientRect();
          return [box.x + 22, box.y + 22, window.hfStudio.timeline.time];
        });
      // reached as a hand does it: on its way the mark moves
      for (let i = 0; i < 20 && !(await page.evaluate(() => window.hfStudio.timeline.held)); ++i) {
        const [x, y] = await place();
        await page.mouse.move(x + 12, y + 8);
      }
      const [x, y, time] = await place();
      await page.waitForTimeout(500);
      const later = await place();
      assert.ok(Math.hypot(later[0] - x, later[1] - y) < 0.5, `it moved from ${[x, y]} to ${later}`);
      assert.equal(later[2], time);
      await page.mouse.move(30, 500);
      await page.waitForFunction((time) => window.hfStudio.timeline.time !== time, time);
    } finally {
      await moving.close();
    }
  });
}
