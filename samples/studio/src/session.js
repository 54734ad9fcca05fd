// The session survives a reload: the file and the present state are kept in the browser (IndexedDB), nowhere else.

/** A state is written when no other came for so many milliseconds. */
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

/** The kept file and state, in one transaction: each takes its way through the browser. */
async function both() {
  const found = [];
  await store('readonly', (kept) => void found.push(kept.get('body'), kept.get('state')));
  return found.map(({ result }) => result);
}

export class Session {
  #timer = 0;
  #writing = 0;
  #able = true; // false in windows that keep nothing, and while a session is read back
  constructor(app) {
    app.session = this;
    this.app = app;
  }
  /** A file was opened: it replaces what was kept. */
  opened(bytes, name) {
    if (this.#able)
      this.#try(() =>
        store('readwrite', (kept) => (kept.put({ bytes, name }, 'body'), kept.delete('state'), kept.delete('source'))),
      );
  }
  /** Another body whose detail is taken. */
  source(bytes, name) {
    if (this.#able) this.#try(() => store('readwrite', (kept) => kept.put({ bytes, name }, 'source')));
  }
  async sourceBytes(name) {
    const source = await store('readonly', (kept) => kept.get('source'));
    return source?.name === name ? source.bytes : null;
  }
  changed(state) {
    clearTimeout(this.#timer);
    this.#timer = 0;
    if (this.#able)
      this.#timer = setTimeout(() => {
        this.#timer = 0;
        this.#try(() => store('readwrite', (kept) => kept.put(state, 'state')));
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
  /** Opens what was kept; false if there is nothing. */
  async restore() {
    try {
      const [body, state] = await both();
      if (!body) return false;
      this.#able = false;
      await this.app.open(body.bytes, body.name);
      if (this.app.body?.name !== body.name) return false;
      if (state) await this.app.take(state);
      return true;
    } catch {
      return false;
    } finally {
      this.#able = true;
    }
  }
}
