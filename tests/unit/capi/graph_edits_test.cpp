// Solvers on surfaces of graphs: random edits against a dense solve, clones, rebases, previews, saved factors.
#include <cmath>
#include <cstring>

#include "graph_support.h"
#include "support/arrays.h"

namespace {

using namespace graph_test;

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// The sites of a solver, as it tells them.
Sites sites_of(hf_solver solver, std::vector<std::uint32_t>* numbers = nullptr) {
  hf_sites_info info = HF_INIT(hf_sites_info);
  EXPECT_EQ(hf_solver_get_sites(solver, &info), HF_OK);
  Sites sites;
  sites.vertices.resize(info.count);
  sites.values.resize(info.count);
  sites.stiffness.resize(info.count);
  std::vector<std::uint32_t> all(info.count);
  info.capacity = info.count;
  info.vertices = sites.vertices.data();
  info.values = sites.values.data();
  info.stiffness = sites.stiffness.data();
  info.sites = all.data();
  EXPECT_EQ(hf_solver_get_sites(solver, &info), HF_OK);
  if (numbers) *numbers = all;
  return sites;
}

void expect_dense(const Graph& graph, std::int32_t kind, hf_solver solver, double tolerance, std::uint32_t step) {
  const Sites sites = sites_of(solver);
  if (sites.vertices.empty()) return;
  const Dense right = dense_field(graph, kind, sites);
  const std::vector<double> found = field(solver, graph.vertex_count);
  double most = 0;
  for (std::uint32_t v = 0; v < graph.vertex_count; ++v)
    most = std::max(most, std::fabs(found[v] - right.field[static_cast<Eigen::Index>(v)]));
  ASSERT_LE(most, tolerance) << "step " << step << ", kind " << kind;
}

TEST(GraphEdits, random_edits_and_kept_clones_follow_the_dense_system) {
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const Graph graph = random_graph(seed + 40, 60);
    const std::int32_t kind = static_cast<std::int32_t>(seed % 3);
    const Surface surface(graph);
    Solver solver(surface.handle, kind), kept(surface.handle, kind);
    std::mt19937 random(seed);
    for (std::uint32_t step = 0; step < 60; ++step) {
      std::vector<std::uint32_t> numbers;
      const Sites there = sites_of(solver.handle, &numbers);
      const std::uint32_t one = numbers.empty() ? 0 : numbers[random() % numbers.size()];
      const Sites fresh = random_sites(random(), graph, 1 + random() % 3);
      hf_sites_desc to = HF_INIT(hf_sites_desc);
      to.site_count = 1;
      to.vertices = fresh.vertices.data();
      const double value = static_cast<double>(random() % 100) / 50 - 1;
      switch (random() % 8) {
        case 0:
        case 1:
        case 2:
          to.site_count = static_cast<std::uint32_t>(fresh.vertices.size());
          to.values = fresh.values.data();
          to.stiffness = fresh.stiffness.data();
          hf_add_sites(solver.handle, &to, nullptr);  // refused where a site is there
          break;
        case 3:
          hf_remove_sites(solver.handle, 1, &one);
          break;
        case 4:
          hf_solver_move_sites(solver.handle, 1, &one, &to);
          break;
        case 5:
          hf_solver_set_values(solver.handle, 1, &one, &value);
          break;
        case 6:
          hf_solver_destroy(kept.handle);
          ASSERT_EQ(hf_solver_clone(solver.handle, &kept.handle), HF_OK);
          break;
        default:
          std::swap(solver.handle, kept.handle);
      }
      expect_dense(graph, kind, solver.handle, kind == HF_FIELD_HARMONIC ? 1e-10 : 1e-7, step);
    }
  }
}

