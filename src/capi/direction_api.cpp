// hf/direction.h: vectors of three-channel solvers carried and turned, and direction fields.
#include <algorithm>
#include <cmath>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/scatter.h"
#include "field/direction_field.h"
#include "field/vector_field.h"
#include "hf/direction.h"

namespace hf_inner::capi {
namespace {

struct DirectionObject final : Object {
  DirectionObject(const SolverObject& solver, std::int32_t degree, std::uint32_t limit)
      : Object(Kind::direction),
        site_limit(limit),
        memory(solver.memory),
        field(solver.field.shared_core(), degree, limit),
        given_count(solver.given_count, memory.get()) {}
  DirectionObject(const DirectionObject& other)
      : Object(Kind::direction),
        site_limit(other.site_limit),
        memory(other.memory),
        field(other.field),
        given_count(other.given_count, memory.get()),
        site_count(other.field.count()) {}
  const std::uint32_t site_limit;
  std::shared_ptr<Memory> memory;  // outlives everything below
  DirectionField field;
  Vector<std::uint32_t> given_count;         // vertices as given, by component
  std::atomic<std::uint32_t> site_count{0};  // of the last finished change
};

std::shared_ptr<DirectionObject> object_of(hf_direction handle) {
  return get<DirectionObject>(handle, Kind::direction, "direction");
}

void require_list(std::uint32_t count, const void* list, const char* name) {
  if (count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "site_count is 0");
  require(list, name);
}

// Counts no list can have, refused before the lists are read.
void check_count(std::uint32_t count, std::uint32_t there) {
  if (count > there) fail(HF_ERROR_NO_SUCH_SITE, there, "%u constraints named, but there are %u", count, there);
}

template <class Change>
void change(hf_direction handle, Change&& work) {
  const auto direction = object_of(handle);
  const Changing changing(*direction);
  work(*direction);
  direction->site_count = direction->field.count();
}

void solve(hf_direction handle, float* f32, double* f64, std::uint32_t stride, hf_solve_info* out_info) {
  const auto direction = object_of(handle);
  if (!f32 && !f64) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_vectors is NULL");
  if (out_info) check_struct(out_info, "out_info");
  const Rows out = rows_of(f32, f64, stride, "vector_stride");
  const Reading reading(*direction);
  const DirectionSolver& solver = direction->field.solver();
  const Core& core = solver.core();
  Vector<Vec3> field(static_cast<std::size_t>(core.size()), direction->memory.get());
  direction->field.solve(field.data());
  scatter(core, 3, out, nullptr, [&](std::size_t v, double* values) { put(field[v], values); });
  if (!out_info) return;
  hf_solve_info info{};
  info.first_unreached_component = HF_NO_INDEX;
  info.unreached_vertex_count = core.mesh.report.isolated_vertex_count;
  for (std::uint32_t c = 0; c < core.mesh.report.component_count; ++c) {
    if (solver.constraint_count(static_cast<std::int32_t>(c)) > 0) continue;
    if (info.unreached_component_count++ == 0) info.first_unreached_component = c;
    info.unreached_vertex_count += direction->given_count[c];
  }
  write_struct(out_info, info);
}

// ---- three-channel solvers ----

const SiteSet::Slot& vector_site(const ScalarField& field, std::uint32_t position, std::uint32_t site) {
  const Span<const SiteSet::Slot> slots = field.sites().slots();
  if (site >= slots.size() || !slots[site].is_site())
    fail(HF_ERROR_NO_SUCH_SITE, position, "entry %u of the list: there is no site %u (removed already, or never added)",
         position, site);
  return slots[site];
}

// The vertex of a site, or the corner nearest to it.
std::int32_t vertex_of(const Site& site) noexcept {
  int best = 0;
  for (int k = 1; k < 3; ++k) best = site.vertex[k] >= 0 && site.weight[k] > site.weight[best] ? k : best;
  return site.vertex[best];
}

Vec3 value_of(const ScalarField& field, std::uint32_t site) noexcept {
  const double* v = field.sites().values() + std::size_t{3} * site;
  return {v[0], v[1], v[2]};
}

void require_vectors(const ScalarField& field) {
  if (field.sites().channels() != 3)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the solver has %d channels; vector fields need channel_count 3",
         field.sites().channels());
}

// Rodrigues' formula, about a unit axis.
Vec3 turned(Vec3 v, Vec3 axis, double angle) noexcept {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * cross(axis, v) + ((1 - c) * dot(axis, v)) * axis;
}

void move_vectors(SolverObject& solver, std::uint32_t count, const std::uint32_t* sites,
                  const std::uint32_t* vertices) {
  const Core& core = solver.field.core();
  const Mesh& mesh = core.mesh;
  Vector<std::int32_t> to(solver.memory.get());
  append_inner(mesh, count, vertices, "vertices", to);
  Vector<double> values(solver.memory.get());
  for (std::uint32_t i = 0; i < count; ++i) {
    const SiteSet::Slot& slot = vector_site(solver.field, i, sites[i]);
    std::int32_t here = vertex_of(slot.site);
    if (to[i] == Mesh::none)
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "entry %u of the list: vertex %u belongs to no usable triangle; choose a vertex of the surface", i,
           vertices[i]);
    if (mesh.component[static_cast<std::size_t>(to[i])] != slot.site.component)
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "entry %u of the list: vertex %u lies in another component than site %u; remove it there and add it here", i,
           vertices[i], sites[i]);
    Vec3 vector = value_of(solver.field, sites[i]), normal = vertex_normal(mesh, core.topology, here);
    for (const std::int32_t e : edge_path(mesh, core.topology, here, to[i], *solver.memory)) {
      here = core.topology.first(e) == here ? core.topology.second(e) : core.topology.first(e);
      const Vec3 next = vertex_normal(mesh, core.topology, here);
      if (norm(next) == 0) continue;  // triangles that cancel out: the plane before stands
      if (norm(normal) > 0) vector = carry(vector, normal, next);
      normal = next;
    }
    for (const double x : {vector.x, vector.y, vector.z}) values.push_back(x);
  }
  FieldEdit edit;
  edit.move_count = count, edit.move_sites = sites, edit.move_to.count = count, edit.move_to.vertices = vertices;
  edit.set_count = count, edit.set_sites = sites, edit.set_values = values.data();
  solver.field.edit(edit, nullptr);
}

