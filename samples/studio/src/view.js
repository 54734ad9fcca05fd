// The picture: three.js draws when something changed, and only then. The camera turns about its target.
import * as THREE from 'three';
import { Skin } from './skin_view.js';

/** A click moves less than this many pixels; more is a drag. Half of it makes drags of clicks, twice of it is seen as a jump of what is dragged. */
export const CLICK_PIXELS = 5;
/** Room around a framed body: handles at its ends stay in the picture. It is 33 pixels of 400 on each side; each tenth more draws the body a tenth smaller. */
const MARGIN = 1.2;
/** Radians of turning for each pixel of a drag: a drag over 400 turns the body about. */
const TURN = 0.008;
/** How a body is first looked at, in radians: from its front and its side, so that no limb hides another, and a little from above. */
const HOME = { turn: 0.75, lift: 0.18 };
/** Where the body is looked at from. Straight down, the picture has no up: the top keeps a hair away from it. */
const STEEPEST = Math.PI / 2 - 1e-3;
const SIDES = { home: HOME, front: { turn: 0, lift: 0 }, side: { turn: Math.PI / 2, lift: 0 }, top: { turn: 0, lift: STEEPEST } };
/** The eye keeps so far above the floor, as part of the size of the body: its shadow is seen from above, and feet still from the side. */
const ABOVE_FLOOR = 0.002;

