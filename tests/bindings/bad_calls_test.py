"""The mistakes that need no thought, for every function of the ABI, made from its description (bindings/api.json): a handle that is
NULL, destroyed, of another kind or no handle; NULL for a pointer that is needed, and for one that is not; a struct, or one that a
struct points to, of the wrong size, and one of a newer header. No refused call changes an object.

A new function is in all of them with no hand work. Calls go through ctypes, past what the package checks.
"""

import ctypes
import json
import pathlib
import unittest

import numpy as np

import hf
from hf import _library, _raw

ROOT = pathlib.Path(__file__).resolve().parents[2]
API = json.loads((ROOT / "bindings/api.json").read_text())
STRUCTS = {s["name"]: s for s in API["structs"]}
HANDLES = {h["name"] for h in API["handles"]}
CODES = {value: name for value, name in _raw.RESULT_NAMES.items()}
NULL_POINTER, INVALID_HANDLE, INVALID_DESC = "HF_ERROR_NULL_POINTER", "HF_ERROR_INVALID_OBJECT", "HF_ERROR_INVALID_DESC"
ROOM = 1 << 16  # bytes behind every pointer: more than any call on the small mesh writes
# other arguments are zeros: where the library reads those first, it refuses them first
SOONER = ("HF_ERROR_INVALID_ARGUMENT", "HF_ERROR_EMPTY")
FAR_SIZES = (0, 1, 4, 4999, 1 << 31, (1 << 32) - 1)  # no struct has one of them


