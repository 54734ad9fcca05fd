// A glb with the pose, or each key, as a morph target. Loaded when it is asked for.

/** The file with one target more for each shape, and a clip that goes through them. shapes: { name, time, positions, normals }. */
async function morphedGlb(app, kit, shapes, clipName) {
  const { bufferOf, copyOf, localNormals, localsOf, ownPrimitives, writeGlb } = kit;
  const copy = await copyOf(app.body);
  ownPrimitives(copy);
  const { document } = copy;
  const root = document.getRoot();
  const buffer = bufferOf(document);
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const parts = new Map(
    copy.parts.map((part, i) => [part.primitive, { ...part, matrices: app.body.parts[i].matrices }]),
  );
  const meshes = new Set(copy.parts.map(({ node }) => node.getMesh()));
  const before = new Map([...meshes].map((mesh) => [mesh, mesh.listPrimitives()[0].listTargets().length]));
  const locals = shapes.map(({ positions }) => localsOf(app.body, positions));
  const floats = (given) => {
    const [out, element] = [new Float32Array(3 * given.getCount()), [0, 0, 0]];
    for (let v = 0; v < given.getCount(); ++v) out.set(given.getElement(v, element), 3 * v);
    return out;
  };
  const difference = (base, now) =>
    accessor(
      'VEC3',
      base.map((x, i) => now[i] - x),
    );
  for (const mesh of meshes) {
    for (const primitive of mesh.listPrimitives()) {
      const part = parts.get(primitive);
      // in whole numbers, as some files have them, a target could not be added exactly
      const [place, normal] = ['POSITION', 'NORMAL'].map((name) => {
        const base = primitive.getAttribute(name) && floats(primitive.getAttribute(name));
        if (base) primitive.setAttribute(name, accessor('VEC3', base));
        return base;
      });
      shapes.forEach(({ name, normals }, i) => {
        const target = document.createPrimitiveTarget(name);
        // lines and points of the mesh need a target too: they stay
        const now = part ? locals[i].subarray(3 * part.first, 3 * (part.first + part.count)) : null;
        target.setAttribute(
          'POSITION',
          now ? difference(place, now) : accessor('VEC3', new Float32Array(place.length)),
        );
        if (normal && part) target.setAttribute('NORMAL', difference(normal, localNormals(part, normals)));
        primitive.addTarget(target);
      });
    }
    const names = mesh.getExtras().targetNames ?? Array.from({ length: before.get(mesh) }, (_, i) => `target ${i + 1}`);
    const old = Array.from({ length: before.get(mesh) }, (_, i) => mesh.getWeights()[i] ?? 0);
    mesh.setWeights([...old, ...shapes.map(() => 0)]);
    mesh.setExtras({ ...mesh.getExtras(), targetNames: [...names, ...shapes.map(({ name }) => name)] });
  }
  widenWeights(root, before, shapes.length, accessor);
  const clip = document.createAnimation(clipName);
  const rest = shapes[0].time > 0 ? [0] : [];
  const times = accessor('SCALAR', Float32Array.from([...rest, ...shapes.map(({ time }) => time)]));
  for (const node of new Set(copy.parts.map((part) => part.node))) {
    const mesh = node.getMesh();
    const rows = [...rest.map(() => -1), ...shapes.keys()].flatMap((shown) => [
      ...mesh.getWeights().slice(0, before.get(mesh)),
      ...shapes.map((_, i) => Number(i === shown)),
    ]);
    const sampler = document.createAnimationSampler().setInput(times).setInterpolation('LINEAR');
    sampler.setOutput(accessor('SCALAR', Float32Array.from(rows)));
    clip
      .addSampler(sampler)
      .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath('weights').setSampler(sampler));
  }
  return writeGlb(document);
}

/** Clips that are there get a weight of 0 for each new target. */
function widenWeights(root, before, more, accessor) {
  const seen = new Set();
  for (const clip of root.listAnimations())
    for (const channel of clip.listChannels()) {
      const sampler = channel.getSampler();
      const old = before.get(channel.getTargetNode()?.getMesh());
      if (channel.getTargetPath() !== 'weights' || !old || seen.has(sampler)) continue;
      seen.add(sampler);
      const output = sampler.getOutput();
      const rows = output.getCount() / old;
      const values = new Float32Array(rows * (old + more));
      for (let row = 0; row < rows; ++row)
        for (let i = 0; i < old; ++i) values[row * (old + more) + i] = output.getScalar(row * old + i);
      sampler.setOutput(accessor('SCALAR', values));
    }
}

/** The pose as a morph target, or with keys one for each of them, and a clip. */
export async function morphGlb(app, kit) {
  const { timeline, state } = app;
  if (!timeline.keys.length) return morphedGlb(app, kit, [{ name: 'pose', time: 1, ...app.shape }], 'pose');
  const shapes = [];
  for (const { time } of timeline.keys) {
    const handles = timeline.handlesAt(time);
    const { lengths, detail } = state;
    const { positions, normals } = await app.client.ask('shape', { handles, lengths, detail, way: 'exact' });
    shapes.push({ name: `key ${shapes.length + 1}`, time, positions, normals });
  }
  return morphedGlb(app, kit, shapes, 'keys');
}
