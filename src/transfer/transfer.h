// Plays the motion of one surface on another: the object behind hf_transfer_*.
//
// Pairs of regions give both surfaces the same harmonic coordinates (pair_fields) and matching clusters (clusters).
// A frame takes the rotations of the source's clusters (source_rotations) into the target's axes and rest directions
// (alignment). Translations of the target's clusters follow (translations), which then turn to meet each other (refit).
// Each vertex blends four of them. Xu, Zhang, Cohen-Or and Xiong 2009, Section 6; those files name what differs.
//
// Pairs come and go at any time; no factor changes. Derived data is recomputed at the next question.
//
// Anchors: the target's region goes where the source's went, y = c + s A (q - p), s the scale. When the source turns or
// falls as a whole, the offsets between the two rest shapes turn with it. Those of a standing foot turn as far as the
// foot itself.
//
// Ground (transfer_ground.cpp): a foot follows its path exactly while its source stands. A contact comes as near to the
// ground as its source. No part sinks deeper than the source, and a lying body rests on the parts its source rests on.
// These are holds: constraints solved beside the energies, without touching a factor.
//
// Edits and frames are all or nothing. apply() allocates nothing once prepared. Results do not depend on threads.
#pragma once
#include <cstdint>
#include <memory>

#include "hf/transfer.h"
#include "transfer/alignment.h"
#include "transfer/clusters.h"
#include "transfer/pair_fields.h"
#include "transfer/refit.h"
#include "transfer/source_rotations.h"
#include "transfer/translations.h"

namespace hf_inner {

struct TransferOptions {
  std::int32_t mode = HF_TRANSFER_FIELDS;
  std::uint32_t cluster_count = 0;  // 0 = default_cluster_count; paper mode: 0 = default_bands per pair
  double kernel_width = 0;          // 0 = default_kernel_width
  double scale = 0;                 // 0 = from the legs or the boxes
  double alignment_angle = 0;       // radians; 0 = default_alignment_angle; negative = never
  double source_axes[9] = {0};      // rows right, up, forward; zero = x, y, z
  double target_axes[9] = {0};
};

struct PairInput {
  Span<const std::int32_t> source, target;  // inner vertices; may repeat
  std::uint32_t flags = 0;                  // HF_PAIR_*
};

struct PairInfo {
  std::uint32_t flags = 0;
  double source_leak = 0, target_leak = 0;
  double alignment_angle = -1;  // negative = unknown
  double confidence = 0;
  bool aligned = false, crossed = false;
};

// The mean of a pair's target region in one frame, given units.
struct PairHold {
  std::uint32_t pair = 0;
  Vec3 place;
};

class Transfer {
 public:
  // Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NON_FINITE for bad options.
  Transfer(std::shared_ptr<const Core> source, std::shared_ptr<const Core> target, const TransferOptions& options);
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  // out_pairs: null, or one number per pair. Errors of PairFields::add; HF_ERROR_TOO_LARGE above 256 pairs,
  // HF_ERROR_INVALID_ARGUMENT for unknown flags.
  void add_pairs(Span<const PairInput> pairs, std::uint32_t* out_pairs);
  // HF_ERROR_NO_SUCH_PAIR (index = position in the list), also for a number named twice.
  void remove_pairs(Span<const std::uint32_t> pairs);
  std::uint32_t pair_count() const noexcept { return static_cast<std::uint32_t>(numbers_.size()); }

  Span<const std::uint32_t> pairs() const noexcept { return {numbers_.data(), numbers_.size()}; }  // ascending

  PairInfo pair_info(std::uint32_t pair);

  // source: posed inner vertices of the source in given units; out: inner vertices of the target in given units.
  // HF_ERROR_EMPTY without a pair, HF_ERROR_NON_FINITE (index = vertex of the source as given). holds: regions of the
  // target that go where the caller says in this frame. HF_ERROR_NO_SUCH_PAIR, HF_ERROR_NON_FINITE,
  // HF_ERROR_INVALID_ARGUMENT (a pair twice), index = position in the list.
  void apply(const Vec3* source, Vec3* out, Span<const PairHold> holds = {});

  // The skin of the last frame (at rest when there was none since the pairs changed).
  std::int32_t cluster_count();
  // Each null or cluster_count() long, in given units: rest centroid, rotation, posed place of the centroid.
  void skin_motion(Vec3* pivots, Quaternion* rotations, Vec3* places);
  // joint[weight_count], weight[weight_count] of an inner vertex of the target, falling, summing to 1 exactly;
  // weight_count 4 or 8.
  void skin_weights(std::int32_t vertex, std::uint32_t weight_count, std::uint32_t* joints, float* weights);

  const Core& source() const noexcept { return *source_core_; }
  const Core& target() const noexcept { return *target_core_; }
  bool scale_found() const noexcept { return options_.scale == 0; }
  double scale();  // target lengths over source lengths as used, given units
  EngineCounters source_counters() const noexcept { return source_.counters(); }
  EngineCounters target_counters() const noexcept { return target_.counters(); }

 private:
  struct Prepared;
  Prepared& prepare();
  void prepare_alignment(Prepared& p) const;
  void prepare_anchors(Prepared& p) const;
  void prepare_ground(Prepared& p) const;
  bool is_crossed(std::uint32_t number) const;
  void place_anchors(Prepared& p, const WholeMotion& whole, const Quaternion& turn) const;
  void read_holds(Prepared& p, Span<const PairHold> holds) const;
  void hold_regions(Prepared& p, double share) const;
  void settle(Prepared& p, Vec3 centroid) const;  // translations of the present rotations and goals
  void turn_clusters(Prepared& p) const;
  void blend(Prepared& p) const;
  double lying_share(Prepared& p) const noexcept;
  void lie_down(Prepared& p, Vec3 centroid, double lies, double fallen, double share) const;
  void keep_above_ground(Prepared& p, Vec3 centroid, double share, double fallen) const;
  void find_sunk(Prepared& p, Vec3 up, double allowed) const noexcept;
  bool hold_sunk(Prepared& p, Vec3 up, double share, std::size_t& held) const noexcept;

  std::shared_ptr<const Core> source_core_, target_core_;
  TransferOptions options_;
  Mat3 source_axes_, target_axes_;
  Quaternion axes_;  // A
  PairFields source_, target_;
  Vector<std::uint32_t> numbers_;  // pairs in use, ascending: the order of the fields
  Vector<std::uint32_t> flags_;    // by number
  Vector<double> source_area_, target_area_;
  std::shared_ptr<Prepared> prepared_;
};

}  // namespace hf_inner
