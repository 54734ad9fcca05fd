"""The Python package beyond the golden scenes: no copies, lifetime in any order, threads, memory, bad arguments."""

import copy
import ctypes
import gc
import json
import pathlib
import pickle
import random
import sys
import threading
import unittest

import numpy as np

import golden
import hf

MESHES = golden.load_meshes()
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings/generate"))
import layout


def mesh(name, dtype=np.float32):
    return np.array(MESHES[name]["positions"], dtype).reshape(-1, 3), np.array(MESHES[name]["triangles"],
        np.uint32).reshape(-1, 3)


class Repr(unittest.TestCase):
    def test_an_object_shows_its_counts_and_what_is_wrong_with_its_mesh(self):
        surface = hf.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 5, 5]], [[0, 1, 2], [0, 1, 2]])
        self.assertEqual(repr(surface), "<hf.Surface vertex_count=4 triangle_count=2 welded_vertex_count=4 component_count=1 "
            "isolated_vertex_count=1 duplicate_triangle_count=1 boundary_edge_count=3>")
        solver = hf.Solver(surface)
        solver.add_sites([0], [1.0])
        self.assertIn("site_count=1", repr(solver))
        surface.close()
        self.assertEqual(repr(surface), "<hf.Surface closed>")


class OtherPackages(unittest.TestCase):
    """The lines of bindings/python/README.md, where the packages are there."""

    def solved(self, surface):
        with hf.Solver(surface) as solver:
            solver.add_sites([0, 1], [0.0, 1.0])
            return solver.solve()

    def package(self, name):
        try:
            return __import__(name)
        except ImportError:
            self.skipTest(f"no {name} here")

    def test_trimesh(self):
        ball = self.package("trimesh").creation.icosphere(2)
        surface = hf.Surface(ball.vertices, ball.faces)
        pose = hf.Pose(surface)
        pose.add_handles([[0]])
        ball.vertices = pose.deform()
        self.assertEqual(surface.vertex_count, len(ball.vertices))

    def test_meshio(self):
        meshio = self.package("meshio")
        mesh = meshio.Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), [("triangle", np.array([[0, 1, 2]]))])
        surface = hf.Surface(mesh.points, mesh.cells_dict["triangle"])
        mesh.point_data["field"] = self.solved(surface)
        self.assertEqual(mesh.point_data["field"].shape, (3,))

    def test_pyvista(self):
        mesh = self.package("pyvista").Sphere()
        surface = hf.Surface(mesh.points, mesh.regular_faces)
        mesh["field"] = self.solved(surface)
        self.assertEqual(len(mesh["field"]), surface.vertex_count)


class Layout(unittest.TestCase):
    def test_ctypes_lays_structs_out_as_the_compiler_does(self):
        """layout.py is held against the compiler by tests/api, whose programs do not compile otherwise."""
        api = json.loads((ROOT / "bindings/api.json").read_text())
        structs = {struct.__name__: struct for struct in hf.constants.STRUCTS}
        self.assertGreater(len(structs), 20)
        for described in api["structs"]:
            size, _, offsets = layout.lay_out(api, described, ctypes.sizeof(ctypes.c_void_p))
            struct = structs[described["name"]]
            self.assertEqual(ctypes.sizeof(struct), size, described["name"])
            for name, offset in offsets.items():
                self.assertEqual(getattr(struct, name).offset, offset, f"{described['name']}.{name}")


def ball(n):
    """A cube of 6 n^2 squares, each of two triangles, on a unit sphere; the two sides of the cube's edges are one."""
    ticks = np.tan(np.linspace(-np.pi / 4, np.pi / 4, n + 1))
    grid = np.stack([*np.meshgrid(ticks, ticks, indexing="ij"), np.ones((n + 1, n + 1))], -1).reshape(-1, 3)
    turns = [np.diag(d) @ np.roll(np.eye(3), k, 0) for k in range(3) for d in ([1, 1, 1], [-1, 1, -1])]
    points, names = np.unique(np.round(np.concatenate([grid @ t for t in turns]), 9), axis=0, return_inverse=True)
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = (i * (n + 1) + j).ravel()
    cells = np.concatenate([np.stack([a, a + n + 1, a + n + 2], 1), np.stack([a, a + n + 2, a + 1], 1)])
    triangles = np.concatenate([cells + k * (n + 1) ** 2 for k in range(6)])
    return points / np.linalg.norm(points, axis=1)[:, None], names.ravel()[triangles].astype(np.uint32)


