// The program that every host runs: a field and a pose on a strip of four triangles.
export function field(hf) {
  const positions = new Float32Array([0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0, 2, 1, 0]);
  const triangles = new Uint32Array([0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5]);
  const surface = new hf.Surface(positions, triangles);
  const solver = new hf.Solver(surface);
  solver.addSites([0, 1, 4, 5], [0, 0, 1, 1]);
  const values = solver.solve();

  const pose = new hf.Pose(surface);
  pose.addHandleAt([0, 0.5, 0], 0.5);
  const right = pose.addHandleAt([2, 0.5, 0], 0.5);
  pose.setTransform(right, { translation: [0, 0, 1] });
  const posed = pose.deform();
  return `${hf.backend}: ${values.join(' ')}, ${posed.subarray(12, 15).join(' ')}`;
}
