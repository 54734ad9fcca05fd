// What the user takes away: a glb with the new shape, a glb rigged by the handles, quads, weights, a picture.
import { Matrix3, Matrix4, Vector3 } from 'three';
import { localsOf } from './timeline.js';
import { meshFile, meshFormat } from './mesh_save.js';
import { readModel, writeGlb } from './model.js';
import { button, card, download, make, say } from './ui.js';

const stem = (name) => name.replace(/\.\w+$/, '');

/** A copy of the body read from its own bytes: changes to it leave the open body alone. */
async function copyOf(body) {
  return readModel(await writeGlb(body.document), 'copy.glb');
}

/** Primitives that several nodes share get one each, because their shapes may differ now. */
function ownPrimitives(copy) {
  const seen = new Set();
  for (const part of copy.parts) {
    if (!seen.has(part.primitive)) {
      seen.add(part.primitive);
      continue;
    }
    const mesh = part.node.getMesh();
    const own = mesh.clone();
    for (const primitive of own.listPrimitives()) own.removePrimitive(primitive);
    for (const primitive of mesh.listPrimitives()) own.addPrimitive(primitive.clone());
    const order = mesh.listPrimitives();
    for (const other of copy.parts)
      if (other.node === part.node)
        other.primitive = own.listPrimitives()[order.indexOf(other.primitive)] ?? other.primitive;
    part.node.setMesh(own);
  }
}

const bufferOf = (document) => document.getRoot().listBuffers()[0] ?? document.createBuffer();

function setShape(document, part, locals, normals) {
  const accessor = (array) => document.createAccessor().setType('VEC3').setArray(array).setBuffer(bufferOf(document));
  part.primitive.setAttribute(
    'POSITION',
    accessor(Float32Array.from(locals.subarray(3 * part.first, 3 * (part.first + part.count)))),
  );
  if (part.primitive.getAttribute('NORMAL'))
    part.primitive.setAttribute('NORMAL', accessor(localNormals(part, normals)));
}

function localNormals(part, normals) {
  const out = new Float32Array(3 * part.count);
  const [matrix, linear, normal] = [new Matrix4(), new Matrix3(), new Vector3()];
  for (let v = 0; v < part.count; ++v) {
    if (part.skin || v === 0)
      linear.setFromMatrix4(matrix.fromArray(part.matrices, part.skin ? 16 * v : 0)).transpose();
    normal
      .fromArray(normals, 3 * (part.first + v))
      .applyMatrix3(linear)
      .normalize();
    if (!(normal.lengthSq() > 0.5)) normal.set(0, 1, 0);
    normal.toArray(out, 3 * v);
  }
  return out;
}

/** The file with the new shape: materials, texture coordinates, skins and clips stay. */
export async function shapedGlb(app) {
  const copy = await copyOf(app.body);
  ownPrimitives(copy);
  const locals = localsOf(app.body, app.shape.positions);
  copy.parts.forEach((part, i) =>
    setShape(copy.document, { ...part, matrices: app.body.parts[i].matrices }, locals, app.shape.normals),
  );
  return writeGlb(copy.document);
}

/** Writes bones and shares of a part, four of each in an attribute. jointOf: the joint of a bone. */
function setInfluences({ primitive, first, count }, given, accessor, jointOf = (bone) => bone) {
  const { joints, weights, influenceCount: size } = given;
  for (let set = 0; set < size / 4; ++set) {
    const [numbers, shares] = [new Uint16Array(4 * count), new Float32Array(4 * count)];
    for (let i = 0; i < 4 * count; ++i) {
      const from = size * (first + (i >> 2)) + 4 * set + (i & 3);
      if (!(weights[from] > 0)) continue;
      [shares[i], numbers[i]] = [weights[from], jointOf(joints[from])];
    }
    primitive
      .setAttribute(`JOINTS_${set}`, accessor('VEC4', numbers))
      .setAttribute(`WEIGHTS_${set}`, accessor('VEC4', shares));
  }
}

