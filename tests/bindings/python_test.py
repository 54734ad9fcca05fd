"""The Python package beyond the golden scenes: no copies, lifetime in any order, threads, memory, bad arguments."""

import ctypes
import gc
import pathlib
import random
import re
import threading
import unittest

import numpy as np

import golden
import hf

MESHES = golden.load_meshes()
ROOT = pathlib.Path(__file__).resolve().parents[2]


def mesh(name, dtype=np.float32):
    return np.array(MESHES[name]["positions"], dtype).reshape(-1, 3), np.array(MESHES[name]["triangles"],
        np.uint32).reshape(-1, 3)


class Layout(unittest.TestCase):
    def test_sizes_and_offsets_are_the_pinned_ones(self):
        pinned = (ROOT / "tests/api/layout.txt").read_text()
        checked = 0
        for struct in hf.constants.STRUCTS:
            self.assertRegex(pinned, rf"(?m)^{struct.__name__} size {ctypes.sizeof(struct)}$")
            block = re.search(rf"^{struct.__name__} size .*\n((?:  .*\n)*)", pinned, re.M).group(1)
            for name, offset, size in re.findall(r"(\w+) at (\d+), (\d+) bytes", block):
                field = getattr(struct, name)
                self.assertEqual((field.offset, field.size), (int(offset), int(size)), f"{struct.__name__}.{name}")
                checked += 1
        self.assertGreater(checked, 200)


class Arrays(unittest.TestCase):
    def test_inputs_and_outputs_are_used_in_place(self):
        points, triangles = mesh("torus")
        rows = np.zeros((len(points), 8), np.float32)  # interleaved: xyz, normal, field, one spare
        rows[:, :3] = points
        with hf.Solver(rows[:, :3], triangles) as solver, hf.Solver(points, triangles) as packed:
            for s in (solver, packed):
                s.add_sites([0, 100], [0.0, 1.0])
            out = rows[:, 6]
            self.assertIs(solver.solve(out), out)
            np.testing.assert_array_equal(rows[:, 6], packed.solve())
            np.testing.assert_array_equal(rows[:, 7], 0)
            with hf.Pose(solver) as pose:
                pose.add_handles([[0, 1], [140, 141]])
                posed, normals = rows[:, :3], rows[:, 3:6]
                pose.deform(posed, normals=normals)
                np.testing.assert_allclose(posed, points, atol=1e-5)
                np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
            np.testing.assert_array_equal(rows[:, 7], 0)

    def test_channels(self):
        points, triangles = mesh("torus")
        with hf.Solver(points, triangles, channel_count=3) as solver:
            solver.add_sites([0, 100], [[0, 1, 2], [1, 1, 0]])
            field = solver.solve()
            self.assertEqual(field.shape, (len(points), 3))
            np.testing.assert_allclose(field[:, 1], 1, atol=1e-6)
            np.testing.assert_allclose(field[:, 2], 2 - 2 * field[:, 0], atol=1e-5)
            self.assertEqual(solver.solve_vectors().shape, (len(points), 3))
            solver.rotate_vector_sites([0], [np.pi])

    def test_wrong_arrays_are_refused(self):
        points, triangles = mesh("torus")
        solver = hf.Solver(points, triangles)
        solver.add_sites([0], [1.0])
        frozen = np.zeros(len(points), np.float32)
        frozen.flags.writeable = False
        cases = [lambda: hf.Solver(points[:, :2], triangles), lambda: hf.Solver("text", triangles),
            lambda: hf.Solver(points, "text"),
                 lambda: hf.Solver(points, triangles + 0.5), lambda: hf.Solver(points,
                     triangles[:, :2]), lambda: hf.Solver(points, [-1, 0, 1]),
                 lambda: hf.Solver(points, triangles, thread_count="many"), lambda: hf.Solver(points, triangles,
                     threads=2),
                 lambda: solver.solve(np.zeros(3, np.float32)), lambda: solver.solve(np.zeros(len(points),
                     np.int32)), lambda: solver.solve(frozen),
                 lambda: solver.solve([0.0] * len(points)), lambda: solver.solve(np.zeros(len(points),
                     np.float32)[::-1]),
                 lambda: solver.add_sites([1.5], [0.0]), lambda: solver.add_sites([-1],
                     [0.0]), lambda: solver.add_sites([1], ["x"]),
                 lambda: solver.add_sites([1],
                     [object()]), lambda: hf.Pose(None), lambda: hf.Pose(3), lambda: hf.Pose(hf.Progress()),
                 lambda: hf.Transfer(solver,
                     None), lambda: hf.Geodesics("s"), lambda: hf.Direction(None), lambda: solver.save_factor()[:0] or hf.Solver(points, triangles, saved_factor=b""),
                 lambda: hf.Solver(points, triangles, saved_factor=b"short"), lambda: hf.Solver(points * np.nan,
                     triangles)]
        for number, case in enumerate(cases):
            with self.assertRaises(hf.HfError, msg=f"case {number}") as caught:
                case()
            self.assertTrue(caught.exception.message, f"case {number}")
        np.testing.assert_allclose(solver.solve(), 1, atol=1e-6)


