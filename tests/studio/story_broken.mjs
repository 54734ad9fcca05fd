// Thirteen broken inputs: each gives a card with a sentence and a way on within 2 s, and what was open stays.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Studio, check, folder } from './harness.mjs';

/** A glb of given JSON and binary data. */
function glb(json, binary = Buffer.alloc(0)) {
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 32)]);
  const head = Buffer.alloc(20);
  head.write('glTF', 0);
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(20 + padded.length + (binary.length ? 8 + binary.length : 0), 8);
  head.writeUInt32LE(padded.length, 12);
  head.write('JSON', 16);
  if (!binary.length) return Buffer.concat([head, padded]);
  const chunk = Buffer.alloc(8);
  chunk.writeUInt32LE(binary.length, 0);
  chunk.write('BIN\0', 4);
  return Buffer.concat([head, padded, chunk, binary]);
}

const triangle = (places, indices = [0, 1, 2]) => {
  const binary = Buffer.concat([
    Buffer.from(Float32Array.from(places).buffer),
    Buffer.from(Uint32Array.from(indices).buffer),
  ]);
  return glb(
    {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: [0] }],
      nodes: [{ mesh: 0 }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
      buffers: [{ byteLength: binary.length }],
      bufferViews: [
        { buffer: 0, byteLength: 36 },
        { buffer: 0, byteOffset: 36, byteLength: 4 * indices.length },
      ],
      accessors: [
        { bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] },
        { bufferView: 1, componentType: 5125, count: indices.length, type: 'SCALAR' },
      ],
    },
    binary,
  );
};

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  const horse = readFileSync(join(folder, 'samples/horse.glb'));
  const inputs = [
    ['an empty file', 'a.glb', Buffer.alloc(0), /empty/],
    ['a cut file', 'b.glb', horse.subarray(0, 100000), /cut off/],
    ['a picture', 'c.png', Buffer.from('89504e470d0a1a0a', 'hex'), /not a glb/],
    [
      'glTF 1',
      'd.glb',
      Buffer.concat([Buffer.from('glTF'), Buffer.from([1, 0, 0, 0, 20, 0, 0, 0]), Buffer.alloc(8)]),
      /version 1/,
    ],
    [
      'a gltf with files beside it',
      'e.gltf',
      Buffer.from(JSON.stringify({ asset: { version: '2.0' }, buffers: [{ uri: 'mesh.bin', byteLength: 3 }] })),
      /mesh.bin/,
    ],
    [
      'a glb that needs what nobody reads',
      'f.glb',
      glb({
        asset: { version: '2.0' },
        extensionsRequired: ['EXT_of_nobody'],
        extensionsUsed: ['EXT_of_nobody'],
      }),
      /EXT_of_nobody/,
    ],
    [
      'a glb without a mesh',
      'g.glb',
      glb({ asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{}] }),
      /no triangles/,
    ],
    ['a glb without a scene', 'h.glb', glb({ asset: { version: '2.0' } }), /no scene/],
    ['a place that is not a number', 'i.glb', triangle([0, 0, 0, 1, NaN, 0, 0, 1, 0]), /Vertex 1/],
    ['a triangle of missing vertices', 'j.glb', triangle([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 7]), /vertex 7/],
    ['an obj without faces', 'k.obj', Buffer.from('v 0 0 0\nv 1 0 0\n'), /no faces/],
    [
      'a ply of points',
      'm.ply',
      Buffer.from(
        'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n',
      ),
      /no faces/,
    ],
    ['an off that ends early', 'l.off', Buffer.from('OFF\n4 2 0\n0 0 0\n1 0 0\n'), /ends within/],
  ];
  for (const [what, name, buffer, sentence] of inputs)
    await check(`${what}: a card with a sentence and a way on within 2 s; the horse stays`, async () => {
      const begin = Date.now();
      await page.setInputFiles('#file', { name, mimeType: 'application/octet-stream', buffer });
      await page.waitForSelector('#card[open]', { timeout: 2000 });
      const time = Date.now() - begin;
      const text = await page.textContent('#card');
      if (sentence) assert.match(text, sentence);
      assert.ok((await page.locator('#card button').count()) >= 2);
      assert.equal(await page.evaluate(() => window.hfStudio.body.name), 'horse.glb');
      if (name === 'b.glb') await studio.picture('card_broken');
      await page.locator('#card button').last().click();
      const said = await page.$$eval('#card p', (all) => all.map((p) => p.textContent).join(' '));
      return `${time} ms: ${said}`;
    });
  await check('after all of them the horse can be pulled', async () => {
    const box = await page.locator('.mark.pulse').boundingBox();
    await studio.drag(box.x + 22, box.y + 22, 40, -80);
    assert.equal((await studio.facts()).handles, '6');
  });
  await check('the sample of a card opens', async () => {
    await page.setInputFiles('#file', { name: 'x.glb', mimeType: 'model/gltf-binary', buffer: Buffer.alloc(0) });
    await page.waitForSelector('#card[open]');
    await page.getByRole('button', { name: 'Take the horse' }).click();
    await page.waitForFunction(() => window.hfStudio.history.past.length === 0 && window.hfStudio.skin.bvh);
  });
  await check('bones that the library refuses are not used, and the notes of the body say so', async () => {
    const found = await page.evaluate(async () => {
      const { client, body } = window.hfStudio;
      const open = async (skeleton) => {
        const { positions, triangles, fileNormals } = body;
        const { notes, proposals } = await client.ask('open', { positions, triangles, fileNormals, skeleton });
        return { notes, proposals: proposals.length };
      };
      const good = body.skeleton;
      const found = {
        good: await open(good),
        weights: await open({ ...good, weights: good.weights.map(() => NaN) }),
        rest: await open({ ...good, rest: good.rest.map(() => NaN) }),
      };
      await window.hfStudio.openSample('horse');
      return found;
    });
    assert.deepEqual(found.good.notes, []);
    const [links, handles] = [/^pieces are linked without the bones/, /^handles are proposed by shape/];
    assert.equal(found.weights.notes.length, 2);
    found.weights.notes.forEach((note, i) => assert.match(note, [links, handles][i]));
    assert.equal(found.rest.notes.length, 1);
    assert.match(found.rest.notes[0], handles);
    for (const { proposals } of Object.values(found)) assert.ok(proposals > 4, JSON.stringify(found));
    return found.weights.notes.join('; ');
  });
  await check('without hf.wasm a card says so', async () => {
    const bare = await Studio.open(host, {
      wait: false,
      before: (other) => other.route('**/hf.wasm', (route) => route.abort()),
    });
    await bare.page.waitForSelector('#card[open]', { timeout: 5000 });
    assert.ok((await bare.page.textContent('#card')).length > 40);
    await bare.close();
  });
  for (const late of [0, 1000])
    await check(`without worker.js a card says so, ${late ? 'also before the page comes' : 'and soon'}`, async () => {
      const bare = await Studio.open(host, {
        wait: false,
        before: async (other) => {
          await other.route('**/worker.js', (route) => route.abort());
          // the Worker is asked for before the page's own scripts: its failure may come first
          await other.route('**/studio.js', async (route) => {
            await new Promise((done) => setTimeout(done, late));
            await route.continue();
          });
        },
      });
      await bare.page.waitForSelector('#card[open]', { timeout: 5000 });
      assert.match(await bare.page.textContent('#card'), /Worker could not start/);
      await bare.close();
    });
  await check('a host that sends hf.wasm as some other type is taken', async () => {
    const bare = await Studio.open(host, {
      before: (other) =>
        other.route('**/*.wasm', async (route) =>
          route.fulfill({ response: await route.fetch(), headers: { 'content-type': 'application/octet-stream' } }),
        ),
    });
    assert.deepEqual(bare.complaints, []);
    await bare.close();
  });
  await check('without WebGL a card says so', async () => {
    const bare = await Studio.open(host, {
      wait: false,
      before: (other) => other.addInitScript(() => (HTMLCanvasElement.prototype.getContext = () => null)),
    });
    await bare.page.waitForSelector('#card[open]', { timeout: 5000 });
    assert.match(await bare.page.textContent('#card'), /WebGL/);
    await bare.close();
  });
  await studio.close();
}
