// Compressed glTF: files by Draco and meshopt are read, pulled and saved plain; pictures in KTX2 stay in the file as they are.
// tests/studio/make_compressed.mjs made the files.
import assert from 'node:assert/strict';
import { existsSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { Studio, check, passOver, require, shared } from './harness.mjs';

const data = join(dirname(fileURLToPath(import.meta.url)), 'data');
/** Vertices and triangles of the ring in the three files. */
const [VERTICES, TRIANGLES] = [1152, 2304];

const jsonOf = (bytes) => JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString());

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  for (const [name, extension] of [
    ['ring_draco', 'KHR_draco_mesh_compression'],
    ['ring_meshopt', 'EXT_meshopt_compression'],
  ])
    await check(`${name}.glb opens, is pulled, and is saved without compression as a valid glb`, async () => {
      const path = join(data, `${name}.glb`);
      assert.ok(jsonOf(readFileSync(path)).extensionsRequired.includes(extension));
      await studio.open(path);
      const { vertices, triangles, box } = await page.evaluate(() => {
        const { body, skin } = window.hfStudio;
        const { min, max } = skin.box(body.positions);
        return { vertices: body.vertexCount, triangles: body.triangles.length / 3, box: max.sub(min).toArray() };
      });
      // Draco may give corners on seams a vertex of their own
      assert.ok(vertices >= VERTICES && triangles === TRIANGLES, `${vertices} vertices, ${triangles} triangles`);
      [2.75, 0.9, 2.6].forEach((size, k) => assert.ok(Math.abs(box[k] - size) < 0.1, `box ${box}`));
      const spots = await studio.spots();
      await page.mouse.click(spots[0][0], spots[0][1]);
      await studio.settle();
      await page.mouse.click(spots.at(-1)[0], spots.at(-1)[1]);
      await studio.settle();
      const mark = (await studio.marks()).find(({ classes }) => / chosen/.test(classes));
      await studio.drag(mark.x, mark.y, 40, -40);
      const saved = readFileSync(await studio.save('save-shape'));
      assert.ok(!(jsonOf(saved).extensionsUsed ?? []).includes(extension));
      const { issues } = await require('gltf-validator').validateBytes(new Uint8Array(saved));
      assert.equal(issues.numErrors, 0, JSON.stringify(issues.messages.slice(0, 3)));
      return `${vertices} vertices, ${issues.numWarnings} warnings`;
    });
  await check('a picture in KTX2 is not shown, which is said, and is saved byte for byte', async () => {
    const path = join(data, 'ring_ktx2.glb');
    await studio.open(path);
    assert.match(await studio.told(), /KTX2 stay in the file/);
    const saved = readFileSync(await studio.save('save-shape'));
    const pictureOf = (bytes) => {
      const json = jsonOf(bytes);
      assert.ok(json.extensionsUsed.includes('KHR_texture_basisu'));
      const { byteOffset = 0, byteLength } = json.bufferViews[json.images[0].bufferView];
      const start = 28 + bytes.readUInt32LE(12) + byteOffset;
      return bytes.subarray(start, start + byteLength).toString('hex');
    };
    assert.equal(pictureOf(saved), pictureOf(readFileSync(path)));
  });
  await check(
    'a compressed file whose decoder cannot be loaded is refused by a sentence, and the body stays',
    async () => {
      const other = await Studio.open(host);
      await other.page.route('**/draco/*', (route) => route.abort());
      await other.page.setInputFiles('#file', join(data, 'ring_draco.glb'));
      await other.page.waitForSelector('#card[open]');
      assert.match(await other.page.textContent('#card'), /compressed .*could not be loaded/);
      assert.equal(await other.page.evaluate(() => window.hfStudio.body.name), 'horse.glb');
      await other.close();
    },
  );
  await check('compressed bytes that are damaged are refused by a sentence', async () => {
    for (const name of ['ring_draco', 'ring_meshopt']) {
      const bytes = readFileSync(join(data, `${name}.glb`));
      bytes.fill(0xff, 28 + bytes.readUInt32LE(12) + 20, 28 + bytes.readUInt32LE(12) + 1200);
      await page.setInputFiles('#file', { name: 'damaged.glb', mimeType: 'model/gltf-binary', buffer: bytes });
      await page.waitForFunction(
        () => document.querySelector('#card[open]') || window.hfStudio.body.name === 'damaged.glb',
      );
      assert.match(await page.textContent('#card[open]'), /damaged.glb was not opened/, name);
      await page.keyboard.press('Escape');
      assert.equal(await page.evaluate(() => window.hfStudio.body.name), 'ring_ktx2.glb');
    }
  });
  const pirate = join(shared, 'data/gltf/pirate.glb');
  if (!existsSync(pirate))
    passOver('a file by another program, meshopt and quantised', 'the shared files are not here');
  else
    await check('a file by another program, meshopt and quantised, opens', async () => {
      await studio.open(pirate);
      await studio.picture('compressed_pirate', { kept: false });
      return `${await page.evaluate(() => window.hfStudio.body.vertexCount)} vertices`;
    });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
