// Formats: FBX, DAE, STL and VRM are opened by loaders that no other visitor fetches, with their skins and clips; the shape is
// saved in the format it came in, or as glb with a sentence.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Studio, check, folder, passOver, require, shared } from './harness.mjs';
import { bar, chunks, dae, fbx, stlBinary, stlText, vrm } from './make_foreign.mjs';

/** The body of the page: counts, joints, clips, and how far its top goes at the end of the clip. */
const opened = () => {
  const { body, timeline, skin, opened } = window.hfStudio;
  const places = new Set(Array.from({ length: body.vertexCount }, (_, v) => body.positions.slice(3 * v, 3 * v + 3).map((x) => Math.fround(Math.round(1e4 * x) / 1e4)).join()));
  const size = [0, 1, 2].map((k) => {
    const list = Array.from({ length: body.vertexCount }, (_, v) => body.positions[3 * v + k]);
    return Math.round(100 * (Math.max(...list) - Math.min(...list))) / 100;
  });
  const found = {
    places: places.size,
    triangles: body.triangles.length / 3,
    size,
    components: opened.report.componentCount,
    joints: body.skeleton?.names ?? [],
    clips: timeline.clips.map((clip) => clip.getName()),
    notes: body.notes,
  };
  if (!found.clips.length) return found;
  timeline.seek(timeline.length * 0.999);
  const box = skin.box();
  found.bent = ['x', 'y'].map((axis) => Math.round(10 * box[axis === 'x' ? 'min' : 'max'][axis]) / 10);
  timeline.stop();
  return found;
};

