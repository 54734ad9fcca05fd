"""demo.py MODEL OUT: a creature whose limbs are dragged for two seconds of 60 frames each, drawn without a window.

MODEL: any file that Panda3D loads. HF_UP: its axis that points up, 0 to 2; 1 when it is not given, as in glTF. Writes OUT_rest.png, OUT_1.png ... and says how long a frame took. HF_PRC: settings of Panda3D, one a line.
"""

import os
import statistics
import sys
import time

from panda3d.core import loadPrcFileData

loadPrcFileData("", "load-display p3tinydisplay\naudio-library-name null\nwin-size 800 600\nload-file-type p3assimp\n"
                "notify-level-assimp fatal\n" + os.environ.get("HF_PRC", ""))

import numpy as np  # noqa: E402
from direct.showbase.ShowBase import ShowBase  # noqa: E402
from panda3d.core import AmbientLight, DirectionalLight, Filename, LPoint3, Vec3, Vec4  # noqa: E402

import hf_panda3d  # noqa: E402

FRAMES = 120  # two seconds at 60 Hz


def look(base, deformer):
    low, high = deformer.rest.min(0), deformer.rest.max(0)
    centre, size = (low + high) / 2, float(np.linalg.norm(high - low))
    up = int(os.environ.get("HF_UP", "1"))
    across = np.argmin([high[k] - low[k] if k != up else np.inf for k in range(3)])  # from the side
    eye = centre.copy()
    eye[across] -= 1.7 * size
    eye[up] += 0.3 * size
    base.camera.setPos(*map(float, eye))
    base.camera.lookAt(LPoint3(*map(float, centre)), Vec3(*[1.0 if k == up else 0.0 for k in range(3)]))
    base.camLens.setNearFar(0.05 * size, 10 * size)
    base.setBackgroundColor(0.16, 0.17, 0.2)
    ambient, sun = AmbientLight("ambient"), DirectionalLight("sun")
    ambient.setColor(Vec4(0.3, 0.3, 0.34, 1))
    sun.setColor(Vec4(0.7, 0.66, 0.6, 1))
    light = base.camera.attachNewNode(sun)
    light.setHpr(-45, -40, 0)
    base.render.setLight(base.render.attachNewNode(ambient))
    base.render.setLight(light)
    return size, up, across


def main(path, out):
    base = ShowBase(windowType="offscreen")
    begin = time.perf_counter()
    deformer = hf_panda3d.Deformer(base.loader.loadModel(Filename.fromOsSpecific(os.path.abspath(path))))
    bound = time.perf_counter() - begin
    deformer.node.reparentTo(base.render)
    size, up, across = look(base, deformer)
    tips = deformer.propose()

    def picture(name):
        for _ in range(2):
            base.graphicsEngine.renderFrame()
        base.win.saveScreenshot(Filename.fromOsSpecific(f"{out}_{name}.png"))

    picture("rest")
    solve, draw = [], []
    for k, (place, radius) in enumerate(tips[:3]):
        handle = deformer.add_handle(place, radius)  # while posed: no factorisation
        start = handle.getPos()
        for frame in range(FRAMES + 1):
            t = 2 * np.pi * frame / FRAMES
            move = np.zeros(3)
            move[up] = 0.16 * size * np.sin(t / 2) ** 2
            move[3 - up - across] = 0.1 * size * np.sin(t)
            handle.setPos(start + Vec3(*move))
            a = time.perf_counter()
            deformer.update()
            b = time.perf_counter()
            base.graphicsEngine.renderFrame()
            solve.append(1e3 * (b - a)), draw.append(1e3 * (time.perf_counter() - b))
            if frame == FRAMES * 3 // 8:
                picture(str(k + 1))
        assert np.isfinite(deformer.posed).all()
        landed = deformer.posed[np.linalg.norm(deformer.rest - place, axis=1).argmin()]
        print(f"tip {k + 1}: back within {np.linalg.norm(landed - place) / size:.1e} of the size")
    print(f"{len(deformer.rest)} vertices, {len(deformer.handles)} handles, bound in {1e3 * bound:.0f} ms")
    print(f"a frame: {statistics.median(solve):.1f} ms to pose (worst {max(solve):.1f}), {statistics.median(draw):.1f} ms to draw")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
