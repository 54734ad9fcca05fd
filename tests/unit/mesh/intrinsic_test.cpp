// Intrinsic Delaunay triangulations: identities of the operator, on clean, obtuse, open and non-manifold surfaces.
#include "mesh/intrinsic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <random>

#include "base/index.h"
#include "mesh/delaunay_patches.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_test::PlainMesh;

struct Surface {
  explicit Surface(const PlainMesh& mesh, std::uint32_t threads = 1) : core(core_of(mesh, threads)) {
    triangulation.emplace(
        hf_inner::mesh::IntrinsicTriangulation::make(core->mesh, core->topology(), *core->memory, core->jobs.get()));
  }
  static std::shared_ptr<const hf_inner::surface::Core> core_of(const PlainMesh& mesh, std::uint32_t threads) {
    hf_inner::surface::CoreOptions options;
    options.operator_kind = hf_inner::mesh::OperatorKind::cotangent;
    options.need_factor = false;
    return hf_test::make_core(mesh, threads, options);
  }
  hf_inner::SymmetricMatrix laplacian() const {
    return triangulation->laplacian(core->size(), *core->memory, core->jobs.get());
  }
  std::shared_ptr<const hf_inner::surface::Core> core;
  std::optional<hf_inner::mesh::IntrinsicTriangulation> triangulation;
};

using Entries = std::map<std::pair<int, int>, double>;
Entries entries_of(const hf_inner::SymmetricMatrix& k) {
  Entries entries;
  for (std::int32_t v = 0; v < k.size(); ++v) {
    for (std::int32_t i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i)
      entries[{v, k.row[at(i)]}] = k.value[at(i)];
  }
  return entries;
}
double value_of(const Entries& entries, int i, int j) {
  const auto found = entries.find({i, j});
  return found == entries.end() ? 0.0 : found->second;
}
double largest_difference(const Entries& a, const Entries& b) {
  double worst = 0;
  for (const auto& [ij, value] : a) worst = std::max(worst, std::fabs(value - value_of(b, ij.first, ij.second)));
  for (const auto& [ij, value] : b) worst = std::max(worst, std::fabs(value - value_of(a, ij.first, ij.second)));
  return worst;
}

double energy(const hf_inner::SymmetricMatrix& k, const std::vector<double>& u) {
  double sum = 0;
  for (const auto& [ij, value] : entries_of(k))
    sum += value * u[static_cast<std::size_t>(ij.first)] * u[static_cast<std::size_t>(ij.second)];
  return sum;
}

TEST(Topology, sides_name_their_corner_and_direction) {
  for (const PlainMesh& mesh : {hf_test::turned_over(hf_test::grid(5, 4), 3), hf_test::book(3, 4, 3, 0.2)}) {
    const std::shared_ptr<const hf_inner::surface::Core> core = Surface::core_of(mesh, 1);
    const hf_inner::mesh::Topology& topology = core->topology();
    std::vector<int> seen(core->mesh.corners.size(), 0);
    for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
      for (std::int32_t i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i) {
        const std::int32_t c = topology.corner(i), t = topology.triangle(i);
        const std::int32_t from = core->mesh.triangle(t)[c % 3], to = core->mesh.triangle(t)[(c + 1) % 3];
        EXPECT_EQ(t, c / 3);
        EXPECT_EQ(from, topology.forward(i) ? topology.first(e) : topology.second(e));
        EXPECT_EQ(to, topology.forward(i) ? topology.second(e) : topology.first(e));
        ++seen[at(c)];
      }
    }
    EXPECT_EQ(seen, std::vector<int>(seen.size(), 1)) << "every side of every triangle once";
  }
}

