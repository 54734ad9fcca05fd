// The class of the object behind a region handle.
#pragma once
#include "capi/objects.h"
#include "detail/region.h"

namespace hf_inner::capi {

struct RegionObject final : Object {
  static constexpr Kind kind_of = Kind::region;
  explicit RegionObject(std::shared_ptr<const RegionSurface> surface)
      : Object(kind_of), memory(surface->core->memory), region(std::move(surface)) {}
  RegionObject(const RegionObject& other) : Object(kind_of), memory(other.memory), region(other.region) {}
  std::shared_ptr<Memory> memory;  // outlives what follows
  Region region;
};

}  // namespace hf_inner::capi
