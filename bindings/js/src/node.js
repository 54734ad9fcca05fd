// In node: the native library through koffi. `import { load } from 'hf-fields/wasm'` gives the WebAssembly build
// instead.
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { nativeBackend } from './native.js';
import { makeApi } from './objects.js';

export { HfError } from './marshal.js';

// The library in the package of this platform, which npm installs beside this one (optionalDependencies).
const packaged = () => {
  const file = process.platform === 'win32' ? 'hf.dll' : 'libhf.so';
  try {
    return [createRequire(import.meta.url).resolve(`hf-fields-${process.platform}-${process.arch}/${file}`)];
  } catch {
    return [];
  }
};

const candidates = () => {
  const name = { win32: 'hf.dll', darwin: 'libhf.dylib' }[process.platform] ?? 'libhf.so.0';
  const beside = fileURLToPath(new URL(`../dist/${name}`, import.meta.url));
  return process.env.HF_LIBRARY ? [process.env.HF_LIBRARY] : [...(existsSync(beside) ? [beside] : []), ...packaged(), name];
};

/** Loads the library: options.library, $HF_LIBRARY, dist/ of this package, the platform's package, or the system's. */
export async function load({ library } = {}) {
  let koffi;
  try {
    koffi = (await import('koffi')).default;
  } catch (error) {
    throw new Error(
      `the native backend needs the package koffi (npm install koffi), or use hf-fields/wasm: ${error.message}`,
    );
  }
  const failures = [];
  for (const path of library ? [library] : candidates()) {
    try {
      return makeApi(nativeBackend(koffi, path));
    } catch (error) {
      failures.push(`${path}: ${error.message}`);
    }
  }
  throw new Error(`the hf library was not found; set HF_LIBRARY to libhf.so. ${failures.join('; ')}`);
}
