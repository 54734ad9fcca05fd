// Sets full-mesh steps on the limbs of handles (limbs.h), in a pose and in its layers.
#include "base/error.h"
#include "deform/pose_layout.h"
#include "deform/pose_stack.h"

namespace hf_inner::deform {

std::uint32_t Pose::limb_steps(std::uint32_t number) const {
  return state_->handles[require(number, HF_NO_INDEX)].limb_steps;
}

void Pose::set_limb_steps(Span<const std::uint32_t> numbers, std::uint32_t steps) {
  for (std::uint32_t k = 0; k < numbers.size(); ++k) require(numbers[k], k);
  auto state = make_shared_in<State>(memory(), *state_, memory());
  bool changed = false;
  for (const std::uint32_t number : numbers) {
    HandleState& handle = state->handles[find(number)];
    changed = changed || handle.limb_steps != steps;
    handle.limb_steps = steps;
  }
  if (!changed) return;
  prepare_limbs(*layout_, *state);
  state_ = std::move(state);
}

void Pose::prepare_limbs(const Layout& layout, State& state) const {
  state.limbs.reset();
  Vector<std::uint32_t> steps(&memory());
  for (const HandleState& handle : state.handles) steps.push_back(handle.limb_steps);
  auto limbs = make_shared_in<Limbs>(memory(), make_limbs(*core_, layout.reach, layout.fields, steps, memory()));
  if (limbs->factor) state.limbs = std::move(limbs);
}

// ---- layers ----

Vector<std::uint32_t> PoseStack::on_base(Span<const std::uint32_t> numbers, const char* word) const {
  Vector<std::uint32_t> inner(&memory());
  for (std::uint32_t k = 0; k < numbers.size(); ++k) {
    const Entry& entry = entries_[require(numbers[k], k)];
    if (entry.layer > 0)
      fail(HF_ERROR_UNSUPPORTED, k, "handle %u is on layer %u; set %s for handles of layer 0 only", numbers[k],
           entry.layer, word);
    inner.push_back(entry.inner[0]);
  }
  return inner;
}

void PoseStack::set_limb_steps(Span<const std::uint32_t> numbers, std::uint32_t steps) {
  base_->set_limb_steps(on_base(numbers, "limb_refine"), steps);
  mark_stale(0);
}

std::uint32_t PoseStack::limb_steps(std::uint32_t number) const {
  const Entry& entry = entries_[require(number, HF_NO_INDEX)];
  return entry.layer > 0 ? 0 : base_->limb_steps(entry.inner[0]);
}

}  // namespace hf_inner::deform
