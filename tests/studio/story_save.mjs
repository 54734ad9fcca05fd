// Save: every glb has no error in the Khronos validator, and opens again as it was.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { meshFile } from '../../samples/studio/src/mesh_save.js';
import { readMesh } from '../../samples/studio/src/mesh_files.js';
import { Studio, check, require } from './harness.mjs';

/** The first picture of a film comes so late: as it did at a load of 12. */
const FILM_LATE_MS = 1500;

async function validated(path) {
  const { issues } = await require('gltf-validator').validateBytes(new Uint8Array(readFileSync(path)));
  assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
  return issues;
}

function glbOf(path) {
  const bytes = readFileSync(path);
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.subarray(20, 20 + length).toString()), bytes, start: 28 + length };
}
/** An accessor of three floats for each vertex. */
function floats({ json, bytes, start }, number) {
  const { bufferView, byteOffset = 0, count, type, componentType } = json.accessors[number];
  const { byteOffset: viewOffset = 0, byteStride = 12 } = json.bufferViews[bufferView];
  assert.ok(componentType === 5126 && type === 'VEC3');
  const at = start + viewOffset + byteOffset;
  return Float32Array.from({ length: 3 * count }, (_, i) =>
    bytes.readFloatLE(at + byteStride * Math.floor(i / 3) + 4 * (i % 3)),
  );
}

/** A sheet of triangles, as the text of an obj. */
function sheetObj(side) {
  const lines = [];
  for (let y = 0; y <= side; ++y) for (let x = 0; x <= side; ++x) lines.push(`v ${x / side} ${0.1 * Math.sin(x)} ${y / side}`);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const a = y * (side + 1) + x + 1;
      lines.push(`f ${a} ${a + side + 1} ${a + 1}`, `f ${a + 1} ${a + side + 1} ${a + side + 2}`);
    }
  return `${lines.join('\n')}\n`;
}

