// Implements hf/direction.h: direction fields.
#include "capi/objects.h"
#include "capi/vertex_writer.h"
#include "field/direction_field.h"
#include "field/unreached.h"
#include "hf/direction.h"

namespace hf_inner::capi {
namespace {

struct DirectionObject final : Object {
  static constexpr Kind kind_of = Kind::direction;
  DirectionObject(const std::shared_ptr<const surface::Core>& core, std::int32_t degree, std::uint32_t limit)
      : Object(kind_of, core->memory), site_limit(limit), field(core, degree, limit) {}
  DirectionObject(const DirectionObject& other)
      : Object(kind_of, other.memory),
        site_limit(other.site_limit),
        field(other.field),
        site_count(other.field.count()) {}
  const std::uint32_t site_limit;
  field::DirectionField field;
  std::atomic<std::uint32_t> site_count{0};  // number of constraints after the last finished change
};

std::shared_ptr<DirectionObject> object_of(hf_direction handle) { return get<DirectionObject>(handle, "direction"); }

template <class Work>
void change(hf_direction handle, Work&& work) {
  const auto direction = object_of(handle);
  const Changing changing(*direction);
  work(direction->field);
  direction->site_count = direction->field.count();
}

// An edit that takes `count` sites or vertices and another list beside them.
template <class Work>
hf_result edit(const char* function, hf_direction handle, std::uint32_t count, const std::uint32_t* list,
               const char* list_name, const void* other, const char* other_name, Work&& work) {
  return guarded(function, [&] {
    object_of(handle);
    require_list(count, list, "site_count", list_name);
    if (other_name) require(other, other_name);
    change(handle, work);
  });
}

void solve_directions(hf_direction handle, const hf_array_out* out_vectors, hf_solve_info* out_info) {
  const auto direction = object_of(handle);
  require(out_vectors, "out_vectors");
  if (out_info) check_struct(out_info, "out_info");
  const Reading reading(*direction);
  const field::DirectionSolver& solver = direction->field.solver();
  const surface::Core& core = solver.core();
  const Rows out = need_reals(out_vectors, 3, core.mesh.report.vertex_count, "vertices", "out_vectors");
  Vector<Vec3> field(static_cast<std::size_t>(core.size()), direction->memory.get());
  direction->field.solve(field.data());
  write_vertices(core, 3, out, nullptr, [&](std::size_t v, double* values) { put(field[v], values); });
  if (out_info)
    write_struct(out_info,
                 field::unreached_by(*core.geometry, [&](std::int32_t c) { return solver.constraint_count(c); }));
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_direction_create(hf_surface surface, const hf_direction_desc* given, hf_direction* out_direction) {
  return create("hf_direction_create", out_direction, "out_direction", [&] {
    const std::shared_ptr<const surface::Core> core = unlinked_core(surface, "a direction field");
    const hf_direction_desc desc = read_optional(given, "desc");
    const std::int32_t degree = field::read_degree(desc);
    return with_progress(desc.progress, [&] {
      auto made = make_owner_in<DirectionObject>(core->memory, core, degree, field::read_site_limit(desc.site_limit));
      report(1);
      return made;
    });
  });
}

hf_result hf_direction_clone(hf_direction handle, hf_direction* out_direction) {
  return clone_object<DirectionObject>("hf_direction_clone", handle, "direction", out_direction, "out_direction");
}

void hf_direction_destroy(hf_direction direction) { destroy<DirectionObject>(direction); }

hf_result hf_direction_add_sites(hf_direction handle, uint32_t site_count, const uint32_t* vertices,
                                 const double* vectors, uint32_t* out_sites) {
  return edit("hf_direction_add_sites", handle, site_count, vertices, "vertices", vectors, "vectors",
              [&](field::DirectionField& field) { field.add(site_count, vertices, vectors, out_sites); });
}

hf_result hf_direction_remove_sites(hf_direction handle, uint32_t site_count, const uint32_t* sites) {
  return edit("hf_direction_remove_sites", handle, site_count, sites, "sites", nullptr, nullptr,
              [&](field::DirectionField& field) { field.remove(site_count, sites); });
}

hf_result hf_direction_move_sites(hf_direction handle, uint32_t site_count, const uint32_t* sites,
                                  const uint32_t* vertices) {
  return edit("hf_direction_move_sites", handle, site_count, sites, "sites", vertices, "vertices",
              [&](field::DirectionField& field) { field.move(site_count, sites, vertices); });
}

hf_result hf_direction_set_vectors(hf_direction handle, uint32_t site_count, const uint32_t* sites,
                                   const double* vectors) {
  return edit("hf_direction_set_vectors", handle, site_count, sites, "sites", vectors, "vectors",
              [&](field::DirectionField& field) { field.set_vectors(site_count, sites, vectors); });
}

hf_result hf_direction_rotate_sites(hf_direction handle, uint32_t site_count, const uint32_t* sites,
                                    const double* angles) {
  return edit("hf_direction_rotate_sites", handle, site_count, sites, "sites", angles, "angles",
              [&](field::DirectionField& field) { field.rotate(site_count, sites, angles); });
}

uint32_t hf_direction_get_site_count(hf_direction direction) {
  return count_at(direction, &DirectionObject::site_count);
}

hf_result hf_direction_get_sites(hf_direction handle, uint32_t capacity, uint32_t* out_sites, uint32_t* out_vertices,
                                 double* out_vectors, uint32_t* out_count) {
  return guarded("hf_direction_get_sites", [&] {
    const auto direction = object_of(handle);
    const Reading reading(*direction);
    write_count(out_count, direction->field.count());
    const bool given = out_sites || out_vertices || out_vectors;
    if (!given && !out_count) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "all arrays and out_count are NULL");
    check_capacity(given, capacity, direction->field.count(), "capacity");
    std::size_t at = 0;
    const Span<const field::DirectionConstraint> constraints = direction->field.constraints();
    for (std::size_t s = 0; given && s < constraints.size(); ++s) {
      const field::DirectionConstraint& c = constraints[s];
      if (c.vertex < 0) continue;
      if (out_sites) out_sites[at] = static_cast<std::uint32_t>(s);
      if (out_vertices) out_vertices[at] = c.given_vertex;
      if (out_vectors) put(direction->field.solver().connection().to_space(c.vertex, c.vector), out_vectors + 3 * at);
      ++at;
    }
  });
}

hf_result hf_direction_solve(hf_direction direction, const hf_array_out* out_vectors, hf_solve_info* out_info) {
  return guarded("hf_direction_solve", [&] { solve_directions(direction, out_vectors, out_info); });
}

hf_result hf_direction_get_singularities(hf_direction handle, uint32_t capacity, hf_singularity* out_singularities,
                                         uint32_t* out_count) {
  return guarded("hf_direction_get_singularities", [&] {
    const auto direction = object_of(handle);
    require_either(out_singularities, out_count, "out_singularities and out_count");
    const Reading reading(*direction);
    const mesh::Mesh& mesh = direction->field.solver().core().mesh;
    const Vector<field::Singularity> found = direction->field.singularities();
    write_count(out_count, found.size());
    check_capacity(out_singularities, capacity, found.size(), "capacity");
    if (!out_singularities) return;
    const Vector<std::uint32_t> triangle = mesh::given_triangles(mesh, *direction->memory);
    for (std::size_t i = 0; i < found.size(); ++i)
      out_singularities[i] = {triangle[static_cast<std::size_t>(found[i].triangle)],
                              mesh::given_vertex(mesh, found[i].vertex), found[i].index};
  });
}

hf_result hf_direction_get_statistics(hf_direction handle, hf_direction_statistics* out_statistics) {
  return guarded("hf_direction_get_statistics", [&] {
    const auto direction = object_of(handle);
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*direction);
    const field::DirectionSolver& solver = direction->field.solver();
    const field::DirectionCounters counters = solver.counters();
    hf_direction_statistics statistics{};
    statistics.unknown_count = static_cast<std::uint32_t>(solver.matrix().size());
    statistics.site_count = direction->field.count();
    statistics.factorisation_count = counters.factorisations;
    statistics.path_solve_count = counters.path_solves;
    statistics.sweep_count = counters.sweeps;
    statistics.irregular_vertex_count = solver.connection().irregular_count;
    statistics.degree = static_cast<std::uint32_t>(solver.degree());
    statistics.site_limit = direction->site_limit;
    statistics.eliminated_count = static_cast<std::uint32_t>(solver.eliminated_count());
    statistics.operator_ms = solver.operator_ms();
    statistics.numeric_ms = solver.statistics().numeric_ms;
    statistics.factor_entries = solver.statistics().entries;
    statistics.factor_bytes = solver.statistics().bytes;
    statistics.site_memory_bytes = counters.bytes;
    write_struct(out_statistics, statistics);
  });
}

}  // extern "C"
