#include "quads/cross_field.h"

#include <algorithm>
#include <cmath>

#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

// Curvatures that differ by this many radians over a length of sqrt(area) count half. Smaller: flat parts follow noise.
// In 26 runs half turns 8 % more triangles of the map over, double 6 %; mean distances change by 4 %.
constexpr double half_trust = 3.0;
// A wish below this length everywhere says nothing: the first solve then starts from one arbitrary direction. With 0
// and 0.1, 15 runs stay the same. Half and double give a sphere, whose wishes are shorter, the same quads.
constexpr double least_wish = 1e-3;
// Rounds after the first solve: each takes a solve, and the crosses come nearer to length 1. Half and double give 4 and
// 5 % fewer irregular vertices in 15 runs, and larger distances.
constexpr Index smooth_rounds = 8;

Vec3 triangle_normal(const mesh::Mesh& mesh, Index t) noexcept {
  const Index* c = mesh.triangle(t);
  const Vec3 a = mesh.positions[at(c[0])];
  return unit_vector(cross(mesh.positions[at(c[1])] - a, mesh.positions[at(c[2])] - a));
}

// An entry of a matrix, 0 where none is stored.
double entry(const SymmetricMatrix& matrix, Index row, Index column) {
  const auto begin = matrix.row.begin() + matrix.column_start[at(column)],
             end = matrix.row.begin() + matrix.column_start[at(column) + 1], found = std::lower_bound(begin, end, row);
  return found != end && *found == row ? matrix.value[static_cast<std::size_t>(found - matrix.row.begin())] : 0.0;
}

}  // namespace

Vector<Complex> curvature_crosses(const surface::Core& core, const field::Connection& connection, Index passes) {
  const mesh::Mesh& mesh = core.mesh;
  const mesh::Topology& topology = core.topology();
  Memory& memory = *core.memory;
  const std::size_t n = at(core.size());
  // difference: the difference of the principal curvatures, as a number of the second degree. sum: their sum.
  Vector<Complex> difference(n, Complex(0, 0), &memory), next(n, &memory);
  Vector<double> sum(n, 0.0, &memory), next_sum(n, &memory);
  double whole = 0;
  for (const double area : core.areas) whole += area;
  Poller poller;
  for (Index e = 0; e < topology.edge_count(); ++e) {
    poller.due();
    const Index first = topology.edge_triangle_start[at(e)];
    if (topology.edge_triangle_start[at(e) + 1] - first != 2) continue;
    const Index a = topology.first(e), b = topology.second(e);
    const Index s = topology.triangle(first), t = topology.triangle(first + 1);
    const Vec3 edge = mesh.positions[at(b)] - mesh.positions[at(a)], p = triangle_normal(mesh, s),
               q = triangle_normal(mesh, t);
    const double length = norm(edge);
    if (!(length > 0)) continue;
    // The sign of the bend: whether the corner of t lies below the plane of s.
    Vec3 corner{};
    for (int k = 0; k < 3; ++k) {
      const Index v = mesh.triangle(t)[k];
      if (v != a && v != b) corner = mesh.positions[at(v)];
    }
    const double angle = arc_tangent(norm(cross(p, q)), dot(p, q));
    const double bend = dot(corner - mesh.positions[at(a)], p) <= 0 ? angle : -angle;
    for (const Index v : {a, b}) {
      const Complex along = unit_of(connection.to_frame(v, edge), 0);
      const double share = bend * length / 2 / core.areas[at(v)];
      difference[at(v)] += share * along * along;
      sum[at(v)] += share;
    }
  }
  for (Index pass = 0; pass < passes; ++pass) {
    for (Index v = 0; v < core.size(); ++v) {
      poller.due();
      double weight = core.areas[at(v)];
      Complex total = weight * difference[at(v)];
      double total_sum = weight * sum[at(v)];
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology.neighbour[at(i)], e = topology.neighbour_edge[at(i)];
        const double area = core.areas[at(w)];
        total += area * difference[at(w)] * field::at_angle(1.0, 2 * connection.turn(topology, e, v));
        total_sum += area * sum[at(w)];
        weight += area;
      }
      next[at(v)] = weight > 0 ? total / weight : Complex(0, 0);
      next_sum[at(v)] = weight > 0 ? total_sum / weight : 0;
    }
    difference.swap(next);
    sum.swap(next_sum);
  }
  const double size = std::sqrt(whole);
  for (std::size_t v = 0; v < n; ++v) {
    const double amount = field::length_of(difference[v]);
    if (!(amount > 0) || !std::isfinite(amount)) {
      next[v] = 0;
      continue;
    }
    const double relative = amount / std::max(std::fabs(sum[v]), amount);
    const double bend = amount * size;
    const Complex along = difference[v] / amount;
    next[v] = relative * bend / (bend + half_trust) * along * along;
  }
  return next;
}

