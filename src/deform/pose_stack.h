// A pose with layers of handles, coarse to fine: the object behind hf_pose_* and hf_deform.
//
// Layer 0 is an ordinary pose (pose.h). Layer k > 0 edits the surface X_{k-1} of the layers below it (Xu, Zhang,
// Cohen-Or and Xiong 2009, Section 5.3). It works on the original rest shape, with the handles of all layers up to k:
//     F_h   the rigid motion of handle h's region and its ring in X_{k-1};
//     U     the unedited pose: each handle h stands at F_h;
//     E     the edited pose: each handle h stands at F_h D_h, where D_h is the user's transform of h;
//     X_k = E + q (X_{k-1} - U),   q: the rotation from U to E, blended from the clusters like positions.
// U and E start from the rotations of X_{k-1} and run the same steps. If all D_h are the identity, then E = U bit for
// bit, and X_k = X_{k-1}. A new handle therefore does not change the surface. Removing a handle, or moving it back,
// undoes its edit exactly. In layer k the handles of lower layers are fixed. A moved handle moves its part of the
// surface rigidly.
//
// A handle of free rotation is free in U and E of its own layer. D_h gives its place there, and it turns by q.
//
// X_k depends only on X_{k-1} and the transforms of its layer, not on the order of edits. While only handles of one
// layer move, U is reused, so a frame costs one solve and one blend. A failed call changes nothing. Repeated deform()
// calls allocate nothing. Results do not depend on the number of threads.
#pragma once
#include <array>

#include "deform/pose.h"

namespace hf_inner::deform {

// These two functions convert a motion p -> R (p - c) + c + t about a centroid c to p -> R p + t' about the origin, and
// back.
inline RigidMotion motion_of(const HandleTransform& transform, Vec3 centroid) noexcept {
  return {transform.rotation, centroid - rotate(transform.rotation, centroid) + transform.translation};
}
inline HandleTransform transform_of(const RigidMotion& motion, Vec3 centroid) noexcept {
  return {motion.rotation, apply(motion, centroid) - centroid};
}

class PoseStack {
 public:
  static std::shared_ptr<PoseStack> make(std::shared_ptr<const surface::Core> core, const PoseOptions& options);
  std::shared_ptr<PoseStack> clone() const;

  // Adds handles to a layer (0 coarsest), like Pose::add_handles. Throws HF_ERROR_INVALID_ARGUMENT for a layer beyond
  // layer_limit. Regions must not overlap, even in different layers.
  void add_handles(Span<const std::uint32_t> start, Span<const std::int32_t> vertices, std::uint32_t layer,
                   Span<std::uint32_t> out_numbers, const HandleKind& kind = {});
  void remove_handles(Span<const std::uint32_t> numbers);
  // On layer 0 a transform starts from the rest shape. On higher layers it starts where the lower layers put the
  // handle, in the frame of its rest shape.
  void set_transforms(Span<const std::uint32_t> numbers, Span<const HandleTransform> transforms);

  // Frees the rotations of handles, or gives them as they stand. On layer 0 the surface stays where it is.
  void set_free_turns(Span<const std::uint32_t> numbers, bool free_turn);
  bool free_turn(std::uint32_t number) const { return entries_[require(number, HF_NO_INDEX)].free_turn; }

  // Sets how much of the surface follows handles of layer 0. Throws HF_ERROR_UNSUPPORTED for others (index: position).
  void set_following(Span<const std::uint32_t> numbers, double following);
  double following(std::uint32_t number) const;

  // Sets the full-mesh steps on the limbs of handles of layer 0. Throws HF_ERROR_UNSUPPORTED for others.
  void set_limb_steps(Span<const std::uint32_t> numbers, std::uint32_t steps);
  std::uint32_t limb_steps(std::uint32_t number) const;

  // The pieces of these inner vertices are rigid from now on, no others. A handle on one takes all of it. Throws
  // HF_ERROR_CONFLICT where a handle has a part of one (index: position).
  void set_rigid_pieces(Span<const std::int32_t> vertices);
  bool has_rigid_pieces() const noexcept { return rigid_ != nullptr; }
  // Whether a vertex is more than a blend of clusters.
  bool needs_surface() const noexcept { return rigid_ || has_layers() || base_->keeps_limbs(); }

  // Solves all layers that changed and writes the surface. request.surface = false only has an effect while there is
  // one layer.
  DeformReport deform(const DeformRequest& request);

