// In node: the native library through koffi, and WebAssembly where there is none. `import { load } from 'hf-fields/wasm'`
// takes WebAssembly at once.
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { nativeBackend } from './native.js';
import { makeApi } from './objects.js';

export { HfError } from './marshal.js';

// bundlers for servers follow an imported createRequire to the binaries of koffi, and fail
const require = process.getBuiltinModule('node:module').createRequire(import.meta.url);

/**
 * Loads the library: options.library or $HF_LIBRARY and no other; else that in dist/ of this package, of the platform's
 * package, or of the system; else WebAssembly. hf.backend says which it is.
 */
export async function load({ library = process.env.HF_LIBRARY, ...options } = {}) {
  const failures = [];
  try {
    const koffi = require('koffi');
    for (const path of library ? [library] : candidates()) {
      try {
        return makeApi(nativeBackend(koffi, path));
      } catch (error) {
        failures.push(`${path}: ${error.message}`);
      }
    }
  } catch (error) {
    failures.push(`the native library needs the package koffi (npm install koffi): ${error.message}`);
  }
  if (library) throw new Error(`the hf library could not be loaded. ${failures.join('; ')}`);
  const web = await import('./web.js').catch(({ message }) => {
    throw new Error(`no hf library here; set HF_LIBRARY to libhf.so. ${[...failures, message].join('; ')}`);
  });
  return web.load(options);
}

function candidates() {
  const name = { win32: 'hf.dll', darwin: 'libhf.dylib' }[process.platform] ?? 'libhf.so.0';
  const found = [join(fileURLToPath(import.meta.url), '../../dist', name)].filter(existsSync);
  try {
    // the package of this platform, which npm installs beside this one (optionalDependencies)
    const file = process.platform === 'win32' ? 'hf.dll' : 'libhf.so';
    found.push(require.resolve(`hf-fields-${process.platform}-${process.arch}/${file}`));
  } catch {} // not installed
  return [...found, name];
}
