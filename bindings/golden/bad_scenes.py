"""The calls that every language must answer with the right error (bad_input.json, written by make_scenes.py)."""


def bad_scenes():
    solver = lambda name="s", mesh="small", **more: {"do": "solver", "as": name, "mesh": mesh, **more}
    made = []
    bad = lambda error, **step: made.append({**step, "error": "HF_ERROR_" + error})
    for place in range(18):
        bad("NON_FINITE", **solver(positions={str(place): ["nan", "inf", "-inf"][place % 3]}), index=place // 3)
    for place in range(12):
        bad("OUT_OF_RANGE", **solver(triangles={str(place): [6, 4294967295][place % 2]}), index=place // 3)
    bad("NULL_POINTER", **solver(mesh=None))
    bad("EMPTY", **solver(no_triangles=True))
    for option, value, error in (("weld", 9, "INVALID_ARGUMENT"), ("weld", -1, "INVALID_ARGUMENT"),
        ("operator_kind", 9, "INVALID_ARGUMENT"),
                                 ("engine", 7, "INVALID_ARGUMENT"), ("ordering", 7,
                                     "INVALID_ARGUMENT"), ("channel_count", 65, "INVALID_ARGUMENT"),
                                 ("vertex_limit", 5, "TOO_LARGE"), ("field_kind", 9, "INVALID_ARGUMENT"), ("weld", 2,
                                     "INVALID_ARGUMENT"), ("penalty", -1.0, "INVALID_ARGUMENT")):
        bad(error, **solver(options={option: value}))
    for option in ("no_such_option", "positions_", "Weld"):
        bad("INVALID_ARGUMENT", **solver(options={option: 1}))
    creation = [*made, solver(mesh="small"), {"do": "report", "on": "s", "expect": {"vertex_count": 6}}]

    made = []
    on = {"on": "s"}
    start = [solver(mesh="lonely")]
    bad("NO_SITES", do="solve", **on)
    bad("NO_SITES", do="solve_f32", **on)
    bad("NO_SITES", do="solve_at", vertices=[0], **on)
    bad("NO_SITES", do="preview", **on)
    bad("NO_RECORD", do="undo", **on)
    bad("NO_RECORD", do="redo", **on)
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
    bad("OUT_OF_RANGE", do="add_sites", triangles=[4], barycentrics=[0.2, 0.3, 0.5], values=[1.0], **on)
    bad("INVALID_ARGUMENT", do="add_sites", triangles=[0], barycentrics=[0.2, 0.3, 0.9], values=[1.0], **on)
    bad("INVALID_ARGUMENT", do="add_sites", triangles=[0], barycentrics=[0.2, -0.2, 1.0], values=[1.0], **on)
    bad("NON_FINITE", do="add_sites", triangles=[0], barycentrics=["nan", 0.5, 0.5], values=[1.0], **on)
    bad("DUPLICATE_SITE", do="add_sites", vertices=[1, 1], values=[1.0, 1.0], **on)
    bad("CONFLICT", do="add_sites", vertices=[1, 1], values=[1.0, 2.0], **on)
    made.append({"do": "add_sites", "vertices": [0, 1], "values": [0.0, 1.0], "numbers": [0, 1], **on})
    bad("DUPLICATE_SITE", do="add_sites", vertices=[1], values=[1.0], **on)
    bad("CONFLICT", do="add_sites", vertices=[1], values=[2.0], **on)
    for site in (2, 9, 4294967295):
        bad("NO_SUCH_SITE", do="remove_sites", sites=[0, site], index=1, **on)
        bad("NO_SUCH_SITE", do="move_sites", sites=[site], vertices=[3], **on)
        bad("NO_SUCH_SITE", do="set_values", sites=[site], values=[1.0], **on)
    bad("NO_SUCH_SITE", do="remove_sites", sites=[0, 0], **on)
    bad("EMPTY", do="remove_sites", sites=[], **on)
    bad("NULL_POINTER", do="remove_sites", sites=None, **on)
    bad("OUT_OF_RANGE", do="move_sites", sites=[0], vertices=[7], **on)
    bad("INVALID_ARGUMENT", do="set_values", sites=[0], values=[1.0, 2.0], **on)
    bad("NON_FINITE", do="set_values", sites=[0], values=["nan"], **on)
    bad("EMPTY", do="solve_at", vertices=[], **on)
    bad("OUT_OF_RANGE", do="solve_at", vertices=[7], **on)
    bad("INVALID_ARGUMENT", do="preview", correction_count=9, **on)
    line = [0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 0.0]
    bad("INVALID_ARGUMENT", do="levels", field=line, count=0, spacing="HF_LEVELS_VALUE", **on)
    bad("INVALID_ARGUMENT", do="levels", field=line[:3], count=2, spacing="HF_LEVELS_VALUE", **on)
    bad("INVALID_ARGUMENT", do="levels", field=[1.0] * 7, count=2, spacing="HF_LEVELS_VALUE", **on)
    bad("NON_FINITE", do="levels", field=["inf"] + line[1:], count=2, spacing="HF_LEVELS_VALUE", **on)
    bad("EMPTY", do="isolines", field=line, levels=[], **on)
    bad("NON_FINITE", do="isolines", field=line, levels=["nan"], **on)
    bad("INVALID_ARGUMENT", do="isolines", field=line[:2], levels=[0.5], **on)
    bad("INVALID_ARGUMENT", do="critical", field=line[:5], **on)
    made.append({"do": "solve", "expect": {"count": 7, "max": 1.0, "min": 0.0, "tolerance": 1e-12}, **on})
    sites = start + made

    made = []
    start = [solver(mesh="bar"), {"do": "pose", "on": "s", "as": "p"}]
    on = {"on": "p"}
    bad("EMPTY", do="deform", **on)
    bad("NULL_POINTER", do="add_handles", regions=None, **on)
    bad("EMPTY", do="add_handles", regions=[], **on)
    bad("EMPTY", do="add_handles", regions=[[0], []], **on)
    for vertex in (302, 4294967295):
        bad("OUT_OF_RANGE", do="add_handles", regions=[[0, 1, vertex]], index=2, **on)
    bad("OVERLAP", do="add_handles", regions=[[0, 1, 2], [2, 3]], **on)
    bad("INVALID_ARGUMENT", do="add_handles", regions=[[0]], layer=8, **on)
    bad("NON_FINITE", do="add_handles", points=["nan", 0.0, 0.0], radii=[1.0], **on)
    bad("NON_FINITE", do="add_handles", points=[0.0, 0.0, 0.0], radii=["inf"], **on)
    bad("INVALID_ARGUMENT", do="add_handles", points=[0.0, 0.0, 0.0], radii=[-1.0], **on)
    bad("INVALID_ARGUMENT", do="add_handles", points=[0.0, 0.0, 0.0], radii=[1.0, 1.0], **on)
    made.append({"do": "add_handles", "regions": [list(range(12)), list(range(276, 288))], "numbers": [0, 1], **on})
    bad("OVERLAP", do="add_handles", regions=[[5]], **on)
    for handle in (2, 4294967295):
        bad("NO_SUCH_HANDLE", do="remove_handles", handles=[handle], **on)
        bad("NO_SUCH_HANDLE", do="set_transforms", handles=[handle], translations=[0.0, 0.0, 0.0], **on)
        bad("NO_SUCH_HANDLE", do="handle_field", handle=handle, **on)
        bad("NO_SUCH_HANDLE", do="handle_info", handle=handle, **on)
    bad("EMPTY", do="remove_handles", handles=[], **on)
    bad("EMPTY", do="set_transforms", handles=[], translations=[], **on)
    for value in ("nan", "inf"):
        bad("NON_FINITE", do="set_transforms", handles=[0], translations=[0.0, value, 0.0], **on)
        bad("NON_FINITE", do="set_transforms", handles=[0], rotations=[0.0, value, 0.0, 1.0], **on)
    bad("INVALID_ARGUMENT", do="set_transforms", handles=[0], translations=[0.0, 0.0], **on)
    bad("INVALID_ARGUMENT", do="set_transforms", handles=[0], rotations=[0.0, 0.0], **on)
    bad("INVALID_ARGUMENT", do="skin", weight_count=5, **on)
    bad("INVALID_ARGUMENT", do="pose", **{"on": "s", "as": "q"}, options={"mode": 9})
    bad("INVALID_ARGUMENT", do="pose", **{"on": "s", "as": "q"}, options={"band_count": 1})
    bad("INVALID_ARGUMENT", do="transfer", **{"as": "x"}, source="s", target="s", options={"mode": 9})
    made.append({"do": "transfer", "as": "x", "source": "s", "target": "s"})
    bad("EMPTY", do="apply", on="x", positions=[0.0] * 906)
    bad("NO_SUCH_PAIR", do="remove_pairs", on="x", pairs=[0])
    bad("EMPTY", do="add_pairs", on="x", source_regions=[], target_regions=[])
    bad("INVALID_ARGUMENT", do="add_pairs", on="x", source_regions=[[0]], target_regions=[[0], [1]])
    bad("OUT_OF_RANGE", do="add_pairs", on="x", source_regions=[[999]], target_regions=[[0]])
    made.append({"do": "add_pairs", "on": "x", "source_regions": [[0, 1]], "target_regions": [[0, 1]]})
    bad("NON_FINITE", do="apply", on="x", positions=[0.0] * 905 + ["nan"])
    bad("INVALID_ARGUMENT", do="apply", on="x", positions=[0.0] * 9)
    made.append({"do": "deform", "expect": {"count": 906}, **on})
    poses = start + made

    made = []
    start = [solver(mesh="bar"), solver("r", "strip"), {"do": "pose", "on": "s", "as": "p"},
        {"do": "transfer", "as": "x", "source": "s", "target": "s"},
             {"do": "geodesics", "on": "s", "as": "g"}, {"do": "direction", "on": "s", "as": "d"}]
    bad("EMPTY", do="distance", on="g", sources=[])
    bad("OUT_OF_RANGE", do="distance", on="g", sources=[302])
    bad("NO_SITES", do="directions", on="d")
    bad("NON_FINITE", do="add_vectors", on="d", vertices=[0], vectors=["nan", 0.0, 0.0])
    bad("OUT_OF_RANGE", do="add_vectors", on="d", vertices=[302], vectors=[1.0, 0.0, 0.0])
    bad("INVALID_ARGUMENT", do="add_vectors", on="d", vertices=[0], vectors=[1.0, 0.0])
    bad("INVALID_ARGUMENT", **{"do": "direction", "on": "s", "as": "e", "options": {"degree": 3}})
    made += [{"do": "flow", "on": "s", "as": "w"}, {"do": "quads", "on": "s", "as": "k", "edge_length": 1.0}]
    bad("NON_FINITE", **{"do": "quads", "on": "s", "as": "m", "edge_length": "nan"})
    bad("NON_FINITE", **{"do": "quads", "on": "s", "as": "m", "edge_length": "inf"})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "s", "as": "m", "edge_length": -1.0})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "s", "as": "m", "options": {"kind": 2}})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "s", "as": "m", "options": {"relax_count": 1001}})
    bad("OUT_OF_RANGE", index=1, **{"do": "quads", "on": "s", "as": "m", "site_vertices": [0, 302]})
    bad("DUPLICATE_SITE", **{"do": "quads", "on": "s", "as": "m", "site_vertices": [7, 7]})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "s", "as": "m", "site_vertices": [0, 287], "site_lines": [4, 4]})
    bad("INVALID_ARGUMENT", **{"do": "quads", "on": "s", "as": "m", "site_vertices": [0, 287], "site_lines": [4]})
    bad("INVALID_ARGUMENT", do="flow_lines", on="w", field=[0.0] * 302, count=0)
    bad("NON_FINITE", index=301, do="flow_lines", on="w", field=[0.0] * 301 + ["nan"], count=4)
    bad("INVALID_ARGUMENT", do="flow_lines", on="w", field=[0.0] * 9, count=4)
    bad("OUT_OF_RANGE", index=1, do="flow_lines", on="w", field=[0.0] * 302, seeds=[0, 302])
    made.append(solver("z"))  # no inner vertex, no room for two sites
    bad("UNSUPPORTED", **{"do": "quads", "on": "z", "as": "m"})
    made += [{"do": "region", "on": "s", "as": "o"}]
    bad("INVALID_ARGUMENT", do="region", on="s", **{"as": "m"}, positions=[0.0] * 9)
    bad("OUT_OF_RANGE", do="region_edit", on="o", add=[302])
    bad("NON_FINITE", do="morph", on="o", weight="nan")
    bad("NO_RECORD", do="undo_region", on="o")
    bad("EMPTY", **{"do": "detail", "as": "m", "source": "o", "target": "o"})
    bad("NO_RECORD", do="undo_vectors", on="d")
    bad("NO_RECORD", do="redo_vectors", on="d")
    bad("NO_SUCH_SITE", do="remove_vectors", on="d", sites=[0])
    bad("NO_SUCH_SITE", do="move_vectors", on="d", sites=[0], vertices=[1])
    bad("INVALID_ARGUMENT", do="move_vectors", on="d", sites=[0, 1], vertices=[1])
    bad("NO_SUCH_SITE", do="set_vectors", on="d", sites=[0], vectors=[1.0, 0.0, 0.0])
    bad("INVALID_ARGUMENT", do="set_vectors", on="d", sites=[0], vectors=[1.0])
    calls = {"s": [{"do": "add_sites", "vertices": [0], "values": [1.0]}, {"do": "remove_sites", "sites": [0]},
        {"do": "move_sites", "sites": [0], "vertices": [1]},
                   {"do": "set_values", "sites": [0], "values": [1.0]}, {"do": "edit", "add": [0],
                       "add_values": [1.0]}, {"do": "record"}, {"do": "undo"},
                   {"do": "redo"}, {"do": "solve"}, {"do": "solve_f32"}, {"do": "preview"}, {"do": "solve_at",
                       "vertices": [0]}, {"do": "report"},
                   {"do": "statistics"}, {"do": "save_factor", "as": "f"}, {"do": "clone", "as": "c"}, {"do": "pose",
                       "as": "q"}, {"do": "geodesics", "as": "h"},
                   {"do": "direction", "as": "e"}, {"do": "quads", "as": "m"}, {"do": "flow",
                       "as": "m"}, {"do": "extremities"}, {"do": "levels", "field": [0.0] * 302, "count": 2, "spacing": "HF_LEVELS_VALUE"},
                   {"do": "isolines", "field": [0.0] * 302, "levels": [0.5]}, {"do": "critical", "field": [0.0] * 302}],
             "p": [{"do": "add_handles", "regions": [[0]]}, {"do": "remove_handles", "handles": [0]},
                 {"do": "set_transforms", "handles": [0], "translations": [0.0, 0.0, 0.0]},
                   {"do": "deform"}, {"do": "handle_field", "handle": 0}, {"do": "handle_info",
                       "handle": 0}, {"do": "skin", "weight_count": 4}],
             "x": [{"do": "add_pairs", "source_regions": [[0]], "target_regions": [[0]]},
                 {"do": "remove_pairs", "pairs": [0]}, {"do": "transfer_info"},
                   {"do": "apply", "positions": [0.0] * 906}],
             "g": [{"do": "distance", "sources": [0]}], "d": [{"do": "add_vectors", "vertices": [0],
                 "vectors": [1.0, 0.0, 0.0]}, {"do": "rotate", "sites": [0], "angles": [1.0]},
                                                             {"do": "directions"}, {"do": "singularities"}, {"do": "remove_vectors", "sites": [0]}, {"do": "move_vectors", "sites": [0], "vertices": [1]},
                   {"do": "set_vectors", "sites": [0],
                       "vectors": [1.0, 0.0,
                       0.0]}, {"do": "record_vectors"}, {"do": "undo_vectors"}, {"do": "redo_vectors"},
                   {"do": "clone_vectors", "as": "e"}],
             "w": [{"do": "flow_lines", "field": [0.0] * 302, "count": 4}], "k": [{"do": "quads_info"},
                 {"do": "quad_mesh"}],
             "o": [{"do": "region_edit", "rings": 1}, {"do": "region_info"}, {"do": "region_vertices"},
                 {"do": "morph", "weight": 1.0},
                   {"do": "record_region"}, {"do": "undo_region"}, {"do": "redo_region"}]}
    for name, steps in calls.items():
        made += [{"do": "dispose", "on": name}, {"do": "dispose", "on": name}]
        for step in steps:
            bad("INVALID_HANDLE", **{**step, "on": name})
    bad("INVALID_HANDLE", **{"do": "transfer", "as": "y", "source": "s", "target": "r"})
    bad("INVALID_HANDLE", **{"do": "transfer", "as": "y", "source": "r", "target": "s"})
    return [{"name": "bad_meshes", "about": "What hf_create must refuse.", "steps": creation},
        {"name": "bad_sites", "about": "Sites and fields.", "steps": sites},
            {"name": "bad_poses", "about": "Handles and pairs.", "steps": poses}, {"name": "stale_objects",
                "about": "Calls on closed objects; closing twice.", "steps": start + made}]
