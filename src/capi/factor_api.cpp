// hf/factor.h: the factor as bytes, previews in single precision.
#include <algorithm>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/scatter.h"
#include "factor/factor_bytes.h"
#include "hf/factor.h"

namespace hf_inner::capi {
namespace {

void solve_preview(hf_solver handle, float* f32, double* f64, std::uint32_t value_stride,
                   std::uint32_t correction_count, hf_preview_info* out_info) {
  const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
  if (!f32 && !f64) fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "out_values is NULL");
  if (out_info) check_struct(out_info, "out_info");
  constexpr std::uint32_t most_corrections = 8;
  if (correction_count > most_corrections)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "correction_count is %u; it must be 0 to %u", correction_count,
         most_corrections);
  const Reading reading(*solver);
  const Core& core = solver->field.core();
  const std::size_t m = static_cast<std::size_t>(solver->field.sites().channels());
  const Rows out = f64 ? Rows(f64, stride_of(value_stride, m * sizeof(double), "value_stride"))
                       : Rows(f32, stride_of(value_stride, m * sizeof(float), "value_stride"));
  Workspace field(core.workspaces, static_cast<std::size_t>(core.size()) * m);
  const PreviewInfo found = solver->field.solve_preview(static_cast<std::int32_t>(correction_count), field.data());
  scatter(core, m, out, nullptr, [&](std::size_t v, double* values) { std::copy_n(field.data() + v * m, m, values); });
  if (!out_info) return;
  hf_preview_info info{};
  info.exact = found.exact, info.correction_count = static_cast<std::uint32_t>(found.corrections);
  for (std::int32_t c = 0; c < core.mesh.component_count(); ++c)
    info.unreached_component_count += solver->field.engine().site_count(c) == 0;
  info.value_range = found.value_range, info.largest_correction = found.largest_correction;
  info.error_estimate = found.error_estimate, info.preview_bytes = found.bytes;
  write_struct(out_info, info);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_get_factor_size(hf_solver handle, size_t* out_size) {
  return guarded("hf_get_factor_size", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    require(out_size, "out_size");
    *out_size = static_cast<std::size_t>(saved_factor_size(*solver->field.core().factor));
  });
}

hf_result hf_save_factor(hf_solver handle, void* out_bytes, size_t size) {
  return guarded("hf_save_factor", [&] {
    const auto solver = get<SolverObject>(handle, Kind::solver, "solver");
    require(out_bytes, "out_bytes");
    const Reading reading(*solver);
    const Core& core = solver->field.core();
    save_factor(*core.factor, grounded_hash(core), {static_cast<std::uint8_t*>(out_bytes), size}, *core.memory,
                *core.jobs);
  });
}

hf_result hf_solve_preview(hf_solver solver, float* out_values, uint32_t value_stride, uint32_t correction_count,
                           hf_preview_info* out_info) {
  return guarded("hf_solve_preview",
                 [&] { solve_preview(solver, out_values, nullptr, value_stride, correction_count, out_info); });
}

hf_result hf_solve_preview_f64(hf_solver solver, double* out_values, uint32_t value_stride, uint32_t correction_count,
                               hf_preview_info* out_info) {
  return guarded("hf_solve_preview_f64",
                 [&] { solve_preview(solver, nullptr, out_values, value_stride, correction_count, out_info); });
}

hf_result hf_release_preview(hf_solver handle) {
  return guarded("hf_release_preview",
                 [&] { get<SolverObject>(handle, Kind::solver, "solver")->field.core().preview.release(); });
}

}  // extern "C"
