// In the browser (and in node, when asked for): the WebAssembly build.
import { wasmBackend } from './wasm.js';
import { makeApi } from './objects.js';

export { HfError } from './marshal.js';

/** Loads the module: options.factory (the default export of dist/hf.mjs) and options.wasmBinary, or both from dist/. */
export async function load({ factory, wasmBinary } = {}) {
  const glue = new URL('../dist/hf.mjs', import.meta.url);
  const create = factory ?? (await import(/* @vite-ignore */ glue.href)).default;
  if (!wasmBinary) {
    const url = new URL('../dist/hf.wasm', import.meta.url);
    if (url.protocol === 'file:') wasmBinary = await (await import('node:fs/promises')).readFile(url);
    else wasmBinary = await (await fetch(url)).arrayBuffer();
  }
  const module = await create({ wasmBinary });
  return makeApi(wasmBackend(module));
}
