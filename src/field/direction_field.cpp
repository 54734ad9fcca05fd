#include "field/direction_field.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"
#include "base/number_pool.h"
#include "mesh/places.h"
#include "solve/site_set.h"

namespace hf_inner::field {
namespace {

using Complex = std::complex<double>;

constexpr double two_pi = 6.283185307179586476925286766559;
// Largest coordinate of a vector, so that the square of its length stays finite.
constexpr double most_coordinate = 1e150;
// The tangent part of a unit vector must be at least this long; in a smaller part the direction is mere rounding. A
// larger limit would refuse more vectors that are nearly normal to the surface. Half and double change no bit of
// crosses on seven shapes.
constexpr double least_tangent = 1e-9;

// Raises |z| e^{i phi} to |z| e^{i n phi}, where n is the degree.
Complex raised(Complex z, Index degree) noexcept {
  if (degree == 1) return z;
  const double length = length_of(z);
  if (!(length > 0)) return 0;
  const Complex unit = z / length;
  Complex power = 1;
  for (Index k = 0; k < degree; ++k) power *= unit;
  return length * power;
}

Complex root(Complex z, Index degree) noexcept {
  return degree == 1 ? z : at_angle(length_of(z), angle_of(z) / degree);
}

double wrapped(double angle) noexcept { return angle - two_pi * std::nearbyint(angle / two_pi); }

}  // namespace

DirectionField::DirectionField(std::shared_ptr<const surface::Core> core, std::int32_t degree, std::uint32_t site_limit)
    : solver_(std::move(core), degree), site_limit_(site_limit), constraints_(solver_.core().memory.get()) {}

DirectionField::DirectionField(const DirectionField& other)
    : solver_(other.solver_),
      site_limit_(other.site_limit_),
      constraints_(other.constraints_, &other.memory()),
      count_(other.count_) {}

void DirectionField::accept(Vector<DirectionConstraint>& next) noexcept { constraints_.swap(next); }

void DirectionField::check_site(const Vector<DirectionConstraint>& list, std::uint32_t position,
                                std::uint32_t site) const {
  if (site >= list.size() || list[site].vertex < 0)
    fail(HF_ERROR_NOT_FOUND, position,
         "entry %u of the list: there is no constraint %u (removed already, or never added)", position, site);
}

Complex DirectionField::projected(std::uint32_t position, Index vertex, const double* vector) const {
  Vec3 v{vector[0], vector[1], vector[2]};
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
    fail(HF_ERROR_NON_FINITE, position, "entry %u of the list: the vector has a coordinate that is not a finite number",
         position);
  const double most = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(most > 0)) return 0;
  if (!(most < most_coordinate))
    fail(HF_ERROR_TOO_LARGE, position, "entry %u of the list: the vector has coordinate %g; scale it below 1e150",
         position, most);
  const Complex z = solver_.connection().to_frame(vertex, (1 / most) * v);
  if (!(length_of(z) > least_tangent))
    fail(HF_ERROR_INVALID_ARGUMENT, position,
         "entry %u of the list: the vector is normal to the surface; give a direction in the "
         "tangent plane",
         position);
  return most * z;
}

void DirectionField::check_free(const Vector<DirectionConstraint>& list, std::uint32_t position,
                                std::uint32_t own) const {
  for (std::size_t s = 0; s < list.size(); ++s) {
    if (s == own || list[s].vertex != list[own].vertex) continue;
    fail(HF_ERROR_DUPLICATE, position,
         "entry %u of the list: vertex %u has constraint %zu already; set its vector or move it", position,
         list[own].given_vertex, s);
  }
}