class Poles(unittest.TestCase):
    def setUp(self):
        self.points, self.triangles = ball(24)
        self.edge = np.sqrt(4 * np.pi / 1500)
        self.options = {"face_count": 1500, "relax_count": hf.NO_INDEX}
        self.quads = hf.Quads(hf.Surface(self.points, self.triangles), **self.options)

    def off(self, place, count):
        mesh = self.quads.mesh()
        edges = np.unique(np.sort(np.stack([mesh.faces, np.roll(mesh.faces, 1, 1)], -1).reshape(-1, 2), 1), axis=0)
        found = mesh.positions[np.bincount(edges.ravel()) == count]
        return np.linalg.norm(found - place, axis=1).min() / self.edge if len(found) else np.inf

    def test_the_irregular_vertex_is_within_an_edge_of_the_place_wherever_that_is(self):
        random = np.random.default_rng(3)
        for count in (3, 5):
            plain, held = [], []
            for _ in range(12):
                place, direction = random.normal(size=3), random.normal(size=3)
                place /= np.linalg.norm(place)
                self.quads.update(**self.options)
                plain.append(self.off(place, count))
                self.quads.update(irregular_points=[place], irregular_valences=[count], irregular_directions=[direction], **self.options)
                held.append(self.off(place, count))
            self.assertLess(max(held), 1, (count, held))
            self.assertGreater(np.median(plain), 2, (count, plain))

    def test_what_cannot_be_is_refused_by_name(self):
        place = self.points[3]
        for word, error, options in (
                ("irregular_valences[1]", hf.InvalidArgumentError, {"irregular_points": [place, place], "irregular_valences": [3, 4]}),
                ("irregular_points[0]", hf.NonFiniteError, {"irregular_points": [place * np.nan], "irregular_valences": [3]}),
                ("irregular_points", hf.InvalidArgumentError, {"irregular_points": [place[:2]], "irregular_valences": [3]}),
                ("irregular_directions[0]", hf.NonFiniteError,
                 {"irregular_points": [place], "irregular_valences": [5], "irregular_directions": [[np.inf, 0, 0]]}),
                ("irregular_points", hf.HfError, {"irregular_valences": [3]}),
                ("irregular_valences", hf.HfError, {"irregular_points": [place]})):
            with self.subTest(word=word):
                before = self.quads.mesh().positions
                with self.assertRaises(error) as caught:
                    self.quads.update(**options)
                self.assertIn(word, str(caught.exception))
                np.testing.assert_array_equal(self.quads.mesh().positions, before)


