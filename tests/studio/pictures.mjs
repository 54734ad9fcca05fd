// Pictures of the studio, kept at half size in tests/studio/pictures and compared. Software rendering gives the same bytes in
// every start; what is allowed to differ is far less than a dot of a handle. HF_RENEW_PICTURES=1 writes them anew: look at
// every one of them before they are committed.
import { existsSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const kept = join(dirname(fileURLToPath(import.meta.url)), 'pictures');
const renew = Boolean(process.env.HF_RENEW_PICTURES);
const maker = join(kept, 'made_by.txt');

/** A channel (0 to 255) that differs by more than this makes a pixel different: kept channels are rounded to 4. */
const LEVEL = 16;
/** Different pixels of all: a dot of a handle is 0.05 % of a page. */
const SHARE = 2e-4;
/** Another Chromium has other letters and edges: then only what is gross is seen. */
const SHARE_OTHER = 0.05;
/** Bytes of all kept pictures. */
const BYTES = 4.5e6;

/** Runs in a page: the shot at half size, and how much it differs from the kept one. */
async function compareInPage([shot, old, level]) {
  const pixelsOf = async (base64) => {
    const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const context = canvas.getContext('2d');
    context.drawImage(picture, 0, 0);
    return context.getImageData(0, 0, picture.width, picture.height);
  };
  const base64Of = async (pixels) => {
    const canvas = new OffscreenCanvas(pixels.width, pixels.height);
    canvas.getContext('2d').putImageData(pixels, 0, 0);
    const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
    let text = '';
    for (const byte of bytes) text += String.fromCharCode(byte);
    return btoa(text);
  };
  const large = await pixelsOf(shot);
  const small = new ImageData(large.width >> 1, large.height >> 1);
  for (let y = 0; y < small.height; ++y)
    for (let x = 0; x < small.width; ++x)
      for (let k = 0; k < 4; ++k) {
        const at = (a, b) => large.data[4 * ((2 * y + b) * large.width + 2 * x + a) + k];
        const mean = (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4;
        // few levels: a smaller file
        small.data[4 * (y * small.width + x) + k] = k === 3 ? 255 : Math.min(252, Math.round(mean / 4) * 4);
      }
  if (!old) return { small: await base64Of(small) };
  const other = await pixelsOf(old);
  if (other.width !== small.width || other.height !== small.height) return { share: 1, small: await base64Of(small) };
  let different = 0;
  const marked = new ImageData(small.width, small.height);
  for (let i = 0; i < small.data.length; i += 4) {
    const away = Math.max(...[0, 1, 2].map((k) => Math.abs(small.data[i + k] - other.data[i + k])));
    different += away > level;
    marked.data.set(away > level ? [220, 0, 0, 255] : [0, 1, 2].map((k) => 180 + small.data[i + k] / 4).concat(255), i);
  }
  return {
    share: different / (small.width * small.height),
    small: await base64Of(small),
    marked: different ? await base64Of(marked) : null,
  };
}

/** Runs in a page: shots side by side, three in a row. */
async function sheetInPage(shots) {
  const pictures = await Promise.all(
    shots.map(async (base64) => createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob())),
  );
  const { width, height } = pictures[0];
  const canvas = new OffscreenCanvas(3 * width, Math.ceil(pictures.length / 3) * height);
  const context = canvas.getContext('2d');
  pictures.forEach((one, i) => context.drawImage(one, (i % 3) * width, Math.floor(i / 3) * height));
  const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/png' })).arrayBuffer());
  let text = '';
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text);
}

export class Pictures {
  #page = null;
  taken = new Set();
  faults = [];
  worst = 0;
  constructor(browser, folder) {
    this.browser = browser;
    this.folder = folder;
    this.version = browser.version();
    this.bound = existsSync(maker) && readFileSync(maker, 'utf8').trim() === this.version ? SHARE : SHARE_OTHER;
  }
  async compare(name, shot) {
    this.#page ??= await this.browser.newPage();
    const path = join(kept, `${name}.png`);
    this.taken.add(name);
    const old = existsSync(path) ? readFileSync(path).toString('base64') : null;
    const told = await this.#page.evaluate(compareInPage, [shot.toString('base64'), old, LEVEL]);
    const differs = !old || told.share > this.bound;
    this.worst = Math.max(this.worst, told.share ?? 0);
    if (renew) {
      mkdirSync(kept, { recursive: true });
      // a picture that is as it was keeps its bytes
      if (!old || told.share > 0) writeFileSync(path, Buffer.from(told.small, 'base64'));
      writeFileSync(maker, `${this.version}\n`);
    } else if (!old) this.faults.push(`${name} is not kept`);
    else if (differs) {
      const at = join(this.folder, `${name}_differs.png`);
      if (told.marked) writeFileSync(at, Buffer.from(told.marked, 'base64'));
      this.faults.push(`${name}: ${(100 * told.share).toFixed(3)} % of its pixels differ (${at} shows them)`);
    }
  }
  /** Several shots as one picture that is kept. */
  async sheet(name, shots) {
    this.#page ??= await this.browser.newPage();
    const sheet = await this.#page.evaluate(
      sheetInPage,
      shots.map((shot) => shot.toString('base64')),
    );
    writeFileSync(join(this.folder, `${name}.png`), Buffer.from(sheet, 'base64'));
    await this.compare(name, Buffer.from(sheet, 'base64'));
  }
  /** A sentence for the report; throws one when a picture differs. all: every story has run. */
  report(all) {
    const files = existsSync(kept) ? readdirSync(kept).filter((name) => name.endsWith('.png')) : [];
    const bytes = files.reduce((sum, name) => sum + readFileSync(join(kept, name)).length, 0);
    // sheets of other bodies (story_bodies.mjs) need shared files and the long form
    const left = all ? files.filter((name) => !this.taken.has(name.slice(0, -4)) && !name.startsWith('tools_')) : [];
    const faults = [...this.faults, ...left.map((name) => `${name} is kept and no story takes it`)];
    if (bytes > BYTES) faults.push(`the kept pictures take ${bytes} bytes`);
    if (faults.length && !renew) throw new Error(`${faults.join('; ')}. HF_RENEW_PICTURES=1 writes them anew`);
    return `${this.taken.size} pictures, ${(bytes / 1e6).toFixed(2)} MB kept; at most ${(100 * this.worst).toFixed(4)} % of a picture differs (allowed ${100 * this.bound} %)${renew ? '; written anew' : ''}`;
  }
}
