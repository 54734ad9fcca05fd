// A second body beside the open one: the source of a motion or of detail.

/** Room between both, as part of their widths. */
const GAP = 1.08;

/** The body as the stage shows it: { body, skin, sums, normals, offset }. */
export async function openBeside({ smoothNormals, normalSums, normalGroups }, app, body) {
  const { positions, triangles } = body;
  const skin = await app.view.ready(body);
  skin.group.visible = true;
  const sums = normalSums(triangles, normalGroups(positions, body.fileNormals));
  const normals = smoothNormals(positions, sums, new Float32Array(positions.length));
  skin.set({ positions, normals });
  return { body, skin, sums, normals, offset: [0, 0, 0] };
}

/** Both bodies in the picture; the second stands to the left of who looks, on the ground of the first. */
export function lookAtBoth({ Vector3 }, { view, skin, body }, source) {
  const box = skin.box(body.positions);
  const other = source.skin.box(source.body.positions);
  const { right } = view.axes();
  const away = (view.half(box, right) + view.half(other, right)) * GAP;
  const place = box.getCenter(new Vector3()).sub(other.getCenter(new Vector3())).addScaledVector(right, -away);
  place.y = box.min.y - other.min.y;
  source.offset = place.toArray();
  source.skin.group.position.copy(place);
  view.frame(box.union(other.translate(place)));
}

/** Buttons that take a sample or a file: onfile(bytes, name). */
export function takeRow({ make, button, say }, app, onfile, accept = '.glb,.gltf') {
  const sample = async (name) => {
    const answer = await fetch(`samples/${name}.glb`);
    if (answer.ok) await onfile(new Uint8Array(await answer.arrayBuffer()), `${name}.glb`);
    else say(`the sample ${name} is not there (${answer.status})`);
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
