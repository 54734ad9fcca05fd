// What is made once from a surface: skin weights and quads.
/** pins: { vertex, bone, radius }: places that belong to one bone alone. */
export function weightsOf(body, bones, influenceCount, pins) {
  const { hf, stiffness } = body;
  const begin = performance.now();
  const weights = new hf.Weights(stiffness.surface, { ...bones, influenceCount });
  try {
    if (pins.length)
      weights.setPins(
        pins.map(({ vertex }) => vertex),
        { joints: pins.map(({ bone }) => bone), weights: pins.map(() => 1), radii: pins.map(({ radius }) => radius) },
      );
    return {
      ...weights.get(),
      ...weights.joints(),
      info: weights.info,
      milliseconds: performance.now() - begin,
    };
  } finally {
    weights.close();
  }
}

/** kept: { hf, surface, quads }. Quads are updated, which keeps what they share. */
export function quadsOf(kept, options) {
  const begin = performance.now();
  if (kept.quads) kept.quads.update(options);
  else kept.quads = new kept.hf.Quads(kept.surface, options);
  return { mesh: kept.quads.mesh(), info: kept.quads.info, milliseconds: performance.now() - begin };
}
