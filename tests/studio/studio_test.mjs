// studio_test.mjs FOLDER PICTURES [STORY...]: every tool's story and the goals of the studio, in headless Chromium.
import { finish, start } from './harness.mjs';

const stories = [
  'pose',
  'field',
  'weights',
  'quads',
  'detail',
  'transfer',
  'history',
  'save',
  'broken',
  'access',
  'bodies',
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
} finally {
  await host.close();
}
process.exitCode = finish();
