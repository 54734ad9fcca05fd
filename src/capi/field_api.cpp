// hf/field.h: sites and fields.
#include <algorithm>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/scatter.h"
#include "field/vector_field.h"
#include "hf/field.h"

namespace hf_inner::capi {
namespace {

Places read_places(const hf_sites_desc& desc) {
  if (desc.site_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "site_count is 0");
  if (desc.vertices && desc.triangles)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "vertices and triangles are both set; set one");
  if (!desc.vertices && !desc.triangles)
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "vertices and triangles are both NULL");
  if (desc.triangles && !desc.barycentrics)
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "barycentrics is NULL, but the sites are in triangles");
  Places places;
  places.count = desc.site_count, places.vertices = desc.vertices, places.triangles = desc.triangles,
  places.barycentrics = desc.barycentrics;
  places.radii = desc.radii;
  return places;
}

void read_addition(const hf_sites_desc* given, FieldEdit& edit) {
  const hf_sites_desc desc = read_struct(given, "sites");
  edit.add = read_places(desc);
  edit.add_values = desc.values, edit.add_stiffness = desc.stiffness;
}

void read_move(std::uint32_t count, const std::uint32_t* sites, const hf_sites_desc* to, FieldEdit& edit) {
  if (count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "site_count is 0");
  require(sites, "sites");
  const hf_sites_desc desc = read_struct(to, "to");
  if (desc.values || desc.stiffness || desc.radii)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "moving keeps values, stiffness and radius: set them to NULL in the desc");
  edit.move_count = count, edit.move_sites = sites, edit.move_to = read_places(desc);
  if (edit.move_to.count != count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "%u sites to move, but %u places", count, edit.move_to.count);
}

// Counts no list can have, refused before the lists are read or anything is allocated by them.
void check_counts(const SolverObject& solver, const FieldEdit& edit) {
  const std::uint32_t there = solver.field.sites().count();
  if (edit.remove_count > there)
    fail(HF_ERROR_NO_SUCH_SITE, there, "%u sites to remove, but the solver has %u", edit.remove_count, there);
  const std::uint32_t left = there - edit.remove_count;
  if (edit.move_count > left)
    fail(HF_ERROR_NO_SUCH_SITE, left, "%u sites to move, but the solver has %u%s", edit.move_count, left,
         edit.remove_count ? " after the removals" : "");
  if (edit.set_count > left)
    fail(HF_ERROR_NO_SUCH_SITE, left, "%u values to set, but the solver has %u sites%s", edit.set_count, left,
         edit.remove_count ? " after the removals" : "");
  if (edit.add.count > solver.site_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u sites to add; the site_limit is %u", edit.add.count, solver.site_limit);
}

void apply(hf_solver handle, const FieldEdit& edit, std::uint32_t* out_sites) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  const Changing changing(*solver);
  check_counts(*solver, edit);
  solver->field.edit(edit, out_sites);
  solver->site_count = solver->field.sites().count();
}

// Counts what no site reaches.
hf_solve_info unreached(const SolverObject& solver) {
  hf_solve_info info{};
  const Core& core = solver.field.core();
  info.first_unreached_component = HF_NO_INDEX;
  info.unreached_vertex_count = core.mesh.report.isolated_vertex_count;
  for (std::uint32_t c = 0; c < core.mesh.report.component_count; ++c) {
    if (solver.field.engine().site_count(static_cast<std::int32_t>(c)) > 0) continue;
    if (info.unreached_component_count++ == 0) info.first_unreached_component = c;
    info.unreached_vertex_count += solver.given_count[c];
  }
  return info;
}

void solve(hf_solver handle, float* f32, double* f64, std::uint32_t value_stride, hf_solve_info* out_info) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  if (!f32 && !f64) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_values is NULL");
  if (out_info) check_struct(out_info, "out_info");
  const Reading reading(*solver);
  const Core& core = solver->field.core();
  const std::size_t m = static_cast<std::size_t>(solver->field.sites().channels());
  const std::size_t stride = stride_of(value_stride, m * (f64 ? sizeof(double) : sizeof(float)), "value_stride");
  FieldWriter writer(core, f64 ? static_cast<void*>(f64) : f32, f64 != nullptr, stride);
  solver->field.solve_into(writer);
  if (out_info) write_struct(out_info, unreached(*solver));
}

