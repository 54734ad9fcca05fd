"""One description writes every language: a toy function in a copy of a header reaches all of them with no hand work, and a
header that leaves a question open is refused by name."""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "bindings/generate"))
import generate
import model
import parse_headers
import plan

TOY = """
/* Writes the mean of the values of all sites. out_mean: receives the mean. Errors: HF_ERROR_EMPTY. Thread safety: reads
 * `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_toy_mean(hf_solver solver, double* out_mean);

/* Shifts sites by a vector for each. sites: uint32_t[site_count]. vectors: double[site_count][3] in the unit of the mesh.
 * Thread safety: changes `solver`. Since 0.1. */
HF_API hf_result hf_solver_shift_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* vectors);

/* Writes the words of a solver. out_text: NULL, or char[capacity] in UTF-8. out_size: NULL, or receives the bytes with the zero.
 * Thread safety: reads `solver`. Since 0.1. */
HF_API hf_result hf_solver_get_words(hf_solver solver, size_t capacity, char* out_text, size_t* out_size);
"""


# what ships as a language's layer; JavaScript's two hosts reach the library's memory in two ways
LAYERS = {"C++": ["include/hf/*.hpp"], "C#": ["bindings/csharp/Hf/*.cs"], "Python": ["bindings/python/hf/_*.py"],
          "hf_gltf in Python": ["bindings/python/hf/gltf.py"],  # of another library
          "Rust": ["bindings/rust/src/*.rs", "bindings/rust/build.rs"],
          "JavaScript": ["bindings/js/src/[!nw]*.js"], "JavaScript in node": ["bindings/js/src/n*.js"],
          "JavaScript in a browser": ["bindings/js/src/w*.js"]}
MOST_LINES = 300  # by hand in a language, without empty lines and comments; a line of more than 120 columns counts as two


