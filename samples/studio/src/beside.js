// A second body beside the open one: the source of a motion or of detail.

/** Room between both, as part of their widths: at 1 they touch, and each twentieth more draws both a twentieth smaller. */
const GAP = 1.08;
/**
 * Bodies whose sizes differ by more than this are shown at one size: a horse beside a scan of 150 units was a dot. Creatures
 * of one scene differ by less, and keep theirs.
 */
const DIFFERENT = 3;

/**
 * The body as the stage shows it: { body, skin, sums, normals, shown, pick }. shown(place) is where a place of the body
 * stands in the picture, pick(ray) finds what a ray of the view meets, in places of the body.
 */
export async function openBeside({ smoothNormals, normalSums, normalGroups }, app, body) {
  const { positions, triangles } = body;
  const skin = await app.view.ready(body);
  skin.group.visible = true;
  const sums = normalSums(triangles, normalGroups(positions, body.fileNormals));
  const normals = smoothNormals(positions, sums, new Float32Array(positions.length));
  skin.set({ positions, normals });
  const { position, scale } = skin.group;
  const shown = (place) => place.map((x, k) => x * scale.x + position.getComponent(k));
  const pick = (ray) => {
    ray.origin.sub(position).divideScalar(scale.x);
    return skin.pick(ray);
  };
  return { body, skin, sums, normals, shown, pick };
}

/** Both bodies in the picture; the second stands to the left of who looks, on the ground of the first. */
export function lookAtBoth({ Vector3 }, { view, skin, body }, source) {
  const box = skin.box(body.positions);
  const other = source.skin.box(source.body.positions);
  const [size, otherSize] = [box, other].map((one) => one.getSize(new Vector3()).length());
  const ratio = otherSize > 0 ? size / otherSize : 1;
  const scale = Math.max(ratio, 1 / ratio) > DIFFERENT ? ratio : 1;
  for (const corner of [other.min, other.max]) corner.multiplyScalar(scale);
  source.skin.group.scale.setScalar(scale);
  const { right } = view.axes();
  const away = (view.half(box, right) + view.half(other, right)) * GAP;
  const place = box.getCenter(new Vector3()).sub(other.getCenter(new Vector3())).addScaledVector(right, -away);
  place.y = box.min.y - other.min.y;
  source.skin.group.position.copy(place);
  view.frame(box.union(other.translate(place)));
}

/** Buttons that take a sample or a file: onfile(bytes, name). */
export function takeRow({ make, button }, app, onfile, accept) {
  const sample = async (name) => {
    const answer = await fetch(`samples/${name}.glb`);
    if (answer.ok) await onfile(new Uint8Array(await answer.arrayBuffer()), `${name}.glb`);
    else app.warn(`the sample ${name} is not there (${answer.status}); open a file of your own`);
  };
  return make(
    'div',
    { class: 'row' },
    ...app.samples
      .filter((name) => `${name}.glb` !== app.body.name)
      .map((name) => button(`Take the ${name}`, () => sample(name), { id: `take-${name}` })),
    button(
      'Take a file',
      () => {
        const input = make('input', { type: 'file', accept, id: 'source-file' });
        input.onchange = async () =>
          input.files[0] && onfile(new Uint8Array(await input.files[0].arrayBuffer()), input.files[0].name);
        input.click();
      },
      { id: 'take-file' },
    ),
  );
}
