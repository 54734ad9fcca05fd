// The page: wires the frame (menus, keys, drop) to the app.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Line,
  LineBasicMaterial,
  LineLoop,
  LineSegments,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  Vector3,
} from 'three';
import { App } from './app.js';
import { Gizmo } from './gizmo.js';
import { help } from './help.js';
import { colourAt } from './legend.js';
import { bonesOf, influencesOf, readModel, writeGlb } from './model.js';
import { middleOf, mirrorChoice } from './mirror.js';
import { normalGroups, normalSums, smoothNormals } from './normals.js';
import { saveMenu, skinnedGlb } from './save.js';
import { lengthOf, localsOf, playedAt, worldsAt } from './timeline.js';
import { FieldTool } from './tools/field.js';
import { PoseTool } from './tools/pose.js';
import { Session } from './session.js';
import { circleOf } from './circle.js';
import { pack, unpack } from './stiffness.js';
import { $, button, card, choice, facts, make, ms, say, slider, touched, whole } from './ui.js';
import { toolKey, viewButtons, viewKey } from './views.js';

/** Tools that the first picture does not need. Their modules import nothing, so that each is one request: the kit has it all. */
const kit = { $, button, choice, facts, make, middleOf, mirrorChoice, ms, say, slider, touched, whole };
Object.assign(kit, { BufferAttribute, BufferGeometry, Color, DoubleSide, Line, LineBasicMaterial, LineLoop });
Object.assign(kit, { LineSegments });
Object.assign(kit, { Gizmo, Matrix4, Mesh, MeshBasicMaterial, MeshLambertMaterial, Quaternion, Vector3, worldsAt });
Object.assign(kit, { bonesOf, influencesOf, readModel, writeGlb, skinnedGlb });
Object.assign(kit, { normalGroups, normalSums, smoothNormals, lengthOf, localsOf, playedAt });
Object.assign(kit, { circleOf, colourAt, pack, unpack });
const later = (key, title, icon, load) => ({ key, title, icon, load: async () => (await load()).tool(kit) });
const laterTools = [
  later('transfer', 'Transfer', 'M4 8h13l-3-3M20 16H7l3 3', () => import('./tools/transfer.js')),
  later(
    'weights',
    'Weights',
    'M7 4a2.4 2.4 0 1 0 2 4l7 8a2.4 2.4 0 1 0 2-2L10 7a2.4 2.4 0 0 0-3-3z',
    () => import('./tools/weights.js'),
  ),
  later(
    'quads',
    'Quads',
    'M4 7l8-3 8 3v10l-8 3-8-3zM4 12l8-2 8 2M12 4v16M8 5.5v13M16 5.5v13',
    () => import('./tools/quads.js'),
  ),
  later('detail', 'Detail', 'M3 15c2-6 4 3 6-2s3-4 5 0 4-3 7-1M3 20h18', () => import('./tools/detail.js')),
  later('brush', 'Stiffness', null, () => import('./tools/brush.js')),
];

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
    app = new App([PoseTool, FieldTool, ...laterTools], samples);
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
  $('file').accept = app.formats;
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
  $('help').onclick = () => help(app);
  viewButtons(app);

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
    if ($('card').open || event.defaultPrevented || !event.key) return;
    const key = event.key.toLowerCase();
    // Alt and a key are the browser's (its menus, its tabs, its first page); AltGr writes a letter, and is Ctrl and Alt to Windows
    if (event.altKey || event.getModifierState('AltGraph')) return;
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
    else if (key === '?') help(app);
    else if (viewKey(app, event)) event.preventDefault();
    else if (key === 'k' && app.skin && app.tool === app.tools.pose && app.state.handles.length) app.timeline.setKey();
    else if (key === 'b' && app.skin) $(app.tool === app.tools.brush ? 'done' : 'brush')?.click();
    else if (toolKey(event) !== null) $('rail').children[toolKey(event)]?.click();
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
    await app.openSample(named ?? samples[0], !settings);
    if (!settings && !params.has('fresh') && app.skin) import('./tour.js').then(({ first, tour }) => first() && tour(app), () => {});
  }
  if ('serviceWorker' in navigator && !params.has('fresh')) navigator.serviceWorker.register('keep.js').catch(() => {});
}
start();
