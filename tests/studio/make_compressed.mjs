// make_compressed.mjs MODULES: writes tests/studio/data/*.glb, small files that are compressed by Draco and by meshopt, and one
// with a picture in KTX2. MODULES: node_modules with @gltf-transform/core, @gltf-transform/extensions, draco3dgltf,
// meshoptimizer and ktx-parse. The tests read the files; nothing runs this.
import { mkdirSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const require = createRequire(join(process.argv[2], 'x.js'));
const { Document, NodeIO } = require('@gltf-transform/core');
const { EXTMeshoptCompression, KHRDracoMeshCompression, KHRTextureBasisu } = require('@gltf-transform/extensions');
const { MeshoptEncoder } = require('meshoptimizer');
const { createDefaultContainer, write } = require('ktx-parse');
const out = join(dirname(fileURLToPath(import.meta.url)), 'data');
mkdirSync(out, { recursive: true });

const [ROUND, ACROSS] = [48, 24];

/** A ring with one bump, so that no turn takes it to itself. */
function ring() {
  const document = new Document();
  const buffer = document.createBuffer();
  const [places, corners] = [[], []];
  for (let i = 0; i < ROUND; ++i)
    for (let j = 0; j < ACROSS; ++j) {
      const [a, b] = [(2 * Math.PI * i) / ROUND, (2 * Math.PI * j) / ACROSS];
      const thick = 0.3 * (1 + 0.5 * Math.exp(-8 * (1 - Math.cos(a))));
      places.push(
        (1 + thick * Math.cos(b)) * Math.cos(a),
        thick * Math.sin(b),
        (1 + thick * Math.cos(b)) * Math.sin(a),
      );
      const at = (x, y) => (x % ROUND) * ACROSS + (y % ACROSS);
      corners.push(at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
    }
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const material = document.createMaterial('ring').setBaseColorFactor([0.6, 0.7, 0.5, 1]);
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', accessor('VEC3', Float32Array.from(places)))
    .setAttribute('TEXCOORD_0', accessor('VEC2', Float32Array.from(places, (x) => x).slice(0, (places.length / 3) * 2)))
    .setIndices(accessor('SCALAR', Uint16Array.from(corners)))
    .setMaterial(material);
  const node = document.createNode('ring').setMesh(document.createMesh('ring').addPrimitive(primitive));
  document.getRoot().setDefaultScene(document.createScene().addChild(node));
  return { document, material };
}

const save = async (name, document, extensions, dependencies) => {
  const io = new NodeIO().registerExtensions(extensions).registerDependencies(dependencies);
  const bytes = await io.writeBinary(document);
  writeFileSync(join(out, `${name}.glb`), bytes);
  console.log(`${name}.glb: ${bytes.length} bytes`);
};

const draco = ring();
draco.document
  .createExtension(KHRDracoMeshCompression)
  .setRequired(true)
  .setEncoderOptions({ quantizationBits: { POSITION: 16, TEX_COORD: 12 } });
await save('ring_draco', draco.document, [KHRDracoMeshCompression], {
  'draco3d.encoder': await require('draco3dgltf').createEncoderModule(),
});

const meshopt = ring();
meshopt.document.createExtension(EXTMeshoptCompression).setRequired(true);
await MeshoptEncoder.ready;
await save('ring_meshopt', meshopt.document, [EXTMeshoptCompression], { 'meshopt.encoder': MeshoptEncoder });

const ktx2 = ring();
ktx2.document.createExtension(KHRTextureBasisu).setRequired(true);
const container = createDefaultContainer();
Object.assign(container, { pixelWidth: 4, pixelHeight: 4, vkFormat: 0, typeSize: 1 });
container.levels = [{ levelData: new Uint8Array(16).fill(7), uncompressedByteLength: 16 }];
container.dataFormatDescriptor[0].colorModel = 166; // UASTC
ktx2.material.setBaseColorTexture(
  ktx2.document.createTexture('packed').setImage(write(container)).setMimeType('image/ktx2'),
);
await save('ring_ktx2', ktx2.document, [KHRTextureBasisu], {});