// Large enough that every thread puts a part of the sides into rows.
TEST(Topology, is_the_same_on_several_threads_and_lists_neighbours_in_order) {
  const PlainMesh mesh = hf_test::torus(250, 200);
  const std::shared_ptr<const hf_inner::surface::Core> core = Surface::core_of(mesh, 1);
  const auto make = [&](std::uint32_t threads) {
    hf_inner::JobRunner jobs(threads);
    return hf_inner::mesh::Topology::make(core->mesh, *core->memory, &jobs);
  };
  const hf_inner::mesh::Topology one = make(1);
  EXPECT_EQ(one.edge_count(), 3 * 50000);
  for (const std::uint32_t threads : {2u, 3u, 8u}) {
    const hf_inner::mesh::Topology other = make(threads);
    EXPECT_EQ(one.edges, other.edges);
    EXPECT_EQ(one.edge_triangle_start, other.edge_triangle_start);
    EXPECT_EQ(one.edge_side, other.edge_side);
    EXPECT_EQ(one.neighbour_start, other.neighbour_start);
    EXPECT_EQ(one.neighbour, other.neighbour);
    EXPECT_EQ(one.neighbour_edge, other.neighbour_edge);
  }
  std::int32_t wrong = 0;
  for (std::int32_t v = 0; v < core->size(); ++v) {
    for (std::int32_t k = one.neighbour_start[at(v)]; k < one.neighbour_start[at(v) + 1]; ++k) {
      const std::int32_t u = one.neighbour[at(k)], e = one.neighbour_edge[at(k)];
      wrong += one.first(e) != std::min(u, v) || one.second(e) != std::max(u, v);
      wrong += k > one.neighbour_start[at(v)] && one.neighbour[at(k) - 1] >= u;
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(Intrinsic, weights_are_never_negative_and_every_edge_is_delaunay) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    SCOPED_TRACE(name);
    Surface surface(mesh);
    surface.triangulation->flip_to_delaunay();
    for (std::int32_t h = 0; h < 3 * surface.triangulation->face_count(); ++h) {
      EXPECT_EQ(surface.triangulation->twin(surface.triangulation->twin(h)), h);
      EXPECT_EQ(surface.triangulation->length(surface.triangulation->twin(h)), surface.triangulation->length(h));
      const double a = surface.triangulation->cotangent(h),
                   b = surface.triangulation->cotangent(surface.triangulation->twin(h));
      EXPECT_GE(a + b, -1e-9 * (1 + std::fabs(a) + std::fabs(b)));
    }
    const hf_inner::SymmetricMatrix k = surface.laplacian();
    for (std::int32_t v = 0; v < k.size(); ++v) {
      double sum = 0, diagonal = 0;
      for (std::int32_t i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) {
        if (k.row[at(i)] == v) {
          diagonal = k.value[at(i)];
        } else {
          EXPECT_LE(k.value[at(i)], 0.0) << "row " << v;
          EXPECT_EQ(k.value[at(i)], value_of(entries_of(k), k.row[at(i)], v));
        }
        EXPECT_TRUE(std::isfinite(k.value[at(i)]));
        sum += k.value[at(i)];
      }
      EXPECT_GT(diagonal, 0.0);
      EXPECT_LE(std::fabs(sum), 1e-14 * diagonal);
    }
  }
}

TEST(Intrinsic, is_the_cotangent_laplacian_where_the_mesh_is_delaunay_already) {
  for (const PlainMesh& mesh : {hf_test::sphere(12), hf_test::disk(9)}) {
    Surface surface(mesh);
    ASSERT_EQ(surface.core->mesh.report.negative_edge_count, 0u);
    EXPECT_EQ(surface.triangulation->flip_to_delaunay(), 0u);
    EXPECT_LE(largest_difference(entries_of(surface.laplacian()), entries_of(surface.core->laplacian)), 1e-14);
  }
}

TEST(Intrinsic, annihilates_linear_functions_inside_a_sheared_flat_patch) {
  PlainMesh mesh = hf_test::grid(30, 30, 1, 0.3, 4);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] += 2 * mesh.positions[i + 1];
  Surface surface(mesh);
  EXPECT_GT(surface.triangulation->flip_to_delaunay(), 500u);
  const hf_inner::SymmetricMatrix k = surface.laplacian();
  std::vector<double> residual(at(k.size()), 0.0);
  for (const auto& [ij, value] : entries_of(k)) {
    const hf_inner::Vec3 p = surface.core->mesh.positions[static_cast<std::size_t>(ij.second)];
    residual[static_cast<std::size_t>(ij.first)] += value * (1 + 3 * p.x - 2 * p.y);
  }
  for (int j = 8; j <= 22; ++j) {
    for (int i = 8; i <= 22; ++i) EXPECT_LE(std::fabs(residual[static_cast<std::size_t>(j * 31 + i)]), 1e-12);
  }
}

