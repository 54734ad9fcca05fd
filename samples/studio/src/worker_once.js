// What is made once from a surface: skin weights and quads.
/** pins: { vertex, bone, radius }: places that belong to one bone alone. */
export function weightsOf(body, bones, weightCount, pins) {
  const { hf, surface } = body;
  const begin = performance.now();
  const weights = new hf.Weights(surface, bones, { weightCount });
  try {
    if (pins.length)
      weights.setPins(
        pins.map(({ vertex }) => vertex),
        { joints: pins.map(({ bone }) => bone), weights: pins.map(() => 1), radii: pins.map(({ radius }) => radius) },
      );
    return {
      ...weights.weights(),
      ...weights.bones(),
      info: weights.info,
      milliseconds: performance.now() - begin,
    };
  } finally {
    weights.close();
  }
}

export function quadsOf(hf, surface, options) {
  const begin = performance.now();
  const quads = new hf.Quads(surface, options);
  const answer = { mesh: quads.mesh(), info: quads.info, milliseconds: performance.now() - begin };
  quads.close();
  return answer;
}
