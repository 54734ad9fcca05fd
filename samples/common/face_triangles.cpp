// See face_triangles.h. The one file of the samples that sees the library's inside: CMakeLists.txt compiles a copy of
// three of its sources under another namespace.
#include "common/face_triangles.h"

#include <algorithm>

#include "mesh/face_cut.h"

namespace samples {

struct FaceTriangles::Inner {
  hf_inner::Memory memory;
  hf_inner::mesh::FaceCutter cutter{memory};
  std::vector<int32_t> vertices;
  std::vector<hf_inner::Vec3> points;
};

FaceTriangles::FaceTriangles() : inner_(std::make_unique<Inner>()) {}
FaceTriangles::~FaceTriangles() = default;

void FaceTriangles::append(const std::vector<glm::dvec3>& positions, const uint32_t* corners, size_t count,
                           std::vector<uint32_t>& triangles) {
  if (count < 3) return;
  if (count == 3) {
    triangles.insert(triangles.end(), corners, corners + 3);
    return;
  }
  inner_->vertices.clear();
  inner_->points.clear();
  // The cut computes with fourth powers of lengths: like the library, in a box of about one.
  const glm::dvec3 origin = positions[corners[0]];
  double size = 0;
  for (size_t k = 0; k < count; ++k) {
    const glm::dvec3 d = glm::abs(positions[corners[k]] - origin);
    size = std::max(size, std::max(d.x, std::max(d.y, d.z)));
  }
  if (!(size > 0)) size = 1;
  for (size_t k = 0; k < count; ++k) {
    const glm::dvec3 p = (positions[corners[k]] - origin) / size;
    inner_->vertices.push_back(static_cast<int32_t>(corners[k]));
    inner_->points.push_back({p.x, p.y, p.z});
  }
  inner_->cutter.cut({inner_->vertices.data(), count}, {inner_->points.data(), count});
  for (const int32_t k : inner_->cutter.triangles) triangles.push_back(corners[k]);
}

}  // namespace samples
