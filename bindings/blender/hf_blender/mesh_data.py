"""Between a Blender mesh and arrays: positions, faces, vertex groups, colours."""

import math

import bpy
import numpy as np

import hf

REST = "hf_rest"
POSED = "hf_posed"  # where the last pose put each vertex; edits carry it along, so what differs from it is an edit
NUMBER = "hf_number"  # of each vertex when the mesh was bound, from 1; edits carry it along, 0 is a new vertex
HELD = "hf_held"  # the handle that has each vertex, from 1; 0 for none
# Blender gives a new vertex on an edge or a face the mean of its neighbours' numbers, which is the number of another. So each
# number has a scrambled one beside it, and the mean of those belongs to another number. Where all neighbours have one number,
# the mean of 24 bits in single precision is off by up to 4; at double that, one mix in a million counts as a number.
SCRAMBLED, MEAN_ERROR = "_scrambled", 8


def positions_of(mesh):
    out = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", out)
    return out.reshape(-1, 3)


def vectors_of(mesh, name):
    """An attribute of the vertices, or None where the mesh has none of that name."""
    if name not in mesh.attributes or len(mesh.attributes[name].data) != len(mesh.vertices):
        return None
    out = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.attributes[name].data.foreach_get("vector", out)
    return out.reshape(-1, 3)


def keep_vectors(mesh, name, vectors):
    layer = mesh.attributes.get(name) or mesh.attributes.new(name, "FLOAT_VECTOR", "POINT")
    layer.data.foreach_set("vector", vectors.ravel())


def rest_of(mesh):
    """The rest positions: the attribute of an earlier pose, or the mesh as it is."""
    rest = vectors_of(mesh, REST)
    return positions_of(mesh) if rest is None else rest


def edited_rest(mesh):
    """The rest positions after edits: a vertex moves at rest as it was moved in the pose, turned back with the surface around
    it. A new vertex has both positions from its neighbours, or neither."""
    rest, posed = vectors_of(mesh, REST), vectors_of(mesh, POSED)
    if rest is None or posed is None:
        return rest_of(mesh)
    moves = positions_of(mesh) - posed
    moved = np.flatnonzero(moves.any(1))
    if len(moved):
        turns = turns_at(mesh, moved, rest, posed)
        rest[moved] += np.einsum("vji,vj->vi", turns, moves[moved].astype(np.float64))
    return rest


def turns_at(mesh, vertices, rest, posed):
    """The rotation of the surface at some vertices, from rest into a pose: the one that fits the edges of the vertex and of its
    neighbours. One ring can lie on a line, as at the rim of an extrusion."""
    edges = column(mesh.edges, "vertices", 2).reshape(-1, 2).astype(np.int64)
    known = (rest.any(1) | posed.any(1)) & np.isfinite(rest + posed).all(1)  # not a new vertex without positions
    edges = edges[known[edges].all(1)]
    apart = [(p[edges[:, 1]] - p[edges[:, 0]]).astype(np.float64) for p in (posed, rest)]
    products = np.einsum("ei,ej->eij", *apart).reshape(-1, 9)
    spread = lambda first, second: np.stack([np.bincount(edges[:, 0], first[:, k], len(rest))
        + np.bincount(edges[:, 1], second[:, k], len(rest)) for k in range(9)], 1)
    own = spread(products, products)
    near = (own + spread(own[edges[:, 1]], own[edges[:, 0]]))[vertices].reshape(-1, 3, 3)
    left, _, right = np.linalg.svd(near)
    left[:, :, 2] *= np.linalg.det(left @ right)[:, None]
    return left @ right


def size_of(mesh):
    """The diagonal of the box of the surface at rest."""
    corners = rest_of(mesh)[on_surface(mesh)]
    return float(np.linalg.norm(np.ptp(corners, axis=0))) if len(corners) else 0.0


def shape_keys_of(obj):
    """Why a mesh can show no pose, or ""."""
    if obj.data.shape_keys is None:
        return ""
    return (f"{obj.name} has shape keys, and Blender shows these instead of a pose; remove them (Properties, Data, Shape Keys), "
        "or pose a copy without them")


def refuse_shape_keys(obj):
    if shape_keys_of(obj):
        raise hf.UnsupportedError(shape_keys_of(obj))


