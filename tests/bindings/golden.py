"""The golden scenes (bindings/golden/README.md) run through the Python package.

usage: golden.py FILE...    each file's scenes; prints a line per scene, exits 1 when one fails
"""

import json
import math
import pathlib
import sys

import numpy as np

import hf

GOLDEN = pathlib.Path(__file__).resolve().parents[2] / "bindings" / "golden"


def numbers(values, depth=0):
    """JSON to numbers: "nan" and "inf" are spelt out."""
    if isinstance(values, list):
        return [numbers(value) for value in values]
    return float(values) if values in ("nan", "inf", "-inf") else values


def digest(array):
    """The figures of an array that every language compares."""
    a = np.asarray(array, np.float64).ravel()
    weights = np.arange(a.size) % 7 + 1
    return {"count": int(a.size), "sum": math.fsum(a), "weighted": math.fsum(a * weights), "min": float(a.min())
        if a.size else 0.0,
            "max": float(a.max()) if a.size else 0.0}


def check_array(array, expect):
    found = digest(array)
    tolerance = expect.get("tolerance", 0)
    flat = np.asarray(array, np.float64).ravel()
    assert np.isfinite(flat).all(), "not finite"
    for key in ("count", "sum", "weighted", "min", "max"):
        if key in expect:
            room = {"count": 0, "sum": tolerance * flat.size + 1e-9, "weighted": 7 * tolerance * flat.size
                + 1e-9}.get(key, tolerance)
            assert abs(found[key] - expect[key]) <= room, f"{key} is {found[key]!r}, not {expect[key]!r}"
    for place, value in zip(expect.get("at", ()), expect.get("values", ())):
        assert abs(flat[place] - value) <= tolerance, f"[{place}] is {flat[place]!r}, not {value!r}"


def check_struct(info, expect):
    for key, value in expect.items():
        if key != "tolerance":
            found = getattr(info, key)
            assert abs(found - value) <= expect.get("tolerance", 0), f"{key} is {found!r}, not {value!r}"


def place_of(numbers):
    return int(numbers[0]) if len(numbers) == 1 else (np.asarray(numbers[:3], int), numbers[3:])


