// The session survives a reload: the file and all that was set are kept in the browser (IndexedDB), nowhere else. What could not
// be brought back stays in the store until the user gives it up.

/** What was set is written so many milliseconds later: a drag is one write, and who closes the page at once loses one act. */
const QUIET_MS = 300;

const NO_ROOM = 'This browser has no room to keep the session: a reload will not bring it back.';
const NOTHING_KEPT = 'This browser keeps nothing of the session: a reload will not bring it back.';

function store(mode, act) {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open('hf-studio', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('session');
    request.onerror = () => reject(request.error);
    request.onsuccess = () => {
      let change = null;
      const closed = (then) => {
        request.result.close();
        then();
      };
      try {
        change = request.result.transaction('session', mode);
        const answer = act(change.objectStore('session'));
        change.oncomplete = () => closed(() => resolve(answer?.result));
        change.onabort = () => closed(() => reject(change.error));
      } catch (error) {
        if (!change) return closed(() => reject(error));
        change.onabort = () => closed(() => reject(error)); // what was there stays
        change.abort();
      }
    };
  });
}

/** The kept file and what was set, in one transaction: each takes its way through the browser. */
async function both() {
  const found = [];
  await store('readonly', (kept) => void found.push(kept.get('body'), kept.get('settings')));
  return found.map(({ result }) => result);
}

export class Session {
  #timer = 0;
  #writing = 0;
  #last = ''; // what is written
  #reading = false; // a session is read back
  #failed = false; // the browser has no room, or keeps nothing: until the next file
  #waiting = null; // what this visit would have kept, while a session waits that could not be brought back
  constructor(app) {
    app.session = this;
    this.app = app;
    // what a tool or the view has set is no step
    app.view.onDraw(() => this.changed());
    addEventListener('change', () => this.changed());
  }
  /** A file was opened: it replaces all that was kept. */
  opened(bytes, name) {
    if (this.#reading) return;
    this.#last = '';
    this.#failed = false;
    if (this.#waiting) this.#waiting = new Map([['body', { bytes, name }]]);
    else this.#try(() => store('readwrite', (kept) => (kept.clear(), kept.put({ bytes, name }, 'body'))));
  }
  /** Beside the body: the source of a transfer or of detail ({ bytes, name }), a quad mesh. */
  keep(key, value) {
    if (this.#waiting) this.#waiting.set(key, value);
    else if (this.#able) this.#try(() => store('readwrite', (kept) => kept.put(value, key)));
  }
  get #able() {
    return !this.#reading && !this.#failed && !this.#waiting;
  }
  kept(key) {
    return store('readonly', (kept) => kept.get(key)).catch(() => null);
  }
  /** Something was set, or may have been: it is written a little later, with what comes meanwhile. */
  changed() {
    if (!this.#able || this.#timer) return;
    this.#timer = setTimeout(() => {
      this.#timer = 0;
      if (!this.#able || !this.app.skin || !this.app.tool) return;
      const settings = this.app.settings();
      const text = JSON.stringify(settings);
      if (text === this.#last) return;
      this.#last = text;
      this.#try(() => store('readwrite', (kept) => kept.put(settings, 'settings')));
    }, QUIET_MS);
  }
  /** True while something is not written yet. */
  get busy() {
    return Boolean(this.#timer || this.#writing);
  }
  async #try(act) {
    ++this.#writing;
    try {
      await act();
    } catch (error) {
      // the studio works without, and says so once for a file
      if (!this.#failed) this.app.warn(`${error?.name === 'QuotaExceededError' ? NO_ROOM : NOTHING_KEPT} Save what you want to keep.`);
      this.#failed = true;
    } finally {
      --this.#writing;
    }
  }
  /** Opens what was kept, as it was left; false if nothing could be opened. */
  async restore() {
    const { app } = this;
    const [body, settings] = await both().catch(() => []); // the first file that is kept says what is wrong
    if (!body) return false;
    this.#reading = true;
    try {
      await app.bring(body.bytes, body.name);
      if (settings && settings.vertexCount !== app.body.vertexCount)
        throw new Error(`${body.name} has ${app.body.vertexCount} vertices now; the session is for ${settings.vertexCount}.`);
      const refused = settings ? await app.adopt(settings) : [];
      if (refused.length) throw new Error(refused.join('; '));
    } catch (error) {
      this.#wait(body.name, error);
    } finally {
      this.#reading = false;
    }
    return Boolean(app.skin);
  }
  /** The store stays as it was left: another version of the studio, or a host that answers again, may bring it back. */
  #wait(name, error) {
    this.#waiting = new Map();
    const { card, make } = this.app.ui;
    card(
      `The last session with ${name} is not whole`,
      [
        make('p', {}, error.message),
        make('p', {}, 'Try again, or give it up. Until then this browser keeps it as you left it, and keeps nothing of this visit.'),
      ],
      [
        ['Try again', () => location.reload(), true],
        ['Give it up', () => this.#giveUp()],
        ['Close', null],
      ],
    );
  }
  /** This visit is kept from now on. */
  #giveUp() {
    const mine = this.#waiting;
    this.#waiting = null;
    this.#last = '';
    this.#try(() =>
      store('readwrite', (kept) => {
        if (mine.has('body')) kept.clear();
        for (const [key, value] of mine) kept.put(value, key);
      }),
    );
    this.changed();
  }
}
