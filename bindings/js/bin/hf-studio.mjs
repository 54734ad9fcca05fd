#!/usr/bin/env node
// hf-studio [PORT [FOLDER]]: serves the studio on the loopback address and prints the link. The folder of the package is
// written by samples/studio/run --build bindings/js/studio.
import { createReadStream, existsSync, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';

const [port = '0', folder = fileURLToPath(new URL('../studio', import.meta.url))] = process.argv.slice(2);
if (!existsSync(join(folder, 'index.html'))) {
  console.error('error: this package was made without the studio; samples/studio/run --build DIR writes it');
  process.exit(1);
}
const types = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.wasm': 'application/wasm',
  '.glb': 'model/gltf-binary',
  '.txt': 'text/plain',
};

const server = createServer((request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, 'http://x').pathname));
  const file = join(folder, path.endsWith('/') ? `${path}index.html` : path);
  if (!existsSync(file) || !statSync(file).isFile()) return response.writeHead(404).end();
  response.writeHead(200, {
    'content-type': types[extname(file)] ?? 'application/octet-stream',
    'content-length': statSync(file).size,
    // the page and its Worker share files: the second takes them from the first
    'cache-control': 'max-age=5',
    'cross-origin-opener-policy': 'same-origin',
    'cross-origin-embedder-policy': 'require-corp',
  });
  return createReadStream(file).pipe(response);
});
server.on('error', (error) => {
  console.error(`error: the port ${port} is not to be had: ${error.code}; name another with --port`);
  process.exit(1);
});
server.listen(Number(port), '127.0.0.1', () => console.log(`hf studio: http://127.0.0.1:${server.address().port}/`));
