// What decodes compressed glTF: meshopt and Draco. Loaded when a file needs it.
import { MeshoptDecoder } from 'three/examples/jsm/libs/meshopt_decoder.module.js';

let draco = null;

/** The decoder of Draco is in files of its own: it is large. */
async function dracoDecoder() {
  const at = (name) => new URL(`draco/${name}`, document.baseURI);
  const answer = await fetch(at('decoder.wasm'));
  if (!answer.ok) throw new Error(`${answer.status}`);
  const { default: make } = await import(at('decoder.js').href);
  return make({ wasmBinary: await answer.arrayBuffer() });
}

/** The decoders as @gltf-transform/extensions takes them. */
export async function decoders(withDraco) {
  await MeshoptDecoder.ready;
  if (withDraco) draco ??= await dracoDecoder();
  return { 'meshopt.decoder': MeshoptDecoder, ...(withDraco && { 'draco3d.decoder': draco }) };
}
