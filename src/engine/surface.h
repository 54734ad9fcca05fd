// A surface: one geometry and the operators that fields on it need, each with its factor.
//
// The operator it is made with stays. Those of other kinds of field are made when first asked for, shared by all who
// use them, and freed with the last of them. So a surface that is not used holds one factor, whatever was made on it.
#pragma once
#include <array>
#include <memory>
#include <mutex>

#include "base/owned_mutex.h"
#include "engine/core.h"

namespace hf_inner {

class Surface {
 public:
  // Makes the operator and factor of options.field_kind, or loads the factor (options.saved_factor).
  Surface(std::shared_ptr<const Geometry> geometry, const CoreOptions& options);

  const Geometry& geometry() const noexcept { return *geometry_; }
  // The operator the surface was made with.
  const Core& own() const noexcept { return *own_; }
  FieldKind field_kind() const noexcept { return own_->field_kind; }

  // The operator and factor of a kind of field. Cost: none for one that exists, else that of making it; other threads
  // that ask for a missing one wait meanwhile. Throws HF_ERROR_REENTRANT when a callback of the making asks, and as
  // Core::make. Thread safety: any thread.
  std::shared_ptr<const Core> core(FieldKind kind, Progress* progress = nullptr) const;

 private:
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const Core> own_;
  // The operators in use beside the own one, by kind. The last user of one takes it out, so nothing of it is left.
  struct Made {
    std::mutex guard;
    std::array<std::weak_ptr<const Core>, 3> core;
  };
  struct Forget;
  mutable OwnedMutex making_;
  const std::shared_ptr<Made> made_;
};

}  // namespace hf_inner
