#!/usr/bin/env node
// hf-studio [PORT [FOLDER]]: serves the studio on the loopback address and prints the link. The folder of the package
// is written by samples/studio/run --build bindings/js/studio/page.
import { createReadStream, existsSync, fstatSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { pipeline } from 'node:stream';
import { fileURLToPath } from 'node:url';

const [port = '0', folder = fileURLToPath(new URL('../page', import.meta.url))] = process.argv.slice(2);
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

/** The file that a request asks for, or null: no such path, or one outside the folder. */
function fileOf(url) {
  let path;
  try {
    path = normalize(decodeURIComponent(url.replace(/[?#].*/, '')));
  } catch {
    return null;
  }
  if (!/^[/\\]/.test(path) || path.includes('\0')) return null;
  return join(folder, /[/\\]$/.test(path) ? `${path}index.html` : path);
}

const server = createServer((request, response) => {
  const refuse = (status) => response.writeHead(status).end();
  // a page of another name that points to this address may not read what is served here (DNS rebinding)
  if (!/^(127\.0\.0\.1|localhost|\[::1\])(:\d+)?$/.test(request.headers.host ?? '')) return refuse(403);
  if (request.method !== 'GET') return refuse(405);
  const file = fileOf(request.url);
  if (!file) return refuse(400);
  const stream = createReadStream(file);
  stream.on('open', (descriptor) => {
    const found = fstatSync(descriptor);
    if (!found.isFile()) return stream.destroy(new Error('not a file'));
    response.writeHead(200, {
      'content-type': types[extname(file)] ?? 'application/octet-stream',
      'content-length': found.size,
      // the page and its Worker share files: the second takes them from the first
      'cache-control': 'max-age=5',
      'cross-origin-opener-policy': 'same-origin',
      'cross-origin-embedder-policy': 'require-corp',
    });
    return pipeline(stream, response, () => {});
  });
  // no such file, a folder, or a file that goes while it is read
  return stream.on('error', () => (response.headersSent ? response.destroy() : refuse(404)));
});
server.on('error', (error) => {
  console.error(`error: the port ${port} is not to be had: ${error.code}; name another`);
  process.exit(1);
});
server.listen(Number(port), '127.0.0.1', () => console.log(`hf studio: http://127.0.0.1:${server.address().port}/`));
