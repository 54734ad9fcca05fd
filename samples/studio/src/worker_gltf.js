// hf_gltf as the Worker uses it: the library of models (src/gltf) in a module of its own, loaded when it is needed.
import createHfGltf from 'hf-gltf-glue';

let loading = null;
/** { module, ok, text, space }: the module, and how its functions are called. */
export function gltf() {
  loading ??= load().catch((error) => {
    loading = null; // the next call tries again
    throw error;
  });
  return loading;
}

async function load() {
  const answer = await fetch(new URL('gltf.wasm', self.location)).catch(() => null);
  if (!answer?.ok)
    throw new Error('What reads models could not be loaded. Try again when the network is there.');
  const module = await createHfGltf({ wasmBinary: await answer.arrayBuffer() });
  const text = (at, size) => {
    const bytes = module.HEAPU8.slice(at, at + size);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  };
  /** Calls a function; what is wrong comes back as an error with its code. */
  const ok = (name, ...given) => {
    const code = module[`_hf_gltf_${name}`](...given);
    if (!code) return;
    const detail = module._malloc(DETAIL);
    module._hf_gltf_error_get_detail(detail);
    const message = text(detail + MESSAGE_AT, DETAIL - MESSAGE_AT);
    module._free(detail);
    throw Object.assign(new Error(message), { code });
  };
  /** Runs an act with memory of its own: space(bytes or an array) gives an address, all is freed behind it. */
  const within = (act) => {
    const blocks = [];
    const space = (given) => {
      const bytes = typeof given === 'number' ? new Uint8Array(given) : new Uint8Array(given.buffer, given.byteOffset, given.byteLength);
      const at = module._malloc(Math.max(bytes.length, 1));
      if (!at) throw new Error('Memory ran out. Close other pages, or make the mesh coarser.');
      blocks.push(at);
      module.HEAPU8.set(bytes, at);
      return at;
    };
    /** A struct of 32-bit words, its size first. */
    const struct = (size, ...words) => {
      const at = space(size);
      module.HEAPU32.set([size, ...words], at >> 2);
      return at;
    };
    try {
      return act(space, struct);
    } finally {
      for (const at of blocks) module._free(at);
    }
  };
  const word = (at) => module.HEAPU32[at >> 2];
  const doubles = (at, count) => Array.from(module.HEAPF64.subarray(at >> 3, (at >> 3) + count));
  return { module, ok, text, within, word, doubles };
}

// sizes of the structs of include/hf_gltf/gltf.h in WebAssembly (tests/studio/story_transfer.mjs would notice)
const [DETAIL, MESSAGE_AT] = [312, 56];