void rotate_vectors(SolverObject& solver, std::uint32_t count, const std::uint32_t* sites, const double* angles) {
  const Core& core = solver.field.core();
  Vector<double> values(solver.memory.get());
  for (std::uint32_t i = 0; i < count; ++i) {
    const SiteSet::Slot& slot = vector_site(solver.field, i, sites[i]);
    if (!std::isfinite(angles[i]))
      fail(HF_ERROR_NON_FINITE, i, "entry %u of the list: the angle is not a finite number", i);
    const Vec3 normal = vertex_normal(core.mesh, core.topology, vertex_of(slot.site));
    const Vec3 vector = turned(value_of(solver.field, sites[i]), normal, norm(normal) > 0 ? angles[i] : 0.0);
    for (const double x : {vector.x, vector.y, vector.z}) values.push_back(x);
  }
  FieldEdit edit;
  edit.set_count = count, edit.set_sites = sites, edit.set_values = values.data();
  solver.field.edit(edit, nullptr);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_move_vector_sites(hf_solver handle, uint32_t site_count, const uint32_t* sites, const uint32_t* vertices) {
  return guarded("hf_move_vector_sites", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    require_list(site_count, sites, "sites"), require(vertices, "vertices");
    const Changing changing(*solver);
    require_vectors(solver->field);
    check_count(site_count, solver->field.sites().count());
    move_vectors(*solver, site_count, sites, vertices);
  });
}

hf_result hf_rotate_vector_sites(hf_solver handle, uint32_t site_count, const uint32_t* sites, const double* angles) {
  return guarded("hf_rotate_vector_sites", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    require_list(site_count, sites, "sites"), require(angles, "angles");
    const Changing changing(*solver);
    require_vectors(solver->field);
    check_count(site_count, solver->field.sites().count());
    rotate_vectors(*solver, site_count, sites, angles);
  });
}

