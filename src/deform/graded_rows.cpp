#include "deform/graded_rows.h"

#include <algorithm>
#include <limits>

#include "base/error.h"

namespace hf_inner::deform {
namespace {

// A cluster that a vertex does not have gets an entry from this share of the vertex's largest gradient on. Half as much
// adds entries that bend no normal; ten times as much turns normals beside handles by twice the angle.
constexpr double least_gradient_share = 0.01;

// The triangles at each vertex.
struct Around {
  Around(const mesh::Mesh& mesh, Memory& memory) : start(mesh.positions.size() + 1, 0, &memory), triangle(&memory) {
    for (const std::int32_t v : mesh.corners) ++start[v + 1];
    for (std::size_t v = 0; v + 1 < start.size(); ++v) start[v + 1] += start[v];
    triangle.resize(mesh.corners.size());
    Vector<std::int32_t> next(start, &memory);
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
      triangle[next[mesh.corners[i]]++] = static_cast<std::int32_t>(i / 3);
  }
  Vector<std::int32_t> start, triangle;
};

// Sums of gradients by cluster, for one vertex after the other.
class ClusterSums {
 public:
  ClusterSums(std::int32_t clusters, Memory& memory)
      : place_(static_cast<std::size_t>(clusters), -1, &memory), cluster_(&memory), sum_(&memory) {}
  void begin() noexcept {
    for (const std::uint16_t c : cluster_) place_[c] = -1;
    cluster_.clear();
    sum_.clear();
  }
  void add(std::uint16_t cluster, Vec3 gradient) {
    if (place_[cluster] < 0) {
      place_[cluster] = static_cast<std::int32_t>(cluster_.size());
      cluster_.push_back(cluster);
      sum_.push_back({});
    }
    Vec3& sum = sum_[place_[cluster]];
    sum = sum + gradient;
  }
  const Vector<std::uint16_t>& clusters() const noexcept { return cluster_; }
  const Vector<Vec3>& sums() const noexcept { return sum_; }

 private:
  Vector<std::int32_t> place_;
  Vector<std::uint16_t> cluster_;
  Vector<Vec3> sum_;
};

// Adds the gradients in a triangle, times twice its area. Returns twice the area.
double add_triangle(const mesh::Mesh& mesh, const ClusterWeights& weights, std::int32_t t, ClusterSums& sums) {
  const std::int32_t* corner = mesh.triangle(t);
  const Vec3 p[3] = {mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]};
  const Vec3 area = cross(p[1] - p[0], p[2] - p[0]);
  const double length = norm(area);
  if (!(length > 0)) return 0;
  for (int j = 0; j < 3; ++j) {
    // gradient of the linear function that is 1 at corner j and 0 at the others
    const Vec3 gradient = (1 / length) * cross(area, p[(j + 2) % 3] - p[(j + 1) % 3]);
    for (std::int32_t k = weights.start[corner[j]]; k < weights.start[corner[j] + 1]; ++k)
      sums.add(weights.cluster[k], static_cast<double>(weights.weight[k]) * gradient);
  }
  return length;
}

}  // namespace

GradedRows graded_rows(const mesh::Mesh& mesh, const ClusterWeights& weights, Memory& memory) {
  const Around around(mesh, memory);
  ClusterSums sums(weights.cluster_count, memory);
  GradedRows rows(memory);
  rows.start.push_back(0);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::int32_t first = weights.start[v], last = weights.start[v + 1];
    sums.begin();
    for (std::int32_t k = first; k < last; ++k) sums.add(weights.cluster[k], {});
    double twice_area = 0;
    for (std::int32_t i = around.start[v]; i < around.start[v + 1] && first < last; ++i)
      twice_area += add_triangle(mesh, weights, around.triangle[i], sums);
    const double unit = twice_area > 0 ? 1 / twice_area : 0;
    double largest = 0;
    for (const Vec3& sum : sums.sums()) largest = std::max(largest, norm(sum));
    Vec3 left;  // sum of the gradients left out; the clusters of the vertex get it, so that all still sum to 0
    const std::size_t own = static_cast<std::size_t>(last - first);
    for (std::size_t i = 0; i < sums.sums().size(); ++i) {
      const Vec3 sum = sums.sums()[i];
      if (i >= own && norm(sum) < least_gradient_share * largest) {
        left = left + sum;
        continue;
      }
      rows.cluster.push_back(sums.clusters()[i]);
      rows.weight.push_back(i < own ? weights.weight[first + static_cast<std::int32_t>(i)] : 0.0f);
      rows.gradient.push_back(unit * sum);
    }
    for (std::size_t i = 0; i < own; ++i) {
      Vec3& gradient = rows.gradient[static_cast<std::size_t>(rows.start[v]) + i];
      gradient = gradient + static_cast<double>(weights.weight[first + static_cast<std::int32_t>(i)]) * unit * left;
    }
    if (rows.cluster.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the blend has more entries than 31 bits count; use fewer handles");
    rows.start.push_back(static_cast<std::int32_t>(rows.cluster.size()));
  }
  return rows;
}

}  // namespace hf_inner::deform
