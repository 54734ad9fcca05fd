// The subject of unchanged_weights.cpp and its calls (unchanged_weights_calls.cpp).
#pragma once
#include "unchanged.h"

namespace unchanged {

struct BoneList {
  std::vector<double> heads, tails, axes;
  std::vector<std::uint32_t> parents;
  std::vector<std::int32_t> deforms;
  std::uint32_t count() const { return static_cast<std::uint32_t>(parents.size()); }
  hf_joints_desc desc() const;
};

struct PinList {
  std::vector<std::uint32_t> vertices, joints;
  std::vector<hf_place> places;  // instead of vertices
  std::vector<double> radii;
  std::vector<float> weights;
  std::uint32_t joint_count = 1;
  std::uint32_t count() const { return static_cast<std::uint32_t>(radii.size()); }
  hf_pins_desc desc() const;
};

// What a caller gave last: a fresh object of it has the same weights.
struct WeightsModel {
  BoneList bones;
  PinList pins;
  std::vector<std::uint32_t> locks;
  std::vector<float> kept;  // [vertex][lock]
  // Weights of pins are eighths, so shares are exact. A removed bone leaves quotients. Edits after that round again.
  bool quotients = false, rounded = false;
  void take_bones(const BoneList& list, const std::vector<std::uint32_t>& sources);
};

struct WeightsSeen {
  std::vector<std::uint32_t> joints;
  std::vector<float> weights;
  std::vector<std::uint8_t> origins;
  bool operator==(const WeightsSeen& o) const {
    return joints == o.joints && weights == o.weights && origins == o.origins;
  }
};

struct WeightsKnown {
  WeightsModel model;
  WeightsSeen seen;
};
using WeightsBranch = Clonable<hf_weights, hf_weights_destroy, WeightsKnown>;

class SkinWeights final : public Subject {
 public:
  SkinWeights(World& given, Random& random);
  bool ready() const { return !branches_.empty(); }
  void glance(State& state) override;
  void look(State& state) override;
  std::string compare_fresh() override;
  const std::vector<Command>& commands() const override;

 private:
  friend struct WeightsCalls;
  WeightsBranch& any(Random& random) { return branches_[random.below(static_cast<std::uint32_t>(branches_.size()))]; }
  std::uint32_t influences() const { return influence_count_ ? influence_count_ : 4; }
  WeightsSeen seen_of(hf_weights handle) const;
  void look_at_weights(const WeightsBranch& b, State& state) const;
  std::uint64_t bits_of(const WeightsBranch& b) const {
    State state;
    look_at_weights(b, state);
    return state.last();
  }
  std::string compare_fresh(const WeightsBranch& b) const;
  // A change was done.
  void changed(WeightsBranch& b) {
    world.memory.disarm();
    b.seen = seen_of(b.handle);
  }
  BoneList bones(std::uint32_t count, Random& random) const;
  PinList pins(std::uint32_t count, std::uint32_t bones, Random& random) const;

  std::uint32_t influence_count_ = 0;
  std::vector<WeightsBranch> branches_;
};

}  // namespace unchanged