/** The rest shape with a skin: `frames` move its joints. names and frames[f][j]: { rotation, translation }. */
async function skinnedGlb(app, { pivots, joints, weights, jointCount, influenceCount = 4 }, frames, seconds, clipName) {
  const copy = await copyOf(app.body);
  ownPrimitives(copy);
  const { document } = copy;
  const root = document.getRoot();
  for (const clip of root.listAnimations()) clip.dispose();
  const buffer = bufferOf(document);
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const above = document.createNode('handles');
  copy.scene.addChild(above);
  const inverse = new Float32Array(16 * jointCount);
  const nodes = Array.from({ length: jointCount }, (_, j) => {
    const pivot = Array.from(pivots.subarray(3 * j, 3 * j + 3));
    inverse.set(new Matrix4().makeTranslation(...pivot.map((x) => -x)).elements, 16 * j);
    const node = document.createNode(`joint ${j + 1}`).setTranslation(pivot);
    above.addChild(node);
    return node;
  });
  const skin = document.createSkin('by handles').setInverseBindMatrices(accessor('MAT4', inverse)).setSkeleton(above);
  for (const node of nodes) skin.addJoint(node);
  const body = document.createMesh('body');
  const moved = new Set();
  for (const part of copy.parts) {
    const range = (array, size) => array.slice(size * part.first, size * (part.first + part.count));
    const { primitive } = part;
    primitive.setAttribute('POSITION', accessor('VEC3', range(app.body.positions, 3)));
    if (primitive.getAttribute('NORMAL'))
      primitive.setAttribute('NORMAL', accessor('VEC3', range(app.opened.normals, 3)));
    for (const name of primitive.listSemantics())
      if (/^(JOINTS|WEIGHTS|TANGENT)/.test(name)) primitive.setAttribute(name, null);
    setInfluences(part, { joints, weights, influenceCount }, accessor);
    body.addPrimitive(primitive);
    moved.add(part.node);
  }
  for (const node of moved) node.setMesh(null).setSkin(null);
  copy.scene.addChild(document.createNode('body').setMesh(body).setSkin(skin));
  for (const old of root.listSkins()) if (old !== skin) old.dispose();
  for (const old of root.listMeshes())
    if (!old.listParents().some((parent) => parent.propertyType === 'Node')) old.dispose();
  const clip = document.createAnimation(clipName);
  const times = accessor('SCALAR', Float32Array.from(seconds));
  nodes.forEach((node, j) => {
    for (const [path, size] of [
      ['rotation', 4],
      ['translation', 3],
    ]) {
      const values = new Float32Array(size * frames.length);
      frames.forEach((frame, f) => values.set(frame[`${path}s`].subarray(size * j, size * j + size), size * f));
      if (size === 4) unit(values);
      const sampler = document
        .createAnimationSampler()
        .setInput(times)
        .setOutput(accessor(`VEC${size}`, values))
        .setInterpolation('LINEAR');
      clip
        .addSampler(sampler)
        .addChannel(document.createAnimationChannel().setTargetNode(node).setTargetPath(path).setSampler(sampler));
    }
  });
  return writeGlb(document);
}

/** Quaternions of length 1 in single precision, each near the one before it. */
function unit(values) {
  for (let i = 0; i < values.length; i += 4) {
    const length = Math.hypot(values[i], values[i + 1], values[i + 2], values[i + 3]) || 1;
    const dot = i ? [0, 1, 2, 3].reduce((sum, k) => sum + values[i + k] * values[i - 4 + k], 0) : 1;
    for (let k = 0; k < 4; ++k) values[i + k] *= (dot < 0 ? -1 : 1) / length;
  }
}

/** The rest shape rigged by the handles, with a clip from rest to the pose. */
export async function riggedGlb(app) {
  // from the pose that is shown: with free rotations the way there counts
  const skin = await app.client.ask('skin', { handles: app.state.handles, way: 'rest' });
  const rotations = new Float64Array(4 * skin.jointCount).map((_, i) => Number(i % 4 === 3));
  return skinnedGlb(app, skin, [{ rotations, translations: skin.pivots }, skin], [0, 1], 'pose');
}

/** Frames a second of a clip that is made of keys: of animation files. */
const FRAME_RATE = 30;

/** The rest shape rigged by the handles, with the keys as a clip. */
export async function keyedGlb(app) {
  const { timeline } = app;
  const { length } = timeline;
  const count = Math.max(2, Math.round(length * FRAME_RATE) + 1);
  const seconds = Array.from({ length: count }, (_, f) => (length * f) / (count - 1));
  const frames = [];
  for (const time of seconds) frames.push(await app.client.ask('skin', { handles: timeline.handlesAt(time) }));
  return skinnedGlb(app, frames[0], frames, seconds, 'keys');
}

export { skinnedGlb };

/** The file with new weights in its own skins. result: { joints, weights } of the bones of the file. */
export async function weightedGlb(app, result, bones) {
  if (!bones.joints) return handleGlb(app, result, bones);
  const copy = await copyOf(app.body);
  ownPrimitives(copy);
  const { document } = copy;
  const buffer = bufferOf(document);
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  copy.parts.forEach((part, i) => {
    const { skin } = app.body.parts[i];
    if (!skin) return;
    const order = new Map(skin.listJoints().map((joint, j) => [bones.joints.indexOf(joint), j]));
    for (let set = 0; set < 4; ++set)
      for (const name of [`JOINTS_${set}`, `WEIGHTS_${set}`]) part.primitive.setAttribute(name, null);
    setInfluences(part, result, accessor, (bone) => order.get(bone) ?? 0);
  });
  return writeGlb(document);
}

