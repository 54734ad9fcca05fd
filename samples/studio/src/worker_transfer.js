// The motion of another body on this one. Pairs are proposed by hf_gltf (worker_pairs.js).
export function transferOf(body, source) {
  const { hf, surface } = body;
  const { HF_PAIR_FOOT, HF_PAIR_TRUNK, HF_PAIR_ANCHOR, HF_PAIR_NECK, HF_PAIR_TAIL, HF_PAIR_ARM } = hf.constants;
  const sourcePositions = body.sourcePositions;
  let transfer = null;
  let dials = {};
  let axes = {};

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

  /** The flags of a pair; those of links from before have a kind and a part instead. */
  const flagsOf = ({ flags, kind, part }) => {
    const kinds = { foot: HF_PAIR_FOOT | HF_PAIR_ANCHOR, trunk: HF_PAIR_TRUNK | HF_PAIR_ANCHOR, tip: 0 };
    const parts = { neck: HF_PAIR_NECK, tail: HF_PAIR_TAIL, arm: HF_PAIR_ARM };
    return flags ?? kinds[kind] | (parts[part] ?? 0);
  };

  return {
    /** Pairs of places that correspond. glb: the bytes of both models. */
    async proposals(glb) {
      const { proposedPairs } = await import('./worker_pairs.js');
      const found = await proposedPairs(
        hf,
        { glb: glb.source, positions: sourcePositions, triangles: body.sourceTriangles, surface: source },
        { glb: glb.target, positions: body.positions, triangles: body.triangles, surface },
      );
      axes = found.axes;
      return found.pairs;
    },
    setPairs(pairs) {
      const next = new hf.Transfer(source, surface, axes);
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
          pairs.map(flagsOf),
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
    skin: () => {
      const { vertexJoints: joints, vertexWeights: weights, ...skin } = transfer.skin({ influenceCount: 4 });
      return { ...skin, joints, weights };
    },
    close() {
      transfer?.close();
      source.close();
    },
  };
}
