// The pose of the body: holds the list of handles that the page asks for.

// At most; a pose at rest ends them. Of two bodies whose handles were moved by 0.2 of the box and turned by 60 degrees, 50
// leave 1e-7 and 7e-5 of the box, 100 leave 6e-8 and 3e-8, and cost 5 and 8 ms (native).
const REST_ITERATIONS = 100;

// Keeping lengths takes so many steps of as-rigid-as-possible on the whole surface, from the smooth pose on. 8 is the least
// that hf_deform_desc gives for it; more make bends sharper. The same handles give the same body, so a drag ends without a
// jump. A step takes 2.9 us a vertex on a slow EPYC: 130 ms for eight steps of the samples. So larger bodies take one step a
// frame while they are dragged, from the last frame on, and settle when the drag stops.
const LENGTH_STEPS = 8;
const LIVE_VERTICES = 6000;

/** What a handle says beside its place: [name, its value, how the pose is told]. A rotation is given from where it stands. */
const SETTINGS = [
  ['free', ({ free }) => Number(Boolean(free)), (pose, numbers, value) => pose.setFreeRotations(numbers, value)],
  // A handle that stands where it was grabbed moves nothing: what follows it counts from its first move on. It takes as long
  // as adding the handle, so a drag tells it a frame later.
  [
    'following',
    ({ following = 1, from, translation }, { fresh }) =>
      fresh || from?.every((x, k) => x === translation[k]) ? 1 : following,
    (pose, numbers, value) => pose.setFollowing(numbers, value),
  ],
  ['limb', ({ limb }) => (limb ? LENGTH_STEPS : 0), (pose, numbers, value) => pose.setLimbRefine(numbers, value)],
];

const sameRegion = (a, b) => a.id === b.id && a.radius === b.radius && a.position.every((x, k) => x === b.position[k]);

/** The regions of heads, hands and feet as the library proposes them: the proposal of each handle that was not changed. */
function proposedRegions({ proposals = [], regions }) {
  const at = ({ position, radius }) => [...position, radius].join();
  const lists = new Map(proposals.map((proposal) => [at(proposal), []]));
  const byNumber = [...lists.values()];
  regions?.forEach((number, v) => byNumber[number]?.push(v));
  return (handle) => {
    const list = lists.get(at(handle));
    return list?.length ? list : null;
  };
}