def keep_pose(mesh, rest, posed):
    """Writes a pose into a mesh. Undo, a saved file and a copy take the attributes along with the mesh."""
    if REST not in mesh.attributes:  # until now the mesh itself holds it
        keep_vectors(mesh, REST, rest)
    keep_vectors(mesh, POSED, posed)
    mesh.vertices.foreach_set("co", posed.ravel())
    mesh.update()


def restore_rest(mesh):
    """The rest shape back into a mesh, and what the add-on kept away. Shape keys hold places of their own: those that were added
    to a posed mesh hold the pose too."""
    rest = edited_rest(mesh)
    offset = positions_of(mesh) - rest
    for key in mesh.shape_keys.key_blocks if mesh.shape_keys and offset.any() else ():
        places = np.empty(3 * len(key.data), np.float32)
        key.data.foreach_get("co", places)
        key.data.foreach_set("co", places - offset.ravel())
    mesh.vertices.foreach_set("co", rest.ravel())
    forget_pose(mesh)
    mesh.update()


def forget_pose(mesh):
    for name in (REST, POSED, NUMBER, NUMBER + SCRAMBLED, HELD, HELD + SCRAMBLED):
        if name in mesh.attributes:
            mesh.attributes.remove(mesh.attributes[name])


def scrambled(numbers):
    """24 bits of each number (MurmurHash3's end): the mean of two is that of no number between."""
    out = numbers.astype(np.uint32)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35), (16, 1)):
        out = (out ^ (out >> np.uint32(shift))) * np.uint32(factor)
    return (out >> np.uint32(8)).astype(np.int32)


def keep_numbers(mesh, name, numbers):
    for layer_name, values in ((name, numbers), (name + SCRAMBLED, scrambled(numbers))):
        layer = mesh.attributes.get(layer_name) or mesh.attributes.new(layer_name, "INT", "POINT")
        layer.data.foreach_set("value", values)


def kept_numbers(mesh, name, error=0):
    """Numbers of the vertices, 0 where they are a mean of several; None where the mesh has none of that name."""
    found = []
    for layer_name in (name, name + SCRAMBLED):
        if layer_name in mesh.attributes and len(mesh.attributes[layer_name].data) == len(mesh.vertices):
            found.append(np.empty(len(mesh.vertices), np.int32))
            mesh.attributes[layer_name].data.foreach_get("value", found[-1])
    if len(found) == 2:  # a file of before has no scrambled ones
        found[0][abs(found[1] - scrambled(np.maximum(found[0], 0))) > error] = 0
    return found[0] if found else None


def number_vertices(mesh):
    """Gives each vertex its number, so that vertices are known again after an edit."""
    keep_numbers(mesh, NUMBER, np.arange(1, len(mesh.vertices) + 1, dtype=np.int32))


def numbers_of(mesh):
    """The number that each vertex had when the mesh was bound, -1 for a new one; None for a mesh that was never bound."""
    numbers = kept_numbers(mesh, NUMBER)
    return None if numbers is None else numbers - 1


def keep_regions(mesh, regions):
    """Writes which region has each vertex, so that a new vertex between vertices of one region is known after an edit."""
    held = np.zeros(len(mesh.vertices), np.int32)
    for number, vertices in enumerate(regions, 1):
        held[np.asarray(vertices, np.int64)] = number
    keep_numbers(mesh, HELD, held)


def regions_of(mesh):
    """The number of the region that has each vertex, from 1; 0 outside and between two."""
    held = kept_numbers(mesh, HELD, MEAN_ERROR)
    return np.zeros(len(mesh.vertices), np.int32) if held is None else held


def take_edit(mesh, rest):
    """Makes an edit part of a bound mesh: its rest shape, and the numbers of its vertices."""
    if REST in mesh.attributes:
        keep_vectors(mesh, REST, rest)
        keep_vectors(mesh, POSED, positions_of(mesh))
    number_vertices(mesh)


def column(collection, name, count=1):
    out = np.empty(count * len(collection), np.uint32)  # Blender's own type: others go through Python objects
    collection.foreach_get(name, out)
    return out


