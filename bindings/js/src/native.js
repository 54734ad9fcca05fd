// The native backend: the shared library through koffi. Memory of typed arrays is passed by its address and kept alive
// for the call; nothing is copied.
import { functions } from './raw.js';
import { missing } from './marshal.js';

const whole = { i32: 'int32_t', u32: 'uint32_t', size: 'size_t', handle: 'uintptr_t', ptr: 'uintptr_t' };
const kinds = { ...whole, f64: 'double', string: 'str', void: 'void' };

export function nativeBackend(koffi, path) {
  const library = koffi.load(path);
  const bind = (name, [result, parameters]) => library.func(name, kinds[result], parameters.map((kind) => kinds[kind]));
  const bound = {};
  // the address an argument stands for; `held` keeps what it points to alive
  const resolve = (argument, held) => {
    if (missing(argument)) return 0n;
    const memory = argument.array ?? argument.bytes;
    if (!memory) return argument;
    const { view, pointers = [] } = argument;
    for (const [at, target] of pointers) view.setBigUint64(at, BigInt(resolve(target, held)), true);
    held.push(memory);
    return koffi.address(memory);
  };
  return {
    name: 'native',
    width: 1,
    newHandle: () => new BigUint64Array(1),
    call(name, args) {
      const held = [];
      return (bound[name] ??= bind(name, functions[name]))(...args.map((argument) => resolve(argument, held)));
    },
  };
}