export default async function story(host) {
  const seen = [];
  const studio = await Studio.open(host, { before: (page) => page.on('request', (request) => seen.push(request.url())) });
  const { page } = studio;
  const take = async (name, bytes) => {
    await page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer: Buffer.from(bytes) });
    await page.waitForFunction((name) => document.querySelector('#card[open]') || window.hfStudio.body.name === name, name, { timeout: 60000 });
    const card = await page.$eval('#card', (dialog) => (dialog.open ? dialog.textContent : ''));
    if (card) {
      await page.keyboard.press('Escape');
      throw new Error(card);
    }
    await studio.ready();
  };
  const pull = async () => {
    await page.evaluate(() => {
      const { tools, state } = window.hfStudio;
      const offer = tools.pose.offers.find(({ id }) => !state.handles.some((other) => other.id === id)) ?? tools.pose.offers[0];
      const handles = [...state.handles.filter(({ id }) => id !== offer.id), { ...offer, pinned: false, translation: [0.05, 0.3, 0] }];
      return window.hfStudio.commit({ ...state, handles }, 'pull');
    });
    await studio.settle();
  };

  await check('the loaders are not among what the first picture fetches', async () =>
    assert.deepEqual(seen.filter((url) => url.includes('loaders')), []));

  for (const [ending, bytes] of [['fbx', fbx()], ['dae', dae()]])
    await check(`${ending}: a mesh with its skin and its clip; saved as glb, and the menu says so`, async () => {
      await take(`bar.${ending}`, bytes);
      const found = await page.evaluate(opened);
      assert.equal(found.places, bar.vertexCount);
      assert.equal(found.triangles, 2 * bar.quads.length);
      assert.deepEqual(found.size, [0.5, 2, 0.5]);
      assert.equal(found.components, 1);
      assert.deepEqual([...found.joints].sort(), ['lower', 'upper']);
      assert.equal(found.clips.length, 1);
      // turned by a right angle about z the upper half lies along -x
      assert.deepEqual(found.bent, [-1, 1.3], JSON.stringify(found));
      await pull();
      await page.click('#save');
      assert.match(await page.textContent('#save-shape'), new RegExp(`${ending} is not written`));
      assert.equal(await page.locator('#save-mesh').count(), 0);
      await page.keyboard.press('Escape');
      const path = await studio.save('save-shape');
      const { issues } = await require('gltf-validator').validateBytes(new Uint8Array(readFileSync(path)));
      assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
      const { json } = chunks(readFileSync(path));
      assert.ok(json.skins.length === 1 && json.animations.length === 1);
    });
  await check('stl, text and binary: the triangles share their corners, and the shape is saved as stl', async () => {
    for (const [name, bytes] of [['text.stl', stlText()], ['binary.stl', stlBinary()]]) {
      await take(name, bytes);
      const found = await page.evaluate(opened);
      assert.deepEqual([found.places, found.triangles, found.components], [8, 12, 1]);
      assert.equal(await page.evaluate(() => window.hfStudio.body.vertexCount), 8);
    }
    await page.evaluate(() => {
      window.hfStudio.shape.positions = window.hfStudio.body.positions.map((x) => 3 * x);
    });
    const path = await studio.save('save-mesh');
    assert.match(path, /binary_posed\.stl$/);
    await take('again.stl', readFileSync(path));
    const found = await page.evaluate(opened);
    assert.deepEqual([found.places, found.triangles, found.size], [8, 12, [6, 6, 6]]);
    assert.equal(readFileSync(path).length, 84 + 50 * 12);
  });
  await check('stl: 0 and -0 are one place', async () => {
    const facet = (...corners) => `facet normal 0 0 0\nouter loop\n${corners.map((p) => `vertex ${p}`).join('\n')}\nendloop\nendfacet\n`;
    // two triangles with one edge, whose ends have a zero of either sign
    const text = `solid two\n${facet('0 0 0', '1 0 0', '0 1 0')}${facet('1 -0 0', '1 1 -0', '-0 1 0')}endsolid two\n`;
    await take('zeros.stl', text);
    assert.equal(await page.evaluate(() => window.hfStudio.body.vertexCount), 4);
  });
  await check('vrm: saved as vrm with another shape, and all else of its JSON is what it was', async () => {
    const before = vrm(readFileSync(join(folder, 'samples/biped.glb')));
    await take('biped.vrm', before);
    await pull();
    const path = await studio.save('save-mesh');
    assert.match(path, /biped_posed\.vrm$/);
    const [old, now] = [before, readFileSync(path)].map((bytes) => chunks(bytes));
    for (const key of ['extensions', 'extensionsUsed', 'nodes', 'skins', 'animations', 'materials', 'textures', 'images', 'samplers', 'scenes'])
      assert.deepEqual(now.json[key], old.json[key], key);
    assert.deepEqual(now.json.accessors.slice(0, old.json.accessors.length), old.json.accessors);
    assert.equal(Buffer.compare(now.binary.subarray(0, old.binary.length), old.binary), 0);
    const { issues } = await require('gltf-validator').validateBytes(new Uint8Array(readFileSync(path)));
    assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
    const shape = await page.evaluate(() => Array.from(window.hfStudio.shape.positions));
    await take('again.vrm', readFileSync(path));
    const again = await page.evaluate(() => Array.from(window.hfStudio.body.positions));
    const most = shape.reduce((far, x, i) => Math.max(far, Math.abs(x - again[i])), 0);
    assert.ok(most < 1e-4, `the shape of the file is ${most} off`);
  });
  await check('a transfer takes an fbx as its source', async () => {
    await page.evaluate(() => window.hfStudio.openSample('biped'));
    await studio.ready();
    await studio.tool('transfer');
    await page.evaluate(
      (text) => window.hfStudio.tools.transfer.open(new TextEncoder().encode(text), 'bar.fbx'),
      fbx(),
    );
    assert.equal(await page.evaluate(() => window.hfStudio.tools.transfer.source?.body.name), 'bar.fbx');
    await studio.tool('pose');
  });
  for (const name of ['data/hostile/cgal/pig.stl', 'data/hostile/trimesh/multibody.stl', 'data/hostile/assimp/invalid/box_nested_animation_4286.dae']) {
    const path = join(shared, name);
    if (!existsSync(path)) {
      passOver(name, 'the shared files are not here');
      continue;
    }
    await check(`${name} opens`, async () => {
      await studio.open(path);
      return JSON.stringify(await page.evaluate(() => [window.hfStudio.body.vertexCount, window.hfStudio.body.notes]));
    });
  }
  await check('broken files of these formats give a card that names the file, and what was open stays', async () => {
    const { name } = await page.evaluate(() => ({ name: window.hfStudio.body.name }));
    for (const [file, bytes] of [['a.fbx', 'not a file of anything'], ['b.dae', '<COLLADA'], ['c.stl', 'solid nothing\nendsolid'], ['d.vrm', 'no']]) {
      await assert.rejects(() => take(file, bytes), new RegExp(file.replace('.', '\\.')), file);
      await page.keyboard.press('Escape');
      assert.equal(await page.evaluate(() => window.hfStudio.body.name), name);
    }
  });
  await studio.close();
}
