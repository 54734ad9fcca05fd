// Triangles that leave a mesh, vertices and triangles that come in, and corners that take copies of their vertices.
//
// Vertices and triangles of the caller keep their numbers. New ones follow. A removed triangle stays in the count and
// is no usable one any more. A vertex whose last triangle left is isolated. New vertices are welded to no other: a cut
// needs two vertices at one place. Inside, new vertices and triangles take the numbers of those that went, and the
// others keep theirs, unless more vertices go than come. The frame (centre and scale) stays, so the numbers of the rest
// keep their bits.
#pragma once
#include "base/index.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

struct MeshPatch {
  Span<const std::uint32_t> removed;    // triangles of the caller
  Span<const Vec3> positions;           // of the new vertices, as given
  Span<const std::uint32_t> triangles;  // three vertices of the caller each
  Span<const Mesh::CutCorner> cuts;     // by copy; the copies are numbered after `positions`
};

struct PatchedMesh {
  explicit PatchedMesh(Memory& memory)
      : mesh(memory), number(&memory), touched(&memory), around(&memory), went(&memory), came(&memory) {}
  Mesh mesh;
  // By inner vertex of the mesh before: its number now, or none. Empty: vertices that stay keep their numbers.
  Vector<Index> number;
  Vector<Index> touched;  // inner vertices with other triangles than before, ascending
  Vector<Index> around;   // the usable triangles at these vertices
  Vector<Index> went;     // inner vertices before that went, ascending
  Vector<Index> came;     // vertices of the caller that became inner ones
  bool same_components = false;
};

// Throws HF_ERROR_UNSUPPORTED (a graph, or a mesh of polygons), HF_ERROR_OUT_OF_RANGE, HF_ERROR_CONFLICT (a triangle
// listed twice, on another triangle, or not there any more), HF_ERROR_INVALID_ARGUMENT (equal corners),
// HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE, HF_ERROR_EMPTY (no triangle is left), all with the position in its list as
// index, or std::bad_alloc. topology: of the mesh before, or null. Cost: copies of the arrays; without a topology a
// pass over the triangles more.
PatchedMesh patched_mesh(const Mesh& before, const Topology* topology, const MeshPatch& patch, Memory& memory,
                         JobRunner* jobs = nullptr);

// Writes the components of out.mesh. They stay if the triangles around the patch join the same components as before;
// else all are found again. fresh: its new vertices.
void put_components(const Mesh& before, Span<const Index> fresh, PatchedMesh& out, Memory& memory);

}  // namespace hf_inner::mesh
