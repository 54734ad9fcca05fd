#include "weights/weights.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/unit_weights.h"

namespace hf_inner::weights {

Weights::Weights(std::shared_ptr<const SkinSurface> surface, std::int32_t influences, const Bones& bones)
    : surface_(std::move(surface)), influences_(influences) {
  const auto inputs = make_shared_in<WeightInputs>(memory(), memory());
  inputs->bones = Bones(bones, memory());
  apply(inputs);
}

Weights::Weights(const Weights& other)
    : surface_(other.surface_), influences_(other.influences_), state_(other.state_) {}

void Weights::apply(const Inputs& inputs) { state_ = compute(inputs); }

void Weights::set_joints(const Bones& bones, Span<const Index> sources) {
  const WeightInputs& present = *state_->inputs;
  const auto next = make_shared_in<WeightInputs>(memory(), memory());
  next->bones = Bones(bones, memory());
  Vector<Index> now(present.bones.head.size(), -1, &memory());
  for (Index b = 0; b < bones.count(); ++b) {
    const Index source = sources.empty() ? b : sources[at(b)];
    if (source >= 0 && at(source) < now.size()) now[at(source)] = b;
  }
  const Pins& pins = present.pins;
  next->pins.places = pins.places;
  next->pins.radius = pins.radius;
  for (std::size_t p = 0; p < pins.count(); ++p) {
    double sum = 0;
    for (Index i = pins.start[p]; i < pins.start[p + 1]; ++i) {
      if (now[at(pins.bone[at(i)])] >= 0) sum += pins.share[at(i)];
    }
    if (!(sum > 0))
      fail(HF_ERROR_CONFLICT, static_cast<std::uint32_t>(p),
           "pin %zu has weights on removed joints only; change the pin first", p);
    for (Index i = pins.start[p]; i < pins.start[p + 1]; ++i) {
      const Index bone = now[at(pins.bone[at(i)])];
      if (bone >= 0) {
        next->pins.bone.push_back(bone);
        next->pins.share.push_back(pins.share[at(i)] / sum);
      }
    }
    next->pins.start.push_back(static_cast<Index>(next->pins.bone.size()));
  }
  if (present.locks) {
    const std::size_t old = present.locks->bones.size(), n = at(surface_->core->size());
    const auto locks = make_shared_in<Locks>(memory(), memory());
    Vector<std::size_t> from(&memory());
    for (std::size_t i = 0; i < old; ++i) {
      const Index bone = now[at(present.locks->bones[i])];
      if (bone >= 0) {
        locks->bones.push_back(bone);
        from.push_back(i);
      }
    }
    locks->units.reserve(n * from.size());
    for (std::size_t v = 0; v < n; ++v) {
      for (const std::size_t i : from) locks->units.push_back(present.locks->units[v * old + i]);
    }
    if (!from.empty()) next->locks = locks;
  }
  apply(next);
}

void Weights::set_pins(const Pins& pins) {
  const auto next = make_shared_in<WeightInputs>(memory(), *state_->inputs, memory());
  next->pins = Pins(pins, memory());
  apply(next);
}

void Weights::set_locks(Span<const Index> bones, const float* values) {
  const auto next = make_shared_in<WeightInputs>(memory(), *state_->inputs, memory());
  next->locks.reset();
  if (!bones.empty()) {
    const std::size_t n = at(surface_->core->size()), m = bones.size(), k = at(influences_);
    const auto locks = make_shared_in<Locks>(memory(), memory());
    locks->bones.assign(bones.begin(), bones.end());
    locks->units.assign(n * m, 0.0f);
    for (std::size_t v = 0; v < n; ++v) {
      for (std::size_t i = 0; i < m; ++i) {
        double weight = values ? static_cast<double>(values[v * m + i]) : 0.0;
        for (std::size_t j = 0; !values && j < k; ++j) {
          if (state_->joints[v * k + j] == static_cast<std::uint32_t>(bones[i]))
            weight += static_cast<double>(state_->weights[v * k + j]);
        }
        locks->units[v * m + i] = static_cast<float>(std::floor(weight_units * std::min(weight, 1.0)));
      }
    }
    next->locks = locks;
  }
  apply(next);
}

}  // namespace hf_inner::weights
