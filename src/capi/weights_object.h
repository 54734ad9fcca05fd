// The object behind hf_weights.
#pragma once
#include "base/progress.h"
#include "capi/objects.h"
#include "hf/weights.h"
#include "weights/weights.h"

namespace hf_inner::capi {

struct WeightsObject final : Object {
  static constexpr Kind kind_of = Kind::weights;
  WeightsObject(std::shared_ptr<const weights::SkinSurface> surface, std::int32_t influences,
                const weights::Bones& bones)
      : Object(kind_of, surface->core->memory), weights(std::move(surface), influences, bones) {}
  WeightsObject(const WeightsObject& other) : Object(kind_of, other.memory), weights(other.weights) {}
  weights::Weights weights;
};

// The share of progress for a harmonic factor that a surface lacks; it passes at once where the factor is there. Chosen
// by time on a bi-harmonic torus with forty bones. Another share moves the fraction at equal times, and no result.
constexpr float progress_core = 0.4f;

// Returns the harmonic operator of a surface. Reports up to progress_core.
inline std::shared_ptr<const surface::Core> skin_core(const SurfaceObject& object) {
  const ProgressRange range(0.0f, progress_core);
  return object.surface.core(mesh::FieldKind::harmonic);
}

}  // namespace hf_inner::capi