TEST(Intrinsic, flips_keep_the_area) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    SCOPED_TRACE(name);
    Surface surface(mesh);
    const auto area = [&] {
      const hf_inner::Vector<double> areas =
          surface.triangulation->vertex_areas(surface.core->mesh, surface.core->topology(), *surface.core->memory);
      return std::accumulate(areas.begin(), areas.end(), 0.0);
    };
    const double whole = area();
    surface.triangulation->flip_to_delaunay();
    const double thin = surface.triangulation->mollified_count() > 0 ? 1e-3 : 1e-11;
    EXPECT_NEAR(area(), whole, thin * whole);
    if (name == "strip on a line") continue;  // its own triangles have no area
    double own = 0;
    for (const double a : hf_inner::mesh::vertex_areas(surface.core->mesh, *surface.core->memory)) own += a;
    EXPECT_NEAR(area(), own, thin * whole);
  }
}

TEST(Intrinsic, energy_is_at_most_that_of_the_cotangent_operator) {
  const PlainMesh mesh = hf_test::torus(30, 20, 0.4, 9);
  Surface surface(mesh);
  EXPECT_GT(surface.triangulation->flip_to_delaunay(), 0u);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> u(at(surface.core->size()));
    for (double& x : u) x = value(random);
    EXPECT_LT(energy(surface.laplacian(), u), energy(surface.core->laplacian, u));
  }
}

TEST(Intrinsic, is_the_same_under_renumbering_and_rotation) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    if (!hf_test::is_generic(name)) continue;
    SCOPED_TRACE(name);
    Surface first(mesh);
    first.triangulation->flip_to_delaunay();
    const Entries expected = entries_of(first.laplacian());
    double size = 0;
    for (const auto& entry : expected) size = std::max(size, std::fabs(entry.second));
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      std::vector<std::uint32_t> place;
      const PlainMesh moved = hf_test::shuffled_and_rotated(mesh, seed, place);
      Surface second(moved);
      second.triangulation->flip_to_delaunay();
      Entries back;
      std::vector<int> old(place.size());
      for (std::size_t v = 0; v < place.size(); ++v) old[place[v]] = static_cast<int>(v);
      for (const auto& [ij, value] : entries_of(second.laplacian())) {
        const auto given = [&](int inner) {
          return first.core->mesh.inner_of_given[static_cast<std::size_t>(
              old[static_cast<std::size_t>(second.core->mesh.given_of_inner[static_cast<std::size_t>(inner)])])];
        };
        back[{given(ij.first), given(ij.second)}] = value;
      }
      EXPECT_LE(largest_difference(expected, back), 1e-9 * size) << "seed " << seed;
    }
  }
}

// Triangles between points of a small lattice: many edges have several at one angle, and many quads lie on a circle.
PlainMesh lattice_soup(std::uint32_t seed) {
  constexpr std::uint32_t points = 12, count = 45;
  PlainMesh mesh;
  std::mt19937 random(seed);
  std::vector<std::uint32_t> place(27);
  std::iota(place.begin(), place.end(), 0u);
  std::shuffle(place.begin(), place.end(), random);
  for (std::uint32_t v = 0; v < points; ++v)
    mesh.positions.insert(mesh.positions.end(), {double(place[v] % 3), double(place[v] / 3 % 3), double(place[v] / 9)});
  while (mesh.triangle_count() < count) {
    const std::uint32_t a = random() % points, b = random() % points, c = random() % points;
    if (a != b && b != c && c != a) mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
  }
  return mesh;
}

// The Laplacian and, on its diagonal, one more for the vertex areas, by numbers as given.
std::pair<Entries, Entries> operator_as_given(const PlainMesh& mesh, const std::vector<std::uint32_t>& old) {
  Surface surface(mesh);
  surface.triangulation->flip_to_delaunay();
  const auto given = [&](int inner) {
    return static_cast<int>(old[static_cast<std::size_t>(surface.core->mesh.given_of_inner[at(inner)])]);
  };
  std::pair<Entries, Entries> out;
  for (const auto& [ij, value] : entries_of(surface.laplacian()))
    out.first[{given(ij.first), given(ij.second)}] = value;
  const auto areas =
      surface.triangulation->vertex_areas(surface.core->mesh, surface.core->topology(), *surface.core->memory);
  for (int v = 0; v < surface.core->size(); ++v) out.second[{given(v), given(v)}] = areas[at(v)];
  return out;
}