class Arrays(unittest.TestCase):
    def test_inputs_and_outputs_are_used_in_place(self):
        points, triangles = mesh("torus")
        rows = np.zeros((len(points), 8), np.float32)  # interleaved: xyz, normal, field, one spare
        rows[:, :3] = points
        surface = hf.Surface(rows[:, :3], triangles)
        with hf.Solver(surface) as solver, hf.Solver(hf.Surface(points, triangles)) as packed:
            for s in (solver, packed):
                s.add_sites([0, 100], [0.0, 1.0])
            out = rows[:, 6]
            self.assertIs(solver.solve(out), out)
            np.testing.assert_array_equal(rows[:, 6], packed.solve())
            np.testing.assert_array_equal(rows[:, 7], 0)
            with hf.Pose(surface) as pose:
                pose.add_handles([[0, 1], [140, 141]])
                posed, normals = rows[:, :3], rows[:, 3:6]
                pose.deform(posed, normals=normals)
                np.testing.assert_allclose(posed, points, atol=1e-5)
                np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
            np.testing.assert_array_equal(rows[:, 7], 0)

    def test_channels(self):
        points, triangles = mesh("torus")
        with hf.Solver(hf.Surface(points, triangles), channel_count=3) as solver:
            solver.add_sites([0, 100], [[0, 1, 2], [1, 1, 0]])
            field = solver.solve()
            self.assertEqual(field.shape, (len(points), 3))
            np.testing.assert_allclose(field[:, 1], 1, atol=1e-6)
            np.testing.assert_allclose(field[:, 2], 2 - 2 * field[:, 0], atol=1e-5)
            self.assertEqual(solver.solve_vectors().shape, (len(points), 3))
            solver.rotate_vectors([0], [np.pi])
            solver.move_vectors([0], [20])
            self.assertEqual(solver.add_site(200, [1, 2, 3]), 2)
            np.testing.assert_array_equal(solver.sites().values[2], [1, 2, 3])
            with self.assertRaises(hf.InvalidArgumentError):
                solver.add_site(201, [1, 2])

    def test_triangles_of_16_bits_are_used_in_place(self):
        points, triangles = mesh("torus")
        rows = np.full((len(triangles), 5), 0xFFFF, np.uint16)
        rows[:, :3] = triangles
        desc = hf._api._surface_desc(held := hf._library.Call(), positions=points, triangles=rows[:, :3])
        self.assertTrue(any(np.shares_memory(part, rows) for part in held.keep if isinstance(part, np.ndarray)))
        view = desc.triangles
        self.assertEqual((view.data, view.stride, view.type), (hf._library.address(rows), 10, hf._raw.HF_TYPE_UINT16))
        fields = []
        for given in (triangles, triangles.astype(np.int64), triangles.astype(np.uint16), rows[:, :3]):
            solver = hf.Solver(hf.Surface(points, given))
            solver.add_sites([0, 100], [0.0, 1.0])
            fields.append(solver.solve(dtype=np.float64))
            np.testing.assert_array_equal(fields[0], fields[-1])

    def test_faces_as_hosts_store_them(self):
        points, _ = mesh("torus")
        around = next(k for k in range(3, len(points)) if len(points) % k == 0 and k * k >= len(points))
        rings = len(points) // around
        i, j = np.meshgrid(np.arange(around), np.arange(rings))
        at = lambda a, b: (b % rings) * around + a % around
        quads = np.stack([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], -1).reshape(-1, 4)
        offsets = np.arange(0, 4 * len(quads) + 1, 4)
        fields = []
        for faces in (quads, quads.astype(np.uint32), (offsets, quads), (None, np.full(len(quads), 4), quads.ravel()),
                      (offsets[:-1].astype(np.int32), np.full(len(quads), 4, np.int32), quads)):
            with hf.Surface(points, faces=faces) as surface, hf.Solver(surface) as solver:
                self.assertEqual((surface.info.face_count, surface.mesh_statistics.polygon_count), (len(quads), len(quads)))
                solver.add_sites([0, 100], [0.0, 1.0])
                fields.append(solver.solve(dtype=np.float64))
                np.testing.assert_array_equal(fields[0], fields[-1])
                hit = surface.cast_ray(points[quads[7]].mean(0) * 3, -points[quads[7]].mean(0))
                corners, weights = list(hit.place.corners), list(hit.place.barycentrics)
                self.assertTrue(set(corners) <= set(quads[hit.triangle]))
                np.testing.assert_allclose(np.dot(weights, points[corners]), hit.position, atol=1e-6)
                solver.add_sites(places=[(corners, weights)], values=[2.0])
                np.testing.assert_allclose(np.dot(weights, solver.solve(dtype=np.float64)[corners]), 2, atol=1e-12)
        for wrong in (quads[:, :2], (offsets,), (None, quads), "text", (offsets, offsets, quads), quads + len(points),
                      (np.zeros(3, int), quads), (None, None, quads), (None, [4, 4], None)):
            with self.assertRaises(hf.HfError):
                hf.Surface(points, faces=wrong)
        with self.assertRaises(hf.InvalidArgumentError):
            hf.Surface(points, [[0, 1, 2]], faces=quads)

    def test_wrong_arrays_are_refused(self):
        points, triangles = mesh("torus")
        surface = hf.Surface(points, triangles)
        solver = hf.Solver(surface)
        solver.add_sites([0], [1.0])
        frozen = np.zeros(len(points), np.float32)
        frozen.flags.writeable = False
        cases = [lambda: hf.Surface(points[:, :2], triangles), lambda: hf.Surface("text", triangles),
                 lambda: hf.Surface(points, "text"), lambda: hf.Surface(points, triangles + 0.5),
                 lambda: hf.Surface(points, triangles[:, :2]), lambda: hf.Surface(points, [-1, 0, 1]),
                 lambda: hf.Surface(points, triangles, thread_count="many"),
                 lambda: hf.Surface(points * np.nan, triangles),
                 lambda: hf.Surface(points, triangles, saved_factor=b""),
                 lambda: hf.Surface(points, triangles, saved_factor=b"short"),
                 lambda: surface.save(9), lambda: surface.cast_ray([0, 0], [0, 0, 1]),
                 lambda: surface.cast_ray([0, 0, 9], [0, 0, 0]), lambda: surface.cast_ray(None, [0, 0, 1]),
                 lambda: surface.cast_ray([0, 0, 9], [0, 0, -1], positions=points[:5]),
                 lambda: surface.find_vertex("abc"), lambda: surface.find_vertex([np.nan, 0, 0]),
                 lambda: hf.Solver(None), lambda: hf.Solver(solver), lambda: hf.Solver(points),
                 lambda: hf.Solver(surface, field_kind=9),
                 lambda: solver.solve(np.zeros(3, np.float32)),
                 lambda: solver.solve(np.zeros(len(points), np.int32)), lambda: solver.solve(frozen),
                 lambda: solver.solve([0.0] * len(points)),
                 lambda: solver.solve(np.zeros(len(points), np.float32)[::-1]),
                 lambda: solver.add_sites([1.5], [0.0]), lambda: solver.add_sites([-1], [0.0]),
                 lambda: solver.add_sites([1], ["x"]), lambda: solver.add_sites([1], [object()]),
                 lambda: solver.add_site(-1), lambda: solver.add_site(1.5), lambda: solver.add_site(1, "x"),
                 lambda: hf.Pose(None), lambda: hf.Pose(3), lambda: hf.Pose(solver), lambda: hf.Pose(hf.Progress()),
                 lambda: hf.Transfer(surface, None), lambda: hf.Geodesics("s"), lambda: hf.Direction(None),
                 lambda: hf.Region(surface, base=9)]
        for number, case in enumerate(cases):
            with self.assertRaises(hf.HfError, msg=f"case {number}") as caught:
                case()
            self.assertTrue(caught.exception.message, f"case {number}")
        np.testing.assert_allclose(solver.solve(), 1, atol=1e-6)