def faces_of(mesh):
    """The faces as Blender stores them: first loop and number of loops of each polygon, vertex of each loop."""
    return (column(mesh.polygons, "loop_start"), column(mesh.polygons, "loop_total"),
            column(mesh.loops, "vertex_index"))


def on_surface(mesh):
    """A mask of the vertices that a face has. The others are no part of the surface."""
    out = np.zeros(len(mesh.vertices), bool)
    out[faces_of(mesh)[2]] = True
    return out


def groups_vertices(obj, names, least=0.5):
    """Vertices on the surface of each vertex group with at least that weight, in one pass over the mesh."""
    found = {}
    for name in names:
        group = obj.vertex_groups.get(name)
        if group is None:
            raise hf.InvalidArgumentError(f"{obj.name} has no vertex group '{name}'")
        found[group.index] = []
    lists = {index: vertices.append for index, vertices in found.items()}
    shown = on_surface(obj.data)
    for number, vertex in enumerate(obj.data.vertices):
        for g in vertex.groups if shown[number] else ():
            add = lists.get(g.group)
            if add and g.weight >= least:
                add(number)
    return list(found.values())


def group_vertices(obj, name, least=0.5):
    return groups_vertices(obj, [name], least)[0]


def places_of(positions):
    """A number for each place: vertices at one place, as along a seam, have the same."""
    order = np.lexsort(positions.T)
    there = positions[order]
    out = np.empty(len(positions), np.int64)
    out[order] = np.cumsum(np.concatenate([[False], (there[1:] != there[:-1]).any(1)])[:len(positions)])
    return out


def group_weights(obj, name):
    """The weight of every vertex in a vertex group, 0 outside."""
    group = obj.vertex_groups.get(name)
    if group is None:
        raise hf.InvalidArgumentError(f"{obj.name} has no vertex group '{name}'")
    out, index = np.zeros(len(obj.data.vertices)), group.index
    for number, vertex in enumerate(obj.data.vertices):
        for g in vertex.groups:
            if g.group == index:
                out[number] = g.weight
    wrong = np.flatnonzero(~np.isfinite(out))
    if len(wrong):
        raise hf.NonFiniteError(f"the weight of vertex {wrong[0]} in {name} is {out[wrong[0]]}; paint it again", index=int(wrong[0]))
    return out


def connected(mesh, start, inside):
    """The vertices of a mask that edges inside it connect with a vertex."""
    edges = column(mesh.edges, "vertices", 2).reshape(-1, 2)
    edges = edges[inside[edges].all(1)]
    reached = np.zeros(len(mesh.vertices), bool)
    reached[start] = True
    while True:
        beside = edges[reached[edges].any(1)].ravel()
        if reached[beside].all():
            return np.flatnonzero(reached).tolist()
        reached[beside] = True


def selected_vertices(obj):
    picked = np.empty(len(obj.data.vertices), bool)
    obj.data.vertices.foreach_get("select", picked)
    return np.flatnonzero(picked & on_surface(obj.data)).tolist()


def write_group(obj, name, values):
    """A field as a vertex group, weights clamped to 0..1."""
    group = obj.vertex_groups.get(name) or obj.vertex_groups.new(name=name)
    levels = np.clip(np.round(np.asarray(values) * 1024).astype(int), 0, 1024)  # one call per level, not per vertex
    order = np.argsort(levels, kind="stable")
    for part in np.split(order, np.flatnonzero(np.diff(levels[order])) + 1):
        group.add(part.tolist(), float(levels[part[0]]) / 1024, "REPLACE")
    return group


def write_colour(obj, name, values, strips=12):
    """A field as a colour attribute in strips, orange at 1 and blue at 0."""
    mesh = obj.data
    attribute = mesh.color_attributes.get(name) or mesh.color_attributes.new(name, "FLOAT_COLOR", "POINT")
    t = np.clip(np.asarray(values, np.float32), 0, 1)[:, None]
    colour = (1 - t) * np.array([0.05, 0.16, 0.6]) + t * np.array([0.9, 0.35, 0.04])
    colour = np.where(np.floor(t * strips) % 2 == 1, 0.45 * colour + 0.55, colour)
    attribute.data.foreach_set("color", np.hstack([colour, np.ones_like(t)]).astype(np.float32).ravel())
    mesh.color_attributes.active_color = attribute
    return attribute


