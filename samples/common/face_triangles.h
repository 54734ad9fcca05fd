// Cuts polygons into triangles by the library's own rule (src/mesh/face_cut.h), so that what a program draws and writes
// are the triangles that the library picks and traces on. Any number of corners, convex or not.
#ifndef HF_SAMPLES_COMMON_FACE_TRIANGLES_H
#define HF_SAMPLES_COMMON_FACE_TRIANGLES_H
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace samples {

// Keeps its memory from face to face: make one for all faces of a mesh. One thread at a time.
class FaceTriangles {
 public:
  FaceTriangles();
  ~FaceTriangles();

  // Appends the count - 2 triangles of the polygon with these vertex numbers. Fewer than three corners have none. A
  // polygon that crosses itself has as many, some turned over. Cost: O(1) for a quad, O(n log n) for n corners that do
  // not lie in the way of each other's ears.
  void append(const std::vector<glm::dvec3>& positions, const uint32_t* corners, size_t count,
              std::vector<uint32_t>& triangles);

 private:
  struct Inner;
  std::unique_ptr<Inner> inner_;
};

}  // namespace samples

#endif
