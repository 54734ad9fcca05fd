// One motion on every rig of the family: what each joint does is known, so what a retarget must give is known too.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "../skeleton/rig_family.h"
#include "base/memory.h"
#include "retarget/retarget.h"

namespace hf_test {

struct Acted {
  std::vector<double> trs;   // 10 numbers a joint
  std::vector<Vec3> places;  // in the space of the model
};

// A rig of one convention, at its own rest, that walks and waves.
class RigActor {
 public:
  RigActor(const std::string& convention, const BodyShape& shape, const Placing& placing = {});
  RigActor(const RigActor&) = delete;
  RigActor& operator=(const RigActor&) = delete;

  // Of the motion at a time; mirrored: left and right changed.
  Acted act(double time, bool mirrored = false) const;
  hf_inner::retarget::RetargetSide side() const { return {input_, *character_, nullptr}; }
  const Rig& rig() const { return *rig_; }
  const Placing& placing() const { return placing_; }
  const std::vector<std::int32_t>& parents() const { return placed_->parents; }
  // The joint of the body that carries a joint, or -1.
  int carrier(std::size_t joint) const { return carriers_[joint]; }
  double height() const { return character_->height; }
  // Lowest vertex of the feet along up over the ground, of world matrices (12 numbers a joint).
  double sole_height(const std::vector<double>& world) const;
  std::string why() const { return {character_->why.begin(), character_->why.end()}; }

 private:
  struct Frame;
  Frame frame_of(std::size_t joint, double time, bool mirrored) const;
  std::unique_ptr<Rig> rig_, t_rig_;
  BodyShape shape_;
  std::string convention_;
  Placing placing_;
  std::unique_ptr<PlacedRig> placed_;
  hf_inner::skeleton::CharacterInput input_;
  hf_inner::Memory memory_;
  std::unique_ptr<hf_inner::skeleton::Character> character_;
  std::vector<int> carriers_;
  std::vector<double> spine_shares_;
  double rest_ground_ = 0;
};

}  // namespace hf_test
