// The tree of boxes that picking uses: built in the Worker, used on the main thread.
import { BufferAttribute, BufferGeometry } from 'three';
import { MeshBVH } from 'three-mesh-bvh';

const geometryOf = (positions, triangles) => {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(triangles, 1));
  return geometry;
};

/** Built without a change of the triangles' order: hits name triangles as the surface has them. */
export function buildBvh(positions, triangles) {
  const bvh = new MeshBVH(geometryOf(positions, triangles), { indirect: true });
  const answer = MeshBVH.serialize(bvh, { cloneBuffers: false });
  answer.index = null;
  return { answer, buffers: [...answer.roots, answer.indirectBuffer?.buffer].filter(Boolean) };
}

/** The same tree over the arrays of the main thread. */
export function readBvh(answer, positions, triangles) {
  return MeshBVH.deserialize({ ...answer, index: triangles }, geometryOf(positions, triangles), { setIndex: false });
}
