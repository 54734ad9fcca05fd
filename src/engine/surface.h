// A surface: one geometry and up to three operators for fields on it, each with its factor.
//
// The surface keeps the operator that it was made with. It makes operators for other kinds of field when they are first
// needed. Users of such an operator share it, and it is freed with the last of them. So an unused surface holds only
// one factor.
#pragma once
#include <array>
#include <memory>

#include "base/owned_mutex.h"
#include "engine/core.h"

namespace hf_inner {

class Surface {
 public:
  // Makes the operator and factor of options.field_kind, or loads the factor from options.saved_factor.
  Surface(std::shared_ptr<const Geometry> geometry, const CoreOptions& options);

  const Geometry& geometry() const noexcept { return *geometry_; }
  // Returns the operator that the surface was made with.
  const Core& own() const noexcept { return *own_; }
  FieldKind field_kind() const noexcept { return own_->field_kind; }

  // The operator and factor of a kind of field. Cost: none for one that exists, else that of making it; other threads
  // that ask for a missing one wait meanwhile. Throws HF_ERROR_REENTRANT when a callback of the making asks, and as
  // Core::make. Thread safety: any thread.
  std::shared_ptr<const Core> core(FieldKind kind) const;

 private:
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const Core> own_;
  mutable OwnedMutex making_;
  mutable std::array<std::weak_ptr<const Core>, 3> made_;  // by kind of field, guarded by making_
};

}  // namespace hf_inner
