// The calls on skin weights.
#include <algorithm>

#include "unchanged_weights.h"

namespace unchanged {

struct WeightsCalls {
  static SkinWeights& of(Subject& s) { return static_cast<SkinWeights&>(s); }

  static hf_result bones(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    WeightsBranch& b = s.any(random);
    const std::uint32_t before = b.model.bones.count();
    BoneList list = s.bones(random.one_in(3) ? 1 + random.below(6) : before, random);
    if (random.one_in(6)) list = b.model.bones;  // the same again
    std::vector<std::uint32_t> sources, left(before);
    for (std::uint32_t i = 0; i < before; ++i) left[i] = i;
    for (std::uint32_t i = 0; i < list.count(); ++i) {
      const std::size_t k = random.below(static_cast<std::uint32_t>(left.size()) + 1);
      const bool fresh = k >= left.size();
      sources.push_back(random.one_in(40) ? random.index(before) : fresh ? HF_NO_INDEX : left[k]);
      if (!fresh) left.erase(left.begin() + static_cast<std::ptrdiff_t>(k));
    }
    if (random.one_in(2)) sources.clear();
    hf_joints_desc desc = list.desc();
    if (!sources.empty()) desc.sources = sources.data();
    desc.progress = s.world.progress();
    const hf_result result = hf_weights_set_joints(b.handle, random.spoiled(desc));
    if (result == HF_OK) {
      b.model.take_bones(list, sources);
      s.changed(b);
    }
    return result;
  }
  static hf_result pins(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    WeightsBranch& b = s.any(random);
    PinList list = s.pins(random.below(5), b.model.bones.count(), random);
    if (random.one_in(4)) {  // the same places with other weights
      PinList old = b.model.pins;
      for (std::size_t i = 0; i < old.weights.size() && i < list.weights.size(); ++i) {
        old.joints[i] = list.joints[i];
        old.weights[i] = list.weights[i];
      }
      list = old;
    }
    hf_pins_desc desc = list.desc();
    desc.progress = s.world.progress();
    desc.reserved = random.one_in(40);
    const hf_result result = hf_weights_set_pins(b.handle, random.spoiled(desc));
    if (result != HF_OK) return result;
    b.model.pins = list;
    b.model.rounded = false;
    const auto eighth = [](float w) { return w * 8 == static_cast<float>(static_cast<int>(w * 8)); };
    b.model.quotients = !std::all_of(list.weights.begin(), list.weights.end(), eighth);
    for (std::size_t i = 0; i < list.weights.size(); i += list.joint_count) {
      float sum = 0;
      for (std::size_t k = i; k < i + list.joint_count; ++k) sum += list.weights[k];
      b.model.quotients = b.model.quotients || sum != 1.0f;
    }
    return s.changed(b), result;
  }
  static hf_result locks(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    WeightsBranch& b = s.any(random);
    std::vector<std::uint32_t> list;
    for (std::uint32_t i = 0; i < b.model.bones.count(); ++i) {
      if (random.one_in(3)) list.push_back(random.one_in(12) ? random.index(b.model.bones.count()) : i);
    }
    const std::size_t vertices = s.world.shape->vertices(), k = s.influences(), m = list.size();
    std::vector<float> values(vertices * m);
    const bool given = random.one_in(2);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (given) values[i] = static_cast<float>(random.real(0, 1));
      for (std::size_t j = 0; !given && j < k; ++j) {  // what a call without values keeps
        const std::size_t at = i / m * k + j;
        if (b.seen.joints[at] == list[i % m]) values[i] += b.seen.weights[at];
      }
    }
    if (given && m > 0 && random.one_in(6)) values[random.below(static_cast<std::uint32_t>(values.size()))] = 1.5f;
    const std::uint32_t count = random.one_in(40) ? 40 : static_cast<std::uint32_t>(m);
    const hf_result result = hf_weights_set_locks(b.handle, count, list.data(), given ? values.data() : nullptr);
    if (result == HF_OK) {
      b.model.locks = list;
      b.model.kept = values;
      s.changed(b);
    }
    return result;
  }
  static hf_result clone(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    return s.Subject::clone(s.branches_, random, hf_weights_clone, [&](const auto& b) { return s.bits_of(b); });
  }
  static hf_result go_back(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    return s.Subject::go_back(s.branches_, random, [&](const auto& b) { return s.bits_of(b); });
  }
  static hf_result make(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    const BoneList list = s.bones(random.below(6), random);
    hf_joints_desc desc = list.desc();
    desc.progress = s.world.progress();
    hf_weights made = s.branches_[0].handle;
    const hf_result result =
        hf_weights_create(s.world.surface, random.spoiled(desc), random.pick({0u, 4u, 8u, 5u}), &made);
    if (result != HF_OK) s.expect(made == nullptr, "refused weights are no NULL");
    return hf_weights_destroy(made), result;
  }
  static hf_result destroy(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    if (s.branches_.size() < 2) return skipped;
    const std::size_t i = random.below(static_cast<std::uint32_t>(s.branches_.size()));
    s.branches_.erase(s.branches_.begin() + static_cast<std::ptrdiff_t>(i));
    return HF_OK;
  }
  static hf_result read(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    const WeightsBranch& b = s.any(random);
    const std::uint32_t count = b.model.bones.count();
    std::vector<std::uint32_t> list(count + 1);
    std::string names;
    for (std::uint32_t i = random.one_in(5); i < count; ++i) names += random.one_in(2) ? "root\n" : "arm_end.L\n";
    const std::uint32_t capacity = random.one_in(5) ? count - 1 : count;
    switch (random.below(3)) {
      case 0:
        return hf_weights_get_joints(b.handle, capacity, list.data(), nullptr, nullptr);
      case 1:
        return hf_weights_get_helpers(b.handle, names.c_str(), capacity, list.data(), nullptr);
      default: {
        hf_weights_out out = HF_INIT(hf_weights_out);
        std::vector<std::uint16_t> joints(s.influences() * std::size_t{s.world.shape->vertices()});
        out.vertex_capacity = s.world.shape->vertices() - random.one_in(5);
        out.joints_u16 = joints.data();
        return hf_weights_get(b.handle, random.spoiled(out));
      }
    }
  }

