// Three rings around the chosen handle: drag one to turn about its axis.
import * as THREE from 'three';

/**
 * Radius of the rings, in pixels: outside of the mark of 44. Reach of a pointer: a ring is 3 pixels wide. Points that stand for a ring
 * when it is looked for: one every 6 pixels, half of the reach.
 */
const [RING, REACH, POINTS] = [70, 11, 72];
const colours = [0xd8452e, 0x3d9a3a, 0x2f6fd6];

export class Gizmo {
  /** placeOf: where the middle of what is turned stands. */
  constructor(app, onturn, placeOf) {
    this.app = app;
    this.onturn = onturn;
    this.placeOf = placeOf;
    this.group = new THREE.Group();
    this.group.visible = false;
    this.rings = [0, 1, 2].map((axis) => {
      const ring = new THREE.Mesh(
        new THREE.TorusGeometry(1, 0.02, 8, 72),
        new THREE.MeshBasicMaterial({ color: colours[axis], depthTest: false, transparent: true, opacity: 0.85 }),
      );
      if (axis === 0) ring.rotation.y = Math.PI / 2;
      if (axis === 1) ring.rotation.x = Math.PI / 2;
      ring.renderOrder = 5;
      this.group.add(ring);
      return ring;
    });
    app.view.extras.add(this.group);
    app.view.onDraw(() => this.rescale());
    this.handle = null;
    this.active = null;
  }
  show(handle) {
    this.handle = handle;
    this.group.visible = Boolean(handle) && !this.app.timeline.away();
    if (handle) {
      this.centre = this.placeOf(handle);
      this.group.position.set(...this.centre);
      this.group.scale.setScalar(this.size());
    }
    this.app.view.draw();
  }
  size() {
    return RING / Math.max(1e-9, this.app.view.pixels(1, this.centre));
  }
  rescale() {
    if (this.group.visible) this.group.scale.setScalar(this.size());
  }
  /** The axis whose ring passes nearest to a pixel, within reach; or -1. */
  under([x, y]) {
    if (!this.group.visible) return -1;
    let [best, axis] = [REACH, -1];
    const size = this.size();
    for (let a = 0; a < 3; ++a)
      for (let i = 0; i < POINTS; ++i) {
        const angle = (2 * Math.PI * i) / POINTS;
        const point = this.centre.slice();
        point[(a + 1) % 3] += size * Math.cos(angle);
        point[(a + 2) % 3] += size * Math.sin(angle);
        const at = this.app.view.onScreen(point);
        const away = Math.hypot(at.x - x, at.y - y);
        if (away < best) [best, axis] = [away, a];
      }
    return axis;
  }
  start(at) {
    const axis = this.under(at);
    if (axis < 0) return false;
    const along = new THREE.Vector3().setComponent(axis, 1);
    const eye = this.app.view.camera.position.clone().sub(new THREE.Vector3(...this.centre));
    this.active = { along, sign: along.dot(eye) >= 0 ? 1 : -1, last: this.angle(at), total: 0 };
    return true;
  }
  angle([x, y]) {
    const at = this.app.view.onScreen(this.centre);
    return Math.atan2(at.y - y, x - at.x);
  }
  move(at) {
    if (!this.active) return;
    const angle = this.angle(at);
    const step = Math.atan2(Math.sin(angle - this.active.last), Math.cos(angle - this.active.last));
    this.active.total += this.active.sign * step;
    this.active.last = angle;
    this.onturn(this.turn(), false);
  }
  turn() {
    return new THREE.Quaternion().setFromAxisAngle(this.active.along, this.active.total);
  }
  /** The turn is given up; whoever is turned goes back by itself. */
  cancel() {
    this.active = null;
  }
  end() {
    if (!this.active) return;
    const turn = this.turn();
    this.active = null;
    this.onturn(turn, true);
  }
}