void DirectionField::add(std::uint32_t count, const std::uint32_t* vertices, const double* vectors,
                         std::uint32_t* out_sites) {
  if (count > site_limit_ || count_ > site_limit_ - count)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u constraints and %u more; the site_limit is %u", count_, count,
         site_limit_);
  Vector<DirectionConstraint> next(constraints_, &memory());
  Vector<Index> slots(&memory()), inner(&memory());
  Vector<std::uint8_t> taken(at(solver_.core().size()), 0, &memory());
  for (const DirectionConstraint& c : next) {
    if (c.vertex >= 0) taken[at(c.vertex)] = 1;
  }
  NumberPool numbers;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t free = numbers.take([&](std::uint32_t s) { return s < next.size() && next[s].vertex >= 0; });
    if (free == next.size()) next.emplace_back();
    const Index v = mesh::usable_vertex(solver_.core().mesh, vertices[i], i);
    next[free] = {v, vertices[i], projected(i, v, vectors + std::size_t{3} * i)};
    if (taken[at(v)]) check_free(next, i, free);
    taken[at(v)] = 1;
    slots.push_back(static_cast<Index>(free));
    inner.push_back(v);
  }
  DirectionSolver::Edit edit;
  edit.add = slots;
  edit.vertices = inner;
  solver_.edit(edit);
  accept(next);
  count_ += count;
  for (std::uint32_t i = 0; out_sites && i < count; ++i) out_sites[i] = static_cast<std::uint32_t>(slots[i]);
}

void DirectionField::remove(std::uint32_t count, const std::uint32_t* sites) {
  solve::check_site_count(count, count_);
  Vector<DirectionConstraint> next(constraints_, &memory());
  Vector<Index> slots(&memory());
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(next, i, sites[i]);
    next[sites[i]] = DirectionConstraint{};
    slots.push_back(static_cast<Index>(sites[i]));
  }
  DirectionSolver::Edit edit;
  edit.remove = slots;
  solver_.edit(edit);
  accept(next);
  count_ -= count;
}

void DirectionField::move(std::uint32_t count, const std::uint32_t* sites, const std::uint32_t* vertices) {
  solve::check_site_count(count, count_);
  const surface::Core& core = solver_.core();
  Vector<DirectionConstraint> next(constraints_, &memory());
  Vector<Index> slots(&memory()), inner(&memory());
  Vector<std::uint8_t> named(next.size(), 0, &memory());
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(next, i, sites[i]);
    if (named[sites[i]]++)
      fail(HF_ERROR_NOT_FOUND, i, "entry %u of the list: constraint %u is named twice", i, sites[i]);
    DirectionConstraint& site = next[sites[i]];
    const Index to = mesh::usable_vertex(core.mesh, vertices[i], i);
    if (core.mesh.component[at(to)] != core.mesh.component[at(site.vertex)])
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "entry %u of the list: vertex %u lies in another component than constraint %u; remove it there and add it "
           "here",
           i, vertices[i], sites[i]);
    double turn = 0;
    Index here = site.vertex;
    for (const Index e : edge_path(core.mesh, core.topology(), site.vertex, to, memory())) {
      here = core.topology().first(e) == here ? core.topology().second(e) : core.topology().first(e);
      turn += solver_.connection().turn(core.topology(), e, here);
    }
    site = {to, vertices[i], site.vector * at_angle(1.0, turn)};
    slots.push_back(static_cast<Index>(sites[i]));
    inner.push_back(to);
  }
  for (std::uint32_t i = 0; i < count; ++i) check_free(next, i, sites[i]);
  DirectionSolver::Edit edit;
  edit.remove = slots;
  edit.add = slots;
  edit.vertices = inner;
  solver_.edit(edit);
  accept(next);
}

template <class Work>
void DirectionField::update(std::uint32_t count, const std::uint32_t* sites, Work&& work) {
  solve::check_site_count(count, count_);
  Vector<DirectionConstraint> next(constraints_, &memory());
  for (std::uint32_t i = 0; i < count; ++i) {
    check_site(next, i, sites[i]);
    work(i, next[sites[i]]);
  }
  accept(next);
}

void DirectionField::set_vectors(std::uint32_t count, const std::uint32_t* sites, const double* vectors) {
  update(count, sites, [&](std::uint32_t i, DirectionConstraint& site) {
    site.vector = projected(i, site.vertex, vectors + std::size_t{3} * i);
  });
}

