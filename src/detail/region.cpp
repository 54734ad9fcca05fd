#include "detail/region.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/index.h"
#include "base/number_pool.h"
#include "detail/constants.h"
#include "detail/curve_crossing.h"
#include "detail/curve_sides.h"
#include "detail/morph.h"

namespace hf_inner::detail {
namespace {

// A closed curve and the vertices on one side of it.
struct Enclosed {
  explicit Enclosed(Memory& memory) : inside(&memory), line(&memory) {}
  Vector<Index> inside;
  Vector<Vec3> line;  // corners of the curve, in the caller's unit
};

Enclosed enclosed(const RegionSurface& surface, const RegionEdit& edit, Memory& memory) {
  const surface::Core& core = *surface.core;
  Enclosed result(memory);
  if (edit.kind == CurveKind::edges) {
    Vector<Index> points(&memory);
    for (const mesh::CurvePoint& point : edit.curve) points.push_back(mesh::nearest_corner(point));
    const ClosedCurve curve = closed_curve(core, points, memory);
    require_no_crossing(core, curve, memory);
    result.inside = curve_side(core, curve.vertices, edit.side, edit.seed, memory);
    for (const Index v : curve.vertices) result.line.push_back(surface.position(v));
    return result;
  }
  const mesh::SurfaceCurve curve =
      mesh::surface_curve(core.geometry->unlinked().mesh, core.geometry->unlinked().topology(), edit.curve, {}, memory);
  result.inside = surface_curve_side(core, edit.curve, curve, edit.side, edit.seed, memory);
  for (std::size_t i = 0; i < curve.place.size(); ++i) {
    const mesh::PathPoint& place = curve.place[i];
    result.line.push_back(place.a == mesh::Mesh::none
                              ? surface.position(edit.curve[at(curve.point_of[i])])
                              : (1 - place.t) * surface.position(place.a) + place.t * surface.position(place.b));
  }
  return result;
}

Vector<Index> edited(const surface::Core& core, Vector<Index>&& inside, const RegionEdit& edit, Memory& memory) {
  if (edit.rings != 0) inside = grown(core, inside, edit.rings, memory);
  if (edit.remove.empty() && edit.add.empty()) return std::move(inside);
  Vector<std::uint8_t> in(at(core.size()), 0, &memory);
  for (const Index v : inside) in[at(v)] = 1;
  for (const Index v : edit.remove) in[at(v)] = 0;
  for (const Index v : edit.add) in[at(v)] = 1;
  inside.clear();
  for (Index v = 0; v < core.size(); ++v)
    if (in[at(v)]) inside.push_back(v);
  return std::move(inside);
}

// Returns the vertex of a list that lies nearest to a point.
Index nearest_of(const RegionSurface& surface, Span<const Index> vertices, Vec3 point) {
  return *std::min_element(vertices.begin(), vertices.end(), [&](Index a, Index b) {
    return norm(surface.position(a) - point) < norm(surface.position(b) - point);
  });
}

// Clones the engine (solver) of `from`, and changes the clone's sites to the sites of `to`.
void place_sites(const RegionState& from, RegionState& to, const surface::Core& core, Memory& memory) {
  const std::shared_ptr<solve::SiteSolver> engine = from.engine->clone();
  Vector<Index> leaving(&memory), coming(&memory), slots(&memory);
  Vector<solve::Site> places(&memory);
  Vector<std::uint8_t> used(at(engine->slot_count()), 0, &memory);
  NumberPool numbers;
  const Vector<Index>&old = from.shape->sites, &now = to.shape->sites;
  to.slot.assign(now.size(), -1);
  std::size_t i = 0, k = 0;
  while (i < old.size() || k < now.size()) {
    if (k == now.size() || (i < old.size() && old[i] < now[k])) {
      leaving.push_back(from.slot[i++]);
    } else if (i == old.size() || now[k] < old[i]) {
      coming.push_back(static_cast<Index>(k++));
    } else {
      used[at(from.slot[i])] = 1;
      to.slot[k++] = from.slot[i++];
    }
  }
  for (const Index c : coming) {
    const auto next = numbers.take([&](std::uint32_t slot) { return slot < used.size() && used[slot]; });
    to.slot[at(c)] = static_cast<Index>(next);
    slots.push_back(to.slot[at(c)]);
    places.push_back(solve::Site::at_vertex(core.mesh, now[at(c)]));
  }
  if (!leaving.empty() || !coming.empty()) {
    solve::SiteEdit edit;
    edit.remove = leaving;
    edit.add = slots;
    edit.sites = places;
    engine->edit(edit);
  }
  to.inserted = static_cast<std::uint32_t>(coming.size());
  to.removed = static_cast<std::uint32_t>(leaving.size());
  to.kept = static_cast<std::uint32_t>(now.size() - coming.size());
  to.engine = engine;
}

void solve_base(const RegionSurface& surface, RegionState& state, Memory& memory) {
  const surface::Core& core = *surface.core;
  const RegionShape& shape = *state.shape;
  Vector<double> values(at(state.engine->slot_count()) * 3, 0.0, &memory);
  for (std::size_t i = 0; i < shape.sites.size(); ++i) {
    const Vec3 p = surface.scaled_position(shape.sites[i]);
    double* value = &values[at(state.slot[i]) * 3];
    value[0] = p.x;
    value[1] = p.y;
    value[2] = p.z;
  }
  const auto take = [&](std::size_t i, const double* u) { state.base[i] = core.mesh.to_given({u[0], u[1], u[2]}); };
  state.base.resize(shape.inside.size());
  // Iterative refinement corrects a bi-harmonic field, and it needs the whole factor.
  state.whole_sweep = core.refinements > 0 || whole_sweep_share * shape.inside.size() > at(core.size());
  if (state.whole_sweep) {
    surface::Workspace field(core.workspaces, at(core.size()) * 3);
    state.engine->solve(values.data(), 3, field.data(), nullptr);
    for (std::size_t i = 0; i < shape.inside.size(); ++i) take(i, field.data() + at(shape.inside[i]) * 3);
  } else {
    Vector<double> field(shape.inside.size() * 3, &memory);
    state.engine->solve_at(values.data(), 3, shape.inside, field.data());
    for (std::size_t i = 0; i < shape.inside.size(); ++i) take(i, &field[3 * i]);
  }
}

}  // namespace

Vector<Vec3> positions_of(const surface::Core& core, const ConstRows& given) {
  const mesh::Mesh& mesh = core.mesh;
  Vector<Vec3> positions(mesh.report.vertex_count, core.memory.get());
  for (std::size_t v = 0; given && v < positions.size(); ++v) {
    const Vec3 p{given.get(v, 0), given.get(v, 1), given.get(v, 2)};
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(v), "the position of vertex %zu is not finite", v);
    positions[v] = p;
  }
  if (given) return positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Index inner = mesh.inner_of_given[v];
    if (inner != mesh::Mesh::none) positions[v] = mesh.to_given(mesh.positions[at(inner)]);
  }
  for (const mesh::Mesh::Isolated& entry : mesh.isolated) positions[at(entry.given)] = entry.position;
  return positions;
}

