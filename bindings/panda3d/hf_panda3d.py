"""hf for Panda3D: a model that follows handles.

    deformer = hf_panda3d.Deformer(loader.loadModel("horse.glb"))
    deformer.node.reparentTo(render)
    head = deformer.add_handle((0, 1.2, 0.4), radius=0.2)  # a NodePath: move and turn it
    deformer.update()                                      # every frame
"""

import numpy as np
from panda3d.core import (Geom, GeomNode, GeomVertexArrayFormat, GeomVertexData, GeomVertexFormat, InternalName, LQuaternion,
                          LPoint3, LVector3, NodePath)

import hf


def _format(old):
    """Positions and normals in arrays of their own, so that numpy writes them whole; the rest as it was. Columns of
    animation go: the vertices follow handles instead."""
    made = GeomVertexFormat()
    for name in ("vertex", "normal"):
        array = GeomVertexArrayFormat()
        array.addColumn(InternalName.make(name), 3, Geom.NTFloat32, Geom.CPoint if name == "vertex" else Geom.CNormal)
        made.addArray(array)
    rest = GeomVertexArrayFormat()
    for k in range(old.getNumColumns()):
        column = old.getColumn(k)
        if str(column.getName()) not in ("vertex", "normal") and not str(column.getName()).startswith("transform"):
            rest.addColumn(column.getName(), column.getNumComponents(), column.getNumericType(), column.getContents())
    if rest.getNumColumns():
        made.addArray(rest)
    return GeomVertexFormat.registerFormat(made)


class Deformer:
    """A model and its handles. Options are those of hf.Surface; pieces of the model are linked unless link_pieces=False."""

    def __init__(self, model, **options):
        self.node = NodePath("hf")
        self.handles = {}  # NodePath -> (number, place at rest)
        self._parts = []  # vertex data of a Geom, its first vertex, its number of vertices
        positions, triangles, first = [], [], 0
        for path in model.findAllMatches("**/+GeomNode"):
            matrix = path.getMat(model)
            made = GeomNode(path.getName())
            for k in range(path.node().getNumGeoms()):
                geom = path.node().getGeom(k).decompose()
                data = GeomVertexData(path.getName(), _format(geom.getVertexData().getFormat()), Geom.UHDynamic)
                data.copyFrom(geom.getVertexData(), False)
                count = data.getNumRows()
                # into the space of the model: this node is the only one left
                turn = np.array(matrix.getUpper3()).reshape(3, 3)
                self._rows(data, 0)[:] = self._rows(data, 0) @ turn + np.array(matrix.getRow3(3))
                normals = self._rows(data, 1) @ np.linalg.inv(turn).T
                self._rows(data, 1)[:] = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
                for primitive in geom.getPrimitives():
                    triangles.append(np.array(primitive.getVertexList(), np.uint32).reshape(-1, 3) + first)
                geom.setVertexData(data)
                made.addGeom(geom, path.node().getGeomState(k))
                positions.append(self._rows(data, 0).copy())
                self._parts.append((made, made.getNumGeoms() - 1, first, count))
                first += count
            self.node.attachNewNode(made).setState(path.getState())
        if not positions:
            raise ValueError("the model has no triangles")
        self.rest = np.concatenate(positions)
        options.setdefault("link_pieces", True)
        self.surface = hf.Surface(self.rest, np.concatenate(triangles), **options)  # factorises, once
        self.pose = hf.Pose(self.surface)
        self.posed, self._normals = self.rest.copy(), np.empty_like(self.rest)

    @staticmethod
    def _rows(data, array):
        return np.frombuffer(memoryview(data.modifyArray(array)).cast("B"), np.float32).reshape(-1, 3)

    def add_handle(self, point, radius, in_place=False):
        """A handle of what is edge-connected within radius of a point at rest. No factorisation, in any pose.

        in_place: it starts where the posed model stands, and the model stays; else it starts at rest.
        """
        number = int(self.pose.add_handles(points=point, radii=[radius], in_place=in_place)[0])
        info = self.pose.handle(number)
        place = LPoint3(*info.centroid)
        handle = self.node.attachNewNode(f"handle {number}")
        handle.setPos(place)
        if in_place:
            handle.setPos(place + LVector3(*info.translation))
            handle.setQuat(LQuaternion(info.rotation[3], *info.rotation[:3]))
        self.handles[handle] = (number, place)
        return handle

    def remove_handle(self, handle):
        self.pose.remove_handles([self.handles.pop(handle)[0]])
        handle.removeNode()

    def propose(self, **options):
        """Adds the handles that hold the body; returns (place, radius) of the others that are worth dragging."""
        found = self.surface.propose_handles(**options)
        for proposal in found[found["pinned"] != 0]:
            self.add_handle(proposal["position"], proposal["radius"])
        return [(proposal["position"], float(proposal["radius"])) for proposal in found[found["pinned"] == 0]]

    def update(self):
        """Solves the pose of the handles and shows it; returns the positions."""
        if not self.handles:
            return self.rest
        numbers, turns, moves = [], [], []
        for handle, (number, place) in self.handles.items():
            turn = LQuaternion(handle.getQuat(self.node))
            turn.normalize()
            numbers.append(number)
            turns.append((turn.getI(), turn.getJ(), turn.getK(), turn.getR()))
            moves.append(tuple(handle.getPos(self.node) - place))
        self.pose.set_transforms(numbers, turns, moves)
        self.pose.deform(self.posed, normals=self._normals)
        for node, k, first, count in self._parts:
            data = node.modifyGeom(k).modifyVertexData()
            self._rows(data, 0)[:] = self.posed[first:first + count]
            self._rows(data, 1)[:] = self._normals[first:first + count]
        return self.posed

    def pick(self, origin, direction):
        """What a click hits, as the model is posed (hf_hit); None when it misses. The ray is one of the node's space."""
        return self.surface.cast_ray(origin, direction, positions=self.posed)
