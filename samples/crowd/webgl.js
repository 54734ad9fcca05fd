// The crowd in WebGL 2: hf_blend_textures.glsl in a standard material of three.js. Rows and transforms are textures.
import * as THREE from 'three';

/** A list as a texture: the last row is padded. */
function texture(data, each, width, [format, type, kept]) {
  const height = Math.ceil(data.length / each / width);
  const padded = width * height * each === data.length ? data : new data.constructor(width * height * each);
  if (padded !== data) padded.set(data);
  const made = new THREE.DataTexture(padded, width, height, format, type);
  made.internalFormat = kept;
  made.needsUpdate = true;
  return made;
}
const floats = [THREE.RGBAFormat, THREE.FloatType, 'RGBA32F'];
const shorts = [THREE.RedIntegerFormat, THREE.UnsignedShortType, 'R16UI'];

export async function makeRenderer() {
  return new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
}

export async function makeMaterial({ rows, transforms, clusterCount, colours }) {
  const answer = await fetch('shaders/hf_blend_textures.glsl');
  if (!answer.ok) throw new Error(`hf_blend_textures.glsl could not be loaded (${answer.status}).`);
  const shader = await answer.text();
  const entries = new Float32Array(4 * rows.entryCount); // gradients and weights
  for (let e = 0; e < rows.entryCount; ++e) {
    for (let k = 0; k < 3; ++k) entries[4 * e + k] = rows.gradients[3 * e + k];
    entries[4 * e + 3] = rows.weights[e];
  }
  const uniforms = {
    hf_clusters: { value: texture(rows.clusters, 1, 1024, shorts) },
    hf_entries: { value: texture(entries, 4, 1024, floats) },
    hf_transforms: { value: texture(transforms, 4, 3 * clusterCount, floats) }, // a row for each creature
  };
  const material = new THREE.MeshStandardMaterial({ vertexColors: colours, roughness: 0.75 });
  material.onBeforeCompile = (program) => {
    Object.assign(program.uniforms, uniforms);
    program.vertexShader = program.vertexShader
      .replace(
        '#include <common>',
        `#include <common>\n#define HF_NO_ENTRY\n${shader}\nin uvec2 hfRow;\nin vec3 hfPlace;`,
      )
      .replace(
        '#include <beginnormal_vertex>',
        `HfVertex hfRest;
        hfRest.position = position;
        hfRest.normal = normal;
        HfVertex hfPosed = hf_blend(hfRow, uint(gl_InstanceID) * ${clusterCount}u, hfRest);
        vec3 objectNormal = hfPosed.normal;`,
      )
      .replace('#include <begin_vertex>', 'vec3 transformed = hfPosed.position + hfPlace;');
  };
  return { material, update: () => (uniforms.hf_transforms.value.needsUpdate = true) };
}
