#include "mesh/laplacian.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// Number of triangles or edges that one thread's job takes. Half and twice the value take the same time within 10 %,
// the noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t weights_piece = 32768;
// In the area of a triangle with edges a >= b >= c, b + c - a counts as at least this share of a. It keeps the area
// positive. It is a guard. Half and double change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double least_gap = 1e-12;
// A thin triangle with edges a >= b >= c is widened until b + c - a is this share of a. A flat triangle then has
// cotangents of 350. Less gives larger cotangents, more moves the field of shapes that are only thin. Half and double
// change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double closing_gap = 1e-6;
// A cross product keeps fewer than seven digits if twice the area over the longest edge squared is below this number.
// Such triangles go the slower way by their edges. A larger number uses the slower way without need. Half and double
// change no bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr double least_area = 1e-9;
// The clamped operator raises edge weights to this share of the median weight. Positive weights keep the field within
// its site values. A smaller number would worsen the condition number of the matrix. A larger one changes fields. Half
// and double move fields on eight shapes by at most 3e-4 and 6e-4 of their range, on one with angles of 0.01 degrees.
constexpr double least_weight = 1e-3;

// Calls work(begin, end) for fixed pieces of the range [0, count).
template <class Work>
void in_pieces(JobRunner* jobs, std::size_t count, Work&& work) {
  for_each(jobs, static_cast<std::uint32_t>((count + weights_piece - 1) / weights_piece),
           [&](std::uint32_t p) { work(p * weights_piece, std::min(count, (p + std::size_t{1}) * weights_piece)); });
}

}  // namespace

// Uses Kahan's formula, which is stable for needle triangles. It needs the lengths in the order a >= b >= c.
double quadruple_area(const double length[3]) noexcept {
  double a = length[0], b = length[1], c = length[2];
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double gap = std::max(c - (a - b), least_gap * a);
  return std::sqrt((a + (b + c)) * gap * (c + (a - b)) * (a + (b - c)));
}

void cotangents_of_lengths(const double length[3], double cotangent[3]) noexcept {
  const double area4 = quadruple_area(length);
  for (int k = 0; k < 3; ++k) {
    const double x = length[k], y = length[(k + 1) % 3], z = length[(k + 2) % 3];
    cotangent[k] = (y * y + z * z - x * x) / area4;
  }
}

namespace {

// Computes the cotangents of a triangle so thin that its stiffness matrix would have rank 1 in floating point. With
// such a matrix the Laplacian may lose definiteness. So each edge is lengthened by just enough to get b + c - a >=
// closing_gap a. This is the mollification of Sharp and Crane 2020 for one triangle alone.
void thin_cotangents(const double squared[3], double cotangent[3]) noexcept {
  double length[3] = {std::sqrt(squared[0]), std::sqrt(squared[1]), std::sqrt(squared[2])};
  const double longest = std::max({length[0], length[1], length[2]});
  if (!(longest > 0)) {
    cotangent[0] = cotangent[1] = cotangent[2] = 1 / std::sqrt(3.0);  // three points at one place: equilateral
    return;
  }
  const double gap = length[0] + length[1] + length[2] - 2 * longest;
  const double more = std::max(0.0, closing_gap * longest - gap);
  for (int k = 0; k < 3; ++k) length[k] += more;
  cotangents_of_lengths(length, cotangent);
}

}  // namespace

