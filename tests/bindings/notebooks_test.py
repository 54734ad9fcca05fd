"""The notebooks of the Python package run, print what they show, and draw their pictures.

notebooks_test.py          runs the cells of each notebook and compares what they print
notebooks_test.py --write  stores what the cells print and draw in the notebooks
"""

import base64
import contextlib
import io
import json
import os
import pathlib
import sys
import unittest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "bindings/python/notebooks"
sys.path.insert(0, str(FOLDER))
sys.path.insert(0, str(FOLDER.parent))
os.chdir(FOLDER)
WRITE = "--write" in sys.argv

try:
    import matplotlib
except ImportError:
    print("skipped: no matplotlib here (Debian: python3-matplotlib)")
    sys.exit(77)
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def lines(text):
    return text.splitlines(keepends=True)


def run(code, names):
    """What a cell prints and draws, as a notebook stores it."""
    told = io.StringIO()
    with contextlib.redirect_stdout(told):
        exec(compile(code, "<cell>", "exec"), names)
    out = [{"output_type": "stream", "name": "stdout", "text": lines(told.getvalue())}] if told.getvalue() else []
    for number in plt.get_fignums():
        png = io.BytesIO()
        plt.figure(number).savefig(png, format="png")
        out.append({"output_type": "display_data", "metadata": {},
            "data": {"image/png": base64.b64encode(png.getvalue()).decode() + "\n", "text/plain": ["<Figure>"]}})
    plt.close("all")
    return out


class Notebooks(unittest.TestCase):
    def test_every_cell_prints_and_draws_what_it_shows(self):
        found = sorted(FOLDER.glob("*.ipynb"))
        self.assertEqual(len(found), 3)
        for path in found:
            notebook, names, pictures = json.loads(path.read_text()), {}, 0
            for cell in notebook["cells"]:
                if cell["cell_type"] != "code":
                    continue
                outputs = run("".join(cell["source"]), names)
                if WRITE:
                    cell["outputs"] = outputs
                texts = [[out["text"] for out in given if "text" in out] for given in (outputs, cell["outputs"])]
                kinds = [[out["output_type"] for out in given] for given in (outputs, cell["outputs"])]
                self.assertEqual(*texts, path.name)
                self.assertEqual(*kinds, path.name)
                pictures += kinds[0].count("display_data")
            self.assertGreater(pictures, 1, path.name)
            if WRITE:
                path.write_text(json.dumps(notebook, indent=1) + "\n")


if __name__ == "__main__":
    unittest.main(argv=[a for a in sys.argv if a != "--write"])
