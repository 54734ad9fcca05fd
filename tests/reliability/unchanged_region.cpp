// Regions: curves, rings and lists of vertices, clones, and detail carried from one to another.
#include <cmath>

#include "unchanged.h"

namespace unchanged {
namespace {

using RegionBranch = Clonable<hf_region, hf_region_destroy, Nothing>;

class Regions final : public Subject {
 public:
  Regions(World& given, Random& random) : Subject(given) {
    desc_.base = random.pick({0, 1, 1, 2, 3});
    hf_region made = nullptr;
    if (hf_region_create(world.surface, &desc_, &made) == HF_OK) branches_.emplace_back(made, Nothing());
  }
  ~Regions() override {
    for (const hf_detail detail : details_) hf_detail_destroy(detail);
  }
  bool ready() const { return !branches_.empty(); }

  void glance(State& state) override {
    for (const RegionBranch& b : branches_) {
      hf_region_info info = HF_INIT(hf_region_info);
      state.begin("info of a region");
      state.add(hf_region_get_info(b.handle, &info));
      add_struct(state, info);
    }
  }
  void look(State& state) override {
    for (const RegionBranch& b : branches_) {
      for (std::int32_t list = 0; list < 3; ++list) {
        state.begin("vertices of a region");
        state.add(vertices_of(b, list));
      }
      std::uint32_t corners = 0;
      state.begin("curve of a region");
      state.add(hf_region_get_curve(b.handle, 0, nullptr, &corners));
      state.add(corners);
      std::vector<double> curve(3 * std::size_t{corners});
      if (corners > 0) hf_region_get_curve(b.handle, corners, curve.data(), &corners);
      for (const double x : curve) state.add(x);
      look_at_base(b, state);
    }
    for (const hf_detail detail : details_) {
      std::vector<double> positions(3 * world.shape->vertices());
      hf_morph_desc morph = HF_INIT(hf_morph_desc);
      morph.weight = 0.75;
      morph.positions_f64 = positions.data();
      state.begin("detail");
      state.add(hf_detail_morph(detail, &morph));
      state.add(positions);
    }
  }
  std::string compare_fresh() override {
    for (const RegionBranch& b : branches_) {
      const std::vector<std::uint32_t> inside = vertices_of(b, HF_REGION_INSIDE);
      if (inside.empty()) continue;
      hf_region made = nullptr;
      hf_result result = hf_region_create(world.surface, &desc_, &made);
      const RegionBranch fresh(made, Nothing());
      hf_region_edit_desc edit = HF_INIT(hf_region_edit_desc);
      edit.add_count = static_cast<std::uint32_t>(inside.size());
      edit.add_vertices = inside.data();
      if (result == HF_OK) result = hf_region_edit(fresh.handle, &edit);
      const std::vector<double> here = base_of(b), there = base_of(fresh);
      const bool same = vertices_of(fresh, HF_REGION_SITES) == vertices_of(b, HF_REGION_SITES);
      if (result != HF_OK) return std::string("a fresh region: ") + hf_result_get_name(result);
      const double off = difference(here, there);
      if (!(off <= 1e-9) || !same) return "a fresh region differs by " + text(off);
    }
    return {};
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct RegionCalls;
  RegionBranch& any(Random& random) { return branches_[random.below(static_cast<std::uint32_t>(branches_.size()))]; }
  std::vector<std::uint32_t> vertices_of(const RegionBranch& b, std::int32_t list) const {
    std::uint32_t count = 0;
    hf_region_get_vertices(b.handle, list, 0, nullptr, &count);
    std::vector<std::uint32_t> vertices(count);
    hf_region_get_vertices(b.handle, list, count, vertices.data(), &count);
    return vertices;
  }
  std::vector<double> base_of(const RegionBranch& b) const {
    std::vector<double> positions(3 * world.shape->vertices());
    hf_morph_desc morph = HF_INIT(hf_morph_desc);
    morph.weight = 1;
    morph.positions_f64 = positions.data();
    return hf_region_morph(b.handle, &morph) == HF_OK ? positions : std::vector<double>{NAN};
  }
  std::uint64_t look_at_base(const RegionBranch& b, State& state) const {
    std::vector<double> positions(3 * world.shape->vertices());
    std::vector<float> normals(positions.size());
    hf_morph_desc morph = HF_INIT(hf_morph_desc);
    morph.weight = 1;
    morph.positions_f64 = positions.data();
    morph.normals = normals.data();
    state.begin("base of a region");
    state.add(hf_region_morph(b.handle, &morph));
    state.add(positions);
    state.add(normals);
    return state.last();
  }
  std::uint64_t base_hash(const RegionBranch& b) {
    world.memory.disarm();
    State state;
    return look_at_base(b, state);
  }
  std::vector<std::uint32_t> vertices(std::size_t count, Random& random) const {
    std::vector<std::uint32_t> list(count);
    for (std::uint32_t& v : list) v = random.index(world.shape->vertices());
    return list;
  }

  hf_region_desc desc_ = HF_INIT(hf_region_desc);
  std::vector<RegionBranch> branches_;
  std::vector<hf_detail> details_;
};

struct RegionCalls {
  static Regions& of(Subject& s) { return static_cast<Regions&>(s); }