bool is_widened(const Mesh& mesh, Index t) noexcept {
  const Index* v = mesh.triangle(t);
  const Vec3 p[3] = {mesh.positions[at(v[0])], mesh.positions[at(v[1])], mesh.positions[at(v[2])]};
  const Vec3 e[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
  return !(norm(cross(e[0], e[1])) > least_area * std::max({dot(e[0], e[0]), dot(e[1], e[1]), dot(e[2], e[2])}));
}

// The cotangent of the angle between the edges u and v is (u . v) / |u x v|.
void corner_cotangents(const Mesh& mesh, Index t, double cotangent[3]) noexcept {
  const Index* v = mesh.triangle(t);
  const Vec3 p[3] = {mesh.positions[at(v[0])], mesh.positions[at(v[1])], mesh.positions[at(v[2])]};
  corner_cotangents(p, cotangent);
}

void widened_cotangents(const Vec3 p[3], double cotangent[3]) noexcept {
  const Vec3 e[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};
  const double squared[3] = {dot(e[0], e[0]), dot(e[1], e[1]), dot(e[2], e[2])};
  thin_cotangents(squared, cotangent);
}

void corner_cotangents(const Vec3 p[3], double cotangent[3]) noexcept {
  const Vec3 e[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};  // opposite to corner k
  const double squared[3] = {dot(e[0], e[0]), dot(e[1], e[1]), dot(e[2], e[2])};
  const double area2 = norm(cross(e[0], e[1]));
  if (!(area2 > least_area * std::max({squared[0], squared[1], squared[2]})))
    return thin_cotangents(squared, cotangent);
  for (int k = 0; k < 3; ++k) cotangent[k] = -dot(e[(k + 1) % 3], e[(k + 2) % 3]) / area2;
}

namespace {

Vector<double> cotangent_weights(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs) {
  Buffer<double> corner(memory, mesh.corners.size());
  in_pieces(jobs, at(mesh.triangle_count()), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) corner_cotangents(mesh, static_cast<Index>(t), corner.data() + 3 * t);
  });
  Vector<double> weights(at(topology.edge_count()), 0.0, &memory);
  in_pieces(jobs, weights.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      for (Index i = topology.edge_triangle_start[e]; i < topology.edge_triangle_start[e + 1]; ++i) {
        const std::size_t c = at(topology.corner(i));
        weights[e] += 0.5 * corner[c % 3 == 0 ? c + 2 : c - 1];  // the corner opposite the side
      }
    }
  });
  return weights;
}

}  // namespace

// The median is used because needle triangles would dominate the mean.
double clamped_floor(const Vector<double>& weights, Memory& memory) {
  Vector<double> magnitude(weights.size(), &memory);
  std::transform(weights.begin(), weights.end(), magnitude.begin(), [](double w) { return std::fabs(w); });
  const auto middle = magnitude.begin() + static_cast<std::ptrdiff_t>(magnitude.size() / 2);
  std::nth_element(magnitude.begin(), middle, magnitude.end());
  return *middle > 0 ? least_weight * *middle : least_weight;
}

Vector<double> edge_weights(const Mesh& mesh, const Topology& topology, OperatorKind kind, Memory& memory,
                            JobRunner* jobs) {
  if (kind == OperatorKind::uniform) return Vector<double>(at(topology.edge_count()), 1.0, &memory);
  Vector<double> weights = cotangent_weights(mesh, topology, memory, jobs);
  if (kind == OperatorKind::clamped) {
    const double floor = clamped_floor(weights, memory);
    for (double& w : weights) w = std::max(w, floor);
  }
  return weights;
}

std::uint32_t count_negative(const Vector<double>& weights) noexcept {
  return static_cast<std::uint32_t>(std::count_if(weights.begin(), weights.end(), [](double w) { return w < 0; }));
}

Vector<double> vertex_areas(const Mesh& mesh, Memory& memory, JobRunner* jobs) {
  Buffer<double> third(memory, at(mesh.triangle_count()));
  in_pieces(jobs, third.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Index* v = mesh.triangle(static_cast<Index>(t));
      const Vec3 a = mesh.positions[at(v[0])];
      const Vec3 normal = cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a);
      third[t] = std::sqrt(dot(normal, normal)) / 6.0;
    }
  });
  Vector<double> areas(mesh.positions.size(), 0.0, &memory);
  for (std::size_t t = 0; t < third.size(); ++t) {
    const Index* v = mesh.triangle(static_cast<Index>(t));
    for (int k = 0; k < 3; ++k) areas[at(v[k])] += third[t];
  }
  return areas;
}

