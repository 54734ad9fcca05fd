// Accessibility: axe finds nothing; the story of the horse by keys alone and by touch alone; every panel on desktop and phone,
// light and dark.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Studio, check, folder, require } from './harness.mjs';

const tools = ['pose', 'field', 'transfer', 'weights', 'quads', 'detail'];

async function axe(page) {
  const source = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
  await page.evaluate(source);
  return page.evaluate(async () =>
    (await window.axe.run()).violations.map(
      ({ id, nodes }) =>
        `${id}: ${nodes
          .map(({ target }) => target)
          .slice(0, 3)
          .join(' ')}`,
    ),
  );
}

/** A touch by the browser's own protocol: points of fingers over time. */
async function touch(page, steps) {
  const session = await page.context().newCDPSession(page);
  const points = (list) => list.map(([x, y], id) => ({ x, y, id }));
  await session.send('Input.dispatchTouchEvent', { type: 'touchStart', touchPoints: points(steps[0]) });
  for (const step of steps.slice(1))
    await session.send('Input.dispatchTouchEvent', { type: 'touchMove', touchPoints: points(step) });
  await session.send('Input.dispatchTouchEvent', { type: 'touchEnd', touchPoints: [] });
  await session.detach();
}
const line = (from, to, count = 8) =>
  Array.from({ length: count + 1 }, (_, i) => [
    from[0] + ((to[0] - from[0]) * i) / count,
    from[1] + ((to[1] - from[1]) * i) / count,
  ]);

/** What a finger cannot take: controls smaller than 44 pixels. A checkbox has its label. */
const tooSmall = (page) =>
  page.$$eval('button, select, input, summary', (all) =>
    all
      .map((e) => (e.type === 'checkbox' ? e.closest('label') : e))
      .filter((e) => e.offsetWidth && (e.offsetHeight < 44 || e.offsetWidth < 44))
      .map((e) => `${e.id || e.textContent} is ${e.offsetWidth}x${e.offsetHeight}`),
  );

/** What a screen reader is told: roles and names of the page, from the browser's own tree. */
async function heard(page) {
  const session = await page.context().newCDPSession(page);
  const { nodes } = await session.send('Accessibility.getFullAXTree');
  await session.detach();
  return nodes
    .filter(({ ignored, role }) => !ignored && role)
    .map(({ role, name, properties }) => ({
      role: role.value,
      name: name?.value ?? '',
      live: properties?.find((one) => one.name === 'live')?.value.value,
    }));
}