class Refusals(unittest.TestCase):
    """What numpy, ctypes or pickle would take without a word."""

    def setUp(self):
        self.points, self.triangles = mesh("torus")
        self.surface = hf.Surface(self.points, self.triangles)
        self.solver = hf.Solver(self.surface)
        self.solver.add_sites([0, 100], [0.0, 1.0])

    def refused(self, case, *words):
        with self.assertRaises(hf.HfError) as caught:
            case()
        for word in words:
            self.assertIn(word, caught.exception.message)

    def everything(self):
        region = hf.Region(self.surface)
        region.edit(add_vertices=[0, 1, 2, 12, 13, 14])
        rest = np.array([[*place, 0, 0, 0, 1, 1, 1, 1] for place in ([0, 1, 0], [0.1, -0.1, 0], [0, -0.4, 0], [-0.1, -0.1, 0], [0, -0.4, 0])], np.float32)
        man = hf.Skeleton(["hips", "left_thigh", "left_shin", "right_thigh", "right_shin"], [hf.NO_INDEX, 0, 1, 0, 3], rest)
        return [man, hf.Retarget(man, man), self.surface, self.solver, hf.Pose(self.surface), hf.Transfer(self.surface, self.surface),
                hf.Geodesics(self.surface), hf.Direction(self.surface), region, hf.Detail(region, region.clone()),
                hf.Flow(self.surface), hf.Quads(self.surface, edge_length=1.0), hf.Progress(),
                hf.Weights(self.surface, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])]

    def test_weights_are_carried_mirrored_and_helpers_named(self):
        n = 17
        x, y = np.meshgrid(np.linspace(-2, 2, n), np.linspace(0, 2, n))
        points = np.stack([x.ravel(), y.ravel(), np.zeros(n * n)], 1)
        first = np.array([i * n + j for i in range(n - 1) for j in range(n - 1)])
        faces = np.concatenate([np.stack([first, first + 1, first + n + 1], 1),
                                np.stack([first, first + n + 1, first + n], 1)])
        surface, other = hf.Surface(points, faces), hf.Surface(points[:, [0, 1, 2]] + [0, 0, 0.05], faces)
        heads = [[0, 0, 0], [1, 1, 0], [-1, 1, 0]]
        weights = hf.Weights(surface, heads, tails=np.array(heads) + [0, 0.5, 0], parents=[-1, 0, 0])
        self.assertEqual(weights.helpers(["root", "arm.L", "arm.R"])[0] & hf.HelperReason.NAME_ROOT, 2)
        self.assertEqual(weights.helpers()[0] & hf.HelperReason.NAME_ROOT, 0)
        found = weights.get()
        info = hf.WeightsTransferInfo()
        carried = hf.Weights.transfer(surface, other, found.joints, found.weights, info=info)
        plain = hf.Weights.transfer(surface, other, found.joints, found.weights, influence_count=0)  # 0: 4
        np.testing.assert_array_equal(plain.weights, carried.weights)
        self.assertEqual(info.matched_count, n * n)
        np.testing.assert_allclose(carried.weights.sum(1), 1, atol=0)
        np.testing.assert_allclose(carried.weights[:, 0], found.weights[:, 0], atol=1e-6)
        kept = np.where((points[:, 0] < -0.01)[:, None], 0, found.weights)
        info = hf.WeightsMirrorInfo()
        mirrored, partners, pairings = hf.Weights.mirror(surface, heads, ["root", "arm.L", "arm.R"], joints=found.joints,
            weights=kept, info=info)
        self.assertEqual(list(partners), [0, 2, 1])
        self.assertEqual(list(pairings), [hf.MirrorPairing.CENTRE, hf.MirrorPairing.NAMED, hf.MirrorPairing.NAMED])
        np.testing.assert_allclose(info.normal, [1, 0, 0], atol=1e-9)
        np.testing.assert_allclose(mirrored.weights.sum(1), 1, atol=0)
        left, right = [j * n + 3 for j in range(n)], [j * n + n - 4 for j in range(n)]
        self.assertTrue((mirrored.joints[left, 0] == partners[mirrored.joints[right, 0]]).all())
        with self.assertRaises(hf.InvalidArgumentError):
            hf.Weights.transfer(surface, other, found.joints[1:], found.weights[1:])
        with self.assertRaises(hf.InvalidArgumentError):
            weights.helpers(["root"])

    def test_objects_refuse_pickling_by_name(self):
        things = self.everything()
        self.assertEqual({type(thing) for thing in things}, {thing for thing in vars(hf).values() if isinstance(thing, type) and issubclass(thing, hf._library.Object)})
        for thing in things:
            for protocol in range(pickle.HIGHEST_PROTOCOL + 1):
                with self.assertRaisesRegex(TypeError, f"hf.{type(thing).__name__} cannot be pickled"):
                    pickle.dumps(thing, protocol)
            with self.assertRaisesRegex(TypeError, "cannot be pickled"):
                pickle.dumps({"deep": [thing]})

    def test_objects_are_cloned_or_refuse_copying_by_name(self):
        for thing in self.everything():
            for make in (copy.copy, copy.deepcopy, lambda t: copy.deepcopy([t])[0]):
                if hasattr(thing, "clone"):
                    twin = make(thing)
                    self.assertNotEqual(twin.raw_handle, thing.raw_handle)
                    twin.close()
                else:
                    with self.assertRaisesRegex(TypeError, f"hf.{type(thing).__name__} cannot be copied"):
                        make(thing)
            self.assertFalse(thing.closed)
        np.testing.assert_array_equal(copy.copy(self.solver).solve(), self.solver.solve())

    def test_options_are_checked_for_range(self):
        surface, solver = self.surface, self.solver
        make = {"Surface": lambda **o: hf.Surface(self.points, self.triangles, **o),
                "Solver": lambda **o: hf.Solver(surface, **o), "Pose": lambda **o: hf.Pose(surface, **o),
                "Transfer": lambda **o: hf.Transfer(surface, surface, **o),
                "Quads": lambda **o: hf.Quads(surface, **o), "Direction": lambda **o: hf.Direction(surface, **o),
                "extremities": lambda **o: surface.find_extremities(**o)}
        counts = {"Surface": "thread_count", "Solver": "site_limit", "Pose": "band_count", "Transfer": "cluster_count",
                  "Quads": "relax_count", "Direction": "site_limit", "extremities": "source_count"}
        for kind, option in counts.items():
            for wrong in (2**32, 2**32 + 1, 2**64, -1, -2**32, 1.0, 1.5, float("nan"), True, "1", None, [1], 1j,
                          np.float32(1), np.array([1, 2])):
                with self.subTest(kind=kind, wrong=wrong):
                    self.refused(lambda: make[kind](**{option: wrong}), option)
            for right in (4, np.uint8(4), np.int64(4), np.uint64(4)):
                make[kind](**{option: right})
        for option in ("operator_kind", "field_kind", "weld", "ordering"):
            for wrong in (2**32, 2**31, -2**31 - 1, 0.5, float("nan"), "0"):
                self.refused(lambda: make["Surface"](**{option: wrong}), option)
        for wrong in ("1", None, 1j, True, np.array([1.0, 2.0]), [1.0]):
            self.refused(lambda: make["Surface"](weld_tolerance=wrong), "weld_tolerance")
        for wrong in (float("nan"), float("inf"), -1.0, 1e300, 10**400):
            self.refused(lambda: make["Surface"](weld=hf.Weld.TOLERANCE, weld_tolerance=wrong))
        for inner in ("positions_f64", "stride", "vertex_count", "struct_size", "threads"):
            with self.assertRaisesRegex(TypeError, inner):
                make["Surface"](**{inner: 12345})
        with self.assertRaisesRegex(TypeError, "positions_f64"):
            hf.Pose(surface).deform(positions_f64=12345)
        pose = hf.Pose(surface)
        pose.add_handles([[0, 1], [140, 141]])
        pose.add_handles([[70, 71]], in_place=True)
        pose.deform(restart=True, refine=False)  # flags are bools
        for wrong in (2, -1, 0.5, "1", None):
            self.refused(lambda: pose.add_handles([[90]], in_place=wrong), "in_place")

    def test_numbers_are_checked_for_range(self):
        surface, solver, region = self.surface, self.solver, hf.Region(self.surface)
        flow, field = hf.Flow(surface), solver.solve()
        region.edit(add_vertices=[0, 1, 2])
        wrongs = (2**32, -1, 1.5, float("nan"), "1", None, True)
        for wrong in wrongs:
            for case in (lambda: surface.save(wrong), lambda: surface.space_levels(field, wrong),
                         lambda: surface.space_levels(field, 3, wrong), lambda: region.vertices(wrong),
                         lambda: region.edit(curve={"vertices": [0, 1, 2, 14], "seed_vertex": wrong}),
                         lambda: solver.solve_preview(correction_count=wrong), lambda: solver.add_site(wrong),
                         lambda: flow.trace(field, wanted_count=wrong), lambda: hf.Pose(surface).skin(wrong),
                         lambda: hf.Direction(surface, degree=wrong), lambda: hf.Pose(surface).handle(wrong)):
                self.refused(case)
        for wrong in ("1", None, 1j, True, [0.5]):
            for case in (lambda: region.morph(wrong), lambda: solver.certify(wrong),
                         lambda: hf.Geodesics(surface, smoothing=wrong),
                         lambda: hf.Pose(surface).add_handle_at([0, 0, 0], wrong)):
                self.refused(case)
        for wrong in (2**31, 0.5, "1", None):
            self.refused(lambda: region.edit(ring_count=wrong), "ring_count")
            self.refused(lambda: region.edit(curve={"vertices": [0, 1, 2, 14], "kind": wrong}), "kind")
            self.refused(lambda: hf.Region(surface, base=wrong), "base")
        self.refused(lambda: hf.Quads(surface, crease_edges=[0, 2**40]), "crease_edges")

    def test_arrays_that_numpy_would_convert_are_refused_by_name(self):
        points, triangles, solver = self.points, self.triangles, self.solver
        mask = np.zeros(points.shape, bool)
        mask[7, 1] = True
        swapped = "<" if np.dtype("=f4").newbyteorder("S").str[0] == "<" else ">"
        positions = {"masked": np.ma.array(points, mask=mask), "complex": points + 1j, "object": points.astype(object),
                     swapped: points.astype(np.float64).astype(f"{swapped}f8"), "bool": points > 0, "str": points.astype(str),
                     "datetime64": points.astype("datetime64[s]")}
        for word, wrong in positions.items():
            self.refused(lambda: hf.Surface(wrong, triangles), "positions", word if word != "str" else "<U")
            self.refused(lambda: self.surface.cast_ray([0, 0, 9], [0, 0, -1], positions=wrong), "positions")
        with self.assertRaises(hf.HfError) as caught:
            hf.Surface(positions["masked"], triangles)
        self.assertEqual(caught.exception.index, 22)
        self.refused(lambda: hf.Surface(list(positions["masked"]), triangles), "masked")
        hf.Surface(np.ma.array(points), triangles)  # nothing of it is masked
        for wrong in (np.ma.array(triangles, mask=triangles == 5), triangles + 1j, triangles.astype(object),
                      triangles.astype(f"{swapped}u4"), triangles > 0, triangles.astype(np.float32), [[0, 1, 2**70]]):
            self.refused(lambda: hf.Surface(points, wrong), "triangles")
        for wrong in (np.ma.array([0.0, 1.0], mask=[False, True]), [1j, 0], np.array([0, 1], f"{swapped}f8"),
                      np.array([0, 1], object), ["0", "1"], [None, 1.0], [[0.0], [1.0, 2.0]]):
            self.refused(lambda: solver.add_sites([5, 6], wrong), "values")
            self.refused(lambda: solver.set_values([0, 1], wrong), "values")
        field = np.zeros(len(points))
        for wrong in (field + 1j, np.ma.array(field, mask=field == 0), field.astype(f"{swapped}f8"), field.astype(object)):
            self.refused(lambda: self.surface.trace_isolines(wrong, [0.5]), "field")
        for wrong in (field.astype(f"{swapped}f8"), field + 1j, np.ma.array(field), field.astype(object)):
            self.refused(lambda: solver.solve(wrong), "out")
        np.testing.assert_array_equal(solver.sites().values.ravel(), [0, 1])


