#include "deform/blend_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hf_inner::deform {
namespace {

// How far floats of a shader may be outside, as a share of the largest product that a transform sums. A row of 8
// clusters takes 12 roundings of 6e-8: half of it is less than that, and twice as much is not seen either.
constexpr double box_margin = 1e-6;
// A mesh of at most this many vertices is bounded by them, in some 20 us. Twice as many cost twice the time; with none,
// the box of a bent tube of 480 vertices and three handles is 38 times too long.
constexpr std::int32_t few_vertices = 1000;

BlendBox nothing() noexcept {
  constexpr double far = std::numeric_limits<double>::infinity();
  return {{far, far, far}, {-far, -far, -far}};
}

void add(const Vec3& low, const Vec3& high, BlendBox& box) noexcept {
  box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y), std::min(box.low.z, low.z)};
  box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y), std::max(box.high.z, high.z)};
}

// The box of a box that a transform has moved.
BlendBox moved(const BlendBox& box, const Affine& transform) noexcept {
  const Vec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
  double place[3], reach[3];
  for (int i = 0; i < 3; ++i) {
    const double* a = transform.a[i];
    place[i] = a[0] * middle.x + a[1] * middle.y + a[2] * middle.z + a[3];
    reach[i] = std::fabs(a[0]) * half.x + std::fabs(a[1]) * half.y + std::fabs(a[2]) * half.z;
  }
  return {{place[0] - reach[0], place[1] - reach[1], place[2] - reach[2]},
          {place[0] + reach[0], place[1] + reach[1], place[2] + reach[2]}};
}

// The largest product that a shader sums for a vertex in a box: its place can be small where the products are large.
double largest_product(const BlendBox& box, const Affine& transform) noexcept {
  const double most[3] = {std::max(std::fabs(box.low.x), std::fabs(box.high.x)),
                          std::max(std::fabs(box.low.y), std::fabs(box.high.y)),
                          std::max(std::fabs(box.low.z), std::fabs(box.high.z))};
  double largest = 0;
  for (const auto& a : transform.a) {
    largest = std::max(largest, std::fabs(a[3]));
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::fabs(a[j]) * most[j]);
  }
  return largest;
}

}  // namespace

Vector<BlendBox> cluster_boxes(const mesh::Mesh& mesh, const ClusterWeights& weights, Memory& memory) {
  Vector<BlendBox> boxes(static_cast<std::size_t>(weights.cluster_count) + 1, nothing(), &memory);
  const auto clusters_of = [&](std::int32_t v) {
    return Span<const std::uint16_t>(weights.cluster.data() + weights.start[v],
                                     static_cast<std::size_t>(weights.start[v + 1] - weights.start[v]));
  };
  BlendBox run = nothing();  // of vertices with the same clusters, one after the other
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3& p = mesh.positions[v];
    add(p, p, run);
    const Span<const std::uint16_t> own = clusters_of(v);
    if (v + 1 < mesh.vertex_count()) {
      const Span<const std::uint16_t> next = clusters_of(v + 1);
      if (std::equal(own.begin(), own.end(), next.begin(), next.end())) continue;
    }
    for (const std::uint16_t cluster : own) add(run.low, run.high, boxes[cluster]);
    if (own.empty()) add(run.low, run.high, boxes.back());
    run = nothing();
  }
  for (const mesh::Mesh::Isolated& vertex : mesh.isolated) {
    const Vec3 p = mesh.to_inner(vertex.position);
    add(p, p, boxes.back());
  }
  return boxes;
}

BlendBox blended_box(const mesh::Mesh& mesh, const ClusterWeights& weights, const Vector<BlendBox>& boxes,
                     const Affine* transforms) noexcept {
  BlendBox whole = boxes.back();
  const bool by_vertex = transforms && mesh.vertex_count() <= few_vertices;
  for (std::int32_t v = 0; by_vertex && v < mesh.vertex_count(); ++v) {
    const Vec3 p = blend_vertex(mesh, weights, transforms, v);
    add(p, p, whole);
  }
  double largest = 0;
  for (std::size_t c = 0; c + 1 < boxes.size(); ++c) {
    if (boxes[c].empty()) continue;
    if (transforms) largest = std::max(largest, largest_product(boxes[c], transforms[c]));
    if (by_vertex) continue;
    const BlendBox own = transforms ? moved(boxes[c], transforms[c]) : boxes[c];
    add(own.low, own.high, whole);
  }
  for (const double x : {whole.low.x, whole.low.y, whole.low.z, whole.high.x, whole.high.y, whole.high.z})
    largest = std::max(largest, std::fabs(x));
  const double margin = box_margin * largest;
  const Vec3 more{margin, margin, margin};
  return {whole.low - more, whole.high + more};
}

}  // namespace hf_inner::deform
