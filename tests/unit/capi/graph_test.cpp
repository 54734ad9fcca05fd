// Surfaces of graphs: their fields against a dense solve, what a list of edges means, units, and what stays the same.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "graph_support.h"

namespace {

using namespace graph_test;

constexpr std::int32_t kinds[] = {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC, HF_FIELD_BIHARMONIC_GRAPH};

std::vector<std::int32_t> engines() {
#ifdef HF_WITH_GPL
  return {HF_ENGINE_GREEN, HF_ENGINE_REFACTOR, HF_ENGINE_UPDOWN};
#else
  return {HF_ENGINE_GREEN, HF_ENGINE_REFACTOR};
#endif
}

double difference(const std::vector<double>& a, const Eigen::VectorXd& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::fabs(a[i] - b[static_cast<Eigen::Index>(i)]));
  return a.size() == static_cast<std::size_t>(b.size()) ? most : HUGE_VAL;
}
bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}
std::vector<double> field_of(const Graph& graph, const Sites& sites, std::int32_t kind = HF_FIELD_HARMONIC) {
  const Surface surface(graph);
  const Solver solver(surface.handle, kind);
  add(solver.handle, sites);
  return field(solver.handle, graph.vertex_count);
}
hf_mesh_statistics statistics_of(hf_surface surface) {
  hf_mesh_statistics statistics = HF_INIT(hf_mesh_statistics);
  EXPECT_EQ(hf_surface_get_mesh_statistics(surface, &statistics), HF_OK);
  return statistics;
}
hf_surface_report report_of(hf_surface surface) {
  hf_surface_report report = HF_INIT(hf_surface_report);
  EXPECT_EQ(hf_surface_get_report(surface, &report), HF_OK);
  return report;
}

TEST(Graph, fields_and_fluxes_are_those_of_the_dense_system) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Graph graph = random_graph(seed, 20 + 7 * seed);
    const Surface surface(graph);
    const Sites sites = random_sites(seed, graph, 3 + seed);
    for (const std::int32_t kind : kinds) {
      const Dense right = dense_field(graph, kind, sites);
      for (const std::int32_t engine : engines()) {
        const Solver solver(surface.handle, kind, engine);
        add(solver.handle, sites);
        const double tolerance = engine == HF_ENGINE_UPDOWN ? 1e-5 : kind == HF_FIELD_HARMONIC ? 1e-11 : 1e-8;
        EXPECT_LE(difference(field(solver.handle, graph.vertex_count), right.field), tolerance)
            << "seed " << seed << ", kind " << kind << ", engine " << engine;
        if (engine == HF_ENGINE_UPDOWN) continue;
        EXPECT_LE(difference(fluxes(solver.handle), right.flux), tolerance * (1 + right.flux.cwiseAbs().maxCoeff()))
            << "seed " << seed << ", kind " << kind << ", engine " << engine;
      }
    }
  }
}

TEST(Graph, components_and_isolated_vertices_are_those_of_the_edges_that_are_left) {
  for (std::uint32_t seed = 20; seed < 30; ++seed) {
    const Graph graph = random_graph(seed, 40);
    const Surface surface(graph);
    const std::vector<int> right = components(graph);
    std::vector<std::uint32_t> found(graph.vertex_count);
    ASSERT_EQ(hf_surface_get_components(surface.handle, graph.vertex_count, found.data(), nullptr), HF_OK);
    std::uint32_t isolated = 0;
    for (std::uint32_t v = 0; v < graph.vertex_count; ++v) {
      isolated += right[v] < 0;
      EXPECT_EQ(found[v], right[v] < 0 ? HF_NO_INDEX : static_cast<std::uint32_t>(right[v])) << v;
    }
    const hf_surface_report report = report_of(surface.handle);
    EXPECT_EQ(report.vertex_count, graph.vertex_count);
    EXPECT_EQ(report.isolated_vertex_count, isolated);
    EXPECT_EQ(report.component_count, static_cast<std::uint32_t>(1 + *std::max_element(right.begin(), right.end())));
    EXPECT_EQ(report.triangle_count, 0u);
    EXPECT_EQ(statistics_of(surface.handle).changed_vertex_count, 0u);
    EXPECT_EQ(statistics_of(surface.handle).first_changed_vertex, HF_NO_INDEX);
  }
}

