// Screened fields against a dense solve: islands with and without screening, sites on both, weights made positive, and
// the harmonic limit.
#include "solve/screened.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "base/index.h"
#include "support/dense.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::solve::ScreenedOperator;
using hf_inner::solve::Site;

// Two islands: a jittered grid and a torus beside it.
hf_test::PlainMesh two_islands() {
  hf_test::PlainMesh mesh = hf_test::grid(9, 7, 1, 0.3);
  hf_test::append(mesh, hf_test::torus(12, 7), 20);
  return mesh;
}

struct Scene {
  std::shared_ptr<const hf_inner::surface::Core> core = hf_test::make_core(two_islands(), 2);
  std::vector<double> screening, wish;  // wish: two channels
  Scene(bool both, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> one(0, 1);
    for (Index v = 0; v < core->size(); ++v) {
      const bool here = both || core->mesh.component[at(v)] == 0;
      screening.push_back(here && random() % 3 == 0 ? 200 * one(random) : 0.0);
      wish.push_back(one(random));
      wish.push_back(one(random));
    }
  }
  std::vector<double> solve(const ScreenedOperator& a) const {
    std::vector<double> u(2 * at(core->size()));
    a.solve(2, u.data(), 2, [&](Index v, Index first, Index count, double* p) {
      for (Index c = 0; c < count; ++c) p[c] = wish[2 * at(v) + at(first + c)];
    });
    return u;
  }
};

// The whole saddle-point system; islands without screening and sites stay 0.
Eigen::MatrixXd dense(const Scene& scene, const ScreenedOperator& a, const std::vector<Site>& sites,
                      const Eigen::MatrixXd& values) {
  const int n = scene.core->size(), k = static_cast<int>(sites.size());
  std::vector<int> reached(at(scene.core->mesh.component_count()), 0);
  for (int v = 0; v < n; ++v) reached[at(scene.core->mesh.component[at(v)])] |= scene.screening[at(v)] > 0;
  for (const Site& site : sites) reached[at(site.component)] = 1;
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n + k, n + k), b = Eigen::MatrixXd::Zero(n + k, 2);
  for (int v = 0; v < n; ++v) {
    if (!reached[at(scene.core->mesh.component[at(v)])]) {
      m(v, v) = 1;
      continue;
    }
    for (int i = a.matrix.column_start[at(v)]; i < a.matrix.column_start[at(v) + 1]; ++i)
      m(v, a.matrix.row[at(i)]) = a.matrix.value[at(i)];
    const double mass = scene.core->areas[at(v)] * scene.screening[at(v)];
    for (int c = 0; c < 2; ++c) b(v, c) = mass * scene.wish[2 * at(v) + at(c)];
  }
  for (int i = 0; i < k; ++i) {
    for (int q = 0; q < 3; ++q) {
      if (sites[at(i)].vertex[q] < 0) continue;
      m(sites[at(i)].vertex[q], n + i) -= sites[at(i)].weight[q];
      m(n + i, sites[at(i)].vertex[q]) += sites[at(i)].weight[q];
    }
    m(n + i, n + i) = sites[at(i)].compliance / scene.core->mean_diagonal[at(sites[at(i)].component)];
    b.row(n + i) = values.row(i);
  }
  return hf_test::DenseSolver(m, hf_test::DenseSolver::full).solve(b).topRows(n);
}

double worst(const std::vector<double>& u, const Eigen::MatrixXd& exact) {
  double most = 0;
  for (int v = 0; v < exact.rows(); ++v) {
    for (int c = 0; c < 2; ++c) most = std::max(most, std::fabs(u[2 * at(v) + at(c)] - exact(v, c)));
  }
  return most;
}

TEST(Screened, SolvesTheDenseSystem) {
  for (const bool both : {true, false}) {
    const Scene scene(both, 3);
    const auto a = ScreenedOperator::make(scene.core, scene.screening, {});
    EXPECT_TRUE(a->screened(0));
    EXPECT_EQ(a->screened(1), both);
    EXPECT_LT(worst(scene.solve(*a), dense(scene, *a, {}, {})), 1e-12);
  }
}

