// A circle that faces the eye: how far a handle or a brush reaches.
import { BufferGeometry, LineBasicMaterial, LineLoop, Vector3 } from 'three';

/** Corners of the circle: each is shorter than 6 pixels. */
const POINTS = 72;

export function circleOf(view) {
  const round = Array.from({ length: POINTS }, (_, i) => (2 * Math.PI * i) / POINTS);
  const circle = new LineLoop(
    new BufferGeometry().setFromPoints(round.map((angle) => new Vector3(Math.cos(angle), Math.sin(angle)))),
    new LineBasicMaterial({ color: 0xe0781e, depthTest: false }),
  );
  circle.visible = false;
  circle.renderOrder = 4;
  view.extras.add(circle);
  circle.onBeforeRender = (renderer, scene, camera) => {
    circle.quaternion.copy(camera.quaternion);
    circle.updateMatrixWorld();
  };
  return circle;
}
