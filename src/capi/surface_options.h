// Makes the object of a surface, of a mesh or of a graph.
#pragma once
#include <memory>
#include <utility>

#include "capi/objects.h"
#include "surface/surface_intake.h"

namespace hf_inner::capi {

// make_geometry(memory, jobs) returns the geometry, of the operator of `info`.
template <class MakeGeometry>
std::shared_ptr<SurfaceObject> make_surface(const hf_surface_desc& desc, hf_surface_info info,
                                            MakeGeometry&& make_geometry) {
  surface::CoreOptions options = surface::core_options(info);
  if (desc.saved_factor)
    surface::read_saved_factor(read_struct(desc.saved_factor, "saved_factor"), desc.ordering, options);
  info.ordering = static_cast<std::int32_t>(options.ordering);
  return with_progress(desc.progress, [&] {
    auto memory = make_memory(desc.allocator, std::uint64_t{desc.memory_limit_mb} << 20);
    auto jobs = make_shared_in<JobRunner>(*memory, info.thread_count, desc.job_runner);
    auto geometry = make_geometry(memory, std::move(jobs));
    return make_owner_in<SurfaceObject>(memory, std::move(geometry), options, info);
  });
}

}  // namespace hf_inner::capi
