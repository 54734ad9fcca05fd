// The WebAssembly build, in browsers, Workers and node. No import of node is reached from here.
import createHf, { wasmUrl } from '../dist/hf.mjs';
import { loader } from './wasm.js';

export { HfError } from './marshal.js';

/** Loads hf.wasm. options.wasm: its bytes or its address, where a bundler or a host has moved it. */
export const load = loader(createHf, wasmUrl);
