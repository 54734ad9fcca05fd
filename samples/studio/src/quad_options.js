// What the library is asked for: sizes, creases, a mirror, and the strokes and poles of the user at rest.

/** HF_NO_INDEX: no relaxation and no fitting, which take most of the time. */
const NO_RELAXATION = 0xffffffff;

/** Directions along the strokes of the body at rest, at the corners of the triangles under them. */
function guidesOf({ skin, body: { positions } }, strokes) {
  const [guideVertices, guideVectors] = [[], []];
  for (const { places } of strokes) {
    const points = places.map((place) => skin.at(place, positions));
    points.slice(1).forEach((point, i) => {
      const vector = point.map((x, k) => x - points[i][k]);
      if (!Math.hypot(...vector)) return;
      for (const vertex of places[i].corners) {
        guideVertices.push(vertex);
        guideVectors.push(...vector);
      }
    });
  }
  return guideVertices.length ? { guideVertices, guideVectors } : {};
}

/** Places of the body at rest. A pole on the side that is mirrored counts as its image. */
function polesOf({ skin, body: { positions } }, poles, plane) {
  if (!poles.length) return {};
  const irregularPoints = poles.flatMap((pole) => {
    const point = Array.from(skin.at(pole, positions));
    const behind = plane ? plane[3] - point.reduce((sum, x, k) => sum + x * plane[k], 0) : 0;
    return behind > 0 ? point.map((x, k) => x + 2 * behind * plane[k]) : point;
  });
  return { irregularPoints, irregularValences: poles.map(({ quads }) => quads) };
}

/** relaxed: false while a stroke or a pole is drawn or dragged. */
export function quadOptions({ middleOf }, { app, edge, crease, mirror, strokes, poles }, relaxed) {
  const options = { edgeLength: edge * app.opened.report.boundingBoxDiagonal };
  if (mirror !== '')
    options.symmetryPlane = [0, 1, 2].map((k) => Number(k === mirror)).concat(middleOf(app.body, mirror));
  Object.assign(options, guidesOf(app, strokes), polesOf(app, poles, options.symmetryPlane));
  return { ...options, creaseAngle: (crease * Math.PI) / 180, relaxCount: relaxed ? 0 : NO_RELAXATION };
}
