// Reads the options that surfaces of meshes and of graphs share, and makes the surface.
#pragma once
#include <memory>
#include <utility>

#include "capi/objects.h"

namespace hf_inner::capi {

// Checks the options of a surface, and returns them with the defaults filled in.
hf_surface_info read_info(const hf_surface_desc& desc);

// Refuses a saved factor of another ordering than the desc asks for.
void read_saved_factor(const hf_surface_desc& desc, CoreOptions& options);

// make_geometry(memory, jobs) returns the geometry, of the operator of `info`.
template <class MakeGeometry>
std::shared_ptr<SurfaceObject> make_surface(const hf_surface_desc& desc, hf_surface_info info,
                                            MakeGeometry&& make_geometry) {
  if ((desc.allocator.allocate == nullptr) != (desc.allocator.release == nullptr))
    fail(HF_ERROR_NULL_POINTER, HF_NO_INDEX, "allocator: set both allocate and release, or neither");
  CoreOptions options;
  options.flop_limit = 1e9 * static_cast<double>(info.work_limit_gflop);
  options.operator_kind = static_cast<OperatorKind>(info.operator_kind);
  options.field_kind = static_cast<FieldKind>(info.field_kind);
  options.ordering = static_cast<Ordering>(info.ordering);
  if (desc.saved_factor) read_saved_factor(desc, options);
  info.ordering = static_cast<std::int32_t>(options.ordering);
  return with_progress(desc.progress, [&] {
    auto memory = make_memory(desc.allocator, std::uint64_t{desc.memory_limit_mb} << 20);
    auto jobs = make_shared_in<JobRunner>(*memory, info.thread_count, desc.job_runner);
    auto geometry = make_geometry(memory, std::move(jobs));
    return make_owner_in<SurfaceObject>(memory, std::move(geometry), options, info);
  });
}

}  // namespace hf_inner::capi