hf_result hf_direction_create(hf_solver handle, const hf_direction_desc* given, hf_direction* out_direction) {
  return guarded("hf_direction_create", [&] {
    require(out_direction, "out_direction");
    *out_direction = nullptr;
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    hf_direction_desc desc{};
    if (given) desc = read_struct(given, "desc");
    if (desc.degree != 0 && desc.degree != 1 && desc.degree != 2 && desc.degree != 4)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "degree is %u; it must be 1, 2 or 4", desc.degree);
    if (desc.reserved != 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "reserved is %u; set it to 0", desc.reserved);
    const Reading reading(*solver);
    *out_direction = reinterpret_cast<hf_direction>(insert(make_owner_in<DirectionObject>(
        solver->memory, *solver, static_cast<std::int32_t>(desc.degree ? desc.degree : 1),
        desc.site_limit ? desc.site_limit : 100000u)));
  });
}

hf_result hf_direction_clone(hf_direction handle, hf_direction* out_direction) {
  return guarded("hf_direction_clone", [&] {
    require(out_direction, "out_direction");
    *out_direction = nullptr;
    const auto direction = object_of(handle);
    const Reading reading(*direction);
    *out_direction =
        reinterpret_cast<hf_direction>(insert(make_owner_in<DirectionObject>(direction->memory, *direction)));
  });
}

hf_result hf_direction_record(hf_direction handle) {
  return guarded("hf_direction_record",
                 [&] { change(handle, [](DirectionObject& direction) { direction.field.record(); }); });
}

hf_result hf_direction_undo(hf_direction handle) {
  return guarded("hf_direction_undo",
                 [&] { change(handle, [](DirectionObject& direction) { direction.field.undo(); }); });
}

hf_result hf_direction_redo(hf_direction handle) {
  return guarded("hf_direction_redo",
                 [&] { change(handle, [](DirectionObject& direction) { direction.field.redo(); }); });
}

void hf_direction_destroy(hf_direction direction) {
  const FloatEnvironment environment;
  remove(reinterpret_cast<std::uintptr_t>(direction), Kind::direction);
}

hf_result hf_direction_add_sites(hf_direction handle, uint32_t site_count, const uint32_t* vertices,
                                 const double* vectors, uint32_t* out_sites) {
  return guarded("hf_direction_add_sites", [&] {
    object_of(handle);
    require_list(site_count, vertices, "vertices"), require(vectors, "vectors");
    change(handle, [&](DirectionObject& direction) { direction.field.add(site_count, vertices, vectors, out_sites); });
  });
}

hf_result hf_direction_remove_sites(hf_direction handle, uint32_t site_count, const uint32_t* sites) {
  return guarded("hf_direction_remove_sites", [&] {
    object_of(handle);
    require_list(site_count, sites, "sites");
    change(handle, [&](DirectionObject& direction) {
      check_count(site_count, direction.field.count());
      direction.field.remove(site_count, sites);
    });
  });
}

hf_result hf_direction_move_sites(hf_direction handle, uint32_t site_count, const uint32_t* sites,
                                  const uint32_t* vertices) {
  return guarded("hf_direction_move_sites", [&] {
    object_of(handle);
    require_list(site_count, sites, "sites"), require(vertices, "vertices");
    change(handle, [&](DirectionObject& direction) {
      check_count(site_count, direction.field.count());
      direction.field.move(site_count, sites, vertices);
    });
  });
}

hf_result hf_direction_set_vectors(hf_direction handle, uint32_t site_count, const uint32_t* sites,
                                   const double* vectors) {
  return guarded("hf_direction_set_vectors", [&] {
    object_of(handle);
    require_list(site_count, sites, "sites"), require(vectors, "vectors");
    change(handle, [&](DirectionObject& direction) {
      check_count(site_count, direction.field.count());
      direction.field.set_vectors(site_count, sites, vectors);
    });
  });
}

hf_result hf_direction_rotate_sites(hf_direction handle, uint32_t site_count, const uint32_t* sites,
                                    const double* angles) {
  return guarded("hf_direction_rotate_sites", [&] {
    object_of(handle);
    require_list(site_count, sites, "sites"), require(angles, "angles");
    change(handle, [&](DirectionObject& direction) {
      check_count(site_count, direction.field.count());
      direction.field.rotate(site_count, sites, angles);
    });
  });
}

