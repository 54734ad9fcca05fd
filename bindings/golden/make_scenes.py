"""Writes meshes/*.json, scenes.json and bad_input.json (see README.md). Needs numpy and the Python package.

Fields come from an oracle: the cotangent Laplacian K as a dense matrix, K u = W lambda, W' u + lambda / alpha = s, solved by
numpy. Poses and transfers are checked by rigid motions where those are exact; elsewhere the languages only have to agree with
the C++ run on the same library ("agree").
"""

import json
import math
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "tests" / "bindings"), str(HERE.parent / "python")]
import golden  # noqa: E402
import hf  # noqa: E402
from bad_scenes import bad_scenes  # noqa: E402
from oracle import (agree, cast_ray, edited, expect, expect_all, expect_rows, field, graph_field, inside_polygon, rotation,  # noqa: E402
                    straight_path)
from shapes import bar, pair, strip, torus  # noqa: E402


def write_meshes():
    small = ([(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (2, 0, 0), (2, 1, 0)], [(0, 2, 1), (1, 2, 3), (2, 4, 3),
        (3, 4, 5)])
    lonely = (small[0] + [(9, 9, 9)], small[1])
    meshes = {"strip": strip(), "torus": torus(), "bar": bar(6, 0.5, 25, 12), "long_bar": bar(9, 0.9, 31, 14),
        "small": small, "lonely": lonely, "pair": pair(5)}
    (HERE / "meshes").mkdir(exist_ok=True)
    for name, (points, triangles) in meshes.items():
        text = {"positions": [round(float(x), 4) + 0.0 for p in points for x in p],
            "triangles": [int(i) for t in triangles for i in t]}
        (HERE / "meshes" / f"{name}.json").write_text(json.dumps(text, separators=(",", ":")) + "\n")


def scenes(meshes):
    found = []

    def scene(name, about, *steps):
        found.append({"name": name, "about": about, "steps": list(steps)})

    # the oracle has plain cotangents; the bars only have to agree, on the default operator
    plain = lambda mesh: {"operator_kind": hf.constants.HF_OPERATOR_COTANGENT} if mesh in ("strip", "torus") else {}
    surface = lambda mesh, name="m", **options: {"do": "surface", "as": name, "mesh": mesh,
        "options": {**plain(mesh), **options}}
    solver = lambda name="s", on="m", **options: {"do": "solver", "as": name, "on": on, "options": options}
    sites = lambda vertices, values, **more: {"do": "add_sites", "on": "s", "vertices": vertices, "values": values,
        **more}
    solve = lambda array, **more: {"do": "solve", "on": "s", "expect": expect(array), **more}

    mesh = meshes["strip"]
    x = np.array(mesh["positions"]).reshape(-1, 3)[:, 0]
    ends = [int(v) for v in np.flatnonzero((x == 0) | (x == 6))]
    scene("linear", "Hard sites on two opposite sides of a flat strip: the field is x, exactly (closed form).",
        surface("strip"), solver(),
          {"do": "report", "on": "m", "expect": {"component_count": 1, "boundary_edge_count": 32, "vertex_count": 65}},
          sites(ends, [float(x[v]) for v in ends]), solve(x), {"do": "solve_at", "on": "s", "vertices": [20, 33],
              "expect": expect(x[[20, 33]])},
          {"do": "solve_f32", "on": "s", "expect": {**expect(x), "tolerance": 1e-6}})

    mesh = meshes["torus"]
    vertices, values = [0, 50, 100, 200, 287], [1.0, -1.0, 0.5, 2.0, 0.0]
    scene("torus_field", "Five sites on a torus (oracle); a preview with two corrections agrees.", surface("torus"), solver(),
          sites(vertices, values, numbers=[0, 1, 2, 3, 4]), solve(field(mesh, vertices, values)),
          {"do": "preview", "on": "s", "correction_count": 2, "expect": expect(field(mesh, vertices, values))},
          {"do": "statistics", "on": "s", "expect": {"factorisation_count": 0, "site_count": 5}},
          {"do": "certify", "on": "s", "expect": {"residual": 0, "site_error": 0, "overshoot_checked": 0,
              "tolerance": 1e-9}},
          {"do": "certify", "on": "s", "tolerance": 1e-300, "error": "HF_ERROR_INACCURATE"},
          {"do": "certify", "on": "s", "tolerance": "nan", "error": "HF_ERROR_INVALID_ARGUMENT"})

    scene("edits",
        "Insert, remove, move, set and a batch of all; each field against the oracle, no factorisation after the surface.", surface("torus"), solver(),
          sites([0, 50, 100], [1.0, -1.0, 0.5]), {"do": "remove_sites", "on": "s", "sites": [1]},
          solve(field(mesh, [0, 100], [1, 0.5])),
          {"do": "move_sites", "on": "s", "sites": [2], "vertices": [150]}, solve(field(mesh, [0, 150], [1, 0.5])),
          {"do": "set_values", "on": "s", "sites": [0, 2], "values": [3.0, -2.0]}, solve(field(mesh, [0, 150],
              [3, -2])),
          {"do": "edit", "on": "s", "remove": [0], "move": [2], "move_to": [151], "set": [2], "set_values": [7.0],
              "add": [10, 20, 30], "add_values": [1.0, 2.0, 3.0]},
          solve(field(mesh, [151, 10, 20, 30], [7, 1, 2, 3])), {"do": "statistics", "on": "s",
              "expect": {"factorisation_count": 0, "site_count": 4}})

    scene("undo_redo", "Record, edit, undo, redo: the same bits come back.", surface("torus"), solver(),
        sites([0, 144], [0.0, 1.0]),
          solve(field(mesh, [0, 144], [0, 1]), keep="before"), {"do": "record", "on": "s"}, sites([70, 80, 90],
              [5.0, 5.0, 5.0]),
          solve(field(mesh, [0, 144, 70, 80, 90], [0, 1, 5, 5, 5]), keep="after"), {"do": "undo", "on": "s"},
          {"do": "solve", "on": "s", "same_as": "before"}, {"do": "redo", "on": "s"}, {"do": "solve", "on": "s",
              "same_as": "after"},
          {"do": "undo", "on": "s"}, {"do": "solve", "on": "s", "same_as": "before"}, {"do": "undo", "on": "s",
              "error": "HF_ERROR_EMPTY"})

    scene("clone", "A clone edits on its own; the original keeps its bits and may go first.", surface("torus"), solver(),
        sites([0, 144], [0.0, 1.0]),
          {"do": "solve", "on": "s", "keep": "original"}, {"do": "clone", "on": "s", "as": "c"},
          {"do": "add_sites", "on": "c", "vertices": [30], "values": [4.0]}, {"do": "solve", "on": "s",
              "same_as": "original"},
          {"do": "dispose", "on": "s"}, {"do": "dispose", "on": "s"},
          {"do": "solve", "on": "c", "expect": expect(field(mesh, [0, 144, 30], [0, 1, 4]))}, {"do": "solve",
              "on": "s", "error": "HF_ERROR_INVALID_OBJECT"})

    scene("saved_factor", "A factor saved and loaded gives the same bits; damage and a foreign mesh are refused.",
          surface("torus"), solver(), sites([0, 144], [0.0, 1.0]), {"do": "solve", "on": "s", "keep": "made"},
          {"do": "save", "on": "m", "as": "f"}, {**surface("torus", "n"), "factor": "f"},
          {"do": "surface_statistics", "on": "m", "expect": {"factor_loaded": 0}},
          {"do": "surface_statistics", "on": "n", "expect": {"factor_loaded": 1}}, solver("t", "n"),
          {"do": "add_sites", "on": "t", "vertices": [0, 144], "values": [0.0, 1.0]},
          {"do": "solve", "on": "t", "same_as": "made"},
          {**surface("bar", "u"), "factor": "f", "error": "HF_ERROR_INVALID_ARGUMENT"},
          {**surface("torus", "u"), "factor": "f", "damage": 300, "error": "HF_ERROR_INVALID_ARGUMENT"})

    t0, t1 = (mesh["triangles"][3 * t:3 * t + 3] for t in (10, 300))
    weights = [[0.2, 0.3, 0.5], [0.5, 0.25, 0.25]]
    rows = [dict(zip(t0, weights[0])), dict(zip(t1, weights[1])), 60, 230]
    scene("soft_inside", "Sites inside triangles and soft sites on vertices (oracle).", surface("torus"), solver(),
          {"do": "add_sites", "on": "s", "places": [*t0, *weights[0], *t1, *weights[1]],
              "values": [1.0, -1.0]},
          sites([60, 230], [0.5, 2.0], stiffness=[2.0, 100.0]), solve(field(mesh, rows, [1, -1, 0.5, 2],
              [0, 0, 2, 100])))

    p = np.array(mesh["positions"]).reshape(-1, 3)
    height = [float(v) for v in p[:, 0]]
    scene("analysis",
        "The field x on a torus has a minimum, a maximum and two saddles; its iso-lines lie at their levels (closed forms); distances and tips (agreement).",
          surface("torus"), {"do": "critical", "on": "m", "field": height, "expect": {"count": 4, "sum": 0, "min": -1,
              "max": 1}},
          {"do": "levels", "on": "m", "field": height, "count": 3, "spacing": "HF_LEVELS_VALUE",
              "expect": expect(np.array([-2.0, 0.0, 2.0]))},
          {"do": "levels", "on": "m", "field": height, "count": 3, "spacing": "HF_LEVELS_AREA", "expect": agree()},
          {"do": "isolines", "on": "m", "field": height, "levels": [0.1, 3.0], "lines": 3, "closed": 3,
              "expect": agree()},
          {"do": "geodesics", "on": "m", "as": "g"}, {"do": "distance", "on": "g", "sources": [0, 100],
              "expect": agree()},
          *[step for method in (1, 2, 3) for step in (
              {"do": "geodesics", "on": "m", "as": f"g{method}", "options": {"method": method}},
              {"do": "distance", "on": f"g{method}", "sources": [0, 100], "expect": agree()})],
          surface("bar", "b"), {"do": "extremities", "on": "b", "expect": agree(0)},
          {"do": "propose", "on": "b", "expect": agree(0)},
          {"do": "direction", "on": "m", "as": "d", "options": {"degree": 4}},
          {"do": "add_vectors", "on": "d", "vertices": [0], "vectors": [0.0, 1.0, 0.0], "numbers": [0]},
          {"do": "singularities", "on": "d", "expect": {"sum": 0, "tolerance": 1e-9}}, {"do": "directions", "on": "d",
              "expect": agree()})

    on_d, on_c = {"on": "d"}, {"on": "c"}
    scene("directions",
        "Crosses on a torus: constraints are added, moved, turned and removed; the undo stack and a clone give the bits back. Indices sum to "
          "degree times the Euler characteristic, 0 (closed form).", surface("torus"), {"do": "direction", "on": "m",
              "as": "d", "options": {"degree": 4}},
          {"do": "undo_vectors", "error": "HF_ERROR_EMPTY", **on_d},
          {"do": "add_vectors", "vertices": [0, 150], "vectors": [0.0, 1.0, 0.0, 0.0, 0.0, 1.0], "numbers": [0, 1],
              **on_d},
          {"do": "directions", "keep": "first", "expect": agree(), **on_d}, {"do": "vectors", "keep": "given",
              "expect": {"count": 6}, **on_d},
          {"do": "clone_vectors", "as": "c", **on_d}, {"do": "record_vectors", **on_d}, {"do": "move_vectors",
              "sites": [1], "vertices": [160], **on_d},
          {"do": "directions", "expect": agree(), **on_d}, {"do": "set_vectors", "sites": [0],
              "vectors": [0.0, 2.0, 0.0], **on_d},
          {"do": "rotate", "sites": [1], "angles": [0.5], **on_d}, {"do": "directions", "keep": "second",
              "expect": agree(), **on_d},
          {"do": "singularities", "expect": {"sum": 0, "tolerance": 1e-9}, **on_d}, {"do": "remove_vectors",
              "sites": [0], **on_d},
          {"do": "vectors", "expect": {"count": 3}, **on_d}, {"do": "undo_vectors", **on_d}, {"do": "directions",
              "same_as": "first", **on_d},
          {"do": "vectors", "same_as": "given", **on_d}, {"do": "dispose", **on_d}, {"do": "directions",
              "same_as": "first", **on_c})

    scene("quads_and_flow",
        "A torus as quads: Euler characteristic 0 and about as many as wanted (closed forms); streamlines of a field between two sites, eight "
          "of equal flux and two through given vertices (agreement).", surface("torus"), solver(), sites([0, 150],
              [0.0, 1.0]), {"do": "solve", "on": "s", "keep": "u"},
          {"do": "flow", "on": "m", "as": "w"}, {"do": "streamlines", "on": "w", "field": "u", "count": 8, "lines": 8,
              "expect": agree(1e-6)},
          {"do": "streamlines", "on": "w", "field": "u", "seeds": [70, 200], "lines": 2, "expect": agree(1e-6)},
          {"do": "quads", "on": "m", "as": "q", "edge_length": 0.8}, {"do": "quads_info", "on": "q",
              "expect": {"euler_characteristic": 0}},
          {"do": "quad_mesh", "on": "q", "expect": {"min": -4.0, "max": 4.0, "tolerance": 0.2}},
          {"do": "quads", "on": "m", "as": "c", "options": {"face_count": 200, "crease_angle": 1.75}},
          {"do": "quads_info", "on": "c", "expect": {"euler_characteristic": 0}},
          {"do": "quads_info", "on": "c", "expect": {"face_count": 200, "tolerance": 10}},
          {"do": "dispose", "on": "m"}, {"do": "streamlines", "on": "w", "field": "u", "count": 8, "lines": 8,
              "expect": {"min": -4.0, "max": 4.0, "tolerance": 4.0}})

    wanted = {"do": "quads", "on": "m", "options": {"face_count": 200}}
    seam = [v for j in range(12) for v in (72 + j, 72 + (j + 1) % 12)]  # around the tube, where x is 0
    turned = {"guide_vertices": [24, 120], "guide_vectors": [-1.0, 2.0, 2.0, -1.0, -2.0, 2.0]}
    # WebAssembly's quads differ from the native ones by 1e-6, and relaxation makes 0.024 of it in "g"
    whole = {"euler_characteristic": 0}
    scene("guided_quads",
        "Quads of a torus that follow two guides, keep a ring of edges and are their own mirror image: Euler characteristic 0 "
          "(closed form); positions by agreement.", surface("torus"),
          *[step for name, more in (("e", {"crease_edges": seam}), ("g", turned),
              ("w", {**turned, "guide_weights": [1.0, 0.25]}),
              ("q", {**turned, "guide_weights": [0.5, 1.0], "crease_edges": seam, "symmetry_plane": [0.0, 1.0, 0.0, 0.0]}))
            for step in ({**wanted, **more, "as": name}, {"do": "quads_info", "on": name, "expect": whole},
              {"do": "quad_mesh", "on": name, "expect": agree(0.03 if name == "g" else 1e-3)})],
          surface("strip", "b"), {**wanted, "on": "b", "as": "s", "symmetry_plane": [-2.0, 0.0, 0.0, -6.0]},
          {"do": "quads_info", "on": "s", "expect": {"euler_characteristic": 1}},
          {"do": "quad_mesh", "on": "s", "expect": {"min": 0.0, "max": 6.0, "tolerance": 1e-6}},
          {"do": "quad_mesh", "on": "s", "expect": agree(1e-5)})

    mirrored = {"symmetry_plane": [0.0, 1.0, 0.0, 0.0]}
    update, quads_of = {**wanted, "do": "update_quads", "on": "u"}, lambda **more: {**wanted, **more}
    mesh_of = lambda name, **more: {"do": "quad_mesh", "on": name, **more}
    dragged = {"face_count": 200, "relax_count": hf.NO_INDEX}
    scene("updated_quads",
        "Quads that are made again with guides and with a plane of symmetry are those that are made anew, bit for bit. A wrong call leaves "
          "them as they are. While the user drags they are not relaxed (agreement).", surface("torus"),
          quads_of(**{"as": "p"}), mesh_of("p", keep="plain"), quads_of(**turned, **{"as": "g"}), mesh_of("g", keep="guided"),
          quads_of(**mirrored, **{"as": "s"}), mesh_of("s", keep="mirrored"),
          quads_of(crease_edges=seam, **{"as": "e"}), mesh_of("e", keep="creased"),
          quads_of(**{"as": "u"}), mesh_of("u", same_as="plain"),
          {**update, **turned, "options": dragged, "expect": agree(1e-3)}, {**update, **turned, "same_as": "guided"},
          {"do": "quads_info", "on": "u", "expect": whole}, {**update, **mirrored, "same_as": "mirrored"},
          {**update, **mirrored, "expect": agree(1e-3)}, {"do": "quads_info", "on": "u", "expect": whole},
          {**update, "crease_edges": [0, 144], "error": "HF_ERROR_INVALID_ARGUMENT", "index": 0},
          {**update, "crease_edges": seam, "same_as": "creased"},
          {"do": "dispose", "on": "m"}, {**update, "same_as": "plain"}, mesh_of("u", same_as="plain"), mesh_of("g", same_as="guided"))

    poles = {"irregular_points": [-2.2, 2.2, 1.0, 3.2, 2.2, 0.0], "irregular_valences": [3, 5]}
    turned_poles = {**poles, "irregular_directions": [0.0, 1.0, 0.0, 1.0, -1.0, 2.0]}
    scene("quads_with_poles",
        "Quads of a torus with a pole of 3 and a pole of 5 that the user places, turns and drags: Euler characteristic 0 (closed form); "
          "positions by agreement.", surface("torus"),
          *[step for name, more in (("p", poles), ("t", turned_poles), ("s", {**turned_poles, **mirrored}))
            for step in ({**wanted, **more, "as": name}, {"do": "quads_info", "on": name, "expect": whole},
              {"do": "quad_mesh", "on": name, "expect": agree(1e-3), "keep": name})],
          quads_of(**{"as": "u"}), mesh_of("u", keep="plain"), {**update, **turned_poles, "options": dragged, "expect": agree(1e-3)},
          {**update, **poles, "same_as": "p"}, {**update, **turned_poles, **mirrored, "same_as": "s"},
          {**update, **poles, "irregular_valences": [3, 4], "error": "HF_ERROR_INVALID_ARGUMENT", "index": 1}, mesh_of("u", same_as="s"),
          {**update, **turned_poles, "same_as": "t"}, {**update, "same_as": "plain"})

    on_r, patch = {"on": "r"}, [0, 1, 2, 12, 13, 14]
    scene("regions",
        "A patch of a torus: edited, morphed (0 gives the given positions back, bit for bit), undone; onto itself its detail gives the "
          "surface back (closed forms), doubled it is exaggerated (agreement).", surface("torus"),
          {"do": "region", "on": "m", "as": "r", "positions": mesh["positions"]}, {"do": "region_edit", "add": patch,
              **on_r},
          {"do": "region_vertices", "expect": expect(np.array(patch), 0), **on_r}, {"do": "record_region", **on_r},
          {"do": "region_edit", "rings": 2, "remove": [0], **on_r}, {"do": "region_vertices", "keep": "grown",
              "expect": agree(0), **on_r},
          {"do": "morph", "weight": 0.0, "expect": expect(np.array(mesh["positions"]), 0), **on_r}, {"do": "morph",
              "weight": 1.0, "expect": agree(), **on_r},
          {"do": "region_info", "expect": {"field_kind": hf.constants.HF_FIELD_BIHARMONIC}, **on_r},
          {"do": "undo_region", **on_r},
          {"do": "region_vertices", "expect": expect(np.array(patch), 0), **on_r}, {"do": "redo_region", **on_r},
          {"do": "region_vertices", "same_as": "grown", **on_r},
          {"do": "region_edit", "curve": [0, 1, 2, 3, 15, 27, 39, 38, 37, 36, 24, 12],
              **on_r}, {"do": "region_vertices", "expect": agree(0), **on_r},
          {"do": "detail", "as": "x", "source": "r", "target": "r"}, {"do": "morph", "on": "x", "weight": 1.0,
              "expect": expect(np.array(mesh["positions"]), 1e-6)},
          {"do": "morph", "on": "x", "weight": 2.0, "expect": agree(1e-6)})

    mesh = meshes["bar"]
    p = np.array(mesh["positions"]).reshape(-1, 3)
    low = [int(v) for v in np.flatnonzero(p[:, 2] <= 0.8)]
    high = [int(v) for v in np.flatnonzero(p[:, 2] >= 5.2)]
    middle = [int(v) for v in np.flatnonzero(np.abs(p[:, 2] - 3) < 0.3)]
    turn = [0.0, math.sin(math.radians(30)), 0.0, math.cos(math.radians(30))]
    about = lambda q, c, points: (points - c) @ rotation(q).T + c
    both = p @ rotation(turn).T + [1, 2, 3]
    shift = lambda region: (rotation(turn) @ p[region].mean(0) + [1, 2, 3] - p[region].mean(0)).tolist()
    pose = lambda **more: {"on": "p", **more}
    scene("pose",
        "Two handles on a bar: rest, a rigid motion of the whole (closed forms), a bend, a third handle added in mid-pose and removed (agreement; the bits return).",
          surface("bar"), {"do": "pose", "on": "m", "as": "p"}, pose(do="deform", error="HF_ERROR_EMPTY"),
          pose(do="add_handles", regions=[low, high], numbers=[0, 1]), pose(do="deform", expect=expect(p)),
          pose(do="set_transforms", handles=[0, 1], rotations=turn + turn,
              translations=shift(low) + shift(high)), pose(do="deform", expect=expect(both, 1e-8)),
          pose(do="set_transforms", handles=[0, 1], rotations=[0, 0, 0, 1] + turn, translations=[0, 0, 0, 1, 0, 0]),
          pose(do="deform", options={"restart": 1, "iteration_count": 20}, keep="bent",
              expect={**expect_rows(about(turn, p[high].mean(0), p[high]) + [1, 0, 0], high)}),
          pose(do="deform", options={"restart": 1, "iteration_count": 20}, same_as="bent", expect=agree()),
          pose(do="deform", options={"refine": 2, "refine_from_last": 1}, expect=agree()),
          pose(do="handle_field", handle=1, expect=agree(2e-6)), pose(do="skin", influence_count=4, expect=agree(2e-6)),
          pose(do="add_handles", regions=[middle], layer=1, numbers=[2]), pose(do="handle_info", handle=2,
              expect={"layer": 1}),
          pose(do="set_transforms", handles=[2], translations=[0.0, 0.7, 0.0]), pose(do="deform", expect=agree()),
          pose(do="remove_handles", handles=[2]), pose(do="deform", options={"restart": 1, "iteration_count": 20},
              same_as="bent"))
    stands = [*turn, *shift(middle)]
    bend = pose(do="set_transforms", handles=[0, 1], rotations=[0, 0, 0, 1] + turn, translations=[0, 0, 0, 1, 0, 0])
    scene("handles_in_place",
        "A handle is added where a bar stands that moved rigidly (closed forms), and one where it is bent (agreement). They move then.",
          surface("bar"), {"do": "pose", "on": "m", "as": "p"}, pose(do="add_handles", regions=[low, high]),
          pose(do="set_transforms", handles=[0, 1], rotations=turn + turn, translations=shift(low) + shift(high)),
          pose(do="deform", expect=expect(both, 1e-8)),
          pose(do="add_handles", regions=[middle], in_place=1, numbers=[2]),
          pose(do="handle_place", handle=2, expect=expect(np.array(stands), 1e-8)),
          pose(do="deform", expect=expect(both, 1e-8)),
          pose(do="set_transform", handle=2, rotation=turn, translation=[x + 0.5 for x in stands[4:]]),
          pose(do="deform", expect=expect_rows(both[middle] + 0.5, middle)), pose(do="deform", expect=agree()),
          pose(do="remove_handles", handles=[2]), bend, pose(do="deform", options={"iteration_count": 100}, expect=agree()),
          pose(do="add_handles", points=p[middle[0]].tolist(), radii=[0.6], in_place=1, numbers=[2]),
          pose(do="handle_place", handle=2, expect=agree()), pose(do="deform", expect=agree()),
          pose(do="set_transform", handle=2, translation=[0.5, 0.0, 0.0]), pose(do="deform", expect=agree()))

    q = np.array(meshes["long_bar"]["positions"]).reshape(-1, 3)
    ends = lambda points, length: [[int(v) for v in np.flatnonzero(points[:, 2] <= 0.13 * length)],
        [int(v) for v in np.flatnonzero(points[:, 2] >= 0.87 * length)]]
    patch = lambda points, length: [int(v)
        for v in np.flatnonzero((np.abs(points[:, 2] / length - 0.5) < 0.06) & (points[:, 0] > 0.05 * length))]
    scene("transfer", "A bend of one bar played on a longer, thicker one (agreement); rest stays rest.", surface("bar"),
        surface("long_bar", "t"),
          {"do": "pose", "on": "m", "as": "p"}, pose(do="add_handles", regions=ends(p, 6)),
          pose(do="set_transforms", handles=[0, 1], rotations=[0, 0, 0, 1] + turn, translations=[0, 0, 0, 1, 0, 0]),
          pose(do="deform", options={"restart": 1, "iteration_count": 20}, keep="bent"),
          {"do": "transfer", "as": "x", "source": "m", "target": "t", "options": {"scale": 1.5}},
          {"do": "add_pairs", "on": "x", "source_regions": [*ends(p, 6), patch(p, 6)], "target_regions": [*ends(q, 9),
              patch(q, 9)], "flags": [1, 0, 0], "numbers": [0, 1, 2]},
          {"do": "transfer_info", "on": "x", "expect": {"pair_count": 3, "scale": 1.5, "tolerance": 1e-6}},
          {"do": "apply", "on": "x", "positions": mesh["positions"], "expect": expect(q, 1e-8)},
          {"do": "apply", "on": "x", "positions": "bent", "expect": agree()},
          {"do": "set_dials", "on": "x", "options": {"stride": 1.5, "hip_height_share": 0.25, "long_follow": 0.5}},
          {"do": "dials", "on": "x", "expect": {"stride": 1.5, "hip_height_share": 0.25, "arm_space": 0,
              "long_follow": 0.5}},
          {"do": "apply", "on": "x", "positions": "bent", "expect": agree()},
          {"do": "set_dials", "on": "x"}, {"do": "dials", "on": "x", "expect": {"stride": 1, "hip_height_share": 0}},
          {"do": "apply", "on": "x", "positions": mesh["positions"], "expect": expect(q, 1e-8)},
          {"do": "remove_pairs", "on": "x", "pairs": [1]}, {"do": "transfer_info", "on": "x",
              "expect": {"pair_count": 2}})

    mesh = meshes["torus"]
    plain_calls(scene, mesh, surface, solver)
    kinds_of_field(scene, mesh, surface, solver)
    picking(scene, mesh, surface)
    paths(scene, meshes["strip"], surface)
    curves(scene, meshes["strip"], surface)
    graphs(scene, solver, solve)
    faces(scene, solver, solve)
    links(scene, surface, solver)
    edits_of_surfaces(scene, meshes["pair"], surface, solver)
    patches_of_surfaces(scene, meshes["pair"], surface, solver)
    cuts_through_triangles(scene, meshes["pair"], surface, solver)
    skin_weights(scene, surface)
    carried_weights(scene, meshes["strip"], surface)
    return found


def plain_calls(scene, mesh, surface, solver):
    """One site, one handle, one transform, the packed deform; 16-bit triangles; what objects were made with."""
    p = np.array(mesh["positions"]).reshape(-1, 3)
    u = expect(field(mesh, [0, 100], [1.0, 0.0]))
    far, near = p[np.argmin(p[:, 0])].tolist(), p[np.argmax(p[:, 0])].tolist()
    scene("plain_calls", "One site, one handle and one transform at a time (oracle, closed form); what objects were made with.",
          surface("torus"), solver(site_limit=9),
          {"do": "add_site", "on": "s", "vertex": 0, "value": 1.0, "numbers": [0]},
          {"do": "add_site", "on": "s", "vertex": 100, "numbers": [1]}, {"do": "solve", "on": "s", "expect": u},
          {"do": "surface_info", "on": "m", "expect": {"vertex_count": 288, "triangle_count": 576, "operator_kind": 3,
              "field_kind": 0, "thread_count": 1, "vertex_limit": 20000000}},
          {"do": "solver_info", "on": "s", "expect": {"site_limit": 9, "site_count": 2, "channel_count": 1,
              "vertex_count": 288, "field_kind": 0}},
          {"do": "components", "on": "m", "expect": expect(np.zeros(288), 0)},
          {"do": "pose", "on": "m", "as": "p"},
          {"do": "add_handle_at", "on": "p", "point": far, "radius": 0.9, "numbers": [0]},
          {"do": "add_handle_at", "on": "p", "point": near, "radius": 0.9, "numbers": [1]},
          {"do": "pose_info", "on": "p", "expect": {"band_count": 10, "iteration_count": 10, "group_count": 250,
              "handle_count": 2, "vertex_count": 288}},
          {"do": "deform_f32", "on": "p", "expect": {**expect(p), "tolerance": 1e-5}},
          {"do": "set_transform", "on": "p", "handle": 0, "rotation": [0.0, 0.0, 0.0, 1.0],
              "translation": [1.0, 2.0, 3.0]},
          {"do": "set_transform", "on": "p", "handle": 1, "translation": [1.0, 2.0, 3.0]},
          {"do": "deform_f32", "on": "p", "expect": {**expect(p + [1, 2, 3]), "tolerance": 1e-5}})
    scene("triangles", "Triangles of 16 and of 32 bits, packed and with a stride, are one surface (the same bits; oracle).",
          surface("torus"), solver(), {"do": "add_sites", "on": "s", "vertices": [0, 100], "values": [1.0, 0.0]},
          {"do": "solve", "on": "s", "keep": "u", "expect": u},
          *[step for bits, stride in ((16, 0), (16, 10), (32, 20)) for step in (
              {**surface("torus"), "index_bits": bits, "triangle_stride": stride}, solver(),
              {"do": "add_sites", "on": "s", "vertices": [0, 100], "values": [1.0, 0.0]},
              {"do": "solve", "on": "s", "same_as": "u"})])


def kinds_of_field(scene, mesh, surface, solver):
    """Solvers, regions and poses of a kind that the surface was not made with."""
    vertices, values = [0, 50, 100, 200, 287], [1.0, -1.0, 0.5, 2.0, 0.0]
    given = {"do": "add_sites", "vertices": vertices, "values": values}
    thin, graph = hf.constants.HF_FIELD_BIHARMONIC, hf.constants.HF_FIELD_BIHARMONIC_GRAPH
    patch, plate = {"do": "region_edit", "add": [0, 1, 2, 12, 13, 14]}, hf.constants.HF_BASE_THIN_PLATE
    turn = {"do": "set_transforms", "handles": [1], "translations": [0.5, 0.0, 0.0]}
    handles = {"do": "add_handles", "regions": [[0, 1, 2], [144, 145, 146]]}
    scene("biharmonic",
        "A bi-harmonic solver and a thin plate on a harmonic surface, beside a harmonic one (oracle); a surface made bi-harmonic gives the "
          "same bits, and its poses use the harmonic factor.", surface("torus"), solver("h"), {**given, "on": "h"},
          solver("g", field_kind=graph), {**given, "on": "g"},
          {"do": "solve", "on": "h", "expect": expect(field(mesh, vertices, values))},
          {"do": "solve", "on": "g", "expect": expect(field(mesh, vertices, values, power=2), 1e-8)},
          {"do": "solver_info", "on": "g", "expect": {"field_kind": graph}},
          {"do": "statistics", "on": "g", "expect": {"factorisation_count": 0, "site_count": 5}},
          solver("b", field_kind=thin), {**given, "on": "b"}, {"do": "solve", "on": "b", "keep": "thin", "expect": agree()},
          {"do": "region", "on": "m", "as": "r", "options": {"base": plate}}, {**patch, "on": "r"},
          {"do": "region_info", "on": "r", "expect": {"field_kind": thin, "vertex_count": 6}},
          {"do": "morph", "on": "r", "weight": 1.0, "keep": "smooth", "expect": agree()},
          {"do": "pose", "on": "m", "as": "p"}, {**handles, "on": "p"}, {**turn, "on": "p"},
          {"do": "deform", "on": "p", "keep": "posed", "expect": agree()},
          surface("torus", "n", field_kind=thin), {"do": "dispose", "on": "m"},
          {"do": "surface_info", "on": "n", "expect": {"field_kind": thin}},
          solver("b", "n", field_kind=thin), {**given, "on": "b"}, {"do": "solve", "on": "b", "same_as": "thin"},
          {"do": "region", "on": "n", "as": "r", "options": {"base": plate}}, {**patch, "on": "r"},
          {"do": "morph", "on": "r", "weight": 1.0, "same_as": "smooth"},
          {"do": "pose", "on": "n", "as": "p"}, {**handles, "on": "p"}, {**turn, "on": "p"},
          {"do": "deform", "on": "p", "same_as": "posed"},
          {"do": "save", "on": "n", "as": "f", "field_kind": thin},
          {**surface("torus", "o", field_kind=thin), "factor": "f"},
          {**surface("torus", "o"), "factor": "f", "error": "HF_ERROR_INVALID_ARGUMENT"})


def faces(scene, solver, solve):
    quads = {"offsets": [0, 4, 8], "corners": [0, 2, 3, 1, 2, 4, 5, 3]}
    given = lambda faces, **more: {"do": "surface", "as": "m", "mesh": "small", "faces": faces, "options": {}, **more}
    mixed = {"offsets": [0, 4, 7, 10], "corners": [0, 2, 3, 1, 2, 4, 3, 3, 4, 5]}
    x = np.array([0.0, 0.0, 0.5, 0.5, 1.0, 1.0])
    calls = [solver(), {"do": "add_sites", "on": "s", "vertices": [0, 1, 4, 5], "values": [0.0, 0.0, 1.0, 1.0]}, solve(x)]
    scene("faces", "Two squares as faces of four corners, and with one of them cut: the field between two ends is x (closed form).",
          given(quads), {"do": "surface_info", "on": "m", "expect": {"face_count": 2, "vertex_count": 6}},
          *calls, given(mixed), {"do": "surface_info", "on": "m", "expect": {"face_count": 3}}, *calls,
          given({**quads, "corners": [0, 2, 3, 1, 2, 4, 9, 3]}, error="HF_ERROR_OUT_OF_RANGE", index=1))


def links(scene, surface, solver):
    sites = {"do": "add_sites", "on": "s", "vertices": [0, 20, 29, 49], "values": [0.0, 0.0, 1.0, 1.0]}
    look = lambda **figures: {"do": "report", "on": "m", "expect": {"vertex_count": 50, **figures}}
    alone = {"do": "add_sites", "on": "s", "vertices": [0], "values": [1.0]}
    zeros = np.repeat([1.0, 0.0], 25)
    scene("links", "Two plates beside each other are one component with links; without, a site on one leaves the other at 0 (closed form).",
          surface("pair", link_pieces=1), look(component_count=1), solver(), sites,
          {"do": "solve", "on": "s", "expect": agree()},
          surface("pair"), look(component_count=2), solver(), alone,
          {"do": "solve", "on": "s", "expect": expect(zeros)},
          surface("pair", link_pieces=1), solver(), alone, {"do": "solve", "on": "s", "expect": expect(np.ones(50))})
    scene("links_tags", "Pieces of different tags stay apart.",
          {**surface("pair", link_pieces=1), "tags": [3] * 25 + [4] * 25}, look(component_count=2), solver(),
          alone, {"do": "solve", "on": "s", "expect": expect(zeros)})


def edits_of_surfaces(scene, mesh, surface, solver):
    rows = [[4, 25, 26, 31, 0.5, 0.25, 0.25, 2.0], [24, 45, 40, 41, 1.0, 0.0, 0.0, 1.0]]
    belt, stiff = [1, 6, 11, 16, 21, 27], [100.0, 100.0, 0.01, 100.0, 100.0, 5.0]
    stiffness, ones = np.ones(50), np.ones(50)
    stiffness[belt] = stiff
    sites, values = [0, 20, 49], [0.0, 1.0, 3.0]
    look = lambda links, s, tolerance=1e-9: {"do": "solve", "on": "s", "expect": expect(
        field(mesh, sites, values, change=lambda matrix: edited(matrix, links, s)), tolerance)}
    edit = lambda on, name, **more: {"do": "edit_surface", "on": on, "as": name, **more}
    move = lambda to, on="s", **more: {"do": "move_to", "on": on, "to": to, **more}
    flat = [x for row in rows for x in row]
    handles = {"do": "add_handles", "on": "p", "regions": [[0, 5, 10, 15, 20], [39, 44, 49]]}
    turn = {"do": "set_transforms", "on": "p", "handles": [0, 1], "rotations": [0, 0, 0, 1, 0, 0, 0.2, 0.98],
        "translations": [0, 0, 0, 0.1, 0.2, 0.1]}
    deform = {"do": "deform", "on": "p", "options": {"restart": 1, "iteration_count": 100}, "expect": agree(1e-6)}
    report = lambda name, count: {"do": "report", "on": name, "expect": {"component_count": count}}
    scene("edited_surfaces", "Stiffness and links come and go while sites and handles stay (dense oracle).",
          surface("pair", operator_kind=hf.constants.HF_OPERATOR_COTANGENT), solver(),
          {"do": "add_sites", "on": "s", "vertices": sites, "values": values}, {"do": "pose", "on": "m", "as": "p"}, handles, turn,
          edit("m", "held", links=flat), report("held", 1), move("held"), look(rows, ones), move("held", "p"), deform,
          edit("held", "stiff", vertices=belt, stiffness=stiff), move("stiff"), look(rows, stiffness), move("stiff", "p"), deform,
          edit("stiff", "one", removed_links=[0]), move("one"), look(rows[1:], stiffness),
          edit("one", "none", removed_links=[0], vertices=belt, stiffness=[1.0] * 6), report("none", 2), move("none"),
          {"do": "components", "on": "none", "expect": expect(np.repeat([0.0, 1.0], 25))},
          edit("none", "e", removed_links=[0], error="HF_ERROR_NOT_FOUND", index=0),
          edit("held", "e", removed_links=[1, 1], error="HF_ERROR_CONFLICT", index=1),
          edit("held", "e", links=flat[:7] + [-1.0], error="HF_ERROR_INVALID_ARGUMENT", index=0),
          edit("held", "e", error="HF_ERROR_EMPTY"),
          surface("strip", "other"), move("other", error="HF_ERROR_CONFLICT"), move("held"), look(rows, ones))


def patches_of_surfaces(scene, mesh, surface, solver):
    """The plates of the scene of links: a triangle becomes three, and a slit opens."""
    points, triangles = [np.array(mesh[key]).reshape(-1, 3) for key in ("positions", "triangles")]
    sites, values = [0, 20, 49], [0.0, 1.0, 3.0]
    edit = lambda on, name, **more: {"do": "edit_surface", "on": on, "as": name, **more}
    move = lambda to: {"do": "move_to", "on": "s", "to": to}
    look = lambda points, triangles: {"do": "solve", "on": "s", "expect": expect(
        field({"positions": points.ravel(), "triangles": triangles.ravel()}, sites, values))}
    report = lambda name, **figures: {"do": "report", "on": name, "expect": figures}
    gone, v = 11, triangles[11]
    fine = np.vstack([points, points[v].mean(0)])
    fan = [[v[0], v[1], 50], [v[1], v[2], 50], [v[2], v[0], 50]]
    three = np.vstack([np.delete(triangles, gone, 0), fan])
    row, edges = [10, 11], [10, 11, 11, 12]  # of the first plate, from its border
    below = [t for t, corners in enumerate(triangles) if corners.max() < 25 and points[corners].mean(0)[1] > points[10][1]]
    cut = triangles.copy()
    corners = []
    for number, vertex in enumerate(row):
        for t in below:
            for k in range(3):
                if triangles[t][k] == vertex:
                    cut[t][k] = 50 + number
                    corners.append([t, k, 50 + number, vertex])
    parted = np.vstack([points, points[row]])
    scene("patched_surfaces", "A triangle becomes three, and a slit opens, while sites stay (dense oracle).",
          surface("pair", operator_kind=hf.constants.HF_OPERATOR_COTANGENT), solver(),
          {"do": "add_sites", "on": "s", "vertices": sites, "values": values}, look(points, triangles),
          edit("m", "fine", removed_triangles=[gone], new_positions=fine[50].tolist(),
               new_triangles=[int(x) for t in fan for x in t]),
          report("fine", vertex_count=51, component_count=2), move("fine"), look(fine, three),
          edit("m", "cut", cut_edges=edges), report("cut", vertex_count=52, component_count=2),
          {"do": "cuts", "on": "cut", "expect": expect(np.array(corners))}, move("cut"), look(parted, cut),
          edit("m", "e", removed_triangles=[gone, gone], error="HF_ERROR_CONFLICT", index=1),
          edit("m", "e", removed_triangles=[4000], error="HF_ERROR_OUT_OF_RANGE", index=0),
          edit("m", "e", cut_edges=[0, 24], error="HF_ERROR_NOT_FOUND", index=0),
          edit("m", "e", cut_edges=[6, 7], error="HF_ERROR_EMPTY"), move("m"), look(points, triangles))


def cuts_through_triangles(scene, mesh, surface, solver):
    """A knife through the first plate of the scene of links: from its border, and back to it."""
    points, triangles = [np.array(mesh[key]).reshape(-1, 3) for key in ("positions", "triangles")]
    t, k = next((t, k) for t, v in enumerate(triangles) for k in range(3)
                if sum(v[k] in w and v[(k + 1) % 3] in w for w in triangles) == 1)
    at = lambda t, *weights: [*(int(x) for x in triangles[t]), *weights]
    start = [0.0, 0.0, 0.0]
    start[k], start[(k + 1) % 3] = 0.55, 0.45
    line = at(t, *start) + at(17, 0.3, 0.5, 0.2) + at(12, 0.25, 0.35, 0.4)
    whole = hf.Surface(points, triangles, operator_kind=hf.constants.HF_OPERATOR_COTANGENT)
    cut = whole.trace_cut(places=[(tuple(int(x) for x in line[i:i + 3]), line[i + 3:i + 6]) for i in range(0, len(line), 6)])
    after = {"positions": np.vstack([points, cut.new_positions]).ravel(),
             "triangles": np.vstack([np.delete(triangles, cut.removed_triangles, 0), cut.new_triangles]).ravel()}
    rim = cut.rim_vertices[len(cut.rim_vertices) // 2].tolist()
    rows = np.hstack([cut.source_triangles[:, None], cut.new_triangles, cut.corner_barycentrics.reshape(-1, 9)])
    cut_by = lambda places, **more: {"do": "cut_surface", "on": "m", "as": "cut", "places": places, **more}
    scene("traced_cuts", "A knife cuts through triangles from the border, and two sites stand on its two sides (dense oracle).",
          surface("pair", operator_kind=hf.constants.HF_OPERATOR_COTANGENT), cut_by(line, expect=expect(rows.ravel())),
          {"do": "report", "on": "cut", "expect": {"vertex_count": len(points) + len(cut.new_positions), "component_count": 2}},
          solver(on="cut"), {"do": "add_sites", "on": "s", "vertices": [*rim, 49], "values": [0.0, 1.0, 3.0]},
          {"do": "solve", "on": "s", "expect": expect(field(after, [*rim, 49], [0.0, 1.0, 3.0]))},
          cut_by(line[:6], error="HF_ERROR_EMPTY", index=1), cut_by(line[:12] + at(40, 0.3, 0.3, 0.4), error="HF_ERROR_NOT_FOUND", index=1),
          cut_by(line + line[6:12], error="HF_ERROR_CONFLICT", index=2))


def skin_weights(scene, surface):
    half = lambda *z: [v for height in z for v in (0.0, 0.0, height)]
    chain = {"heads": half(0.0, 2.0, 4.0), "tails": half(2.0, 4.0, 6.0), "parents": [4294967295, 0, 1]}
    make = lambda name="w", **joints: {"do": "weights", "on": "m", "as": name, **joints, "options": {"influence_count": 4}}
    column = lambda joint, **more: {"do": "skin_weights", "on": "w", "joint": joint, **more}
    near = 24 * 12 + 2  # a vertex of the last ring
    pin = {"do": "set_pins", "on": "w", "vertices": [near], "joints": [0, 1], "weights": [0.25, 0.75]}
    pinned = {"count": 302, "at": [near], "tolerance": 0}
    joints = {"heads": half(0.5, 3.0, 5.0, 5.5, 0.2), "axes": half(1.0, 1.0, 1.0, 1.0, 1.0),
        "parents": [4294967295, 0, 1, 2, 0], "deforms": [1, 1, 1, 0, 1]}
    scene("weights", "Skin weights of a bar: pins are exact, undo and locks keep bits, a leaf ends where a child says that does not "
          "deform (the same weights as with tails).", surface("bar"), make(**chain),
          {"do": "weights_info", "on": "w", "expect": {"vertex_count": 302, "joint_count": 3, "informed_count": 302,
              "pin_count": 0}},
          *(column(joint, expect=agree()) for joint in range(3)), {"do": "joint_flags", "on": "w", "expect": agree(0)},
          column(2, keep="third"), {"do": "record_weights", "on": "w"}, pin,
          column(0, expect={**pinned, "values": [0.25]}), column(1, expect={**pinned, "values": [0.75]}),
          column(2, expect={**pinned, "values": [0.0]}), {"do": "clone_weights", "on": "w", "as": "c"},
          {"do": "undo_weights", "on": "w"}, column(2, same_as="third"),
          {"do": "skin_weights", "on": "c", "joint": 0, "expect": {**pinned, "values": [0.25]}},
          {"do": "redo_weights", "on": "w"}, column(1, expect={**pinned, "values": [0.75]}),
          {"do": "undo_weights", "on": "w"}, {"do": "undo_weights", "on": "w", "error": "HF_ERROR_EMPTY"},
          {"do": "set_locks", "on": "w", "joints": [2]},
          {"do": "set_joints", "on": "w", **chain, "tails": half(2.5, 4.0, 6.0)}, column(2, same_as="third"),
          {"do": "set_locks", "on": "w", "joints": []},
          {"do": "set_joints", "on": "w", "heads": half(0.5, 3.0, 5.0, 0.2), "tails": half(3.0, 5.0, 5.5, 0.5),
              "deforms": [1, 1, 1, 0]}, column(2, keep="tail"),
          {"do": "set_joints", "on": "w", **joints, "deforms": [1, 1, 1, 0, 0]}, column(2, same_as="tail"),
          {"do": "set_joints", "on": "w", **joints},
          {"do": "helpers", "on": "w", "names": ["root", "spine", "spine2", "spine2_end", "ik_target"], "expect": agree(0)},
          {"do": "helpers", "on": "w", "expect": agree(0)},
          {"do": "helpers", "on": "w", "names": ["root"], "error": "HF_ERROR_INVALID_ARGUMENT"},
          make("u", heads=[], error="HF_ERROR_EMPTY"),
          make("u", **{**chain, "parents": [4294967295, 7, 1]}, error="HF_ERROR_OUT_OF_RANGE", index=1),
          make("u", **{**chain, "deforms": [1, 2, 1]}, error="HF_ERROR_INVALID_ARGUMENT", index=1),
          make("u", **{**chain, "deforms": [0, 0, 0]}, error="HF_ERROR_EMPTY"),
          make("u", **{**chain, "heads": [*half(0.0, 2.0), 0.0, 0.0, "nan"]}, error="HF_ERROR_NON_FINITE", index=2),
          {**pin, "vertices": [999], "error": "HF_ERROR_OUT_OF_RANGE", "index": 0},
          {**pin, "vertices": [5, 5], "joints": [0, 1], "weights": [1.0, 1.0], "error": "HF_ERROR_DUPLICATE", "index": 1},
          {**pin, "weights": [0.0, 0.0], "error": "HF_ERROR_INVALID_ARGUMENT", "index": 0},
          {"do": "set_locks", "on": "w", "joints": [9], "error": "HF_ERROR_OUT_OF_RANGE", "index": 0},
          {"do": "dispose", "on": "w"}, {"do": "weights_info", "on": "w", "error": "HF_ERROR_INVALID_OBJECT"})


def carried_weights(scene, mesh, surface):
    x = np.array(mesh["positions"]).reshape(-1, 3)[:, 0]
    count = len(x)
    left = np.where(x < 3, 0.75, 0.25)
    given = {"joints": [0, 1] * count, "weights": np.stack([left, 1 - left], 1).ravel().tolist()}
    carry = {"do": "transfer_weights", "on": "n", "source": "m", **given, "joint": 0}
    side = np.where(x > 3, 0.0, 0.5)  # joint 1 alone on the right, both on the left
    arms = {"joints": [0, 1] * count, "weights": np.stack([side, 1 - side], 1).ravel().tolist(),
        "heads": [0.0, 1.0, 0.0, 6.0, 1.0, 0.0]}
    mirror = {"do": "mirror", "on": "m", **arms, "names": ["arm.L", "arm.R"], "joint": 0}
    corners = {"count": count, "at": [0, 12, 52, 64], "tolerance": 1e-6}
    scene("carried_weights", "Weights carried to the same strip stay (closed form); mirrored ones are those of the other arm.",
          surface("strip"), surface("strip", "n"), {**carry, "expect": {**expect(left), "tolerance": 1e-6}},
          {**mirror, "expect": {**corners, "values": [1.0, 0.0, 1.0, 0.0]}},
          {**mirror, "plane": [3.0, 0.0, 0.0, -1.0, 0.0, 0.0], "expect": {**corners, "values": [0.5, 0.5, 0.5, 0.5]}},
          {**mirror, "to": 1, "expect": {**corners, "values": [0.5, 0.5, 0.5, 0.5]}},
          {**carry, "weights": [0.0] * (2 * count), "error": "HF_ERROR_EMPTY"},
          {**carry, "weights": ["nan", *given["weights"][1:]], "error": "HF_ERROR_NON_FINITE", "index": 0},
          {**carry, "joints": [*given["joints"][:-1], 1048576], "error": "HF_ERROR_OUT_OF_RANGE", "index": count - 1},
          {**carry, "weights": given["weights"][:-1], "error": "HF_ERROR_INVALID_ARGUMENT"},
          {**mirror, "plane": [3.0, 0.0, 0.0, 0.0, 0.0, 0.0], "error": "HF_ERROR_INVALID_ARGUMENT"},
          {**mirror, "names": ["arm.L"], "error": "HF_ERROR_INVALID_ARGUMENT"},
          {**mirror, "weights": [0.0] * (2 * count), "error": "HF_ERROR_EMPTY"})


def curves(scene, mesh, surface):
    points, triangles = np.array(mesh["positions"]).reshape(-1, 3), np.array(mesh["triangles"]).reshape(-1, 3)
    through = [14, 23, 48, 40]
    corners = points[through]
    line = np.concatenate([straight_path(points, triangles, [v], [w])[:-1] for v, w in zip(through,
        np.roll(through, -1).tolist())])
    inside = inside_polygon(points, corners)
    inside[through] = False
    rim = np.zeros_like(inside)
    rim[triangles[inside[triangles].any(1)]] = True
    edit = lambda curve, **more: {"do": "region_edit", "on": "r", "curve": curve, **more}
    list_of = lambda which, found: {"do": "region_vertices", "on": "r", "list": which,
        "expect": expect(np.flatnonzero(found), 0)}
    drawn = lambda **more: {"do": "region_curve", "on": "r", **more}
    scene("curves",
        "A straight curve on a flat strip is a polygon: its corners, the vertices inside it and their rim (closed forms). Along "
          "edges by agreement. A curve that crosses itself is refused and changes nothing.", surface("strip"),
          {"do": "region", "on": "m", "as": "r", "options": {"base": hf.constants.HF_BASE_MEMBRANE}},
          drawn(expect={"count": 0}), edit(through), list_of(0, inside), list_of(1, rim & ~inside),
          {"do": "region_info", "on": "r", "expect": {"field_kind": hf.constants.HF_FIELD_HARMONIC}},
          drawn(expect=expect_all(line.ravel()), keep="line"),
          edit([14, 48, 23, 40], error="HF_ERROR_INVALID_ARGUMENT", index=2), drawn(same_as="line"),
          {"do": "region_edit", "on": "r", "rings": 1}, drawn(same_as="line"),
          edit(through, curve_kind=hf.constants.HF_CURVE_EDGES), drawn(expect=agree(0)),
          {"do": "region_vertices", "on": "r", "expect": agree(0)})


def graphs(scene, solver, solve):
    edges = [(0, 1), (1, 2), (2, 3), (3, 0), (2, 1), (4, 5), (5, 7), (7, 4)]
    weights, masses = [1.0, 0.5, 2.0, 0.25, 1.5, 3.0, 1.0, 0.5], [1.0, 2.0, 3.0, 0.5, 1.0, 1.0, 4.0, 2.0]
    given = {"do": "graph", "as": "m", "vertex_count": 8, "edges": [v for e in edges for v in e], "weights": weights,
        "masses": masses}
    sites = lambda on: {"do": "add_sites", "on": on, "vertices": [0, 2, 4], "values": [0.0, 1.0, 5.0]}
    thin = hf.constants.HF_FIELD_BIHARMONIC
    calls = [{"do": "pose", "as": "p"}, {"do": "direction", "as": "d"}, {"do": "region", "as": "r"},
        {"do": "geodesics", "as": "g"}, {"do": "flow", "as": "f"},
        {"do": "cast_ray", "origin": [0.0, 0.0, 1.0], "direction": [0.0, 0.0, -1.0]},
        {"do": "find_vertex", "point": [0.0, 0.0, 0.0]}]
    scene("graph", "A surface of edges and weights (oracle): parallel edges add up, a vertex without an edge holds 0.",
          given, {"do": "report", "on": "m", "expect": {"component_count": 2, "vertex_count": 8}},
          {"do": "components", "on": "m", "expect": {"count": 8, "at": [3, 5, 6], "values": [0, 1, 4294967295]}},
          solver(), sites("s"), solve(graph_field(8, edges, weights, [0, 2, 4], [0.0, 1.0, 5.0])),
          solver("b", field_kind=thin), sites("b"), {"do": "solve", "on": "b",
              "expect": expect(graph_field(8, edges, weights, [0, 2, 4], [0.0, 1.0, 5.0], masses), 1e-8)},
          *({**call, "on": "m", "error": "HF_ERROR_UNSUPPORTED"} for call in calls),
          {**given, "edges": [*given["edges"][:5], 8, *given["edges"][6:]], "error": "HF_ERROR_OUT_OF_RANGE", "index": 2},
          {**given, "weights": [*weights[:4], -1.0, *weights[5:]], "error": "HF_ERROR_INVALID_ARGUMENT", "index": 4},
          {**given, "weights": [*weights[:7], "nan"], "error": "HF_ERROR_NON_FINITE", "index": 7},
          {**given, "weights": weights[:7], "error": "HF_ERROR_INVALID_ARGUMENT"},
          {**given, "masses": [0.0, *masses[1:]], "error": "HF_ERROR_INVALID_ARGUMENT", "index": 0},
          {**given, "edges": [], "weights": [], "error": "HF_ERROR_EMPTY"})


def paths(scene, mesh, surface):
    points, triangles = np.array(mesh["positions"]).reshape(-1, 3), np.array(mesh["triangles"]).reshape(-1, 3)
    place = lambda t, *weights: [*map(int, triangles[t]), *weights]
    first, last = place(1, 0.2, 0.3, 0.5), place(88, 0.25, 0.25, 0.5)
    find = lambda start, end, on="g": {"do": "path", "on": on, "from": start, "to": end,
        "expect": expect_all(straight_path(points, triangles, start, end).ravel())}
    scene("paths",
        "Shortest paths on a flat strip are straight (closed form), whatever the method; its map around a place is the strip itself, turned (agreement).",
          surface("strip"), {"do": "geodesics", "on": "m", "as": "g"},
          {"do": "geodesics", "on": "m", "as": "h", "options": {"method": hf.constants.HF_GEODESICS_HEAT}},
          find(first, last), find(first, last, "h"), find([16], last), find([16], [61]), find([16], [16]),
          {"do": "map", "on": "g", "centre": [16], "expect": agree()},
          {"do": "map", "on": "h", "centre": first, "expect": agree()},
          {"do": "map", "on": "g", "centre": [16], "radius": 100.0, "expect": agree()},
          {"do": "path", "on": "g", "from": [16], "to": [65], "error": "HF_ERROR_OUT_OF_RANGE", "index": 1},
          {"do": "map", "on": "g", "centre": [0, 1, 64, 0.2, 0.3, 0.5], "error": "HF_ERROR_INVALID_ARGUMENT"})


def picking(scene, mesh, surface):
    p, triangles = np.array(mesh["positions"]).reshape(-1, 3), np.array(mesh["triangles"]).reshape(-1, 3)
    moved = p + [5, 0, 0]
    nearest = lambda points, at: np.array([np.argmin(np.linalg.norm(points - at, axis=1)),
        np.min(np.linalg.norm(points - at, axis=1))])
    ray = lambda origin, direction, points=p, **more: {"do": "cast_ray", "on": "m", "origin": origin,
        "direction": direction, "expect": expect_all(cast_ray(points, triangles, origin, direction)), **more}
    point = lambda at, points=p, **more: {"do": "find_vertex", "on": "m", "point": at,
        "expect": expect_all(nearest(points, at)), **more}
    inside = ([3.01, 0.02, 0.03], [1.0, 0.0, 0.0])
    scene("picking",
        "Rays and points against a surface at rest and posed (oracle). From inside, front_only passes the wall.", surface("torus"),
          ray([10.0, 0.3, 0.2], [-2.0, 0.01, 0.02]), ray([0.1, 0.2, 9.0], [0.3, 0.1, -1.0]), ray([0.0, 0.0, 9.0],
              [0.0, 0.0, 1.0]),
          ray([10.0, 0.3, 0.2], [-2.0, 0.01, 0.02], moved, positions=moved.ravel().tolist()),
          ray(*inside), ray(*inside, front_only=1, expect=expect_all(np.array([0.0]))),
          point([4.2, 0.1, 0.1]), point([-3.0, 1.0, -2.0]), point([4.2, 0.1, 0.1], moved,
              positions=moved.ravel().tolist()))


def dump(name, scene_list):
    lines = ['{"scenes": [']
    for scene in scene_list:
        head = json.dumps({k: scene[k] for k in ("name", "about")})[:-1]
        lines.append(f' {head}, "steps": [')
        lines += [f"  {json.dumps(step)}{',' if step is not scene['steps'][-1] else ''}" for step in scene["steps"]]
        lines.append(" ]}" + ("," if scene is not scene_list[-1] else ""))
    (HERE / name).write_text("\n".join(lines + ["]}"]) + "\n")


if __name__ == "__main__":
    write_meshes()
    all_meshes = golden.load_meshes()
    good = scenes(all_meshes)
    dump("scenes.json", good)
    wrong = bad_scenes()
    dump("bad_input.json", wrong)
    print(f"{len(good)} scenes, {sum('error' in step for scene in wrong for step in scene['steps'])} bad calls")