export default async function story(host) {
  for (const [where, size, more] of [
    ['desktop', [1280, 800], {}],
    ['phone', [390, 844], { hasTouch: true, isMobile: true, deviceScaleFactor: 1 }],
  ])
    for (const colorScheme of ['light', 'dark'])
      await check(`axe finds nothing in the six panels, ${where}, ${colorScheme}`, async () => {
        const studio = await Studio.open(host, { size, colorScheme, reducedMotion: 'reduce', ...more });
        const found = [];
        for (const key of tools) {
          await studio.tool(key);
          if (key === 'field') {
            await studio.page.waitForSelector('.mark.offer');
            await studio.page.evaluate(async () => {
              for (const mark of window.hfStudio.tools.field.marks().slice(0, 3))
                await window.hfStudio.tools.field.choose(mark);
            });
          }
          if (key === 'transfer') {
            await studio.page.click('#take-bull');
            await studio.page.waitForFunction(() => window.hfStudio.tools.transfer?.info);
          }
          found.push(...(await axe(studio.page)).map((text) => `${key}: ${text}`));
          await studio.picture(`panel_${key}_${where}_${colorScheme}`);
          const wide = await studio.page.evaluate(
            () =>
              Math.max(
                ...['top', 'stage', 'sheet', 'rail', 'timeline'].map(
                  (id) => document.getElementById(id).getBoundingClientRect().right,
                ),
              ) - innerWidth,
          );
          if (wide > 0) found.push(`${key}: the page is ${wide} pixels too wide`);
          if (more.isMobile) found.push(...(await tooSmall(studio.page)).map((text) => `${key}: ${text}`));
        }
        await studio.page.click('#help');
        found.push(...(await axe(studio.page)).map((text) => `help: ${text}`));
        await studio.picture(`panel_help_${where}_${colorScheme}`);
        await studio.close();
        assert.deepEqual(found, []);
      });

  await check(
    'by keys alone: a proposed handle is reached, moved, turned, pinned, removed, and all is taken back',
    async () => {
      const studio = await Studio.open(host);
      const { page } = studio;
      const press = async (key, times = 1) => {
        for (let i = 0; i < times; ++i) await page.keyboard.press(key);
        await studio.settle();
      };
      for (let i = 0; i < 40; ++i) {
        await page.keyboard.press('Tab');
        if ((await page.evaluate(() => document.activeElement.getAttribute('aria-label') ?? '')).includes('proposed'))
          break;
      }
      const start = await page.evaluate(() => window.hfStudio.state.handles.length);
      await press('ArrowUp', 5);
      await page.waitForTimeout(800);
      const moved = await page.evaluate(() => window.hfStudio.state.handles.at(-1));
      assert.equal(await page.evaluate(() => window.hfStudio.state.handles.length), start + 1);
      assert.ok(Math.hypot(...moved.translation) > 0.05);
      await press(']', 2);
      assert.ok((await page.evaluate(() => window.hfStudio.state.handles.at(-1).rotation[3])) < 0.999);
      await press('p');
      assert.equal(await page.evaluate(() => window.hfStudio.state.handles.at(-1).pinned), true);
      await press('Delete');
      assert.equal(await page.evaluate(() => window.hfStudio.state.handles.length), start);
      for (let i = 0; i < 12; ++i) await press('Control+z');
      assert.equal(await page.evaluate(() => window.hfStudio.history.past.length), 0);
      await press('2');
      assert.equal(await page.getAttribute('#tool-field', 'aria-selected'), 'true');
      await page.keyboard.press('Control+s');
      await page.waitForSelector('#save-shape');
      await page.keyboard.press('Escape');
      await page.close();
    },
  );

  await check('a screen reader hears every control by its name, the handles one by one, and what was done', async () => {
    const studio = await Studio.open(host);
    const { page } = studio;
    const controls = /^(button|tab|slider|checkbox|radio|combobox|textbox|spinbutton)$/i;
    for (const key of tools) {
      await studio.tool(key);
      const nameless = (await heard(page)).filter(({ role, name }) => controls.test(role) && !/\w/.test(name));
      assert.deepEqual(nameless, [], key);
    }
    await studio.tool('pose');
    const buttons = (await heard(page)).filter(({ role }) => role === 'button').map(({ name }) => name);
    const marks = (await studio.marks()).map(({ label }) => label);
    assert.ok(marks.length >= 5 && new Set(marks).size === marks.length, marks.join('; '));
    for (const label of marks) assert.ok(buttons.includes(label), label);
    assert.equal((await heard(page)).filter(({ role, live }) => role === 'status' && live === 'polite').length, 1);
    const box = await page.locator('.mark.pulse').boundingBox();
    await studio.drag(box.x + 22, box.y + 22, 30, -60);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => /^taken back: \w/.test(document.getElementById('told').textContent));
    await studio.close();
    return `${marks.length} handles: ${marks.join('; ')}`;
  });

  await check('a file that is dropped on the page opens', async () => {
    const studio = await Studio.open(host);
    const { page } = studio;
    const session = await page.context().newCDPSession(page);
    const data = { items: [], files: [join(folder, 'samples/bull.glb')], dragOperationsMask: 1 };
    for (const type of ['dragEnter', 'dragOver']) await session.send('Input.dispatchDragEvent', { type, x: 500, y: 400, data });
    await page.waitForSelector('#drop:not([hidden])');
    await session.send('Input.dispatchDragEvent', { type: 'drop', x: 500, y: 400, data });
    await page.waitForFunction(() => window.hfStudio.body?.name === 'bull.glb');
    await studio.ready();
    assert.ok(await page.locator('#drop').isHidden());
    await studio.close();
  });

  await check('a small phone has all of the bar; a long name of a file is cut off nowhere', async () => {
    for (const size of [
      [320, 640],
      [360, 740],
      [1280, 800],
    ]) {
      const phone = size[0] < 720 ? { hasTouch: true, isMobile: true } : {};
      const studio = await Studio.open(host, { size, ...phone });
      const told = await studio.page.evaluate(() => {
        const app = window.hfStudio;
        const { card, make } = app.ui;
        const name = `${'a_long_name_of_a_body_'.repeat(4)}.glb`;
        app.warn(`${name} is not here`);
        card(`The last session with ${name} is not whole`, [make('p', {}, `${name} has other vertices`)], [['Close', null]]);
        const boxes = [...document.querySelectorAll('#top button, #top select, #told, #matters, #card')].filter(
          (element) => element.checkVisibility(),
        );
        const cut = boxes.filter((element) => {
          const { left, right } = element.getBoundingClientRect();
          return left < 0 || right > document.documentElement.clientWidth || element.scrollWidth > element.clientWidth + 1;
        });
        return { count: boxes.length, cut: cut.map(({ id }) => id), wide: [innerWidth, document.documentElement.scrollWidth] };
      });
      assert.ok(told.count >= 8, `${told.count} boxes`);
      assert.deepEqual(told.cut, [], `at ${size[0]} pixels`);
      assert.deepEqual(told.wide, [size[0], size[0]]);
      await studio.picture(`long_name_${size[0]}`, { kept: false });
      await studio.close();
    }
  });

  await check('by touch alone on a phone: pull, add a handle, turn and pinch the view, put a site', async () => {
    const studio = await Studio.open(host, { size: [390, 844], hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
    const { page } = studio;
    const box = await page.locator('.mark.pulse').boundingBox();
    const at = [box.x + 22, box.y + 22];
    await touch(
      page,
      line(at, [at[0] + 20, at[1] - 60]).map((point) => [point]),
    );
    await studio.settle();
    const moved = await page.evaluate(() => window.hfStudio.state.handles.at(-1).translation);
    assert.ok(Math.hypot(...moved) > 0.1, `translation ${moved}`);
    const canvas = await page.locator('#canvas').boundingBox();
    const before = await page.evaluate(() => [window.hfStudio.view.turn, window.hfStudio.view.distance]);
    await touch(
      page,
      line([20, canvas.y + 90], [60, canvas.y + 90]).map((point) => [point]),
    );
    // beside the body, where no handle and no button is
    const middle = [canvas.x + canvas.width - 30, canvas.y + 150];
    await touch(
      page,
      [40, 60, 80, 110].map((d) => [
        [middle[0], middle[1] - d],
        [middle[0], middle[1] + d],
      ]),
    );
    const after = await page.evaluate(() => [window.hfStudio.view.turn, window.hfStudio.view.distance]);
    assert.ok(after[0] !== before[0] && after[1] < before[1], `${before} to ${after}`);
    await page.locator('#tool-field').tap();
    await studio.settle();
    const spots = await studio.spots(16);
    await page.touchscreen.tap(spots[3][0], spots[3][1]);
    await studio.settle();
    assert.equal(await page.evaluate(() => window.hfStudio.state.sites.length), 1);
    assert.deepEqual(await tooSmall(page), []);
    await studio.picture('touch_phone', { kept: false });
    await studio.close();
  });
}
