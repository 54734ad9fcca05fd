// The pose of the body: holds the list of handles that the page asks for.

const sameRegion = (a, b) => a.id === b.id && a.radius === b.radius && a.position.every((x, k) => x === b.position[k]);

export function poseOf(body) {
  const { hf, surface } = body;
  let pose = null;
  let held = []; // { id, position, radius, number }
  let told = {};

  /** Handles up to the first difference stay; the others are removed and added in order, so that order decides the bits. */
  const hold = (handles) => {
    pose ??= new hf.Pose(surface);
    let same = 0;
    while (same < held.length && same < handles.length && sameRegion(held[same], handles[same])) ++same;
    if (same < held.length) {
      pose.removeHandles(held.slice(same).map(({ number }) => number));
      held.length = same;
    }
    if (same < handles.length) {
      const added = handles.slice(same);
      const numbers = pose.addHandles(null, {
        points: added.flatMap(({ position }) => position),
        radii: added.map(({ radius }) => radius),
      });
      added.forEach(({ id, position, radius }, i) => held.push({ id, position, radius, number: numbers[i] }));
    }
  };

  const change = (handles) => {
    const before = held.slice();
    try {
      hold(handles);
    } catch (error) {
      hold(before);
      throw error;
    }
  };

  return {
    /** Positions of every vertex. restart: the bits depend on these handles and transforms alone. */
    deform(handles, { restart = false } = {}) {
      if (!handles.length) {
        if (held.length) change([]);
        told = { unreachedVertexCount: 0, handles: [] };
        return body.positions.slice();
      }
      const known = new Set(held.map(({ number }) => number));
      change(handles);
      const added = held.some(({ number }) => !known.has(number));
      pose.setTransforms(
        held.map(({ number }) => number),
        {
          rotations: handles.flatMap((handle) => handle.rotation),
          translations: handles.flatMap((handle) => handle.translation),
        },
      );
      const positions = pose.deform(null, { restart: Number(restart) });
      told = pose.deformInfo;
      told.added = added;
      told.handles = held.map(({ id, number }) => ({ id, centroid: pose.handleInfo(number).centroid }));
      return positions;
    },
    told: () => told,
    skin: () => pose.skin(4),
    close: () => pose?.close(),
  };
}
