// The README's program as a user would run it: js_readme.mjs PROGRAM native | wasm, with the package and koffi in a
// node_modules of its own.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, rmSync, symlinkSync, writeFileSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const program = process.argv[2];
if (!existsSync(join(process.env.HF_NODE_MODULES, 'koffi'))) {
  console.log('skipped: the npm package koffi is not here (HF_NODE_MODULES)');
  process.exit(77);
}
const folder = join(dirname(program), 'js_readme');
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(folder, 'node_modules'), { recursive: true });
// the package is copied, not linked: node looks for koffi beside where a module really is
spawnSync('cp', ['-r', join(here, '../../bindings/js'), join(folder, 'node_modules/hf-fields')]);
for (const name of ['koffi', '@koromix'])
  symlinkSync(join(process.env.HF_NODE_MODULES, name), join(folder, 'node_modules', name));
writeFileSync(join(folder, 'program.mjs'), readFileSync(program));
const run = spawnSync(process.execPath, [join(folder, 'program.mjs')], { stdio: 'inherit' });
process.exit(run.status ?? 1);