class Regions(unittest.TestCase):
    def test_a_region_is_edited_morphed_and_undone(self):
        points, triangles = mesh("torus", np.float64)
        surface = hf.Surface(points, triangles)
        with hf.Region(surface, points) as region:
            region.edit(add_vertices=[0, 1, 2, 12, 13, 14])
            np.testing.assert_array_equal(region.vertices(), [0, 1, 2, 12, 13, 14])
            region.record()
            region.edit(ring_count=2)
            grown = set(region.vertices())
            self.assertTrue({0, 1, 2, 12, 13, 14} < grown)
            self.assertFalse(grown & set(region.vertices(hf.RegionList.RIM)))
            np.testing.assert_array_equal(region.morph(0.0, dtype=np.float64), points)  # bit for bit
            base, half = region.morph(1.0, dtype=np.float64), region.morph(0.5, dtype=np.float64)
            np.testing.assert_allclose(half, 0.5 * (points + base), atol=1e-12)
            outside = np.setdiff1d(np.arange(len(points)), sorted(grown))
            np.testing.assert_array_equal(base[outside], points[outside])
            # the base is harmonic: its area is the smaller, and onto itself the detail gives the surface back
            self.assertLess(region.info.base_area, region.info.area)
            with hf.Detail(region, region.clone()) as detail:
                np.testing.assert_allclose(detail.morph(1.0, dtype=np.float64), points, atol=1e-6)
            region.undo()
            np.testing.assert_array_equal(region.vertices(), [0, 1, 2, 12, 13, 14])
            region.redo()
            self.assertEqual(set(region.vertices()), grown)
            self.assertEqual(region.statistics.factorisation_count, 0)
            region.edit(curve=[int(v) for v in (0, 1, 2, 3, 15, 27, 39, 38, 37, 36, 24, 12)])
            self.assertTrue({13, 14, 25, 26} <= set(region.vertices()))
            for wrong in (lambda: region.edit(add_vertices=[288]), lambda: region.edit(curve=[0]), lambda: region.morph(np.nan),
                          lambda: hf.Region(None), lambda: hf.Region(surface, points[:5]), lambda: hf.Detail(region, None),
                          lambda: region.vertices(9), lambda: region.morph(1.0, np.zeros(3, np.float32))):
                with self.assertRaises(hf.HfError):
                    wrong()
        with self.assertRaises(hf.InvalidObjectError):
            region.edit(ring_count=1)


