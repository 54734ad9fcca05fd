// Reads the places that a caller names: vertices, places between corners, or points in space. Sites, pins, curves,
// handles and paths read theirs here, so each refuses the same places in the same words.
#pragma once
#include <optional>

#include "mesh/nearest_triangle.h"
#include "mesh/places.h"

namespace hf_inner::mesh {

// Places of a caller: `count` of them, in the one array that is set. Throws HF_ERROR_INVALID_ARGUMENT (two are set) or
// HF_ERROR_NULL_POINTER (none).
struct Places {
  Places() = default;
  Places(std::uint32_t n, const std::uint32_t* of_vertices, const hf_place* of_places, const double* in_space);
  std::uint32_t count = 0;
  const std::uint32_t* vertices = nullptr;
  const hf_place* places = nullptr;
  const double* points = nullptr;  // xyz
};

// Reads one place. position: its place in the list, and the index of an error; list: its name in the text. Throws as
// usable_vertex, HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT (a barycentric weight below 0, another sum than 1,
// corners of different components), HF_ERROR_INVALID_DESC (reserved), HF_ERROR_UNSUPPORTED on a graph.
SurfacePlace read_place(const Mesh& mesh, const hf_place& given, std::size_t position, const char* list);

class PlaceReader {
 public:
  // Both arguments must outlive this object. Cost of points: a tree of boxes for many, O(n log n). For a few, each is
  // compared with the boxes of all triangles, and nothing is allocated.
  PlaceReader(const Mesh& mesh, const Places& given, Memory& memory);
  // Reads place i. A point in space becomes the nearest point of the surface. Throws as usable_vertex, read_place and
  // read_point_near do, index = i.
  SurfacePlace read(std::uint32_t i) const;

 private:
  Index nearest(const Vec3& p) const noexcept;

  const Mesh& mesh_;
  const Places& given_;
  std::optional<NearestTriangle> tree_;  // for many points
};

}  // namespace hf_inner::mesh
