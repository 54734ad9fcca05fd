"""An edit of a bound mesh: which vertex was which, and what goes along. Attributes of the vertices, which Blender carries through
Edit Mode, tell it (mesh_data.py). Painted groups and fields are vertex groups and attributes, so Blender carries them by itself."""

import numpy as np

from . import carriers, mesh_data


class Taken:
    """What an edit changed, for the sentence of the panel."""

    def __init__(self):
        self.fresh, self.kept, self.lost = 0, 0, []  # new vertices; handles; names of handles whose vertices are gone

    def sentence(self, milliseconds, painted):
        """painted: what else stays, in words."""
        kept = [f"{self.kept} handle{'s' * (self.kept != 1)}"] * bool(self.kept) + painted
        out = f"The mesh was edited and is bound again in {milliseconds:.0f} ms: "
        out += f"{' and '.join(kept)} stay" if kept else "it has no handle"
        if self.fresh:
            out += f", {self.fresh} vertices are new"
        return out + (f"; {', '.join(self.lost)} went with its vertices" if self.lost else "")


def region_after(region, before, marks):
    """The vertices of a handle after an edit: those that were there, copies of them, and new ones between them.

    before: the number that each vertex had, -1 for a new one. marks: mesh_data.regions_of."""
    inside = np.isin(before, np.asarray(region, np.int64))
    own = np.bincount(marks[inside]).argmax() if inside.any() else 0
    return np.flatnonzero(inside | ((before < 0) & (marks == own) & (own > 0)))


def take(obj, rest, held):
    """Takes an edit of a bound mesh into its rest shape and into the regions of its handles. held: carriers of the handles.
    Returns what was taken, or None where nothing was edited."""
    mesh = obj.data
    before = mesh_data.numbers_of(mesh)
    if before is None or (np.array_equal(before, np.arange(len(before))) and np.array_equal(rest, mesh_data.rest_of(mesh))):
        return None
    marks, out = mesh_data.regions_of(mesh), Taken()
    mesh_data.take_edit(mesh, rest)
    out.fresh = int(np.count_nonzero(before < 0)) + int(np.count_nonzero(before >= 0)) - len(np.unique(before[before >= 0]))
    for carrier in held:
        region = region_after(carrier["hf_vertices"], before, marks)
        if len(region):
            carrier["hf_vertices"] = region.tolist()
            out.kept += 1
        else:
            out.lost.append(carrier.name)
            carriers.unmark(carrier)
    return out
