// The vertex areas of an intrinsic Delaunay triangulation.
//
// A quad on one circle has two Delaunay diagonals. Which of them the flips leave follows from their order, and so from
// the order of the faces. The weight of both is 0, but they share the area of the quad in other ways. So where a flip
// made the diagonal, the mesh's own diagonal counts, or the mean of both if neither is an edge of the mesh.
#include <algorithm>
#include <cmath>

#include "base/hypotenuse.h"
#include "mesh/intrinsic.h"

namespace hf_inner::mesh {
namespace {

// A sum of cotangents that divides counts as at least this, so that a flat face does not divide by zero.
constexpr double least_sum = 1e-300;
// An intrinsic edge is one of the mesh if the lengths differ by less than this share. It is above the rounding of
// lengths. More takes edges around a bend for straight ones.
constexpr double same_length = 1e-9;

bool is_edge(const Mesh& mesh, const Topology& topology, Index a, Index b, double length) noexcept {
  if (topology.edge_between(a, b) == Mesh::none) return false;
  return std::fabs(norm(mesh.positions[at(b)] - mesh.positions[at(a)]) - length) <= same_length * length;
}

}  // namespace

void IntrinsicTriangulation::even_out(const Mesh& mesh, const Topology& topology, Index half,
                                      Vector<double>& areas) const {
  const Index twin = twin_[at(half)], h[3] = {half, next(half), next(next(half))},
              g[3] = {twin, next(twin), next(next(twin))};
  const double a = cotangent_[at(half)], b = cotangent_[at(twin)];
  if (half / 3 == twin / 3 || std::fabs(a + b) > delaunay_rounding * (1 + std::fabs(a) + std::fabs(b))) return;
  // the quad i, m, j, k in a plane, with i at the origin and j on the x axis
  const Index i = tail_[at(h[0])], j = tail_[at(h[1])], k = tail_[at(h[2])], m = tail_[at(g[2])];
  const double l = length_[at(half)];
  if (is_edge(mesh, topology, i, j, l)) return;
  const auto square = [&](Index side) { return length_[at(side)] * length_[at(side)]; };
  const double xk = 0.5 * (l + (square(h[2]) - square(h[1])) / l), xm = 0.5 * (l + (square(g[1]) - square(g[2])) / l);
  const double yk = std::sqrt(std::max(0.0, square(h[2]) - xk * xk)),
               ym = std::sqrt(std::max(0.0, square(g[1]) - xm * xm));
  const double upper = 0.5 * l * yk, lower = 0.5 * l * ym, left = 0.5 * (xk * ym + xm * yk),
               right = upper + lower - left;
  const bool own = is_edge(mesh, topology, k, m, hypotenuse(xk - xm, yk + ym));
  const double part = share(half / 3) * (own ? 1.0 : 0.5) / 3;
  areas[at(i)] += part * (left - upper - lower);
  areas[at(j)] += part * (right - upper - lower);
  areas[at(k)] += part * (left + right - upper);
  areas[at(m)] += part * (left + right - lower);
}

Vector<double> IntrinsicTriangulation::vertex_areas(const Mesh& mesh, const Topology& topology, Memory& memory) const {
  Vector<double> areas(at(mesh.vertex_count()), 0.0, &memory);
  for (Index f = 0; f < face_count(); ++f) {
    // The area of the face follows from |ij|^2 = 2 area (cot at i + cot at j).
    const std::size_t h = 3 * at(f);
    std::size_t k = 0;  // the longest side, whose quotient has the smallest rounding error
    for (std::size_t q = 1; q < 3; ++q) k = length_[h + q] > length_[h + k] ? q : k;
    const double base = length_[h + k], sum = cotangent_[h + (k + 1) % 3] + cotangent_[h + (k + 2) % 3];
    const double third = share(f) * base * base / (6 * std::max(sum, least_sum));
    for (std::size_t q = 0; q < 3; ++q) areas[at(tail_[h + q])] += third;
  }
  for (Index half = 0; half < static_cast<Index>(flipped_.size()); ++half) {
    if (flipped_[at(half)] && half < twin_[at(half)]) even_out(mesh, topology, half, areas);
  }
  return areas;
}

}  // namespace hf_inner::mesh
