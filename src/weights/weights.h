// Skin weights of a surface from a skeleton: a few bones per vertex with weights of sum 1, for every vertex.
//
// The smooth weights solve (K + A H) w = A H p: H is large near bones, p says which bone is nearest (Baran and Popovic
// 2007, with another strength of H). Pins are sites on the same operator. Weights of locked bones stay. Pieces without
// information take the weights of the nearest vertices of others. All results are functions of the inputs alone, so
// undo gives the same bits.
#pragma once
#include "weights/pins.h"
#include "weights/prune.h"

namespace hf_inner::weights {

// Weights that stay as they are, in units of weight_units by inner vertex.
struct Locks {
  explicit Locks(Memory& memory) : bones(&memory), units(&memory) {}
  Vector<Index> bones;
  Vector<float> units;  // [vertex][bones]
};

// The input of the caller. Immutable; undo keeps old ones.
struct WeightInputs {
  explicit WeightInputs(Memory& memory) : bones(memory), pins(memory) {}
  WeightInputs(const WeightInputs& other, Memory& memory)
      : bones(other.bones, memory), pins(other.pins, memory), locks(other.locks) {}
  Bones bones;
  Pins pins;
  std::shared_ptr<const Locks> locks;  // null: none
};

struct WeightCounts {
  std::uint32_t by_origin[6] = {};  // vertices of the caller, by Origin
  std::uint32_t pieces_carried = 0, pieces_rigid = 0;
  std::uint32_t factorisations = 0, path_solves = 0;  // since the object was made
  bool blind = false;
};

// The weights for one set of inputs. Immutable.
struct WeightState {
  explicit WeightState(Memory& memory)
      : joints(&memory), weights(&memory), origin(&memory), nearest_of_isolated(&memory) {}
  std::shared_ptr<const WeightInputs> inputs;
  std::shared_ptr<const Solution> solution;
  std::shared_ptr<const PinnedField> pinned;  // null without pins
  Vector<std::uint32_t> joints;               // [inner vertex][influences]
  Vector<float> weights;
  Vector<Origin> origin;              // by inner vertex
  Vector<Index> nearest_of_isolated;  // by Mesh::isolated: the inner vertex whose weights it takes
  WeightCounts counts;
};

class Weights {
 public:
  // influences: 4 or 8.
  Weights(std::shared_ptr<const SkinSurface> surface, std::int32_t influences, const Bones& bones);
  Weights(const Weights& other);
  Weights& operator=(const Weights&) = delete;

  // Replaces all bones. sources: by new bone the number it had before, or -1 for a new one; empty: the same numbers.
  // Pins and locks keep their bones. Throws HF_ERROR_CONFLICT (index = pin) if a pin loses all its bones.
  void set_joints(const Bones& bones, Span<const Index> sources);
  void set_pins(const Pins& pins);
  // values: the weights to keep, a row of the locked bones for each welded vertex; null: the present weights.
  void set_locks(Span<const Index> bones, const float* values);

  const WeightState& state() const noexcept { return *state_; }
  const SkinSurface& surface() const noexcept { return *surface_; }
  std::int32_t influences() const noexcept { return influences_; }

 private:
  using Inputs = std::shared_ptr<const WeightInputs>;
  std::shared_ptr<const WeightState> compute(const Inputs& inputs) const;
  void apply(const Inputs& inputs);
  Memory& memory() const noexcept { return *surface_->core->memory; }

  std::shared_ptr<const SkinSurface> surface_;  // first member
  const std::int32_t influences_;
  std::shared_ptr<const WeightState> state_;
};

}  // namespace hf_inner::weights
