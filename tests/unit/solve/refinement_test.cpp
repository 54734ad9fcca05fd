// Iterative refinement of bi-harmonic fields: the correction reaches the dense oracle, a second one changes nothing,
// and it holds with soft sites, points in triangles, several components, eliminated and freed sites.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "base/index.h"
#include "solve/green.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace {

using hf_inner::at;
std::shared_ptr<const hf_inner::surface::Core> biharmonic_core(const hf_test::PlainMesh& mesh,
                                                               std::int32_t refinements) {
  hf_inner::surface::CoreOptions options;
  options.field_kind = hf_inner::mesh::FieldKind::biharmonic;
  const auto core = hf_test::make_core(mesh, 2, options);
  EXPECT_EQ(core->refinements, 1);
  const_cast<hf_inner::surface::Core&>(*core).refinements = refinements;
  return core;
}

struct Sites {
  std::vector<std::int32_t> slots;
  std::vector<hf_inner::solve::Site> sites;
  std::vector<double> values;  // two channels
  void add(const hf_inner::solve::Site& site, double a, double b) {
    slots.push_back(static_cast<std::int32_t>(slots.size()));
    sites.push_back(site);
    values.push_back(a);
    values.push_back(b);
  }
};

Sites scattered(const hf_inner::surface::Core& core, std::uint32_t seed, int step) {
  Sites out;
  std::mt19937 random(seed);
  for (std::int32_t v = 0; v < core.size(); v += step + static_cast<int>(random() % 5)) {
    out.add(hf_inner::solve::Site::at_vertex(core.mesh, v, random() % 4 == 0 ? 0.5 : 0.0), std::sin(v),
            std::cos(2.0 * v));
    if (v % 3) continue;
    hf_inner::solve::Site point;  // a point in a triangle away from other sites
    const std::int32_t t = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(core.mesh.triangle_count()));
    for (int k = 0; k < 3; ++k) {
      point.vertex[k] = core.mesh.triangle(t)[k];
      point.weight[k] = k ? 0.25 : 0.5;
    }
    point.component = core.mesh.component[at(point.vertex[0])];
    point.compliance = 0.01;
    out.add(point, 0.3, -0.2);
  }
  return out;
}

double worst_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::fabs(a[i] - b[i]));
  return worst;
}

// The field with this many refinements, and lambda.
std::vector<double> field_of(const std::shared_ptr<const hf_inner::surface::Core>& core, const Sites& sites,
                             int removed, std::vector<double>& flux, std::uint32_t* factorisations = nullptr) {
  hf_inner::solve::GreenSolver solver(core);
  hf_inner::solve::SiteEdit edit;
  edit.add = sites.slots;
  edit.sites = sites.sites;
  solver.edit(edit);
  if (removed > 0) {
    const std::vector<std::int32_t> leaving(sites.slots.begin() + 5, sites.slots.begin() + 5 + removed);
    hf_inner::solve::SiteEdit out;
    out.remove = leaving;
    solver.edit(out);
  }
  std::vector<double> field(at(core->size()) * 2);
  flux.assign(sites.values.size(), 0.0);
  solver.solve(sites.values.data(), 2, field.data(), flux.data());
  if (factorisations) *factorisations = solver.counters().factorisations;
  return field;
}

hf_test::PlainMesh two_bodies() {
  hf_test::PlainMesh mesh = hf_test::torus(20, 15);
  append(mesh, hf_test::grid(8, 7, 1, 0.2), 20);
  return mesh;
}

TEST(Refinement, reaches_the_dense_oracle) {
  const auto core = biharmonic_core(two_bodies(), 1);
  const Sites sites = scattered(*core, 4, 9);
  std::vector<double> flux;
  const std::vector<double> field = field_of(core, sites, 0, flux);
  Eigen::MatrixXd values(static_cast<Eigen::Index>(sites.sites.size()), 2), lambda;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index c = 0; c < 2; ++c) values(i, c) = sites.values[static_cast<std::size_t>(2 * i + c)];
  }
  const Eigen::MatrixXd exact = hf_test::dense_field(*core, sites.sites, values, &lambda);
  double worst = 0;
  for (std::int32_t v = 0; v < core->size(); ++v) {
    for (int c = 0; c < 2; ++c) worst = std::max(worst, std::fabs(field[at(2 * v + c)] - exact(v, c)));
  }
  EXPECT_LE(worst, 1e-11);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index c = 0; c < 2; ++c) EXPECT_NEAR(flux[static_cast<std::size_t>(2 * i + c)], lambda(i, c), 1e-8);
  }
}

// A larger mesh, where the sweep alone leaves an error that can be seen.
TEST(Refinement, a_second_correction_changes_nothing_more) {
  const hf_test::PlainMesh mesh = hf_test::torus(140, 110);
  std::vector<double> flux, fields[3];
  for (int r = 0; r < 3; ++r) {
    const auto core = biharmonic_core(mesh, r);
    fields[r] = field_of(core, scattered(*core, 8, 260), 0, flux);
  }
  const double first = worst_difference(fields[0], fields[1]), second = worst_difference(fields[1], fields[2]);
  EXPECT_GT(first, 1e-14) << "nothing to correct: the test shows nothing";
  EXPECT_LE(second, 1e-12);
  EXPECT_LT(second, 0.1 * first);
}

TEST(Refinement, holds_for_eliminated_and_freed_sites) {
  const hf_test::PlainMesh mesh = two_bodies();
  std::vector<double> flux, fields[3];
  for (int r = 0; r < 3; ++r) {
    const auto core = biharmonic_core(mesh, r);
    Sites sites;
    for (std::int32_t v = 0; v < core->size(); v += 2)
      sites.add(hf_inner::solve::Site::at_vertex(core->mesh, v), std::sin(0.1 * v), 1e3);
    std::uint32_t factorisations = 0;
    fields[r] = field_of(core, sites, 7, flux, &factorisations);
    EXPECT_EQ(factorisations, 2u) << "the cost model did not eliminate";
    std::vector<hf_inner::solve::Site> used;
    Eigen::MatrixXd values(static_cast<Eigen::Index>(sites.sites.size()) - 7, 2);
    for (std::size_t i = 0; i < sites.sites.size(); ++i) {
      if (i >= 5 && i < 12) continue;
      values(static_cast<Eigen::Index>(used.size()), 0) = sites.values[2 * i];
      values(static_cast<Eigen::Index>(used.size()), 1) = sites.values[2 * i + 1];
      used.push_back(sites.sites[i]);
    }
    const Eigen::MatrixXd exact = hf_test::dense_field(*core, used, values);
    double worst = 0;
    for (std::int32_t v = 0; v < core->size(); ++v) {
      for (int c = 0; c < 2; ++c) worst = std::max(worst, std::fabs(fields[r][at(2 * v + c)] - exact(v, c)));
    }
    EXPECT_LE(worst, 1e-9) << r << " refinements";
  }
  EXPECT_LE(worst_difference(fields[1], fields[2]), 1e-11);
}

}  // namespace
