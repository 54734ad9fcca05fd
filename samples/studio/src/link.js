// A link with the settings: handles, sites, keys, pins, the tools and the view stand in the address after #. The body does not:
// a sample is named, and a file has to be opened by who has it.

const MARK = '#s=';
/** Longer links are cut by mail programs and browsers. A link of this length cannot inflate beyond 1,032 times its bytes. */
const LONGEST = 30000;

async function through(stream, bytes) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}
const encode = (bytes) =>
  btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''))
    .replace(/\+/g, '-')
    .replace(/\//g, '_')
    .replace(/=+$/, '');
const decode = (text) =>
  Uint8Array.from(atob(text.replace(/-/g, '+').replace(/_/g, '/')), (letter) => letter.charCodeAt(0));

export async function linkOf(app) {
  const { body, samples } = app;
  const text = new TextEncoder().encode(JSON.stringify(app.settings()));
  const address = new URL(location.origin + location.pathname);
  const sample = body.name.replace(/\.glb$/, '');
  if (samples.includes(sample)) address.searchParams.set('sample', sample);
  return `${address}${MARK}${encode(await through(new CompressionStream('deflate-raw'), text))}`;
}

export async function showLink(app) {
  const { card, make, say } = app.ui;
  const link = await linkOf(app);
  if (link.length > LONGEST)
    throw new Error(`The link would have ${link.length} letters; programs cut links of more than ${LONGEST}. Save the body as a file instead.`);
  const field = make('input', { id: 'link', type: 'text', readonly: true, value: link, 'aria-label': 'Link' });
  const sample = new URL(link).searchParams.has('sample');
  card(
    'Link with the settings',
    [
      make(
        'p',
        {},
        sample
          ? 'The link shows this creature as you left it.'
          : `It holds the settings and not the body: who opens it needs ${app.body.name} too.`,
      ),
      field,
    ],
    [
      [
        'Copy',
        async () => {
          await navigator.clipboard.writeText(link);
          say('link copied');
        },
        true,
      ],
      ['Close', null],
    ],
  );
  field.select();
}

/** The settings of the address, or null. */
export async function settingsOf(hash, { say }) {
  if (!hash.startsWith(MARK)) return null;
  try {
    if (hash.length > LONGEST) throw new Error('no link of the studio is so long');
    const text = await through(new DecompressionStream('deflate-raw'), decode(hash.slice(MARK.length)));
    return JSON.parse(new TextDecoder().decode(text));
  } catch {
    say('the link is damaged: it was cut off or changed; copy all of it again');
    return null;
  }
}

/** Brings the body to the settings of a link, if it is their body. */
export async function takeSettings(app, settings) {
  const { say } = app.ui;
  if (settings.name !== app.body?.name || settings.vertexCount !== app.body.vertexCount) {
    app.warn(`the link is for ${settings.name}: open it to see its settings`);
    return false;
  }
  let refused = [];
  try {
    refused = await app.adopt(settings);
  } catch {
    app.warn('the link is damaged: its settings do not fit the body; make the link again');
    return false;
  }
  if (refused.length) app.warn(`not all of the link could be brought back; ${refused.join('; ')}`);
  else say(`as in the link: ${settings.name}`);
  return true;
}
