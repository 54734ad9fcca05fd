// Surfaces, graphs, links, and what is read off them: geodesics, paths, maps, extremities, levels, iso-lines, critical
// points, picking, saving.
#include <algorithm>
#include <cmath>

#include "support/arrays.h"
#include "unchanged.h"

namespace unchanged {
namespace {

class Analysis final : public Subject {
 public:
  Analysis(World& given, Random& random) : Subject(given) {
    hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
    desc.smoothing = random.pick({0.0, 1.0, 3.0});
    desc.method = random.pick({0, 1, 2, 3});
    hf_progress_create(&progress_);
    desc.progress = progress_;
    if (hf_geodesics_create(world.surface, &desc, &geodesics_) != HF_OK) geodesics_ = nullptr;
    for (std::uint32_t v = 0; v < world.shape->vertices(); ++v) field_.push_back(random.real(0, 1) + v);
  }
  ~Analysis() override {
    hf_geodesics_destroy(geodesics_);
    hf_progress_destroy(progress_);
  }
  bool ready() const { return geodesics_ != nullptr; }

  void glance(State& state) override {
    hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
    state.begin("statistics of a surface");
    state.add(hf_surface_get_statistics(world.surface, &statistics));
    state.add(statistics.unknown_count);
    state.add(statistics.factor_entries);
    state.add(statistics.factor_bytes);
    state.add(statistics.factor_flops);
  }
  void look(State& state) override {
    std::vector<double> distance(world.shape->vertices());
    const std::uint32_t sources[2] = {1, 20};
    state.begin("distances");
    state.add(hf_geodesics_solve(geodesics_, 2, sources, OUT(distance.data())));
    state.add(distance);
    std::size_t size = 0;
    hf_surface_save(world.surface, world.desc.field_kind, nullptr, 0, nullptr, &size);
    std::vector<unsigned char> bytes(size);
    state.begin("the saved factor");
    state.add(hf_surface_save(world.surface, world.desc.field_kind, nullptr, size, bytes.data(), &size));
    state.add(bytes);
  }
  const std::vector<Command>& commands() const override;

 private:
  friend struct AnalysisCalls;
  hf_array scalars(Random& random) {
    hf_array s = HF_ARRAY(field_.data(), field_.size());
    s.stride = random.one_in(20) ? 3 : 0;
    return s;
  }
  // Geodesics keep the progress object they were made with. The cancel of a call goes to that one.
  template <class Call>
  hf_result call_geodesics(Call&& call) {
    const hf_progress armed = world.memory.progress;
    if (!armed) return call();
    world.memory.progress = progress_;
    if (world.memory.cancel_at == 0) hf_progress_cancel(progress_);
    const hf_result result = call();
    world.memory.disarm();
    world.memory.progress = armed;
    if (result == HF_ERROR_CANCELLED) return result;
    std::vector<double> distance(world.shape->vertices());  // a cancel that came too late stops this call
    const std::uint32_t source = 1;
    hf_geodesics_solve(geodesics_, 1, &source, OUT(distance.data()));
    return result;
  }
  hf_place point(Random& random) const {
    hf_place p = {};
    const std::uint32_t triangle = random.below(world.shape->count()), i = random.below(5), j = random.below(5 - i);
    for (std::size_t k = 0; k < 3; ++k) p.corners[k] = world.shape->triangles[3 * triangle + k];
    if (random.one_in(12)) p.corners[random.below(3)] = random.index(world.shape->vertices());
    p.barycentrics[0] = i / 4.0;
    p.barycentrics[1] = j / 4.0;
    p.barycentrics[2] = (4 - i - j) / 4.0;
    if (random.one_in(12)) p.barycentrics[random.below(3)] = random.number();
    return p.reserved = random.one_in(40), p;
  }
  hf_geodesics geodesics_ = nullptr;
  hf_progress progress_ = nullptr;
  std::vector<double> field_;
};

struct AnalysisCalls {
  static Analysis& of(Subject& s) { return static_cast<Analysis&>(s); }

