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
    await studio.settle(); // the view has come home
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
  await check('a drag beside a mark that the body hides turns the view', async () => {
    await page.click('#view-side');
    await studio.settle();
    await page.waitForTimeout(300);
    const hidden = (await studio.marks()).filter(({ classes }) => classes.includes('behind'));
    const seen = (await studio.marks()).filter(({ classes }) => !classes.includes('behind'));
    assert.ok(hidden.length, 'a foot on the other side');
    const far = (mark, [x, y]) => Math.hypot(x - mark.x, y - mark.y);
    const place = (await studio.spots(4)).find((spot) => hidden.some((mark) => far(mark, spot) < 40) && seen.every((mark) => far(mark, spot) > 46));
    assert.ok(place, 'a place of the body that is near to hidden marks alone');
    const { turn } = await now();
    const steps = await page.evaluate(() => window.hfStudio.history.past.length);
    await studio.drag(place[0], place[1], 40, -20);
    assert.notEqual((await now()).turn, turn);
    assert.equal(await page.evaluate(() => window.hfStudio.history.past.length), steps);
    await page.click('#view-home');
  });
  await check('a second finger, or a pointer that the system takes, gives up what was pulled: no step, and the body goes back', async () => {
    await page.click('#view-home');
    await studio.settle();
    const session = await page.context().newCDPSession(page);
    const send = (type, ...points) => session.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
    const mark = await studio.mark('head');
    const near = (await studio.spots(6)).find(([x, y]) => {
      const away = Math.hypot(x - mark.x, y - mark.y);
      return away > 26 && away < 40;
    });
    const rest = () => page.evaluate(() => [window.hfStudio.history.past.length, window.hfStudio.history.state.handles.length, Boolean(window.hfStudio.live)]);
    const moved = () =>
      page.evaluate(() => {
        const { skin, body, view } = window.hfStudio;
        return skin.positions.reduce((most, x, i) => Math.max(most, Math.abs(x - body.positions[i])), 0) / view.size;
      });
    const before = await rest();
    // on the body beside the mark, and on the mark itself
    for (const [x, y, end] of [[near[0], near[1], 'second'], [near[0], near[1], 'touchCancel'], [mark.x, mark.y, 'touchCancel']]) {
      await page.click('#view-home'); // two fingers have turned it
      await studio.settle();
      await send('touchStart', [x, y]);
      for (const k of [1, 2, 3, 4]) await send('touchMove', [x + 10 * k, y - 15 * k]);
      await studio.settle();
      assert.ok((await moved()) > 0.02, `${end}: the body follows`);
      if (end === 'second') {
        await send('touchStart', [x + 40, y - 60], beside);
        await send('touchMove', [x + 45, y - 65], beside);
        await send('touchEnd');
      } else await send(end);
      await studio.settle();
      assert.deepEqual(await rest(), before, end);
      assert.ok((await moved()) < 1e-6, `${end}: ${await moved()}`);
    }
    await session.detach();
    assert.ok((await studio.mark('head')).classes.includes('offer'));
    await page.click('#view-home');
  });
  await check('keys: AZERTY has digits with Shift, a slider keeps its own, and Alt is left to the browser', async () => {
    /** What a key does: the tool, the direction, and whether the browser may act on it. */
    const press = (init, at = 'body') =>
      page.evaluate(
        async ([init, at]) => {
          const event = new KeyboardEvent('keydown', { bubbles: true, cancelable: true, ...init });
          const free = document.querySelector(at).dispatchEvent(event);
          await new Promise((done) => setTimeout(done, 50));
          const { tool, view } = window.hfStudio;
          return [tool.constructor.key, [view.turn, view.lift].map((x) => Math.round(100 * x) / 100).join(), free];
        },
        [init, at],
      );
    await page.click('#view-home');
    const home = (await press({ key: 'x', code: 'KeyX' }))[1];
    assert.deepEqual(await press({ key: 'é', code: 'Digit2' }), ['field', home, true]);
    assert.deepEqual(await press({ key: '&', code: 'Digit1' }), ['pose', home, true]);
    assert.deepEqual(await press({ key: '1', code: 'Digit1', shiftKey: true }), ['pose', '0,0', false]);
    assert.deepEqual(await press({ key: 'Home', code: 'Home' }), ['pose', home, false]);
    assert.deepEqual(await press({ key: '2', code: 'Digit2', shiftKey: true }), ['pose', home, true]);
    // the number pad, with NumLock and without; it chooses no tools
    assert.deepEqual(await press({ key: '3', code: 'Numpad3' }), ['pose', '1.57,0', false]);
    assert.deepEqual(await press({ key: 'Home', code: 'Numpad7' }), ['pose', '0,1.57', false]);
    assert.deepEqual(await press({ key: '2', code: 'Numpad2' }), ['pose', '0,1.57', true]);
    // on a slider those of the number pad without NumLock move it
    for (const [key, code] of [['Home', 'Numpad7'], ['End', 'Numpad1'], ['PageDown', 'Numpad3'], ['ArrowLeft', 'Numpad4'], ['Home', 'Home']])
      assert.deepEqual(await press({ key, code }, '#radius'), ['pose', '0,1.57', true], code);
    for (const more of [{ altKey: true }, { altKey: true, ctrlKey: true }, { modifierAltGraph: true }])
      for (const [key, code] of [['f', 'KeyF'], ['Home', 'Home'], ['2', 'Digit2'], ['?', 'Slash']])
        assert.deepEqual(await press({ key, code, ...more }), ['pose', '0,1.57', true], `${code} ${Object.keys(more)}`);
    assert.equal(await page.locator('#card[open]').count(), 0);
    await page.click('#view-home');
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

  await check('the rings of a handle have their size in the first picture of a nearer eye', async () => {
    const studio = await Studio.open(host);
    const { page } = studio;
    const foot = await studio.mark('foot 1');
    await page.mouse.click(foot.x, foot.y);
    await studio.settle();
    const sizes = await page.evaluate(async () => {
      const { tools, view } = window.hfStudio;
      const { gizmo } = tools.pose;
      const drawn = [];
      // as three.js has it while it draws
      gizmo.rings[0].onBeforeRender = () => drawn.push(gizmo.group.scale.x * view.pixels(1, gizmo.centre));
      view.zoomBy(0.5);
      await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      gizmo.rings[0].onBeforeRender = () => {};
      return drawn;
    });
    assert.ok(sizes.length && sizes.every((size) => Math.abs(size - 70) < 0.5), `pixels: ${sizes}`);
    await studio.close();
  });
  await check('"pull me" is read also where the body hides its place', async () => {
    const studio = await Studio.open(host);
    const { page } = studio;
    /** Whether the body lies before the mark that says it. */
    const hidden = () =>
      page.evaluate(() => {
        const { skin, tools, view } = window.hfStudio;
        const { place } = tools.pose.marks().find(({ pulse }) => pulse);
        const { x, y } = view.onScreen(place);
        const hit = skin.pick(view.ray(x, y));
        return Boolean(hit) && hit.distance < Math.hypot(...place.map((p, k) => p - view.camera.position.getComponent(k))) - 0.1 * view.size;
      });
    for (let turn = 0; turn < 6.2 && !(await hidden()); turn += 0.2) {
      await page.evaluate((turn) => (Object.assign(window.hfStudio.view, { turn }), window.hfStudio.view.draw()), turn);
      await studio.settle();
    }
    assert.ok(await hidden(), 'the body hides it from some side');
    await page.waitForTimeout(400);
    const { classes } = (await studio.marks()).find((mark) => mark.classes.includes('pulse'));
    assert.ok(!classes.includes('behind'), classes);
    await studio.close();
  });
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