class Regions(unittest.TestCase):
    def test_a_region_is_edited_morphed_and_undone(self):
        points, triangles = mesh("torus", np.float64)
        solver = hf.Solver(points, triangles)
        with hf.Region(solver, points) as region:
            region.edit(add=[0, 1, 2, 12, 13, 14])
            np.testing.assert_array_equal(region.vertices(), [0, 1, 2, 12, 13, 14])
            region.record()
            region.edit(rings=2)
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
            self.assertEqual(region.info.factorisation_count, 0)
            region.edit(curve=[int(v) for v in (0, 1, 2, 3, 15, 27, 39, 38, 37, 36, 24, 12)])
            self.assertTrue({13, 14, 25, 26} <= set(region.vertices()))
            for wrong in (lambda: region.edit(add=[288]), lambda: region.edit(curve=[0]), lambda: region.morph(np.nan),
                          lambda: hf.Region(None), lambda: hf.Region(solver, points[:5]), lambda: hf.Detail(region, None),
                          lambda: region.vertices(9), lambda: region.morph(1.0, np.zeros(3, np.float32))):
                with self.assertRaises(hf.HfError):
                    wrong()
        with self.assertRaises(hf.InvalidHandleError):
            region.edit(rings=1)


class Lifetime(unittest.TestCase):
    def test_any_order_of_closing_and_collecting(self):
        points, triangles = mesh("bar")
        calls = 0
        for seed in range(120):
            draw = random.Random(seed)
            solver = hf.Solver(points, triangles)
            solver.add_sites([0, 287], [0.0, 1.0])
            things = [solver, solver.clone(), hf.Pose(solver), hf.Transfer(solver, solver), hf.Geodesics(solver),
                hf.Progress()]
            things[2].add_handles([range(12), range(276, 288)])
            things.append(things[2].clone())
            del solver
            draw.shuffle(things)
            while things:
                thing = things.pop()
                if draw.random() < 0.5:
                    thing.close()
                    thing.close()
                    with self.assertRaises(hf.InvalidHandleError):
                        {hf.Solver: lambda: thing.solve(), hf.Pose: lambda: thing.deform(),
                            hf.Transfer: lambda: thing.info,
                         hf.Geodesics: lambda: thing.distance([0]), hf.Progress: lambda: thing.fraction}[type(thing)]()
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
                solver = hf.Solver(points, triangles)
                solver.add_sites([0, 100], [0.0, 1.0])
                pose = hf.Pose(solver)
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
            hf.Solver(points, triangles, progress=progress)
        hf.Solver(points, triangles, progress=progress).close()
        self.assertEqual(progress.fraction, 1.0)

    def test_threads_on_clones(self):
        points, triangles = mesh("torus")
        solver = hf.Solver(points, triangles)
        results, failures = {}, []

        def run(value):
            try:
                clone = solver.clone()
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