export function poseOf(body) {
  const { hf, surface } = body;
  const regionOf = proposedRegions(body);
  const present = () => body.stiffness?.surface ?? surface;
  let pose = null;
  let on = null; // the surface that it stands on
  let held = []; // { id, position, radius, number, and what the pose was told of it (SETTINGS) }
  let told = {};
  let grabbed = false; // since the last deform

  /** Adds handles that have all a region, or have none and take what lies within their radius. */
  const add = (some, inPlace) => {
    const lists = some.map(regionOf);
    const points = some.flatMap(({ position }) => position);
    const radii = some.map(({ radius }) => radius);
    return lists[0] ? pose.addHandles(lists, { inPlace }) : pose.addHandles(null, { points, radii, inPlace });
  };

  /** Handles up to the first difference stay; the others are removed and added in order, so that order decides the bits. */
  const hold = (handles, inPlace = false) => {
    const next = present();
    if (!pose) pose = new hf.Pose(next);
    else if (on !== next) pose.moveTo(next);
    on = next;
    let same = 0;
    while (same < held.length && same < handles.length && sameRegion(held[same], handles[same])) ++same;
    if (same < held.length) {
      pose.removeHandles(held.slice(same).map(({ number }) => number));
      held.length = same;
    }
    while (held.length < handles.length) {
      const next = handles.slice(held.length);
      const kind = !regionOf(next[0]);
      const other = next.findIndex((handle) => !regionOf(handle) !== kind);
      const added = other < 0 ? next : next.slice(0, other);
      const numbers = add(added, inPlace);
      added.forEach(({ id, position, radius }, i) =>
        held.push({ id, position, radius, number: numbers[i], fresh: true, free: 0, following: 1, limb: 0 }),
      );
    }
  };

  const change = (handles, inPlace = false) => {
    const before = held.slice();
    try {
      hold(handles, inPlace);
    } catch (error) {
      hold(before);
      // of handles the library refuses this alone as a conflict; it counts vertices and entries, which no artist has seen
      if (error.codeName !== 'HF_ERROR_CONFLICT') throw error;
      throw new Error('a handle overlaps another; put it farther away, or make it smaller');
    }
  };

  const lengthSteps = (lengths, way) => {
    if (!lengths) return {};
    const live = way === 'follow' && body.positions.length / 3 > LIVE_VERTICES;
    return { refine: live ? 1 : LENGTH_STEPS, refineFromLast: Number(live) };
  };

  /** Tells the pose the settings that differ. */
  const set = (handles, way) => {
    if (way !== 'follow') for (const one of held) one.fresh = false;
    for (const [name, wanted, tell] of SETTINGS)
      for (const value of new Set(held.map((one, i) => wanted(handles[i], one)))) {
        const changed = held.filter((one, i) => one[name] !== value && wanted(handles[i], one) === value);
        if (!changed.length) continue;
        tell(
          pose,
          changed.map(({ number }) => number),
          value,
        );
        for (const one of changed) one[name] = value;
      }
    for (const one of held) one.fresh = false;
  };

  const place = (handles, way) => {
    change(handles);
    set(handles, way);
    pose.setTransforms(
      held.map(({ number }) => number),
      {
        rotations: handles.flatMap((handle) => handle.rotation),
        translations: handles.flatMap((handle) => handle.translation),
      },
    );
  };

  return {
    /**
     * Adds handles where the posed body stands, so that it stays. Returns the rotation and translation of each. The next
     * deform gets them in its list.
     */
    grab(handles, added, lengths = false) {
      // a skin may have been asked for since the last frame, at another time
      place(handles);
      pose.deform(null, { iterationCount: REST_ITERATIONS, ...lengthSteps(lengths, 'rest') });
      change([...handles, ...added], true);
      grabbed = true;
      return held.slice(handles.length).map(({ number }) => {
        // plain lists: a link and a session keep them
        const [rotation, translation] = [pose.handle(number).rotation, pose.handle(number).translation].map((x) => Array.from(x));
        return { rotation, translation, from: translation };
      });
    },
    /**
     * Positions of every vertex. way: 'follow' goes a frame on from the last pose, as a drag needs; 'rest' goes on until
     * nothing moves; 'exact' starts anew and comes to rest, so that its bits depend on these handles alone. lengths: edges
     * keep their lengths.
     */
    deform(handles, way, lengths = false) {
      if (!handles.length) {
        if (held.length) change([]);
        told = { unreachedVertexCount: 0, handles: [] };
        return body.positions.slice();
      }
      const known = new Set(held.map(({ number }) => number));
      place(handles, way);
      const added = grabbed || held.some(({ number }) => !known.has(number));
      grabbed = false;
      const positions = pose.deform(null, {
        restart: Number(way === 'exact'),
        iterationCount: way === 'follow' ? 0 : REST_ITERATIONS,
        ...lengthSteps(lengths, way),
      });
      told = pose.deformInfo;
      told.added = added;
      if (way !== 'follow') {
        surface.measureGaps(positions);
        told.gap = surface.gapsInfo.worst / surface.report.boundingBoxDiagonal;
      }
      told.handles = held.map(({ id, number }) => {
        const { centroid, rotation } = pose.handle(number);
        return { id, centroid, rotation };
      });
      return positions;
    },
    told: () => told,
    skin: () => {
      const { vertexJoints: joints, vertexWeights: weights, ...skin } = pose.skin({ influenceCount: 4 });
      return { ...skin, joints, weights };
    },
    close: () => pose?.close(),
  };
}