TEST(Screened, TheMatrixIsTheOperatorPlusTheMass) {
  const Scene scene(true, 5);
  const auto a = ScreenedOperator::make(scene.core, scene.screening, {});
  for (Index v = 0; v < scene.core->size(); ++v) {
    const auto& k = scene.core->laplacian;
    for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) {
      const double mass = k.row[at(i)] == v ? scene.core->areas[at(v)] * scene.screening[at(v)] : 0.0;
      EXPECT_EQ(a->matrix.value[at(i)], k.value[at(i)] + mass);
    }
  }
}

// Hard and soft vertices and points in triangles, on islands with and without screening.
TEST(Screened, SitesHoldOnTop) {
  for (const bool both : {true, false}) {
    const Scene scene(both, 7);
    const auto a = ScreenedOperator::make(scene.core, scene.screening, {});
    std::vector<Site> sites;
    std::mt19937 random(11);
    for (Index v = 4; v < scene.core->size(); v += 17)
      sites.push_back(Site::at_vertex(scene.core->mesh, v, random() % 3 == 0 ? 0.4 : 0.0));
    for (const Index t : {5, 150}) {
      Site point;
      for (int k = 0; k < 3; ++k) {
        point.vertex[k] = scene.core->mesh.triangle(t)[k];
        point.weight[k] = k ? 0.25 : 0.5;
      }
      point.component = scene.core->mesh.component[at(point.vertex[0])];
      sites.push_back(point);
    }
    Eigen::MatrixXd values(static_cast<int>(sites.size()), 2);
    std::vector<double> rows;
    for (int i = 0; i < values.rows(); ++i) {
      values(i, 0) = std::sin(i) + 3;
      values(i, 1) = std::cos(i);
      rows.push_back(values(i, 0));
      rows.push_back(values(i, 1));
    }
    hf_inner::solve::ConstraintSystem system(a->view());
    std::vector<Index> slots(sites.size());
    std::iota(slots.begin(), slots.end(), 0);
    const hf_inner::solve::SiteEdit edit{{}, {slots.data(), slots.size()}, {sites.data(), sites.size()}};
    system.edit(edit);
    EXPECT_EQ(system.counts().rebases, 0u);
    const Eigen::MatrixXd exact = dense(scene, *a, sites, values);
    std::vector<double> u = scene.solve(*a);
    a->add_sites(system, rows.data(), 2, u.data(), 2);
    EXPECT_LT(worst(u, exact), 1e-11);
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (!sites[i].is_hard_vertex()) continue;
      EXPECT_EQ(u[2 * at(sites[i].vertex[0])], rows[2 * i]);
    }
    // the same with the hard sites eliminated
    system.rebase(*scene.core->jobs);
    u = scene.solve(*a);
    a->add_sites(system, rows.data(), 2, u.data(), 2);
    EXPECT_LT(worst(u, exact), 1e-11);
  }
}

// With weights made positive, a field of wishes in 0..1 stays there, and wishes that sum to 1 give fields that do.
TEST(Screened, PositiveWeightsKeepThePartition) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    hf_inner::surface::CoreOptions options;
    options.operator_kind = hf_inner::mesh::OperatorKind::cotangent;
    std::shared_ptr<const hf_inner::surface::Core> core;
    try {
      core = hf_test::make_core(mesh, 1, options);
    } catch (const std::exception&) {
      continue;  // cotangent weights of this mesh have no factor
    }
    std::vector<double> screening(at(core->size()), 0.0);
    for (Index v = 0; v < core->size(); v += 3) screening[at(v)] = 50;
    hf_inner::solve::ScreenedOptions positive;
    positive.least_weight = 1e-9;
    const auto a = ScreenedOperator::make(core, screening, positive);
    std::vector<double> u(2 * at(core->size()));
    a->solve(2, u.data(), 2, [&](Index v, Index first, Index count, double* p) {
      for (Index c = 0; c < count; ++c) p[c] = (v % 2 == 0) == (first + c == 0) ? 1.0 : 0.0;
    });
    for (Index v = 0; v < core->size(); ++v) {
      if (!a->screened(core->mesh.component[at(v)])) continue;
      EXPECT_NEAR(u[2 * at(v)] + u[2 * at(v) + 1], 1, 1e-7) << name;
      EXPECT_GE(u[2 * at(v)], -1e-9) << name;
    }
  }
}

}  // namespace