/** The shape at rest with a joint for each handle, and a clip from rest to the pose of the handles. */
function handleGlb(app, result, { heads, handles }) {
  const pivots = Float64Array.from(heads);
  const rest = {
    rotations: new Float64Array(4 * handles.length).map((_, i) => Number(i % 4 === 3)),
    translations: pivots,
  };
  const pose = {
    rotations: Float64Array.from(handles.flatMap((handle) => app.standing(handle).rotation)),
    translations: Float64Array.from(handles.flatMap(({ translation }) => translation)).map((t, i) => t + pivots[i]),
  };
  return skinnedGlb(app, { ...result, pivots, jointCount: handles.length }, [rest, pose], [0, 1], 'pose');
}

/** For modules that are loaded when they are asked for: they import nothing that the page has. */
const parts = { bufferOf, copyOf, localNormals, localsOf, ownPrimitives, writeGlb };

/** Quads as obj: glTF has triangles only. */
export function quadsObj({ positions, faces }) {
  const lines = ['# quads by hf studio'];
  for (let v = 0; v < positions.length; v += 3) lines.push(`v ${positions[v]} ${positions[v + 1]} ${positions[v + 2]}`);
  for (let i = 0; i < faces.length; i += 4)
    lines.push(`f ${Array.from(faces.subarray(i, i + 4), (v) => v + 1).join(' ')}`);
  return `${lines.join('\n')}\n`;
}

export function saveMenu(app) {
  const name = stem(app.body.name);
  const glb = 'model/gltf-binary';
  const { weights, quads, transfer } = app.tools;
  const format = app.body.vrm ? 'vrm' : meshFormat(app.body.name);
  const types = { vrm: glb, ply: 'model/ply', stl: 'model/stl' };
  const ownFile = async () =>
    app.body.vrm ? (await import('./vrm_save.js')).shapedVrm(app, parts) : meshFile(format, app.shape.positions, app.body.triangles);
  const ownFormat = [
    `Shape (${format})`,
    app.body.vrm ? 'the posed shape; all else of the file stays as it is' : 'the posed shape as the kind of file it came in, in triangles',
    async () => download(await ownFile(), `${name}_posed.${format}`, types[format] ?? 'text/plain'),
    true,
    'save-mesh',
  ];
  const ending = app.body.name.toLowerCase().split('.').pop();
  const unwritten = ['fbx', 'dae'].includes(ending) ? `${ending} is not written; as glb ` : '';
  const choices = [
    ...(format ? [ownFormat] : []),
    [
      'Shape (glb)',
      `${unwritten}the posed shape; materials, skin and clips of the file stay`,
      async () => download(await shapedGlb(app), `${name}_posed.glb`, glb),
      true,
      'save-shape',
    ],
    [
      'Rig by handles (glb)',
      'a skin made of the handles, and the pose as a clip',
      async () => download(await riggedGlb(app), `${name}_rigged.glb`, glb),
      app.state.handles.length > 0,
      'save-rig',
    ],
    [
      'Morph (glb)',
      'the pose, or each key, as a morph target with a clip',
      async () => download(await (await import('./morph.js')).morphGlb(app, parts), `${name}_morph.glb`, glb),
      true,
      'save-morph',
    ],
    [
      'Keys (glb)',
      'a skin made of the handles, and the keys as a clip',
      async () => download(await keyedGlb(app), `${name}_keys.glb`, glb),
      app.timeline.keys.length > 0,
      'save-keys',
    ],
    [
      'Weights (glb)',
      'the new weights in the skin of the file, or of the handles',
      async () => download(await weightedGlb(app, weights.changed(), weights.bones), `${name}_weights.glb`, glb),
      Boolean(weights?.changed()),
      'save-weights',
    ],
    [
      'Quads (obj)',
      'the quad mesh',
      async () => download(quadsObj(quads.result.mesh), `${name}_quads.obj`, 'text/plain'),
      Boolean(quads?.result),
      'save-quads',
    ],
    [
      'Transferred walk (glb)',
      'this body with the clip of the other',
      async () => download(await transfer.glb(), `${name}_walk.glb`, glb),
      Boolean(transfer?.ready()),
      'save-transfer',
    ],
    [
      'Picture (png)',
      'the view as it is now',
      async () => download(await app.view.picture(), `${name}.png`, 'image/png'),
      true,
      'save-picture',
    ],
    [
      'Film (webm)',
      'six seconds: what plays, or the body turned once',
      async () => download(await (await import('./film.js')).film(app), `${name}.webm`, 'video/webm'),
      true,
      'save-film',
    ],
    [
      'Link',
      'the settings in an address: tools, handles, keys, the view',
      async () => (await import('./link.js')).showLink(app),
      true,
      'save-link',
      true,
    ],
  ];
  const dialog = card(
    'Save',
    choices.map(([title, text, act, able, id, quiet]) => {
      const entry = button(
        '',
        async () => {
          dialog.close();
          say(`saving: ${title}`, { stays: true });
          try {
            await act();
            say(quiet ? '' : `saved: ${title}`);
          } catch (error) {
            app.failed(`${title} was not saved`, error);
          }
        },
        { class: 'choice', disabled: !able, id },
      );
      entry.append(make('strong', {}, title), make('small', {}, text));
      return entry;
    }),
    [['Close', null]],
  );
}