Vec3 RegionSurface::position(const mesh::CurvePoint& point) const noexcept {
  Vec3 sum;
  for (int k = 0; k < 3; ++k) {
    if (point.weight[k] > 0) sum = sum + point.weight[k] * position(point.corner[k]);
  }
  return sum;
}

RegionSurface::RegionSurface(std::shared_ptr<const surface::Core> shared, Vector<Vec3>&& given)
    : core(std::move(shared)),
      positions(std::move(given), core->memory.get()),
      normal_sum(at(core->size()), core->memory.get()) {
  for (Index t = 0; t < core->mesh.triangle_count(); ++t) {
    const Index* v = core->mesh.triangle(t);
    const Vec3 a = scaled_position(v[0]), n = cross(scaled_position(v[1]) - a, scaled_position(v[2]) - a);
    for (int k = 0; k < 3; ++k) normal_sum[at(v[k])] = normal_sum[at(v[k])] + n;
  }
}

RegionState::RegionState(const RegionSurface& surface, std::shared_ptr<const RegionShape> given, Memory& memory)
    : shape(std::move(given)), slot(&memory), base(&memory), outer_normal(shape->rim.size(), &memory) {
  const std::size_t inside = shape->inside.size();
  for (std::size_t r = 0; r < shape->rim.size(); ++r) outer_normal[r] = surface.normal_sum[at(shape->rim[r])];
  for (std::size_t i = 0; i < shape->triangles.size(); ++i) {
    const Index* v = surface.core->mesh.triangle(shape->triangles[i]);
    const Vec3 a = surface.scaled_position(v[0]);
    const Vec3 n = cross(surface.scaled_position(v[1]) - a, surface.scaled_position(v[2]) - a);
    area += 0.5 * norm(n);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = at(shape->corners[3 * i + k]);
      if (l >= inside) outer_normal[l - inside] = outer_normal[l - inside] - n;
    }
  }
}

Region::Region(std::shared_ptr<const RegionSurface> surface) : surface_(std::move(surface)) {
  const auto shape = make_shared_in<RegionShape>(memory(), core(), Span<const Index>(), memory());
  const auto state = make_shared_in<RegionState>(memory(), *surface_, shape, memory());
  state->engine = solve::SiteSolver::make(surface_->core);
  state_ = state;
}

Region::Region(const Region& other) : surface_(other.surface_), state_(other.state_) {}

void Region::edit(const RegionEdit& edit) {
  // Reported progress, by the usual share of time. A curve comes first, if there is one.
  constexpr float shaped = 0.2f, placed = 0.7f, drawn = 0.5f;
  report(0.0f);
  const RegionShape& before = *state_->shape;
  Enclosed enclosing(memory());
  if (!edit.curve.empty()) {
    const ProgressRange range(0.0f, drawn);
    enclosing = enclosed(*surface_, edit, memory());
  }
  std::optional<ProgressRange> part(std::in_place, edit.curve.empty() ? 0.0f : drawn, 1.0f);
  Vector<Index>& begun = edit.curve.empty() ? enclosing.inside = before.inside : enclosing.inside;
  const Vector<Index> inside = edited(core(), std::move(begun), edit, memory());
  if (inside.empty())
    fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the region would have no vertex; take a wider curve or fewer rings away");
  const auto shape = make_shared_in<RegionShape>(memory(), core(), inside, memory());
  report(shaped);
  const auto next = make_shared_in<RegionState>(memory(), *surface_, shape, memory());
  {
    const ProgressRange range(shaped, placed);
    place_sites(*state_, *next, core(), memory());
  }
  report(placed);
  solve_base(*surface_, *next, memory());
  next->base_area = morphed_area(*surface_, *next, 1.0, memory());
  next->first = state_->first;
  next->curve = state_->curve;
  if (!edit.curve.empty()) {
    next->first = nearest_of(*surface_, shape->rim, surface_->position(edit.curve[0]));
    next->curve = make_shared_in<Vector<Vec3>>(memory(), std::move(enclosing.line));
  }
  part.reset();
  report(1.0f);
  state_ = next;
}

}  // namespace hf_inner::detail
