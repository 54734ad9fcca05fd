// With the intrinsic Delaunay operator a harmonic field has its extrema at its sites, on any triangle soup.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solve/site_solver.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

// How far fields of random site sets leave the range of their sites, as a share of it; per component.
double worst_overshoot(const hf_test::PlainMesh& mesh, hf_inner::mesh::OperatorKind kind, int rounds,
                       std::uint32_t seed) {
  hf_inner::surface::CoreOptions options;
  options.operator_kind = kind;
  const auto core = hf_test::make_core(mesh, 1, options);
  std::mt19937 random(seed);
  double worst = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto solver = hf_inner::solve::SiteSolver::make(core);
    const std::size_t count = 2 + random() % 12;
    std::vector<std::int32_t> slots, taken;
    std::vector<hf_inner::solve::Site> sites;
    std::vector<double> values;
    while (sites.size() < count) {
      const auto v = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(core->size()));
      if (std::find(taken.begin(), taken.end(), v) != taken.end()) continue;
      taken.push_back(v);
      slots.push_back(static_cast<std::int32_t>(sites.size()));
      sites.push_back(hf_inner::solve::Site::at_vertex(core->mesh, v));
      values.push_back(std::uniform_real_distribution<double>(-1, 1)(random));
    }
    hf_inner::solve::SiteEdit edit;
    edit.add = slots;
    edit.sites = sites;
    solver->edit(edit);
    std::vector<double> u(static_cast<std::size_t>(core->size()));
    solver->solve(values.data(), 1, u.data(), nullptr);
    for (std::int32_t v = 0; v < core->size(); ++v) {
      double low = 1e300, high = -1e300;
      for (std::size_t s = 0; s < sites.size(); ++s) {
        if (sites[s].component != core->mesh.component[static_cast<std::size_t>(v)]) continue;
        low = std::min(low, values[s]);
        high = std::max(high, values[s]);
      }
      const double x = u[static_cast<std::size_t>(v)];
      EXPECT_TRUE(std::isfinite(x));
      if (low <= high) worst = std::max({worst, x - high, low - x});
    }
  }
  return worst;
}

TEST(MaximumPrinciple, holds_for_a_thousand_random_site_sets_on_obtuse_and_non_manifold_surfaces) {
  const auto meshes = hf_test::dirty_meshes();
  const int rounds = 1 + 1000 / static_cast<int>(meshes.size());
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    SCOPED_TRACE(meshes[i].first);
    EXPECT_LE(worst_overshoot(meshes[i].second, hf_inner::mesh::OperatorKind::intrinsic_delaunay, rounds,
                              100 + static_cast<std::uint32_t>(i)),
              1e-11);
  }
}

TEST(MaximumPrinciple, fails_with_plain_cotangents_on_the_same_surfaces) {
  double worst = 0;
  const auto meshes = hf_test::dirty_meshes();
  for (std::size_t i = 0; i < 3; ++i)
    worst = std::max(worst, worst_overshoot(meshes[i].second, hf_inner::mesh::OperatorKind::cotangent, 30, 100));
  EXPECT_GT(worst, 1e-3);
}

}  // namespace
