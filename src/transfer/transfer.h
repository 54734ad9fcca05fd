// Plays the motion of one surface on another: the object behind hf_transfer_*.
//
// Pairs of regions give both surfaces the same harmonic coordinates (pair_fields) and matching clusters (clusters). A
// frame takes the rotations of the source's clusters (source_rotations) into the target's axes and rest directions
// (alignment). Then it solves the translations of the target's clusters (translations), and turns the clusters to fit
// each other (refit). Each vertex blends four clusters. The method follows Xu, Zhang, Cohen-Or and Xiong 2009, Section
// 6. Each file says what differs.
//
// The caller can add and remove pairs at any time; no factor changes. The next call recomputes the derived data.
//
// Anchors: the target's region moves as the source's region moved, y = c + s A (q - p). The means p and q are the
// source region's, at rest and posed. The mean c is the target region's at rest. s is the scale, and A takes the
// source's axes to the target's. When the source turns or falls as a whole, the offsets between the two rest shapes
// turn with it. The offset of a standing foot turns only as far as the foot itself.
//
// Ground (transfer_ground.cpp): a foot follows its path exactly while the source's foot is planted. A contact comes as
// near to the ground as its source. No part goes deeper under the ground than on the source. A lying body rests on the
// parts on which its source rests. All these are holds: constraints that are solved beside the energies and change no
// factor.
//
// A refused edit or frame changes nothing. apply() allocates nothing once prepared. Results do not depend on threads.
#pragma once
#include <cstdint>
#include <memory>

#include "deform/rigid_pieces.h"
#include "hf/transfer.h"
#include "transfer/alignment.h"
#include "transfer/clusters.h"
#include "transfer/overlaps.h"
#include "transfer/pair_fields.h"
#include "transfer/refit.h"
#include "transfer/source_rotations.h"
#include "transfer/translations.h"

namespace hf_inner::transfer {

struct TransferOptions {
  std::int32_t mode = HF_TRANSFER_FIELDS;
  std::shared_ptr<const ClusterScheme> scheme;  // of baselines alone; null: kernels around centres
  std::uint32_t cluster_count = 0;              // 0 = default_cluster_count, or the default of the scheme
  double kernel_width = 0;                      // 0 = from the number of pairs
  double scale = 0;                             // 0 = from the lengths of legs, or the bounding boxes
  double alignment_angle = 0;                   // radians; 0 = default_alignment_angle; negative = never
  bool keep_ground = true;                      // false: there is no ground (transfer_ground.cpp)
  double source_axes[9] = {0};                  // rows right, up, forward; zero = x, y, z
  double target_axes[9] = {0};
  // Rest poses in which the two bodies correspond, by inner vertex in the caller's units; empty: the surfaces as made.
  Span<const Vec3> source_rest, target_rest;  // read by the constructor only
};

// The dials of an animator, which need no new preparation. These values change nothing (hf_transfer_dials).
struct Dials {
  double stride = 1, hip_height_share = 0, neck_follow = 0, tail_follow = 0, arm_space = 0, long_follow = 0;
  bool moves_paths() const noexcept { return stride != 1 || hip_height_share != 0; }
  bool turns_limbs() const noexcept { return neck_follow != 0 || tail_follow != 0 || arm_space != 0; }
};

struct PairInput {
  Span<const std::int32_t> source, target;  // inner vertices; may repeat
  std::uint32_t flags = 0;                  // HF_PAIR_*
};

struct PairInfo {
  std::uint32_t flags = 0;
  double source_leak = 0, target_leak = 0;
  double alignment_angle = -1;  // negative = unknown
  double confidence = 0, alignment_share = 0;
  bool crossed = false;
};

// A constraint of one frame: the mean of a pair's target region goes to `place`, in the caller's units.
struct PairHold {
  std::uint32_t pair = 0;
  Vec3 place;
};

class Transfer {
 public:
  // Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE or HF_ERROR_TOO_LARGE for bad options (index: the caller's
  // vertex of a rest pose).
  Transfer(std::shared_ptr<const surface::Core> source, std::shared_ptr<const surface::Core> target,
           const TransferOptions& options);
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  // Adds pairs of regions. out_pairs: null, or room for one number per pair. Throws the errors of PairFields::add. Also
  // throws HF_ERROR_TOO_LARGE above 256 pairs, and HF_ERROR_INVALID_ARGUMENT for unknown flags. prepare_now: also
  // solves the fields and makes the clusters of all pairs, which else the next frame does. This changes no result.
  void add_pairs(Span<const PairInput> pairs, std::uint32_t* out_pairs, bool prepare_now = false);
  // Throws HF_ERROR_NOT_FOUND (index: position in the list), also for a number named twice.
  void remove_pairs(Span<const std::uint32_t> pairs);
  std::uint32_t pair_count() const noexcept { return static_cast<std::uint32_t>(numbers_.size()); }

  Span<const std::uint32_t> pairs() const noexcept { return {numbers_.data(), numbers_.size()}; }  // ascending

  PairInfo pair_info(std::uint32_t pair);

