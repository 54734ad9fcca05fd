// Surfaces and what is read off them: geodesics, extremities, levels, iso-lines, critical points, picking, saving.
#include <cmath>

#include "unchanged.h"

namespace unchanged {
namespace {

class Analysis final : public Subject {
 public:
  Analysis(World& given, Random& random) : Subject(given) {
    hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
    desc.smoothing = random.pick({0.0f, 1.0f, 3.0f});
    if (hf_geodesics_create(world.surface, &desc, &geodesics_) != HF_OK) geodesics_ = nullptr;
    for (std::uint32_t v = 0; v < world.shape->vertices(); ++v) field_.push_back(random.real(0, 1) + v);
  }
  ~Analysis() override { hf_geodesics_destroy(geodesics_); }
  bool ready() const { return geodesics_ != nullptr; }

  void glance(State& state) override {
    hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
    state.begin("statistics of a surface");
    state.add(hf_surface_get_statistics(world.surface, &statistics));
    state.add(statistics.unknown_count), state.add(statistics.factor_entries), state.add(statistics.factor_bytes);
    state.add(statistics.factor_flops);
  }
  void look(State& state) override {
    std::vector<double> distance(world.shape->vertices());
    const std::uint32_t sources[2] = {1, 20};
    state.begin("distances");
    state.add(hf_geodesics_solve_f64(geodesics_, 2, sources, distance.data(), 0)), state.add(distance);
    std::size_t size = 0;
    hf_surface_save(world.surface, world.desc.field_kind, nullptr, 0, nullptr, &size);
    std::vector<unsigned char> bytes(size);
    state.begin("the saved factor");
    state.add(hf_surface_save(world.surface, world.desc.field_kind, nullptr, size, bytes.data(), &size)),
        state.add(bytes);
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct Calls;
  hf_scalars scalars(Random& random) {
    hf_scalars s = HF_INIT(hf_scalars);
    s.values_f64 = field_.data(), s.value_stride = random.one_in(20) ? 3 : 0;
    return s;
  }
  hf_geodesics geodesics_ = nullptr;
  std::vector<double> field_;
};

struct Calls {
  static Analysis& of(Subject& s) { return static_cast<Analysis&>(s); }

  static hf_result make(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
    desc.smoothing = static_cast<float>(random.number()), desc.progress = s.world.progress();
    hf_geodesics made = s.geodesics_;
    const hf_result result = hf_geodesics_create(s.world.surface, random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "refused geodesics are no NULL");
    return hf_geodesics_destroy(made), result;
  }
  static hf_result solve(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    std::vector<double> distance(s.world.shape->vertices());
    const std::uint32_t sources[3] = {random.index(s.world.shape->vertices()), random.index(s.world.shape->vertices()),
                                      0};
    return hf_geodesics_solve_f64(s.geodesics_, random.below(4), sources, distance.data(), random.one_in(9) ? 4 : 0);
  }
  static hf_result tips(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
    desc.kind = random.pick({0, 1, 2}), desc.source_count = random.pick({4u, 9u, 2000u});
    desc.least_length = random.pick({0.0f, 0.2f, -1.0f}), desc.progress = s.world.progress();
    if (random.one_in(2)) desc.geodesics = s.geodesics_;
    hf_extremity found[2];
    std::uint32_t count = 0;
    return hf_surface_find_extremities(s.world.surface, random.spoiled(desc), random.below(3), found, &count);
  }
  static hf_result lines(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    const double bad = random.number();
    const std::uint32_t at = random.below(s.world.shape->vertices());
    const double kept = s.field_[at];
    if (random.one_in(5)) s.field_[at] = bad;
    const hf_scalars field = s.scalars(random);
    double levels[5] = {1.5, 7, random.number(), 20, 33};
    std::vector<double> positions(3000);
    std::vector<hf_critical_point> points(20);
    hf_isolines out = HF_INIT(hf_isolines);
    hf_critical_info info = HF_INIT(hf_critical_info);
    out.point_capacity = random.pick({0u, 1000u}), out.line_capacity = 100, out.positions = positions.data();
    const std::uint32_t dice = random.below(3);
    const hf_result result =
        dice == 0   ? hf_surface_space_levels(s.world.surface, &field, random.below(4) - 0, 1 + random.below(5), levels)
        : dice == 1 ? hf_surface_trace_isolines(s.world.surface, &field, 5, levels, random.spoiled(out))
                    : hf_surface_find_critical_points(s.world.surface, &field, random.pick({0u, 20u}), points.data(),
                                                      random.spoiled(info));
    s.field_[at] = kept;
    return result;
  }
  static hf_result pick(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    const double from[3] = {random.number(), random.number(), 9},
                 along[3] = {0, random.pick({0.0, 0.1}), random.number()};
    hf_hit hit = HF_INIT(hf_hit);
    hf_pick_desc desc = HF_INIT(hf_pick_desc);
    desc.front_only = random.pick({0, 1, 2});
    std::uint32_t vertex = 0;
    if (random.one_in(2)) return hf_surface_find_vertex(s.world.surface, from, random.spoiled(desc), &vertex, nullptr);
    return hf_surface_cast_ray(s.world.surface, from, along, random.spoiled(desc), random.spoiled(hit));
  }
  static hf_result save(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    std::size_t size = 0;
    std::vector<unsigned char> bytes(random.pick({100u, 200000u}));
    return hf_surface_save(s.world.surface, random.pick({0, 1, 2, 3}), nullptr, bytes.size(), bytes.data(), &size);
  }
  // A surface of damaged options, indices, positions or bytes beside the first.
  static hf_result surface(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    hf_surface_desc desc = s.world.desc;
    Shape shape = *s.world.shape;
    if (random.one_in(3)) shape.positions[random.below(3 * shape.vertices())] = static_cast<float>(random.number());
    if (random.one_in(3)) shape.triangles[random.below(3 * shape.count())] = random.index(shape.vertices());
    desc.positions = shape.positions.data(), desc.triangles = shape.triangles.data();
    desc.progress = s.world.progress(), desc.weld = random.pick({0, 1, 2, 3}),
    desc.field_kind = random.pick({0, 1, 2, 3});
    desc.weld_tolerance = static_cast<float>(random.number());
    if (random.one_in(20)) desc.vertex_limit = 5;
    std::vector<unsigned char> bytes(64 + random.below(300), static_cast<unsigned char>(random.below(256)));
    hf_factor_desc saved = HF_INIT(hf_factor_desc);
    saved.bytes = bytes.data(), saved.byte_count = bytes.size();
    if (random.one_in(6)) desc.saved_factor = &saved;
    hf_surface made = s.world.surface;
    const hf_result result = hf_surface_create(random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused surface is no NULL");
    return hf_surface_destroy(made), result;
  }
};

const std::vector<Command>& Analysis::commands() const {
  static const std::vector<Command> table = {
      {"hf_geodesics_create", 4, Calls::make},
      {"hf_geodesics_solve", 4, Calls::solve},
      {"hf_surface_find_extremities", 5, Calls::tips},
      {"levels, lines and critical points", 7, Calls::lines},
      {"picking", 2, Calls::pick},
      {"hf_surface_save", 3, Calls::save},
      {"hf_surface_create", 5, Calls::surface},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_analysis(World& world, Random& random) {
  auto made = std::make_unique<Analysis>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
