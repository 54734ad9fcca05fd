// Every act as a step: states are never changed, only replaced, so undo takes back exactly what was there.

/** Steps kept: hours of work. A state shares all that did not change, so they cost little. */
const STEP_LIMIT = 500;
/** Acts of one name within this many milliseconds are one step: nudges by a held key, a turned slider. */
const JOIN_MS = 700;

export class History {
  constructor(state) {
    this.reset(state);
  }
  reset(state) {
    this.state = state;
    this.past = [];
    this.future = [];
    this.last = { name: '', time: -Infinity };
  }
  /** A new step. join: a name under which acts that follow closely are one. */
  push(state, name, join = null) {
    const now = performance.now();
    if (!(join && join === this.last.name && now - this.last.time < JOIN_MS && this.past.length))
      this.past.push({ state: this.state, name });
    if (this.past.length > STEP_LIMIT) this.past.shift();
    this.future = [];
    this.state = state;
    this.last = { name: join ?? '', time: now };
  }
  undo() {
    const step = this.past.pop();
    if (!step) return null;
    this.future.push({ state: this.state, name: step.name });
    this.state = step.state;
    this.last = { name: '', time: -Infinity };
    return step.name;
  }
  redo() {
    const step = this.future.pop();
    if (!step) return null;
    this.past.push({ state: this.state, name: step.name });
    this.state = step.state;
    this.last = { name: '', time: -Infinity };
    return step.name;
  }
}