  // Arrays for carried and mirrored weights. A refused call leaves them at their mark.
  struct Out {
    std::vector<std::uint32_t> joints;
    std::vector<float> weights;
    hf_weights_out desc = HF_INIT(hf_weights_out);
    Out(const SkinWeights& s, Random& random)
        : joints(8 * std::size_t{s.world.shape->vertices()}, 77), weights(joints.size(), 77.0f) {
      desc.vertex_capacity = s.world.shape->vertices() - random.one_in(20);
      desc.joints = joints.data();
      desc.weights = weights.data();
    }
    bool untouched() const {
      return std::all_of(joints.begin(), joints.end(), [](std::uint32_t j) { return j == 77; }) &&
             std::all_of(weights.begin(), weights.end(), [](float w) { return w == 77.0f; });
    }
  };
  // The weights of a branch, some of them taken away or damaged.
  static WeightsSeen holes(const SkinWeights& s, const WeightsBranch& b, Random& random) {
    WeightsSeen given = b.seen;
    const std::size_t k = s.influences();
    for (std::size_t v = 0; v < s.world.shape->vertices(); ++v) {
      if (random.one_in(4)) std::fill_n(given.weights.begin() + static_cast<std::ptrdiff_t>(v * k), k, 0.0f);
    }
    const auto at = [&] { return random.below(static_cast<std::uint32_t>(given.weights.size())); };
    if (random.one_in(20)) given.weights[at()] = static_cast<float>(random.number());
    if (random.one_in(20)) given.joints[at()] = random.index(b.model.bones.count());
    return given;
  }
  template <class Desc>
  static void fill(SkinWeights& s, Desc& desc, const WeightsSeen& given, Random& random) {
    desc.source_influence_count = s.influences();
    desc.joints = given.joints.data();
    desc.weights = given.weights.data();
    desc.distance = random.pick({0.0, 0.0, 0.5, 2.0, random.number()});
    desc.angle = random.pick({0.0, 0.0, 1.0, 3.15, random.number()});
    desc.influence_count = random.one_in(20) ? 5 : random.pick({0u, 4u, 8u});
    desc.progress = s.world.progress();
  }
  static hf_result carry(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    const WeightsSeen given = holes(s, s.any(random), random);
    hf_weights_transfer_desc desc = HF_INIT(hf_weights_transfer_desc);
    fill(s, desc, given, random);
    hf_weights_transfer_info info = HF_INIT(hf_weights_transfer_info);
    Out out(s, random);
    const hf_result result =
        hf_weights_transfer(s.world.surface, s.world.surface, random.spoiled(desc), random.spoiled(out.desc), &info);
    s.expect(result == HF_OK || out.untouched(), "refused, but weights were written");
    return result;
  }
  static hf_result mirror(Subject& subject, Random& random) {
    SkinWeights& s = of(subject);
    const WeightsBranch& b = s.any(random);
    const WeightsSeen given = holes(s, b, random);
    hf_weights_mirror_desc desc = HF_INIT(hf_weights_mirror_desc);
    fill(s, desc, given, random);
    const std::uint32_t count = b.model.bones.count();
    std::vector<std::uint32_t> partners(count, HF_NO_INDEX), found(count, 77), pairings(count, 77);
    for (std::uint32_t& p : partners) p = random.one_in(12) ? random.index(count) : HF_NO_INDEX;
    std::string names;
    for (std::uint32_t i = random.one_in(20); i < count; ++i) names += i % 2 ? "arm.L\n" : "arm.R\n";
    const double plane[6] = {random.number(), 0, 0, random.number(), random.pick({0.0, 0.3}), 0};
    desc.joint_count = count;
    desc.heads = b.model.bones.heads.data();
    desc.to = random.pick({0, 1, 2, 2, 3});
    if (random.one_in(3)) desc.partners = partners.data();
    if (random.one_in(2)) desc.names = names.c_str();
    if (!random.one_in(3)) desc.plane = plane;
    hf_weights_mirror_info info = HF_INIT(hf_weights_mirror_info);
    Out out(s, random);
    const hf_result result = hf_weights_mirror(s.world.surface, random.spoiled(desc), random.spoiled(out.desc),
                                               found.data(), pairings.data(), &info, nullptr);
    const bool pairs = std::any_of(found.begin(), found.end(), [](std::uint32_t f) { return f != 77; });
    s.expect(result == HF_OK || (out.untouched() && !pairs), "refused, but weights or partners were written");
    return result;
  }
};

const std::vector<Command>& SkinWeights::commands() const {
  static const std::vector<Command> table = {
      {"hf_weights_set_joints", 8, WeightsCalls::bones}, {"hf_weights_set_pins", 10, WeightsCalls::pins},
      {"hf_weights_set_locks", 6, WeightsCalls::locks},  {"hf_weights_clone", 5, WeightsCalls::clone},
      {"back to a clone", 5, WeightsCalls::go_back},     {"hf_weights_create", 3, WeightsCalls::make},
      {"hf_weights_destroy", 1, WeightsCalls::destroy},  {"reading weights", 2, WeightsCalls::read},
      {"hf_weights_transfer", 4, WeightsCalls::carry},   {"hf_weights_mirror", 4, WeightsCalls::mirror},
  };
  return table;
}

}  // namespace unchanged
