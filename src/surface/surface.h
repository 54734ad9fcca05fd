// A surface: one geometry and up to three operators for fields on it, each with its factor.
//
// The surface keeps the operator that it was made with. It makes operators for other kinds of field when they are first
// needed. Users of such an operator share it, and it is freed with the last of them. So an unused surface holds only
// one factor.
#pragma once
#include <array>
#include <memory>
#include <mutex>

#include "base/owned_mutex.h"
#include "surface/core.h"

namespace hf_inner::surface {

struct SurfaceEdit;

class Surface {
 public:
  // Makes the operator and factor of options.field_kind, or loads the factor from options.saved_factor.
  Surface(std::shared_ptr<const Geometry> geometry, const CoreOptions& options);

  // Makes a surface with another stiffness or other links (edited_core.h), which shares the factor of `from`. Throws
  // what edit_core throws.
  Surface(std::shared_ptr<const Surface> from, SurfaceEdit edit);

  const Geometry& geometry() const noexcept { return *geometry_; }
  // Returns whether edits have changed its operators.
  bool is_edited() const noexcept { return own_->stiffness || (origin_ && origin_->geometry_ != geometry_); }
  // The surface with a stiffness of 1, for everything that follows lengths alone.
  const Surface& unedited() const noexcept { return plain_ ? *plain_ : *this; }
  // Returns the geometry with these links. Equal links share the geometry of a surface before this one.
  std::shared_ptr<const Geometry> geometry_of(std::shared_ptr<const mesh::Links> links) const;
  // Returns its geometry with other triangles. Throws what Geometry::patched throws.
  std::shared_ptr<const Geometry> patched(const mesh::MeshPatch& patch) const {
    return Geometry::patched(geometry_, patch);
  }
  // By vertex; null: 1 everywhere.
  const Vector<double>* stiffness() const noexcept { return own_->stiffness.get(); }
  // Returns the geometry of the triangles alone, without links.
  std::shared_ptr<const Geometry> unlinked_geometry() const noexcept {
    return geometry_->plain ? geometry_->plain : geometry_;
  }
  // Returns the operator that the surface was made with.
  const Core& own() const noexcept { return *own_; }
  mesh::FieldKind field_kind() const noexcept { return own_->field_kind; }

  // Returns the operator and factor of a kind of field. If they are missing, the call makes them, and other threads
  // that ask for them wait. Throws HF_ERROR_REENTRANT if a callback asks during the making, and what Core::make throws.
  // Thread safety: any thread.
  std::shared_ptr<const Core> core(mesh::FieldKind kind) const;
  // Returns the harmonic operator and factor of the triangles alone, without links and edits. Thread safety and errors
  // as above.
  std::shared_ptr<const Core> unlinked_core() const;

 private:
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const Core> own_;
  // The operators in use beside the own one, by kind. The last user of one takes it out, so nothing of it is left.
  struct Made {
    std::mutex guard;
    std::array<std::weak_ptr<const Core>, 4> core;  // by kind, then that without links
  };
  struct Forget;
  std::shared_ptr<const Core> make_core(std::size_t slot, std::shared_ptr<const Geometry> geometry,
                                        mesh::FieldKind kind) const;
  mutable OwnedMutex making_;
  const std::shared_ptr<Made> made_;
  std::shared_ptr<const Surface> origin_;  // before all edits; null: this is it
  std::shared_ptr<const Surface> plain_;   // with a stiffness of 1; null: this is it
  // edit_core (edited_core.h), or null without edits: a program that edits nothing links nothing of it
  std::shared_ptr<const Core> (*edit_)(std::shared_ptr<const Core>, SurfaceEdit, double) = nullptr;
};

}  // namespace hf_inner::surface