def weights_of(obj):
    """The vertex groups as columns: (vertices, groups)."""
    weights = np.zeros((len(obj.data.vertices), len(obj.vertex_groups)))
    for number, vertex in enumerate(obj.data.vertices):
        for g in vertex.groups:
            weights[number, g.group] = g.weight
    return weights


def sharp_edges(mesh):
    """The two vertices of every edge that is marked as sharp."""
    sharp = np.empty(len(mesh.edges), bool)
    mesh.edges.foreach_get("use_edge_sharp", sharp)
    return column(mesh.edges, "vertices", 2).reshape(-1, 2)[sharp]


def guides_of(obj, curves, surface, step, graph=None):
    """Places along curves, one each step: the nearest vertices, and vectors along the curves, in the space of the mesh.
    graph: the evaluated scene; in a handler of its updates the one that the handler got."""
    graph, vertices, vectors = graph or bpy.context.evaluated_depsgraph_get(), [], []
    for curve in curves:
        line = curve.evaluated_get(graph)
        mesh = line.to_mesh()
        if mesh is None:  # nothing is drawn yet
            continue
        edges, points, solid = column(mesh.edges, "vertices", 2).reshape(-1, 2), positions_of(mesh), len(mesh.polygons)
        line.to_mesh_clear()
        if solid:
            raise hf.InvalidArgumentError(f"{curve.name} has faces; a stroke is a curve without bevel or fill")
        into = np.array(obj.matrix_world.inverted_safe() @ curve.matrix_world)
        starts, ends = (points @ into[:3, :3].T + into[:3, 3])[edges.T]
        along = np.cumsum(np.linalg.norm(ends - starts, axis=1))
        if not len(along) or not along[-1] > 0:
            continue
        count = math.ceil(along[-1] / step)
        for place in (np.arange(count) + 0.5) * along[-1] / count:
            edge = np.searchsorted(along, place)
            vector = ends[edge] - starts[edge]
            point = ends[edge] - vector * (along[edge] - place) / np.linalg.norm(vector)
            vertices.append(surface.find_vertex(point)[0])
            vectors.append(vector)
    return vertices, np.array(vectors).reshape(-1, 3)


def quads_object(obj):
    """A new object beside this one, with its materials and without a mesh yet."""
    mesh = bpy.data.meshes.new(f"{obj.data.name} quads")
    for material in obj.data.materials:
        mesh.materials.append(material)
    made = bpy.data.objects.new(f"{obj.name} quads", mesh)
    for collection in obj.users_collection:
        collection.objects.link(made)
    made.matrix_world = obj.matrix_world
    return made


def write_quads(mesh, quads):
    """A quad mesh (hf.QuadsMesh) in place of what a mesh holds. Materials stay, and shading where all faces share it."""
    first = mesh.polygons[0] if len(mesh.polygons) else None
    smooth, material = (first.use_smooth, first.material_index) if first else (False, 0)
    count = len(quads.faces)
    mesh.clear_geometry()
    mesh.vertices.add(len(quads.positions))
    mesh.vertices.foreach_set("co", quads.positions.astype(np.float32).ravel())
    mesh.loops.add(4 * count)
    mesh.loops.foreach_set("vertex_index", quads.faces.astype(np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, 4 * count, 4, dtype=np.int32))
    if bpy.app.version < (3, 6, 0):  # later versions take it from the starts
        mesh.polygons.foreach_set("loop_total", np.full(count, 4, np.int32))
    if smooth:
        mesh.polygons.foreach_set("use_smooth", np.ones(count, bool))
    if material:
        mesh.polygons.foreach_set("material_index", np.full(count, material, np.int32))
    mesh.update(calc_edges=True)


def carry_groups(obj, made, quads):
    """The vertex groups of a mesh on its quads."""
    if not obj.vertex_groups:
        return
    inside = quads.corners < len(obj.data.vertices)  # a corner that does not count is NO_INDEX
    corners = np.where(inside, quads.corners, 0)
    weights = np.einsum("vk,vkg->vg", np.where(inside, quads.barycentrics, 0), weights_of(obj)[corners])
    for group, column_of in zip(obj.vertex_groups, weights.T):
        write_group(made, group.name, column_of)
