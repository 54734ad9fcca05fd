// loadBackend('native' | 'wasm'): { api, backend } of the JavaScript package; ends with 77 (skipped) where it is not.
// HF_LIBRARY: the shared library (native); HF_WASM: folder of hf.mjs and hf.wasm (wasm); HF_NODE_MODULES: where koffi
// is.
import assert from 'node:assert/strict';
import { readFileSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const js = join(here, '../../bindings/js/src');
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};

export async function loadBackend(kind) {
  if (kind === 'native') {
    const { nativeBackend } = await import(pathToFileURL(join(js, 'native.js')));
    const { makeApi } = await import(pathToFileURL(join(js, 'objects.js')));
    let koffi;
    try {
      koffi = createRequire(join(process.env.HF_NODE_MODULES ?? here, 'x.js'))('koffi');
    } catch {
      skip('the npm package koffi is not here (HF_NODE_MODULES)');
    }
    const backend = nativeBackend(koffi, process.env.HF_LIBRARY);
    return { api: makeApi(backend), backend };
  }
  const { apiOf } = await import(pathToFileURL(join(js, 'wasm.js')));
  const folder = process.env.HF_WASM;
  try {
    statSync(join(folder, 'hf.wasm'));
  } catch {
    skip('hf.wasm was not built (Debian: emscripten)');
  }
  const bytes = readFileSync(join(folder, 'hf.wasm'));
  console.log(`hf.wasm: ${(bytes.length / 1e6).toFixed(2)} MB`);
  // skeletons, retargets and following are 0.26 MB of it, edits 0.07; the slim build has neither
  assert.ok(bytes.length < 2.49e6, 'the wasm file is to stay below 2.49 MB');
  const { default: factory } = await import(pathToFileURL(join(folder, 'hf.mjs')));
  return { api: await apiOf(factory, bytes), backend: null };
}