def objects():
    """One of every kind, and another that is closed."""
    n = 6
    points = np.array([[i // n, i % n, (i * 7 % 5) * 0.1] for i in range(n * n)], np.float64)
    first = np.array([i * n + j for i in range(n - 1) for j in range(n - 1)])
    faces = np.concatenate([np.stack([first, first + n, first + n + 1], 1), np.stack([first, first + n + 1, first + 1], 1)])
    surface = hf.Surface(points, faces)
    region = hf.Region(surface)
    region.edit(add_vertices=[14])
    solver, pose = hf.Solver(surface), hf.Pose(surface)
    solver.add_sites([0, 35], [0.0, 1.0])
    pose.add_handles([[0, 1], [34, 35]])
    places = [[0, 1, 0], [0, 0.5, 0], [0.1, -0.1, 0], [0, -0.4, 0], [-0.1, -0.1, 0], [0, -0.4, 0]]
    rest = np.array([[*place, 0, 0, 0, 1, 1, 1, 1] for place in places], np.float32)
    man = hf.Skeleton(["hips", "spine", "left_thigh", "left_shin", "right_thigh", "right_shin"], [hf.NO_INDEX, 0, 0, 2, 0, 4], rest)
    made = {"hf_skeleton": man, "hf_retarget": hf.Retarget(man, man), "hf_surface": surface, "hf_region": region, "hf_solver": solver, "hf_pose": pose, "hf_progress": hf.Progress()}
    makers = {"hf_detail": lambda: hf.Detail(region, region.clone()), "hf_weights": lambda: hf.Weights(surface, [[0.0, 0, 0], [5.0, 5, 0]]),
              "hf_transfer": lambda: hf.Transfer(surface, surface)}
    for name in HANDLES - made.keys():  # what is made on a surface alone needs no line here
        made[name] = makers[name]() if name in makers else getattr(hf, "".join(w.title() for w in name[3:].split("_")))(surface)
    made["hf_direction"].add_sites([0], [[1.0, 0.0, 0.0]])
    return made


def is_sized(p):
    """Whether a parameter or a field points to a struct that says its size."""
    return p["pointer"] and p["type"] in STRUCTS and STRUCTS[p["type"]]["fields"][0]["name"] == "struct_size"


class Calls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.live, cls.stale = objects(), objects()
        for thing in cls.stale.values():
            thing.close()

    def state(self):
        """What the objects say, to the bit."""
        def bits(part):
            if isinstance(part, dict):
                return {key: bits(value) for key, value in part.items()}
            if isinstance(part, (tuple, list)):
                return [bits(value) for value in part]
            return bytes(part) if isinstance(part, ctypes.Structure) else np.asarray(part).tobytes()

        live = self.live
        return bits([live["hf_solver"].solve(), live["hf_direction"].solve(), live["hf_pose"].deform(), live["hf_weights"].get(),
                     live["hf_region"].vertices(), live["hf_surface"].report])

    def arguments(self, function):
        """Arguments that are right in form: live handles, zeroed memory behind every pointer, structs with their size."""
        keep, values = [], []
        for p in function["parameters"]:
            if p["type"] in HANDLES and not p["pointer"]:
                optional = p.get("optional")
                values.append(None if optional else self.live[p["type"]].raw_handle)
            elif p["pointer"]:
                block = (ctypes.c_uint8 * ROOM)()
                keep.append(block)
                if p["type"] in STRUCTS and STRUCTS[p["type"]]["fields"][0]["name"] == "struct_size":
                    ctypes.c_uint32.from_buffer(block).value = ctypes.sizeof(getattr(_raw, p["type"]))
                values.append(ctypes.addressof(block))
            else:
                values.append(0.0 if p["type"] in ("float", "double") else 0)
        return keep, values

    def code(self, function, values):
        found = getattr(_library.library(), function["name"])(*values)
        return CODES.get(found, found)

    def each(self, kind):
        """(function, place, parameter) of the functions that return a result."""
        for function in API["functions"]:
            if function["returns"]["type"] == "hf_result":
                for place, p in enumerate(function["parameters"]):
                    if kind(p):
                        yield function, place, p

    def test_what_is_no_live_handle_of_its_kind_is_refused_by_every_function(self):
        rows, before, memory = 0, self.state(), (ctypes.c_uint8 * ROOM)()
        no_handles = [(1 << 8 * ctypes.sizeof(ctypes.c_void_p)) - 1, 1, ctypes.addressof(memory)]
        for function, place, p in self.each(lambda p: p["type"] in HANDLES and not p["pointer"]):
            others = [thing.raw_handle for kind, thing in self.live.items() if kind != p["type"]]
            for handle in [self.stale[p["type"]].raw_handle, *others, *no_handles] + ([] if p.get("optional") else [None]):
                keep, values = self.arguments(function)
                values[place] = handle
                with self.subTest(function=function["name"], parameter=p["name"], handle=handle):
                    self.assertEqual(self.code(function, values), INVALID_HANDLE)
                rows += 1
        self.assertGreater(rows, 2000)
        self.assertEqual(self.state(), before)

    def test_null_for_a_pointer_that_is_needed_is_refused_by_every_function(self):
        rows, exact, before = 0, 0, self.state()
        for function, place, p in self.each(lambda p: p["pointer"] and not p.get("optional")):
            keep, values = self.arguments(function)
            values[place] = None
            if p["role"] == "array" and p["direction"] == "in":  # a list of none may be NULL: say that there is one
                for other, q in enumerate(function["parameters"]):
                    values[other] = 1 if q["role"] == "count" and q["name"] in p.get("dims", ()) else values[other]
            with self.subTest(function=function["name"], parameter=p["name"]):
                code = self.code(function, values)
                self.assertIn(code, (NULL_POINTER, *SOONER))
                exact += code == NULL_POINTER
            rows += 1
        self.assertGreater(rows, 60)
        self.assertGreater(exact, 0.8 * rows)
        self.assertEqual(self.state(), before)

    def test_null_for_a_pointer_that_may_be_left_out_is_never_called_null(self):
        rows = 0
        for function, place, p in self.each(lambda p: p["pointer"] and p.get("optional") and p["role"] != "handle"):
            keep, values = self.arguments(function)
            values[place] = None
            with self.subTest(function=function["name"], parameter=p["name"]):
                code = self.code(function, values)
                named = _raw.hf_error_detail()
                _library.library().hf_error_get_detail(ctypes.byref(named))
                self.assertFalse(code == NULL_POINTER and p["name"] in named.message.decode(), named.message)
            rows += 1
        self.assertGreater(rows, 60)

    def structs(self):
        """(function, parameter, values, address of a struct) for each struct with a size that a call takes or points to."""
        for function, place, p in self.each(is_sized):
            for field in [None, *filter(is_sized, STRUCTS[p["type"]]["fields"])]:
                if field and field["name"] == "move_to":  # a count of 0 skips this part of an edit
                    continue
                def call():
                    keep, values = self.arguments(function)
                    if not field:
                        return keep, values, values[place], p["type"]
                    inner = (ctypes.c_uint8 * ROOM)()
                    parent = getattr(_raw, p["type"])
                    setattr(parent.from_address(values[place]), field["name"], ctypes.addressof(inner))
                    return [keep, inner], values, ctypes.addressof(inner), field["type"]
                yield function, p["name"] + ("->" + field["name"] if field else ""), call

    def test_a_struct_of_the_wrong_size_or_with_an_unknown_byte_is_refused_by_every_function(self):
        rows, exact, before = 0, 0, self.state()
        for function, name, call in self.structs():
            own = ctypes.sizeof(getattr(_raw, call()[3]))
            for size, byte in [(size, 0) for size in (*FAR_SIZES, own // 2, own - 1)] + [(own + n, 1) for n in (1, 8, 64)]:
                keep, values, at, _ = call()
                ctypes.c_uint32.from_address(at).value = size
                if byte:
                    ctypes.c_uint8.from_address(at + size - 1).value = byte
                with self.subTest(function=function["name"], parameter=name, size=size):
                    code = self.code(function, values)
                    self.assertIn(code, (INVALID_DESC, *SOONER))
                    exact += code == INVALID_DESC
                rows += 1
        self.assertGreater(rows, 900)
        self.assertGreater(exact, 0.8 * rows)
        self.assertEqual(self.state(), before)

    def test_a_longer_struct_of_zeros_is_taken_and_its_unknown_part_stays(self):
        rows = taken = 0
        for function, name, call in self.structs():
            keep, values, at, kind = call()
            own = ctypes.sizeof(getattr(_raw, kind))
            ctypes.c_uint32.from_address(at).value = own + 24
            with self.subTest(function=function["name"], parameter=name):
                code = self.code(function, values)
                self.assertNotEqual(code, INVALID_DESC)
                self.assertEqual(ctypes.c_uint32.from_address(at).value, own + 24)
                self.assertFalse(any(ctypes.string_at(at + own, 24)))
                taken += code == "HF_OK"
            rows += 1
        self.assertGreater(rows, 80)
        self.assertGreater(taken, 0.3 * rows)


if __name__ == "__main__":
    unittest.main()
