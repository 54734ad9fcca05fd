// Detail of regions: each region is drawn as a closed curve of vertices and smoothed or exaggerated by a weight.
export function detailOf(body) {
  const { hf, surface } = body;
  let region = null; // kept while its curve and its shape stay
  let key = '';
  let shape = null;

  const same = (positions) => shape && shape.every((x, i) => x === positions[i]);

  return {
    /** Changes the positions in place. detail: { curve, seed, rings, weight }. */
    apply(positions, { curve, seedVertex, rings, weight }) {
      const wanted = JSON.stringify([curve, seedVertex]);
      if (!region || wanted !== key || !same(positions)) {
        const next = new hf.Region(surface, { positions });
        try {
          next.edit({ curve, seedVertex, side: 0 });
        } catch (error) {
          next.close();
          throw error;
        }
        region?.close();
        region = next;
        key = wanted;
        shape = positions.slice();
        this.rings = 0;
      }
      if (rings !== this.rings) {
        region.edit({ rings: rings - this.rings });
        this.rings = rings;
      }
      positions.set(region.morph(weight));
      const { vertexCount, rimCount, area } = region.info;
      return { vertexCount, rimCount, area, inside: region.vertices(0), rim: region.vertices(1) };
    },
    rings: 0,
    close: () => region?.close(),
  };
}
