#include "engine/surface.h"

namespace hf_inner {

Surface::Surface(std::shared_ptr<const Geometry> geometry, const CoreOptions& options)
    : geometry_(std::move(geometry)), own_(Core::make(geometry_, options)) {}

std::shared_ptr<const Core> Surface::core(FieldKind kind) const {
  if (kind == own_->field_kind) return own_;
  const std::lock_guard<OwnedMutex> lock(making_);
  std::weak_ptr<const Core>& slot = made_[static_cast<std::size_t>(kind)];
  if (std::shared_ptr<const Core> made = slot.lock()) return made;
  CoreOptions options;
  options.operator_kind = geometry_->operator_kind, options.field_kind = kind, options.ordering = own_->ordering;
  options.flop_limit = own_->flop_limit;
  std::shared_ptr<const Core> made = Core::make(geometry_, options);
  slot = made;
  return made;
}

}  // namespace hf_inner
