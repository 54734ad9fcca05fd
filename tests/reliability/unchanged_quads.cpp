// Quad meshes and streamlines.
#include <cmath>

#include "unchanged.h"

namespace unchanged {
namespace {

class Quads final : public Subject {
 public:
  Quads(World& given, Random& random) : Subject(given) {
    for (std::uint32_t v = 0; v < world.shape->vertices(); ++v) field_.push_back(random.real(0, 1) + v);
    if (hf_flow_create(world.surface, &flow_) != HF_OK) flow_ = nullptr;
  }
  ~Quads() override {
    hf_flow_destroy(flow_);
    for (const hf_quads quads : made_) hf_quads_destroy(quads);
  }
  bool ready() const { return flow_ != nullptr; }

  void glance(State& state) override {
    for (const hf_quads quads : made_) {
      hf_quads_info info = HF_INIT(hf_quads_info);
      state.begin("info of quads");
      state.add(hf_quads_get_info(quads, &info));
      add_struct(state, info);
    }
  }
  void look(State& state) override {
    for (const hf_quads quads : made_) {
      hf_quads_info info = HF_INIT(hf_quads_info);
      hf_quads_get_info(quads, &info);
      std::vector<double> positions(3 * info.vertex_count);
      std::vector<std::uint32_t> faces(4 * std::size_t{info.face_count});
      hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
      mesh.vertex_capacity = info.vertex_count;
      mesh.face_capacity = info.face_count;
      mesh.positions = positions.data();
      mesh.faces = faces.data();
      state.begin("a quad mesh");
      state.add(hf_quads_get_mesh(quads, &mesh));
      state.add(positions);
      state.add(faces);
    }
    const hf_array field = HF_ARRAY(field_.data(), field_.size());
    std::vector<double> positions(3 * 5000);
    hf_streamlines lines = HF_INIT(hf_streamlines);
    lines.wanted_count = 5;
    lines.point_capacity = 5000;
    lines.positions = positions.data();
    state.begin("streamlines");
    state.add(hf_flow_trace(flow_, &field, &lines));
    state.add(lines.point_count);
    state.add(positions);
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct QuadsCalls;
  hf_flow flow_ = nullptr;
  std::vector<hf_quads> made_;
  std::vector<double> field_;
};

struct QuadsCalls {
  static Quads& of(Subject& s) { return static_cast<Quads&>(s); }

