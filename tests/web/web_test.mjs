// The package in bundlers, pages, Workers, node, Deno and Bun: web_test.mjs quick|all SCRATCH. It packs bindings/js, installs
// the archive into an empty folder, and does with it what bindings/js/README.md says under "Where it runs".
// HF_WASM: folder of hf.wasm; HF_LIBRARY: the shared library; HF_NODE_MODULES: npm packages of tests/npm, HF_WEB_MODULES:
// those of tests/web.
import { spawn, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { basename, delimiter, dirname, extname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';

const here = dirname(fileURLToPath(import.meta.url));
const js = join(here, '../../bindings/js');
const [form, scratchGiven] = process.argv.slice(2);
const scratch = resolve(scratchGiven);
const modules = [process.env.HF_NODE_MODULES, process.env.HF_WEB_MODULES].filter((folder) => folder && existsSync(folder));
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};
for (const name of ['hf', 'hf_slim'])
  if (!existsSync(join(process.env.HF_WASM ?? '', `${name}.wasm`))) skip(`${name}.wasm was not built (Debian: emscripten)`);
if (spawnSync('npm', ['--version']).error) skip('no npm here');
const found = (name) => modules.map((folder) => join(folder, name)).find(existsSync);

// ---- the package, as npm packs and installs it
rmSync(scratch, { recursive: true, force: true });
const packed = join(scratch, 'packed');
mkdirSync(join(packed, 'dist'), { recursive: true });
for (const name of ['src', 'package.json', 'README.md']) cpSync(join(js, name), join(packed, name), { recursive: true });
for (const name of ['hf.mjs', 'hf.wasm', 'hf_slim.mjs', 'hf_slim.wasm'])
  cpSync(join(process.env.HF_WASM, name), join(packed, 'dist', name));
const npm = (cwd, ...given) => {
  const run = spawnSync('npm', [...given, '--cache', join(scratch, 'npm_cache')], { cwd, encoding: 'utf8' });
  if (run.status) throw new Error(`npm ${given[0]}: ${run.stderr}`);
  return run.stdout;
};
const archive = join(packed, npm(packed, 'pack', '--silent').trim());
const empty = join(scratch, 'empty');
mkdirSync(empty);
writeFileSync(join(empty, 'package.json'), '{ "private": true, "type": "module" }');
npm(empty, 'install', '--offline', '--ignore-scripts', '--no-audit', '--no-fund', '--omit=optional', archive);
const kilo = (file) => `${(readFileSync(file).length / 1000).toFixed(0)} kB, ${(gzipSync(readFileSync(file), { level: 9 }).length / 1000).toFixed(0)} with gzip`;
console.log(`${basename(archive)}: ${(readFileSync(archive).length / 1e6).toFixed(2)} MB`);
for (const name of ['hf.wasm', 'hf_slim.wasm']) console.log(`${name}: ${kilo(join(packed, 'dist', name))}`);

// ---- what the README says
const parts = Object.fromEntries(
  readFileSync(join(js, 'README.md'), 'utf8')
    .split(/^##+ /m)
    .map((text) => {
      const blocks = Array.from(text.matchAll(/^```(\w+)\n([^]*?)^```/gm), ([, kind, block]) => [kind, block]);
      const files = blocks.map(([, block]) => [/^(?:\/\/|<!--) (\S+\.\w+)/.exec(block)?.[1], block]).filter(([name]) => name);
      const commands = blocks.filter(([kind]) => kind === 'sh').flatMap(([, block]) => block.trim().split('\n'));
      return [text.split('\n')[0], { files: Object.fromEntries(files), commands }];
    }),
);
const usual = {
  ...parts['Where it runs'].files,
  'index.html': '<!doctype html>\n<body><script type="module" src="main.js"></script>\n',
  'field.js': readFileSync(join(here, 'field.js')),
};
const expected = (backend) => `${backend}: 0 0 0.5 0.5 1 1, 2 0 1`;

/** A folder with the installed package and some files. */
function folderOf(name, files) {
  const folder = join(scratch, name);
  cpSync(empty, folder, { recursive: true });
  for (const [file, text] of Object.entries({ ...usual, ...files })) {
    mkdirSync(dirname(join(folder, file)), { recursive: true });
    writeFileSync(join(folder, file), text);
  }
  return folder;
}

// ---- how it is run
const bun = modules.flatMap((folder) => (existsSync(join(folder, '@oven')) ? readdirSync(join(folder, '@oven')).map((one) => join(folder, '@oven', one, 'bin')) : []));
const path = [...bun, ...modules.map((folder) => join(folder, '.bin')), dirname(process.execPath), process.env.PATH].join(delimiter);
const { HF_LIBRARY: library, ...plainEnv } = process.env;
const clean = { ...plainEnv, PATH: path, NO_COLOR: '1', NEXT_TELEMETRY_DISABLED: '1', DO_NOT_TRACK: '1', CI: '1' };

/** Runs a line of the README: what it printed, or the address of a server and what ends it. */
function run(line, cwd, env = clean) {
  const [program, ...given] = line.replace(/^npx /, '').split(' ');
  const child = spawn(program, given, { cwd, env, detached: true });
  const end = () => process.kill(-child.pid);
  return new Promise((done, fail) => {
    let text = '';
    const hear = (data) => {
      text += data;
      const address = /http:\/\/localhost:\d+/.exec(text)?.[0];
      if (address) done({ address, end });
    };
    child.stdout.on('data', hear);
    child.stderr.on('data', hear);
    child.on('error', fail);
    child.on('close', (code) => (code === 0 ? done({ text }) : fail(new Error(`${line}: ${text.slice(-2000)}`))));
  });
}

const types = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm' };
/** A server of a folder, as any host of files: what is not there is the page, as for apps of one page. */
async function serve(folder) {
  const server = createServer((request, response) => {
    const asked = join(folder, new URL(request.url, 'http://host').pathname.replace(/\/$/, '/index.html'));
    const file = existsSync(asked) ? asked : join(folder, 'index.html');
    response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' });
    response.end(readFileSync(file));
  });
  await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
  return { address: `http://127.0.0.1:${server.address().port}`, end: () => server.close() };
}

let browser = null;
const browserPath = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'].find(existsSync);
/** What a page says at last. */
async function look({ address, end }, wanted) {
  browser ??= await createRequire(join(process.env.HF_NODE_MODULES, 'x.js'))('playwright-core').chromium.launch({ executablePath: browserPath, args: ['--no-sandbox'] });
  const page = await browser.newPage();
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(error.message));
  page.on('console', (message) => message.type() === 'error' && complaints.push(message.text()));
  try {
    await page.goto(address, { timeout: 120000 });
    await page.waitForFunction((text) => document.body?.innerText.includes(text), wanted, { timeout: 120000 });
  } catch (error) {
    throw new Error(`the page says "${await page.innerText('body').catch(() => '')}". ${complaints.join('; ') || error.message}`);
  } finally {
    await page.close();
    end();
  }
}

let [passed, failed, skipped] = [0, 0, 0];
/** One test: its name is the sentence it proves. needs: npm packages, and 'chromium'. */
async function check(name, needs, act) {
  const lacks = needs.find((need) => (need === 'chromium' ? !browserPath || !found('playwright-core') : !found(need)));
  if (lacks) {
    ++skipped;
    return console.log(`skipped ${name}: ${lacks} is not here`);
  }
  try {
    await act();
    ++passed;
    return console.log(`ok      ${name}`);
  } catch (error) {
    ++failed;
    return console.log(`FAILED  ${name}: ${error.message}`);
  }
}
function same(text, wanted) {
  if (!text.includes(wanted)) throw new Error(`"${text}" does not hold "${wanted}"`);
}

/** Builds a part of the README and looks at the page. change: of a command. */
async function build(title, { name = title, files = {}, change = (line) => line, commands = parts[title].commands, shown = 'dist' }) {
  const folder = folderOf(name.replaceAll(' ', '_'), { ...parts[title].files, ...files });
  for (const line of commands) await run(change(line), folder);
  await look(await serve(join(folder, shown)), expected('wasm'));
}

const slimFiles = parts['The small build'].files;
const workerFiles = parts['A Worker'].files;
const slimCopy = (line) => line.replace('/hf.wasm', '/hf_slim.wasm');
const secondEntry = (line) => line.replace('main.js', 'main.js worker.js');
async function bundler(title, needs, { entry = (line) => line } = {}) {
  const all = [...needs, 'chromium'];
  await check(`${title} makes a page`, all, () => build(title, {}));
  await check(`${title} makes a page and its Worker`, all, () => build(title, { name: `${title} Worker`, files: workerFiles, change: entry }));
  await check(`${title} makes a page of the small build`, all, () => build(title, { name: `${title} slim`, files: slimFiles, change: slimCopy }));
}

/** koffi for a folder. */
function giveKoffi(folder) {
  for (const name of ['koffi', '@koromix']) symlinkSync(found(name), join(folder, 'node_modules', name));
}
const consoleOf = (files) => Object.fromEntries(Object.entries(files).map(([name, text]) => [name, text.replace('document.body.append', 'console.log')]));
const [onNode, onDeno, onBun] = parts['Node, Deno, Bun'].commands;
const onConsole = parts['Node, Deno, Bun'].files;

async function quick() {
  await check('node without a native library takes WebAssembly and says so', [], async () => {
    same((await run(onNode, folderOf('node', onConsole))).text, expected('wasm'));
  });
  await check('node takes the native library where it is', library ? ['koffi'] : ['HF_LIBRARY'], async () => {
    const folder = folderOf('native', onConsole);
    giveKoffi(folder);
    same((await run(onNode, folder, { ...clean, HF_LIBRARY: library })).text, expected('native'));
  });
  await check('a named library that is not there is an error with its name', ['koffi'], async () => {
    const folder = folderOf('named', onConsole);
    giveKoffi(folder);
    const { message } = await run(onNode, folder, { ...clean, HF_LIBRARY: '/nothing.so' }).catch((error) => error);
    same(message, '/nothing.so: ');
  });
  await check('node plays the small build', [], async () => {
    same((await run(onNode, folderOf('node slim', consoleOf(slimFiles)))).text, expected('wasm'));
  });
  await check('a call outside the small build says so, and nothing else changes', [], async () => {
    const program = `import { load } from 'hf-fields/slim';
      const hf = await load();
      const surface = new hf.Surface([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);
      for (const act of [() => new hf.Quads(surface), () => new hf.Skeleton(), () => new hf.Transfer(surface, surface)])
        try { act(); } catch (error) { console.log(error.codeName, error.message); }
      console.log(surface.report.componentCount);`;
    const { text } = await run(onNode, folderOf('slim calls', { 'main.js': program }));
    for (const [i, name] of ['quads', 'skeleton', 'transfer'].entries())
      same(text.split('\n')[i], `HF_ERROR_UNSUPPORTED hf_${name}_create: not in the slim build; import { load } from 'hf-fields'`);
    same(text.split('\n')[3], '1');
  });
  await check('an address that is not WebAssembly is an error with the address and the remedy', [], async () => {
    const host = await serve(folderOf('lost', { 'main.js': `import { load } from 'hf-fields/wasm'; load({ wasm: process.env.AT });` }));
    const at = `${host.address}/assets/hf.wasm?1`;
    const { message } = await run(onNode, join(scratch, 'lost'), { ...clean, AT: at }).catch((error) => error);
    host.end();
    same(message, `${at} is not WebAssembly (200 text/html): copy node_modules/hf-fields/dist/hf.wasm there`);
  });
  await check('a page without a bundler', ['chromium'], () => build('A page without a bundler', { shown: '' }));
  await check('a page without a bundler and its Worker', ['chromium'], () => {
    const worker = workerFiles['worker.js'].replace("'hf-fields'", "'./node_modules/hf-fields/src/web.js'");
    return build('A page without a bundler', { name: 'page Worker', files: { ...workerFiles, 'worker.js': worker }, shown: '' });
  });
  await bundler('esbuild', ['esbuild'], { entry: secondEntry });
  await check('esbuild gives the file a name with a hash', ['esbuild', 'chromium'], () => {
    const main = usual['main.js'].replace('load()', 'load({ wasm })').replace(/^/, "import wasm from 'hf-fields/hf.wasm';\n");
    const change = (line) => line.replace('npx esbuild', 'npx esbuild --loader:.wasm=file').replace(/ \S*hf\.wasm/, '');
    return build('esbuild', { name: 'esbuild hash', files: { 'main.js': main }, change });
  });
  await check('esbuild makes a classic script', ['esbuild', 'chromium'], () => {
    const main = usual['main.js'].replace('document.body.append(field(await load()));', "load({ wasm: 'hf.wasm' }).then((hf) => document.body.append(field(hf)));");
    return build('esbuild', { name: 'esbuild classic', files: { 'main.js': main }, change: (line) => line.replace('=esm', '=iife') });
  });
  await check('esbuild makes a program for node', ['esbuild', 'koffi'], async () => {
    const folder = folderOf('esbuild node', onConsole);
    giveKoffi(folder);
    for (const line of parts.esbuild.commands) await run(line.replace('--format', '--platform=node --format'), folder);
    same((await run('node dist/main.js', folder)).text, expected('wasm'));
  });
  await check('the types are exact', ['typescript'], async () => {
    const folder = folderOf('types', { 'types.ts': readFileSync(join(here, 'types.ts')) });
    const strict = 'tsc --strict --noEmit --noUncheckedIndexedAccess --exactOptionalPropertyTypes --target es2022 --lib es2022,dom types.ts';
    for (const kind of ['--module esnext --moduleResolution bundler', '--module nodenext --moduleResolution nodenext']) await run(`${strict} ${kind}`, folder);
  });
}

async function long() {
  await bundler('Vite', ['vite']);
  await check('Vite serves a page while it is worked on', ['vite', 'chromium'], async () => {
    const folder = folderOf('Vite_dev', parts.Vite.files);
    await look(await run('npx vite', folder), expected('wasm'));
  });
  await bundler('webpack 5', ['webpack', 'webpack-cli']);
  await bundler('Rollup', ['rollup', '@rollup/plugin-node-resolve'], { entry: secondEntry });
  // as files, so that any server shows it
  const next = (options) => ({
    'next.config.mjs': `export default { output: 'export', turbopack: { root: ${JSON.stringify(resolve(scratch, '..'))} }, ${options} };`,
    'app/layout.jsx': 'export default ({ children }) => <html><body>{children}</body></html>;',
  });
  for (const more of ['', ' --webpack'])
    await check(`Next.js${more} makes a page of a client component`, ['next', 'chromium'], () =>
      build('Next.js', { name: `Next${more}`, files: next(''), change: (line) => line + more, shown: 'out' }),
    );
  await check('Next.js makes a page on the server', ['next', 'chromium'], () => {
    const [option] = /serverExternalPackages: \['hf-fields'\]/.exec(readFileSync(join(js, 'README.md'), 'utf8'));
    const page = `import { load } from 'hf-fields';
      import { field } from '../field.js';
      export default async function Page() { return <p>{field(await load())}</p>; }`;
    return build('Next.js', { name: 'Next server', files: { ...next(option), 'app/page.jsx': page }, shown: 'out' });
  });
  await check('Deno', ['deno'], async () => same((await run(onDeno, folderOf('deno', onConsole))).text, expected('wasm')));
  await check('Bun', ['bun'], async () => same((await run(onBun, folderOf('bun', onConsole))).text, expected('wasm')));
}

await quick();
if (form === 'all') await long();
await browser?.close();
console.log(`web: ${passed} passed, ${failed} failed, ${skipped} skipped`);
process.exit(failed ? 1 : 0);