def lay_out(triangles, bits, stride):
    """Rows of corners as a step asks for them; what lies between them is 255 in every byte."""
    kind = np.dtype(np.uint16 if bits == 16 else np.uint32)
    stride = stride or 3 * kind.itemsize
    rows = np.full((len(triangles) // 3, stride // kind.itemsize), -1, np.int64).astype(kind)
    rows[:, :3] = np.array(triangles, np.uint32).reshape(-1, 3)
    return rows[:, :3]


class Scene:
    def __init__(self, meshes):
        self.meshes, self.objects, self.kept = meshes, {}, {}

    def array(self, step, key, default=None):
        value = step.get(key, default)
        return self.kept[value] if isinstance(value, str) else numbers(value)

    def run(self, step):
        do, on = step["do"], self.objects.get(step.get("on"))
        get = lambda key, default=None: self.array(step, key, default)
        options = {k: getattr(hf.constants, v) if isinstance(v, str) else v for k, v in step.get("options", {}).items()}
        if do == "surface":
            mesh = self.meshes[step["mesh"]] if step["mesh"] else {"positions": None, "triangles": None}
            positions, triangles = (mesh[k] and list(mesh[k]) for k in ("positions", "triangles"))
            for key, value in step.get("positions", {}).items():
                positions[int(key)] = numbers(value)
            for key, value in step.get("triangles", {}).items():
                triangles[int(key)] = value
            if step.get("no_triangles"):
                triangles = []
            if triangles and ("index_bits" in step or "triangle_stride" in step):
                triangles = lay_out(triangles, step.get("index_bits", 32), step.get("triangle_stride", 0))
            factor = self.kept[step["factor"]] if "factor" in step else None
            if factor is not None and "damage" in step:
                factor = bytes(b ^ (1 if i == step["damage"] else 0) for i, b in enumerate(factor))
            faces = step.get("faces") and (step["faces"]["offsets"], step["faces"]["corners"])
            self.objects[step["as"]] = hf.Surface(None if positions is None else np.array(positions, np.float64),
                None if faces else triangles, faces=faces, link_pieces=bool(options.pop("link_pieces", 0)),
                tags=get("tags"), saved_factor=factor, **options)
        elif do == "graph":
            self.objects[step["as"]] = hf.Surface.from_graph(get("edges"), get("weights"), vertex_count=step["vertex_count"],
                masses=get("masses"), **options)
        elif do == "solver":
            self.objects[step["as"]] = hf.Solver(on, **options)
        elif do == "clone":
            self.objects[step["as"]] = on.clone()
        elif do == "edit_surface":
            rows = np.reshape(get("links", []), (-1, 8))
            links = np.zeros(len(rows), np.dtype(hf._raw.hf_link)) if len(rows) else None
            for link, row in zip(() if links is None else links, rows):
                link["vertex"], link["corners"], link["barycentrics"], link["weight"] = row[0], row[1:4], row[4:7], row[7]
            patch = {name: np.reshape(step[name], shape) for name, shape in (("removed_triangles", -1),
                ("new_positions", (-1, 3)), ("new_triangles", (-1, 3)), ("cut_edges", (-1, 2))) if name in step}
            self.objects[step["as"]] = on.edit(get("vertices"), get("stiffness"), links, get("removed_links"),
                patch=patch or None)
        elif do == "cut_surface":
            places = [(row[:3].astype(int), row[3:]) for row in np.reshape(get("places"), (-1, 6))]
            cut = on.trace_cut(places=places)
            self.objects[step["as"]] = on.edit(patch={name: getattr(cut, name) for name in ("removed_triangles",
                "new_positions", "new_triangles")})
            return "array", np.hstack([cut.source_triangles[:, None], cut.new_triangles,
                cut.corner_barycentrics.reshape(-1, 9)]).ravel()
        elif do == "cuts":
            return "array", np.array([list(cut) for cut in on.cuts().tolist()], float).ravel()
        elif do == "move_to":
            on.move_to(self.objects[step["to"]])
        elif do == "dispose":
            on.close()
        elif do == "add_sites":
            flat = get("places")
            places = None if flat is None else [(row[:3].astype(int), row[3:]) for row in np.reshape(flat, (-1, 6))]
            return "numbers", on.add_sites(get("vertices"), get("values"), places=places, stiffness=get("stiffness"),
                radii=get("radii"))
        elif do == "add_site":
            return "numbers", [on.add_site(step["vertex"], numbers(step.get("value", 0.0)))]
        elif do == "remove_sites":
            on.remove_sites(get("sites"))
        elif do == "move_sites":
            on.move_sites(get("sites"), get("vertices"))
        elif do == "set_values":
            on.set_values(get("sites"), get("values"))
        elif do == "edit":
            return "numbers", on.edit_sites(remove_sites=get("remove", []), move_sites=get("move", []), move_to=get("move_to"),
                set_sites=get("set", []), set_values=get("set_values"),
                add=None if "add" not in step else {"vertices": get("add"), "values": get("add_values")})
        elif do in ("record", "undo", "redo"):
            getattr(on, do)()
        elif do == "solve":
            return "array", on.solve(dtype=np.float64)
        elif do == "solve_f32":
            return "array", on.solve()
        elif do == "preview":
            return "array", on.solve_preview(dtype=np.float64, correction_count=step.get("correction_count", 0))
        elif do == "solve_at":
            return "array", on.solve_at(get("vertices"))
        elif do == "report":
            return "struct", on.report
        elif do in ("surface_info", "solver_info", "pose_info"):
            return "struct", on.info
        elif do == "components":
            return "array", on.components().astype(np.float64)
        elif do == "cast_ray":
            hit = on.cast_ray(get("origin"), get("direction"), positions=get("positions"),
                front_only=step.get("front_only", 0))
            return "array", np.array([0.0] if hit is None else [1, hit.triangle, hit.vertex, *hit.place.barycentrics,
                *hit.position, hit.distance])
        elif do == "find_vertex":
            return "array", np.array(on.find_vertex(get("point"), positions=get("positions")))
        elif do in ("statistics", "surface_statistics"):
            return "struct", on.statistics
        elif do == "certify":
            return "struct", on.certify(numbers(step.get("tolerance", 0)))
        elif do == "save":
            self.kept[step["as"]] = on.save(step.get("field_kind", 0))
        elif do == "levels":
            return "array", on.space_levels(get("field"), step["count"], getattr(hf.constants, step["spacing"]))
        elif do == "isolines":
            lines = on.trace_isolines(get("field"), get("levels"))
            if "lines" in step:
                closed = int(lines.line_closed.sum())
                assert len(lines.line_levels) == step["lines"] and closed == step["closed"], "lines"
            return "array", lines.positions
        elif do == "critical":
            points = on.find_critical_points(get("field"))
            return "array", points["index"].astype(np.float64)
        elif do == "propose":
            return "array", np.sort(on.propose_handles(**options)["vertex"].astype(np.float64))
        elif do == "extremities":
            return "array", np.sort(on.find_extremities(**options)["vertex"].astype(np.float64))
        elif do == "geodesics":
            self.objects[step["as"]] = hf.Geodesics(on, **options)
        elif do == "distance":
            return "array", on.solve(get("sources"), dtype=np.float64)
        elif do == "path":
            return "array", on.find_path(place_of(get("from")), place_of(get("to"))).positions.ravel()
        elif do == "map":
            return "array", on.map(place_of(get("centre")), step.get("radius", 0.0))[0].ravel()
        elif do == "direction":
            self.objects[step["as"]] = hf.Direction(on, **options)
        elif do == "add_vectors":
            return "numbers", on.add_sites(get("vertices"), get("vectors"))
        elif do == "rotate":
            on.rotate_sites(get("sites"), get("angles"))
        elif do == "remove_vectors":
            on.remove_sites(get("sites"))
        elif do == "move_vectors":
            on.move_sites(get("sites"), get("vertices"))
        elif do == "set_vectors":
            on.set_vectors(get("sites"), get("vectors"))
        elif do in ("record_vectors", "undo_vectors", "redo_vectors"):
            getattr(on, do.split("_")[0])()
        elif do == "clone_vectors":
            self.objects[step["as"]] = on.clone()
        elif do == "vectors":
            return "array", on.sites()[2]
        elif do == "directions":
            return "array", on.solve(dtype=np.float64)
        elif do == "singularities":
            return "array", on.singularities()["index"].astype(np.float64)
        elif do in ("quads", "update_quads"):
            if "edge_length" in step:
                options["edge_length"] = numbers(step["edge_length"])
            lists = ("crease_edges", "guide_vertices", "guide_vectors", "guide_weights", "irregular_points", "irregular_valences",
                "irregular_directions", "symmetry_plane")
            options.update({key: get(key) for key in lists})
            if do == "update_quads":
                on.update(**options)
                return "array", on.mesh().positions
            self.objects[step["as"]] = hf.Quads(on, **options)
        elif do == "quads_info":
            return "struct", on.info
        elif do == "quad_mesh":
            return "array", on.mesh().positions
        elif do == "flow":
            self.objects[step["as"]] = hf.Flow(on)
        elif do == "streamlines":
            lines = on.trace(get("field"), wanted_count=step.get("count", 0), seeds=get("seeds"))
            assert len(lines.line_ends) == step.get("lines", len(lines.line_ends)), f"{len(lines.line_ends)} lines"
            return "array", lines.positions
        elif do == "region":
            self.objects[step["as"]] = hf.Region(on, get("positions"), **options)
        elif do in ("weights", "set_joints"):
            rows = {key: np.array(get(key), np.float64).reshape(-1, 3) for key in ("heads", "tails", "axes") if key in step}
            lists = {key: get(key) for key in ("parents", "deforms", "sources") if key in step}
            if do == "weights":
                self.objects[step["as"]] = hf.Weights(on, rows.pop("heads"), **rows, **lists, **options)
            else:
                on.set_joints(rows.pop("heads"), **rows, **lists)
        elif do == "set_pins":
            count = len(get("vertices"))
            on.set_pins(get("vertices"), joints=np.reshape(get("joints"), (count, -1)), weights=np.reshape(get("weights"), (count, -1)))
        elif do == "set_locks":
            on.set_locks(get("joints"))
        elif do in ("record_weights", "undo_weights", "redo_weights"):
            getattr(on, do.split("_")[0])()
        elif do == "clone_weights":
            self.objects[step["as"]] = on.clone()
        elif do == "weights_info":
            return "struct", on.info
        elif do == "joint_flags":
            return "array", on.joints()[0].astype(np.float64)
        elif do == "helpers":
            return "array", on.helpers(get("names")).astype(np.float64)
        elif do in ("skin_weights", "transfer_weights", "mirror"):
            if do == "skin_weights":
                found = on.get()
            else:
                surface = self.objects[step.get("source", step["on"])]
                shares = np.array(get("weights"), np.float32)
                joints = np.array(get("joints"), np.uint32)
                if joints.size != shares.size or joints.size % surface.vertex_count:
                    raise hf.InvalidArgumentError("joints and weights of one length")
                given = joints.reshape(surface.vertex_count, -1), shares.reshape(surface.vertex_count, -1)
                if do == "transfer_weights":
                    found = hf.Weights.transfer(surface, on, *given)
                else:
                    found = hf.Weights.mirror(surface, np.array(get("heads")).reshape(-1, 3), get("names"), joints=given[0],
                        weights=given[1], plane=get("plane"), to=step.get("to", 0))[0]
            return "array", np.where(found.joints == step["joint"], found.weights, 0).sum(1).astype(np.float64)
        elif do == "region_edit":
            curve = {"vertices": get("curve"), "kind": step.get("curve_kind", 0)} if "curve" in step else None
            on.edit(curve=curve, ring_count=step.get("rings", 0), add_vertices=get("add"), remove_vertices=get("remove"))
        elif do == "region_info":
            return "struct", on.info
        elif do == "region_vertices":
            return "array", on.vertices(step.get("list", 0)).astype(np.float64)
        elif do == "region_curve":
            return "array", on.curve().ravel()
        elif do in ("record_region", "undo_region", "redo_region"):
            getattr(on, do.split("_")[0])()
        elif do == "morph":
            return "array", on.morph(numbers(step["weight"]), dtype=np.float64)
        elif do == "detail":
            self.objects[step["as"]] = hf.Detail(self.objects[step["source"]], self.objects[step["target"]], **options)
        elif do == "pose":
            self.objects[step["as"]] = hf.Pose(on, **options)
        elif do == "add_handles":
            return "numbers", on.add_handles(get("regions"), points=get("points"), radii=get("radii"),
                layer=step.get("layer", 0), in_place=step.get("in_place", 0))
        elif do == "add_handle_at":
            return "numbers", [on.add_handle_at(get("point"), numbers(step["radius"]))]
        elif do == "remove_handles":
            on.remove_handles(get("handles"))
        elif do == "set_transforms":
            on.set_transforms(get("handles"), get("rotations"), get("translations"))
        elif do == "set_transform":
            on.set_transform(step["handle"], get("rotation"), get("translation"))
        elif do == "deform_f32":
            return "array", on.deform()
        elif do == "deform":
            return "array", on.deform(dtype=np.float64, **options)
        elif do == "handle_field":
            return "array", on.field(step["handle"])
        elif do == "handle_info":
            return "struct", on.handle(step["handle"])
        elif do == "handle_place":
            info = on.handle(step["handle"])
            return "array", np.array([*info.rotation, *info.translation])
        elif do == "skin":
            skin = on.skin(step["influence_count"])
            assert len(skin.pivots) >= 2, f"{len(skin.pivots)} joints"
            return "array", skin.vertex_weights
        elif do == "transfer":
            self.objects[step["as"]] = hf.Transfer(self.objects[step["source"]], self.objects[step["target"]],
                **options)
        elif do == "add_pairs":
            return "numbers", on.add_pairs(get("source_regions"), get("target_regions"), get("flags"))
        elif do == "remove_pairs":
            on.remove_pairs(get("pairs"))
        elif do == "set_dials":
            on.set_dials(**options)
        elif do == "dials":
            return "struct", on.dials
        elif do == "transfer_info":
            return "struct", on.info
        elif do == "apply":
            return "array", on.apply(np.array(get("positions")), dtype=np.float64)
        else:
            raise ValueError(f"unknown step {do}")
        return None, None

    def step(self, step):
        try:
            kind, result = self.run(step)
        except hf.HfError as error:
            # of two arrays that belong together, the library names the one that is missing; golden.cpp refuses the lone one
            lone = step.get("error") == "HF_ERROR_INVALID_ARGUMENT" and error.name == "HF_ERROR_NULL_POINTER" and "is NULL" in error.message
            assert lone or error.name == step.get("error"), f"raised {error}"
            assert "index" not in step or error.index == step["index"], f"index {error.index}: {error}"
            return
        except TypeError as error:  # Python's own word for an option that there is not
            assert "unexpected keyword" in str(error) and step.get("error") == "HF_ERROR_INVALID_ARGUMENT", f"raised {error}"
            return
        assert "error" not in step, f"did not fail with {step['error']}"
        if kind == "array":
            if "expect" in step:
                check_array(result, step["expect"])
            if "same_as" in step:
                assert np.array_equal(result.ravel(),
                    self.kept[step["same_as"]].ravel()), f"differs from {step['same_as']}"
            if "keep" in step:
                self.kept[step["keep"]] = result
        elif kind == "numbers" and "numbers" in step:
            assert list(result) == step["numbers"], f"numbers {list(result)}"
        elif kind == "struct":
            check_struct(result, step.get("expect", {}))


def refuse_unknown_steps(meshes):
    """A step that the interpreter does not know fails, also where a failure is expected."""
    for step in ({"do": "nonsense"}, {"do": "nonsense", "on": "nobody", "error": "HF_ERROR_EMPTY"}):
        try:
            Scene(meshes).step(step)
        except ValueError as error:
            assert "unknown step nonsense" in str(error), error
        else:
            raise AssertionError(f"an unknown step passes: {step}")


def load_meshes():
    return {path.stem: json.loads(path.read_text()) for path in (GOLDEN / "meshes").glob("*.json")}


def main(paths):
    meshes, failed, wrong = load_meshes(), 0, 0
    refuse_unknown_steps(meshes)
    for path in paths:
        for scene in json.loads(pathlib.Path(path).read_text())["scenes"]:
            runner = Scene(meshes)
            for place, step in enumerate(scene["steps"]):
                wrong += "error" in step
                try:
                    runner.step(step)
                except (AssertionError, KeyError) as error:  # KeyError: an array that a failed step did not keep
                    failed += 1
                    print(f"FAILED {scene['name']}, step {place} ({step['do']}): {error}")
            print(f"{scene['name']}: {len(scene['steps'])} steps")
    print(f"{wrong} wrong calls answered")
    assert wrong >= 100 or len(paths) < 2, "too few wrong calls"
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or [GOLDEN / "scenes.json", GOLDEN / "bad_input.json"]))
