// Distance between two triangle surfaces, for the report of hf_quads.
//
// The one-sided Hausdorff distance max over points p of A of min over B |p - q| is sampled: vertices of A and points
// spread over its triangles, about `samples` of them. The nearest point of B comes from a tree of boxes. Cost:
// O((samples + triangles) log triangles), but for long thin triangles side by side, whose boxes lie over one another.
// Then the search ends when points have looked at most_tries triangles each, and more_tries in all.
#ifndef HF_SAMPLES_QUADS_SURFACE_DISTANCE_H
#define HF_SAMPLES_QUADS_SURFACE_DISTANCE_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/face_triangles.h"

namespace samples {

struct TriangleSoup {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;
};
// The same with positions that others hold too.
struct SharedSoup {
  const std::vector<glm::dvec3>* positions = nullptr;
  std::vector<uint32_t> triangles;
};

// Appends the triangles of a face of a quad mesh that distances are measured on. A quad that is not flat has two cuts:
// this takes the one at its first corner where both triangles face the quad's side. The figures of the docs and the
// bounds of the tests are of this cut; the Delaunay one gives distances up to a fifth larger on creatures.
void append_measured(FaceTriangles& cut, const std::vector<glm::dvec3>& positions, const uint32_t* corners,
                     uint32_t size, std::vector<uint32_t>& triangles);

class NearestPoint {
 public:
  // The soup must outlive *this.
  explicit NearestPoint(const TriangleSoup& soup) : NearestPoint(soup.positions, soup.triangles) {}
  explicit NearestPoint(const SharedSoup& soup) : NearestPoint(*soup.positions, soup.triangles) {}
  // triangle: NULL, or receives the number of the nearest one.
  double distance(const glm::dvec3& p, uint32_t* triangle = nullptr) const;
  uint64_t tries() const { return tries_; }  // triangles that were looked at so far

 private:
  struct Box {
    glm::dvec3 low, high;
    uint32_t first, count, right;  // a leaf's triangles, or its right child (the left one is the next box)
  };
  NearestPoint(const std::vector<glm::dvec3>& positions, const std::vector<uint32_t>& triangles);
  uint32_t build(uint32_t first, uint32_t count);
  const std::vector<glm::dvec3>& positions_;
  const std::vector<uint32_t>& triangles_;
  std::vector<uint32_t> order_;
  std::vector<Box> boxes_;
  mutable uint64_t tries_ = 0;
};

struct SurfaceDistance {
  // Points of six real meshes look at 12 triangles each. 5,000,000 take about 0.1 s.
  static constexpr uint64_t most_tries = 50, more_tries = 5000000;
  bool measured = true;  // false: the search stopped, and the numbers below are too small
  double a_to_b = 0, b_to_a = 0, mean_a_to_b = 0;
  double largest() const { return a_to_b > b_to_a ? a_to_b : b_to_a; }
};
SurfaceDistance surface_distance(const TriangleSoup& a, const TriangleSoup& b, uint32_t samples = 60000);

}  // namespace samples

#endif