TEST(GraphEdits, clones_chosen_vertices_previews_and_certificates_are_those_of_the_field) {
  const Graph graph = random_graph(50, 200);
  const Surface surface(graph);
  for (const std::int32_t kind : {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC}) {
    const Solver solver(surface.handle, kind);
    add(solver.handle, random_sites(51, graph, 20));
    const std::vector<double> whole = field(solver.handle, graph.vertex_count);
    hf_solver copy = nullptr;
    ASSERT_EQ(hf_solver_clone(solver.handle, &copy), HF_OK);
    EXPECT_TRUE(same_bits(whole, field(copy, graph.vertex_count)));
    hf_solver_destroy(copy);

    std::vector<std::uint32_t> all(graph.vertex_count);
    std::vector<double> at(graph.vertex_count), preview(graph.vertex_count);
    for (std::uint32_t v = 0; v < graph.vertex_count; ++v) all[v] = v;
    ASSERT_EQ(hf_solver_solve_at(solver.handle, graph.vertex_count, all.data(), at.data()), HF_OK);
    EXPECT_TRUE(same_bits(whole, at));
    ASSERT_EQ(hf_solver_solve_preview(solver.handle, OUT(preview.data()), 2, nullptr), HF_OK);
    for (std::size_t v = 0; v < whole.size(); ++v) ASSERT_NEAR(preview[v], whole[v], 1e-9) << kind;

    hf_certificate certificate = HF_INIT(hf_certificate);
    EXPECT_EQ(hf_solver_certify(solver.handle, &certificate), HF_OK) << last_message();
    EXPECT_EQ(certificate.overshoot_checked, kind == HF_FIELD_HARMONIC);
  }
}

TEST(GraphEdits, a_rebase_leaves_the_field_and_a_kept_clone_its_bits) {
  const Graph graph = random_graph(60, 300);
  const Surface surface(graph);
  const Solver solver(surface.handle, HF_FIELD_HARMONIC);
  add(solver.handle, random_sites(61, graph, 60));
  const std::vector<double> before = field(solver.handle, graph.vertex_count);
  Solver kept(surface.handle, HF_FIELD_HARMONIC);
  hf_solver_destroy(kept.handle);
  ASSERT_EQ(hf_solver_clone(solver.handle, &kept.handle), HF_OK);
  ASSERT_EQ(hf_solver_prepare_rebase(solver.handle), HF_OK) << last_message();
  const std::vector<std::uint32_t> one = {0};
  ASSERT_EQ(hf_remove_sites(solver.handle, 1, one.data()), HF_OK);
  hf_solver_statistics statistics = HF_INIT(hf_solver_statistics);
  ASSERT_EQ(hf_solver_get_statistics(solver.handle, &statistics), HF_OK);
  EXPECT_GT(statistics.eliminated_count, 0u);
  expect_dense(graph, HF_FIELD_HARMONIC, solver.handle, 1e-10, 0);
  EXPECT_TRUE(same_bits(before, field(kept.handle, graph.vertex_count)));
}

TEST(GraphEdits, a_saved_factor_gives_the_same_bits_and_knows_its_graph) {
  const Graph graph = random_graph(70, 150);
  const Sites sites = random_sites(71, graph, 12);
  for (const std::int32_t kind : {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC}) {
    const Surface made(graph);
    std::size_t size = 0;
    ASSERT_EQ(hf_surface_save(made.handle, kind, nullptr, 0, nullptr, &size), HF_OK);
    std::vector<unsigned char> bytes(size);
    ASSERT_EQ(hf_surface_save(made.handle, kind, nullptr, size, bytes.data(), &size), HF_OK);
    hf_factor_desc saved = HF_INIT(hf_factor_desc);
    saved.bytes = bytes.data();
    saved.byte_count = size;
    hf_graph_desc desc = graph.desc();
    desc.field_kind = kind;
    desc.saved_factor = &saved;
    const Surface loaded(desc);
    hf_surface_statistics statistics = HF_INIT(hf_surface_statistics);
    ASSERT_EQ(hf_surface_get_statistics(loaded.handle, &statistics), HF_OK);
    EXPECT_EQ(statistics.factor_loaded, 1);
    const Solver a(made.handle, kind), b(loaded.handle, kind);
    add(a.handle, sites);
    add(b.handle, sites);
    EXPECT_TRUE(same_bits(field(a.handle, graph.vertex_count), field(b.handle, graph.vertex_count)));

    Graph other = graph;
    other.weights[0] = other.weights[0] * 1.5 + 1;
    hf_graph_desc wrong = other.desc();
    wrong.field_kind = kind;
    wrong.saved_factor = &saved;
    hf_surface none = nullptr;
    EXPECT_EQ(hf_surface_create_graph(&wrong, &none), HF_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(none, nullptr);
  }
}

}  // namespace
