// Critical points: indices sum to the Euler characteristic; extrema of a field lie at its sites; and the open question
// of the paper, the number of critical points under penalty against exact constraints.
#include "field/critical_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "analysis_support.h"
#include "base/index.h"
#include "field/scalar_field.h"
#include "support/creature.h"
#include "support/engines.h"

namespace {

using hf_inner::at;
using hf_inner::field::CriticalKind;
using hf_inner::field::CriticalPoints;
using hf_test::PlainMesh;

std::shared_ptr<const hf_inner::surface::Core> bare(const PlainMesh& mesh) {
  hf_inner::surface::CoreOptions options;
  options.need_factor = false;
  return hf_test::make_core(mesh, 1, options);
}

CriticalPoints find(const hf_inner::surface::Core& core, const std::vector<double>& field) {
  static hf_inner::Memory memory;  // outlives the core
  return hf_inner::field::find_critical_points(core.mesh, core.topology(), field, memory);
}

// index by the sign changes around the ring of an inner manifold vertex: 1 - changes / 2
int index_by_walking(const hf_inner::surface::Core& core, const std::vector<double>& u, int v) {
  const auto below = [&](int w) {
    const std::size_t a = static_cast<std::size_t>(w), b = static_cast<std::size_t>(v);
    return u[a] != u[b] ? u[a] < u[b] : w < v;
  };
  std::map<int, int> next;
  for (int t = 0; t < core.mesh.triangle_count(); ++t) {
    const int* c = core.mesh.triangle(t);
    for (int k = 0; k < 3; ++k) {
      if (c[k] == v) next[c[(k + 1) % 3]] = c[(k + 2) % 3];
    }
  }
  int changes = 0, w = next.begin()->first;
  for (std::size_t i = 0; i < next.size(); ++i, w = next.at(w)) changes += below(w) != below(next.at(w));
  return 1 - changes / 2;
}

TEST(CriticalPoints, have_indices_that_sum_to_the_euler_characteristic_for_genus_0_to_5) {
  for (int genus = 0; genus <= 5; ++genus) {
    const PlainMesh mesh = hf_test::ladder(genus, 0.16);
    const auto core = bare(mesh);
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      const auto u = seed
                         ? hf_test::random_field(mesh, seed)
                         : hf_test::field_of(mesh, [](double x, double y, double z) { return y + 0.1 * x + 0.01 * z; });
      const CriticalPoints found = find(*core, u);
      EXPECT_EQ(found.euler_characteristic, 2 - 2 * genus);
      EXPECT_EQ(found.index_sum, 2 - 2 * genus);
      EXPECT_EQ(found.points.size(), found.minima + found.maxima + found.saddles);
    }
  }
}

TEST(CriticalPoints, have_the_index_that_walking_around_the_vertex_counts) {
  const PlainMesh mesh = hf_test::torus(13, 8);
  const auto core = bare(mesh);
  std::map<int, int> seen;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    auto u = hf_test::random_field(mesh, seed);
    if (seed % 2) {
      for (double& value : u) value = std::floor(3 * value);  // many ties
    }
    const CriticalPoints found = find(*core, u);
    std::map<int, int> index;
    for (const auto& point : found.points) {
      index[point.vertex] = point.index;
      ++seen[point.index];
    }
    for (int v = 0; v < core->size(); ++v) EXPECT_EQ(index.count(v) ? index[v] : 0, index_by_walking(*core, u, v));
  }
  EXPECT_GT(seen[1], 0);
  EXPECT_GT(seen[-1], 0);
  EXPECT_GT(seen[-2], 0);
}

TEST(CriticalPoints, of_a_height_are_those_one_expects) {
  const PlainMesh ball = hf_test::from_shape(samples::sphere(10));
  const CriticalPoints two =
      find(*bare(ball), hf_test::field_of(ball, [](double x, double y, double) { return y + 0.1 * x; }));
  EXPECT_EQ(two.minima, 1u);
  EXPECT_EQ(two.maxima, 1u);
  EXPECT_EQ(two.saddles, 0u);

  const PlainMesh ring = hf_test::torus(40, 24, 0.1);
  const CriticalPoints four =
      find(*bare(ring), hf_test::field_of(ring, [](double x, double y, double z) { return x + 0.2 * y + 0.1 * z; }));
  EXPECT_EQ(four.minima, 1u);
  EXPECT_EQ(four.maxima, 1u);
  EXPECT_EQ(four.saddles, 2u);

  // a monkey saddle: Re (x + i y)^3 around an inner vertex of a sheet
  const PlainMesh sheet = hf_test::grid(10, 10, 0.1);
  const CriticalPoints monkey = find(*bare(sheet), hf_test::field_of(sheet, [](double x, double y, double) {
    const double a = x - 0.5, b = y - 0.6;
    return a * a * a - 3 * a * b * b + 1e-9 * (a + 2 * b);
  }));
  const auto centre = std::find_if(monkey.points.begin(), monkey.points.end(),
                                   [](const hf_inner::field::CriticalPoint& p) { return p.vertex == 6 * 11 + 5; });
  ASSERT_TRUE(centre != monkey.points.end());
  EXPECT_EQ(centre->kind, CriticalKind::saddle);
  EXPECT_EQ(centre->index, -2);
}