void solve_vectors(hf_solver handle, float* f32, double* f64, std::uint32_t stride, double* out_normals,
                   hf_solve_info* out_info) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  if (!f32 && !f64) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_vectors is NULL");
  if (out_info) check_struct(out_info, "out_info");
  const Reading reading(*solver);
  const Core& core = solver->field.core();
  if (solver->field.sites().channels() != 3)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the solver has %d channels; vector fields need channel_count 3",
         solver->field.sites().channels());
  const Rows out = rows_of(f32, f64, stride, "vector_stride");
  Workspace field(core.workspaces, static_cast<std::size_t>(core.size()) * 3);
  solver->field.solve(field.data());
  const Vector<Vec3> normals = vertex_normals(core.mesh, *solver->memory);
  project_on_tangent_planes(normals, field.data());
  scatter(core, 3, out, nullptr, [&](std::size_t v, double* values) { std::copy_n(field.data() + v * 3, 3, values); });
  if (out_normals) {
    scatter(core, 3, Rows(out_normals, 3 * sizeof(double)), nullptr, [&](std::size_t v, double* values) {
      values[0] = normals[v].x, values[1] = normals[v].y, values[2] = normals[v].z;
    });
  }
  if (out_info) write_struct(out_info, unreached(*solver));
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_add_sites(hf_solver solver, const hf_sites_desc* sites, uint32_t* out_sites) {
  return guarded("hf_add_sites", [&] {
    FieldEdit edit;
    get<SolverObject>(solver, Kind::solver, "solver");
    read_addition(sites, edit);
    apply(solver, edit, out_sites);
  });
}

hf_result hf_remove_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites) {
  return guarded("hf_remove_sites", [&] {
    FieldEdit edit;
    get<SolverObject>(solver, Kind::solver, "solver");
    if (site_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "site_count is 0");
    require(sites, "sites");
    edit.remove_count = site_count, edit.remove_sites = sites;
    apply(solver, edit, nullptr);
  });
}

hf_result hf_move_sites(hf_solver solver, uint32_t site_count, const uint32_t* sites, const hf_sites_desc* to) {
  return guarded("hf_move_sites", [&] {
    FieldEdit edit;
    get<SolverObject>(solver, Kind::solver, "solver");
    read_move(site_count, sites, to, edit);
    apply(solver, edit, nullptr);
  });
}

hf_result hf_set_site_values(hf_solver solver, uint32_t site_count, const uint32_t* sites, const double* values) {
  return guarded("hf_set_site_values", [&] {
    FieldEdit edit;
    get<SolverObject>(solver, Kind::solver, "solver");
    if (site_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "site_count is 0");
    require(sites, "sites"), require(values, "values");
    edit.set_count = site_count, edit.set_sites = sites, edit.set_values = values;
    apply(solver, edit, nullptr);
  });
}

hf_result hf_edit_sites(hf_solver solver, const hf_edit_desc* given, uint32_t* out_sites) {
  return guarded("hf_edit_sites", [&] {
    get<SolverObject>(solver, Kind::solver, "solver");
    const hf_edit_desc desc = read_struct(given, "edit");
    FieldEdit edit;
    if (desc.remove_count) require(desc.remove_sites, "remove_sites");
    edit.remove_count = desc.remove_count, edit.remove_sites = desc.remove_sites;
    if (desc.move_count) read_move(desc.move_count, desc.move_sites, desc.move_to, edit);
    if (desc.set_count) require(desc.set_sites, "set_sites"), require(desc.set_values, "set_values");
    edit.set_count = desc.set_count, edit.set_sites = desc.set_sites, edit.set_values = desc.set_values;
    if (desc.add) read_addition(desc.add, edit);
    apply(solver, edit, out_sites);
  });
}

uint32_t hf_get_site_count(hf_solver solver) {
  const std::shared_ptr<Object> object = find(reinterpret_cast<std::uintptr_t>(solver), Kind::solver);
  return object ? static_cast<SolverObject&>(*object).site_count.load() : 0;
}

