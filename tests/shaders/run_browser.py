"""Runs the shaders in Chromium, WebGL 2 and WebGPU, and compares with hf_deform. Prints the errors.

run_browser.py SHADERS FOLDER [OBJ|COUNT]: a body of 50,000 vertices without a file. 77 (skipped) without node or Chromium."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
from scene import Errors, draws, scenes


def write(scene, folder):
    """Writes scene.json, which names the arrays of scene.bin by place and length."""
    offset, parts = 0, []

    def place(array):
        nonlocal offset
        data = np.ascontiguousarray(array).tobytes()
        parts.append(data + bytes(-len(data) % 4))
        offset += len(parts[-1])
        return [offset - len(parts[-1]), int(np.size(array))]

    sets = [{"cluster_count": s["cluster_count"], "arrays": {k: place(a) for k, a in s.items() if k != "cluster_count"}} for s in scene.sets]
    frames = [{"share": f["share"], "transforms": place(f["transforms"])} for f in scene.frames]
    listed = [{"set": which, "now": now, "before": before} for which, now, before in draws(scene)]
    told = {"vertex_count": len(scene.points), "sets": sets, "frames": frames, "draws": listed}
    (folder / "scene.json").write_text(json.dumps(told))
    (folder / "scene.bin").write_bytes(b"".join(parts))


def main():
    shaders, folder = Path(sys.argv[1]), Path(sys.argv[2])
    if not shutil.which("node"):
        print("skipped: no node here")
        sys.exit(77)
    for scene in scenes(sys.argv[3:]):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        write(scene, folder)
        ran = subprocess.run(["node", Path(__file__).with_name("browser.mjs"), folder, shaders], stdout=subprocess.PIPE, text=True)
        print(ran.stdout, end="", flush=True)
        if ran.returncode:
            sys.exit(ran.returncode)
        for name in ("webgl", "webgpu"):
            if f"{name}: ran" not in ran.stdout:
                continue
            errors = Errors(scene)
            for number, (_, now, before) in enumerate(draws(scene)):
                posed = np.fromfile(folder / f"{name}_{number}.bin", np.float32)
                errors.add(now, before, posed.reshape(len(now), 4, len(scene.points), 3))
            errors.check(name)


main()
