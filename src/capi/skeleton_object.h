// The objects behind hf_skeleton and hf_retarget.
#pragma once
#include "capi/objects.h"
#include "hf/retarget.h"
#include "retarget/retarget.h"
#include "skeleton/known_skeleton.h"

namespace hf_inner::capi {

struct SkeletonObject final : Object {
  static constexpr Kind kind_of = Kind::skeleton;
  explicit SkeletonObject(std::shared_ptr<const skeleton::KnownSkeleton> known)
      : Object(kind_of, known->memory), skeleton(std::move(known)) {}
  const std::shared_ptr<const skeleton::KnownSkeleton> skeleton;
};

// The data of a retarget. Copies share it.
struct RetargetParts {
  std::shared_ptr<const skeleton::KnownSkeleton> source, target;
  retarget::RetargetOptions options;
  std::shared_ptr<const Vector<double>> source_rest, target_rest;  // null: the rest of the skeleton

  retarget::RetargetSide side(const skeleton::KnownSkeleton& of,
                              const std::shared_ptr<const Vector<double>>& rest) const {
    return {of.input, of.character, rest ? rest->data() : nullptr};
  }
};

struct RetargetObject final : Object {
  static constexpr Kind kind_of = Kind::retarget;
  explicit RetargetObject(const RetargetParts& given)
      : Object(kind_of, given.target->memory),
        parts(given),
        retarget(given.side(*given.source, given.source_rest), given.side(*given.target, given.target_rest),
                 given.options, *memory),
        source_pose(10 * std::size_t{given.source->input.joint_count}, 0.0, memory.get()),
        target_pose(10 * std::size_t{given.target->input.joint_count}, 0.0, memory.get()) {}
  RetargetObject(const RetargetObject& other) : RetargetObject(other.parts) { retarget.copy_state(other.retarget); }
  const RetargetParts parts;
  retarget::Retarget retarget;
  Vector<double> source_pose, target_pose;  // of a frame
};

}  // namespace hf_inner::capi