  static hf_result edit(Subject& subject, Random& random) {
    Regions& s = of(subject);
    RegionBranch& b = s.any(random);
    const std::vector<std::uint32_t> gone = s.vertices(1 + random.below(4), random),
                                     come = s.vertices(1 + random.below(6), random),
                                     points = s.vertices(2 + random.below(5), random);
    std::vector<hf_place> inside;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Shape& shape = *s.world.shape;
      const std::uint32_t triangle = random.index(shape.count());
      double weights[3] = {0, 0, 0};
      weights[random.below(3)] = 1;
      inside.push_back(place_in(shape.triangles.data(), shape.count(), triangle, weights));
    }
    hf_curve_desc curve = HF_INIT(hf_curve_desc);
    curve.point_count = static_cast<std::uint32_t>(points.size());
    curve.side = random.pick({0, 0, 1, 2, 3});
    curve.kind = random.pick({0, 0, 1, 1, 2});
    curve.reserved = random.one_in(20);
    curve.seed_vertex = random.index(s.world.shape->vertices());
    if (random.one_in(3))
      curve.places = inside.data();
    else
      curve.vertices = points.data();
    hf_region_edit_desc desc = HF_INIT(hf_region_edit_desc);
    if (random.one_in(4)) desc.curve = random.spoiled(curve);
    desc.ring_count = random.pick({0, 0, 1, -1, 2, -40});
    if (random.one_in(3)) desc.remove_count = static_cast<std::uint32_t>(gone.size());
    if (random.one_in(2)) desc.add_count = static_cast<std::uint32_t>(come.size());
    desc.remove_vertices = gone.data();
    desc.add_vertices = come.data();
    desc.progress = s.world.progress();
    return hf_region_edit(b.handle, random.spoiled(desc));
  }
  static hf_result clone(Subject& subject, Random& random) {
    Regions& s = of(subject);
    return s.Subject::clone(s.branches_, random, hf_region_clone, [&](const auto& b) { return s.base_hash(b); });
  }
  static hf_result go_back(Subject& subject, Random& random) {
    Regions& s = of(subject);
    return s.Subject::go_back(s.branches_, random, [&](const auto& b) { return s.base_hash(b); });
  }
  static hf_result make(Subject& subject, Random& random) {
    Regions& s = of(subject);
    std::vector<double> positions(3 * s.world.shape->vertices());
    for (double& p : positions) p = random.real(-1, 1);
    if (random.one_in(4)) positions[random.below(static_cast<std::uint32_t>(positions.size()))] = random.number();
    hf_region_desc desc = HF_INIT(hf_region_desc);
    desc.base = random.pick({0, 1, 2, 3, 4});
    desc.progress = s.world.progress();
    desc.reserved = random.one_in(20);
    if (random.one_in(2)) desc.positions_f64 = positions.data();
    hf_region made = s.branches_[0].handle;
    const hf_result result = hf_region_create(s.world.surface, random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused region is no NULL");
    return hf_region_destroy(made), result;
  }
  static hf_result destroy(Subject& subject, Random& random) {
    Regions& s = of(subject);
    if (!s.details_.empty() && random.one_in(2))
      return hf_detail_destroy(s.details_.back()), s.details_.pop_back(), HF_OK;
    if (s.branches_.size() < 2) return skipped;
    s.branches_.pop_back();
    return HF_OK;
  }
  static hf_result carry(Subject& subject, Random& random) {
    Regions& s = of(subject);
    const RegionBranch &from = s.any(random), &to = s.any(random);
    if (s.details_.size() > 1) return skipped;
    const std::vector<std::uint32_t> a = s.vertices(1 + random.below(3), random), b = s.vertices(a.size(), random);
    hf_detail_desc desc = HF_INIT(hf_detail_desc);
    if (random.one_in(4)) desc.pair_count = static_cast<std::uint32_t>(a.size());
    desc.source_vertices = a.data();
    desc.target_vertices = b.data();
    desc.progress = s.world.progress();
    desc.scale = random.pick({0.0, 0.0, 1.0, -1.0, random.number()});
    hf_detail made = reinterpret_cast<hf_detail>(s.world.surface);
    const hf_result result = hf_detail_create(from.handle, to.handle, random.spoiled(desc), &made);
    if (result == HF_OK) return s.details_.push_back(made), result;
    return s.expect(made == nullptr, "refused detail is no NULL"), result;
  }
  static hf_result morph(Subject& subject, Random& random) {
    Regions& s = of(subject);
    const RegionBranch& b = s.any(random);
    std::vector<double> positions(3 * s.world.shape->vertices());
    std::vector<float> single(positions.size());
    hf_morph_desc desc = HF_INIT(hf_morph_desc);
    desc.weight = random.number();
    desc.positions_f64 = positions.data();
    if (random.one_in(4)) desc.normals = single.data();
    if (random.one_in(9)) desc.positions = single.data();
    if (random.one_in(9)) desc.position_stride = 5;
    if (!s.details_.empty() && random.one_in(2)) return hf_detail_morph(s.details_[0], random.spoiled(desc));
    return hf_region_morph(b.handle, random.spoiled(desc));
  }
};

const std::vector<Command>& Regions::commands() const {
  static const std::vector<Command> table = {
      {"hf_region_edit", 16, RegionCalls::edit},    {"hf_region_clone", 5, RegionCalls::clone},
      {"back to a clone", 4, RegionCalls::go_back}, {"hf_region_create", 2, RegionCalls::make},
      {"hf_detail_create", 4, RegionCalls::carry},  {"destroying regions and detail", 1, RegionCalls::destroy},
      {"a morph", 4, RegionCalls::morph},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_regions(World& world, Random& random) {
  auto made = std::make_unique<Regions>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
