// Transfers of a surface on itself: pairs that come and go, frames with holds, skins.
#include <algorithm>
#include <cmath>

#include "support/arrays.h"
#include "support/peers.h"
#include "unchanged.h"

namespace unchanged {
namespace {

struct Pair {
  std::uint32_t number, flags;
  std::vector<std::uint32_t> source, target;
};

struct Frame {
  std::vector<double> posed;
  std::vector<std::uint32_t> holds;  // numbers of pairs
  std::vector<double> places;
};

class Transfers final : public Subject {
 public:
  Transfers(World& given, Random& random) : Subject(given) {
    kind_ = random.pick({TRANSFER_FIELDS, TRANSFER_FIELDS, TRANSFER_PAPER, TRANSFER_STRETCH});
    desc_.mode = mode_of(kind_);
    desc_.cluster_count = random.pick({5u, 10u});  // 80 on 80 vertices would rest on one vertex each
    if (create_transfer_with(kind_, world.surface, world.surface, &desc_, &handle_) != HF_OK) handle_ = nullptr;
  }
  ~Transfers() override { hf_transfer_destroy(handle_); }
  bool ready() const { return handle_ != nullptr; }

  void glance(State&) override {}  // readers solve the fields of new pairs
  void look(State& state) override {
    hf_transfer_info info = HF_INIT(hf_transfer_info);
    state.begin("info of a transfer");
    state.add(hf_transfer_get_info(handle_, &info));
    add_struct(state, info);
    hf_transfer_dials dials = HF_INIT(hf_transfer_dials);
    state.begin("dials");
    state.add(hf_transfer_get_dials(handle_, &dials));
    add_struct(state, dials);
    expect(info.pair_count == pairs_.size() || pairs_.empty() || world.desc.memory_limit_mb,
           "the number of pairs is not that of the model");
    for (const Pair& p : pairs_) {
      hf_pair_info pair = HF_INIT(hf_pair_info);
      state.begin("a pair");
      state.add(hf_transfer_get_pair(handle_, p.number, &pair));
      add_struct(state, pair);
    }
    look_at_skin(state);
  }
  std::string compare_fresh() override {
    if (pairs_.empty()) return {};
    std::vector<double> here;
    const hf_result frame = apply(handle_, bent(0.4), here);
    for (const bool batch : {false, true}) {
      std::vector<double> there;
      const hf_result result = frame_of_fresh(batch, there);
      if (result != HF_OK || frame != HF_OK)
        return std::string("a fresh transfer: ") + hf_result_get_name(result == HF_OK ? frame : result);
      if (here != there) return "a fresh transfer differs by " + text(difference(here, there));
    }
    return {};
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct TransferCalls;

  void look_at_skin(State& state) const {
    hf_skin_info skin = HF_INIT(hf_skin_info);
    state.begin("skin of a transfer");
    state.add(hf_transfer_get_skin(handle_, &skin));
    const std::size_t joints = skin.joint_count, vertices = skin.vertex_count;
    std::vector<double> numbers(10 * joints);
    std::vector<std::uint32_t> of(4 * vertices);
    std::vector<float> weights(4 * vertices);
    skin.joint_capacity = skin.joint_count;
    skin.vertex_capacity = skin.vertex_count;
    skin.pivots = numbers.data();
    skin.rotations = skin.pivots + 3 * joints;
    skin.translations = skin.rotations + 4 * joints;
    skin.vertex_joints = of.data();
    skin.vertex_weights = weights.data();
    if (joints > 0) state.add(hf_transfer_get_skin(handle_, &skin));
    state.add(numbers);
    state.add(of);
    state.add(weights);
  }
  // The frame of a fresh transfer that gets the pairs there are, one by one or in one batch.
  hf_result frame_of_fresh(bool batch, std::vector<double>& out) const {
    hf_transfer fresh = nullptr;
    hf_result result = create_transfer_with(kind_, world.surface, world.surface, &desc_, &fresh);
    std::vector<Pair> pairs = pairs_;
    std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.number < b.number; });
    for (const Pair& pair : pairs) {
      if (result == HF_OK && !batch) result = add_to(fresh, {pair}, nullptr);
    }
    if (result == HF_OK && batch) result = add_to(fresh, pairs, nullptr);
    if (result == HF_OK) result = hf_transfer_set_dials(fresh, &dials_);
    if (result == HF_OK) result = make_rigid(fresh, rigid_);
    if (result == HF_OK) result = apply(fresh, bent(0.4), out);
    return hf_transfer_destroy(fresh), result;
  }
  static hf_result make_rigid(hf_transfer transfer, const std::vector<std::uint32_t>& pieces) {
    return hf_transfer_set_rigid_pieces(transfer, static_cast<std::uint32_t>(pieces.size()), pieces.data());
  }
  static hf_result add_to(hf_transfer transfer, const std::vector<Pair>& pairs, std::uint32_t* out,
                          hf_progress progress = nullptr) {
    std::vector<std::uint32_t> counts[2], vertices[2], flags;
    for (const Pair& p : pairs) {
      counts[0].push_back(static_cast<std::uint32_t>(p.source.size()));
      counts[1].push_back(static_cast<std::uint32_t>(p.target.size()));
      vertices[0].insert(vertices[0].end(), p.source.begin(), p.source.end());
      vertices[1].insert(vertices[1].end(), p.target.begin(), p.target.end());
      flags.push_back(p.flags);
    }
    hf_pairs_desc desc = HF_INIT(hf_pairs_desc);
    desc.pair_count = static_cast<std::uint32_t>(pairs.size());
    desc.flags = flags.data();
    desc.source_counts = counts[0].data();
    desc.source_vertices = vertices[0].data();
    desc.target_counts = counts[1].data();
    desc.target_vertices = vertices[1].data();
    desc.progress = progress;
    return hf_transfer_add_pairs(transfer, &desc, out);
  }
  // The surface at rest, bent about its y axis.
  Frame bent(double angle) const {
    Frame frame;
    const std::vector<float>& p = world.shape->positions;
    for (std::size_t v = 0; v + 2 < p.size(); v += 3) {
      const double x = static_cast<double>(p[v]), z = static_cast<double>(p[v + 2]), a = angle * (1 + 0.2 * x);
      frame.posed.push_back(x * std::cos(a) - z * std::sin(a));
      frame.posed.push_back(static_cast<double>(p[v + 1]));
      frame.posed.push_back(x * std::sin(a) + z * std::cos(a));
    }
    return frame;
  }
  hf_result apply(hf_transfer transfer, const Frame& given, std::vector<double>& out) const {
    out.assign(given.posed.size(), 0.0);
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(given.posed.data(), given.posed.size() / 3);
    frame.target_positions = ROWS_OUT(out.data());
    frame.hold_count = static_cast<std::uint32_t>(given.holds.size());
    frame.hold_pairs = given.holds.data();
    frame.hold_positions = given.places.data();
    return hf_transfer_apply(transfer, &frame);
  }
  std::uint32_t number(Random& random) const {
    if (pairs_.empty() || random.one_in(15)) return random.below(20);
    return pairs_[random.below(static_cast<std::uint32_t>(pairs_.size()))].number;
  }

