// The WebAssembly backend: arguments are copied into the module's memory for the call and results out of it. One block
// holds all memory of a call, so a call allocates once.
import { fail } from './marshal.js';
import { makeApi } from './objects.js';

const align = (size) => (size + 15) & ~15;
const bytesOf = (argument) => {
  const memory = argument?.array ?? argument?.bytes;
  return memory && new Uint8Array(memory.buffer, memory.byteOffset, memory.byteLength);
};
const measure = (argument) => {
  const inside = [...(argument?.pointers?.values() ?? [])];
  return inside.reduce((sum, target) => sum + measure(target), align(bytesOf(argument)?.length ?? 0));
};

export function wasmBackend(module) {
  // a thread of the library may have grown the memory: then the view of it that is there is too short
  const heap = () => {
    const { wasmMemory } = module;
    if (wasmMemory && module.HEAPU8.buffer !== wasmMemory.buffer) module.HEAPU8 = new Uint8Array(wasmMemory.buffer);
    return module.HEAPU8;
  };
  return {
    name: 'wasm',
    width: 0,
    newHandle: () => new Uint32Array(1),
    // first pass: how many bytes; second: copy in; third: copy out
    call(name, args) {
      const run = module['_' + name];
      if (!run) fail("not in the slim build; import { load } from 'hf-fields'", 'HF_ERROR_UNSUPPORTED', null, name);
      const total = args.reduce((sum, argument) => sum + measure(argument), 0);
      const block = total ? module._malloc(total) >>> 0 : 0;
      if (total && !block)
        fail(`${total} bytes of WebAssembly memory are not to be had`, 'HF_ERROR_OUT_OF_MEMORY', null, name);
      let next = block;
      const back = [];
      const place = (argument) => {
        const bytes = bytesOf(argument);
        if (!bytes) return Number(argument ?? 0);
        const at = next;
        next += align(bytes.length);
        for (const [offset, target] of argument.pointers ?? []) argument.view.setUint32(offset, place(target), true);
        heap().set(bytes, at);
        if (argument.written !== false) back.push([at, bytes]); // a struct has no mark
        return at;
      };
      try {
        const result = run(...args.map(place));
        for (const [at, bytes] of back) bytes.set(heap().subarray(at, at + bytes.length));
        return result;
      } finally {
        if (block) module._free(block);
      }
    },
  };
}

/** The API over the module that the glue of Emscripten makes of the bytes of hf.wasm. */
export const apiOf = async (create, wasmBinary) => makeApi(wasmBackend(await create({ wasmBinary })));

/** The bytes of hf.wasm: given, or fetched from an address. */
async function bytesAt(wasm) {
  if (wasm instanceof ArrayBuffer || ArrayBuffer.isView(wasm)) return wasm;
  // node's fetch reads no files; an import of node:fs would stop bundlers for browsers
  if (String(wasm).startsWith('file:')) return globalThis.process.getBuiltinModule('node:fs').readFileSync(new URL(wasm));
  const answer = await fetch(wasm);
  const bytes = new Uint8Array(await answer.arrayBuffer());
  // servers of pages answer with index.html for files that they do not have
  if (answer.ok && String(bytes.subarray(0, 4)) === '0,97,115,109') return bytes;
  const file = /[^/]*$/.exec(new URL(wasm, 'file:').pathname)[0];
  throw new Error(`${wasm} is not WebAssembly (${answer.status} ${answer.headers.get('content-type')}): \
copy node_modules/hf-fields/dist/${file} there, or give load({ wasm }) its address`);
}

/** load() of a build: the glue and the address of its file. */
export function loader(create, wasmUrl) {
  // the glue would ask import.meta.url, which a classic script has not
  const own = (options) => create({ ...options, locateFile: (name) => name });
  return async ({ factory = own, wasm = wasmUrl() } = {}) => apiOf(factory, await bytesAt(wasm));
}
