// What is made once from a surface: skin weights and quads.
export function weightsOf(body, bones, weightCount) {
  const { hf, surface } = body;
  const begin = performance.now();
  const weights = new hf.Weights(surface, bones, { weightCount });
  const answer = {
    ...weights.weights(),
    ...weights.bones(),
    info: weights.info,
    milliseconds: performance.now() - begin,
  };
  weights.close();
  return answer;
}

export function quadsOf(hf, surface, { edgeLength, kind }) {
  const begin = performance.now();
  const quads = new hf.Quads(surface, { edgeLength, kind });
  const answer = { mesh: quads.mesh(), info: quads.info, milliseconds: performance.now() - begin };
  quads.close();
  return answer;
}
