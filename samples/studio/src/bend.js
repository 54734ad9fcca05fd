// The test of weights: bones are turned by rings or a slider, or the clip of the file plays, and the skin follows. Nothing of
// the body changes.
import { skinned, turnedBones } from './skinning.js';

const HALF_TURN = 180;

/** tool: { app, bones, shown, present() } of the Weights tool. */
export class Bend {
  constructor(kit, tool) {
    this.kit = kit;
    this.tool = tool;
    this.app = tool.app;
    this.turns = new Map(); // bone -> Quaternion, in the frame of the body at rest
    this.clip = null; // the clip that plays
    this.gizmo = new kit.Gizmo(
      this.app,
      (turn, done) => this.#ring(turn, done),
      (bone) => this.head(bone.number),
    );
  }
  opened() {
    this.turns = new Map();
    this.clip = null;
    this.sums = null;
    this.forget();
  }
  /** The slider begins at 0 again: another bone, or another way to turn it. */
  forget() {
    this.degrees = 0;
    this.from = null;
  }
  get active() {
    return this.turns.size > 0 || Boolean(this.clip);
  }
  matrices() {
    const { kit, app } = this;
    const { bones } = this.tool;
    if (!this.clip) return turnedBones(kit, bones, this.turns);
    const worldOf = kit.worldsAt(app.body, this.clip, this.time);
    return bones.joints.map((joint) =>
      worldOf(joint).clone().multiply(new kit.Matrix4().fromArray(joint.getWorldMatrix()).invert()),
    );
  }
  head(bone) {
    const { Vector3 } = this.kit;
    return new Vector3()
      .fromArray(this.tool.bones.heads, 3 * bone)
      .applyMatrix4(this.matrices()[bone])
      .toArray();
  }
  /** Draws the body under the test, or as it is. */
  show() {
    const { app, kit, tool } = this;
    const bone = tool.shown === 'all' || this.clip ? null : { number: Number(tool.shown) };
    if (!this.active) app.skin.set(app.shape);
    else {
      const { positions, triangles, fileNormals } = app.body;
      if (!this.sums) {
        this.sums = kit.normalSums(triangles, kit.normalGroups(positions, fileNormals));
        this.posed = new Float32Array(positions.length);
        this.normals = new Float32Array(positions.length);
      }
      skinned(positions, tool.present(), this.matrices(), this.posed);
      kit.smoothNormals(this.posed, this.sums, this.normals);
      app.skin.set({ positions: this.posed, normals: this.normals });
    }
    this.gizmo.show(bone);
    if (app.tool === tool) tool.drawn.show();
    app.marksLayer.update();
  }
  hide() {
    this.clip = null;
    this.gizmo.show(null);
    this.app.skin.set(this.app.shape);
  }
  rest() {
    this.turns = new Map();
    this.clip = null;
    this.forget();
    this.show();
    this.app.panel();
  }
  /** Turns a bone by a quaternion of the picture, from a turn that it had. */
  #turn(bone, before, by) {
    const { Quaternion } = this.kit;
    const { parents } = this.tool.bones;
    const above = parents[bone] < parents.length ? this.matrices()[parents[bone]] : new this.kit.Matrix4();
    const frame = new Quaternion().setFromRotationMatrix(above);
    const turn = frame.clone().invert().multiply(by).multiply(frame).multiply(before);
    this.turns = new Map(this.turns).set(bone, turn);
    this.show();
  }
  #before(bone) {
    return this.turns.get(bone) ?? new this.kit.Quaternion();
  }
  #ring(by, done) {
    const bone = Number(this.tool.shown);
    this.ringFrom ??= this.#before(bone);
    this.#turn(bone, this.ringFrom, by);
    if (!done) return;
    this.ringFrom = null;
    this.forget();
    this.app.panel();
  }
  /** The turn of a ring is given up: the bone goes back. */
  cancel() {
    this.gizmo.cancel();
    const { ringFrom } = this;
    this.ringFrom = null;
    if (ringFrom) this.#turn(Number(this.tool.shown), ringFrom, new this.kit.Quaternion());
  }
  /** The slider turns about the direction of the view. */
  slide(degrees) {
    const { Quaternion, Vector3 } = this.kit;
    const bone = Number(this.tool.shown);
    this.from ??= { turn: this.#before(bone), axis: this.app.view.camera.getWorldDirection(new Vector3()) };
    this.degrees = degrees;
    const by = new Quaternion().setFromAxisAngle(this.from.axis, (degrees * Math.PI) / HALF_TURN);
    this.#turn(bone, this.from.turn, by);
  }
  play(clip, length) {
    this.turns = new Map();
    this.forget();
    this.clip = clip;
    this.time = 0;
    let last = performance.now();
    const step = (now) => {
      if (this.clip !== clip || this.app.tool !== this.tool) return;
      this.time = (this.time + Math.max(0, now - last) / 1000) % length;
      last = now;
      this.show();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    this.app.panel();
  }
}
