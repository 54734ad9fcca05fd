// Faces of any number of corners, as the caller stores them and as a Mesh keeps them beside the triangles of its cut.
//
// A face of n corners is cut into n - 2 triangles (face_cut.h). Everything that needs triangles works on the cut. The
// operators of mesh/face_operator.h do not depend on it. Cost: O(corners).
#pragma once
#include <cstdint>

#include "base/shared_vector.h"
#include "base/span.h"

namespace hf_inner::mesh {

// The caller's faces. Face f has `size` corners from corner `start` on. Starts and sizes come from one array of sizes
// (the faces follow one another), from one of starts (n + 1 offsets), or from one of each.
class FaceRows {
 public:
  IndexRows starts, sizes, corners;  // rows of one
  std::uint32_t face_count = 0, corner_count = 0;

  // Calls visit(face, start, size) for every face, in order. Sizes of descending offsets are below 0.
  template <class Visit>
  void each(Visit&& visit) const {
    std::int64_t next = 0;
    for (std::uint32_t f = 0; f < face_count; ++f) {
      const std::int64_t start = starts ? starts.get(f, 0) : next;
      const std::int64_t size =
          sizes ? std::int64_t{sizes.get(f, 0)} : std::int64_t{starts.get(f + std::size_t{1}, 0)} - start;
      visit(f, start, size);
      next = start + size;
    }
  }
  std::uint32_t corner(std::int64_t c) const noexcept { return corners.get(static_cast<std::size_t>(c), 0); }
};

// The usable faces of a mesh. Empty where the caller gave triangles.
struct Faces {
  explicit Faces(Memory& memory)
      : corner_start(memory),
        corner(memory),
        triangle_start(memory),
        given(memory),
        second_cut(memory),
        given_size(memory) {}
  bool empty() const noexcept { return corner_start.empty(); }
  std::int32_t count() const noexcept { return empty() ? 0 : static_cast<std::int32_t>(given.size()); }
  Span<const std::int32_t> corners_of(std::int32_t face) const noexcept {
    const std::size_t f = static_cast<std::size_t>(face);
    const std::size_t first = static_cast<std::size_t>(corner_start[f]);
    return {corner.data() + first, static_cast<std::size_t>(corner_start[f + 1]) - first};
  }

  // The corners of face f are corner[corner_start[f] .. corner_start[f + 1]).
  SharedVector<std::int32_t> corner_start;
  // Inner vertices. No two neighbours of a face are equal.
  SharedVector<std::int32_t> corner;
  // The triangles of face f are triangle_start[f] .. triangle_start[f + 1] - 1.
  SharedVector<std::int32_t> triangle_start;
  // The number of each face as the caller gave it.
  SharedVector<std::int32_t> given;
  // 1 for a quad that is not planar: its operator uses both diagonals as cuts.
  SharedVector<std::uint8_t> second_cut;
  // The number of corners of every face of the caller.
  SharedVector<std::uint32_t> given_size;
  // Faces of the caller that have four corners or more.
  std::uint32_t polygon_count = 0;
  // Usable faces with a corner far from their mean plane.
  std::uint32_t non_planar_count = 0;
  // The number of corners of the largest face of the caller.
  std::uint32_t largest_size = 0;
};

}  // namespace hf_inner::mesh
