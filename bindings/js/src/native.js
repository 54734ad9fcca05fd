// The native backend: the shared library through koffi. Memory of typed arrays is passed by its address and kept alive
// for the call; nothing is copied.
import { functions } from './raw.js';
import { Memory, Struct } from './marshal.js';

const kinds = {
  i32: 'int32_t',
  u32: 'uint32_t',
  size: 'size_t',
  f64: 'double',
  string: 'str',
  void: 'void',
  handle: 'uintptr_t',
  ptr: 'uintptr_t',
};

export function nativeBackend(koffi, path) {
  const library = koffi.load(path);
  const bound = new Map();
  const functionOf = (name) => {
    let entry = bound.get(name);
    if (!entry) {
      const [result, parameters] = functions[name];
      bound.set(
        name,
        (entry = library.func(
          name,
          kinds[result],
          parameters.map((kind) => kinds[kind]),
        )),
      );
    }
    return entry;
  };
  // the address an argument stands for; `held` keeps what it points to alive
  const resolve = (argument, held) => {
    if (argument === null || argument === undefined) return 0n;
    if (argument instanceof Memory) {
      held.push(argument.array);
      return koffi.address(argument.array);
    }
    if (argument instanceof Struct) {
      for (const [at, target] of argument.pointers) argument.view.setBigUint64(at, BigInt(resolve(target, held)), true);
      held.push(argument.bytes);
      return koffi.address(argument.bytes);
    }
    return argument;
  };
  return {
    name: 'native',
    width: 1,
    newHandle: () => new BigUint64Array(1),
    call(name, args) {
      const held = [];
      return functionOf(name)(...args.map((argument) => resolve(argument, held)));
    },
  };
}
