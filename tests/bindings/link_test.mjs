// A link of the studio is read, or it is damaged and said so: it cannot fill the memory.
import { deflateRawSync } from 'node:zlib';
import { pathToFileURL } from 'node:url';

const { settingsOf } = await import(pathToFileURL(process.argv[2]));
const link = (bytes) => `#s=${deflateRawSync(bytes).toString('base64url')}`;
let [passed, failed] = [0, 0];
async function check(name, hash, settings, told) {
  let said = null;
  const read = await settingsOf(hash, { say: (text) => (said = text) });
  const right = JSON.stringify(read) === JSON.stringify(settings) && (said !== null) === told;
  right ? ++passed : ++failed;
  console.log(`${right ? 'ok     ' : 'FAILED '} ${name}: ${said}`);
}
const settings = { name: 'horse.glb', vertexCount: 5000 };
const whole = link(JSON.stringify(settings));
await check('a link', whole, settings, false);
await check('no link', '#top', null, false);
await check('a link that was cut', whole.slice(0, -5), null, true);
await check('a link that was changed', `${whole.slice(0, 20)}!!${whole.slice(22)}`, null, true);
const filling = link(Buffer.alloc(1 << 28, ' '));
const before = process.resourceUsage().maxRSS;
await check('a link made to fill the memory', filling, null, true);
const grown = 1024 * (process.resourceUsage().maxRSS - before);
grown < 100e6 ? ++passed : ++failed;
console.log(`memory has grown by ${(grown / 1e6).toFixed(0)} MB\n${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
