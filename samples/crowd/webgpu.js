// The crowd in WebGPU: hf_blend of hf_blend.wgsl in a standard material of three.js. Rows and transforms are buffers.
import * as THREE from 'three/webgpu';
import {
  attribute,
  instanceIndex,
  normalGeometry,
  positionGeometry,
  storage,
  transformNormalToView,
  varying,
  wgsl,
  wgslFn,
} from 'three/tsl';

export async function makeRenderer() {
  const renderer = new THREE.WebGPURenderer({ antialias: true });
  await renderer.init();
  return renderer;
}

export async function makeMaterial({ rows, transforms, clusterCount, colours }) {
  const answer = await fetch('shaders/hf_blend.wgsl');
  if (!answer.ok) throw new Error(`hf_blend.wgsl could not be loaded (${answer.status}).`);
  const source = await answer.text();
  const clusters = new Uint32Array((rows.entryCount + 1) >> 1); // two in a word
  new Uint16Array(clusters.buffer).set(rows.clusters);
  const buffers = {
    hf_clusters: [clusters, 'uint', 1],
    hf_weights: [rows.weights, 'float', 1],
    hf_gradients: [rows.gradients, 'float', 1],
  };
  const nodes = Object.entries({ ...buffers, hf_transforms: [transforms, 'vec4', 4] }).map(
    ([name, [array, type, size]]) =>
      storage(new THREE.StorageBufferAttribute(array, size), type, array.length / size)
        .toReadOnly()
        .setName(name),
  );
  // three.js declares the buffers: what the source says of arrays and blend, with `.value` behind their names
  const transform = /struct HfTransform [^]*?\n}/.exec(source)[0];
  const blend = /\/\/ ---- arrays[^]*(?=\/\/ ---- compute)/.exec(source)[0];
  const code = `${transform}\n${blend}`.replace(
    /\b(hf_clusters|hf_weights|hf_gradients|hf_transforms)\[/g,
    '$1.value[',
  );
  const posed = wgslFn(
    `fn hf_posed(row: vec2u, first: u32, position: vec3f, normal: vec3f) -> mat3x3f {
      var rest: HfVertex;
      rest.position = position;
      rest.normal = normal;
      let made = hf_blend(row, first, rest);
      return mat3x3f(made.position, made.normal, made.tangent);
    }`,
    [...nodes, wgsl(code)],
  )(attribute('hfRow', 'uvec2'), instanceIndex.mul(clusterCount), positionGeometry, normalGeometry).toVar();
  const material = new THREE.MeshStandardNodeMaterial({ vertexColors: colours, roughness: 0.75 });
  material.positionNode = posed.element(0).add(attribute('hfPlace', 'vec3'));
  material.normalNode = varying(transformNormalToView(posed.element(1))).normalize();
  return { material, update: () => (nodes[3].value.needsUpdate = true) };
}
