"""The calls that every language must answer with the right error (bad_input.json, written by make_scenes.py)."""


def bad_scenes():
    surface = lambda name="m", mesh="small", **more: {"do": "surface", "as": name, "mesh": mesh, **more}
    solver = lambda name="s", on="m", **more: {"do": "solver", "as": name, "on": on, **more}
    made = []
    bad = lambda error, **step: made.append({**step, "error": "HF_ERROR_" + error})
    for place in range(18):
        bad("NON_FINITE", **surface(positions={str(place): ["nan", "inf", "-inf"][place % 3]}), index=place // 3)
    for place in range(12):
        bad("OUT_OF_RANGE", **surface(triangles={str(place): [6, 4294967295][place % 2]}), index=place // 3)
    bad("OUT_OF_RANGE", **surface(triangles={"7": 6}, index_bits=16), index=2)
    bad("OUT_OF_RANGE", **surface(triangles={"7": 65535}, index_bits=16, triangle_stride=8), index=2)
    bad("NULL_POINTER", **surface(mesh=None))
    bad("EMPTY", **surface(no_triangles=True))
    for option, value, error in (("weld", 9, "INVALID_ARGUMENT"), ("weld", -1, "INVALID_ARGUMENT"),
            ("operator_kind", 9, "INVALID_ARGUMENT"), ("ordering", 7, "INVALID_ARGUMENT"),
            ("vertex_limit", 5, "TOO_LARGE"), ("triangle_limit", 3, "TOO_LARGE"),
            ("thread_count", 257, "INVALID_ARGUMENT"), ("field_kind", 9, "INVALID_ARGUMENT"),
            ("weld", 2, "INVALID_ARGUMENT")):
        bad(error, **surface(options={option: value}))
    for option in ("no_such_option", "positions_", "Weld", "engine", "channel_count"):
        bad("INVALID_ARGUMENT", **surface(options={option: 1}))
    made.append(surface(mesh="small"))
    for option, value in (("engine", 7), ("engine", -1), ("channel_count", 65), ("field_kind", 9), ("penalty", -1.0),
            ("no_such_option", 1), ("weld", 1), ("operator_kind", 1)):
        bad("INVALID_ARGUMENT", **solver(options={option: value}))
    bad("INVALID_ARGUMENT", do="save", on="m", field_kind=9, **{"as": "f"})
    for direction in ([0.0, 0.0, 0.0],):
        bad("INVALID_ARGUMENT", do="cast_ray", on="m", origin=[0.3, 0.3, 1.0], direction=direction)
    for value in ("nan", "inf"):
        bad("NON_FINITE", do="cast_ray", on="m", origin=[0.0, value, 1.0], direction=[0.0, 0.0, 1.0])
        bad("NON_FINITE", do="cast_ray", on="m", origin=[0.0, 0.0, 1.0], direction=[0.0, value, 1.0])
        bad("NON_FINITE", do="find_vertex", on="m", point=[0.0, value, 1.0])
    posed = [0.0, 0.0, 0.0] * 5 + [0.0, 0.0, "nan"]
    bad("NON_FINITE", index=5, do="cast_ray", on="m", origin=[0.3, 0.3, 1.0], direction=[0.0, 0.0, -1.0],
        positions=posed)
    bad("NON_FINITE", index=5, do="find_vertex", on="m", point=[0.3, 0.3, 1.0], positions=posed)
    bad("INVALID_ARGUMENT", do="cast_ray", on="m", origin=[0.3, 0.3, 1.0], direction=[0.0, 0.0, -1.0],
        positions=[0.0] * 9)
    bad("INVALID_ARGUMENT", do="cast_ray", on="m", origin=[0.3, 0.3], direction=[0.0, 0.0, -1.0])
    bad("INVALID_ARGUMENT", do="cast_ray", on="m", origin=[0.3, 0.3, 1.0], direction=[0.0, 0.0, -1.0], front_only=2)
    bad("INVALID_ARGUMENT", do="find_vertex", on="m", point=[0.3, 0.3, 1.0], positions=[0.0] * 9)
    creation = [*made, {"do": "report", "on": "m", "expect": {"vertex_count": 6}},
        {"do": "find_vertex", "on": "m", "point": [0.0, 0.0, 0.0], "expect": {"count": 2, "sum": 0.0}}]

    made = []
    on = {"on": "s"}
    start = [surface(mesh="lonely"), solver()]
    bad("EMPTY", do="solve", **on)
    bad("EMPTY", do="solve_f32", **on)
    bad("EMPTY", do="solve_at", vertices=[0], **on)
    bad("EMPTY", do="preview", **on)
    bad("EMPTY", do="undo", **on)
    bad("EMPTY", do="redo", **on)
    bad("NULL_POINTER", do="add_sites", vertices=None, values=[1.0], **on)
    bad("EMPTY", do="add_sites", vertices=[], values=[], **on)
    for vertex in (7, 100, 4294967295):
        bad("OUT_OF_RANGE", do="add_sites", vertices=[0, vertex], values=[0.0, 1.0], index=1, **on)
    bad("INVALID_ARGUMENT", do="add_sites", vertices=[6], values=[1.0], **on)  # isolated
    for value in ("nan", "inf", "-inf"):
        bad("NON_FINITE", do="add_sites", vertices=[0, 1], values=[0.0, value], index=1, **on)
        bad("NON_FINITE", do="add_sites", vertices=[0], values=[0.0], stiffness=[value], **on)
        bad("NON_FINITE", do="add_sites", vertices=[0], values=[0.0], radii=[value], **on)
    bad("INVALID_ARGUMENT", do="add_sites", vertices=[0], values=[0.0], stiffness=[-1.0], **on)
    bad("INVALID_ARGUMENT", do="add_sites", vertices=[0], values=[0.0], radii=[-1.0], **on)
    for wrong in ({"values": [1.0, 2.0]}, {"values": []}, {"values": [1.0], "stiffness": [1.0, 1.0]},
        {"values": [1.0], "radii": [1.0, 2.0]}):
        bad("INVALID_ARGUMENT", do="add_sites", vertices=[0], **wrong, **on)  # lengths that do not match
    bad("OUT_OF_RANGE", do="add_sites", places=[7, 2, 1, 0.2, 0.3, 0.5], values=[1.0], **on)
    bad("INVALID_ARGUMENT", do="add_sites", places=[0, 2, 1, 0.2, 0.3, 0.9], values=[1.0], **on)
    bad("INVALID_ARGUMENT", do="add_sites", places=[0, 2, 1, 0.2, -0.2, 1.0], values=[1.0], **on)
    bad("NON_FINITE", do="add_sites", places=[0, 2, 1, "nan", 0.5, 0.5], values=[1.0], **on)
    bad("DUPLICATE", do="add_sites", vertices=[1, 1], values=[1.0, 1.0], **on)
    bad("CONFLICT", do="add_sites", vertices=[1, 1], values=[1.0, 2.0], **on)
    bad("OUT_OF_RANGE", do="add_site", vertex=7, value=1.0, **on)
    bad("NON_FINITE", do="add_site", vertex=0, value="nan", **on)
    bad("INVALID_ARGUMENT", do="add_site", vertex=6, value=1.0, **on)  # isolated
    made.append({"do": "add_sites", "vertices": [0, 1], "values": [0.0, 1.0], "numbers": [0, 1], **on})
    bad("DUPLICATE", do="add_site", vertex=1, value=1.0, **on)
    bad("CONFLICT", do="add_site", vertex=1, value=3.0, **on)
    bad("DUPLICATE", do="add_sites", vertices=[1], values=[1.0], **on)
    bad("CONFLICT", do="add_sites", vertices=[1], values=[2.0], **on)
    for site in (2, 9, 4294967295):
        bad("NOT_FOUND", do="remove_sites", sites=[0, site], index=1, **on)
        bad("NOT_FOUND", do="move_sites", sites=[site], vertices=[3], **on)
        bad("NOT_FOUND", do="set_values", sites=[site], values=[1.0], **on)
    bad("NOT_FOUND", do="remove_sites", sites=[0, 0], **on)
    bad("EMPTY", do="remove_sites", sites=[], **on)
    bad("NULL_POINTER", do="remove_sites", sites=None, **on)
    bad("OUT_OF_RANGE", do="move_sites", sites=[0], vertices=[7], **on)
    bad("INVALID_ARGUMENT", do="set_values", sites=[0], values=[1.0, 2.0], **on)
    bad("NON_FINITE", do="set_values", sites=[0], values=["nan"], **on)
    bad("EMPTY", do="solve_at", vertices=[], **on)
    bad("OUT_OF_RANGE", do="solve_at", vertices=[7], **on)
    bad("INVALID_ARGUMENT", do="preview", correction_count=9, **on)
    line = [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 0.0]
    bad("INVALID_ARGUMENT", do="levels", field=line, count=0, spacing="HF_LEVELS_VALUE", on="m")
    bad("INVALID_ARGUMENT", do="levels", field=line[:3], count=2, spacing="HF_LEVELS_VALUE", on="m")
    bad("INVALID_ARGUMENT", do="levels", field=[1.0] * 7, count=2, spacing="HF_LEVELS_VALUE", on="m")
    bad("NON_FINITE", do="levels", field=["inf"] + line[1:], count=2, spacing="HF_LEVELS_VALUE", on="m")
    bad("EMPTY", do="isolines", field=line, levels=[], on="m")
    bad("NON_FINITE", do="isolines", field=line, levels=["nan"], on="m")
    bad("INVALID_ARGUMENT", do="isolines", field=line[:2], levels=[0.5], on="m")
    bad("INVALID_ARGUMENT", do="critical", field=line[:5], on="m")
    made.append({"do": "solve", "expect": {"count": 7, "max": 1.0, "min": 0.0, "tolerance": 1e-12}, **on})
    sites = start + made

    made = []
    start = [surface(mesh="bar"), {"do": "pose", "on": "m", "as": "p"}]
    on = {"on": "p"}
    bad("EMPTY", do="deform", **on)
    bad("EMPTY", do="deform_f32", **on)
    bad("NON_FINITE", do="add_handle_at", point=["nan", 0.0, 0.0], radius=1.0, **on)
    bad("NON_FINITE", do="add_handle_at", point=[0.0, 0.0, 0.0], radius="inf", **on)
    bad("INVALID_ARGUMENT", do="add_handle_at", point=[0.0, 0.0, 0.0], radius=-1.0, **on)
    bad("INVALID_ARGUMENT", do="add_handle_at", point=[0.0, 0.0], radius=1.0, **on)
    bad("NULL_POINTER", do="add_handles", regions=None, **on)
    bad("EMPTY", do="add_handles", regions=[], **on)
    bad("EMPTY", do="add_handles", regions=[[0], []], **on)
    for vertex in (302, 4294967295):
        bad("OUT_OF_RANGE", do="add_handles", regions=[[0, 1, vertex]], index=2, **on)
    bad("CONFLICT", do="add_handles", regions=[[0, 1, 2], [2, 3]], **on)
    bad("INVALID_ARGUMENT", do="add_handles", regions=[[0]], layer=8, **on)
    bad("INVALID_ARGUMENT", do="add_handles", regions=[[0]], in_place=2, **on)
    bad("NON_FINITE", do="add_handles", points=["nan", 0.0, 0.0], radii=[1.0], **on)
    bad("NON_FINITE", do="add_handles", points=[0.0, 0.0, 0.0], radii=["inf"], **on)
    bad("INVALID_ARGUMENT", do="add_handles", points=[0.0, 0.0, 0.0], radii=[-1.0], **on)
    bad("INVALID_ARGUMENT", do="add_handles", points=[0.0, 0.0, 0.0], radii=[1.0, 1.0], **on)
    made.append({"do": "add_handles", "regions": [list(range(12)), list(range(276, 288))], "numbers": [0, 1], **on})
    bad("CONFLICT", do="add_handles", regions=[[5]], **on)
    bad("CONFLICT", do="add_handle_at", point=[0.5, 0.0, 0.0], radius=0.1, **on)
    bad("NON_FINITE", do="set_transform", handle=0, translation=[0.0, "nan", 0.0], **on)
    bad("NOT_FOUND", do="set_transform", handle=2, translation=[0.0, 0.0, 0.0], **on)
    bad("INVALID_ARGUMENT", do="set_transform", handle=0, translation=[0.0, 0.0], **on)
    for handle in (2, 4294967295):
        bad("NOT_FOUND", do="remove_handles", handles=[handle], **on)
        bad("NOT_FOUND", do="set_transforms", handles=[handle], translations=[0.0, 0.0, 0.0], **on)
        bad("NOT_FOUND", do="handle_field", handle=handle, **on)
        bad("NOT_FOUND", do="handle_info", handle=handle, **on)
    bad("EMPTY", do="remove_handles", handles=[], **on)
    bad("EMPTY", do="set_transforms", handles=[], translations=[], **on)
    for value in ("nan", "inf"):
        bad("NON_FINITE", do="set_transforms", handles=[0], translations=[0.0, value, 0.0], **on)
        bad("NON_FINITE", do="set_transforms", handles=[0], rotations=[0.0, value, 0.0, 1.0], **on)
    bad("INVALID_ARGUMENT", do="set_transforms", handles=[0], translations=[0.0, 0.0], **on)
    bad("INVALID_ARGUMENT", do="set_transforms", handles=[0], rotations=[0.0, 0.0], **on)
    bad("INVALID_ARGUMENT", do="skin", influence_count=5, **on)
    bad("INVALID_ARGUMENT", do="pose", **{"on": "m", "as": "q"}, options={"mode": 9})
    bad("INVALID_ARGUMENT", do="pose", **{"on": "m", "as": "q"}, options={"band_count": 1})
    bad("INVALID_ARGUMENT", do="transfer", **{"as": "x"}, source="m", target="m", options={"mode": 9})
    made.append({"do": "transfer", "as": "x", "source": "m", "target": "m"})
    bad("EMPTY", do="apply", on="x", positions=[0.0] * 906)
    bad("NOT_FOUND", do="remove_pairs", on="x", pairs=[0])
    bad("EMPTY", do="add_pairs", on="x", source_regions=[], target_regions=[])
    bad("INVALID_ARGUMENT", do="add_pairs", on="x", source_regions=[[0]], target_regions=[[0], [1]])
    bad("OUT_OF_RANGE", do="add_pairs", on="x", source_regions=[[999]], target_regions=[[0]])
    made.append({"do": "add_pairs", "on": "x", "source_regions": [[0, 1]], "target_regions": [[0, 1]]})
    bad("NON_FINITE", do="apply", on="x", positions=[0.0] * 905 + ["nan"])
    bad("INVALID_ARGUMENT", do="apply", on="x", positions=[0.0] * 9)
    made.append({"do": "deform", "expect": {"count": 906}, **on})
    poses = start + made

    made = []
    start = [surface(mesh="bar"), surface("r", "strip"), solver(), {"do": "pose", "on": "m", "as": "p"},
        {"do": "transfer", "as": "x", "source": "m", "target": "m"},
             {"do": "geodesics", "on": "m", "as": "g"}, {"do": "direction", "on": "m", "as": "d"}]
    bad("EMPTY", do="distance", on="g", sources=[])
    bad("OUT_OF_RANGE", do="distance", on="g", sources=[302])
    bad("OUT_OF_RANGE", do="path", on="g", **{"from": [302], "to": [0]})
    bad("INVALID_ARGUMENT", do="path", on="g", **{"from": [0], "to": [0, 1, 2, 0.5, 0.5, 0.5]})
    bad("INVALID_ARGUMENT", do="map", on="g", centre=[0], radius=-1.0)
    bad("EMPTY", do="directions", on="d")
    bad("NON_FINITE", do="add_vectors", on="d", vertices=[0], vectors=["nan", 0.0, 0.0])
    bad("OUT_OF_RANGE", do="add_vectors", on="d", vertices=[302], vectors=[1.0, 0.0, 0.0])
    bad("INVALID_ARGUMENT", do="add_vectors", on="d", vertices=[0], vectors=[1.0, 0.0])
    bad("INVALID_ARGUMENT", **{"do": "direction", "on": "m", "as": "e", "options": {"degree": 3}})
    made += [{"do": "flow", "on": "m", "as": "w"}, {"do": "quads", "on": "m", "as": "k", "edge_length": 1.0}]
    bad("NON_FINITE", **{"do": "quads", "on": "m", "as": "n", "edge_length": "nan"})
    bad("NON_FINITE", **{"do": "quads", "on": "m", "as": "n", "edge_length": "inf"})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "m", "as": "n", "edge_length": -1.0})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "m", "as": "n", "options": {"relax_count": 1001}})
    quads = {"do": "quads", "on": "m", "as": "n"}
    guide = {"guide_vertices": [7], "guide_vectors": [1.0, 0.0, 0.0]}
    pole = {"irregular_points": [4.0, 0.0, 0.0], "irregular_valences": [5]}
    for wrong in ({"crease_edges": [0, 1, 2]}, {"guide_vertices": [7], "guide_vectors": [1.0, 0.0]},
            {"guide_vertices": [7, 8], "guide_vectors": [1.0, 0.0, 0.0]}, {"guide_vectors": [1.0, 0.0, 0.0]},
            {**guide, "guide_weights": [1.0, 1.0]}, {**guide, "guide_weights": []}, {"guide_weights": [1.0]},
            {"irregular_points": [4.0, 0.0, 0.0]}, {"irregular_directions": [0.0, 1.0, 0.0]}, {**pole, "irregular_points": [4.0, 0.0]},
            {**pole, "irregular_valences": [5, 3]}, {**pole, "irregular_directions": [0.0, 1.0]}, {**pole, "irregular_directions": []},
            {"symmetry_plane": [1.0, 0.0, 0.0]}, {"symmetry_plane": [1.0, 0.0, 0.0, 0.0, 0.0]},
            {"symmetry_plane": [0.0, 0.0, 0.0, 1.0]}):  # lengths that do not match, and no plane
        bad("INVALID_ARGUMENT", **quads, **wrong)
    for option in ("crease_count", "guide_count", "irregular_count"):
        bad("INVALID_ARGUMENT", **{**quads, "options": {option: 0}})  # lengths of lists are no options
    bad("INVALID_ARGUMENT", index=0, **quads, crease_edges=[0, 301])  # no edge
    bad("OUT_OF_RANGE", index=1, **quads, crease_edges=[0, 1, 0, 302])
    bad("OUT_OF_RANGE", index=0, **quads, **{**guide, "guide_vertices": [302]})
    bad("NULL_POINTER", **quads, guide_vertices=[7], guide_vectors=None)
    bad("NON_FINITE", index=0, **quads, **{**guide, "guide_vectors": [1.0, "nan", 0.0]})
    bad("INVALID_ARGUMENT", index=0, **quads, **{**guide, "guide_vectors": [0.0, 0.0, 0.0]})
    for weight, error in (("nan", "NON_FINITE"), (0.0, "INVALID_ARGUMENT"), (1.5, "INVALID_ARGUMENT")):
        bad(error, index=0, **quads, **guide, guide_weights=[weight])
    bad("INVALID_ARGUMENT", index=1, **quads, irregular_points=[4.0, 0.0, 0.0] * 2, irregular_valences=[3, 4])
    bad("NULL_POINTER", **quads, irregular_points=None, irregular_valences=[3])
    bad("NON_FINITE", index=0, **quads, **{**pole, "irregular_points": [4.0, "nan", 0.0]})
    bad("NON_FINITE", index=0, **quads, **pole, irregular_directions=["inf", 0.0, 0.0])
    bad("NON_FINITE", **quads, symmetry_plane=[1.0, 0.0, "inf", 0.0])
    wanted = {"options": {"face_count": 200}}
    made += [{"do": "quads", "on": "m", "as": "u", **wanted}, {"do": "quad_mesh", "on": "u", "keep": "before"},
        {"do": "quads", "on": "m", "as": "n", **wanted, **guide}, {"do": "quad_mesh", "on": "n", "keep": "guided"}]
    again = {"do": "update_quads", "on": "u", **wanted}
    bad("NON_FINITE", index=0, **again, **{**guide, "guide_vectors": [1.0, "nan", 0.0]})
    bad("INVALID_ARGUMENT", index=0, **again, **{**guide, "guide_vectors": [0.0, 0.0, 0.0]})
    bad("OUT_OF_RANGE", index=0, **again, **{**guide, "guide_vertices": [302]})
    bad("INVALID_ARGUMENT", index=0, **again, **{**pole, "irregular_valences": [4]})
    bad("NON_FINITE", index=0, **again, **{**pole, "irregular_points": [4.0, "inf", 0.0]})
    bad("INVALID_ARGUMENT", index=0, **again, crease_edges=[0, 301])  # no edge
    bad("NON_FINITE", **again, symmetry_plane=[1.0, 0.0, "inf", 0.0])
    bad("UNSUPPORTED", **again, symmetry_plane=[1.0, 0.0, 0.0, 100.0])  # nothing on its side
    bad("NON_FINITE", **again, edge_length="nan")
    bad("INVALID_ARGUMENT", **{**again, "options": {"relax_count": 1001}})
    bad("INVALID_ARGUMENT", **{**again, "options": {"guide_count": 0}})
    for wrong in ({"crease_edges": [0, 1, 2]}, {"guide_vertices": [7, 8], "guide_vectors": [1.0, 0.0, 0.0]},
            {**guide, "guide_weights": []}, {"irregular_points": [4.0, 0.0, 0.0]}, {"symmetry_plane": [1.0, 0.0, 0.0]}):  # lengths that do not match
        bad("INVALID_ARGUMENT", **again, **wrong)
    made += [{"do": "quad_mesh", "on": "u", "same_as": "before"}, {**again, **guide, "same_as": "guided"}]
    bad("INVALID_ARGUMENT", do="streamlines", on="w", field=[0.0] * 302, count=0)
    bad("NON_FINITE", index=301, do="streamlines", on="w", field=[0.0] * 301 + ["nan"], count=4)
    bad("INVALID_ARGUMENT", do="streamlines", on="w", field=[0.0] * 9, count=4)
    bad("OUT_OF_RANGE", index=1, do="streamlines", on="w", field=[0.0] * 302, seeds=[0, 302])
    made += [{"do": "region", "on": "m", "as": "o"}]
    bad("INVALID_ARGUMENT", do="region", on="m", **{"as": "n"}, positions=[0.0] * 9)
    for base in (-1, 4):
        bad("INVALID_ARGUMENT", do="region", on="m", **{"as": "n"}, options={"base": base})
    bad("OUT_OF_RANGE", do="region_edit", on="o", add=[302])
    for kind in (-1, 2):
        bad("INVALID_ARGUMENT", do="region_edit", on="o", curve=[0, 1, 13], curve_kind=kind)
    bad("EMPTY", index=2, do="region_edit", on="o", curve=[0, 1])
    made += [{"do": call, "on": "o", "expect": {"count": 0}} for call in ("region_curve", "region_vertices")]
    bad("NON_FINITE", do="morph", on="o", weight="nan")
    bad("EMPTY", do="undo_region", on="o")
    bad("EMPTY", **{"do": "detail", "as": "n", "source": "o", "target": "o"})
    bad("EMPTY", do="undo_vectors", on="d")
    bad("EMPTY", do="redo_vectors", on="d")
    bad("NOT_FOUND", do="remove_vectors", on="d", sites=[0])
    bad("NOT_FOUND", do="move_vectors", on="d", sites=[0], vertices=[1])
    bad("INVALID_ARGUMENT", do="move_vectors", on="d", sites=[0, 1], vertices=[1])
    bad("NOT_FOUND", do="set_vectors", on="d", sites=[0], vectors=[1.0, 0.0, 0.0])
    bad("INVALID_ARGUMENT", do="set_vectors", on="d", sites=[0], vectors=[1.0])
    ramp = [0.0] * 302
    calls = {"s": [{"do": "add_sites", "vertices": [0], "values": [1.0]}, {"do": "add_site", "vertex": 0, "value": 1.0},
                   {"do": "remove_sites", "sites": [0]}, {"do": "move_sites", "sites": [0], "vertices": [1]},
                   {"do": "set_values", "sites": [0], "values": [1.0]}, {"do": "edit", "add": [0],
                       "add_values": [1.0]}, {"do": "record"}, {"do": "solve"}, {"do": "solve_f32"}, {"do": "preview"}, {"do": "solve_at",
                       "vertices": [0]}, {"do": "statistics"}, {"do": "solver_info"}, {"do": "clone", "as": "c"}],
             "m": [{"do": "report"}, {"do": "surface_statistics"}, {"do": "surface_info"}, {"do": "components"},
                   {"do": "save", "as": "f"}, {"do": "solver", "as": "t"}, {"do": "pose", "as": "q"},
                   {"do": "geodesics", "as": "h"}, {"do": "direction", "as": "e"}, {"do": "region", "as": "n"},
                   {"do": "quads", "as": "n"}, {"do": "flow", "as": "n"}, {"do": "extremities"},
                   {"do": "propose"},
                   {"do": "levels", "field": ramp, "count": 2, "spacing": "HF_LEVELS_VALUE"},
                   {"do": "isolines", "field": ramp, "levels": [0.5]}, {"do": "critical", "field": ramp},
                   {"do": "cast_ray", "origin": [9.0, 0.0, 3.0], "direction": [-1.0, 0.0, 0.0]},
                   {"do": "find_vertex", "point": [9.0, 0.0, 3.0]}],
             "p": [{"do": "add_handles", "regions": [[0]]}, {"do": "remove_handles", "handles": [0]},
                 {"do": "set_transforms", "handles": [0], "translations": [0.0, 0.0, 0.0]},
                   {"do": "deform"}, {"do": "deform_f32"}, {"do": "pose_info"}, {"do": "add_handle_at", "point": [0.0, 0.0, 3.0],
                       "radius": 0.1}, {"do": "set_transform", "handle": 0, "translation": [0.0, 0.0, 0.0]},
                   {"do": "handle_field", "handle": 0}, {"do": "handle_info",
                       "handle": 0}, {"do": "skin", "influence_count": 4}],
             "x": [{"do": "add_pairs", "source_regions": [[0]], "target_regions": [[0]]},
                 {"do": "remove_pairs", "pairs": [0]}, {"do": "transfer_info"},
                   {"do": "apply", "positions": [0.0] * 906}],
             "g": [{"do": "distance", "sources": [0]}, {"do": "path", "from": [0], "to": [1]},
                 {"do": "map", "centre": [0]}], "d": [{"do": "add_vectors", "vertices": [0],
                 "vectors": [1.0, 0.0, 0.0]}, {"do": "rotate", "sites": [0], "angles": [1.0]},
                                                             {"do": "directions"}, {"do": "singularities"}, {"do": "remove_vectors", "sites": [0]}, {"do": "move_vectors", "sites": [0], "vertices": [1]},
                   {"do": "set_vectors", "sites": [0],
                       "vectors": [1.0, 0.0,
                       0.0]}, {"do": "record_vectors"},
                   {"do": "clone_vectors", "as": "e"}],
             "w": [{"do": "streamlines", "field": [0.0] * 302, "count": 4}], "k": [{"do": "quads_info"},
                 {"do": "quad_mesh"}, {"do": "update_quads"}],
             "o": [{"do": "region_edit", "rings": 1}, {"do": "region_info"}, {"do": "region_vertices"},
                 {"do": "region_curve"}, {"do": "morph", "weight": 1.0},
                   {"do": "record_region"}]}
    for name, steps in calls.items():
        made += [{"do": "dispose", "on": name}, {"do": "dispose", "on": name}]
        for step in steps:
            bad("INVALID_OBJECT", **{**step, "on": name})
    bad("INVALID_OBJECT", **{"do": "transfer", "as": "y", "source": "m", "target": "r"})
    bad("INVALID_OBJECT", **{"do": "transfer", "as": "y", "source": "r", "target": "m"})
    return [{"name": "bad_meshes", "about": "What hf_surface_create and hf_create must refuse; picking.", "steps": creation},
        {"name": "bad_sites", "about": "Sites and fields.", "steps": sites},
            {"name": "bad_poses", "about": "Handles and pairs.", "steps": poses}, {"name": "stale_objects",
                "about": "Calls on closed objects; closing twice.", "steps": start + made}]