export default async function story(host) {
  await check('obj, off and ply are written so that they read back bit for bit, strips are read too', async () => {
    const positions = Float32Array.from([0, 0, 0, 1, 0, 0.5, 0, 1.1, 0, 1e-9, 2, -3]);
    const triangles = Uint32Array.from([0, 1, 2, 2, 1, 3]);
    for (const format of ['obj', 'off', 'ply']) {
      const data = meshFile(format, positions, triangles);
      const back = await readMesh(typeof data === 'string' ? new TextEncoder().encode(data) : data, `a.${format}`);
      assert.deepEqual([back.positions, back.triangles], [positions, triangles], format);
    }
    const strips =
      'ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n' +
      'property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 1 4 3\n';
    const read = await readMesh(new TextEncoder().encode(strips), 'strips.ply');
    assert.deepEqual([...read.triangles], [0, 1, 2, 1, 3, 2, 1, 4, 3]);
    return '3 formats';
  });
  const studio = await Studio.open(host);
  const { page } = studio;
  const box = await page.locator('.mark.pulse').boundingBox();
  await studio.drag(box.x + 22, box.y + 22, 60, -140);
  const posed = await page.evaluate(() => Array.from(window.hfStudio.shape.positions));
  let path;
  await check('the saved shape is a valid glb', async () => {
    await page.click('#save');
    await studio.picture('save_menu');
    await page.click('#card .row button');
    path = await studio.save('save-shape');
    const { numWarnings } = await validated(path);
    return `${numWarnings} warnings`;
  });
  await check('it opens again with the same places, its skin, clips and texture coordinates', async () => {
    const before = await page.evaluate(() => {
      const { body } = window.hfStudio;
      return [
        body.clips.length,
        body.parts[0].skin.listJoints().length,
        body.parts[0].primitive.listSemantics().sort().join(),
      ];
    });
    await page.setInputFiles('#file', path);
    await page.waitForFunction(() => window.hfStudio.body.name === 'horse_posed.glb' && window.hfStudio.skin.bvh);
    const after = await page.evaluate(() => {
      const { body } = window.hfStudio;
      return [
        [
          body.clips.length,
          body.parts[0].skin.listJoints().length,
          body.parts[0].primitive.listSemantics().sort().join(),
        ],
        Array.from(body.positions),
        window.hfStudio.view.size,
      ];
    });
    assert.deepEqual(after[0], before);
    const worst = posed.reduce((most, x, i) => Math.max(most, Math.abs(x - after[1][i])), 0);
    assert.ok(worst < 1e-5 * after[2], `a place differs by ${worst}`);
    return `largest difference ${(worst / after[2]).toExponential(1)} of the body`;
  });
  await check('a body that came as an obj is saved as an obj, with its vertices in their order', async () => {
    const text = sheetObj(12);
    await page.setInputFiles('#file', { name: 'sheet.obj', mimeType: 'text/plain', buffer: Buffer.from(text) });
    await page.waitForFunction(() => window.hfStudio.body.name === 'sheet.obj' && window.hfStudio.skin.bvh);
    const back = await readMesh(readFileSync(await studio.save('save-mesh')), 'back.obj');
    const given = await readMesh(Buffer.from(text), 'given.obj');
    assert.deepEqual(back.triangles, given.triangles);
    assert.deepEqual(back.positions, await page.evaluate(() => Array.from(window.hfStudio.shape.positions)).then((x) => Float32Array.from(x)));
    return `${given.positions.length / 3} vertices`;
  });
  await check('the rig by handles is valid, and its clip ends in the pose', async () => {
    await page.selectOption('#sample', 'horse');
    await page.waitForFunction(() => window.hfStudio.body.name === 'horse.glb' && window.hfStudio.skin.bvh);
    const again = await page.locator('.mark[aria-label*="proposed"]').first().boundingBox();
    await studio.drag(again.x + 22, again.y + 22, 60, -140);
    const shape = await page.evaluate(() => Array.from(window.hfStudio.shape.positions));
    const rigged = await studio.save('save-rig');
    await validated(rigged);
    await page.setInputFiles('#file', rigged);
    await page.waitForFunction(() => window.hfStudio.body.name === 'horse_rigged.glb' && window.hfStudio.skin.bvh);
    await page.locator('#scrub').fill('1');
    await studio.settle();
    const [played, size] = await page.evaluate(() => [
      Array.from(window.hfStudio.skin.positions),
      window.hfStudio.view.size,
    ]);
    const worst = shape.reduce((most, x, i) => Math.max(most, Math.abs(x - played[i])), 0) / size;
    assert.ok(worst < 0.03, `a place differs by ${worst} of the body`);
    return `largest difference ${(100 * worst).toFixed(2)} % of the body`;
  });
  await check('the pose is saved as a morph target: valid, and rest and target give the pose', async () => {
    await page.selectOption('#sample', 'horse');
    await page.waitForFunction(() => window.hfStudio.body.name === 'horse.glb' && window.hfStudio.skin.bvh);
    const dot = await page.locator('.mark[aria-label*="proposed"]').first().boundingBox();
    await studio.drag(dot.x + 22, dot.y + 22, 60, -140);
    const [morph, baked] = [await studio.save('save-morph'), await studio.save('save-shape')];
    await validated(morph);
    const [a, b] = [glbOf(morph), glbOf(baked)];
    const worst = a.json.meshes[0].primitives.reduce((most, { attributes, targets }, i) => {
      assert.equal(targets.length, 1);
      const [rest, way] = [floats(a, attributes.POSITION), floats(a, targets[0].POSITION)];
      const pose = floats(b, b.json.meshes[0].primitives[i].attributes.POSITION);
      return rest.reduce((m, x, k) => Math.max(m, Math.abs(x + way[k] - pose[k])), most);
    }, 0);
    assert.ok(worst < 1e-5, `a place differs by ${worst}`);
    const clip = a.json.animations.find(({ name }) => name === 'pose');
    assert.equal(clip.channels[0].target.path, 'weights');
    assert.equal(a.json.skins.length, b.json.skins.length);
    // keys: one target for each
    await page.click('#key');
    await studio.settle();
    await page.locator('#scrub').fill('0.5');
    await studio.settle();
    await page.click('#key');
    await studio.settle();
    const keyed = await studio.save('save-morph');
    await validated(keyed);
    assert.equal(glbOf(keyed).json.meshes[0].primitives[0].targets.length, 2);
    return `largest difference ${worst.toExponential(1)}`;
  });
  await check('new weights are saved into the skin of the file', async () => {
    await page.selectOption('#sample', 'bull');
    await page.waitForFunction(() => window.hfStudio.body.name === 'bull.glb' && window.hfStudio.skin.bvh);
    await studio.tool('weights');
    await page.click('#compute');
    await page.waitForFunction(() => window.hfStudio.tools.weights?.result);
    await validated(await studio.save('save-weights'));
  });
  await check('a picture is saved', async () => {
    const bytes = readFileSync(await studio.save('save-picture'));
    assert.ok(bytes.length > 10000 && bytes.subarray(1, 4).toString() === 'PNG');
  });
  await check('a film of six seconds is saved: webm with pictures that move, also where the first one comes late', async () => {
    await page.evaluate((late) => {
      const { start } = MediaRecorder.prototype;
      MediaRecorder.prototype.start = function (...given) {
        this.addEventListener('start', () => {
          const begin = performance.now();
          while (performance.now() - begin < late);
        });
        return start.apply(this, given);
      };
    }, FILM_LATE_MS);
    const path = await studio.save('save-film');
    const bytes = readFileSync(path);
    assert.equal(bytes.subarray(0, 4).toString('hex'), '1a45dfa3');
    const told = await page.evaluate(async (base64) => {
      const video = document.createElement('video');
      video.src = `data:video/webm;base64,${base64}`;
      video.muted = true;
      await new Promise((resolve, reject) => ((video.onloadeddata = resolve), (video.onerror = reject)));
      // a recorded webm knows its length when its end was seen
      video.currentTime = 1e6;
      await new Promise((resolve) => (video.onseeked = resolve));
      const seconds = video.currentTime;
      const canvas = new OffscreenCanvas(160, 100);
      const paint = canvas.getContext('2d', { willReadFrequently: true });
      const shots = [];
      for (const time of [0.5, 2.3]) {
        video.currentTime = time;
        await new Promise((resolve) => (video.onseeked = resolve));
        // the picture comes a moment after the place
        for (let wait = 0; wait < 50; ++wait) {
          paint.drawImage(video, 0, 0, 160, 100);
          if (paint.getImageData(0, 0, 1, 1).data[0] > 0) break;
          await new Promise((resolve) => setTimeout(resolve, 40));
        }
        shots.push(paint.getImageData(0, 0, 160, 100).data);
      }
      const moved = shots[0].reduce((sum, x, i) => sum + (Math.abs(x - shots[1][i]) > 24), 0);
      return { moved, seconds, corner: Array.from(shots[0].slice(0, 3)) };
    }, bytes.toString('base64'));
    assert.ok(told.moved > 100, `${told.moved} values differ`);
    assert.ok(told.seconds > 5 && told.seconds < 8, `${told.seconds} s`);
    assert.ok(Math.min(...told.corner) > 200, `the ground is ${told.corner}`);
    return `${told.seconds.toFixed(1)} s, ${(bytes.length / 1e6).toFixed(2)} MB`;
  });
  await check('a link holds handles, keys, the tool and the view', async () => {
    await page.selectOption('#sample', 'bull');
    await page.waitForFunction(
      () => window.hfStudio.body.name === 'bull.glb' && window.hfStudio.history.past.length === 0,
    );
    await studio.tool('pose');
    await studio.settle();
    const dot = await page.locator('.mark[aria-label*="proposed"]').first().boundingBox();
    await studio.drag(dot.x + 22, dot.y + 22, 40, -60);
    await page.evaluate(() => window.hfStudio.view.turnBy(60, 10));
    await page.click('#save');
    await page.click('#save-link');
    const link = await page.inputValue('#link');
    // the port of the server is another in every run
    await page.evaluate(() => (document.getElementById('link').value = 'https://example.org/?sample=bull#s='));
    await studio.picture('save_link');
    await page.keyboard.press('Escape');
    const state = await page.evaluate(() => JSON.stringify([window.hfStudio.state, window.hfStudio.view.turn]));
    const other = await Studio.open(host, { query: new URL(link).search.slice(1) + new URL(link).hash });
    await other.page.waitForFunction(() => /as in the link/.test(document.getElementById('told').textContent));
    assert.equal(
      await other.page.evaluate(() => JSON.stringify([window.hfStudio.state, window.hfStudio.view.turn])),
      state,
    );
    assert.deepEqual(other.complaints, []);
    await other.close();
    return `${link.length} letters`;
  });
  await check('a link opens each tool as it was: mirror, quads, weights, another body with its dials', async () => {
    await page.selectOption('#mirror', '0');
    await studio.tool('quads');
    await page.locator('#count').fill('9');
    await page.selectOption('#mirror', '0');
    await studio.tool('weights');
    await page.selectOption('#weight-count', '8');
    await page.selectOption('#bone', { index: 4 });
    await studio.tool('transfer');
    await page.click('#take-horse');
    await page.waitForFunction(() => window.hfStudio.tools.transfer.info);
    await page.click('#dials summary');
    await page.locator('#dial-stride').fill('1.5');
    await studio.settle();
    await page.click('#save');
    await page.click('#save-link');
    const link = await page.inputValue('#link');
    await page.keyboard.press('Escape');
    const of = (other) =>
      other.page.evaluate(() => {
        const { tools, tool } = window.hfStudio;
        return JSON.stringify([
          tool.constructor.key,
          ...['pose', 'quads', 'weights', 'transfer'].map((key) => tools[key]?.settings()),
        ]);
      });
    const settings = await of(studio);
    const other = await Studio.open(host, { query: new URL(link).search.slice(1) + new URL(link).hash });
    await other.page.waitForFunction(() => /as in the link/.test(document.getElementById('told').textContent));
    assert.equal(await of(other), settings);
    assert.match(settings, /"stride":1.5/);
    assert.deepEqual(other.complaints, []);
    await other.close();
    return `${link.length} letters`;
  });
  await check('a damaged link says so, and the sample opens', async () => {
    const other = await Studio.open(host, { query: 'sample=bull#s=abcd' });
    assert.equal(await other.page.evaluate(() => window.hfStudio.body.name), 'bull.glb');
    assert.deepEqual(other.complaints, []);
    await other.close();
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