TEST(Intrinsic, does_not_depend_on_orders_where_triangles_lie_on_one_another) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const PlainMesh mesh = lattice_soup(seed);
    std::vector<std::uint32_t> same(mesh.vertex_count());
    std::iota(same.begin(), same.end(), 0u);
    const auto expected = operator_as_given(mesh, same);
    for (std::uint32_t order = 1; order <= 6; ++order) {
      std::mt19937 random(order);
      PlainMesh copy = mesh;
      std::vector<std::uint32_t> old = same;
      if (order % 2) std::shuffle(old.begin(), old.end(), random);
      for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
        for (std::uint32_t k = 0; k < 3; ++k) copy.positions[3 * v + k] = mesh.positions[3 * old[v] + k];
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
          if (mesh.triangles[i] == old[v]) copy.triangles[i] = v;
        }
      }
      for (std::uint32_t t = copy.triangle_count(); t-- > 0;) {
        const std::uint32_t other = random() % (t + 1), turn = random() % 3;
        std::swap_ranges(&copy.triangles[3 * t], &copy.triangles[3 * t] + 3, &copy.triangles[3 * other]);
        std::rotate(&copy.triangles[3 * t], &copy.triangles[3 * t] + turn, &copy.triangles[3 * t] + 3);
      }
      const auto found = operator_as_given(copy, old);
      EXPECT_LE(largest_difference(expected.first, found.first), 1e-11);
      EXPECT_LE(largest_difference(expected.second, found.second), 1e-12);
    }
  }
}

TEST(Intrinsic, gives_the_same_bits_for_any_number_of_threads) {
  const PlainMesh mesh = hf_test::torus(300, 120, 0.4);
  std::vector<double> first;
  for (const std::uint32_t threads : {1u, 2u, 4u}) {
    Surface surface(mesh, threads);
    surface.triangulation->flip_to_delaunay();
    const hf_inner::SymmetricMatrix k = surface.laplacian();
    const std::vector<double> value(k.value.begin(), k.value.end());
    if (first.empty()) first = value;
    EXPECT_EQ(first, value);
  }
}

// Two cones of many triangles, one on the other; without the lower one: an open fan, whose edges are parallel in pairs.
PlainMesh cones(std::uint32_t count, bool closed) {
  PlainMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979 * i / count;
    mesh.positions.insert(mesh.positions.end(), {std::cos(angle), 0.02 * (i % 7), std::sin(angle)});
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.insert(mesh.triangles.end(), {next, i, count});
    if (closed) mesh.triangles.insert(mesh.triangles.end(), {i, next, count + 1});
  }
  mesh.positions.insert(mesh.positions.end(), {0, 1, 0});
  if (closed) mesh.positions.insert(mesh.positions.end(), {0, -1, 0});
  return mesh;
}

TEST(Intrinsic, laplacian_is_the_sum_over_its_edges_in_short_and_long_rows) {
  for (int i = 0; i < 6; ++i) {
    Surface surface(i < 2 ? hf_test::grid(9, 7, 1, 0.3) : cones(100, i < 4), 2);
    if (i % 2 == 0) surface.triangulation->flip_to_delaunay();
    const hf_inner::mesh::IntrinsicTriangulation& t = *surface.triangulation;
    Entries wanted;
    for (std::int32_t h = 0; h < 3 * t.face_count(); ++h) {
      const double w = t.share(h / 3) * std::max(0.0, t.edge_weight(h));
      if (t.tail(h) == t.head(h)) continue;
      wanted[{t.tail(h), t.head(h)}] -= w;
      wanted[{t.tail(h), t.tail(h)}] += w;
    }
    const hf_inner::SymmetricMatrix k = surface.laplacian();
    const Entries found = entries_of(k);
    EXPECT_LT(largest_difference(found, wanted), 1e-12);
    for (std::int32_t v = 0; v < k.size(); ++v) {
      const auto end = k.row.begin() + k.column_start[at(v) + 1];
      EXPECT_EQ(std::adjacent_find(k.row.begin() + k.column_start[at(v)], end, std::greater_equal<>()), end)
          << "a column twice, or not in order, in row " << v;
      for (std::int32_t i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i)
        EXPECT_EQ(k.value[at(i)], value_of(found, k.row[at(i)], v)) << "not symmetric";
    }
  }
}

