// The page: wires the frame (menus, keys, drop) to the app.
import { App } from './app.js';
import { saveMenu } from './save.js';
import { DetailTool } from './tools/detail.js';
import { FieldTool } from './tools/field.js';
import { PoseTool } from './tools/pose.js';
import { QuadsTool } from './tools/quads.js';
import { TransferTool } from './tools/transfer.js';
import { WeightsTool } from './tools/weights.js';
import { Session } from './session.js';
import { $, card, make } from './ui.js';

const samples = ['horse', 'bull', 'biped'];
const root = document.documentElement;

const setTheme = (theme) => {
  root.dataset.theme = theme;
  $('theme').setAttribute('aria-pressed', String(theme === 'dark'));
};
setTheme(matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light');
$('theme').onclick = () => setTheme(root.dataset.theme === 'dark' ? 'light' : 'dark');

async function start() {
  let app;
  try {
    app = new App([PoseTool, FieldTool, TransferTool, WeightsTool, QuadsTool, DetailTool], samples);
  } catch (error) {
    card(
      'The studio cannot draw here',
      [
        make('p', {}, `The browser gives no WebGL: ${error.message}`),
        make('p', {}, 'Turn on hardware acceleration in its settings, or take another browser.'),
      ],
      [['Try again', () => location.reload(), true]],
    );
    return;
  }
  window.hfStudio = app; // for tests and the curious
  const openFile = async (file) => file && app.open(new Uint8Array(await file.arrayBuffer()), file.name);
  $('open').onclick = () => $('file').click();
  $('file').onchange = async () => {
    await openFile($('file').files[0]);
    $('file').value = '';
  };
  $('sample').append(
    make('option', { value: '' }, 'Samples'),
    ...samples.map((name) => make('option', { value: name }, name)),
  );
  $('sample').onchange = () => {
    if ($('sample').value) app.openSample($('sample').value);
    $('sample').value = '';
  };
  $('undo').onclick = () => app.step('undo');
  $('redo').onclick = () => app.step('redo');
  $('save').onclick = () => app.skin && saveMenu(app);
  $('help').onclick = () => app.help();

  let inside = 0;
  addEventListener('dragenter', (event) => {
    event.preventDefault();
    ++inside;
    $('drop').hidden = false;
  });
  addEventListener('dragleave', () => ($('drop').hidden = --inside <= 0));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    inside = 0;
    $('drop').hidden = true;
    openFile(event.dataTransfer.files[0]);
  });
  addEventListener('keydown', (event) => {
    if ($('card').open || event.defaultPrevented) return;
    const key = event.key.toLowerCase();
    if (event.ctrlKey || event.metaKey) {
      const acts = {
        z: () => app.step(event.shiftKey ? 'redo' : 'undo'),
        y: () => app.step('redo'),
        s: () => app.skin && saveMenu(app),
        o: () => $('file').click(),
      };
      if (!acts[key]) return;
      event.preventDefault();
      acts[key]();
    } else if (/input|select/i.test(event.target.tagName) && event.target.type !== 'range') return;
    else if (key === '?') app.help();
    else if (key === 'k' && app.skin && app.tool === app.tools.pose && app.state.handles.length) app.timeline.setKey();
    else if (/^[1-6]$/.test(key)) $('rail').children[Number(key) - 1]?.click();
  });
  const params = new URLSearchParams(location.search);
  // ?fresh: nothing of an earlier visit; ?sample=bull: that creature
  if (!params.has('fresh')) new Session(app);
  const named = samples.includes(params.get('sample')) ? params.get('sample') : null;
  const link = location.hash ? await import('./link.js') : null;
  const settings = await link?.settingsOf(location.hash, app.ui);
  const kept = app.session && !named && !settings && (await app.session.restore());
  if (!kept) {
    app.pending = settings ? () => link.takeSettings(app, settings) : null;
    app.openSample(named ?? samples[0]);
  }
  if ('serviceWorker' in navigator && !params.has('fresh')) navigator.serviceWorker.register('keep.js').catch(() => {});
}
start();
