// Implements hf/solver.h: solvers and their sites.
#include <algorithm>

#include "capi/objects.h"
#include "capi/vertex_writer.h"
#include "field/intake.h"
#include "field/vector_sites.h"
#include "hf/solver.h"

namespace hf_inner::capi {
namespace {

template <class Work>
void change(hf_solver handle, Work&& work) {
  const auto solver = get<SolverObject>(handle, "solver");
  const Changing changing(*solver);
  work(*solver);
  solver->site_count = solver->field.sites().count();
}

// Applies an edit that read(edit) fills in. The handle is checked first.
template <class Read>
hf_result apply(const char* function, hf_solver handle, std::uint32_t* out_sites, Read&& read) {
  return guarded(function, [&] {
    get<SolverObject>(handle, "solver");
    field::FieldEdit edit;
    read(edit);
    change(handle, [&](SolverObject& solver) { solver.field.edit(edit, out_sites); });
  });
}

template <class Work>
hf_result change_vectors(const char* function, hf_solver handle, std::uint32_t count, const std::uint32_t* sites,
                         const void* list, const char* name, Work&& work) {
  return guarded(function, [&] {
    get<SolverObject>(handle, "solver");
    require_list(count, sites, "site_count", "sites");
    require(list, name);
    change(handle, [&](SolverObject& solver) { work(solver.field); });
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_create(hf_surface handle, const hf_solver_desc* given, hf_solver* out_solver) {
  return create("hf_create", out_solver, "out_solver", [&] {
    const auto surface = get<SurfaceObject>(handle, "surface");
    const hf_solver_desc desc = read_optional(given, "desc");
    const field::SolverOptions options = field::read_solver_options(desc);
    return with_progress(desc.progress, [&] {
      return make_owner_in<SolverObject>(surface->memory, surface->surface.core(options.field_kind), options);
    });
  });
}

hf_result hf_solver_clone(hf_solver handle, hf_solver* out_solver) {
  return clone_object<SolverObject>("hf_solver_clone", handle, "solver", out_solver, "out_solver");
}

void hf_solver_destroy(hf_solver solver) { destroy<SolverObject>(solver); }

hf_result hf_solver_get_info(hf_solver handle, hf_solver_info* out_info) {
  return guarded("hf_solver_get_info", [&] {
    const auto solver = get<SolverObject>(handle, "solver");
    check_struct(out_info, "out_info");
    const Reading reading(*solver);
    hf_solver_info info{};
    info.field_kind = static_cast<std::int32_t>(solver->field.core().field_kind);
    info.channel_count = static_cast<std::uint32_t>(solver->field.sites().channels());
    info.site_limit = solver->site_limit;
    info.site_count = solver->field.sites().count();
    info.vertex_count = solver->field.core().mesh.report.vertex_count;
    write_struct(out_info, info);
  });
}

hf_result hf_add_sites(hf_solver solver, const hf_sites_desc* sites, uint32_t* out_sites) {
  return apply("hf_add_sites", solver, out_sites,
               [&](field::FieldEdit& edit) { field::read_addition(read_struct(sites, "sites"), edit); });
}

hf_result hf_solver_add_site(hf_solver solver, uint32_t vertex, const double* values, uint32_t* out_site) {
  return apply("hf_solver_add_site", solver, out_site, [&](field::FieldEdit& edit) {
    edit.add = {1, &vertex, nullptr, nullptr};
    edit.add_holds.values = values;
  });
}

hf_result hf_remove_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites) {
  return apply("hf_remove_sites", solver, nullptr, [&](field::FieldEdit& edit) {
    require_list(site_count, sites, "site_count", "sites");
    edit.remove_count = site_count;
    edit.remove_sites = sites;
  });
}

hf_result hf_solver_move_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites, const hf_sites_desc* to) {
  return apply("hf_solver_move_sites", solver, nullptr,
               [&](field::FieldEdit& edit) { field::read_move(site_count, sites, read_struct(to, "to"), edit); });
}

hf_result hf_solver_set_values(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* values) {
  return apply("hf_solver_set_values", solver, nullptr, [&](field::FieldEdit& edit) {
    require_list(site_count, sites, "site_count", "sites");
    require(values, "values");
    edit.set_count = site_count;
    edit.set_sites = sites;
    edit.set_values = values;
  });
}

hf_result hf_solver_edit_sites(hf_solver solver, const hf_edit_desc* given, uint32_t* out_sites) {
  return apply("hf_solver_edit_sites", solver, out_sites, [&](field::FieldEdit& edit) {
    const hf_edit_desc desc = read_struct(given, "edit");
    if (desc.remove_count) require(desc.remove_sites, "remove_sites");
    edit.remove_count = desc.remove_count;
    edit.remove_sites = desc.remove_sites;
    if (desc.move_count) field::read_move(desc.move_count, desc.move_sites, read_struct(desc.move_to, "to"), edit);
    if (desc.set_count) {
      require(desc.set_sites, "set_sites");
      require(desc.set_values, "set_values");
    }
    edit.set_count = desc.set_count;
    edit.set_sites = desc.set_sites;
    edit.set_values = desc.set_values;
    if (desc.add) field::read_addition(read_struct(desc.add, "sites"), edit);
  });
}

hf_result hf_solver_move_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites,
                                 const uint32_t* vertices) {
  return change_vectors("hf_solver_move_vectors", solver, site_count, sites, vertices, "vertices",
                        [&](field::ScalarField& field) { field::move_vectors(field, site_count, sites, vertices); });
}

hf_result hf_solver_rotate_vectors(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* angles) {
  return change_vectors("hf_solver_rotate_vectors", solver, site_count, sites, angles, "angles",
                        [&](field::ScalarField& field) { field::rotate_vectors(field, site_count, sites, angles); });
}

hf_result hf_solver_set_screening(hf_solver handle, const double* screening, const double* targets) {
  return guarded("hf_solver_set_screening", [&] {
    change(handle, [&](SolverObject& solver) {
      field::ScreeningInput input(*solver.memory);
      if (screening)
        input = field::read_screening(solver.field.core().mesh, solver.field.sites().channels(), screening, targets,
                                      *solver.memory);
      solver.field.set_screening(input.strength, input.target.empty() ? nullptr : input.target.data());
    });
  });
}

uint32_t hf_solver_get_site_count(hf_solver solver) { return count_at(solver, &SolverObject::site_count); }

hf_result hf_solver_get_sites(hf_solver handle, hf_sites_info* inout) {
  return guarded("hf_solver_get_sites", [&] {
    const auto solver = get<SolverObject>(handle, "solver");
    hf_sites_info info = read_struct(inout, "inout_info");
    require_zero(info.reserved);
    const Reading reading(*solver);
    const solve::SiteSet& sites = solver->field.sites();
    info.count = sites.count();
    write_struct(inout, info);
    const bool given =
        info.sites || info.vertices || info.components || info.values || info.stiffness || info.flux || info.radii;
    check_capacity(given, info.capacity, info.count, "capacity");
    const std::size_t m = static_cast<std::size_t>(sites.channels());
    Vector<double> flux(solver->memory.get());
    if (info.flux) solver->field.site_flux(flux);
    std::size_t at = 0;
    for (std::size_t s = 0; s < sites.slots().size(); ++s) {
      const solve::SiteSet::Slot& slot = sites.slots()[s];
      if (!slot.is_site()) continue;
      if (info.sites) info.sites[at] = static_cast<std::uint32_t>(s);
      if (info.vertices) info.vertices[at] = slot.given_vertex;
      if (info.components) info.components[at] = static_cast<std::uint32_t>(slot.site.component);
      if (info.stiffness) info.stiffness[at] = slot.stiffness;
      if (info.radii) info.radii[at] = slot.radius;
      if (info.values) std::copy_n(sites.values() + s * m, m, info.values + at * m);
      if (info.flux) std::copy_n(flux.data() + s * m, m, info.flux + at * m);
      ++at;
    }
  });
}

hf_result hf_solver_prepare_rebase(hf_solver solver) {
  return guarded("hf_solver_prepare_rebase", [&] {
    // This call is neither a Reading nor a Changing of the solver object. It may run during both, because the field has
    // its own locks.
    get<SolverObject>(solver, "solver")->field.prepare_rebase();
  });
}

hf_result hf_solver_get_statistics(hf_solver handle, hf_solver_statistics* out_statistics) {
  return guarded("hf_solver_get_statistics", [&] {
    const auto solver = get<SolverObject>(handle, "solver");
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*solver);
    const solve::EngineCounters counters = solver->field.engine().counters();
    hf_solver_statistics statistics{};
    statistics.site_count = solver->field.sites().count();
    statistics.factorisation_count = counters.factorisations - 1;  // the surface's own is not counted
    statistics.path_solve_count = counters.path_solves;
    statistics.sweep_count = counters.sweeps;
    statistics.last_route = static_cast<std::uint32_t>(counters.last_route);
    statistics.rebase_count = counters.rebases;
    statistics.dense_edit_count = counters.dense_edits;
    statistics.dense_row_count = counters.dense_rows;
    statistics.eliminated_count = counters.eliminated;
    statistics.rebase_advised = counters.rebase_advised;
    statistics.site_memory_bytes = counters.bytes;
    statistics.predicted_dense_ms = counters.dense_ms;
    statistics.predicted_rebase_ms = counters.rebase_ms;
    write_struct(out_statistics, statistics);
  });
}

}  // extern "C"
