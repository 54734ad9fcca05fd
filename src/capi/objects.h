// The classes of the objects behind the handles.
#pragma once
#include <atomic>
#include <memory>

#include "base/progress.h"
#include "capi/boundary.h"
#include "capi/handle_table.h"
#include "field/intake.h"
#include "hf/surface.h"
#include "mesh/places.h"
#include "surface/edited_core.h"
#include "surface/surface.h"

namespace hf_inner::capi {

struct ProgressObject final : Object {
  static constexpr Kind kind_of = Kind::progress;
  ProgressObject() noexcept : Object(kind_of) {}
  Progress progress;
};

// Calls work() as a call that reports to a progress object; null: to none. A cancel that stopped
// this call does not stop the next.
template <class Work>
auto with_progress(const std::shared_ptr<ProgressObject>& object, Work&& work) {
  Progress* const progress = object ? &object->progress : nullptr;
  const CallProgress here(progress);
  if (progress) progress->begin();
  try {
    poll();
    return work();
  } catch (const Error& error) {
    if (error.code() == HF_ERROR_CANCELLED && object) object->progress.clear_cancel();
    throw;
  }
}
inline std::shared_ptr<ProgressObject> progress_of(hf_progress handle) {
  return handle ? get<ProgressObject>(handle, "progress") : nullptr;
}
template <class Work>
auto with_progress(hf_progress handle, Work&& work) {
  return with_progress(progress_of(handle), std::forward<Work>(work));
}

struct SurfaceObject final : Object {
  static constexpr Kind kind_of = Kind::surface;
  SurfaceObject(std::shared_ptr<const surface::Geometry> geometry, const surface::CoreOptions& options,
                const hf_surface_info& given)
      : Object(kind_of, geometry->memory), surface(std::move(geometry), options), info(given) {}
  // A surface edited from another one.
  SurfaceObject(std::shared_ptr<const surface::Surface> from, surface::SurfaceEdit edit, const hf_surface_info& given)
      : Object(kind_of, from->geometry().memory),
        surface(std::move(from), std::move(edit)),
        info(counted(given, surface.geometry().mesh.report)) {}
  const surface::Surface surface;
  const hf_surface_info info;

 private:
  static hf_surface_info counted(hf_surface_info info, const mesh::MeshReport& report) noexcept {
    info.vertex_count = report.vertex_count;
    info.triangle_count = report.triangle_count;
    return info;
  }
};

// Returns a surface that has triangles. purpose: why the call needs them. Throws HF_ERROR_UNSUPPORTED for one made of a
// graph.
inline std::shared_ptr<SurfaceObject> mesh_surface(hf_surface handle, const char* purpose, const char* name = "surface",
                                                   std::uint32_t index = HF_NO_INDEX) {
  std::shared_ptr<SurfaceObject> object = get<SurfaceObject>(handle, name, index);
  mesh::require_triangles(object->surface.geometry().mesh, purpose, index);
  return object;
}

// Returns the harmonic core (operator and factor) of such a surface, with its links. Poses are built on this core,
// transfers on that without edits.
inline std::shared_ptr<const surface::Core> harmonic_core(hf_surface handle, const char* purpose,
                                                          const char* name = "surface",
                                                          std::uint32_t index = HF_NO_INDEX) {
  return mesh_surface(handle, purpose, name, index)->surface.core(mesh::FieldKind::harmonic);
}

// The harmonic core with links, without edits.
inline std::shared_ptr<const surface::Core> unedited_core(hf_surface handle, const char* name, std::uint32_t index) {
  return mesh_surface(handle, "a transfer", name, index)->surface.unedited().core(mesh::FieldKind::harmonic);
}

// The same without links, for what works on triangles: directions, distances, extremities and quads.
inline std::shared_ptr<const surface::Core> unlinked_core(hf_surface handle, const char* purpose) {
  return mesh_surface(handle, purpose)->surface.unlinked_core();
}

struct SolverObject final : Object {
  static constexpr Kind kind_of = Kind::solver;
  // engine: as ScalarField takes it.
  SolverObject(std::shared_ptr<const surface::Core> core, const field::SolverOptions& options,
               std::shared_ptr<solve::SiteSolver> engine = nullptr)
      : Object(kind_of, core->memory),
        site_limit(options.site_limit),
        field(std::move(core), options.channels, site_limit, std::move(engine)) {}
  SolverObject(const SolverObject& other)
      : Object(kind_of, other.memory),
        site_limit(other.site_limit),
        field(other.field),
        site_count(other.field.sites().count()) {}
  const std::uint32_t site_limit;
  field::ScalarField field;
  // The site count after the last finished change. Another thread may read it while a change runs.
  std::atomic<std::uint32_t> site_count{0};
};

// The body of a function that makes an object: its handle in *out, NULL on failure.
template <class Handle, class Make>
hf_result create(const char* function, Handle* out, const char* name, Make&& make) {
  return guarded(function, [&] { create(out, name, make); });
}

// The body of a function that copies an object.
template <class T, class Handle>
hf_result clone_object(const char* function, Handle handle, const char* name, Handle* out, const char* out_name) {
  return create(function, out, out_name, [&] {
    const auto object = get<T>(handle, name);
    const Reading reading(*object);
    return make_owner_in<T>(object->memory, *object);
  });
}

// A count that can be read while another thread changes the object; 0 for an invalid handle.
template <class T, class Handle>
std::uint32_t count_at(Handle handle, const std::atomic<std::uint32_t> T::*count) {
  const std::shared_ptr<Object> object = find(reinterpret_cast<std::uintptr_t>(handle), T::kind_of);
  return object ? (static_cast<const T&>(*object).*count).load() : 0;
}

}  // namespace hf_inner::capi
