#include "sequence_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "hf/surface.h"
#include "support/dense.h"

namespace sequences {
namespace {

using Point = Eigen::Vector3d;

Point position(const Surface& s, std::uint32_t v) {
  const float* p = s.positions.data() + std::size_t{3} * v;
  return {double(p[0]), double(p[1]), double(p[2])};
}

// Nearly equilateral triangles over columns x rows cells, slightly bent. Returns the first vertex.
std::uint32_t put_lattice(Surface& s, std::uint32_t columns, std::uint32_t rows, float x0, float shear = 0) {
  const std::uint32_t first = s.vertex_count(), width = columns + 1;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      const float x = x0 + float(i) + (j % 2 ? 0.5f : 0.0f), y = 0.875f * float(j);
      s.positions.insert(s.positions.end(), {x + shear * y, y, 0.125f * std::sin(0.9f * x) * std::cos(0.7f * y)});
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = first + j * width + i, b = a + 1, c = a + width, d = c + 1;
      if (j % 2)
        s.triangles.insert(s.triangles.end(), {a, b, d, a, d, c});
      else
        s.triangles.insert(s.triangles.end(), {a, b, c, b, d, c});
    }
  }
  return first;
}

Surface lattice() {
  Surface s;
  s.name = "lattice";
  put_lattice(s, 4, 4, 0);
  return s;
}

// Two sheets along a seam of copies, an island, a vertex in no triangle, a triangle of equal corners.
Surface cut() {
  Surface s;
  s.name = "cut";
  put_lattice(s, 3, 3, 0);
  put_lattice(s, 3, 3, 3);
  put_lattice(s, 2, 2, 20);
  s.positions.insert(s.positions.end(), {30, 1, 2});
  s.triangles.insert(s.triangles.end(), {0, 0, 1});
  return s;
}

