// In node: the native library through koffi. `import { load } from 'hf-fields/wasm'` gives the WebAssembly build
// instead.
import { existsSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { nativeBackend } from './native.js';
import { makeApi } from './objects.js';

export { HfError } from './marshal.js';

const candidates = () => {
  const name = { win32: 'hf.dll', darwin: 'libhf.dylib' }[process.platform] ?? 'libhf.so.0';
  const beside = fileURLToPath(new URL(`../dist/${name}`, import.meta.url));
  return process.env.HF_LIBRARY ? [process.env.HF_LIBRARY] : [...(existsSync(beside) ? [beside] : []), name];
};

/** Loads the library: options.library, $HF_LIBRARY, dist/ of this package, or the system's. */
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