TEST(CriticalPoints, sum_up_on_every_component_with_borders_ties_missing_values_and_non_manifold_edges) {
  PlainMesh mesh = hf_test::grid(7, 5, 1, 0.2);
  hf_test::append(mesh, hf_test::torus(9, 7), 20);
  hf_test::append(mesh, hf_test::from_shape(samples::sphere(3)), 40);
  const std::uint32_t base = mesh.vertex_count();
  mesh.positions.insert(mesh.positions.end(), {60, 0, 0, 60, 0, 1, 61, 0, 0, 59, 1, 0, 59, -1, 0});
  for (const std::uint32_t v : {0u, 1u, 2u, 1u, 0u, 3u, 0u, 1u, 4u}) mesh.triangles.push_back(base + v);
  const auto core = bare(mesh);
  ASSERT_EQ(core->mesh.component_count(), 4);
  const int euler[] = {1, 0, 2, 1};
  for (std::uint32_t seed = 1; seed <= 50; ++seed) {
    auto u = hf_test::random_field(mesh, seed);
    if (seed % 3 == 0) {
      for (double& value : u) value = std::floor(2 * value);
    }
    std::map<int, int> sum;
    for (const auto& point : find(*core, u).points)
      sum[core->mesh.component[static_cast<std::size_t>(point.vertex)]] += point.index;
    for (int c = 0; c < 4; ++c) EXPECT_EQ(sum[c], euler[c]) << "component " << c;
  }
  auto u = hf_test::random_field(mesh, 99);
  for (std::size_t v = 0; v < u.size(); v += 7) u[v] = std::nan("");
  const CriticalPoints holes = find(*core, u);
  EXPECT_EQ(holes.index_sum, holes.euler_characteristic);
}

// ---- fields

void add(hf_inner::field::ScalarField& field, const std::vector<std::uint32_t>& vertices,
         const std::vector<double>& values) {
  hf_inner::field::FieldEdit edit;
  edit.add.count = static_cast<std::uint32_t>(vertices.size());
  edit.add.vertices = vertices.data();
  edit.add_holds.values = values.data();
  field.edit(edit, nullptr);
}

std::vector<std::uint32_t> different_vertices(std::uint32_t below, std::size_t count, std::mt19937_64& random) {
  std::vector<std::uint32_t> vertices;
  while (vertices.size() < count) {
    const std::uint32_t v = static_cast<std::uint32_t>(random() % below);
    if (std::find(vertices.begin(), vertices.end(), v) == vertices.end()) vertices.push_back(v);
  }
  return vertices;
}

TEST(MaximumPrinciple, holds_for_1000_random_site_sets_with_weights_above_zero) {
  PlainMesh mesh = hf_test::torus(24, 14, 0.35);
  hf_inner::surface::CoreOptions options;
  options.operator_kind = hf_inner::mesh::OperatorKind::clamped;
  const auto core = hf_test::make_core(mesh, 1, options);
  std::mt19937_64 random(5);
  std::vector<double> u(mesh.vertex_count());
  for (int set = 0; set < 1000; ++set) {
    hf_inner::field::ScalarField field(core, 1, 1000);
    const auto vertices = different_vertices(mesh.vertex_count(), 2 + random() % 9, random);
    std::vector<double> values;
    for (std::size_t i = 0; i < vertices.size(); ++i) values.push_back(static_cast<double>(random() % 1000) / 1000);
    values[0] = -1;
    values[1] = 2;
    add(field, vertices, values);
    field.solve(u.data());
    for (const auto& point : find(*core, u).points) {
      if (point.kind == CriticalKind::saddle) continue;
      ASSERT_TRUE(std::find(vertices.begin(), vertices.end(), static_cast<std::uint32_t>(point.vertex)) !=
                  vertices.end())
          << "set " << set << ": vertex " << point.vertex;
    }
  }
}