def lines_by_hand(patterns):
    """(lines, files)"""
    files = [path for pattern in patterns for path in sorted(ROOT.glob(pattern)) if "Generated from include/hf" not in path.read_text()[:200]]
    lines = 0
    for path in files:
        comments = r'(?m)^\s*"""[\s\S]*?"""\s*$|^\s*#.*' if path.suffix == ".py" else r"(?m)/\*[\s\S]*?\*/|^\s*//.*"
        lines += sum(-(-len(line) // 120) for line in re.sub(comments, "", path.read_text()).split("\n") if line.strip())
    return lines, files


def with_toy(folder, text=TOY):
    """A copy of the headers with more at the end of solver.h."""
    shutil.copytree(ROOT / "include", folder / "include")
    header = folder / "include/hf/solver.h"
    before, brace, after = header.read_text().rpartition("#ifdef __cplusplus")
    header.write_text(before + text + brace + after)
    return folder / "include"


files_of_toy = {}


def made_with_toy(folder):
    """All files made from the headers with the toy: read once, since every folder has the same."""
    include = with_toy(folder)
    if not files_of_toy:
        files_of_toy.update(generate.files(include))
    return files_of_toy


class OneDescription(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def test_nothing_in_the_headers_is_left_open(self):
        api = parse_headers.read_api(ROOT / "include")
        self.assertTrue(all(p["role"] for f in api["functions"] for p in f["parameters"]))
        self.assertTrue(all(f["noun"] or f["name"] in plan.LOOSE for f in api["functions"]))

    def test_a_toy_function_is_in_every_raw_layer(self):
        made = made_with_toy(self.folder)
        for name in ("functions.txt", "api.json", "python/hf/_raw.py", "js/src/raw.js", "csharp/Hf/Raw.cs", "rust/src/raw.rs", "../include/hf/hf.hpp"):
            self.assertIn("hf_solver_get_toy_mean", made[name], name)

    def test_a_toy_function_is_a_method_of_python_that_is_called_with_arrays(self):
        made = made_with_toy(self.folder)
        shutil.copytree(ROOT / "bindings/python", self.folder / "python")
        for name, text in made.items():
            if name.startswith("python/"):
                (self.folder / name).write_text(text)
        script = self.folder / "call.py"
        script.write_text(CALL)
        subprocess.run([sys.executable, script], cwd=self.folder / "python", check=True)

    def test_a_toy_function_is_a_method_of_javascript_that_is_called_with_arrays(self):
        node = shutil.which("node")
        if node is None:
            self.skipTest("no node here")
        made = made_with_toy(self.folder)
        shutil.copytree(ROOT / "bindings/js/src", self.folder / "js/src")
        for name, text in made.items():
            if name.startswith("js/"):
                (self.folder / name).write_text(text)
        types = (self.folder / "js/src/index.d.ts").read_text()
        self.assertIn("  readonly toyMean: number;", types)
        self.assertIn("  shiftSites(sites: Rows, vectors: Rows): void;", types)
        (self.folder / "js/src/call_toy.mjs").write_text(CALL_JS)
        subprocess.run([node, self.folder / "js/src/call_toy.mjs"], check=True)

    def stub(self):
        """A library of the two functions and of what a solver needs."""
        compiler = shutil.which("cc")
        if compiler is None:
            self.skipTest("no C compiler here")
        (self.folder / "stub.c").write_text(STUB)
        subprocess.run([compiler, "-shared", "-fPIC", self.folder / "stub.c", "-o", self.folder / "libhf.so"], check=True)

    def test_a_toy_function_is_a_method_of_csharp_that_is_called_with_arrays(self):
        if shutil.which("mcs") is None or shutil.which("mono") is None:
            self.skipTest("no Mono here")
        self.stub()
        made = made_with_toy(self.folder)
        shutil.copytree(ROOT / "bindings/csharp/Hf", self.folder / "csharp/Hf")
        for name, text in made.items():
            if name.startswith("csharp/"):
                (self.folder / name).write_text(text)
        (self.folder / "Toy.cs").write_text(CALL_CS)
        subprocess.run(["mcs", "-langversion:latest", "-unsafe", f"-out:{self.folder}/toy.exe", self.folder / "Toy.cs",
                        *sorted((self.folder / "csharp/Hf").glob("*.cs"))], check=True)
        subprocess.run(["mono", self.folder / "toy.exe"], check=True, env={"PATH": "/usr/bin:/bin", "HF_LIBRARY": str(self.folder / "libhf.so")})

    def test_a_toy_function_is_a_method_of_rust_that_is_called_with_slices(self):
        if shutil.which("rustc") is None:
            self.skipTest("no Rust here")
        self.stub()
        made = made_with_toy(self.folder)
        shutil.copytree(ROOT / "bindings/rust/src", self.folder / "rust/src")
        for name, text in made.items():
            if name.startswith("rust/"):
                (self.folder / name).write_text(text)
        (self.folder / "toy.rs").write_text(CALL_RS)
        subprocess.run(["rustc", "--edition=2021", "--crate-type=rlib", "--crate-name=hf", self.folder / "rust/src/lib.rs", "-o",
                        self.folder / "libhf.rlib"], check=True)
        subprocess.run(["rustc", "--edition=2021", "--extern", f"hf={self.folder}/libhf.rlib", "-L", self.folder, "-l", "hf", "-C",
                        "link-args=-Wl,--unresolved-symbols=ignore-all", self.folder / "toy.rs", "-o", self.folder / "toy"], check=True)
        subprocess.run([self.folder / "toy"], check=True, env={"LD_LIBRARY_PATH": str(self.folder)})

    def test_a_toy_function_is_a_method_of_cpp_that_is_called_with_vectors(self):
        if shutil.which("c++") is None:
            self.skipTest("no C++ compiler here")
        self.stub()
        made = made_with_toy(self.folder)
        (self.folder / "include/hf/hf.hpp").write_text(made["../include/hf/hf.hpp"])
        (self.folder / "toy.cpp").write_text(CALL_CPP)
        # the inline methods of the other classes call functions that the stub has not
        subprocess.run(["c++", "-std=c++17", "-I", self.folder / "include", self.folder / "toy.cpp", "-o", self.folder / "toy_cpp",
                        "-L", self.folder, "-lhf", "-Wl,--unresolved-symbols=ignore-all"], check=True)
        subprocess.run([self.folder / "toy_cpp"], check=True, env={"LD_LIBRARY_PATH": str(self.folder)})

    def test_a_language_has_at_most_300_lines_by_hand(self):
        counted = {layer: lines_by_hand(patterns) for layer, patterns in LAYERS.items()}
        for layer, (lines, _) in counted.items():
            with self.subTest(layer=layer):
                self.assertLessEqual(lines, MOST_LINES, f"{layer}: what follows from the headers goes to bindings/generate")
                self.assertGreater(lines, 0)
        folders = {path.parent for layer in LAYERS.values() for pattern in layer for path in ROOT.glob(pattern)} - {ROOT / "bindings/rust"}
        sources = {path for folder in folders for path in folder.glob("*") if path.suffix in (".hpp", ".cs", ".py", ".rs", ".js")}
        made = {path for path in sources if "Generated from include/hf" in path.read_text()[:200]}
        self.assertEqual(sources - made, {path for _, files in counted.values() for path in files} & sources, "a file by hand is counted in no layer")

    def test_a_struct_of_more_than_16_fields_says_why(self):
        fields = "".join(f"  uint32_t field_{n};\n" for n in range(17))
        many = "\n/* Many figures.%s */\ntypedef struct hf_many {\n" + fields + "} hf_many;\n"
        with self.assertRaisesRegex(model.Problems, "hf_many: 17 fields"):
            parse_headers.read_api(with_toy(self.folder, many % ""))
        shutil.rmtree(self.folder / "include")
        parse_headers.read_api(with_toy(self.folder, many % " More than 16 fields: they are one vector."))

    def test_what_a_comment_leaves_open_is_refused_by_name(self):
        cases = {"hf_solver_get_toy_mean, out_mean: how many?": TOY.replace("out_mean: receives the mean. ", ""),
                 "hf_solver_shift_sites, vectors: how many?": TOY.replace("vectors: double[site_count][3] ", "vectors: "),
                 "what is angle_count?": TOY.replace("double[site_count][3]", "double[angle_count][3]"),
                 "its name starts with out_": TOY.replace("out_mean", "mean")}
        for number, (words, text) in enumerate(cases.items()):
            with self.subTest(words=words):
                with self.assertRaises(model.Problems) as caught:
                    parse_headers.read_api(with_toy(self.folder / str(number), text))
                self.assertIn(words, str(caught.exception))


CALL = '''
import sys
sys.path.insert(0, ".")
sys.dont_write_bytecode = True
import ctypes
import inspect
import numpy as np
import hf
from hf import _library

class Stub:
    """A library with the two functions alone."""
    def hf_solver_get_toy_mean(self, handle, out):
        out._obj.value = handle + 0.5
        return 0
    def hf_solver_shift_sites(self, handle, count, sites, vectors):
        self.got = count, np.ctypeslib.as_array((ctypes.c_double * (3 * count)).from_address(vectors)).tolist()
        return 0
    def hf_solver_get_words(self, handle, capacity, text, size):
        size._obj.value = 4
        if capacity:
            ctypes.memmove(text, b"two\\0", 4)
        return 0

stub = Stub()
_library.library = lambda: stub
solver = hf.Solver.__new__(hf.Solver)
solver._handle = 2
assert solver.toy_mean == 2.5
assert solver.words() == "two", solver.words()
assert hf.Solver.toy_mean.__doc__.startswith("Writes the mean of the values of all sites."), hf.Solver.toy_mean.__doc__
assert "EmptyError" in hf.Solver.toy_mean.__doc__
solver.shift_sites([4, 5], [[1, 2, 3], [4, 5, 6]])
assert stub.got == (2, [1, 2, 3, 4, 5, 6]), stub.got
try:
    solver.shift_sites([4, 5], [[1, 2], [3, 4]])
except hf.InvalidArgumentError as error:
    assert "vectors must have the shape (2, 3), not (2, 2)" in str(error), error
else:
    raise AssertionError("two numbers for each were taken for three")
assert str(inspect.signature(hf.Solver.shift_sites)).startswith("(self, sites"), inspect.signature(hf.Solver.shift_sites)
'''

CALL_JS = '''
import assert from 'node:assert/strict';
import { makeApi } from './objects.js';

// a library with the functions of the toy alone
let handles = 1n;
let got;
const stub = {
  name: 'stub',
  width: 1,
  newHandle: () => new BigUint64Array(1),
  call(name, args) {
    if (name === 'hf_version_get') return 1000;
    if (name === 'hf_solver_get_toy_mean') args[1].array[0] = 2.5;
    else if (name === 'hf_solver_shift_sites') got = [args[1], [...args[2].array], [...args[3].array]];
    else if (name === 'hf_solver_get_words') {
      args[3].array[0] = 4n;
      args[2]?.array.set(new TextEncoder().encode('two\\0'));
    } else if (name.includes('create')) args.at(-1).array[0] = handles++;
    return 0;
  },
};
const hf = makeApi(stub);
const solver = new hf.Solver(new hf.Surface([0, 0, 0], [0, 0, 0]));
assert.equal(solver.toyMean, 2.5);
assert.equal(solver.words(), 'two');
solver.shiftSites([4, 5], [1, 2, 3, 4, 5, 6]);
assert.deepEqual(got, [2, [4, 5], [1, 2, 3, 4, 5, 6]]);
assert.throws(() => solver.shiftSites([4, 5], [1, 2, 3, 4]), /vectors must hold 6 numbers, not 4/);
'''

STUB = '''
#include <stdint.h>
#include <string.h>
uint32_t hf_version_get(void) { return 1000; }
const char* hf_result_get_name(int32_t result) { return result ? "HF_ERROR_INVALID_ARGUMENT" : "HF_OK"; }
int32_t hf_error_get_detail(void* detail) { return 0; }
int32_t hf_surface_create(const void* desc, void** out) { *out = (void*)8; return 0; }
void hf_surface_destroy(void* surface) {}
int32_t hf_create(void* surface, const void* desc, void** out) { *out = (void*)16; return 0; }
void hf_solver_destroy(void* solver) {}
int32_t hf_solver_get_toy_mean(void* solver, double* out_mean) { *out_mean = 2.5; return 0; }
int32_t hf_solver_get_words(void* solver, size_t capacity, char* out_text, size_t* out_size) {
  *out_size = 4;
  if (capacity) memcpy(out_text, "two", 4);
  return 0;
}
int32_t hf_solver_shift_sites(void* solver, uint32_t count, const uint32_t* sites, const double* vectors) {
  const double wanted[] = {1, 2, 3, 4, 5, 6};
  return count == 2 && sites[1] == 5 && !memcmp(vectors, wanted, sizeof(wanted)) ? 0 : -1;
}
'''

CALL_CS = '''
using System;
using Hf;
static class Toy
{
    static void Main()
    {
        var solver = new Solver(new Surface(new float[3], new uint[3]));
        if (solver.ToyMean != 2.5 || solver.Words() != "two") throw new Exception("the mean, or the words");
        solver.ShiftSites(new uint[] { 4, 5 }, new double[] { 1, 2, 3, 4, 5, 6 });
        try { solver.ShiftSites(new uint[] { 4, 5 }, new double[] { 1, 2, 3, 4 }); }
        catch (HfException error)
        {
            if (error.Message.Contains("vectors must hold 6 numbers, not 4")) return;
            throw;
        }
        throw new Exception("two numbers for each were taken for three");
    }
}
'''

CALL_RS = '''
fn main() -> hf::Result<()> {
    let surface = hf::Surface::new(&[0f32; 3], &[0u32; 3], &hf::SurfaceOptions::default())?;
    let mut solver = hf::Solver::new(&surface, &hf::SolverOptions::default())?;
    assert_eq!((solver.toy_mean()?, solver.words()?.as_str()), (2.5, "two"));
    solver.shift_sites(&[4, 5], &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0])?;
    let refused = solver.shift_sites(&[4, 5], &[1.0, 2.0, 3.0, 4.0]).unwrap_err();
    assert_eq!(refused.message, "vectors must hold 6 entries, not 4");
    Ok(())
}
'''

CALL_CPP = '''
#include <string>
#include "hf/hf.hpp"

int main() {
  const hf::Surface surface(std::vector<float>(3), std::vector<uint32_t>(3));
  hf::Solver solver(surface);
  if (solver.toy_mean() != 2.5 || solver.words() != "two") return 1;
  solver.shift_sites({4, 5}, {1, 2, 3, 4, 5, 6});
  try {
    solver.shift_sites({4, 5}, {1, 2, 3, 4});
  } catch (const std::invalid_argument& error) {
    return std::string(error.what()) != "vectors must hold 6 numbers, not 4";
  }
  return 2;
}
'''

if __name__ == "__main__":
    unittest.main()