TEST(Intrinsic, takes_a_closed_surface_once_and_an_open_one_twice) {
  const Surface closed(hf_test::torus(10, 8)), open(hf_test::grid(5, 4));
  EXPECT_EQ(closed.triangulation->face_count(), closed.core->mesh.triangle_count());
  EXPECT_EQ(open.triangulation->face_count(), 2 * open.core->mesh.triangle_count());
}

TEST(Intrinsic, stopped_early_it_still_has_no_negative_weight) {
  PlainMesh mesh = hf_test::grid(20, 20, 1, 0.3);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] += 4 * mesh.positions[i + 1];
  Surface surface(mesh);
  EXPECT_EQ(surface.triangulation->flip_to_delaunay(7), 7u);
  for (const auto& [ij, value] : entries_of(surface.laplacian())) {
    if (ij.first != ij.second) {
      EXPECT_LE(value, 0.0);
    }
  }
}

// The operator by patches and the one of the whole triangulation, and how many triangles the patches took.
struct TwoWays {
  explicit TwoWays(const PlainMesh& mesh, std::uint32_t threads = 1) : surface(mesh, threads) {
    const hf_inner::surface::Core& core = *surface.core;
    patches.emplace(hf_inner::mesh::delaunay_operator(core.mesh, core.topology(), core.weights(), true, *core.memory,
                                                      core.jobs.get()));
    flips = surface.triangulation->flip_to_delaunay();
  }
  double share() const { return patches->patch_triangles / static_cast<double>(surface.core->mesh.triangle_count()); }
  Surface surface;
  std::optional<hf_inner::mesh::DelaunayOperator> patches;
  std::uint64_t flips = 0;
};

// Bumps that make some triangles obtuse, here and there.
PlainMesh with_folds(PlainMesh mesh, int count, double height, std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int i = 0; i < count; ++i) {
    const std::size_t v = random() % mesh.vertex_count();
    for (std::size_t k = 0; k < 3; ++k)
      mesh.positions[3 * v + k] += height * std::uniform_real_distribution<double>(-1, 1)(random);
  }
  return mesh;
}

TEST(DelaunayPatches, give_the_operator_and_areas_of_the_whole_triangulation) {
  std::vector<std::pair<std::string, PlainMesh>> meshes = hf_test::dirty_meshes();
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const std::string number = std::to_string(seed);
    // spread out so far that a few patches are the rule, many enough that flips run into their borders
    meshes.emplace_back("sphere " + number, with_folds(hf_test::sphere(40), 25, 0.05, seed));
    meshes.emplace_back("open disk " + number, with_folds(hf_test::disk(40), 25, 0.03, seed));
    meshes.emplace_back("book " + number, with_folds(hf_test::book(3, 40, 40, 0.0), 25, 0.03, seed));
    meshes.emplace_back("turned over " + number,
                        with_folds(hf_test::turned_over(hf_test::sphere(40), 97), 25, 0.05, seed));
    // a long thin fold: flips spread far from the edges that are broken at the start
    PlainMesh folded = hf_test::grid(60, 60, 1, 0.1, seed);
    for (std::size_t i = 0; i < folded.positions.size(); i += 3) {
      const double x = folded.positions[i], y = folded.positions[i + 1];
      if (y > 28 && y < 32) folded.positions[i] = x + 3 * (y - 28) * (seed / 6.0);
    }
    meshes.emplace_back("slid " + number, std::move(folded));
  }
  int by_patches = 0, beyond = 0;
  for (const auto& [name, mesh] : meshes) {
    SCOPED_TRACE(name);
    const TwoWays ways(mesh);
    const hf_inner::surface::Core& core = *ways.surface.core;
    const Entries whole = entries_of(ways.surface.laplacian()), patched = entries_of(ways.patches->laplacian);
    double size = 0;
    for (const auto& entry : whole) size = std::max(size, std::fabs(entry.second));
    EXPECT_LE(largest_difference(whole, patched), 1e-9 * size);
    const hf_inner::Vector<double> areas =
        ways.surface.triangulation->vertex_areas(core.mesh, core.topology(), *core.memory);
    double largest = 0, worst = 0;
    for (const double a : areas) largest = std::max(largest, a);
    if (hf_test::is_generic(name) || name.find("disk") != std::string::npos || name.find("sphere") == 0) {
      // where two diagonals serve, areas depend on which is taken
      for (std::size_t v = 0; v < areas.size(); ++v)
        worst = std::max(worst, std::fabs(areas[v] - ways.patches->areas[v]));
      EXPECT_LE(worst, 1e-9 * largest);
    }
    by_patches += ways.share() > 0 && ways.share() < 0.3;
    beyond += ways.flips > 0 && ways.share() < 0.3;
    for (const auto& [ij, value] : patched) {
      if (ij.first != ij.second) {
        ASSERT_LE(value, 0.0);
        ASSERT_EQ(value, value_of(patched, ij.second, ij.first)) << "symmetric to the bit";
      }
    }
  }
  EXPECT_GE(by_patches, 15);
  EXPECT_GE(beyond, 15);
}