// The default operator's principle is one along its own, intrinsic edges: on the mesh's edges a vertex may seem an
// extremum that is none.
TEST(MaximumPrinciple, holds_along_the_edges_of_the_intrinsic_operator) {
  const PlainMesh mesh = hf_test::torus(24, 14, 0.35);
  const auto core = hf_test::make_core(mesh);
  ASSERT_GT(core->mesh.report.negative_edge_count, 100u);
  std::mt19937_64 random(5);
  std::vector<double> u(mesh.vertex_count());
  int seeming = 0;
  for (int set = 0; set < 200; ++set) {
    hf_inner::field::ScalarField field(core, 1, 1000);
    const auto vertices = different_vertices(mesh.vertex_count(), 10, random);
    std::vector<double> values;
    for (std::size_t i = 0; i < vertices.size(); ++i) values.push_back(static_cast<double>(random() % 1000) / 1000);
    add(field, vertices, values);
    field.solve(u.data());
    const auto is_site = [&](int v) {
      return std::find(vertices.begin(), vertices.end(), static_cast<std::uint32_t>(v)) != vertices.end();
    };
    const hf_inner::SymmetricMatrix& k = core->laplacian;
    for (std::int32_t v = 0; v < core->size(); ++v) {
      bool lower = false, higher = false;
      for (std::int32_t i = k.column_start[static_cast<std::size_t>(v)];
           i < k.column_start[static_cast<std::size_t>(v) + 1]; ++i) {
        const std::int32_t w = k.row[static_cast<std::size_t>(i)];
        if (w == v || k.value[static_cast<std::size_t>(i)] == 0) continue;
        lower = lower || u[static_cast<std::size_t>(w)] <= u[static_cast<std::size_t>(v)] + 1e-12;
        higher = higher || u[static_cast<std::size_t>(w)] >= u[static_cast<std::size_t>(v)] - 1e-12;
      }
      ASSERT_TRUE((lower && higher) || is_site(v)) << "set " << set << ", vertex " << v;
    }
    for (const auto& point : find(*core, u).points)
      seeming += point.kind != CriticalKind::saddle && !is_site(point.vertex);
  }
  RecordProperty("extrema_off_sites_on_mesh_edges", seeming);
  std::printf("%d extrema off the sites on the mesh's edges, 200 fields of 10 sites\n", seeming);
}

// ---- the paper's open question (docs/fields.md)

std::vector<double> solve(const std::shared_ptr<const hf_inner::surface::Core>& core, hf_test::EngineKind engine,
                          double stiffness, const std::vector<std::uint32_t>& vertices,
                          const std::vector<double>& values) {
  hf_inner::field::ScalarField field(core, 1, 100000, hf_test::make_engine(engine, core));
  hf_inner::field::FieldEdit edit;
  const std::vector<double> soft(vertices.size(), stiffness);
  edit.add.count = static_cast<std::uint32_t>(vertices.size());
  edit.add.vertices = vertices.data();
  edit.add_holds.values = values.data();
  if (stiffness > 0) edit.add_holds.stiffness = soft.data();
  field.edit(edit, nullptr);
  std::vector<double> u(static_cast<std::size_t>(core->size()));
  field.solve(u.data());
  return u;
}

bool same_points(const CriticalPoints& a, const CriticalPoints& b) {
  return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                    [](const hf_inner::field::CriticalPoint& p, const hf_inner::field::CriticalPoint& q) {
                      return p.vertex == q.vertex && p.kind == q.kind && p.index == q.index;
                    });
}

// No two of them neighbours: equal values next to each other are a tie, which anything decides.
std::vector<std::uint32_t> scattered_vertices(const hf_inner::surface::Core& core, std::size_t count,
                                              std::mt19937_64& random) {
  std::vector<std::uint32_t> vertices;
  while (vertices.size() < count) {
    const std::uint32_t v = static_cast<std::uint32_t>(random() % static_cast<std::uint64_t>(core.size()));
    const auto taken = [&](std::uint32_t w) {
      return std::find(vertices.begin(), vertices.end(), w) != vertices.end();
    };
    bool free = !taken(v);
    for (int i = core.topology().neighbour_start[v]; i < core.topology().neighbour_start[v + 1]; ++i)
      free = free && !taken(static_cast<std::uint32_t>(core.topology().neighbour[static_cast<std::size_t>(i)]));
    if (free) vertices.push_back(v);
  }
  return vertices;
}