export class View {
  #wanted = false;
  #scene = new THREE.Scene();
  #listeners = new Set();

  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.toneMapping = THREE.NoToneMapping;
    // asking what a shader says waits for the graphics card; faults of our own shaders are seen in the tests
    this.renderer.debug.checkShaderErrors = false;
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.target = new THREE.Vector3();
    Object.assign(this, HOME);
    this.floor = -Infinity; // the eye stays above it
    this.distance = 4;
    this.size = 1;
    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(0.6, 1, 0.8);
    const fill = new THREE.DirectionalLight(0xbfd4ff, 0.7);
    fill.position.set(-0.7, 0.3, -0.6);
    this.lamp = new THREE.Group();
    this.lamp.add(sun, fill);
    this.#scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8378, 1.35), this.lamp);
    this.bodies = new THREE.Group();
    this.extras = new THREE.Group();
    this.#scene.add(this.bodies, this.extras);
    this.pictures = 0;
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
  }

  /** Draws at the next picture of the screen. */
  draw() {
    if (this.#wanted) return;
    this.#wanted = true;
    requestAnimationFrame(() => {
      this.#wanted = false;
      // a panel that came or went: once, before anything is drawn at the old size
      this.resize();
      this.drawNow();
    });
  }
  drawNow() {
    this.place();
    for (const listener of this.#listeners) listener();
    this.renderer.render(this.#scene, this.camera);
    ++this.pictures;
  }
  /** Calls before every picture, with its camera: marks and rings are drawn where it has them. */
  onDraw(listener) {
    this.#listeners.add(listener);
  }

  place() {
    // the eye slides along the floor and not through it
    const least = Math.asin(Math.max(-1, Math.min(1, (this.floor - this.target.y) / this.distance)));
    this.lift = Math.max(-STEEPEST, Math.min(STEEPEST, Math.max(least, this.lift)));
    const flat = Math.cos(this.lift) * this.distance;
    this.camera.position
      .set(Math.sin(this.turn) * flat, Math.sin(this.lift) * this.distance, Math.cos(this.turn) * flat)
      .add(this.target);
    this.camera.near = this.distance / 100;
    this.camera.far = this.distance * 20;
    this.camera.lookAt(this.target);
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld();
    this.lamp.rotation.y = this.turn - 0.4;
  }
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height || (width === this.width && height === this.height)) return;
    this.width = width;
    this.height = height;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    if (this.framed) this.frame(this.framed);
    this.draw();
  }
  /** The directions of the picture: right, up, and towards the eye. */
  axes() {
    const eye = new THREE.Vector3(
      Math.sin(this.turn) * Math.cos(this.lift),
      Math.sin(this.lift),
      Math.cos(this.turn) * Math.cos(this.lift),
    );
    const right = new THREE.Vector3(Math.cos(this.turn), 0, -Math.sin(this.turn));
    return { right, up: eye.clone().cross(right), eye };
  }
  /** Half of what a box takes along a direction. */
  half(box, direction) {
    const size = box.getSize(new THREE.Vector3());
    return [0, 1, 2].reduce((sum, k) => sum + 0.5 * size.getComponent(k) * Math.abs(direction.getComponent(k)), 0);
  }
  /** Moves so that a box fills the picture but for a margin; when the window changes, again, until the user zooms. */
  frame(box) {
    this.framed = box.clone();
    box.getCenter(this.target);
    this.size = box.getSize(new THREE.Vector3()).length() || 1;
    const { right, up, eye } = this.axes();
    const tangent = Math.tan((this.camera.fov * Math.PI) / 360);
    const [wide, high, deep] = [right, up, eye].map((direction) => this.half(box, direction));
    this.distance = MARGIN * Math.max(high / tangent, wide / tangent / (this.width / this.height)) + 0.5 * deep;
    this.draw();
  }
  /** A body stands on the floor of the stage, and is looked at as the first one was. */
  stand(box) {
    const { y } = box.min;
    this.floor = y + ABOVE_FLOOR * box.getSize(new THREE.Vector3()).length();
    this.look('home');
    this.frame(box);
  }
  /** Looks from one of SIDES; what is framed then fills the picture. */
  look(side) {
    Object.assign(this, SIDES[side]);
  }
  turnBy(dx, dy) {
    this.turn -= dx * TURN;
    this.lift += dy * TURN;
    this.draw();
  }
  panBy(dx, dy) {
    this.framed = null;
    const unit = (2 * this.distance * Math.tan((this.camera.fov * Math.PI) / 360)) / this.height;
    const [right, up] = [new THREE.Vector3(), new THREE.Vector3()];
    this.camera.matrixWorld.extractBasis(right, up, new THREE.Vector3());
    this.target.addScaledVector(right, -dx * unit).addScaledVector(up, dy * unit);
    this.target.y = Math.max(this.floor, this.target.y);
    this.draw();
  }
  zoomBy(factor) {
    this.framed = null;
    this.distance = Math.max(this.size * 0.05, Math.min(this.size * 12, this.distance * factor));
    this.draw();
  }

  /** Pixels of a place in the stage, and whether it is in front of the camera. */
  onScreen(place) {
    const p = new THREE.Vector3(...place).project(this.camera);
    return { x: ((p.x + 1) / 2) * this.width, y: ((1 - p.y) / 2) * this.height, front: p.z < 1 };
  }
  ray(x, y) {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2((x / this.width) * 2 - 1, 1 - (y / this.height) * 2), this.camera);
    return caster.ray;
  }
  /** Where the ray of a pixel meets the plane through a place that faces the camera. */
  onPlane(x, y, place) {
    const normal = this.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, new THREE.Vector3(...place));
    return this.ray(x, y).intersectPlane(plane, new THREE.Vector3())?.toArray() ?? place;
  }
  /** Pixels of a length at a place. */
  pixels(length, place) {
    const depth = new THREE.Vector3(...place).applyMatrix4(this.camera.matrixWorldInverse).z;
    return (length * this.height) / (2 * Math.tan((this.camera.fov * Math.PI) / 360) * Math.max(1e-9, -depth));
  }
  camRight() {
    return new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 0).toArray();
  }
  camUp() {
    return new THREE.Vector3().setFromMatrixColumn(this.camera.matrixWorld, 1).toArray();
  }

  /** A body that is ready to be drawn, and hidden: pictures are decoded, and the shaders are made without a stop. */
  async ready(body) {
    const skin = new Skin(body, this);
    skin.group.visible = false;
    try {
      await skin.loadPictures();
      await this.renderer.compileAsync(skin.group, this.camera, this.#scene);
    } catch (error) {
      skin.dispose();
      throw error;
    }
    return skin;
  }
  clear(group) {
    group.traverse((thing) => {
      thing.geometry?.dispose();
      for (const material of [thing.material].flat()) material?.dispose();
    });
    group.clear();
  }
  picture() {
    this.drawNow();
    return new Promise((resolve) => this.canvas.toBlob(resolve, 'image/png'));
  }
}
