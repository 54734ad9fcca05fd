// The WebAssembly backend: arguments are copied into the module's memory for the call and results out of it. One block
// holds all memory of a call, so a call allocates once.
import { Memory, Struct } from './marshal.js';
import { HfError } from './marshal.js';
import { constants } from './raw.js';

const align = (size) => (size + 15) & ~15;

export function wasmBackend(module) {
  // first pass: how many bytes; second: copy in; third: copy out
  const measure = (argument) => {
    if (argument instanceof Memory) return align(argument.array.byteLength);
    if (argument instanceof Struct)
      return align(argument.bytes.length) + argument.pointers.reduce((sum, [, target]) => sum + measure(target), 0);
    return 0;
  };
  // a thread of the library may have grown the memory: then the view of it that is there is too short
  const heap = () => {
    const { wasmMemory } = module;
    if (wasmMemory && module.HEAPU8.buffer !== wasmMemory.buffer) module.HEAPU8 = new Uint8Array(wasmMemory.buffer);
    return module.HEAPU8;
  };
  const bytesOf = (array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  return {
    name: 'wasm',
    width: 0,
    newHandle: () => new Uint32Array(1),
    call(name, args) {
      const total = args.reduce((sum, argument) => sum + measure(argument), 0);
      const block = total ? module._malloc(total) >>> 0 : 0;
      if (total && !block)
        throw new HfError(
          `${total} bytes of WebAssembly memory are not to be had`,
          constants.HF_ERROR_OUT_OF_MEMORY,
          null,
          name,
        );
      let next = block;
      const back = [];
      const place = (argument) => {
        if (argument === null || argument === undefined) return 0;
        if (argument instanceof Memory) {
          const at = next;
          next += align(argument.array.byteLength);
          heap().set(bytesOf(argument.array), at);
          if (argument.written) back.push([at, bytesOf(argument.array)]);
          return at;
        }
        if (argument instanceof Struct) {
          const at = next;
          next += align(argument.bytes.length);
          for (const [offset, target] of argument.pointers) argument.view.setUint32(offset, place(target), true);
          heap().set(argument.bytes, at);
          back.push([at, argument.bytes]);
          return at;
        }
        return typeof argument === 'boolean' ? Number(argument) : argument;
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
