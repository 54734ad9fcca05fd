// The field of the body: holds the list of sites that the page asks for.

/** A soft site pulls with this stiffness, in the unit of the operator: between free and hard on our own creatures. */
const SOFT_STIFFNESS = 1;

export function fieldOf(body) {
  const { hf, surface } = body;
  const present = () => body.stiffness?.surface ?? surface;
  let solver = null;
  let on = null; // the surface that it stands on
  let held = new Map(); // id -> { number, corners, barycentrics, value, soft }
  const components = surface.components();

  const moved = (a, b) =>
    a.corners.some((x, k) => x !== b.corners[k]) || a.barycentrics.some((x, k) => x !== b.barycentrics[k]);

  const hold = (sites) => {
    const next = present();
    if (!solver) solver = new hf.Solver(next);
    else if (on !== next) solver.moveTo(next);
    on = next;
    const wanted = new Map(sites.map((site) => [site.id, site]));
    const gone = [...held].filter(([id, site]) => !wanted.has(id) || wanted.get(id).soft !== site.soft);
    if (gone.length) {
      solver.removeSites(gone.map(([, { number }]) => number));
      for (const [id] of gone) held.delete(id);
    }
    const kept = sites.filter(({ id }) => held.has(id));
    const travelled = kept.filter((site) => moved(site, held.get(site.id)));
    if (travelled.length)
      solver.moveSites(
        travelled.map(({ id }) => held.get(id).number),
        null,
        null,
        { places: travelled },
      );
    const changed = kept.filter((site) => site.value !== held.get(site.id).value);
    if (changed.length)
      solver.setValues(
        changed.map(({ id }) => held.get(id).number),
        changed.map(({ value }) => value),
      );
    for (const site of kept) held.set(site.id, { ...site, number: held.get(site.id).number });
    const added = sites.filter(({ id }) => !held.has(id));
    if (added.length) {
      const stiffness = added.map(({ soft }) => (soft ? SOFT_STIFFNESS : 0));
      const numbers = solver.addSites(
        null,
        added.map(({ value }) => value),
        { places: added, stiffness },
      );
      added.forEach((site, i) => held.set(site.id, { ...site, number: numbers[i] }));
    }
  };

  /** The field from scratch: an edit that was refused half-way leaves the list that was there. */
  const change = (sites) => {
    const before = [...held.values()];
    try {
      hold(sites);
    } catch (error) {
      solver.close();
      solver = null;
      held = new Map();
      hold(before);
      throw error;
    }
  };

  return {
    /**
     * fresh: the bits do not depend on the sites that were there before. reached: 1 where a site reaches, null where all is
     * reached.
     */
    solve(sites, fresh) {
      if (fresh && solver) {
        solver.close();
        solver = null;
        held = new Map();
      }
      change(sites);
      const values = solver.solve();
      const told = solver.solveInfo;
      if (!told.unreachedVertexCount) return { values, reached: null, told };
      const reached = new Float32Array(values.length);
      const withSite = new Set(sites.map(({ corners }) => components[corners[0]]));
      for (let v = 0; v < reached.length; ++v) reached[v] = withSite.has(components[v]) ? 1 : 0;
      return { values, reached, told };
    },
    close: () => solver?.close(),
  };
}
