// node validate.mjs NODE_MODULES FOLDER: the Khronos validator over every .glb and .gltf of the folder.
// Prints each error and a summary; ends with 1 when there was an error, 2 when there was nothing to check.
import { createRequire } from 'node:module';
import { readFileSync, readdirSync } from 'node:fs';
import { join, resolve } from 'node:path';

const [modules, folder] = process.argv.slice(2);
const validator = createRequire(join(resolve(modules), 'gltf-validator', 'index.js'))('./index.js');
const files = readdirSync(folder).filter((name) => /\.(glb|gltf)$/.test(name)).sort();
let errors = 0;
let warnings = 0;
for (const name of files) {
  const bytes = new Uint8Array(readFileSync(join(folder, name)));
  let report;
  try {
    // an image that lies beside a model stays there: the written file names it, and it is not in this folder
    report = await validator.validateBytes(bytes, { uri: name, maxIssues: 1000, ignoredIssues: ['IO_ERROR'] });
  } catch (error) {
    console.log(`${name}: ${error}`);
    errors += 1;
    continue;
  }
  errors += report.issues.numErrors;
  warnings += report.issues.numWarnings;
  for (const issue of report.issues.messages.filter((message) => message.severity === 0).slice(0, 5)) {
    console.log(`${name}: ${issue.code} ${issue.pointer}: ${issue.message}`);
  }
}
console.log(`${files.length} files, ${errors} errors, ${warnings} warnings`);
process.exit(files.length === 0 ? 2 : errors > 0 ? 1 : 0);
