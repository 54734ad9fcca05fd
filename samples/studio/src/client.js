// The page's side of the Worker: requests with answers, frames of which only the newest waits, and jobs that can be ended.
export class HfFailure extends Error {
  constructor({ message, codeName, index, advice }) {
    super(message);
    this.advice = advice;
    this.codeName = codeName;
    this.index = index;
  }
}

const failureOf = ({ message }) => new HfFailure({ message: message || 'the Worker could not start; load the page again' });

class Line {
  constructor(worker = new Worker(new URL('worker.js', document.baseURI), { type: 'module' })) {
    this.worker = worker;
    this.waiting = new Map();
    this.next = 0;
    this.worker.onmessage = ({ data: { id, answer, error } }) => {
      const { resolve, reject } = this.waiting.get(id);
      this.waiting.delete(id);
      if (error) reject(new HfFailure(error));
      else resolve(answer);
    };
    this.worker.onerror = (event) => {
      if (!event.message) worker.failed = event; // its file did not come: nothing will be answered
      for (const { reject } of this.waiting.values()) reject(failureOf(event));
      this.waiting.clear();
    };
  }
  ask(task, args, transfer = []) {
    const id = ++this.next;
    return new Promise((resolve, reject) => {
      if (this.worker.failed) return reject(failureOf(this.worker.failed));
      this.waiting.set(id, { resolve, reject });
      this.worker.postMessage({ id, task, args }, transfer);
    });
  }
  end() {
    this.worker.terminate();
    for (const { reject } of this.waiting.values())
      reject(new HfFailure({ message: 'cancelled', codeName: 'cancelled' }));
    this.waiting.clear();
  }
}

export class Client {
  #line = new Line(window.hfWorker); // index.html has started it
  #frames = new Map(); // task -> { busy, next }

  ask(task, args, transfer) {
    return this.#line.ask(task, args, transfer);
  }

  /** Asks for a frame. While one is on its way the newest waits; those between are dropped and answer null. */
  async frame(task, args) {
    const line = this.#frames.get(task) ?? { busy: false, next: null };
    this.#frames.set(task, line);
    if (line.busy) {
      line.next?.resolve(null);
      return new Promise((resolve, reject) => (line.next = { args, resolve, reject }));
    }
    line.busy = true;
    try {
      return await this.ask(task, args);
    } finally {
      line.busy = false;
      const { next } = line;
      line.next = null;
      if (next) this.frame(task, next.args).then(next.resolve, next.reject);
    }
  }

  /** A Worker of its own, until line.end(). */
  line() {
    return new Line();
  }

  /** A job in a Worker of its own: { answer, cancel }. */
  job(task, args, transfer) {
    const line = new Line();
    const answer = line.ask(task, args, transfer).finally(() => line.worker.terminate());
    return { answer, cancel: () => line.end() };
  }
}
