// In node: the native library through koffi. `import { load } from 'hf-fields/wasm'` gives the WebAssembly build
// instead.
import { existsSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { nativeBackend } from './native.js';
import { makeApi } from './objects.js';

export { HfError } from './marshal.js';

/** Loads the library: options.library, $HF_LIBRARY, dist/ of this package, the platform's package, or the system's. */
export async function load({ library = process.env.HF_LIBRARY } = {}) {
  const koffi = await import('koffi').catch(({ message }) => {
    throw new Error(`the native backend needs the package koffi (npm install koffi), or hf-fields/wasm: ${message}`);
  });
  const failures = [];
  for (const path of library ? [library] : candidates()) {
    try {
      return makeApi(nativeBackend(koffi.default, path));
    } catch (error) {
      failures.push(`${path}: ${error.message}`);
    }
  }
  throw new Error(`the hf library was not found; set HF_LIBRARY to libhf.so. ${failures.join('; ')}`);
}

function candidates() {
  const name = { win32: 'hf.dll', darwin: 'libhf.dylib' }[process.platform] ?? 'libhf.so.0';
  const found = [fileURLToPath(new URL(`../dist/${name}`, import.meta.url))].filter(existsSync);
  try {
    // the package of this platform, which npm installs beside this one (optionalDependencies)
    const file = process.platform === 'win32' ? 'hf.dll' : 'libhf.so';
    found.push(createRequire(import.meta.url).resolve(`hf-fields-${process.platform}-${process.arch}/${file}`));
  } catch {} // not installed
  return [...found, name];
}
