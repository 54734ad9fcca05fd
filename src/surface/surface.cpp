#include "surface/surface.h"

#include "surface/edited_core.h"
#include "surface/link_change.h"

namespace hf_inner::surface {

namespace {
constexpr std::size_t unlinked_slot = 3;  // after the slots of the kinds of field
}  // namespace

// Runs when the last user of an operator is gone.
struct Surface::Forget {
  std::shared_ptr<const Core> core;
  std::shared_ptr<Made> made;
  std::size_t kind;
  void operator()(const Core*) noexcept {
    {
      const std::lock_guard<std::mutex> lock(made->guard);
      if (made->core[kind].expired()) made->core[kind].reset();
    }
    made.reset();
    core.reset();  // the operator last: it can hold the memory of all this
  }
};

Surface::Surface(std::shared_ptr<const Geometry> geometry, const CoreOptions& options)
    : geometry_(std::move(geometry)),
      own_(Core::make(geometry_, options)),
      made_(make_shared_in<Made>(*geometry_->memory)) {}

Surface::Surface(std::shared_ptr<const Surface> from, SurfaceEdit edit)
    : geometry_(edit.geometry ? edit.geometry : from->geometry_),
      own_(edit_core(from->own_, edit)),
      made_(make_shared_in<Made>(*geometry_->memory)),
      origin_(from->origin_ ? from->origin_ : from),
      edit_(&edit_core) {
  if (!edit.stiffness) return;
  if (geometry_ == from->unedited().geometry_) {
    plain_ = from->plain_ ? from->plain_ : from;
  } else if (geometry_ == origin_->geometry_) {
    plain_ = origin_;
  } else {
    const std::shared_ptr<const Surface> plain = from->plain_ ? from->plain_ : from->stiffness() ? origin_ : from;
    plain_ = make_owner_in<Surface>(geometry_->memory, plain, SurfaceEdit{nullptr, geometry_});
  }
}

std::shared_ptr<const Geometry> Surface::geometry_of(std::shared_ptr<const mesh::Links> links) const {
  for (const std::shared_ptr<const Geometry>& known : {geometry_, origin_ ? origin_->geometry_ : geometry_}) {
    if (&known->unlinked() == &geometry_->unlinked() && same_links(known->links.get(), links.get())) return known;
  }
  if (links->links.empty() && geometry_->unlinked().is_patched) return unlinked_geometry();
  return Geometry::relinked(geometry_, std::move(links));
}

std::shared_ptr<const Core> Surface::core(mesh::FieldKind kind) const {
  if (kind == own_->field_kind) return own_;
  return make_core(static_cast<std::size_t>(kind), geometry_, kind);
}

std::shared_ptr<const Core> Surface::unlinked_core() const {
  const bool patched = geometry_->unlinked().is_patched;  // a factor beside another one has other rows
  if (origin_ && !patched) return origin_->unlinked_core();
  if (!geometry_->plain && !patched) return core(mesh::FieldKind::harmonic);
  return make_core(unlinked_slot, unlinked_geometry(), mesh::FieldKind::harmonic);
}

std::shared_ptr<const Core> Surface::make_core(std::size_t slot, std::shared_ptr<const Geometry> geometry,
                                               mesh::FieldKind kind) const {
  const std::lock_guard<OwnedMutex> lock(making_);
  {
    const std::lock_guard<std::mutex> guard(made_->guard);
    if (std::shared_ptr<const Core> found = made_->core[slot].lock()) return found;
  }
  const auto make = [&] {
    // beside the factor of the surface before its edits, which a solver or a pose may have
    if (origin_ && kind == mesh::FieldKind::harmonic && slot != unlinked_slot)
      return edit_(origin_->core(kind), SurfaceEdit{own_->stiffness, geometry_}, 1);
    CoreOptions options;
    options.operator_kind = geometry->operator_kind;
    options.field_kind = kind;
    options.ordering = own_->ordering;
    options.flop_limit = own_->flop_limit;
    options.formed_valence = own_->formed_valence;
    if (slot != unlinked_slot) options.stiffness = own_->stiffness;
    return Core::make(geometry, options);
  };
  const std::shared_ptr<const Core> core = make();
  const std::shared_ptr<const Core> counted(core.get(), Forget{core, made_, slot},
                                            OwningAllocator<Core>(geometry_->memory));
  const std::lock_guard<std::mutex> guard(made_->guard);
  made_->core[slot] = counted;
  return counted;
}

}  // namespace hf_inner::surface
