// The motion of another body on this one. Pairs are proposed from the handles that the library proposes for both: feet with
// feet and tips with tips, at like places of the two boxes; and the top and the bottom of the trunk.

/** Two places are alike if they differ by less than this part of the box: the tail of a horse and of a bull do, a horn and a tail do not. */
const ALIKE = 0.45;

export function transferOf(body, source) {
  const { hf, surface } = body;
  const { HF_PAIR_FOOT, HF_PAIR_TRUNK, HF_PAIR_ANCHOR, HF_HANDLE_REASON_FOOT } = hf.constants;
  const sourcePositions = body.sourcePositions;
  let transfer = null;

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
      like: place.position.map((x, k) => (x - low[k]) / Math.max(high[k] - low[k], 1e-9)),
    });
    return [...places, ...trunk].map(like);
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
  const regionOf = (positions, { position, radius }, nearest) => {
    const list = [];
    for (let v = 0; 3 * v < positions.length; ++v)
      if (
        Math.hypot(
          positions[3 * v] - position[0],
          positions[3 * v + 1] - position[1],
          positions[3 * v + 2] - position[2],
        ) < radius
      )
        list.push(v);
    return list.length ? list : [nearest(position)];
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
          source: { position: from[i].position, radius: from[i].radius },
          target: { position: to[j].position, radius: to[j].radius },
        });
      }
      return pairs;
    },
    setPairs(pairs) {
      const next = new hf.Transfer(source, surface);
      const flags = { foot: HF_PAIR_FOOT | HF_PAIR_ANCHOR, trunk: HF_PAIR_TRUNK | HF_PAIR_ANCHOR, tip: 0 };
      try {
        next.addPairs(
          pairs.map((pair) => regionOf(sourcePositions, pair.source, (place) => source.findVertex(place).vertex)),
          pairs.map((pair) => regionOf(body.positions, pair.target, (place) => surface.findVertex(place).vertex)),
          pairs.map(({ kind }) => flags[kind]),
        );
      } catch (error) {
        next.close();
        throw error;
      }
      transfer?.close();
      transfer = next;
      return next.info;
    },
    apply: (positions) => transfer.apply(positions),
    skin: () => transfer.skin(4),
    close() {
      transfer?.close();
      source.close();
    },
  };
}