hf_result hf_get_sites(hf_solver handle, hf_site_info* out_info) {
  return guarded("hf_get_sites", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    check_struct(out_info, "out_info");
    const hf_site_info info = read_struct(out_info, "out_info");
    const Reading reading(*solver);
    const SiteSet& sites = solver->field.sites();
    if (info.capacity < sites.count())
      fail(HF_ERROR_TOO_SMALL, HF_NO_INDEX, "capacity is %u; the solver has %u sites", info.capacity, sites.count());
    const std::size_t m = static_cast<std::size_t>(sites.channels());
    Vector<double> flux(solver->memory.get());
    if (info.flux) {
      solver->field.flux(flux);
      for (std::size_t s = 0; s < sites.slots().size(); ++s) {
        const std::int32_t owner = sites.slots()[s].owner;
        for (std::size_t c = 0; owner >= 0 && c < m; ++c)
          flux[static_cast<std::size_t>(owner) * m + c] += flux[s * m + c];
      }
    }
    std::size_t at = 0;
    for (std::size_t s = 0; s < sites.slots().size(); ++s) {
      const SiteSet::Slot& slot = sites.slots()[s];
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

hf_result hf_solve(hf_solver solver, float* out_values, uint32_t value_stride, hf_solve_info* out_info) {
  return guarded("hf_solve", [&] { solve(solver, out_values, nullptr, value_stride, out_info); });
}

hf_result hf_solve_f64(hf_solver solver, double* out_values, uint32_t value_stride, hf_solve_info* out_info) {
  return guarded("hf_solve_f64", [&] { solve(solver, nullptr, out_values, value_stride, out_info); });
}

hf_result hf_solve_vectors(hf_solver solver, float* out_vectors, uint32_t vector_stride, double* out_normals,
                           hf_solve_info* out_info) {
  return guarded("hf_solve_vectors",
                 [&] { solve_vectors(solver, out_vectors, nullptr, vector_stride, out_normals, out_info); });
}

hf_result hf_solve_vectors_f64(hf_solver solver, double* out_vectors, uint32_t vector_stride, double* out_normals,
                               hf_solve_info* out_info) {
  return guarded("hf_solve_vectors_f64",
                 [&] { solve_vectors(solver, nullptr, out_vectors, vector_stride, out_normals, out_info); });
}

hf_result hf_solve_at(hf_solver handle, uint32_t vertex_count, const uint32_t* vertices, double* out_values) {
  return guarded("hf_solve_at", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    if (vertex_count == 0) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "vertex_count is 0");
    require(vertices, "vertices"), require(out_values, "out_values");
    const Reading reading(*solver);
    const Mesh& mesh = solver->field.core().mesh;
    const std::size_t m = static_cast<std::size_t>(solver->field.sites().channels());
    if (vertex_count > mesh.report.vertex_count)
      fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u vertices asked for; the mesh has %u", vertex_count,
           mesh.report.vertex_count);
    Vector<std::int32_t> inner(solver->memory.get());
    Vector<std::uint32_t> place(solver->memory.get());  // in `inner`, of every vertex of the list
    for (std::uint32_t i = 0; i < vertex_count; ++i) {
      if (vertices[i] >= mesh.report.vertex_count)
        fail(HF_ERROR_OUT_OF_RANGE, i, "entry %u of the list: vertex %u, but there are %u vertices", i, vertices[i],
             mesh.report.vertex_count);
      const std::int32_t v = mesh.inner_of_given[vertices[i]];
      place.push_back(v == Mesh::none ? HF_NO_INDEX : static_cast<std::uint32_t>(inner.size()));
      if (v != Mesh::none) inner.push_back(v);
    }
    Vector<double> values(inner.size() * m, solver->memory.get());
    solver->field.solve_at(inner, values.data());
    // the list is not read again: the caller may have it overwritten by the output
    for (std::size_t i = 0; i < vertex_count; ++i) {
      for (std::size_t c = 0; c < m; ++c)
        out_values[i * m + c] = place[i] == HF_NO_INDEX ? 0.0 : values[place[i] * m + c];
    }
  });
}

hf_result hf_prepare_rebase(hf_solver handle) {
  return guarded("hf_prepare_rebase", [&] {
    // neither reading nor changing: it runs beside both, the field guards itself
    get<SolverObject>(handle, Kind::solver, "solver")->field.prepare_rebase();
  });
}

hf_result hf_record(hf_solver handle) {
  return guarded("hf_record", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    const Changing changing(*solver);
    solver->field.record();
  });
}

hf_result hf_undo(hf_solver handle) {
  return guarded("hf_undo", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    const Changing changing(*solver);
    solver->field.undo();
    solver->site_count = solver->field.sites().count();
  });
}

hf_result hf_redo(hf_solver handle) {
  return guarded("hf_redo", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    const Changing changing(*solver);
    solver->field.redo();
    solver->site_count = solver->field.sites().count();
  });
}

}  // extern "C"
