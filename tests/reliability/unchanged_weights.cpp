// Skin weights: joints that move, come and go, pins, locks, clones, transferred and mirrored weights.
#include "unchanged_weights.h"

#include <cmath>

namespace unchanged {

hf_joints_desc BoneList::desc() const {
  hf_joints_desc out = HF_INIT(hf_joints_desc);
  out.joint_count = count();
  out.heads = heads.data();
  out.parents = parents.data();
  out.deforms = deforms.data();
  if (!tails.empty()) out.tails = tails.data();
  if (!axes.empty()) out.axes = axes.data();
  return out;
}

hf_pins_desc PinList::desc() const {
  hf_pins_desc out = HF_INIT(hf_pins_desc);
  out.pin_count = count();
  out.influence_count = joint_count;
  out.radii = radii.data();
  if (!vertices.empty()) out.vertices = vertices.data();
  if (!places.empty()) out.places = places.data();
  out.joints = joints.data();
  out.weights = weights.data();
  return out;
}

void WeightsModel::take_bones(const BoneList& list, const std::vector<std::uint32_t>& sources) {
  std::vector<std::uint32_t> now(bones.count(), HF_NO_INDEX);
  for (std::uint32_t b = 0; b < list.count(); ++b) {
    const std::uint32_t source = sources.empty() ? b : sources[b];
    if (source < now.size()) now[source] = b;
  }
  rounded = rounded || quotients;
  for (std::size_t i = 0; i < pins.joints.size(); ++i) {
    const std::uint32_t bone = now[pins.joints[i]];
    quotients = quotients || (bone == HF_NO_INDEX && pins.weights[i] > 0);
    if (bone == HF_NO_INDEX) pins.weights[i] = 0;
    pins.joints[i] = bone == HF_NO_INDEX ? 0 : bone;
  }
  std::vector<std::uint32_t> left;
  std::vector<float> values;
  for (const std::uint32_t lock : locks) {
    if (now[lock] != HF_NO_INDEX) left.push_back(now[lock]);
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (now[locks[i % locks.size()]] != HF_NO_INDEX) values.push_back(kept[i]);
  }
  bones = list;
  locks = left;
  kept = values;
}

SkinWeights::SkinWeights(World& given, Random& random) : Subject(given) {
  influence_count_ = random.pick({0u, 4u, 8u});
  hf_result result = HF_ERROR_INTERNAL;
  WeightsKnown first;
  hf_weights made = nullptr;
  for (int i = 0; i < 50 && result != HF_OK; ++i) {  // some bones are refused
    first.model.bones = bones(2 + random.below(4), random);
    const hf_joints_desc desc = first.model.bones.desc();
    result = hf_weights_create(world.surface, &desc, influence_count_, &made);
  }
  if (result != HF_OK) return;
  first.seen = seen_of(made);
  branches_.emplace_back(made, first);
}

void SkinWeights::glance(State& state) {
  for (const WeightsBranch& b : branches_) {
    hf_weights_info info = HF_INIT(hf_weights_info);
    state.begin("info of weights");
    state.add(hf_weights_get_info(b.handle, &info));
    add_struct(state, info);
    expect(info.joint_count == b.model.bones.count() && info.pin_count == b.model.pins.count() &&
               info.lock_count == b.model.locks.size(),
           "the counts of bones, pins or locks are not those of the model");
  }
}

void SkinWeights::look(State& state) {
  for (const WeightsBranch& b : branches_) {
    look_at_weights(b, state);
    const std::uint32_t count = b.model.bones.count();
    std::vector<std::uint32_t> flags(count), informed(count), reasons(count);
    state.begin("bones of weights");
    state.add(hf_weights_get_joints(b.handle, count, flags.data(), informed.data(), nullptr));
    state.add(flags);
    state.add(informed);
    state.begin("helper bones");
    state.add(hf_weights_get_helpers(b.handle, nullptr, count, reasons.data(), nullptr));
    state.add(reasons);
  }
}

void SkinWeights::look_at_weights(const WeightsBranch& b, State& state) const {
  const WeightsSeen seen = seen_of(b.handle);
  state.begin("weights");
  state.add(seen.joints);
  state.add(seen.weights);
  state.add(seen.origins);
}

std::string SkinWeights::compare_fresh() {
  for (const WeightsBranch& b : branches_) {
    const std::string fault = compare_fresh(b);
    if (!fault.empty()) return fault;
  }
  return {};
}

// The same bits, but for pins whose shares were rounded twice: those agree to a millionth.
std::string SkinWeights::compare_fresh(const WeightsBranch& b) const {
  const WeightsModel& m = b.model;
  hf_weights fresh = nullptr;
  const hf_joints_desc bones = m.bones.desc();
  const hf_pins_desc pins = m.pins.desc();
  hf_result result = hf_weights_create(world.surface, &bones, influence_count_, &fresh);
  if (result == HF_OK && m.pins.count() > 0) result = hf_weights_set_pins(fresh, &pins);
  if (result == HF_OK && !m.locks.empty())
    result = hf_weights_set_locks(fresh, static_cast<std::uint32_t>(m.locks.size()), m.locks.data(), m.kept.data());
  const WeightsSeen here = seen_of(b.handle), there = seen_of(fresh);
  hf_weights_destroy(fresh);
  if (result != HF_OK) return std::string("fresh weights: ") + hf_result_get_name(result);
  if (here == there) return {};
  const auto by_bone = [&](const WeightsSeen& seen) {
    std::vector<double> all(std::size_t{world.shape->vertices()} * m.bones.count());
    for (std::size_t i = 0; i < seen.joints.size(); ++i)
      all[i / influences() * m.bones.count() + seen.joints[i]] += static_cast<double>(seen.weights[i]);
    return all;
  };
  const double off = difference(by_bone(here), by_bone(there));
  return m.rounded && off <= 1e-6 ? "" : "fresh weights differ by " + text(off);
}

WeightsSeen SkinWeights::seen_of(hf_weights handle) const {
  const std::size_t vertices = world.shape->vertices(), count = vertices * influences();
  WeightsSeen seen{std::vector<std::uint32_t>(count), std::vector<float>(count), std::vector<std::uint8_t>(vertices)};
  hf_weights_out out = HF_INIT(hf_weights_out);
  out.vertex_capacity = world.shape->vertices();
  out.joints = seen.joints.data();
  out.weights = seen.weights.data();
  out.origins = seen.origins.data();
  return hf_weights_get(handle, &out) == HF_OK ? seen : WeightsSeen{};
}

// Bones from vertex to vertex, nearly.
BoneList SkinWeights::bones(std::uint32_t count, Random& random) const {
  BoneList list;
  const std::vector<float>& at = world.shape->positions;
  const auto place = [&](std::vector<double>& out) {
    const std::uint32_t v = random.below(world.shape->vertices());
    for (std::size_t k = 0; k < 3; ++k) out.push_back(static_cast<double>(at[3 * v + k]) + random.real(-0.5, 0.5));
    if (random.one_in(60)) out.back() = random.number();
  };
  const std::uint32_t form = random.below(3);  // tails, axes, or neither
  for (std::uint32_t b = 0; b < count; ++b) {
    place(list.heads);
    if (form == 0) place(list.tails);
    for (int k = 0; form == 1 && k < 3; ++k) list.axes.push_back(random.number());
    list.parents.push_back(b == 0 || random.one_in(4) ? HF_NO_INDEX : random.below(b));
    if (random.one_in(60)) list.parents.back() = random.index(count);
    list.deforms.push_back(random.one_in(60) ? 2 : !random.one_in(8));
  }
  return list;
}

PinList SkinWeights::pins(std::uint32_t count, std::uint32_t bones, Random& random) const {
  PinList list;
  const bool inside = random.one_in(3);
  list.joint_count = 1 + random.below(random.one_in(8) ? 9 : 3);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t a = random.below(5), b = random.below(5 - a);
    if (inside) {
      const std::uint32_t triangle = random.index(world.shape->count());
      double weights[3] = {a / 4.0, b / 4.0, (4 - a - b) / 4.0};
      if (random.one_in(30)) weights[2] += random.pick({0.5, -1.0});
      list.places.push_back(place_in(world.shape->triangles.data(), world.shape->count(), triangle, weights));
    } else {
      list.vertices.push_back(random.index(world.shape->vertices()));
    }
    list.radii.push_back(random.one_in(4) ? random.pick({0.0, 0.8, 1.5, random.number()}) : 0.0);
    std::vector<float> eighths(list.joint_count, 0.0f);
    for (int k = 0; k < 8; ++k) eighths[random.below(list.joint_count)] += 0.125f;
    for (const float weight : eighths) {
      list.joints.push_back(random.index(bones));
      list.weights.push_back(random.one_in(60) ? static_cast<float>(random.number()) : weight);
    }
  }
  return list;
}

std::unique_ptr<Subject> make_weights(World& world, Random& random) {
  auto made = std::make_unique<SkinWeights>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
