// A pose with layers of handles, coarse to fine: the object behind hf_pose_* and hf_deform.
//
// Layer 0 is an ordinary pose (pose.h). Layer k > 0 edits the surface X_{k-1} of the layers below it, coarse to fine
// (Xu, Zhang, Cohen-Or and Xiong 2009, Section 5.3). It works on the original rest shape, with the handles of all
// layers up to k:
//   F_h   the rigid motion of handle h's region and its ring in X_{k-1};
//   U     the pose whose handles stand at F_h: the unedited one;
//   E     the pose whose handles stand at F_h D_h, D_h the transform the user gave h;
//   X_k = E + q (X_{k-1} - U),   q = the rotation from U to E, blended from the clusters like positions.
// U and E start from the same rotations, those of X_{k-1}, and take the same steps. So D_h = identity gives E = U bit
// for bit and X_k = X_{k-1}. A new handle does not change the surface, and removing it or moving it back undoes it
// exactly. Handles of the layers below are pins of the layer. A moved handle carries the surface it found rigidly.
//
// X_k depends on nothing but X_{k-1} and the transforms of the layer, not on the path. While only handles of a layer
// move, U is kept: one solve and one blend. Everything is transactional; repeated deform() calls allocate nothing;
// results do not depend on the number of threads.
#pragma once
#include <array>

#include "deform/pose.h"

namespace hf_inner {

class PoseStack {
 public:
  static std::shared_ptr<PoseStack> make(std::shared_ptr<const Core> core, const PoseOptions& options);
  std::shared_ptr<PoseStack> clone() const;

  // As Pose::add_handles, on a layer (HF_ERROR_INVALID_ARGUMENT beyond layer_limit). Handles of all layers share the
  // surface: no two regions overlap.
  void add_handles(Span<const std::uint32_t> start, Span<const std::int32_t> vertices, std::uint32_t layer,
                   Span<std::uint32_t> out_numbers);
  void remove_handles(Span<const std::uint32_t> numbers);
  // On layer 0 from rest; above, from where the layers below put the handle, in the frame of its rest.
  void set_transforms(Span<const std::uint32_t> numbers, Span<const HandleTransform> transforms);

  // request.surface = false is heeded while there is one layer only. All or nothing.
  DeformReport deform(const DeformRequest& request);

  std::uint32_t handle_count() const noexcept { return static_cast<std::uint32_t>(entries_.size()); }
  std::uint32_t layer_of(std::uint32_t number) const;
  HandleReport handle(std::uint32_t number) const;
  // The same, with this index in the error.
  HandleReport handle_at(std::uint32_t number, std::uint32_t index) const;
  Span<const double> field(std::uint32_t number) const;  // in the handle's own layer
  // Where the handle's transform took it in the last deform().
  HandleTransform placed(std::uint32_t number) const;
  const Core& core() const noexcept { return *core_; }
  const PoseOptions& options() const noexcept { return base_->options(); }
  const Pose& base() const noexcept { return *base_; }
  bool has_layers() const noexcept;

  explicit PoseStack(std::shared_ptr<const Core> core, std::shared_ptr<Pose> base);  // use make()

 private:
  struct Entry {
    std::uint32_t number = 0, layer = 0;
    std::array<std::uint32_t, layer_limit> inner{};  // its number in the poses of the layers from its own on
    Vec3 centroid;                                   // of the rest region, given frame
    HandleTransform edit;                            // D_h
    Vec3 turn;                                       // of D_h, turns included
    RigidMotion placed;                              // F_h D_h (layer 0: D_h), given frame
  };
  struct Layer {
    explicit Layer(Memory& memory) : relative(&memory), turns(&memory), zeros(&memory) {}
    std::shared_ptr<Pose> plain, edited;  // U and E
    Buffer<Vec3> surface;                 // X_k
    Vector<Quaternion> relative;          // by cluster, from U to E
    Vector<Vec3> turns, zeros;            // by handle of the pose, in its order
    DeformReport report;                  // of the last update
    bool plain_stale = true, edited_stale = true;
  };

  Memory& memory() const noexcept { return *core_->memory; }
  std::int32_t require(std::uint32_t number, std::uint32_t position) const;
  Span<const std::int32_t> region_of(const Entry& entry) const;
  // A pose with the handles of `entries` up to layer k, whose numbers in it are written there.
  std::shared_ptr<Pose> make_plain(Vector<Entry>& entries, std::uint32_t k) const;
  std::shared_ptr<Layer> make_layer(std::shared_ptr<Pose> plain) const;
  void mark_stale(std::uint32_t layer) noexcept;
  DeformReport deform_all(const DeformRequest& request);
  RigidMotion fit_region(const Entry& entry, Span<const std::int32_t> region, const Vec3* surface) const noexcept;
  // Layer k from the surface below it; whether its own surface may have changed.
  bool update(std::uint32_t k, Span<const Vec3> below, bool below_changed, const DeformRequest& request);
  void combine(Layer& layer, Span<const Vec3> below) noexcept;

  std::shared_ptr<const Core> core_;
  std::shared_ptr<Pose> base_;
  Vector<Entry> entries_;
  std::array<std::shared_ptr<Layer>, layer_limit> layers_;  // [0] unused
  Buffer<Vec3> rest_;
  Buffer<Normal> normals_;
  Buffer<NormalSum> normal_sums_;
  bool base_stale_ = true, refined_ = false;
};

}  // namespace hf_inner
