// Quads: made in a Worker of their own, with counts; cancelled; they follow a pose, strokes and poles.
import assert from 'node:assert/strict';
import { Studio, check } from './harness.mjs';

/** A cube of 6 n n squares as an obj file. */
function cube(n) {
  const places = new Map();
  const [vertices, faces] = [[], []];
  const at = (...p) => {
    const key = p.join();
    if (!places.has(key)) (vertices.push(p), places.set(key, vertices.length));
    return places.get(key);
  };
  for (let axis = 0; axis < 3; ++axis)
    for (const side of [0, n])
      for (let i = 0; i < n; ++i)
        for (let j = 0; j < n; ++j) {
          const corner = (a, b) => {
            const p = [];
            [p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]] = [side, i + a, j + b];
            return at(...p);
          };
          const face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
          faces.push(side ? face : face.reverse());
        }
  return `${vertices.map((p) => `v ${p.join(' ')}`).join('\n')}\n${faces.map((f) => `f ${f.join(' ')}`).join('\n')}\n`;
}

export default async function story(host) {
  const studio = await Studio.open(host);
  const { page } = studio;
  // the mesh is relaxed, and that of the strokes and poles that are there
  const still = async () => {
    await page.waitForFunction(() => {
      const { tools, live, state } = window.hfStudio;
      return !live && !tools.quads.following && tools.quads.relaxed && tools.quads.shows(state);
    });
    await studio.settle();
  };
  // where the middle of the trunk is on the screen
  const trunk = async () => {
    const middle = await page.evaluate(() => {
      const { skin, view } = window.hfStudio;
      const box = skin.box();
      const { x, y } = view.onScreen([0, 1, 2].map((k) => (box.min.getComponent(k) + box.max.getComponent(k)) / 2));
      return [x, y];
    });
    const canvas = await page.locator('canvas').boundingBox();
    return [canvas.x + middle[0], canvas.y + middle[1] - 20];
  };
  await studio.tool('quads');
  await check('the size is a count: about so many quads come, and none of the bodies starts with edges wider than its thin parts', async () => {
    const said = await page.textContent('label:has(#count)');
    assert.match(said, /about [\d,]+$/);
    const { count, edge } = await page.evaluate(() => {
      const { count, edge } = window.hfStudio.tools.quads;
      return { count, edge };
    });
    assert.ok(count >= 1500 && count <= 3000, `${count}`);
    await page.click('#make');
    await page.waitForFunction(() => window.hfStudio.tools.quads?.result && !window.hfStudio.tools.quads.busy);
    const { faceCount } = await page.evaluate(() => window.hfStudio.tools.quads.result.info);
    assert.ok(faceCount > 0.8 * count && faceCount < 1.2 * count, `${faceCount} of about ${count}`);
    await studio.picture('quads_first', { kept: false });
    await page.locator('#count').fill('9.9');
    return `${faceCount} of about ${count}, edge ${edge.toFixed(4)}`;
  });
  await check('quads are made and counted, and every face has four corners', async () => {
    await page.click('#make');
    await page.waitForFunction(() => window.hfStudio.tools.quads?.busy);
    await page.waitForFunction(() => window.hfStudio.tools.quads?.result && !window.hfStudio.tools.quads.busy, null, { timeout: 60000 });
    await studio.settle();
    const facts = await studio.facts();
    assert.ok(Number(facts.quads.replace(/,/g, '')) > 300, JSON.stringify(facts));
    const four = await page.evaluate(() => {
      const { mesh, info } = window.hfStudio.tools.quads.result;
      let count = 0;
      for (let i = 0; i < mesh.faces.length; i += 4) count += new Set(mesh.faces.subarray(i, i + 4)).size === 4;
      return [count, info.faceCount];
    });
    assert.equal(four[0], four[1]);
    await studio.picture('quads_made');
  });
  await check('the first form is shown while it is evened out; a cancel keeps what is shown, and the next run works', async () => {
    const before = await studio.facts();
    await page.locator('#count').fill('13');
    await page.click('#make');
    await page.waitForSelector('#cancel');
    const count = () => page.evaluate(() => window.hfStudio.tools.quads.result.info.faceCount);
    // pressed in the page: on a busy machine the mouse can come after the end
    const pressed = await page.waitForFunction((old) => {
      const { quads } = window.hfStudio.tools;
      const { faceCount } = quads.result.info;
      if (faceCount <= 2 * old || !quads.busy || quads.relaxed) return 0;
      document.getElementById('cancel').click();
      return faceCount;
    }, Number(before.quads.replace(/,/g, '')));
    const shown = await pressed.jsonValue();
    await studio.settle();
    await page.waitForTimeout(500);
    assert.equal(await count(), shown);
    assert.equal((await studio.facts()).quads, shown.toLocaleString('en'));
    await page.locator('#count').fill('9');
    await page.click('#make');
    await page.waitForFunction(
      (old) => !document.querySelector('#cancel') && window.hfStudio.tools.quads?.result.info.faceCount !== old,
      Number(before.quads.replace(/,/g, '')),
      { timeout: 60000 },
    );
  });
  await check('a cancel while the Worker opens is taken, and who asks meanwhile waits', async () => {
    const error = await page.evaluate(async () => {
      const { quads } = window.hfStudio.tools;
      quads.opened(); // no Worker
      const first = quads.run();
      quads.cancel();
      await Promise.all([first, quads.run(), quads.run()]);
      return quads.error;
    });
    assert.equal(error, null);
    await studio.settle();
  });
  await check('the quads lie on the body in a pose', async () => {
    await studio.tool('pose');
    const box = await page.locator('.mark.pulse').boundingBox();
    await studio.drag(box.x + 22, box.y + 22, 60, -140);
    await studio.tool('quads');
    const away = await page.evaluate(() => {
      const { tools, shape, view } = window.hfStudio;
      const { corners, barycentrics } = tools.quads.result.mesh;
      const place = tools.quads.lines.geometry.getAttribute('position').array;
      let most = 0;
      for (let v = 0; v < corners.length / 3; ++v) {
        const at = [0, 1, 2].map((k) =>
          [0, 1, 2].reduce((sum, i) => sum + barycentrics[3 * v + i] * shape.positions[3 * corners[3 * v + i] + k], 0),
        );
        most = Math.max(most, Math.hypot(...at.map((x, k) => x - place[3 * v + k])));
      }
      return most / view.size;
    });
    assert.ok(away < 0.005, `${away} of the body`);
    // thin lines show the last digits of a pose: bits that do not depend on how quick the drag was
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+Shift+z');
    await studio.settle();
    await studio.picture('quads_posed');
  });
  await check('a stroke that is drawn and dragged turns the quads, live; undo brings them back', async () => {
    const seen = () =>
      page.evaluate(() => {
        const { tools, body, state } = window.hfStudio;
        const { positions, faces } = tools.quads.result.mesh;
        const place = ({ corners, barycentrics }) =>
          [0, 1, 2].map((k) => corners.reduce((sum, v, i) => sum + barycentrics[i] * body.positions[3 * v + k], 0));
        const strokes = (state.strokes ?? []).map(({ places }) => places.map(place));
        const at = (v) => Array.from(positions.subarray(3 * v, 3 * v + 3));
        const less = (a, b) => a.map((x, k) => x - b[k]);
        const length = (a) => Math.hypot(...a);
        // the mean angle between a stroke and the nearest edges of quads, in degrees
        const off = strokes.map((points) => {
          let [sum, count] = [0, 0];
          const near = length(less(points[0], points.at(-1))) / 6;
          for (let i = 0; i < faces.length; ++i) {
            const a = at(faces[i]);
            const edge = less(at(faces[i % 4 === 3 ? i - 3 : i + 1]), a);
            const nearest = points.reduce(
              (best, p, k) => (length(less(p, a)) < length(less(points[best], a)) ? k : best),
              0,
            );
            const [p, q] = [Math.max(0, nearest - 1), Math.min(points.length - 1, nearest + 1)];
            if (length(less(points[nearest], a)) > near) continue;
            const way = less(points[q], points[p]);
            const cosine = Math.abs(edge.reduce((x, e, k) => x + e * way[k], 0)) / (length(edge) * length(way));
            const angle = (Math.acos(Math.min(1, cosine)) * 180) / Math.PI;
            [sum, count] = [sum + Math.min(angle, 90 - angle), count + 1];
          }
          return sum / count;
        });
        return {
          strokes: strokes.length,
          off,
          count: faces.length / 4,
          followed: tools.quads.followed,
          mesh: positions.join(),
        };
      });
    await studio.tool('pose');
    await page.keyboard.press('Control+z');
    await studio.tool('quads');
    await page.locator('#count').fill('9.9');
    await page.click('#make');
    await page.waitForFunction(() => !document.querySelector('#cancel'), null, { timeout: 60000 });
    const before = await seen();
    await page.click('#draw');
    assert.equal(await page.getAttribute('#draw', 'aria-pressed'), 'true');
    // over the trunk, slanting
    const [x, y] = await trunk();
    await studio.drag(x - 55, y + 35, 110, -70);
    await still();
    const drawn = await seen();
    assert.equal(drawn.strokes, 1);
    assert.ok(drawn.followed > before.followed, 'no mesh was made while the stroke was drawn');
    assert.ok(drawn.off[0] < 15, `${drawn.off[0]} degrees off the stroke`);
    await studio.picture('quads_stroke');
    // its dot is dragged
    const dot = await page.locator('.mark').first().boundingBox();
    await studio.drag(dot.x + dot.width / 2, dot.y + dot.height / 2, 40, 25);
    await still();
    const moved = await seen();
    assert.ok(moved.followed > drawn.followed, 'no mesh was made while the stroke was dragged');
    assert.notEqual(moved.mesh, drawn.mesh);
    assert.ok(moved.off[0] < 18, `${moved.off[0]} degrees off the moved stroke`);
    await page.keyboard.press('Control+z');
    await still();
    assert.equal((await seen()).mesh, drawn.mesh);
    await page.keyboard.press('Control+z');
    await still();
    const back = await seen();
    assert.equal(back.strokes, 0);
    assert.equal(back.mesh, before.mesh);
    // a mirror in the plane of the body: as many quads on both sides
    await page.selectOption('#mirror', '0');
    await page.click('#make');
    await page.waitForFunction(() => !document.querySelector('#cancel') && !window.hfStudio.tools.quads.busy, null, {
      timeout: 60000,
    });
    const [left, right] = await page.evaluate(() => {
      const { tools, body } = window.hfStudio;
      const inX = (positions) => positions.filter((_, i) => i % 3 === 0);
      const [low, high] = inX(body.positions).reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [9e9, -9e9]);
      const away = inX(tools.quads.result.mesh.positions).map((x) => x - (low + high) / 2);
      return [-1, 1].map((side) => away.filter((x) => side * x > 1e-5).length);
    });
    assert.ok(left > 100 && left === right, `${left} and ${right} vertices`);
    await page.selectOption('#mirror', '');
    await page.click('#draw');
    return `${drawn.followed - before.followed} meshes while drawn, ${moved.followed - drawn.followed} while dragged; ${drawn.off[0].toFixed(1)} degrees off`;
  });
  await check(
    'a pole that is placed and dragged is an irregular vertex at its dot, live; undo and a link keep it',
    async () => {
      const seen = () =>
        page.evaluate(() => {
          const { tools, body, state, skin } = window.hfStudio;
          const { mesh, info } = tools.quads.result;
          const { positions, faces } = mesh;
          const count = new Uint32Array(positions.length / 3);
          for (const corner of faces) ++count[corner];
          const inX = body.positions.filter((_, i) => i % 3 === 0);
          const [low, high] = inX.reduce(([a, b], x) => [Math.min(a, x), Math.max(b, x)], [9e9, -9e9]);
          const nearest = (place, quads) =>
            count.reduce(
              (least, n, v) =>
                n === quads
                  ? Math.min(least, Math.hypot(...place.map((x, k) => x - positions[3 * v + k])) / info.edgeLength)
                  : least,
              Infinity,
            );
          const poles = state.poles ?? [];
          const at = poles.map((pole) => skin.at(pole, body.positions));
          return {
            poles: poles.map(({ quads }) => quads),
            // how many edges away is a vertex with as many quads
            away: at.map((place, i) => nearest(place, poles[i].quads)),
            image: at.map(([x, ...rest], i) => nearest([low + high - x, ...rest], poles[i].quads)),
            followed: tools.quads.followed,
            mesh: positions.join(),
          };
        });
      const made = async () => {
        await page.click('#make');
        await page.waitForFunction(
          () => !document.querySelector('#cancel') && !window.hfStudio.tools.quads.busy,
          null,
          {
            timeout: 60000,
          },
        );
        await still();
      };
      await made();
      const before = await seen();
      const [x, y] = await trunk();
      await page.click('#pole-3');
      assert.equal(await page.getAttribute('#pole-3', 'aria-pressed'), 'true');
      await page.mouse.click(x, y);
      await still();
      const placed = await seen();
      assert.deepEqual(placed.poles, [3]);
      assert.ok(placed.away[0] < 1, `${placed.away[0]} edges off the pole`);
      assert.notEqual(placed.mesh, before.mesh);
      const dot = page.locator('.mark').first();
      const box = await dot.boundingBox();
      await studio.drag(box.x + box.width / 2, box.y + box.height / 2, 40, 15);
      await still();
      const moved = await seen();
      assert.ok(moved.followed > placed.followed, 'no mesh was made while the pole was dragged');
      assert.notEqual(moved.mesh, placed.mesh);
      assert.ok(moved.away[0] < 1, `${moved.away[0]} edges off the moved pole`);
      await page.keyboard.press('Control+z');
      await still();
      assert.equal((await seen()).mesh, placed.mesh);
      // with a mirror a pole has an image, on whichever side it is placed
      await page.click('#pole-5');
      assert.equal(await page.getAttribute('#pole-3', 'aria-pressed'), 'false');
      await page.mouse.click(x + 60, y);
      await still();
      await page.selectOption('#mirror', '0');
      await made();
      const mirrored = await seen();
      assert.deepEqual(mirrored.poles, [3, 5]);
      for (const off of [...mirrored.away, ...mirrored.image]) assert.ok(off < 1, `${off} edges off`);
      // a link and a session hold the state, and a state that comes back holds the poles
      const kept = await page.evaluate(async () => {
        const app = window.hfStudio;
        const text = JSON.stringify(app.history.state);
        await app.take(JSON.parse(text));
        return JSON.stringify(app.history.state.poles) === JSON.stringify(JSON.parse(text).poles);
      });
      assert.ok(kept);
      await still();
      assert.deepEqual((await seen()).poles, [3, 5]);
      await page.selectOption('#mirror', '');
      await page.locator('.mark').first().focus();
      await page.keyboard.press('Delete');
      await still();
      assert.deepEqual((await seen()).poles, [5]);
      await page.click('#clear-poles');
      await still();
      assert.deepEqual((await seen()).poles, []);
      await made();
      assert.equal((await seen()).mesh, before.mesh);
      await page.click('#pole-5');
      return `${placed.away[0].toFixed(2)} and ${moved.away[0].toFixed(2)} edges off; ${moved.followed - placed.followed} meshes while dragged`;
    },
  );
  await check('with creases the edges of a cube are edges of quads', async () => {
    await page.setInputFiles('#file', { name: 'cube.obj', mimeType: 'text/plain', buffer: Buffer.from(cube(10)) });
    await page.waitForFunction(() => window.hfStudio.body.name === 'cube.obj' && window.hfStudio.skin.bvh);
    await studio.tool('quads');
    await page.locator('#count').fill('9.1');
    await page.locator('#crease').fill('45');
    await page.click('#make');
    await page.waitForFunction(() => (window.hfStudio.tools.quads?.result && !window.hfStudio.tools.quads.busy) || window.hfStudio.tools.quads?.error, null, {
      timeout: 60000,
    });
    await studio.settle();
    // every edge of a quad that joins two sides of the cube lies on an edge of the cube: none cuts a corner off
    const [corners, cuts, count] = await page.evaluate(() => {
      const { positions, faces } = window.hfStudio.tools.quads.result.mesh;
      const sides = (v) => [0, 1, 2].flatMap((k) => [0, 10].map((x) => Math.abs(positions[3 * v + k] - x) < 1e-4));
      let [corners, cuts] = [0, 0];
      for (let v = 0; v < positions.length / 3; ++v) corners += sides(v).filter(Boolean).length === 3;
      for (let i = 0; i < faces.length; i += 4) {
        const all = Array.from(faces.subarray(i, i + 4), sides);
        cuts += ![0, 1, 2, 3, 4, 5].some((side) => all.every((list) => list[side]));
      }
      return [corners, cuts, faces.length / 4];
    });
    assert.equal(corners, 8);
    assert.equal(cuts, 0);
    await studio.picture('quads_creases');
    return `${count} quads, all on one side each`;
  });
  await check('no error was written', async () => assert.deepEqual(studio.complaints, []));
  await studio.close();
}
