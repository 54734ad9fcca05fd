"""The types of the Python package are complete, and pyright passes its README and typical lines in strict mode.

HF_PYRIGHT: the program pyright, where it is not on the path (package pyright of PyPI). Without it the test is skipped.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PYRIGHT = shutil.which(os.environ.get("HF_PYRIGHT", "pyright"))
TYPICAL = '''
with hf.Solver(surface) as inside:
    assert_type(inside, hf.Solver)
    assert_type(inside.solve(), "np.ndarray[Any, Any]")
assert_type(copy.copy(pose), hf.Pose)
quads = hf.Quads(surface, edge_length=0.5).mesh()
print(len(quads.faces), quads.positions[0])
squares = hf.Surface(positions, faces=np.array([[0, 2, 3, 1], [2, 4, 5, 3]]), link_pieces=True)
edited = squares.edit([0], 2.0)
hf.Pose(edited).set_matrices([0], np.eye(4)[None])
print(edited.report.boundary_edge_count, edited.info.vertex_count)
direction = hf.Direction(surface, degree=4)
print(pose.handle(left).position[0], hit and hit.place.triangle, direction.clone().closed)
'''


def pyright(*given):
    done = subprocess.run([PYRIGHT, "--outputjson", "--pythonpath", sys.executable, *map(str, given)], capture_output=True, text=True)
    return json.loads(done.stdout)


class Types(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def test_every_public_name_has_a_known_type(self):
        # the package is looked for where Python finds it
        site = pathlib.Path(self.folder.name)
        (site / "hf").symlink_to(ROOT / "bindings/python/hf")
        done = subprocess.run([PYRIGHT, "--verifytypes", "hf", "--ignoreexternal", "--outputjson"], capture_output=True, text=True,
            env={**os.environ, "PYTHONPATH": str(site)})
        found = json.loads(done.stdout)["typeCompleteness"]
        self.assertTrue(found["symbols"], done.stdout[:500])
        unknown = [symbol["name"] for symbol in found["symbols"] if symbol["isExported"] and not symbol["isTypeKnown"]]
        self.assertEqual(unknown, [])
        self.assertEqual(found["completenessScore"], 1.0)

    def test_the_readme_and_typical_lines_pass_in_strict_mode(self):
        readme = (ROOT / "bindings/python/README.md").read_text()
        blocks = re.findall(r"```python\n(.*?)```", readme, re.S)
        self.assertTrue(blocks)
        program = "import copy\nfrom typing import Any\n\nfrom typing_extensions import assert_type\n" + "".join(blocks) + TYPICAL
        folder = pathlib.Path(self.folder.name)
        (folder / "typical.py").write_text(program)
        (folder / "pyrightconfig.json").write_text(json.dumps({"typeCheckingMode": "strict", "extraPaths": [str(ROOT / "bindings/python")],
            "reportMissingModuleSource": False}))
        found = pyright("--project", folder)
        lines = program.split("\n")
        self.assertEqual([f'{one["message"]}: {lines[one["range"]["start"]["line"]]}' for one in found["generalDiagnostics"]], [])
        self.assertEqual(found["summary"]["filesAnalyzed"], 1)


if __name__ == "__main__":
    if PYRIGHT is None:
        print("skipped: no pyright here (package pyright of PyPI; HF_PYRIGHT=its program)")
        sys.exit(77)
    unittest.main()
