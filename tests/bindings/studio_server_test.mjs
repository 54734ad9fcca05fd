// The server of the studio stands, whatever a page or a program on this machine asks it for, and gives its own files alone.
import { spawn } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { connect } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const [program] = process.argv.slice(2);
const above = mkdtempSync(join(tmpdir(), 'hf-studio-'));
const folder = join(above, 'page');
writeFileSync(join(above, 'secret.txt'), 'secret');
mkdirSync(folder);
writeFileSync(join(folder, 'index.html'), 'the page');
writeFileSync(join(folder, 'a b.txt'), 'named');
writeFileSync(join(folder, 'large.bin'), Buffer.alloc(1 << 24));

const server = spawn(process.execPath, [program, '0', folder], { stdio: ['ignore', 'pipe', 'inherit'] });
let ended = false;
server.on('exit', () => (ended = true));
const port = await new Promise((resolve) => server.stdout.on('data', (text) => resolve(/:(\d+)\//.exec(text)[1])));

/** The status and the body of one request, written as given. */
function ask(path, { host = `127.0.0.1:${port}`, method = 'GET', leaveAfter = Infinity } = {}) {
  return new Promise((resolve, reject) => {
    let text = '';
    const socket = connect(port, '127.0.0.1', () =>
      socket.write(`${method} ${path} HTTP/1.1\r\nHost: ${host}\r\nConnection: close\r\n\r\n`),
    );
    socket.on('data', (data) => {
      text += data.toString('latin1');
      if (text.length > leaveAfter) socket.destroy();
    });
    socket.on('close', () => resolve({ status: Number(text.split(' ')[1]), body: text.split('\r\n\r\n')[1] }));
    socket.on('error', reject);
    socket.setTimeout(5000, () => reject(new Error(`${path}: no answer`)));
  });
}

let [passed, failed] = [0, 0];
async function check(name, path, options, status, body) {
  const answer = await ask(path, options).catch((error) => ({ status: error.message }));
  const right = answer.status === status && (body === undefined || answer.body === body) && !ended;
  right ? ++passed : ++failed;
  console.log(`${right ? 'ok     ' : 'FAILED '} ${name}: ${answer.status}${ended ? ', the server ended' : ''}`);
}
await check('the page', '/', {}, 200, 'the page');
await check('a name with a space, and a query', '/a%20b.txt?x=1', {}, 200, 'named');
await check('localhost is this machine too', '/', { host: `localhost:${port}` }, 200, 'the page');
await check('a page of another name is refused', '/', { host: 'evil.example' }, 403);
await check('a name that begins like this machine is refused', '/', { host: '127.0.0.1.evil.example' }, 403);
await check('bytes that are no text', '/%ff', {}, 400);
await check('half of an escape', '/%', {}, 400);
await check('a zero', '/%00', {}, 400);
await check('two slashes are the page', '//', {}, 200, 'the page');
await check('another host in the path', '//evil.example/x', {}, 404);
await check('an address for a path', 'http://evil.example/', {}, 400);
for (const path of ['/..%2fsecret.txt', '/%2e%2e/secret.txt', '/../secret.txt', '/..%5csecret.txt'])
  await check(`above the folder: ${path}`, path, {}, 404);
await check('no such file', '/nothing.js', {}, 404);
await check('a folder above a file', '/index.html/', {}, 404);
await check('what changes files', '/', { method: 'DELETE' }, 405);
await check('a reader that leaves early', '/large.bin', { leaveAfter: 1 << 16 }, 200);
await check('and the page after it', '/', {}, 200, 'the page');
server.kill();
rmSync(above, { recursive: true });
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
