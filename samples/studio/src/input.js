// Pointers on the canvas: a click goes to the tool; a drag turns the view, unless the tool takes it or it begins on the body
// near a mark, which was meant; two fingers turn and pinch, and what one of them had begun to pull goes back.
import { CLICK_PIXELS } from './view.js';

const ZOOM = 0.0012; // of a wheel's step: a notch of 100 is 13 per cent

export function listen(app, canvas) {
  const { view } = app;
  const fingers = new Map();
  let act = null; // { from, moved, taken, mark, button }
  const here = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  /** A drag from the body near a mark pulls the mark: who missed it by a little does not turn the view. */
  const take = ({ from, button, shift }) => {
    if (button !== 0 || shift || !app.tool?.drag) return null;
    const mark = app.skin?.pick(view.ray(...from)) ? app.marksLayer.near(from) : null;
    if (!mark) return null;
    app.timeline.still();
    app.tool.dragStart?.(mark, from);
    return mark;
  };
  /** What a drag has begun is given up: nothing of it is a step. */
  const giveUp = ({ taken, mark }) => {
    if (taken) app.tool.strokeCancel?.();
    if (mark) app.tool.dragCancel?.(mark);
  };
  canvas.onpointerdown = (event) => {
    canvas.setPointerCapture(event.pointerId);
    app.hover(null);
    fingers.set(event.pointerId, here(event));
    if (fingers.size === 2 && act) giveUp(act);
    if (fingers.size === 1)
      act = { from: here(event), moved: false, taken: false, mark: null, button: event.button, shift: event.shiftKey };
    else act = { ...act, moved: true, taken: false, mark: null };
    document.activeElement?.classList?.contains('mark') && document.activeElement.blur();
  };
  canvas.onpointermove = (event) => {
    const at = here(event);
    const before = fingers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === 'mouse') app.hover(at);
      return;
    }
    if (fingers.size === 2) {
      const [other] = [...fingers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      const length = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
      view.zoomBy(length(before) / Math.max(1, length(at)));
      view.turnBy((at[0] - before[0]) / 2, (at[1] - before[1]) / 2);
    } else if (act) {
      if (!act.moved && Math.hypot(at[0] - act.from[0], at[1] - act.from[1]) >= CLICK_PIXELS) {
        act.moved = true;
        act.taken = act.button === 0 && Boolean(app.tool?.strokeStart?.(act.from));
        act.mark = act.taken ? null : take(act);
      }
      if (act.taken) app.tool.stroke?.(at);
      else if (act.mark) app.tool.drag(act.mark, at, act.from);
      else if (act.moved && (act.button === 1 || act.shift)) view.panBy(at[0] - before[0], at[1] - before[1]);
      else if (act.moved) view.turnBy(at[0] - before[0], at[1] - before[1]);
    }
    fingers.set(event.pointerId, at);
  };
  const end = (event) => {
    if (!fingers.delete(event.pointerId) || fingers.size) return;
    const done = act;
    act = null;
    if (!done) return;
    if (event.type !== 'pointerup') giveUp(done);
    else if (done.taken) app.tool.strokeEnd?.();
    else if (done.mark) app.tool.dragEnd?.(done.mark);
    else if (!done.moved && done.button === 0) app.tool?.click?.(done.from);
  };
  canvas.onpointerup = end;
  canvas.onpointercancel = end;
  canvas.onpointerleave = () => app.hover(null);
  canvas.oncontextmenu = (event) => event.preventDefault();
  // a mark that moves with its body waits for a pointer that comes near
  const stage = canvas.parentElement;
  stage.addEventListener('pointermove', (event) => (app.timeline.held = Boolean(app.marksLayer.near(here(event)))));
  stage.addEventListener('pointerleave', () => (app.timeline.held = false));
  stage.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      view.zoomBy(Math.exp(event.deltaY * ZOOM));
    },
    { passive: false },
  );
}
