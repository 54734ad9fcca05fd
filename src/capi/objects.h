// The objects behind the handles.
#pragma once
#include <atomic>
#include <memory>

#include "base/progress.h"
#include "capi/handle_table.h"
#include "engine/surface.h"
#include "field/scalar_field.h"
#include "hf/surface.h"

namespace hf_inner::capi {

struct ProgressObject final : Object {
  static constexpr Kind kind_of = Kind::progress;
  ProgressObject() noexcept : Object(kind_of) {}
  Progress progress;
};

// Runs work(progress) with the progress of a handle, or null. A cancel that stopped this call does not stop the next.
template <class Work>
auto with_progress(hf_progress handle, Work&& work) {
  std::shared_ptr<ProgressObject> object;
  if (handle) object = get<ProgressObject>(handle, "progress");
  try {
    return work(object ? &object->progress : nullptr);
  } catch (const Error& error) {
    if (error.code() == HF_ERROR_CANCELLED && object) object->progress.clear_cancel();
    throw;
  }
}

struct SurfaceObject final : Object {
  static constexpr Kind kind_of = Kind::surface;
  SurfaceObject(std::shared_ptr<const Geometry> geometry, const CoreOptions& options, const hf_surface_info& given)
      : Object(kind_of), memory(geometry->memory), surface(std::move(geometry), options), info(given) {}
  std::shared_ptr<Memory> memory;  // outlives everything below
  const Surface surface;
  const hf_surface_info info;
};

// Poses, transfers, directions, distances and quads stand on this core.
inline std::shared_ptr<const Core> harmonic_core(hf_surface handle, const char* name = "surface",
                                                 std::uint32_t index = HF_NO_INDEX) {
  return get<SurfaceObject>(handle, name, index)->surface.core(FieldKind::harmonic);
}

struct SolverObject final : Object {
  static constexpr Kind kind_of = Kind::solver;
  SolverObject(std::shared_ptr<const Core> core, EngineKind engine, double given_penalty, std::uint32_t channels,
               std::uint32_t limit)
      : Object(kind_of),
        site_limit(limit),
        penalty(given_penalty),
        memory(core->memory),
        field(std::move(core), engine, given_penalty, static_cast<std::int32_t>(channels), limit) {}
  SolverObject(const SolverObject& other)
      : Object(kind_of),
        site_limit(other.site_limit),
        penalty(other.penalty),
        memory(other.memory),
        field(other.field),
        site_count(other.field.sites().count()) {}
  const std::uint32_t site_limit;
  const double penalty;
  std::shared_ptr<Memory> memory;  // outlives everything below
  ScalarField field;
  // of the last finished change: may be read while another thread changes the field
  std::atomic<std::uint32_t> site_count{0};
};

inline std::uint32_t given_vertex(const Mesh& mesh, std::int32_t inner) noexcept {
  return inner == Mesh::none ? HF_NO_INDEX
                             : static_cast<std::uint32_t>(mesh.given_of_inner[static_cast<std::size_t>(inner)]);
}

}  // namespace hf_inner::capi
