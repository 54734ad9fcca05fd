// studio_test.mjs FOLDER PICTURES [STORY...]: every tool's story and the goals of the studio, in headless Chromium.
import { check, finish, start } from './harness.mjs';

const stories = [
  'views',
  'pose',
  'mirror',
  'keys',
  'field',
  'brush',
  'weights',
  'quads',
  'detail',
  'transfer',
  'history',
  'session',
  'save',
  'compressed',
  'formats',
  'broken',
  'access',
  'bodies',
  'crowd',
  'smooth',
  'figures',
];
const wanted = process.argv.slice(4);
const host = await start();
try {
  for (const name of stories) {
    if (wanted.length && !wanted.includes(name)) continue;
    const { default: story } = await import(`./story_${name}.mjs`).catch((error) =>
      error.code === 'ERR_MODULE_NOT_FOUND' ? { default: null } : Promise.reject(error),
    );
    if (story) await story(host);
  }
  if (host.kept.taken.size)
    await check('every picture is the one that is kept', async () => host.kept.report(!wanted.length));
} finally {
  await host.close();
}
process.exitCode = finish();
