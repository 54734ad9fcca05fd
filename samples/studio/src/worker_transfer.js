// The motion of another body on this one. Pairs are proposed from the handles that the library proposes for both: feet with
// feet and tips with tips, at like places of the two boxes; and the top and the bottom of the trunk.

/** Two places are alike if they differ by less than this part of the box: the tail of a horse and of a bull do, a horn and a tail do not. */
const ALIKE = 0.45;

export function transferOf(body, source) {
  const { hf, surface } = body;
  const {
    HF_PAIR_FOOT,
    HF_PAIR_TRUNK,
    HF_PAIR_ANCHOR,
    HF_PAIR_NECK,
    HF_PAIR_TAIL,
    HF_PAIR_ARM,
    HF_HANDLE_REASON_FOOT,
  } = hf.constants;
  const sourcePositions = body.sourcePositions;
  let transfer = null;
  let dials = {};

  const boxOf = (positions) => {
    const [low, high] = [
      [Infinity, Infinity, Infinity],
      [-Infinity, -Infinity, -Infinity],
    ];
    for (let i = 0; i < positions.length; ++i) {
      low[i % 3] = Math.min(low[i % 3], positions[i]);
      high[i % 3] = Math.max(high[i % 3], positions[i]);
    }
    return { low, high };
  };
  const placesOf = (on, positions) => {
    const { low, high } = boxOf(positions);
    const size = Math.hypot(...high.map((x, k) => x - low[k]));
    const places = on
      .proposeHandles()
      .map(({ position, radius, reason }) => ({ position, radius, foot: reason === HF_HANDLE_REASON_FOOT }));
    const feet = places.filter(({ foot }) => foot);
    const trunk = trunkOf(on, positions, low, high, feet).map((position) => ({
      position,
      radius: 0.03 * size,
      trunk: true,
    }));
    const like = (place) => ({
      ...place,
      part: place.foot || place.trunk ? null : partOf(place.position, low, high, feet),
      like: place.position.map((x, k) => (x - low[k]) / Math.max(high[k] - low[k], 1e-9)),
    });
    return [...places, ...trunk].map(like);
  };
  /** What a tip belongs to, for the dials: beyond the fore feet to the neck, beyond the hind feet to the tail; of a body on
   * two feet the top to the neck, what is far to a side to an arm. */
  const partOf = (position, low, high, feet) => {
    if (feet.length >= 4) {
      const rows = feet.map((foot) => foot.position[2]);
      return position[2] > Math.max(...rows) ? 'neck' : position[2] < Math.min(...rows) ? 'tail' : null;
    }
    const share = (k) => (position[k] - low[k]) / Math.max(high[k] - low[k], 1e-9);
    if (feet.length < 2) return null;
    return share(1) > 0.8 ? 'neck' : Math.abs(share(0) - 0.5) > 0.3 ? 'arm' : null;
  };
  /** Withers and rump: where vertical lines over the fore and the hind feet enter the body. Over one row of feet: back and belly. */
  const trunkOf = (on, positions, low, high, feet) => {
    const centre = (list, k) => list.reduce((sum, { position }) => sum + position[k], 0) / list.length;
    const down = (x, z) => on.castRay([x, high[1] + 1, z], [0, -1, 0])?.position;
    if (feet.length >= 4) {
      const middle = centre(feet, 2);
      const [fore, hind] = [
        feet.filter(({ position }) => position[2] > middle),
        feet.filter(({ position }) => position[2] <= middle),
      ];
      return [down(centre(fore, 0), centre(fore, 2)), down(centre(hind, 0), centre(hind, 2))].filter(Boolean);
    }
    const [x, z] = feet.length ? [centre(feet, 0), centre(feet, 2)] : [(low[0] + high[0]) / 2, (low[2] + high[2]) / 2];
    const under = on.castRay([x, low[1] - 1, z], [0, 1, 0])?.position;
    return [down(x, z), under].filter(Boolean);
  };
  /** The vertices around each place; one that lies in reach of two belongs to the nearer. */
  const regionsOf = (positions, places, nearest) => {
    const lists = places.map(() => []);
    for (let v = 0; 3 * v < positions.length; ++v) {
      let [best, owner] = [1, -1];
      places.forEach(({ position, radius }, i) => {
        const away =
          Math.hypot(
            positions[3 * v] - position[0],
            positions[3 * v + 1] - position[1],
            positions[3 * v + 2] - position[2],
          ) / radius;
        if (away < best) [best, owner] = [away, i];
      });
      if (owner >= 0) lists[owner].push(v);
    }
    return lists.map((list, i) => (list.length ? list : [nearest(places[i].position)]));
  };

  return {
    /** Pairs of places: nearest first, each place once. */
    proposals() {
      const [from, to] = [placesOf(source, sourcePositions), placesOf(surface, body.positions)];
      const kindOf = ({ foot, trunk }) => (foot ? 'foot' : trunk ? 'trunk' : 'tip');
      const options = [];
      from.forEach((a, i) =>
        to.forEach((b, j) => {
          if (kindOf(a) === kindOf(b)) options.push([Math.hypot(...a.like.map((x, k) => x - b.like[k])), i, j]);
        }),
      );
      options.sort((a, b) => a[0] - b[0]);
      const [used, taken, pairs] = [new Set(), new Set(), []];
      for (const [away, i, j] of options) {
        if (used.has(i) || taken.has(j) || away > ALIKE) continue;
        used.add(i);
        taken.add(j);
        pairs.push({
          kind: kindOf(from[i]),
          part: from[i].part === to[j].part ? to[j].part : null,
          source: { position: from[i].position, radius: from[i].radius },
          target: { position: to[j].position, radius: to[j].radius },
        });
      }
      return pairs;
    },
    setPairs(pairs) {
      const next = new hf.Transfer(source, surface);
      const flags = { foot: HF_PAIR_FOOT | HF_PAIR_ANCHOR, trunk: HF_PAIR_TRUNK | HF_PAIR_ANCHOR, tip: 0 };
      const partFlags = { neck: HF_PAIR_NECK, tail: HF_PAIR_TAIL, arm: HF_PAIR_ARM };
      try {
        next.addPairs(
          ...[
            ['source', source, sourcePositions],
            ['target', surface, body.positions],
          ].map(([side, on, positions]) =>
            regionsOf(
              positions,
              pairs.map((pair) => pair[side]),
              (place) => on.findVertex(place).vertex,
            ),
          ),
          pairs.map(({ kind, part }) => flags[kind] | (partFlags[part] ?? 0)),
        );
        next.setDials(dials);
      } catch (error) {
        next.close();
        throw error;
      }
      transfer?.close();
      transfer = next;
      return next.info;
    },
    setDials(next) {
      transfer?.setDials(next);
      dials = next;
    },
    apply: (positions) => transfer.apply(positions),
    skin: () => transfer.skin(4),
    close() {
      transfer?.close();
      source.close();
    },
  };
}
