// The WebAssembly backend: arguments are copied into the module's memory for the call and results out of it. One block
// holds all memory of a call, so a call allocates once.
import { fail } from './marshal.js';

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
        const result = module['_' + name](...args.map(place));
        for (const [at, bytes] of back) bytes.set(heap().subarray(at, at + bytes.length));
        return result;
      } finally {
        if (block) module._free(block);
      }
    },
  };
}
