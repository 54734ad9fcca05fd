// The object behind hf_weights.
#pragma once
#include "capi/objects.h"
#include "hf/weights.h"
#include "weights/weights.h"

namespace hf_inner::capi {

struct WeightsObject final : Object {
  static constexpr Kind kind_of = Kind::weights;
  WeightsObject(std::shared_ptr<const SkinSurface> surface, std::int32_t influences, const Bones& bones)
      : Object(kind_of), memory(surface->core->memory), weights(std::move(surface), influences, bones) {}
  WeightsObject(const WeightsObject& other) : Object(kind_of), memory(other.memory), weights(other.weights) {}
  std::shared_ptr<Memory> memory;  // outlives what follows
  Weights weights;
};

}  // namespace hf_inner::capi