CrossSmoother::CrossSmoother(const field::DirectionMatrix& system, double radius)
    : system_(system), radius_(radius), matrix_(*system.core->memory) {
  const surface::Core& core = *system.core;
  const double t = 1 / (radius * radius);
  matrix_.column_start.assign(system.matrix.column_start.begin(), system.matrix.column_start.end());
  matrix_.row.assign(system.matrix.row.begin(), system.matrix.row.end());
  matrix_.value.assign(system.matrix.value.begin(), system.matrix.value.end());
  for (Index v = 0; v < core.size(); ++v) {
    for (Index part = 0; part < 2; ++part)
      matrix_.value[matrix_.diagonal(system.unknown(v, part))] += t * core.areas[at(v)];
  }
  solver_.emplace(matrix_, system.factorise(matrix_), *core.memory, *core.jobs);
}

Vector<Complex> CrossSmoother::smooth(Span<const Complex> wish, Span<const HardCross> hard,
                                      Span<const SeenCross> seen) {
  const field::DirectionMatrix& system = system_;
  const surface::Core& core = *system.core;
  Memory& memory = *core.memory;
  const std::size_t n = at(core.size());
  const double t = 1 / (radius_ * radius_);
  DefiniteSystem& solver = *solver_;
  solver.set_scale(1);
  // Nothing of the call stays, also when it is cancelled: updates of quads keep the solver.
  const struct Forget {
    DefiniteSystem& solver;
    ~Forget() { solver.forget(); }
  } forget{solver};
  double most = 0;
  for (const Complex& w : wish) most = std::max(most, field::length_of(w));
  Vector<Complex> field(n, Complex(0, 0), &memory), target(wish.begin(), wish.end(), &memory);
  if (most < least_wish && hard.empty()) {
    for (Complex& w : target) w += Complex(1, 0);
  }
  Vector<double> right(2 * n, &memory), x(2 * n, &memory);
  Vector<Index> unknowns(&memory);
  Vector<double> values(&memory);
  for (const HardCross& h : hard) {
    for (Index part = 0; part < 2; ++part) {
      unknowns.push_back(system.unknown(h.vertex, part));
      values.push_back(part == 0 ? h.cross.real() : h.cross.imag());
    }
  }
  if (!hard.empty()) solver.fix(unknowns, values);
  for (Index round = 0; round <= smooth_rounds; ++round) {
    report(static_cast<float>(round) / static_cast<float>(smooth_rounds + 1));
    for (Index v = 0; v < core.size(); ++v) {
      const Complex w = t * core.areas[at(v)] * target[at(v)];
      right[at(system.unknown(v, 0))] = w.real();
      right[at(system.unknown(v, 1))] = w.imag();
    }
    for (const SeenCross& s : seen) {
      for (Index k = 0; k < 4; ++k) {
        const Index row = system.unknown(s.neighbour, k / 2), column = system.unknown(s.vertex, k % 2);
        right[at(row)] -= entry(matrix_, row, column) * (k % 2 == 0 ? s.change.real() : s.change.imag());
      }
    }
    solver.set_right(right);
    solver.solve(x.data());
    for (Index v = 0; v < core.size(); ++v) {
      field[at(v)] = Complex(x[at(system.unknown(v, 0))], x[at(system.unknown(v, 1))]);
      target[at(v)] = wish[at(v)] + std::max(0.0, 1 - field::length_of(wish[at(v)])) * unit_of(field[at(v)], 0);
    }
  }
  return field;
}

}  // namespace hf_inner::quads