// Points on an arc that bends a little more than a circle, triangulated by halving the arc, and a point inside the
// circle beyond the chord: only the chord is not Delaunay, but its flip makes the next edges so, and in the end all
// points hang on the point inside.
PlainMesh halved_arc(std::uint32_t halvings) {
  const std::uint32_t last = 1u << halvings;
  PlainMesh mesh;
  mesh.positions.assign(3 * (std::size_t{last} + 2), 0.0);
  const auto put = [&](std::uint32_t i, double x, double y) {
    mesh.positions[3 * std::size_t{i}] = x;
    mesh.positions[3 * std::size_t{i} + 1] = y;
  };
  put(0, std::cos(0.5), std::sin(0.5));
  put(last, std::cos(2.5), std::sin(2.5));
  put(last + 1, 0.05, 0.2);
  mesh.triangles = {0, last, last + 1};
  for (std::uint32_t step = last; step > 1; step /= 2) {
    for (std::uint32_t i = 0; i < last; i += step) {
      mesh.triangles.insert(mesh.triangles.end(), {i, i + step / 2, i + step});
      const double *a = &mesh.positions[3 * std::size_t{i}], *b = &mesh.positions[3 * std::size_t{i + step}];
      const double x = 0.5 * (a[0] + b[0]), y = 0.5 * (a[1] + b[1]), dx = b[0] - a[0], dy = b[1] - a[1];
      const double turn = std::tan(0.25 * 2.0 * step / last) / 2 * 1.001;  // height over chord: tan(angle / 4) / 2
      put(i + step / 2, x + turn * dy, y - turn * dx);
    }
  }
  return mesh;
}

TEST(DelaunayPatches, grow_as_far_as_the_flips_reach) {
  PlainMesh mesh = halved_arc(12);
  hf_test::append(mesh, hf_test::sphere(70), 4);
  const TwoWays ways(mesh);
  EXPECT_GT(ways.flips, 2u * 4000u);  // front and back
  EXPECT_GT(ways.patches->patch_triangles, 4000);
  EXPECT_LT(ways.share(), 0.25);
  const Entries whole = entries_of(ways.surface.laplacian());
  double size = 0;
  for (const auto& entry : whole) size = std::max(size, std::fabs(entry.second));
  EXPECT_LE(largest_difference(whole, entries_of(ways.patches->laplacian)), 1e-12 * size);
}

TEST(DelaunayPatches, leave_a_delaunay_mesh_its_cotangent_bits) {
  for (const PlainMesh& mesh : {hf_test::sphere(12), hf_test::disk(9)}) {
    const TwoWays ways(mesh);
    EXPECT_EQ(ways.patches->patch_triangles, 0);
    const hf_inner::SymmetricMatrix& cotangent = ways.surface.core->laplacian;
    EXPECT_TRUE(ways.patches->laplacian.column_start == cotangent.column_start);
    EXPECT_TRUE(ways.patches->laplacian.row == cotangent.row);
    EXPECT_TRUE(ways.patches->laplacian.value == cotangent.value);
  }
}

TEST(DelaunayPatches, give_the_same_bits_for_any_number_of_threads) {
  const PlainMesh mesh = with_folds(hf_test::sphere(90), 60, 0.02, 3);
  std::vector<double> first;
  for (const std::uint32_t threads : {1u, 2u, 4u}) {
    const TwoWays ways(mesh, threads);
    EXPECT_GT(ways.patches->patch_triangles, 0);
    EXPECT_LT(ways.share(), 0.25);
    const auto& k = ways.patches->laplacian.value;
    const std::vector<double> value(k.begin(), k.end());
    if (first.empty()) first = value;
    EXPECT_EQ(first, value);
  }
}

}  // namespace