// The octahedron, its edges halved, on the sphere.
Surface ball() {
  Surface s;
  s.name = "ball";
  const float corner[6][3] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const std::uint32_t face[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                                    {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  for (const auto& c : corner) s.positions.insert(s.positions.end(), c, c + 3);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
  const auto between = [&](std::uint32_t a, std::uint32_t b) {
    const auto key = std::minmax(a, b);
    const auto found = middle.find(key);
    if (found != middle.end()) return found->second;
    const Point m = (position(s, a) + position(s, b)).normalized();
    s.positions.insert(s.positions.end(), {float(m.x()), float(m.y()), float(m.z())});
    return middle[key] = s.vertex_count() - 1;
  };
  for (const auto& f : face) {
    const std::uint32_t a = between(f[0], f[1]), b = between(f[1], f[2]), c = between(f[2], f[0]);
    s.triangles.insert(s.triangles.end(), {f[0], a, c, f[1], b, a, f[2], c, b, a, b, c});
  }
  return s;
}

Surface one_triangle() {
  Surface s;
  s.name = "one triangle";
  s.positions = {0, 0, 0, 1, 0, 0, 0.5f, 0.75f, 0.25f};
  s.triangles = {0, 1, 2};
  return s;
}

// Obtuse triangles, one of them turned over, and a fin: an edge of three triangles.
Surface rough() {
  Surface s;
  s.name = "rough";
  put_lattice(s, 4, 3, 0, 1.5f);
  std::swap(s.triangles[3], s.triangles[4]);
  s.positions.insert(s.positions.end(), {2.5f, 1.25f, 1.5f});
  s.triangles.insert(s.triangles.end(), {s.triangles[6], s.triangles[7], s.vertex_count() - 1});
  return s;
}

// Three components of which one is a single triangle, far from the origin and small.
Surface islands() {
  Surface s;
  s.name = "islands";
  put_lattice(s, 2, 2, 0, 0.75f);
  put_lattice(s, 2, 3, 8, -0.5f);
  const std::uint32_t v = s.vertex_count();
  s.positions.insert(s.positions.end(), {20, 0, 0, 21, 0, 0, 20.25f, 1, 0});
  s.triangles.insert(s.triangles.end(), {v, v + 1, v + 2});
  for (std::size_t i = 0; i < s.positions.size(); ++i) s.positions[i] = s.positions[i] / 1024 + (i % 3 == 0 ? 16 : 0);
  return s;
}

void weld(Surface& s) {
  std::map<std::array<float, 3>, int> place;
  std::vector<int> welded(s.vertex_count());
  for (std::uint32_t v = 0; v < s.vertex_count(); ++v) {
    const float* p = s.positions.data() + std::size_t{3} * v;
    welded[v] = place.emplace(std::array<float, 3>{p[0], p[1], p[2]}, static_cast<int>(v)).first->second;
  }
  s.inner = welded;  // for usable()
  std::vector<bool> used(s.vertex_count(), false);
  std::vector<int> label(s.vertex_count());
  for (std::size_t v = 0; v < label.size(); ++v) label[v] = static_cast<int>(v);
  for (bool changed = true; changed;) {  // the smallest vertex spreads
    changed = false;
    for (std::uint32_t t = 0; t < s.triangle_count(); ++t) {
      if (!s.usable(t)) continue;
      const std::uint32_t* v = s.triangles.data() + std::size_t{3} * t;
      int least = label[at(welded[v[0]])];
      for (int k = 0; k < 3; ++k) {
        used[at(welded[v[k]])] = true;
        least = std::min(least, label[at(welded[v[k]])]);
      }
      for (int k = 0; k < 3; ++k) changed |= std::exchange(label[at(welded[v[k]])], least) != least;
    }
  }
  std::map<int, int> component_of_label, number;
  for (std::uint32_t v = 0; v < s.vertex_count(); ++v) {
    const int w = welded[v];
    s.inner[v] = -1;
    if (!used[at(w)]) continue;
    const auto [it, fresh] = number.emplace(w, s.inner_count);
    s.inner[v] = it->second;
    if (!fresh) continue;
    ++s.inner_count;
    s.component.push_back(
        component_of_label.emplace(label[at(w)], static_cast<int>(component_of_label.size())).first->second);
  }
  s.component_count = static_cast<int>(component_of_label.size());
}

double cotangent(const Surface& s, std::uint32_t t, int corner) {
  const std::uint32_t* v = s.triangles.data() + std::size_t{3} * t;
  const Point o = position(s, v[corner]), a = position(s, v[(corner + 1) % 3]) - o,
              b = position(s, v[(corner + 2) % 3]) - o;
  return a.dot(b) / a.cross(b).norm();
}

}  // namespace

bool Surface::usable(std::uint32_t t) const {
  const std::uint32_t* v = triangles.data() + std::size_t{3} * t;
  return inner[v[0]] != inner[v[1]] && inner[v[1]] != inner[v[2]] && inner[v[2]] != inner[v[0]];
}

const std::vector<Surface>& surfaces() {
  static const std::vector<Surface> all = [] {
    std::vector<Surface> made = {lattice(), cut(), ball(), one_triangle(), rough(), islands()};
    for (Surface& s : made) {
      weld(s);
      s.acute = true;
      for (std::uint32_t t = 0; t < s.triangle_count(); ++t) {
        for (int k = 0; k < 3 && s.usable(t); ++k) s.acute = s.acute && cotangent(s, t, k) >= 0;
      }
    }
    return made;
  }();
  return all;
}

Operator make_operator(const Surface& s, int operator_kind, int field_kind) {
  const int n = s.inner_count;
  std::map<std::pair<int, int>, double> weights;
  Eigen::VectorXd area = Eigen::VectorXd::Zero(n);
  for (std::uint32_t t = 0; t < s.triangle_count(); ++t) {
    if (!s.usable(t)) continue;
    const std::uint32_t* v = s.triangles.data() + std::size_t{3} * t;
    for (int k = 0; k < 3; ++k) {
      const int a = s.inner[v[(k + 1) % 3]], b = s.inner[v[(k + 2) % 3]];
      weights[std::minmax(a, b)] += 0.5 * cotangent(s, t, k);
      area[a] += (position(s, v[1]) - position(s, v[0])).cross(position(s, v[2]) - position(s, v[0])).norm() / 6;
    }
  }
  if (operator_kind == HF_OPERATOR_UNIFORM) {
    for (auto& w : weights) w.second = 1;
  } else if (operator_kind == HF_OPERATOR_CLAMPED) {
    std::vector<double> sizes;
    for (const auto& w : weights) sizes.push_back(std::fabs(w.second));
    std::sort(sizes.begin(), sizes.end());
    for (auto& w : weights) w.second = std::max(w.second, 1e-3 * sizes[sizes.size() / 2]);
  }
  Operator made;
  made.matrix = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [edge, w] : weights) {
    made.matrix(edge.first, edge.second) -= w;
    made.matrix(edge.second, edge.first) -= w;
    made.matrix(edge.first, edge.first) += w;
    made.matrix(edge.second, edge.second) += w;
  }
  std::vector<double> count(at(s.component_count), 0), mean(at(s.component_count), 0);
  for (int v = 0; v < n; ++v) {
    count[at(s.component[at(v)])] += 1;
    mean[at(s.component[at(v)])] += area[v];
  }
  if (field_kind == HF_FIELD_BIHARMONIC) {
    Eigen::VectorXd inverse(n);
    for (int v = 0; v < n; ++v) inverse[v] = mean[at(s.component[at(v)])] / count[at(s.component[at(v)])] / area[v];
    made.matrix = hf_test::dense_product(made.matrix, Eigen::MatrixXd(inverse.asDiagonal() * made.matrix));
  } else if (field_kind == HF_FIELD_BIHARMONIC_GRAPH) {
    made.matrix = hf_test::dense_product(made.matrix, made.matrix);
  }
  made.mean_diagonal.assign(at(s.component_count), 0);
  for (int v = 0; v < n; ++v) {
    made.mean_diagonal[at(s.component[at(v)])] += std::fabs(made.matrix(v, v)) / count[at(s.component[at(v)])];
  }
  return made;
}

}  // namespace sequences