TEST(Graph, the_order_of_the_list_and_of_its_ends_changes_no_bit) {
  const Graph graph = random_graph(5, 70);
  const Sites sites = random_sites(6, graph, 8);
  std::vector<std::size_t> order(graph.weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(9);
  std::shuffle(order.begin(), order.end(), random);
  Graph shuffled;
  shuffled.vertex_count = graph.vertex_count;
  shuffled.masses = graph.masses;
  for (const std::size_t e : order) {
    const bool turned = random() % 2;
    shuffled.add(graph.edges[2 * e + turned], graph.edges[2 * e + !turned], graph.weights[e]);
  }
  for (const std::int32_t kind : kinds)
    EXPECT_TRUE(same_bits(field_of(graph, sites, kind), field_of(shuffled, sites, kind))) << kind;
}

TEST(Graph, parallel_edges_add_up_and_loops_and_zeros_are_left_out) {
  Graph plain, given;
  plain.vertex_count = given.vertex_count = 6;
  plain.add(0, 1, 3);
  plain.add(1, 2, 1);
  plain.add(2, 3, 2);
  given.add(1, 0, 1);
  given.add(2, 2, 7);
  given.add(1, 2, 1);
  given.add(3, 2, 2);
  given.add(0, 1, 2);
  given.add(3, 4, 0);
  const Sites sites{{0, 3}, {0, 1}, {}};
  EXPECT_TRUE(same_bits(field_of(plain, sites), field_of(given, sites)));
  const Surface surface(given);
  EXPECT_EQ(report_of(surface.handle).isolated_vertex_count, 2u);
}

TEST(Graph, a_unit_that_is_a_power_of_two_changes_no_bit_of_a_field) {
  const Graph graph = random_graph(3, 60);
  const Sites sites = random_sites(4, graph, 7);
  for (const int power : {-300, -40, 1, 40, 300}) {
    Graph scaled = graph;
    for (double& w : scaled.weights) w = std::ldexp(w, power);
    for (const std::int32_t kind : kinds) {
      EXPECT_TRUE(same_bits(field_of(graph, sites, kind), field_of(scaled, sites, kind))) << power << ", " << kind;
    }
    const Surface a(graph), b(scaled);
    for (const std::int32_t kind : {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC}) {
      const Solver one(a.handle, kind), other(b.handle, kind);
      add(one.handle, sites);
      add(other.handle, sites);
      std::vector<double> flux = fluxes(one.handle);
      for (double& f : flux) f = std::ldexp(f, kind == HF_FIELD_HARMONIC ? power : 2 * power);
      EXPECT_TRUE(same_bits(flux, fluxes(other.handle))) << power << ", " << kind;
    }
  }
}

TEST(Graph, components_may_have_units_of_their_own) {
  Graph one = random_graph(2, 30), both;
  both.vertex_count = 60;
  for (std::size_t e = 0; e < one.weights.size(); ++e) {
    both.add(one.edges[2 * e], one.edges[2 * e + 1], 1e-30 * one.weights[e]);
    both.add(30 + one.edges[2 * e], 30 + one.edges[2 * e + 1], 1e30 * one.weights[e]);
  }
  one.masses.clear();
  const Sites sites = random_sites(7, one, 5);
  Sites twice = sites;
  for (std::size_t i = 0; i < sites.vertices.size(); ++i) {
    twice.vertices.push_back(30 + sites.vertices[i]);
    twice.values.push_back(sites.values[i]);
    twice.stiffness.push_back(sites.stiffness[i]);
  }
  for (const std::int32_t kind : kinds) {
    const Dense right = dense_field(one, kind, sites);
    const std::vector<double> found = field_of(both, twice, kind);
    EXPECT_LE(difference({found.begin(), found.begin() + 30}, right.field), 1e-8) << kind;
    EXPECT_LE(difference({found.begin() + 30, found.end()}, right.field), 1e-8) << kind;
  }
}

TEST(Graph, masses_have_no_unit_and_none_are_ones) {
  Graph graph = random_graph(8, 50);
  const Sites sites = random_sites(8, graph, 6);
  const std::vector<double> found = field_of(graph, sites, HF_FIELD_BIHARMONIC);
  Graph scaled = graph, ones = graph, none = graph;
  for (double& m : scaled.masses) m *= 1024;
  ones.masses.assign(graph.vertex_count, 3.0);
  none.masses.clear();
  EXPECT_TRUE(same_bits(found, field_of(scaled, sites, HF_FIELD_BIHARMONIC)));
  EXPECT_FALSE(same_bits(found, field_of(none, sites, HF_FIELD_BIHARMONIC)));
  EXPECT_TRUE(same_bits(field_of(none, sites, HF_FIELD_BIHARMONIC), field_of(ones, sites, HF_FIELD_BIHARMONIC)));
}

TEST(Graph, paths_stars_and_cliques_have_their_closed_forms) {
  const std::uint32_t n = 5000;
  Graph path, star, clique;
  path.vertex_count = star.vertex_count = n;
  clique.vertex_count = 150;
  double length = 0;
  std::vector<double> right(n, 0);
  for (std::uint32_t v = 0; v + 1 < n; ++v) {
    const double weight = 0.5 + (v * 7919 % 100) / 50.0;
    path.add(v, v + 1, weight);
    star.add(n - 1, v, weight);
    right[v + 1] = length += 1 / weight;
  }
  for (std::uint32_t a = 0; a < 150; ++a) {
    for (std::uint32_t b = 0; b < a; ++b) clique.add(a, b, 1);
  }
  const Sites ends{{0, n - 1}, {0, 1}, {}};
  const std::vector<double> on_path = field_of(path, ends), on_star = field_of(star, {{0, 1}, {0, 1}, {}});
  double most = 0;
  for (std::uint32_t v = 0; v < n; ++v) most = std::max(most, std::fabs(on_path[v] - right[v] / length));
  EXPECT_LE(most, 1e-9);
  const double centre = star.weights[1] / (star.weights[0] + star.weights[1]);
  for (std::uint32_t v = 2; v < n; ++v) ASSERT_NEAR(on_star[v], centre, 1e-12);
  const std::vector<double> on_clique = field_of(clique, {{3, 9}, {0, 1}, {}});
  for (std::uint32_t v = 10; v < 150; ++v) ASSERT_NEAR(on_clique[v], 0.5, 1e-12);
}

TEST(Graph, is_the_uniform_operator_of_a_mesh_with_its_edges) {
  const std::uint32_t side = 12;
  std::vector<float> positions;
  std::vector<std::uint32_t> triangles;
  Graph graph;
  graph.vertex_count = side * side;
  for (std::uint32_t v = 0; v < side * side; ++v) {
    const std::uint32_t x = v % side, y = v / side;
    positions.insert(positions.end(),
                     {static_cast<float>(x), static_cast<float>(y), 0.1f * static_cast<float>(x * y % 7)});
    if (x + 1 < side) graph.add(v, v + 1, 1);
    if (y + 1 < side) graph.add(v, v + side, 1);
    if (x + 1 == side || y + 1 == side) continue;
    graph.add(v, v + side + 1, 1);
    triangles.insert(triangles.end(), {v, v + 1, v + side + 1, v, v + side + 1, v + side});
  }
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.vertex_count = side * side;
  desc.positions = positions.data();
  desc.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
  desc.triangles = triangles.data();
  desc.operator_kind = HF_OPERATOR_UNIFORM;
  hf_surface mesh = nullptr;
  ASSERT_EQ(hf_surface_create(&desc, &mesh), HF_OK);
  const Sites sites{{0, 77, 143}, {0, 2, -1}, {0, 0.3, 0}};
  for (const std::int32_t kind : {HF_FIELD_HARMONIC, HF_FIELD_BIHARMONIC_GRAPH}) {
    const Solver solver(mesh, kind);
    add(solver.handle, sites);
    const std::vector<double> a = field(solver.handle, graph.vertex_count), b = field_of(graph, sites, kind);
    for (std::size_t v = 0; v < a.size(); ++v) ASSERT_NEAR(a[v], b[v], 1e-9) << kind;
  }
  hf_surface_destroy(mesh);
}

TEST(Graph, threads_and_orderings_agree) {
  const Graph graph = random_graph(31, 400);
  const Sites sites = random_sites(31, graph, 40);
  for (const std::int32_t kind : kinds) {
    std::vector<double> first;
    for (const std::uint32_t threads : {1u, 2u, 5u}) {
      hf_graph_desc desc = graph.desc();
      desc.thread_count = threads;
      desc.field_kind = kind;
      const Surface surface(desc);
      const Solver solver(surface.handle, kind);
      add(solver.handle, sites);
      if (threads == 1) first = field(solver.handle, graph.vertex_count);
      EXPECT_TRUE(same_bits(first, field(solver.handle, graph.vertex_count))) << threads;
    }
    hf_graph_desc desc = graph.desc();
    desc.ordering = HF_ORDERING_MINIMUM_DEGREE;
    const Surface surface(desc);
    const Solver solver(surface.handle, kind);
    add(solver.handle, sites);
    const std::vector<double> other = field(solver.handle, graph.vertex_count);
    for (std::size_t v = 0; v < other.size(); ++v) ASSERT_NEAR(other[v], first[v], 1e-7) << kind;
  }
}

// ---- weights that are hard ----

TEST(Graph, weights_of_any_spread_give_fields_within_their_sites) {
  for (const double spread : {3.0, 10.0, 30.0, 90.0, 200.0}) {
    Graph graph = random_graph(11, 120);
    std::mt19937 random(static_cast<std::uint32_t>(spread));
    for (double& w : graph.weights) {
      if (w > 0) w = std::pow(10.0, std::min(99.0, (static_cast<double>(random() % 2001) / 1000 - 1) * spread));
    }
    const Surface surface(graph);
    const Sites sites = random_sites(12, graph, 9);
    for (const std::int32_t kind : kinds) {
      const Solver solver(surface.handle, kind);
      add(solver.handle, sites);
      std::vector<double> exact = field(solver.handle, graph.vertex_count), preview(graph.vertex_count);
      ASSERT_EQ(hf_solver_solve_preview_f64(solver.handle, preview.data(), 0, 2, nullptr), HF_OK);
      for (std::size_t v = 0; v < exact.size(); ++v) {
        ASSERT_TRUE(std::isfinite(exact[v]) && std::isfinite(preview[v])) << spread << ", kind " << kind;
        ASSERT_LE(std::fabs(exact[v]), kind == HF_FIELD_HARMONIC ? 1 + 1e-6 : HUGE_VAL) << spread;
      }
    }
    const std::uint32_t changed = statistics_of(surface.handle).changed_vertex_count;
    EXPECT_TRUE(spread > 3 || changed == 0) << changed;
    EXPECT_TRUE(spread < 100 || changed > 0);
  }
}

// A path between two sites: the field is the share of the resistance behind it, whatever the weights span. A rule
// changes weights that no factor can hold, and a certificate must not speak for the changed ones.
TEST(Graph, a_certificate_holds_for_the_weights_given) {
  int certified = 0, refused = 0, changed = 0;
  for (const double spread : {2.0, 5.0, 8.0, 11.0, 14.0}) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      std::mt19937 random(seed);
      Graph graph;
      graph.vertex_count = 12;
      std::vector<long double> behind(1, 0);
      for (std::uint32_t v = 0; v + 1 < 12; ++v) {
        graph.add(v, v + 1, std::pow(10.0, (static_cast<double>(random() % 2001) / 1000 - 1) * spread));
        behind.push_back(behind.back() + 1 / static_cast<long double>(graph.weights.back()));
      }
      const Surface surface(graph);
      const Solver solver(surface.handle, HF_FIELD_HARMONIC);
      add(solver.handle, {{0, 11}, {0, 1}, {}});
      const std::vector<double> u = field(solver.handle, 12);
      long double error = 0;
      for (std::size_t v = 0; v < 12; ++v) error = std::max(error, std::fabs(behind[v] / behind.back() - u[v]));
      hf_certificate certificate = HF_INIT(hf_certificate);
      const hf_result result = hf_solver_certify(solver.handle, &certificate);
      EXPECT_EQ(certificate.changed_vertex_count, statistics_of(surface.handle).changed_vertex_count);
      changed += certificate.changed_vertex_count > 0;
      if (result == HF_OK) {
        EXPECT_LE(error, 1e-7) << "spread " << spread << ", seed " << seed;
      } else {
        EXPECT_EQ(result, HF_ERROR_INACCURATE);
        EXPECT_GE(certificate.error_estimate, error) << "spread " << spread << ", seed " << seed;
      }
      (result == HF_OK ? certified : refused)++;
    }
  }
  EXPECT_GE(certified, 20);
  EXPECT_GT(changed, 5);
  EXPECT_GT(refused, 0);
}

