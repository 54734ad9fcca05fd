// Types of hf-fields/slim: those of hf-fields without the classes that hf_slim.wasm leaves out.
import type { Api, LoadOptions } from './index.js';

export * from './index.js';
export type SlimApi = Omit<Api, 'Geodesics' | 'Direction' | 'Quads' | 'Flow' | 'Region' | 'Detail' | 'Retarget' | 'Skeleton' | 'Transfer' | 'Weights'>;
export function load(options?: LoadOptions): Promise<SlimApi>;