  // QuadsCalls work(desc) with a description that is good or not.
  template <class Work>
  static hf_result with_desc(Quads& s, Random& random, Work&& work) {
    hf_quads_desc desc = HF_INIT(hf_quads_desc);
    desc.edge_length = random.pick({0.9, 1.3, 2.0, -1.0});
    if (random.one_in(15)) desc.edge_length = random.number();
    if (desc.edge_length > 0 && desc.edge_length < 0.3) desc.edge_length = 0.3;
    if (desc.edge_length == 0) desc.edge_length = 1;  // the default is too fine for a test of many calls
    desc.relax_count = random.pick({2u, 5u, HF_NO_INDEX, 2000u});
    desc.progress = s.world.progress();
    desc.face_count = random.pick({0u, 0u, 40u, 200u, 4000000000u});
    desc.crease_angle = random.pick({0.0, 0.35, 1.05, -1.0});
    if (random.one_in(15)) desc.irregular_count = 1;
    std::vector<std::uint32_t> guided(1 + random.below(6)), edges(2 * guided.size());
    std::vector<double> vectors(3 * guided.size());
    std::vector<float> weights(guided.size());
    for (std::uint32_t& v : guided) v = random.index(s.world.shape->vertices());
    for (std::uint32_t& v : edges) v = random.index(s.world.shape->vertices());
    for (double& x : vectors) x = random.one_in(20) ? random.number() : random.pick({1.0, -0.3, 0.2});
    for (float& w : weights) w = random.pick({1.0f, 0.5f, 1.0f, 0.0f, 0.2f});
    if (random.one_in(3)) {
      desc.guide_count = static_cast<std::uint32_t>(guided.size());
      desc.guide_vertices = guided.data();
      desc.guide_vectors = vectors.data();
      if (random.one_in(2)) desc.guide_weights = weights.data();
    }
    std::vector<double> places(3 * (1 + random.below(3)));
    std::vector<std::uint32_t> meeting(places.size() / 3);
    for (double& x : places) x = random.one_in(30) ? random.number() : random.pick({0.0, 0.7, -1.0, 2.5});
    for (std::uint32_t& q : meeting) q = random.pick({3u, 5u, 3u, 5u, 4u});
    if (random.one_in(3)) {
      desc.irregular_count = static_cast<std::uint32_t>(meeting.size());
      desc.irregular_points = places.data();
      desc.irregular_valences = meeting.data();
      if (random.one_in(2)) desc.irregular_directions = places.data();
    }
    if (random.one_in(8)) {
      desc.crease_count = desc.guide_count;
      desc.crease_edges = edges.data();
    }
    if (random.one_in(6)) {
      desc.symmetry_plane[random.below(3)] = random.pick({1.0, -2.0});
      desc.symmetry_plane[3] = random.pick({0.0, 0.0, 0.5});
    }
    return work(random.spoiled(desc));
  }
  static hf_result make(Subject& subject, Random& random) {
    Quads& s = of(subject);
    return with_desc(s, random, [&](const hf_quads_desc* desc) {
      hf_quads made = reinterpret_cast<hf_quads>(s.flow_);
      const hf_result result = hf_quads_create(s.world.surface, desc, &made);
      if (result != HF_OK) return s.expect(made == nullptr, "refused quads are no NULL"), result;
      if (s.made_.size() > 1) {
        hf_quads_destroy(s.made_.front());
        s.made_.erase(s.made_.begin());
      }
      return s.made_.push_back(made), result;
    });
  }
  static hf_result update(Subject& subject, Random& random) {
    Quads& s = of(subject);
    if (s.made_.empty()) return skipped;
    return with_desc(s, random, [&](const hf_quads_desc* desc) { return hf_quads_update(s.made_.back(), desc); });
  }
  static hf_result flow(Subject& subject, Random& random) {
    Quads& s = of(subject);
    hf_flow made = s.flow_;
    const hf_result result = hf_flow_create(random.one_in(9) ? nullptr : s.world.surface, &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused flow is no NULL");
    return hf_flow_destroy(made), result;
  }
  static hf_result trace(Subject& subject, Random& random) {
    Quads& s = of(subject);
    std::vector<double> values = s.field_, positions(3 * 500);
    if (random.one_in(5)) values[random.below(static_cast<std::uint32_t>(values.size()))] = random.number();
    const hf_array field = HF_ARRAY(values.data(), values.size());
    const std::uint32_t seeds[2] = {random.index(s.world.shape->vertices()), 3};
    hf_streamlines lines = HF_INIT(hf_streamlines);
    lines.wanted_count = random.pick({0u, 3u, 9u});
    lines.seed_count = random.below(3);
    lines.seeds = seeds;
    lines.point_capacity = random.pick({10u, 500u});
    lines.positions = positions.data();
    return hf_flow_trace(s.flow_, random.one_in(60) ? nullptr : &field, random.spoiled(lines));
  }
  static hf_result read(Subject& subject, Random& random) {
    Quads& s = of(subject);
    if (s.made_.empty()) return skipped;
    hf_quads_mesh mesh = HF_INIT(hf_quads_mesh);
    std::vector<double> positions(3 * 20);
    mesh.vertex_capacity = 20;
    mesh.positions = positions.data();
    mesh.reserved = random.one_in(9);
    return hf_quads_get_mesh(s.made_[0], random.spoiled(mesh));
  }
};

const std::vector<Command>& Quads::commands() const {
  static const std::vector<Command> table = {
      {"hf_quads_create", 6, QuadsCalls::make},   {"hf_quads_update", 6, QuadsCalls::update, true},
      {"hf_flow_create", 3, QuadsCalls::flow},    {"hf_flow_trace", 8, QuadsCalls::trace},
      {"hf_quads_get_mesh", 2, QuadsCalls::read},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_quads(World& world, Random& random) {
  auto made = std::make_unique<Quads>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
