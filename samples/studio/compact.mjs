// compact.mjs IN OUT: writes a sample creature in fewer bytes for the first picture: what glTF allows in 8 and 16 bits is
// written so. Places stay in single precision, on a grid.
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const { NodeIO } = createRequire(join(process.env.HF_MODULES, 'x.js'))('@gltf-transform/core');
const { KHRMeshQuantization } = createRequire(join(process.env.HF_MODULES, 'x.js'))('@gltf-transform/extensions');
const io = new NodeIO().registerExtensions([KHRMeshQuantization]);
const document = await io.readBinary(new Uint8Array(readFileSync(process.argv[2])));

const packed = (accessor, Type, scale) =>
  accessor.setArray(Type.from(accessor.getArray(), (x) => Math.round(x * scale))).setNormalized(true);

/** Places are rounded to the box divided by this: four tenths of a millimetre on a horse. Double takes 6 kB more, 4 times 10. */
const GRID = 8192;
function onGrid(accessor) {
  const [low, high] = [accessor.getMin([]), accessor.getMax([])];
  const step = Math.max(...high.map((x, k) => x - low[k])) / GRID;
  accessor.setArray(accessor.getArray().map((x) => Math.round(x / step) * step));
}

/** Four weights of 8 bits whose sum is 255: the largest takes what rounding left. */
function weightsIn8Bits(accessor) {
  const given = accessor.getArray();
  const out = new Uint8Array(given.length);
  for (let v = 0; v < given.length; v += 4) {
    let left = 255;
    for (let k = 3; k > 0; --k) left -= out[v + k] = Math.round(255 * given[v + k]);
    out[v] = left;
  }
  accessor.setArray(out).setNormalized(true);
}

const done = new Set();
for (const mesh of document.getRoot().listMeshes())
  for (const primitive of mesh.listPrimitives()) {
    const once = (name, act) => {
      const accessor = primitive.getAttribute(name);
      if (accessor && !done.has(accessor)) act(accessor);
      done.add(accessor);
    };
    once('NORMAL', (accessor) => {
      packed(accessor, Int8Array, 127);
      document.createExtension(KHRMeshQuantization).setRequired(true);
    });
    once(
      'TEXCOORD_0',
      (accessor) => accessor.getArray().every((x) => x >= 0 && x <= 1) && packed(accessor, Uint16Array, 65535),
    );
    once('POSITION', onGrid);
    once('COLOR_0', (accessor) => packed(accessor, Uint8Array, 255));
    once('WEIGHTS_0', weightsIn8Bits);
    once('JOINTS_0', (accessor) => {
      const weights = primitive.getAttribute('WEIGHTS_0').getArray();
      const joints = accessor.getArray().map((joint, i) => (weights[i] ? joint : 0));
      accessor.setArray(joints.every((joint) => joint < 256) ? Uint8Array.from(joints) : joints);
    });
    const indices = primitive.getIndices();
    if (indices && primitive.getAttribute('POSITION').getCount() < 65536)
      indices.setArray(Uint16Array.from(indices.getArray()));
  }
for (const clip of document.getRoot().listAnimations())
  for (const channel of clip.listChannels()) {
    const values = channel.getSampler().getOutput();
    if (channel.getTargetPath() !== 'rotation' || done.has(values)) continue;
    done.add(values);
    packed(values, Int16Array, 32767);
  }
writeFileSync(process.argv[3], await io.writeBinary(document));
