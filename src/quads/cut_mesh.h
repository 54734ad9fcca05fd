// A surface whose long triangles are cut.
//
// The map of quads is linear in each triangle, so quads cannot bend or change their size inside one. Where triangles
// are longer than quads, the surface is cut before it gets crosses and a map. It stays the same surface.
//
// Every edge that is too long is cut in the middle, the longest first, and its triangles with it: in two, three or
// four. Neighbours share the new vertices. Cost: O(n log n) for n triangles of the result.
#pragma once
#include "quads/field_quads.h"

namespace hf_inner::quads {

// Returns the share of a surface that lies in triangles longer than several quads. length: of their edges.
double coarse_part(const surface::Core& core, double length) noexcept;
// Whether such triangles make up much of a surface.
bool is_coarse(double coarse_part) noexcept;

struct CutMesh {
  explicit CutMesh(Memory& memory)
      : position(&memory), corner(&memory), parent(&memory), weight(&memory), middle(&memory) {}
  // No edge of the result is longer than `longest`, unless it would have more than `most` triangles.
  static CutMesh make(const surface::Core& core, double longest, Index most);
  // Calls use(a, b) for the edges that an edge of the core became.
  template <class Use>
  void for_pieces(Index a, Index b, Use&& use) const {
    const Index m = middle_of(a, b);
    if (m == mesh::Mesh::none) return use(a, b);
    for_pieces(a, m, use);
    for_pieces(m, b, use);
  }

  struct Weights {
    double of[3][3];  // by corner, of the three corners of the parent
  };
  struct Middle {
    Index a, b;  // a < b
    Index vertex;
  };
  Vector<Vec3> position;   // by vertex, inner units of the core, whose vertices come first
  Vector<Index> corner;    // three vertices for each triangle
  Vector<Index> parent;    // by triangle, its triangle of the core
  Vector<Weights> weight;  // by triangle
  Vector<Middle> middle;   // of every edge that was cut, ascending

 private:
  bool cut(double longest, Index most, Memory& memory);
  Index middle_of(Index a, Index b) const noexcept;
};

// The data that quads of one surface share where it is cut for one edge length.
struct CutBase {
  // quads: how many are wanted; it bounds the triangles.
  CutBase(const surface::Core& whole, double length, double quads);
  // The point of `whole` that a point of `core` is. Weights belong to the corners of their meshes.
  remesh::SurfacePoint in_whole(const remesh::SurfacePoint& point) const noexcept;

  double length, quads;
  double facet;  // of the options for quads of `core`; inner units of `whole`
  CutMesh cut;
  std::shared_ptr<const surface::Core> core;
  QuadKeeper kept;
};

}  // namespace hf_inner::quads