class Given(unittest.TestCase):
    """What a method takes beside arrays: records of the library, structs to fill, descs inside descs, arrays to fill."""

    def setUp(self):
        points, triangles = mesh("torus")
        self.points = np.concatenate([points, points + [0, 0, 1.05 * np.ptp(points[:, 2])]]).astype(np.float32)
        self.surface = hf.Surface(self.points, np.concatenate([triangles, triangles + len(points)]), link_pieces=True)

    def test_links_are_written_changed_and_given_back(self):
        links = self.surface.links()
        self.assertEqual(len(links), self.surface.links_info.link_count)
        self.assertGreater(len(links), 1)
        again = self.surface.relink(mode=hf.LinkMode.LIST, links=links)
        np.testing.assert_array_equal(again.links()["vertex"], links["vertex"])
        self.assertIs(type(again), hf.Surface)
        one = hf.Surface(self.points, np.concatenate([mesh("torus")[1], mesh("torus")[1] + len(self.points) // 2]),
                         links={"mode": hf.LinkMode.LIST, "links": links[:1]})
        self.assertEqual(one.links_info.link_count, 1)
        with self.assertRaisesRegex(hf.InvalidArgumentError, "links must be records"):
            self.surface.relink(mode=hf.LinkMode.LIST, links=[[0, 1]])

    def test_links_come_in_and_go_out_by_an_edit(self):
        """The second torus follows while links hold it."""
        links = self.surface.links()
        solver = hf.Solver(self.surface)
        solver.add_sites([0, 150], [0, 1])
        held = solver.solve()
        parted = self.surface.edit(removed_links=range(len(links)))
        self.assertEqual(parted.links_info.link_count, 0)
        self.assertEqual(parted.report.component_count, self.surface.report.component_count + 1)
        solver.move_to(parted)
        np.testing.assert_array_equal(solver.solve()[len(self.points) // 2:], 0)
        joined = parted.edit(links=links[:2])
        np.testing.assert_array_equal(joined.links()["vertex"], links["vertex"][:2])
        solver.move_to(joined.edit(links=links[2:]))
        np.testing.assert_allclose(solver.solve(), held, atol=1e-10)
        with self.assertRaisesRegex(hf.NotFoundError, "entry 1 of removed_links is 2; the surface has 2 links") as caught:
            joined.edit(removed_links=[1, 2])
        self.assertEqual(caught.exception.index, 1)

    def test_a_list_of_vertices_is_edited_on_a_mesh_of_more(self):
        """The desc counts its list as the surface counts its vertices: both are vertex_count."""
        solver = hf.Solver(self.surface)
        solver.add_sites([0, 150], [0, 1])
        before = solver.solve()
        belt = [3, 4, 5]
        edited = self.surface.edit(belt, [1e4, 1e4, 1e4])
        np.testing.assert_array_equal(np.flatnonzero(edited.stiffness() != 1), belt)
        np.testing.assert_array_equal(self.surface.edit(belt, 1e4).stiffness(), edited.stiffness())
        solver.move_to(edited)
        self.assertEqual(len(solver.solve()), len(self.points))
        self.assertGreater(np.abs(solver.solve() - before).max(), 1e-3)
        whole = self.surface.edit(stiffness=np.full(len(self.points), 2.0))
        np.testing.assert_array_equal(whole.stiffness(), 2)
        np.testing.assert_array_equal(whole.edit(belt, [1, 1, 1]).stiffness()[[2, 3]], [2, 1])
        with self.assertRaises(hf.InvalidArgumentError):
            self.surface.edit(stiffness=[2.0, 2.0])
        with self.assertRaisesRegex(hf.InvalidArgumentError, r"stiffness must have the shape \(3\), not \(2,\)"):
            self.surface.edit(belt, [1, 2])

    def test_structs_and_arrays_are_filled_when_given(self):
        gaps, opened = hf.GapsInfo(), self.points.copy()
        opened[len(opened) // 2:, 2] += 1
        found = self.surface.measure_gaps(opened, info=gaps)
        self.assertEqual((len(found), found.max()), (gaps.link_count, gaps.worst))
        self.assertIn("worst_link=", repr(gaps))
        with self.assertRaisesRegex(hf.InvalidArgumentError, "info must be a"):
            self.surface.measure_gaps(opened, info=hf.SolveInfo())
        field = np.zeros(len(self.points))
        tips = self.surface.find_extremities(field=field)
        self.assertGreater(np.ptp(field), 0)
        self.assertTrue(set(tips["vertex"]) <= set(range(len(field))))
        solver, normals = hf.Solver(self.surface, channel_count=3), np.zeros((len(self.points), 3))
        solver.add_sites([0], [[1, 0, 0]])
        solver.solve_vectors(normals=normals)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
        flat, axes = hf.Geodesics(self.surface).map(0)
        self.assertEqual((flat.shape, axes.shape, flat[0].tolist()), ((len(self.points), 2), (6,), [0, 0]))

    def test_a_batch_of_edits_takes_descs_as_dicts_or_lists(self):
        solver = hf.Solver(self.surface)
        first, second = solver.add_sites([0, 40], [0.0, 1.0])
        added = solver.edit_sites(remove_sites=[first], move_sites=[second], move_to=[41], add={"vertices": [7, 9], "values": [2.0, 3.0]})
        np.testing.assert_array_equal(solver.sites().vertices[np.argsort(solver.sites().vertices)], [7, 9, 41])
        self.assertEqual(len(added), 2)
        with self.assertRaises(TypeError):
            solver.edit_sites(add={"vertexes": [1]})

    def test_the_room_for_what_grows_is_found(self):
        field = self.points[:, 2].astype(np.float64)
        few = self.surface.trace_isolines(field, np.linspace(field.min(), field.max(), 5)[1:-1])
        many = self.surface.trace_isolines(field, np.linspace(field.min(), field.max(), 402)[1:-1])  # beyond the first room
        self.assertGreater(len(many.positions), 1024)
        self.assertEqual([len(line) for line in few.lines()], np.diff(few.line_starts).tolist())
        self.assertEqual((few.line_closed.dtype, many.line_starts[-1]), (bool, len(many.positions)))


class Picking(unittest.TestCase):
    def test_a_click_becomes_a_site_and_a_handle(self):
        points, triangles = mesh("torus")
        surface = hf.Surface(points, triangles)
        hit = surface.cast_ray([9, 0.3, 0.2], [-2, 0, 0])
        np.testing.assert_allclose(np.dot(hit.place.barycentrics, points[list(hit.place.corners)]), hit.position, atol=1e-12)
        self.assertIn(hit.vertex, triangles[hit.triangle])
        np.testing.assert_allclose(9 - 2 * hit.distance, hit.position[0], atol=1e-12)
        self.assertIsNone(surface.cast_ray([9, 0, 0], [1, 0, 0]))
        solver = hf.Solver(surface)
        solver.add_sites(places=[hit], values=[2.0])
        solver.add_site(150)
        np.testing.assert_allclose(np.dot(hit.place.barycentrics, solver.solve(dtype=np.float64)[list(hit.place.corners)]), 2)
        pose = hf.Pose(surface)
        self.assertEqual([pose.add_handle_at(hit.position, 0.5), pose.add_handle_at([-4, 0, 0], 0.5)], [0, 1])
        pose.set_transform(0, translation=[1, 0, 0])
        posed = pose.deform()
        moved = surface.cast_ray([9, 0.3, 0.2], [-2, 0, 0], positions=posed)
        self.assertLess(moved.distance, hit.distance)
        vertex, distance = surface.find_vertex(posed[hit.vertex], positions=posed)
        self.assertEqual((vertex, distance), (hit.vertex, 0.0))
        self.assertEqual(pose.info.handle_count, 2)


class Lifetime(unittest.TestCase):
    def test_a_graph_carries_fields_and_says_what_needs_triangles(self):
        edges = np.array([[0, 1], [1, 2], [2, 3], [5, 4]])
        surface = hf.Surface.from_graph(edges, [1, 1, 2, 7], masses=np.arange(1, 7), vertex_count=6)
        self.assertEqual(surface.info.operator_kind, hf.Operator.GRAPH)
        self.assertEqual(surface.components().tolist(), [0, 0, 0, 0, 1, 1])
        solver = hf.Solver(surface)
        solver.add_sites([0, 3], [0.0, 5.0])
        self.assertTrue(np.allclose(solver.solve(dtype=np.float64), [0, 2, 4, 5, 0, 0]))
        loaded = hf.Surface.from_graph(edges, [1, 1, 2, 7], vertex_count=6, saved_factor=surface.save())
        self.assertEqual(loaded.statistics.factor_loaded, 1)
        with self.assertRaises(hf.UnsupportedError):
            hf.Pose(surface)
        with self.assertRaises(hf.OutOfRangeError) as raised:
            hf.Surface.from_graph(edges, [1, 1, 2, 7], vertex_count=5)
        self.assertEqual(raised.exception.index, 3)
        for wrong in ({"weights": [1, 1, 2]}, {"weights": [1, 1, 2, -1]}, {"masses": [1, 2]}):
            with self.assertRaises(hf.InvalidArgumentError):
                hf.Surface.from_graph(**{"vertex_count": 6, "edges": edges, "weights": [1, 1, 2, 7], **wrong})
        hf.Surface.from_graph(edges, [1, 1, 2, 7], vertex_count=6, allow_negative=True).close()

    def test_any_order_of_closing_and_collecting(self):
        points, triangles = mesh("bar")
        calls = 0
        for seed in range(120):
            draw = random.Random(seed)
            surface = hf.Surface(points, triangles)
            solver = hf.Solver(surface)
            solver.add_sites([0, 287], [0.0, 1.0])
            things = [solver, solver.clone(), hf.Pose(surface), hf.Transfer(surface, surface), hf.Geodesics(surface),
                hf.Progress(), surface]
            things[2].add_handles([range(12), range(276, 288)])
            things.append(things[2].clone())
            del solver, surface
            draw.shuffle(things)
            while things:
                thing = things.pop()
                if draw.random() < 0.5:
                    thing.close()
                    thing.close()
                    with self.assertRaises(hf.InvalidObjectError):
                        {hf.Surface: lambda: thing.report, hf.Solver: lambda: thing.solve(), hf.Pose: lambda: thing.deform(),
                            hf.Transfer: lambda: thing.info,
                         hf.Geodesics: lambda: thing.solve([0]), hf.Progress: lambda: thing.fraction}[type(thing)]()
                    calls += 1
                elif isinstance(thing, hf.Pose):
                    self.assertEqual(thing.deform().shape, points.shape)  # whatever has gone before
                del thing
                if draw.random() < 0.2:
                    gc.collect()
        self.assertGreater(calls, 100)

    def test_memory_comes_back(self):
        points, triangles = mesh("torus")

        def resident():
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * 4096

        def work(count):
            for _ in range(count):
                surface = hf.Surface(points, triangles)
                solver = hf.Solver(surface)
                solver.add_sites([0, 100], [0.0, 1.0])
                pose = hf.Pose(surface)
                pose.add_handles([[0, 1], [140, 141]])
                pose.deform()
        if not pathlib.Path("/proc/self/statm").exists():
            self.skipTest("no /proc")
        work(30)
        before = resident()
        work(150)
        self.assertLess(resident() - before, 8 << 20)  # one round holds more than 0.5 MB: 75 MB if nothing came back

    def test_progress_and_cancel_from_another_thread(self):
        points, triangles = mesh("torus")
        progress = hf.Progress()
        progress.cancel()
        with self.assertRaises(hf.CancelledError):
            hf.Surface(points, triangles, progress=progress)
        hf.Surface(points, triangles, progress=progress).close()
        self.assertEqual(progress.fraction, 1.0)

    def test_threads_on_clones_and_on_one_surface(self):
        points, triangles = mesh("torus")
        surface = hf.Surface(points, triangles)
        solver = hf.Solver(surface)
        results, failures = {}, []

        def run(value):
            try:
                clone = solver.clone() if value % 2 else hf.Solver(surface)
                surface.cast_ray([9, 0.3, 0.2], [-2, 0, 0])
                clone.add_sites([0, 144], [0.0, float(value)])
                results[value] = [clone.solve(dtype=np.float64) for _ in range(20)][-1]
            except Exception as error:  # noqa: BLE001
                failures.append(error)
        threads = [threading.Thread(target=run, args=(i + 1,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])
        for value in (2, 3, 4):
            np.testing.assert_allclose(results[value], value * results[1], atol=1e-9)


if __name__ == "__main__":
    unittest.main()