TEST(CriticalPointsUnderPenalty, are_the_very_vertices_of_the_exact_field) {
  const PlainMesh meshes[] = {hf_test::from_shape(samples::jittered_torus(60, 60)),
                              hf_test::from_shape(samples::sphere(18)),
                              hf_test::from_shape(samples::bumpy_plane(60, 60)),
                              hf_test::from_shape(hf_test::cactus(3000)), hf_test::ladder(3, 0.14)};
  int sets = 0, changed_at_100 = 0, changed_at_1 = 0;
  for (int run = 0; run < 10; ++run) {
    const PlainMesh& mesh = meshes[run / 2];
    hf_inner::surface::CoreOptions options;  // the paper's operator and the default
    options.operator_kind =
        run % 2 ? hf_inner::mesh::OperatorKind::cotangent : hf_inner::mesh::OperatorKind::intrinsic_delaunay;
    const auto core = hf_test::make_core(mesh, 1, options);
    std::mt19937_64 random(7);
    for (const std::size_t count : {std::size_t{8}, std::size_t{64}}) {
      for (int kind = 0; kind < 3; ++kind, ++sets) {  // random values, two values, four values
        const auto vertices = scattered_vertices(*core, count, random);
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) {
          values.push_back(kind == 0   ? static_cast<double>(random() % 100000) / 1e5
                           : kind == 1 ? static_cast<double>(i % 2)
                                       : static_cast<double>(i % 4) / 3);
        }
        const CriticalPoints exact = find(*core, solve(core, hf_test::EngineKind::green, 0, vertices, values));
        for (const double alpha : {1e8, 1e6}) {
          const CriticalPoints soft = find(*core, solve(core, hf_test::EngineKind::green, alpha, vertices, values));
          EXPECT_TRUE(same_points(exact, soft)) << "alpha " << alpha << ", " << count << " sites, kind " << kind;
        }
        changed_at_100 +=
            !same_points(exact, find(*core, solve(core, hf_test::EngineKind::green, 100, vertices, values)));
        changed_at_1 += !same_points(exact, find(*core, solve(core, hf_test::EngineKind::green, 1, vertices, values)));
#ifdef HF_WITH_GPL
        EXPECT_TRUE(same_points(exact, find(*core, solve(core, hf_test::EngineKind::updown, 0, vertices, values))));
#endif
      }
    }
  }
  EXPECT_EQ(sets, 60);
  RecordProperty("changed_at_100", changed_at_100);
  RecordProperty("changed_at_1", changed_at_1);
  EXPECT_LT(changed_at_100, changed_at_1);
  EXPECT_GT(changed_at_1, 5);  // a weak penalty moves the values of the sites past one another
}

TEST(CriticalPointsUnderPenalty, differ_where_the_exact_field_is_flat) {
  // a closed ring of sites of one value: what is inside is constant in the exact field, and hides the differences
  // lambda / alpha of the sites in the soft one
  const PlainMesh mesh = hf_test::from_shape(samples::bumpy_plane(40, 40));
  const auto core = hf_test::make_core(mesh);
  std::vector<std::uint32_t> vertices;
  std::vector<double> values;
  const auto at = [](std::uint32_t i, std::uint32_t j) { return j * 40 + i; };
  for (std::uint32_t i = 8; i <= 16; ++i) {
    vertices.insert(vertices.end(), {at(i, 8), at(i, 16)});
    if (i > 8 && i < 16) vertices.insert(vertices.end(), {at(8, i), at(16, i)});
  }
  values.assign(vertices.size(), 1.0);
  vertices.push_back(at(32, 30));
  values.push_back(0.0);
  vertices.push_back(at(35, 5));
  values.push_back(0.3);
  const auto inside_range = [&](const std::vector<double>& u) {
    double low = 1e300, high = -1e300;
    for (std::uint32_t j = 8; j <= 16; ++j) {
      for (std::uint32_t i = 8; i <= 16; ++i) {
        low = std::min(low, u[at(i, j)]);
        high = std::max(high, u[at(i, j)]);
      }
    }
    return high - low;
  };
  const auto outside = [&](const std::vector<double>& u) {
    std::vector<int> found;
    for (const auto& point : find(*core, u).points) {
      const int i = point.vertex % 40, j = point.vertex / 40;
      if (i < 7 || i > 17 || j < 7 || j > 17) found.push_back(2 * point.vertex + (point.kind == CriticalKind::saddle));
    }
    return found;
  };
  const auto exact = solve(core, hf_test::EngineKind::green, 0, vertices, values);
  EXPECT_LT(inside_range(exact), 1e-12);
  for (const double alpha : {1e8, 1e4}) {
    const auto soft = solve(core, hf_test::EngineKind::green, alpha, vertices, values);
    EXPECT_GT(inside_range(soft), 1e-3 / alpha);
    EXPECT_LT(inside_range(soft), 10 / alpha);
    EXPECT_FALSE(same_points(find(*core, exact), find(*core, soft)));
    EXPECT_EQ(outside(exact), outside(soft));
  }
}

}  // namespace