// Weights of rounding size between all vertices do not count for the median that caps the weights of L M^-1 L.
TEST(Graph, weights_of_rounding_size_leave_bi_harmonic_fields_alone) {
  Graph graph;
  graph.vertex_count = 40;
  for (std::uint32_t v = 0; v + 1 < 40; ++v) graph.add(v, v + 1, 1 + 0.1 * (v % 4));
  const Sites sites{{0, 13, 39}, {0, 1, -1}, {}};
  const std::vector<double> clean = field_of(graph, sites, HF_FIELD_BIHARMONIC);
  for (std::uint32_t a = 0; a < 40; ++a) {
    for (std::uint32_t b = 0; b + 1 < a; ++b) graph.add(a, b, 1e-17);
  }
  const Surface surface(graph);
  EXPECT_EQ(statistics_of(surface.handle).changed_vertex_count, 0u);
  const std::vector<double> noisy = field_of(graph, sites, HF_FIELD_BIHARMONIC);
  for (std::size_t v = 0; v < 40; ++v) ASSERT_NEAR(noisy[v], clean[v], 1e-9);
}

TEST(Graph, negative_weights_are_taken_while_the_matrix_is_semi_definite) {
  Graph graph;  // a square with diagonals: the form is sum w d^2, definite for diagonals above -1
  graph.vertex_count = 4;
  graph.allow_negative = 1;
  for (std::uint32_t v = 0; v < 4; ++v) graph.add(v, (v + 1) % 4, 1);
  graph.add(0, 2, -0.45);
  graph.add(1, 3, -0.3);
  const Sites sites{{0, 1}, {0, 1}, {}};
  for (const std::int32_t kind : kinds) {
    const Dense right = dense_field(graph, kind, sites);
    EXPECT_LE(difference(field_of(graph, sites, kind), right.field), 1e-10) << kind;
  }
  const Surface surface(graph);
  EXPECT_EQ(statistics_of(surface.handle).negative_edge_count, 2u);
  const Solver solver(surface.handle, HF_FIELD_HARMONIC);
  add(solver.handle, sites);
  hf_certificate certificate = HF_INIT(hf_certificate);
  EXPECT_EQ(hf_solver_certify(solver.handle, &certificate), HF_OK);
  EXPECT_EQ(certificate.overshoot_checked, 0);

  graph.weights[4] = -1.1;
  const hf_graph_desc desc = graph.desc();
  hf_surface none = surface.handle;
  EXPECT_EQ(hf_surface_create_graph(&desc, &none), HF_ERROR_NOT_POSITIVE_DEFINITE);
  EXPECT_EQ(none, nullptr);
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  EXPECT_LT(detail.index, 4u);
}

}  // namespace