  hf_transfer_desc desc_ = HF_INIT(hf_transfer_desc);
  std::int32_t kind_ = TRANSFER_FIELDS;
  hf_transfer handle_ = nullptr;
  hf_transfer_dials dials_ = HF_INIT(hf_transfer_dials);
  std::vector<std::uint32_t> rigid_;
  std::vector<Pair> pairs_;
};

struct TransferCalls {
  static Transfers& of(Subject& s) { return static_cast<Transfers&>(s); }

  static hf_result add(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    std::vector<Pair> fresh(1 + random.below(3));
    std::vector<std::uint32_t> out(fresh.size());
    const std::uint32_t n = s.world.shape->vertices();
    for (Pair& p : fresh) {
      p.flags = random.pick({0u, 0u, 1u, 2u, 5u, 16u, 5u | 64u, 384u, random.one_in(9) ? 512u : 8u});
      const std::uint32_t first = random.below(n), size = 1 + random.below(4);
      for (std::uint32_t k = 0; k < size; ++k) p.source.push_back(random.one_in(60) ? n : (first + k) % n);
      p.target = p.source;
      if (random.one_in(30)) p.target.back() = random.below(n + 1);
    }
    const hf_result result = Transfers::add_to(s.handle_, fresh, out.data(), s.world.progress());
    if (result != HF_OK) return result;
    for (std::size_t i = 0; i < out.size(); ++i) {
      fresh[i].number = out[i];
      s.pairs_.push_back(fresh[i]);
    }
    return result;
  }
  static hf_result remove(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    std::vector<std::uint32_t> list(1 + random.below(2));
    for (std::uint32_t& n : list) n = s.number(random);
    const hf_result result = hf_transfer_remove_pairs(s.handle_, static_cast<std::uint32_t>(list.size()), list.data());
    if (result != HF_OK) return result;
    const auto gone = [&](const Pair& p) { return std::find(list.begin(), list.end(), p.number) != list.end(); };
    s.pairs_.erase(std::remove_if(s.pairs_.begin(), s.pairs_.end(), gone), s.pairs_.end());
    return result;
  }
  static hf_result frame(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    Frame frame = s.bent(random.real(-1, 1));
    if (random.one_in(10)) frame.posed[random.below(static_cast<std::uint32_t>(frame.posed.size()))] = random.number();
    for (std::uint32_t i = random.one_in(3) ? 1 + random.below(2) : 0; i > 0; --i) {
      frame.holds.push_back(s.number(random));
      for (int k = 0; k < 3; ++k) frame.places.push_back(random.number());
    }
    std::vector<float> normals(frame.posed.size());
    std::vector<double> out(frame.posed.size());
    hf_transfer_frame desc = HF_INIT(hf_transfer_frame);
    desc.source_positions = HF_ARRAY(frame.posed.data(), frame.posed.size() / 3);
    desc.target_positions = ROWS_OUT(out.data());
    desc.hold_count = static_cast<std::uint32_t>(frame.holds.size());
    desc.hold_pairs = frame.holds.data();
    desc.hold_positions = frame.places.data();
    if (random.one_in(3)) desc.target_normals = ROWS_OUT(normals.data());
    if (random.one_in(20)) desc.source_positions.stride = 5;
    return hf_transfer_apply(s.handle_, random.spoiled(desc));
  }
  static hf_result dials(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    hf_transfer_dials dials = HF_INIT(hf_transfer_dials);
    const auto value = [&](double low, double high) {
      return static_cast<float>(random.one_in(12) ? random.number() : random.real(low, high));
    };
    if (random.one_in(2)) dials.stride = value(0.1, 4);
    if (random.one_in(2)) dials.hip_height_share = value(-0.5, 0.5);
    if (random.one_in(2)) {
      dials.neck_follow = value(-1, 1);
      dials.tail_follow = value(-1, 1);
    }
    if (random.one_in(2)) dials.arm_space = value(-1.5, 1.5);
    if (random.one_in(2)) dials.long_follow = value(0, 1);
    const hf_transfer_dials* given = random.spoiled(dials);
    const hf_result result = hf_transfer_set_dials(s.handle_, given);
    if (result == HF_OK) s.dials_ = given ? dials : HF_INIT(hf_transfer_dials);  // NULL: neutral ones
    return result;
  }
  static hf_result rigid(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    std::vector<std::uint32_t> pieces(random.below(3));
    for (std::uint32_t& v : pieces) v = random.index(s.world.shape->vertices());
    const hf_result result = Transfers::make_rigid(s.handle_, pieces);
    if (result == HF_OK) s.rigid_ = pieces;
    return result;
  }
  static hf_result make(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
    const std::int32_t kind = random.pick({TRANSFER_FIELDS, TRANSFER_PAPER});
    desc.mode = random.pick({0, 1, 2});
    desc.cluster_count = random.pick({0u, 512u, 513u});
    desc.kernel_width = random.number();
    desc.scale = random.number();
    hf_transfer made = s.handle_;
    const hf_result result = create_transfer_with(kind, s.world.surface, s.world.surface, random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused transfer is no NULL");
    return hf_transfer_destroy(made), result;
  }
  static hf_result read(Subject& subject, Random& random) {
    Transfers& s = of(subject);
    hf_transfer_info info = HF_INIT(hf_transfer_info);
    hf_pair_info pair = HF_INIT(hf_pair_info);
    hf_skin_info skin = HF_INIT(hf_skin_info);
    if (random.one_in(3)) return hf_transfer_get_info(s.handle_, random.spoiled(info));
    if (random.one_in(2)) return hf_transfer_get_pair(s.handle_, s.number(random), random.spoiled(pair));
    skin.influence_count = random.pick({0u, 4u, 5u});
    return hf_transfer_get_skin(s.handle_, random.spoiled(skin));
  }
};

const std::vector<Command>& Transfers::commands() const {
  static const std::vector<Command> table = {
      {"hf_transfer_add_pairs", 8, TransferCalls::add},   {"hf_transfer_remove_pairs", 3, TransferCalls::remove},
      {"hf_transfer_set_dials", 3, TransferCalls::dials}, {"hf_transfer_set_rigid_pieces", 2, TransferCalls::rigid},
      {"hf_transfer_apply", 10, TransferCalls::frame},    {"hf_transfer_create", 2, TransferCalls::make},
      {"reading a transfer", 4, TransferCalls::read},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_transfers(World& world, Random& random) {
  auto made = std::make_unique<Transfers>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