  static hf_result make(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    hf_geodesics_desc desc = HF_INIT(hf_geodesics_desc);
    desc.smoothing = random.number();
    desc.method = random.pick({0, 1, 2, 3, 3, 4});
    desc.progress = s.world.progress();
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
    const std::uint32_t count = random.below(4), stride = random.one_in(9) ? 4 : 0;
    return s.call_geodesics(
        [&] { return hf_geodesics_solve(s.geodesics_, count, sources, OUT_ROWS(distance.data(), stride)); });
  }
  static hf_result path(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    const hf_place from = s.point(random), to = random.one_in(9) ? from : s.point(random);
    std::vector<double> positions(3 * 200);
    hf_path out = HF_INIT(hf_path);
    out.point_capacity = random.pick({0u, 2u, 200u, 200u});
    out.positions = positions.data();
    hf_path* given = random.spoiled(out);
    return s.call_geodesics([&] { return hf_geodesics_find_path(s.geodesics_, &from, &to, given); });
  }
  static hf_result map(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    const hf_place centre = s.point(random);
    std::vector<double> plane(2 * s.world.shape->vertices(), 77.0), frame(6, 77.0);
    const double radius = random.pick({0.0, 1.5, 3.0, random.number()});
    const hf_result result = s.call_geodesics(
        [&] { return hf_geodesics_get_map(s.geodesics_, &centre, radius, plane.data(), frame.data()); });
    const bool written = std::any_of(plane.begin(), plane.end(), [](double x) { return x != 77.0; });
    s.expect(result == HF_OK || !written, "refused, but a map was written");
    return result;
  }
  static hf_result tips(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    hf_extremities_desc desc = HF_INIT(hf_extremities_desc);
    desc.kind = random.pick({0, 1, 2});
    desc.source_count = random.pick({4u, 9u, 2000u});
    desc.least_length_share = random.pick({0.0, 0.2, -1.0});
    desc.progress = s.world.progress();
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
    const hf_array field = s.scalars(random);
    double levels[5] = {1.5, 7, random.number(), 20, 33};
    std::vector<double> positions(3000);
    std::vector<hf_critical_point> points(20);
    hf_isolines out = HF_INIT(hf_isolines);
    hf_critical_info info = HF_INIT(hf_critical_info);
    out.point_capacity = random.pick({0u, 1000u});
    out.line_capacity = 100;
    out.positions = positions.data();
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
    desc.positions = HF_ARRAY(shape.positions.data(), shape.positions.size() / 3);
    desc.triangles = HF_ARRAY(shape.triangles.data(), shape.count());
    desc.progress = s.world.progress();
    desc.weld = random.pick({0, 1, 2, 3});
    desc.field_kind = random.pick({0, 1, 2, 3});
    desc.weld_tolerance = random.number();
    if (random.one_in(20)) desc.vertex_limit = 5;
    std::vector<unsigned char> bytes(64 + random.below(300), static_cast<unsigned char>(random.below(256)));
    hf_factor_desc saved = HF_INIT(hf_factor_desc);
    saved.bytes = bytes.data();
    saved.byte_count = bytes.size();
    if (random.one_in(6)) desc.saved_factor = &saved;
    hf_surface made = s.world.surface;
    const hf_result result = hf_surface_create(random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused surface is no NULL");
    return hf_surface_destroy(made), result;
  }
  // The edges of the triangles, each with a weight.
  static hf_result graph(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    const std::vector<std::uint32_t>& t = s.world.shape->triangles;
    std::vector<std::uint32_t> edges;
    for (std::size_t i = 0; i < t.size(); ++i) {
      edges.push_back(t[i]);
      edges.push_back(t[i % 3 == 2 ? i - 2 : i + 1]);
    }
    std::vector<double> weights(t.size()), masses(s.world.shape->vertices());
    for (double& w : weights) w = random.real(0.1, 2);
    for (double& m : masses) m = random.real(0.5, 2);
    hf_graph_desc desc = HF_INIT(hf_graph_desc);
    if (random.one_in(3))
      edges[random.below(static_cast<std::uint32_t>(edges.size()))] = random.index(s.world.shape->vertices());
    if (random.one_in(3)) weights[random.below(static_cast<std::uint32_t>(weights.size()))] = random.number();
    if (random.one_in(5)) masses[random.below(static_cast<std::uint32_t>(masses.size()))] = random.number();
    desc.vertex_count = s.world.shape->vertices();
    desc.edges = HF_ARRAY(edges.data(), weights.size());
    desc.weights = HF_ARRAY(weights.data(), weights.size());
    desc.allow_negative = random.pick({0, 0, 1, 2});
    if (random.one_in(2)) desc.masses = HF_ARRAY(masses.data(), masses.size());
    desc.field_kind = random.pick({0, 1, 2, 3});
    desc.progress = s.world.progress();
    desc.memory_limit_mb = s.world.desc.memory_limit_mb;
    desc.allocator = s.world.memory.hooks();
    if (random.one_in(20)) desc.edge_limit = 5;
    hf_surface made = s.world.surface;
    const hf_result result = hf_surface_create_graph(random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused graph is no NULL");
    return hf_surface_destroy(made), result;
  }
  static hf_result edit(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    std::vector<std::uint32_t> list(1 + random.below(4));
    for (std::uint32_t& v : list) v = random.index(s.world.shape->vertices());
    std::vector<double> stiffness(list.size());
    for (double& x : stiffness) x = random.one_in(12) ? random.number() : random.pick({1.0, 30.0, 0.2});
    hf_surface_edit_desc desc = HF_INIT(hf_surface_edit_desc);
    desc.vertex_count = static_cast<std::uint32_t>(list.size());
    desc.vertices = list.data();
    desc.stiffness = stiffness.data();
    desc.progress = s.world.progress();
    hf_link link{};
    link.vertex = random.index(s.world.shape->vertices());
    for (std::uint32_t& corner : link.corners) corner = random.index(s.world.shape->vertices());
    link.barycentrics[0] = link.weight = random.one_in(12) ? random.number() : 1;
    const std::uint32_t removed = random.below(3);
    desc.link_count = random.below(2);
    desc.links = &link;
    desc.removed_link_count = random.one_in(3);
    desc.removed_links = &removed;
    if (desc.link_count + desc.removed_link_count > 0 && random.one_in(2)) {
      desc.vertex_count = 0;
      desc.vertices = nullptr;
      desc.stiffness = nullptr;
    }
    hf_patch_desc patch = HF_INIT(hf_patch_desc);
    const std::uint32_t gone[2] = {random.index(s.world.shape->count()), random.index(s.world.shape->count())};
    const double middle[3] = {random.number(), 0.1, 0.2};
    std::uint32_t corners[6];
    for (std::uint32_t& corner : corners) corner = random.index(s.world.shape->vertices() + 1);
    if (random.one_in(3)) {
      patch.removed_triangle_count = random.below(3);
      patch.removed_triangles = gone;
      patch.new_vertex_count = random.below(2);
      patch.new_positions = middle;
      patch.new_triangle_count = random.below(3);
      patch.new_triangles = corners;
      patch.cut_edge_count = random.one_in(3) ? 3 : 0;
      patch.cut_edges = corners;
      desc = HF_INIT(hf_surface_edit_desc);
      desc.progress = s.world.progress();
      desc.patch = random.spoiled(patch);
    }
    hf_surface made = s.world.surface;
    const hf_result result = hf_surface_edit(s.world.surface, random.spoiled(desc), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused surface is no NULL");
    return hf_surface_destroy(made), result;
  }
  static hf_result relink(Subject& subject, Random& random) {
    Analysis& s = of(subject);
    const auto vertex = [&] { return random.index(s.world.shape->vertices()); };
    std::vector<hf_link> list(1 + random.below(3));
    for (hf_link& link : list) {
      const hf_place end = s.point(random);
      link = {};
      link.vertex = vertex();
      std::copy_n(end.corners, 3, link.corners);
      std::copy_n(end.barycentrics, 3, link.barycentrics);
      link.weight = random.one_in(12) ? random.number() : 1.0;
    }
    const std::uint32_t light = vertex(), heavy = vertex();
    hf_links_desc desc = HF_INIT(hf_links_desc);
    desc.mode = random.pick({0, 1, 1, 2, 2, 3});
    desc.distance = random.pick({0.0, 20.0, -1.0, 0.5});
    if (random.one_in(4)) desc.stiffness = random.number();
    desc.overlay_distance = random.pick({0.0, 5.0, -1.0});
    if (desc.mode == HF_LINK_LIST) {
      desc.link_count = static_cast<std::uint32_t>(list.size());
      desc.links = list.data();
    }
    if (random.one_in(3)) {
      desc.light_count = 1;
      desc.light_vertices = &light;
    }
    if (random.one_in(4)) {
      desc.heavy_count = 1;
      desc.heavy_vertices = &heavy;
    }
    hf_surface made = s.world.surface;
    const hf_result result = hf_surface_relink(s.world.surface, random.spoiled(desc), s.world.progress(), &made);
    if (result != HF_OK) s.expect(made == nullptr, "a refused surface is no NULL");
    return hf_surface_destroy(made), result;
  }
};

const std::vector<Command>& Analysis::commands() const {
  static const std::vector<Command> table = {
      {"hf_geodesics_create", 4, AnalysisCalls::make},
      {"hf_geodesics_solve", 4, AnalysisCalls::solve},
      {"hf_surface_find_extremities", 5, AnalysisCalls::tips},
      {"levels, lines and critical points", 7, AnalysisCalls::lines},
      {"picking", 2, AnalysisCalls::pick},
      {"hf_surface_save", 3, AnalysisCalls::save},
      {"hf_surface_create", 5, AnalysisCalls::surface},
      {"hf_surface_create_graph", 4, AnalysisCalls::graph},
      {"hf_surface_relink", 5, AnalysisCalls::relink},
      {"hf_surface_edit", 5, AnalysisCalls::edit},
      {"hf_geodesics_find_path", 4, AnalysisCalls::path},
      {"hf_geodesics_get_map", 3, AnalysisCalls::map},
  };
  return table;
}

}  // namespace

std::unique_ptr<Subject> make_analysis(World& world, Random& random) {
  auto made = std::make_unique<Analysis>(world, random);
  return made->ready() ? std::move(made) : nullptr;
}

}  // namespace unchanged
