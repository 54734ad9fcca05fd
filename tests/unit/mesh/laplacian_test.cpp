// The Laplacian: identities, not recorded numbers.
#include "mesh/laplacian.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/meshes.h"

namespace {

double largest_row_sum(const hf_inner::SymmetricMatrix& k) {
  double worst = 0;
  for (std::int32_t v = 0; v < k.size(); ++v) {
    double sum = 0, size = 0;
    for (std::int32_t i = k.column_start[static_cast<std::size_t>(v)];
         i < k.column_start[static_cast<std::size_t>(v) + 1]; ++i) {
      sum += k.value[static_cast<std::size_t>(i)];
      size += std::fabs(k.value[static_cast<std::size_t>(i)]);
    }
    worst = std::max(worst, std::fabs(sum) / size);
  }
  return worst;
}

std::vector<double> times(const hf_inner::SymmetricMatrix& k, const std::vector<double>& u) {
  std::vector<double> out(u.size(), 0.0);
  for (std::int32_t v = 0; v < k.size(); ++v) {
    for (std::int32_t i = k.column_start[static_cast<std::size_t>(v)];
         i < k.column_start[static_cast<std::size_t>(v) + 1]; ++i) {
      out[static_cast<std::size_t>(v)] +=
          k.value[static_cast<std::size_t>(i)] * u[static_cast<std::size_t>(k.row[static_cast<std::size_t>(i)])];
    }
  }
  return out;
}

TEST(Laplacian, annihilates_constants_and_is_symmetric) {
  for (const hf_inner::mesh::OperatorKind kind :
       {hf_inner::mesh::OperatorKind::cotangent, hf_inner::mesh::OperatorKind::clamped,
        hf_inner::mesh::OperatorKind::uniform}) {
    hf_inner::surface::CoreOptions options;
    options.operator_kind = kind;
    const auto core = hf_test::make_core(hf_test::torus(20, 15, 0.3), 1, options);
    const hf_inner::SymmetricMatrix& k = core->laplacian;
    EXPECT_LE(largest_row_sum(k), 1e-15);
    for (std::int32_t v = 0; v < k.size(); ++v) {
      EXPECT_TRUE(std::is_sorted(k.row.begin() + k.column_start[static_cast<std::size_t>(v)],
                                 k.row.begin() + k.column_start[static_cast<std::size_t>(v) + 1]));
      for (std::int32_t i = k.column_start[static_cast<std::size_t>(v)];
           i < k.column_start[static_cast<std::size_t>(v) + 1]; ++i) {
        const std::int32_t w = k.row[static_cast<std::size_t>(i)];
        const auto begin = k.row.begin() + k.column_start[static_cast<std::size_t>(w)],
                   end = k.row.begin() + k.column_start[static_cast<std::size_t>(w) + 1];
        const auto twin = std::lower_bound(begin, end, v);
        ASSERT_TRUE(twin != end && *twin == v);
        EXPECT_EQ(k.value[static_cast<std::size_t>(twin - k.row.begin())], k.value[static_cast<std::size_t>(i)]);
      }
    }
  }
}

TEST(Laplacian, annihilates_linear_functions_inside_a_flat_patch) {
  const auto core = hf_test::make_core(hf_test::grid(12, 9, 1, 0.35, 5));
  std::vector<double> u;
  for (const hf_inner::Vec3& p : core->mesh.positions) u.push_back(0.3 + 2 * p.x - 5 * p.y);
  const std::vector<double> ku = times(core->laplacian, u);
  for (std::size_t v = 0; v < u.size(); ++v) {
    const std::size_t i = v % 13, j = v / 13;
    if (i > 0 && i < 12 && j > 0 && j < 9) {
      EXPECT_LE(std::fabs(ku[v]), 1e-13);
    }
  }
}

TEST(Laplacian, energy_is_the_dirichlet_energy_of_a_linear_function) {
  const auto core = hf_test::make_core(hf_test::grid(7, 11, 1, 0.3, 9));
  std::vector<double> u;
  for (const hf_inner::Vec3& p : core->mesh.positions) u.push_back(3 * p.x + 4 * p.y);
  const std::vector<double> ku = times(core->laplacian, u);
  double energy = 0, area = 0;
  for (std::size_t v = 0; v < u.size(); ++v) energy += u[v] * ku[v];
  for (const double a : hf_inner::mesh::vertex_areas(core->mesh, *core->memory)) area += a;
  EXPECT_NEAR(energy, 25 * area, 1e-12);
}

TEST(Laplacian, stays_finite_and_factors_on_zero_area_triangles) {
  hf_test::PlainMesh strip;  // eighteen triangles on one line
  for (int i = 0; i < 20; ++i) strip.positions.insert(strip.positions.end(), {double(i), 0.0, 0.0});
  for (std::uint32_t i = 0; i + 2 < 20; ++i) strip.triangles.insert(strip.triangles.end(), {i, i + 1, i + 2});
  const auto core = hf_test::make_core(strip);
  EXPECT_EQ(core->mesh.report.degenerate_triangle_count, 18u);
  for (const double w : core->weights()) EXPECT_TRUE(std::isfinite(w));
}

TEST(Laplacian, clamped_weights_are_positive_on_obtuse_meshes) {
  hf_test::PlainMesh mesh = hf_test::grid(20, 3);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] += 3 * mesh.positions[i + 1];  // sheared
  hf_inner::surface::CoreOptions options;
  options.operator_kind = hf_inner::mesh::OperatorKind::clamped;
  const auto core = hf_test::make_core(mesh, 1, options);
  EXPECT_GT(core->mesh.report.negative_edge_count, 0u);
  for (const double w : core->weights()) EXPECT_GT(w, 0);
}

}  // namespace
