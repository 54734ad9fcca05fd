// The small WebAssembly build: surfaces, fields and poses. Calls of other functions fail with HF_ERROR_UNSUPPORTED.
import createHf, { wasmUrl } from '../dist/hf_slim.mjs';
import { loader } from './wasm.js';

export { HfError } from './marshal.js';

/** Loads hf_slim.wasm. options.wasm: its bytes or its address, where a bundler or a host has moved it. */
export const load = loader(createHf, wasmUrl);
