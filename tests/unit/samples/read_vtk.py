"""Posed vertices of a glTF as VTK's vtkGLTFReader plays it: read_vtk.py FILE.glb TIMES OUT.json"""
import json
import sys

from vtkmodules.vtkIOGeometry import vtkGLTFReader

file, times, out = sys.argv[1:4]
frames = []


def collect(block, points):
    if block is None:
        return
    if block.IsA("vtkMultiBlockDataSet"):
        for i in range(block.GetNumberOfBlocks()):
            collect(block.GetBlock(i), points)
    else:
        for i in range(block.GetNumberOfPoints()):
            points.extend(block.GetPoint(i))


for time in times.split(","):
    # a reader that is asked for a second time leaves blocks out
    reader = vtkGLTFReader()
    reader.SetFileName(file)
    reader.ApplyDeformationsToGeometryOn()
    reader.UpdateInformation()
    reader.EnableAnimation(0)
    reader.UpdateTimeStep(float(time))
    points = []
    collect(reader.GetOutput(), points)
    frames.append(points)
json.dump({"frames": frames}, open(out, "w"))
