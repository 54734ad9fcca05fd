"""The Panda3D layer without a window: panda3d_test.py PICTURE.png. 77 (skipped) without Panda3D."""

import sys

try:
    from panda3d.core import loadPrcFileData
except ImportError:
    print("skipped: no Panda3D here (HF_PANDA3D: a Python that has it and numpy)")
    sys.exit(77)

loadPrcFileData("", "load-display p3tinydisplay\naudio-library-name null\nwin-size 400 300\n")

import numpy as np  # noqa: E402
from direct.showbase.ShowBase import ShowBase  # noqa: E402
from panda3d.core import (Filename, Geom, GeomNode, GeomTriangles, GeomVertexData, GeomVertexFormat,  # noqa: E402
                          GeomVertexWriter, NodePath)

import hf_panda3d  # noqa: E402

RINGS, AROUND = 41, 16


def tube(name, low, high):
    """A tube along z as an engine's model: positions, normals, colours in one array, triangles of 16 bits."""
    data = GeomVertexData(name, GeomVertexFormat.getV3n3c4(), Geom.UHStatic)
    vertex, normal, colour = (GeomVertexWriter(data, column) for column in ("vertex", "normal", "color"))
    for i in range(RINGS):
        for j in range(AROUND):
            a = 2 * np.pi * j / AROUND
            vertex.addData3(0.3 * np.cos(a), 0.3 * np.sin(a), low + (high - low) * i / (RINGS - 1))
            normal.addData3(np.cos(a), np.sin(a), 0)
            colour.addData4(1, i / RINGS, 0, 1)
    triangles = GeomTriangles(Geom.UHStatic)
    for i in range(RINGS - 1):
        for j in range(AROUND):
            a, b = i * AROUND + j, i * AROUND + (j + 1) % AROUND
            triangles.addVertices(a, b, b + AROUND), triangles.addVertices(a, b + AROUND, a + AROUND)
    geom, node = Geom(data), GeomNode(name)
    geom.addPrimitive(triangles)
    node.addGeom(geom)
    return NodePath(node)


base = ShowBase(windowType="offscreen")
model = NodePath("model")
lower, upper = tube("lower", 0, 2), tube("upper", 0, 2)
lower.reparentTo(model), upper.reparentTo(model)
upper.setPos(0, 0, 2.01)  # another node with its own place, almost touching: a link joins them
deformer = hf_panda3d.Deformer(model)
rest = deformer.rest
assert len(rest) == 2 * RINGS * AROUND and abs(rest[:, 2].max() - 4.01) < 1e-5

foot, tip = deformer.add_handle((0, 0, 0), 0.4), deformer.add_handle((0, 0, 4.01), 0.4)
assert 3.7 < tip.getZ() < 4.0 and abs(tip.getX()) < 1e-4, tip.getPos()
low, high = rest[:, 2] < 0.01, rest[:, 2] > 4.0
tip.setPos(tip.getPos() + (1, 0, -0.3))
tip.setHpr(0, 0, 50)
for _ in range(30):
    posed = deformer.update().copy()  # update() returns the same array every time
np.testing.assert_allclose(posed[low], rest[low], atol=1e-4)
turn = np.array(tip.getMat(deformer.node).getUpper3()).reshape(3, 3)
start = np.array(deformer.handles[tip][1])
np.testing.assert_allclose(posed[high], (rest[high] - start) @ turn + np.array(tip.getPos()), atol=1e-4)
# the engine has what the library wrote, and colours are as they were
node, _, first, count = next(part for part in deformer._parts if part[0].getName() == "upper")
shown = np.frombuffer(memoryview(node.getGeom(0).getVertexData().getArray(0)).cast("B"), np.float32).reshape(-1, 3)
np.testing.assert_array_equal(shown, posed[first:first + count])
assert node.getGeom(0).getVertexData().hasColumn("color")

# a handle while posed, and gone again
middle = deformer.add_handle((0, 0, 2), 0.25)
deformer.update()
deformer.remove_handle(middle)
assert len(deformer.handles) == 2
for _ in range(30):
    again = deformer.update().copy()
assert np.abs(again - posed).max() < 0.05
# a handle in place: the model stays, and it follows the handle from there
waist = deformer.add_handle((0, 0, 2), 0.25, in_place=True)
assert (waist.getPos() - deformer.handles[waist][1]).length() > 0.05, waist.getPos()
still = deformer.update().copy()
assert np.abs(still - again).max() < 0.01, np.abs(still - again).max()
waist.setPos(waist.getPos() + (0, 0.5, 0))
assert np.abs(deformer.update() - still).max() > 0.3
deformer.remove_handle(waist)
hit = deformer.pick((1, -5, float(posed[high][:, 2].mean())), (0, 1, 0))
assert hit is not None and deformer.pick((50, -5, 0), (0, 1, 0)) is None

try:
    hf_panda3d.Deformer(NodePath("empty"))
    raise AssertionError("a model without triangles was taken")
except ValueError:
    pass

deformer.node.reparentTo(base.render)
base.camera.setPos(0, -9, 2)
for _ in range(2):
    base.graphicsEngine.renderFrame()
base.win.saveScreenshot(Filename.fromOsSpecific(sys.argv[1]))
print("panda3d: all right")
