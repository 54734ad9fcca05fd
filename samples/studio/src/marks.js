// Handles and sites as buttons over the canvas: seen, dragged and touched there, walked by Tab, read by a screen reader.
import { make } from './ui.js';
import { CLICK_PIXELS } from './view.js';

/** Marks behind the body are looked for when nothing has moved for so many milliseconds: sooner they are looked for between two moves of a hand. */
const LOOK_BEHIND_MS = 150;
/** Larger bodies keep the marks undimmed after a pose: the tree of boxes would take longer than 50 ms to follow. */
const FOLLOWED_VERTICES = 30000;
/** A drag that begins on the body so many pixels from the middle of a mark means the mark: twice the radius of what a finger hits. */
const NEAR_PIXELS = 44;
/** A place counts as behind when the surface is nearer to the eye by this part of the size of the body: handles stand inside, up to the radius of a leg under it. */
const BEHIND = 0.03;

export class Marks {
  #buttons = new Map(); // id -> element
  #timer = 0;
  #held = null; // the element that a pointer drags
  constructor(app, parent) {
    this.app = app;
    this.parent = parent;
    app.view.onDraw(() => this.place());
  }
  /** The marks of the present tool: { id, place, label, chosen, twin, offer, pinned, colour, pulse }. */
  update() {
    const list = this.app.tool?.marks?.() ?? [];
    const seen = new Set();
    list.forEach((mark, i) => {
      let element = this.#buttons.get(mark.id);
      if (!element) {
        element = make('button', { class: 'mark', type: 'button' });
        this.#listen(element);
        this.#buttons.set(mark.id, element);
        this.parent.append(element);
      }
      // an element that moves in the document loses its pointer, and the drag would never end
      if (!this.#held && this.parent.children[i] !== element) this.parent.insertBefore(element, this.parent.children[i] ?? null);
      element.mark = mark;
      seen.add(mark.id);
      element.setAttribute('aria-label', mark.say ? `${mark.say}: ${mark.label}` : mark.label);
      element.setAttribute('aria-pressed', String(Boolean(mark.chosen)));
      for (const name of ['chosen', 'twin', 'offer', 'pinned', 'pulse'])
        element.classList.toggle(name, Boolean(mark[name]));
      if (mark.colour) element.style.setProperty('--dot', mark.colour);
      const said = element.querySelector('.say');
      if (Boolean(mark.say) !== Boolean(said))
        mark.say ? element.append(make('span', { class: 'say' }, mark.say)) : said.remove();
    });
    for (const [id, element] of this.#buttons)
      if (!seen.has(id)) {
        element.remove();
        this.#buttons.delete(id);
      }
    this.place();
  }
  place() {
    for (const element of this.#buttons.values()) {
      const { x, y, front } = this.app.view.onScreen(element.mark.place);
      element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      element.style.visibility = front ? '' : 'hidden';
    }
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#lookBehind(), LOOK_BEHIND_MS);
  }
  /** Whether the body can be asked at once for what it hides. */
  #canLook() {
    const { skin } = this.app;
    return Boolean(skin?.bvh) && !(skin.stale && skin.body.vertexCount > FOLLOWED_VERTICES);
  }
  #lookBehind() {
    if (!this.#canLook()) return;
    for (const element of this.#buttons.values())
      element.classList.toggle('behind', !element.mark.pulse && this.#isBehind(element.mark)); // "pull me" is always read
  }
  /** Whether the body lies before a mark. */
  #isBehind({ place }) {
    const { view, skin } = this.app;
    const { x, y } = view.onScreen(place);
    const hit = skin.pick(view.ray(x, y));
    const away = Math.hypot(...place.map((p, k) => p - view.camera.position.getComponent(k)));
    return Boolean(hit && hit.distance < away - BEHIND * view.size);
  }
  /** The mark nearest to a pixel of the stage, if one is near that the body does not hide: nobody means what is not seen. */
  near([x, y]) {
    const found = [];
    for (const { mark, disabled } of this.#buttons.values()) {
      const at = this.app.view.onScreen(mark.place);
      const away = Math.hypot(at.x - x, at.y - y);
      if (!disabled && at.front && away < NEAR_PIXELS) found.push({ away, mark });
    }
    const inOrder = found.sort((a, b) => a.away - b.away);
    return (this.#canLook() ? inOrder.find(({ mark }) => !this.#isBehind(mark)) : inOrder[0])?.mark ?? null;
  }
  focus(id) {
    this.#buttons.get(id)?.focus({ preventScroll: true });
  }
  elementOf(id) {
    return this.#buttons.get(id);
  }
  #listen(element) {
    let from = null;
    const here = (event) => {
      const box = this.parent.getBoundingClientRect();
      return [event.clientX - box.left, event.clientY - box.top];
    };
    element.onpointerdown = (event) => {
      if (event.button || from) return;
      event.stopPropagation();
      this.app.timeline.still(); // what moves stands, and then it is pulled
      element.setPointerCapture(event.pointerId);
      from = { at: here(event), pointer: event.pointerId, dragging: false };
      this.#held = element;
    };
    element.onpointermove = (event) => {
      if (!from || event.pointerId !== from.pointer) return;
      const [x, y] = here(event);
      if (!from.dragging && Math.hypot(x - from.at[0], y - from.at[1]) < CLICK_PIXELS) return;
      if (!from.dragging) this.app.tool.dragStart?.(element.mark, from.at);
      from.dragging = true;
      this.app.tool.drag?.(element.mark, [x, y], from.at);
    };
    const end = (event) => {
      if (!from || event.pointerId !== from.pointer) return;
      const { dragging } = from;
      from = this.#held = null;
      const taken = event.type === 'pointerup';
      // a pointer that the system took has let nothing go
      if (dragging) taken ? this.app.tool.dragEnd?.(element.mark) : this.app.tool.dragCancel?.(element.mark);
      else if (taken) this.app.tool.choose?.(element.mark);
    };
    element.onpointerup = end;
    element.onpointercancel = end;
    element.onclick = (event) => {
      if (event.detail === 0) this.app.tool.choose?.(element.mark); // Enter or the space bar
    };
    element.onkeydown = (event) => {
      if (this.app.tool.key?.(element.mark, event)) event.preventDefault();
    };
  }
}