uint32_t hf_direction_get_site_count(hf_direction direction) {
  const std::shared_ptr<Object> object = find(reinterpret_cast<std::uintptr_t>(direction), Kind::direction);
  return object ? static_cast<DirectionObject&>(*object).site_count.load() : 0;
}

hf_result hf_direction_get_sites(hf_direction handle, uint32_t capacity, uint32_t* out_sites, uint32_t* out_vertices,
                                 double* out_vectors) {
  return guarded("hf_direction_get_sites", [&] {
    const auto direction = object_of(handle);
    const Reading reading(*direction);
    if (capacity < direction->field.count())
      fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "capacity is %u; there are %u constraints", capacity,
           direction->field.count());
    std::size_t at = 0;
    const Span<const DirectionConstraint> constraints = direction->field.constraints();
    for (std::size_t s = 0; s < constraints.size(); ++s) {
      const DirectionConstraint& c = constraints[s];
      if (c.vertex < 0) continue;
      if (out_sites) out_sites[at] = static_cast<std::uint32_t>(s);
      if (out_vertices) out_vertices[at] = c.given_vertex;
      if (out_vectors) put(direction->field.solver().connection().to_space(c.vertex, c.vector), out_vectors + 3 * at);
      ++at;
    }
  });
}

hf_result hf_direction_solve(hf_direction direction, float* out_vectors, uint32_t vector_stride,
                             hf_solve_info* out_info) {
  return guarded("hf_direction_solve", [&] { solve(direction, out_vectors, nullptr, vector_stride, out_info); });
}

hf_result hf_direction_solve_f64(hf_direction direction, double* out_vectors, uint32_t vector_stride,
                                 hf_solve_info* out_info) {
  return guarded("hf_direction_solve_f64", [&] { solve(direction, nullptr, out_vectors, vector_stride, out_info); });
}

hf_result hf_direction_get_singularities(hf_direction handle, uint32_t capacity, hf_singularity* out_singularities,
                                         uint32_t* out_count) {
  return guarded("hf_direction_get_singularities", [&] {
    const auto direction = object_of(handle);
    require(out_count, "out_count");
    const Reading reading(*direction);
    const Mesh& mesh = direction->field.solver().core().mesh;
    const Vector<Singularity> found = direction->field.singularities();
    *out_count = static_cast<std::uint32_t>(found.size());
    if (!out_singularities) return;
    if (capacity < found.size())
      fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "capacity is %u; there are %zu singularities", capacity, found.size());
    // usable triangles stand in the order of the given ones
    std::size_t next = 0;
    for (std::uint32_t t = 0; t < mesh.report.triangle_count && next < found.size(); ++t) {
      if (mesh.triangle_of_given[t] != found[next].triangle) continue;
      const auto vertex = mesh.given_of_inner[static_cast<std::size_t>(found[next].vertex)];
      out_singularities[next] = {t, static_cast<std::uint32_t>(vertex), found[next].index};
      ++next;
    }
  });
}

hf_result hf_direction_get_statistics(hf_direction handle, hf_direction_statistics* out_statistics) {
  return guarded("hf_direction_get_statistics", [&] {
    const auto direction = object_of(handle);
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*direction);
    const DirectionSolver& solver = direction->field.solver();
    const DirectionCounters counters = solver.counters();
    hf_direction_statistics statistics{};
    statistics.unknown_count = static_cast<std::uint32_t>(solver.matrix().size());
    statistics.site_count = direction->field.count();
    statistics.factorisation_count = counters.factorisations;
    statistics.path_solve_count = counters.path_solves;
    statistics.sweep_count = counters.sweeps;
    statistics.irregular_vertex_count = solver.connection().irregular_count;
    statistics.sites_eliminated = solver.eliminates();
    statistics.operator_ms = solver.operator_ms();
    statistics.numeric_ms = solver.statistics().numeric_ms;
    statistics.factor_entries = solver.statistics().entries;
    statistics.factor_bytes = solver.statistics().bytes;
    statistics.site_memory_bytes = counters.bytes;
    write_struct(out_statistics, statistics);
  });
}

}  // extern "C"