  // Takes dials for the next frames (transfer_dials.cpp). Throws HF_ERROR_INVALID_ARGUMENT or HF_ERROR_NON_FINITE; else
  // it cannot fail, and it allocates nothing.
  void set_dials(const Dials& dials);
  const Dials& dials() const noexcept { return dials_; }

  // Poses the target like the posed source. source, out: inner vertices of source and target, in the caller's units.
  // holds: regions of the target whose mean goes to a given place in this frame. Throws HF_ERROR_EMPTY without a pair,
  // and HF_ERROR_NON_FINITE or HF_ERROR_TOO_LARGE (index: given vertex of the source). For bad holds it throws
  // HF_ERROR_NOT_FOUND, HF_ERROR_NON_FINITE, HF_ERROR_TOO_LARGE, or HF_ERROR_INVALID_ARGUMENT for a pair named twice
  // (index: position in the list).
  void apply(const Vec3* source, Vec3* out, Span<const PairHold> holds = {});

  // Takes the pieces of the target that move rigidly, named by inner vertices; none: an empty list.
  void set_rigid_pieces(Span<const std::int32_t> vertices);

  std::int32_t cluster_count();
  // The joints of the skin of the last frame: clusters, then rigid pieces. Before the first frame, the skin is at rest.
  std::size_t joint_count();
  // Writes each joint's rest centroid, rotation and posed centroid, in the caller's units. Each array is null or
  // joint_count() long.
  void skin_motion(Vec3* pivots, deform::Quaternion* rotations, Vec3* places);
  // By inner vertex of the target: 1 if it may sink into the ground. NULL: there is no ground.
  const std::uint8_t* sinking();
  // Writes the joints and weights of an inner vertex of the target, by falling weight, with sum exactly 1.
  // influence_count: 4 or 8, the length of both arrays.
  void skin_weights(std::int32_t vertex, std::uint32_t influence_count, std::uint32_t* joints, float* weights);

  const surface::Core& source() const noexcept { return *source_core_; }
  const surface::Core& target() const noexcept { return *target_core_; }
  bool scale_found() const noexcept { return options_.scale == 0; }
  double scale();  // target lengths over source lengths as used, given units
  solve::EngineCounters source_counters() const noexcept { return source_.counters(); }
  solve::EngineCounters target_counters() const noexcept { return target_.counters(); }

 private:
  struct Prepared;
  Prepared& prepare();
  double kernel_width() const noexcept;
  // Clusters around centres, with all that a character needs beside them.
  bool has_kernels() const noexcept { return options_.mode == HF_TRANSFER_FIELDS && !options_.scheme; }
  bool has_ground() const noexcept { return has_kernels() && options_.keep_ground; }
  void prepare_alignment(Prepared& p) const;
  void prepare_anchors(Prepared& p) const;
  void prepare_ground(Prepared& p) const;
  void find_sinking(Prepared& p);
  void prepare_gradients(Prepared& p) const;
  void prepare_levers(Prepared& p, const Overlaps& from, const Overlaps& to) const;
  void prepare_dials(Prepared& p) const;  // the limbs that dials turn
  void turn_dials(Prepared& p) const noexcept;
  void stiffen(Prepared& p) const noexcept;
  void move_paths(Prepared& p) const;
  bool is_crossed(std::uint32_t number) const;
  void place_anchors(Prepared& p, const WholeMotion& whole, const deform::Quaternion& turn) const;
  void read_holds(Prepared& p, Span<const PairHold> holds) const;
  void hold_regions(Prepared& p, double rigid, double share) const;
  void settle(Prepared& p, Vec3 centroid) const;  // finds translations for the present rotations and goals
  void turn_clusters(Prepared& p) const;
  void blend(Prepared& p) const;
  double lying_share(Prepared& p) const noexcept;
  void lie_down(Prepared& p, Vec3 centroid, double lies, double rigid, double share) const;
  void keep_above_ground(Prepared& p, const deform::Quaternion& turn, Vec3 centroid, double rigid) const;
  void make_rigid(Prepared& p, Vec3* out) noexcept;
  bool raise_sunk(Prepared& p, Vec3 up, double allowed, double share) const;

  // With rest poses of the caller, these hold their positions and no factor; the fields have the cores as made.
  std::shared_ptr<const surface::Core> source_core_, target_core_, target_factor_;
  TransferOptions options_;
  Dials dials_;
  Mat3 source_axes_, target_axes_;
  deform::Quaternion axes_;  // A: takes the source's axes to the target's
  PairFields source_, target_;
  Vector<std::uint32_t> numbers_;  // numbers of pairs in use, ascending: order of the fields
  Vector<std::uint32_t> flags_;    // HF_PAIR_*, by pair number
  Vector<double> source_area_, target_area_;
  Vector<std::uint8_t> thin_;  // by inner vertex of the target (thin_parts.h); empty until the first pairs are prepared
  std::shared_ptr<const deform::RigidPieces> rigid_;  // null: none
  Buffer<Vec3> rigid_scratch_;
  std::shared_ptr<Prepared> prepared_;
};

}  // namespace hf_inner::transfer
