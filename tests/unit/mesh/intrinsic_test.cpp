// Intrinsic Delaunay triangulations: identities of the operator, on clean, obtuse, open and non-manifold surfaces.
#include "mesh/intrinsic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

using hf_test::PlainMesh;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Surface {
  explicit Surface(const PlainMesh& mesh, std::uint32_t threads = 1) : core(core_of(mesh, threads)) {
    triangulation.emplace(
        hf::IntrinsicTriangulation::make(core->mesh, core->topology, *core->memory, core->jobs.get()));
  }
  static std::shared_ptr<const hf::Core> core_of(const PlainMesh& mesh, std::uint32_t threads) {
    hf::CoreOptions options;
    options.operator_kind = hf::OperatorKind::cotangent, options.need_factor = false;
    return hf_test::make_core(mesh, threads, options);
  }
  hf::SymmetricMatrix laplacian() const {
    return triangulation->laplacian(core->size(), *core->memory, core->jobs.get());
  }
  std::shared_ptr<const hf::Core> core;
  std::optional<hf::IntrinsicTriangulation> triangulation;
};

using Entries = std::map<std::pair<int, int>, double>;
Entries entries_of(const hf::SymmetricMatrix& k) {
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

double energy(const hf::SymmetricMatrix& k, const std::vector<double>& u) {
  double sum = 0;
  for (const auto& [ij, value] : entries_of(k))
    sum += value * u[static_cast<std::size_t>(ij.first)] * u[static_cast<std::size_t>(ij.second)];
  return sum;
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
    const hf::SymmetricMatrix k = surface.laplacian();
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
  const hf::SymmetricMatrix k = surface.laplacian();
  std::vector<double> residual(at(k.size()), 0.0);
  for (const auto& [ij, value] : entries_of(k)) {
    const hf::Vec3 p = surface.core->mesh.positions[static_cast<std::size_t>(ij.second)];
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
      const hf::Vector<double> areas = surface.triangulation->vertex_areas(surface.core->size(), *surface.core->memory);
      return std::accumulate(areas.begin(), areas.end(), 0.0);
    };
    const double whole = area();
    surface.triangulation->flip_to_delaunay();
    const double thin = surface.triangulation->mollified_count() > 0 ? 1e-3 : 1e-11;
    EXPECT_NEAR(area(), whole, thin * whole);
    if (name == "strip on a line") continue;  // its own triangles have no area
    double own = 0;
    for (const double a : hf::vertex_areas(surface.core->mesh, *surface.core->memory)) own += a;
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

TEST(Intrinsic, gives_the_same_bits_for_any_number_of_threads) {
  const PlainMesh mesh = hf_test::torus(300, 120, 0.4);
  std::vector<double> first;
  for (const std::uint32_t threads : {1u, 2u, 4u}) {
    Surface surface(mesh, threads);
    surface.triangulation->flip_to_delaunay();
    const hf::SymmetricMatrix k = surface.laplacian();
    const std::vector<double> value(k.value.begin(), k.value.end());
    if (first.empty()) first = value;
    EXPECT_EQ(first, value);
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

}  // namespace
