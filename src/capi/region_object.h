// The class of the object behind a region handle.
#pragma once
#include "capi/objects.h"
#include "detail/region.h"

namespace hf_inner::capi {

struct RegionObject final : Object {
  static constexpr Kind kind_of = Kind::region;
  explicit RegionObject(std::shared_ptr<const detail::RegionSurface> surface)
      : Object(kind_of, surface->core->memory), region(std::move(surface)) {}
  RegionObject(const RegionObject& other) : Object(kind_of, other.memory), region(other.region) {}
  detail::Region region;
};

}  // namespace hf_inner::capi