void DirectionField::rotate(std::uint32_t count, const std::uint32_t* sites, const double* angles) {
  update(count, sites, [&](std::uint32_t i, DirectionConstraint& site) {
    check_angle(i, angles[i]);
    site.vector *= at_angle(1.0, wrapped(angles[i]));
  });
}

Vector<Complex> DirectionField::solved() const {
  if (count_ == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the field has no constraints; add at least one before solving");
  Vector<Complex> values(constraints_.size(), &memory()), field(at(solver_.core().size()), &memory());
  for (std::size_t s = 0; s < values.size(); ++s) values[s] = raised(constraints_[s].vector, solver_.degree());
  solver_.solve(values, field.data());
  return field;
}

void DirectionField::solve(Vec3* out) const {
  const Vector<Complex> field = solved();
  for (std::size_t v = 0; v < field.size(); ++v)
    out[v] = solver_.connection().to_space(static_cast<Index>(v), root(field[v], solver_.degree()));
  // Constrained vertices get their own vectors bit for bit, whichever of its `degree` directions the field has
  // elsewhere.
  for (const DirectionConstraint& c : constraints_) {
    if (c.vertex >= 0) out[c.vertex] = solver_.connection().to_space(c.vertex, c.vector);
  }
}

namespace {

// Adds up the singularities of the triangles that one face is cut into. The numbers of a surface of triangles stay.
Vector<Singularity> by_face(const mesh::Mesh& mesh, Vector<Singularity> found) {
  if (mesh.faces.empty()) return found;
  std::size_t count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool same =
        count > 0 && mesh.given_of_triangle(found[count - 1].triangle) == mesh.given_of_triangle(found[i].triangle);
    if (same)
      found[count - 1].index += found[i].index;
    else
      found[count++] = found[i];
    if (found[count - 1].index == 0) --count;
  }
  found.resize(count);
  return found;
}

}  // namespace

Vector<Singularity> DirectionField::singularities() const {
  const Vector<Complex> field = solved();
  const surface::Core& core = solver_.core();
  const Connection& connection = solver_.connection();
  const Index n = solver_.degree();
  // Stores, for each edge, how much more the field turns along it than a direction that is carried along the edge. Seen
  // from the other end, the number is the same with the opposite sign.
  Vector<double> turn(at(core.topology().edge_count()), 0.0, &memory());
  for (Index e = 0; e < core.topology().edge_count(); ++e) {
    const Complex from = field[at(core.topology().first(e))], to = field[at(core.topology().second(e))];
    if (from == 0.0 || to == 0.0) continue;
    turn[at(e)] = wrapped(angle_of(to) - angle_of(from) - n * connection.rotation[at(e)]);
  }
  Vector<Singularity> found(&memory());
  for (Index t = 0; t < core.mesh.triangle_count(); ++t) {
    const Index* v = core.mesh.triangle(t);
    if (solver_.constraint_count(core.mesh.component[at(v[0])]) == 0) continue;
    double sum = n * connection.curvature[at(t)];
    for (int k = 0; k < 3; ++k) {
      const Index from = v[k], to = v[(k + 1) % 3];
      const auto begin = core.topology().neighbour.begin() + core.topology().neighbour_start[at(from)],
                 end = core.topology().neighbour.begin() + core.topology().neighbour_start[at(from) + 1];
      const Index e = core.topology().neighbour_edge[static_cast<std::size_t>(std::lower_bound(begin, end, to) -
                                                                              core.topology().neighbour.begin())];
      sum += to == core.topology().second(e) ? turn[at(e)] : -turn[at(e)];
    }
    const Index index = static_cast<Index>(std::lround(sum / two_pi));
    if (index == 0) continue;
    Index corner = v[0];
    for (const Index w : {v[1], v[2]}) corner = length_of(field[at(w)]) < length_of(field[at(corner)]) ? w : corner;
    found.push_back({t, corner, index});
  }
  return by_face(core.mesh, std::move(found));
}

}  // namespace hf_inner::field
