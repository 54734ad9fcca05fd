// The session survives a reload: the file and all that was set are kept in the browser (IndexedDB), nowhere else.

/** What was set is written after so many milliseconds. */
const QUIET_MS = 300;

function store(mode, act) {
  return new Promise((resolve, reject) => {
    const request = indexedDB.open('hf-studio', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('session');
    request.onerror = () => reject(request.error);
    request.onsuccess = () => {
      const change = request.result.transaction('session', mode);
      const answer = act(change.objectStore('session'));
      change.oncomplete = () => {
        request.result.close();
        resolve(answer?.result);
      };
      change.onabort = () => reject(change.error);
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
  #able = true; // false in windows that keep nothing, and while a session is read back
  constructor(app) {
    app.session = this;
    this.app = app;
    // what a tool or the view has set is no step
    app.view.onDraw(() => this.changed());
    addEventListener('change', () => this.changed());
  }
  /** A file was opened: it replaces all that was kept. */
  opened(bytes, name) {
    if (!this.#able) return;
    this.#last = '';
    this.#try(() => store('readwrite', (kept) => (kept.clear(), kept.put({ bytes, name }, 'body'))));
  }
  /** Beside the body: the source of a transfer or of detail ({ bytes, name }), a quad mesh. */
  keep(key, value) {
    if (this.#able) this.#try(() => store('readwrite', (kept) => kept.put(value, key)));
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
    } catch {
      // no room, or a window that keeps nothing: the studio works without
      this.#able = false;
    } finally {
      --this.#writing;
    }
  }
  /** Opens what was kept, as it was left; false if there is nothing. */
  async restore() {
    const { app } = this;
    try {
      const [body, settings] = await both();
      if (!body) return false;
      this.#able = false;
      await app.open(body.bytes, body.name);
      if (app.body?.name !== body.name) return false;
      if (settings?.vertexCount === app.body.vertexCount)
        await app.adopt(settings).catch(() => app.warn('Not all of the last session could be brought back.'));
      return true;
    } catch {
      return false;
    } finally {
      this.#able = true;
    }
  }
}