  // Goes to another core of the same geometry, with all handles and their transforms.
  void move_to(std::shared_ptr<const surface::Core> core);

  std::uint32_t handle_count() const noexcept { return static_cast<std::uint32_t>(entries_.size()); }
  std::uint32_t layer_of(std::uint32_t number) const;
  HandleReport handle(std::uint32_t number) const;
  // Returns the report of a handle like handle(), but an error carries this index.
  HandleReport handle_at(std::uint32_t number, std::uint32_t index) const;
  FieldColumn<const double> field(std::uint32_t number) const;  // of the pose of the handle's own layer
  // Returns the motion from rest to where the handle was in the last deform().
  HandleTransform placed(std::uint32_t number) const;
  const surface::Core& core() const noexcept { return *core_; }
  const PoseOptions& options() const noexcept { return base_->options(); }
  const Pose& base() const noexcept { return *base_; }
  bool has_layers() const noexcept;

  explicit PoseStack(std::shared_ptr<const surface::Core> core, std::shared_ptr<Pose> base);  // use make()

 private:
  struct Entry {
    std::uint32_t number = 0, layer = 0;
    // The handle's number in the poses of its own layer and of the layers above.
    std::array<std::uint32_t, layer_limit> inner{};
    Vec3 centroid;         // of the rest region, in the given frame
    HandleTransform edit;  // D_h, the transform that the user set; of a free handle with the rotation it took
    bool free_turn = false;
    Vec3 turn;           // rotation vector of D_h, with full turns
    RigidMotion placed;  // F_h D_h in the given frame, F_h the motion by lower layers; on layer 0 D_h
  };
  struct Layer {
    explicit Layer(Memory& memory) : relative(&memory), turns(&memory), zeros(&memory) {}
    std::shared_ptr<Pose> plain, edited;  // the poses U without and E with the layer's edits
    Buffer<Vec3> surface;                 // the surface of this layer and those below
    Vector<Quaternion> relative;          // rotation by cluster, from plain to edited
    Vector<Vec3> turns, zeros;            // by handle of the pose, in its order
    DeformReport report;                  // of the last update
    bool plain_stale = true, edited_stale = true;
  };

  Memory& memory() const noexcept { return *core_->memory; }
  std::int32_t require(std::uint32_t number, std::uint32_t position) const;
  Span<const std::int32_t> region_of(const Entry& entry) const;
  // Makes a pose with the handles of `entries` up to layer k, and writes their numbers in that pose into `entries`.
  std::shared_ptr<Pose> make_plain(Vector<Entry>& entries, std::uint32_t k) const;
  std::shared_ptr<Layer> make_layer(std::shared_ptr<Pose> plain) const;
  void check_rigid(const RigidPieces& rigid, Span<const std::int32_t> vertices) const;
  void take_whole_pieces(Span<const std::uint32_t> start, Span<const std::int32_t> vertices,
                         Vector<std::uint32_t>& whole_start, Vector<std::int32_t>& whole) const;
  // Returns the numbers of these handles in the pose of layer 0. Throws for others. word: the option in the error.
  Vector<std::uint32_t> on_base(Span<const std::uint32_t> numbers, const char* word) const;
  void mark_stale(std::uint32_t layer) noexcept;
  void take_base_turns();
  void take_turns(std::uint32_t k);
  DeformReport deform_all(const DeformRequest& request);
  RigidMotion fit_region(const Entry& entry, Span<const std::int32_t> region, const Vec3* surface) const noexcept;
  // Updates layer k from the surface below it. Returns whether the layer's own surface may have changed.
  bool update(std::uint32_t k, Span<const Vec3> below, bool below_changed, const DeformRequest& request);
  void combine(Layer& layer, Span<const Vec3> below) noexcept;

  std::shared_ptr<const surface::Core> core_;
  std::shared_ptr<Pose> base_;
  Vector<Entry> entries_;
  std::array<std::shared_ptr<Layer>, layer_limit> layers_;  // [0] unused
  std::shared_ptr<const RigidPieces> rigid_;                // null: none
  Buffer<Vec3> rigid_scratch_;
  Buffer<Vec3> rest_;
  Buffer<Normal> normals_;
  Buffer<NormalSum> normal_sums_;
  bool base_stale_ = true;
  std::uint32_t refined_ = 0;  // full-mesh steps of the last frame
  bool followed_ = false;      // they went on from the frame before
};

}  // namespace hf_inner::deform