SymmetricMatrix laplacian(const Topology& topology, const Vector<double>& weights, Memory& memory, JobRunner* jobs) {
  SymmetricMatrix matrix(memory);
  const std::size_t n = topology.neighbour_start.size() - 1;
  matrix.column_start.resize(n + 1);
  matrix.row.resize(topology.neighbour.size() + n);
  matrix.value.resize(topology.neighbour.size() + n);
  in_pieces(jobs, n, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      std::size_t k = at(topology.neighbour_start[v]) + v;  // each earlier column has one diagonal entry
      matrix.column_start[v] = static_cast<Index>(k);
      double sum = 0;
      std::size_t diagonal = 0;
      bool placed = false;
      const auto place = [&] {
        diagonal = k;
        matrix.row[k++] = static_cast<Index>(v);
        placed = true;
      };
      for (Index i = topology.neighbour_start[v]; i < topology.neighbour_start[v + 1]; ++i) {
        if (!placed && at(topology.neighbour[at(i)]) > v) place();
        const double w = weights[at(topology.neighbour_edge[at(i)])];
        matrix.row[k] = topology.neighbour[at(i)];
        matrix.value[k++] = -w;
        sum += w;
      }
      if (!placed) place();
      matrix.value[diagonal] = sum;
    }
  });
  matrix.column_start[n] = static_cast<Index>(matrix.row.size());
  return matrix;
}

void tie_weakly(SymmetricMatrix& matrix, double share, Memory& memory) {
  const std::size_t n = at(matrix.size());
  Vector<double> diagonal(n, &memory);
  for (std::size_t v = 0; v < n; ++v) diagonal[v] = matrix.value[matrix.diagonal(static_cast<Index>(v))];
  for (std::size_t v = 0; v < n; ++v) {
    double rest = 0;
    for (std::size_t i = at(matrix.column_start[v]); i < at(matrix.column_start[v + 1]); ++i) {
      const std::size_t w = at(matrix.row[i]);
      if (w == v) continue;
      matrix.value[i] -= share * std::max(diagonal[v], diagonal[w]);
      rest += matrix.value[i];
    }
    matrix.value[matrix.diagonal(static_cast<Index>(v))] = -rest;
  }
}

void confine_weights(SymmetricMatrix& matrix, Span<const Index> component, const Vector<std::uint8_t>& confined,
                     double spread, Memory& memory) {
  struct Entry {
    Index component;
    double weight;
    std::size_t position;
  };
  Vector<Entry> entries(&memory);
  for (Index v = 0; v < matrix.size(); ++v) {
    if (!confined[at(component[at(v)])]) continue;
    for (std::size_t i = at(matrix.column_start[at(v)]); i < at(matrix.column_start[at(v) + 1]); ++i) {
      if (matrix.row[i] != v) entries.push_back({component[at(v)], std::fabs(matrix.value[i]), i});
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    if (a.component != b.component) return a.component < b.component;
    return a.weight != b.weight ? a.weight < b.weight : a.position < b.position;
  });
  for (std::size_t begin = 0; begin < entries.size();) {
    std::size_t end = begin, zeros = begin;
    for (; end < entries.size() && entries[end].component == entries[begin].component; ++end)
      zeros += entries[end].weight == 0;
    const double median = zeros < end ? entries[zeros + (end - zeros) / 2].weight : 1.0;
    for (; begin < end; ++begin)
      matrix.value[entries[begin].position] =
          -std::min(std::max(entries[begin].weight, median / spread), median * spread);
  }
  for (Index v = 0; v < matrix.size(); ++v) {
    if (!confined[at(component[at(v)])]) continue;
    double rest = 0;
    for (std::size_t i = at(matrix.column_start[at(v)]); i < at(matrix.column_start[at(v) + 1]); ++i)
      rest += matrix.row[i] == v ? 0.0 : matrix.value[i];
    matrix.value[matrix.diagonal(v)] = -rest;
  }
}

}  // namespace hf_inner::mesh
