// Implements the part of hf/solver.h for fields, previews and certificates.
#include <algorithm>
#include <iterator>

#include "capi/objects.h"
#include "capi/vertex_writer.h"
#include "field/certificate.h"
#include "field/unreached.h"
#include "field/vector_field.h"
#include "field/vector_sites.h"
#include "hf/solver.h"
#include "mesh/vertex_lists.h"

namespace hf_inner::capi {
namespace {

hf_solve_info unreached(const SolverObject& solver) {
  const solve::SiteSolver& engine = solver.field.engine();
  return field::unreached_by(*solver.field.core().geometry, [&](std::int32_t c) { return engine.site_count(c); });
}

// Writes a field of `width` numbers per vertex. Throws as Overflow.
void write_checked(const surface::Core& core, std::size_t width, const Rows& out, const double* field) {
  Overflow overflow(out.is_double());
  write_vertices(core, width, out, nullptr, [&](std::size_t v, double* values) {
    std::copy_n(field + v * width, width, values);
    const std::size_t given = mesh::given_vertex(core.mesh, static_cast<std::int32_t>(v));
    for (std::size_t c = 0; c < width; ++c) overflow.look(given, values[c]);
  });
  overflow.check();
}

// read_out(width, rows) returns the caller's array.
template <class ReadOut>
void solve_field(hf_solver handle, hf_solve_info* out_info, ReadOut&& read_out) {
  const auto solver = get<SolverObject>(handle, "solver");
  if (out_info) check_struct(out_info, "out_info");
  const Reading reading(*solver);
  const surface::Core& core = solver->field.core();
  const Rows out = read_out(static_cast<std::size_t>(solver->field.sites().channels()), core.mesh.report.vertex_count);
  FieldWriter writer(core, out);
  solver->field.solve_into(writer);
  writer.check();
  if (out_info) write_struct(out_info, unreached(*solver));
}

void solve_vectors(hf_solver handle, const hf_array_out* out_vectors, double* out_normals, hf_solve_info* out_info) {
  const auto solver = get<SolverObject>(handle, "solver");
  require(out_vectors, "out_vectors");
  if (out_info) check_struct(out_info, "out_info");
  const Reading reading(*solver);
  const surface::Core& core = solver->field.core();
  field::require_vectors(solver->field);
  const Rows out = need_reals(out_vectors, 3, core.mesh.report.vertex_count, "vertices", "out_vectors");
  surface::Workspace field(core.workspaces, static_cast<std::size_t>(core.size()) * 3);
  solver->field.solve(field.data());
  const Vector<Vec3> normals = field::vertex_normals(core.mesh, *solver->memory);
  field::project_on_tangent_planes(normals, field.data());
  write_checked(core, 3, out, field.data());
  if (out_normals)
    write_vertices(core, 3, Rows(out_normals, 3 * sizeof(double)), nullptr,
                   [&](std::size_t v, double* values) { put(normals[v], values); });
  if (out_info) write_struct(out_info, unreached(*solver));
}

void solve_preview(hf_solver handle, const hf_array_out* out_values, std::uint32_t correction_count,
                   hf_preview_info* out_info) {
  const auto solver = get<SolverObject>(handle, "solver");
  require(out_values, "out_values");
  if (out_info) check_struct(out_info, "out_info");
  const std::int32_t corrections = field::read_correction_count(correction_count);
  const Reading reading(*solver);
  const surface::Core& core = solver->field.core();
  const std::size_t m = static_cast<std::size_t>(solver->field.sites().channels());
  const Rows out = need_reals(out_values, m, core.mesh.report.vertex_count, "vertices", "out_values");
  surface::Workspace field(core.workspaces, static_cast<std::size_t>(core.size()) * m);
  const solve::PreviewInfo found = solver->field.solve_preview(corrections, field.data());
  write_checked(core, m, out, field.data());
  if (!out_info) return;
  hf_preview_info info{};
  info.exact = found.exact;
  info.correction_count = static_cast<std::uint32_t>(found.corrections);
  info.unreached_component_count = unreached(*solver).unreached_component_count;
  info.value_range = found.value_range;
  info.largest_correction = found.largest_correction;
  info.error_estimate = found.error_estimate;
  info.preview_bytes = found.bytes;
  write_struct(out_info, info);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_solve(hf_solver solver, float* out_values, uint32_t value_stride, hf_solve_info* out_info) {
  return guarded("hf_solve", [&] {
    solve_field(solver, out_info, [&](std::size_t width, std::size_t) {
      require(out_values, "out_values");
      return Rows(out_values, stride_of(value_stride, width * sizeof(float), "value_stride"));
    });
  });
}

hf_result hf_solver_solve(hf_solver solver, const hf_array_out* out_values, hf_solve_info* out_info) {
  return guarded("hf_solver_solve", [&] {
    solve_field(solver, out_info, [&](std::size_t width, std::size_t rows) {
      return need_reals(out_values, width, rows, "vertices", "out_values");
    });
  });
}

hf_result hf_solver_solve_at(hf_solver handle, uint32_t count, const uint32_t* vertices, double* out_values) {
  return guarded("hf_solver_solve_at", [&] {
    const auto solver = get<SolverObject>(handle, "solver");
    require_list(count, vertices, "vertex_count", "vertices");
    require(out_values, "out_values");
    const Reading reading(*solver);
    const mesh::Mesh& mesh = solver->field.core().mesh;
    const std::size_t m = static_cast<std::size_t>(solver->field.sites().channels());
    mesh::check_vertex_count(mesh, count, "vertex_count");
    Vector<std::int32_t> asked(solver->memory.get()), inner(solver->memory.get());
    mesh::append_inner(mesh, count, vertices, "vertices", asked);
    std::copy_if(asked.begin(), asked.end(), std::back_inserter(inner),
                 [](std::int32_t v) { return v != mesh::Mesh::none; });
    Vector<double> values(inner.size() * m, solver->memory.get());
    solver->field.solve_at(inner, values.data());
    // From here on the caller's list is not read: the caller may pass memory for the output that overlaps the list.
    const double* next = values.data();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < m; ++c) out_values[i * m + c] = asked[i] == mesh::Mesh::none ? 0.0 : *next++;
    }
  });
}

hf_result hf_solver_solve_vectors(hf_solver solver, const hf_array_out* out_vectors, double* out_normals,
                                  hf_solve_info* out_info) {
  return guarded("hf_solver_solve_vectors", [&] { solve_vectors(solver, out_vectors, out_normals, out_info); });
}

hf_result hf_solver_solve_preview(hf_solver solver, const hf_array_out* out_values, uint32_t correction_count,
                                  hf_preview_info* out_info) {
  return guarded("hf_solver_solve_preview", [&] { solve_preview(solver, out_values, correction_count, out_info); });
}

hf_result hf_solver_release_preview(hf_solver solver) {
  return guarded("hf_solver_release_preview",
                 [&] { get<SolverObject>(solver, "solver")->field.core().preview.release(); });
}

hf_result hf_solver_certify(hf_solver handle, hf_certificate* inout_certificate) {
  return guarded("hf_solver_certify", [&] {
    const auto solver = get<SolverObject>(handle, "solver");
    hf_certificate report = read_struct(inout_certificate, "inout_certificate");
    const Reading reading(*solver);
    const double tolerance = field::certificate_tolerance(report.tolerance, solver->field.engine());
    const field::Certificate found = field::certify(solver->field);
    report.overshoot_checked = found.overshoot_checked;
    report.tolerance = tolerance;
    report.value_range = found.value_range;
    report.residual = found.residual;
    report.site_error = found.site_error;
    report.overshoot = found.overshoot;
    report.error_estimate = found.error;
    report.changed_vertex_count = solver->field.core().changed_count;
    report.worst_vertex = mesh::given_vertex(solver->field.core().mesh, found.vertex);
    write_struct(inout_certificate, report);
    field::require_accuracy(found, tolerance, report.worst_vertex);
  });
}

}  // extern "C"
