// Screened fields of a solver against a dense solve: edits, copies, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "base/index.h"
#include "field/scalar_field.h"
#include "support/dense.h"
#include "support/dirty_meshes.h"
#include "support/engines.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::field::ScalarField;
using hf_inner::solve::Site;

constexpr int channels = 2;

struct Scene {
  std::shared_ptr<const hf_inner::surface::Core> core;
  ScalarField field;
  std::vector<double> strength, target;
  Scene() : core(hf_test::make_core(mesh())), field(core, channels, 100000) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> one(0, 1);
    for (Index v = 0; v < core->size(); ++v) {
      strength.push_back(core->mesh.component[at(v)] == 0 && random() % 2 ? 300 * one(random) : 0.0);
      target.push_back(one(random));
      target.push_back(-one(random));
    }
  }
  static hf_test::PlainMesh mesh() {
    hf_test::PlainMesh out = hf_test::grid(9, 7, 1, 0.3);
    hf_test::append(out, hf_test::torus(12, 7), 20);
    return out;
  }
  void screen() { field.set_screening({strength.data(), strength.size()}, target.data()); }
  void add(const std::vector<std::uint32_t>& vertices, const std::vector<double>& stiffness) {
    std::vector<double> values;
    for (const std::uint32_t v : vertices) {
      values.push_back(std::sin(v));
      values.push_back(std::cos(v));
    }
    hf_inner::field::FieldEdit edit;
    std::vector<std::uint32_t> numbers(vertices.size());
    edit.add.count = static_cast<std::uint32_t>(vertices.size());
    edit.add.vertices = vertices.data();
    edit.add_holds.values = values.data();
    edit.add_holds.stiffness = stiffness.data();
    field.edit(edit, numbers.data());
  }
  std::vector<double> solve() const {
    std::vector<double> u(channels * at(core->size()));
    field.solve(u.data());
    return u;
  }
  // The largest difference of field and fluxes to the dense system; components without sites and screening are 0.
  double error() const {
    const int n = core->size(), k = static_cast<int>(field.sites().count());
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + k, n + k), b = Eigen::MatrixXd::Zero(n + k, channels);
    a.topLeftCorner(n, n) = hf_test::dense_operator(*core);
    std::vector<int> reached(at(core->mesh.component_count()), 0);
    const bool screened = field.is_screened();
    for (int v = 0; v < n && screened; ++v) {
      const double mass = core->areas[at(v)] * strength[at(v)];
      a(v, v) += mass;
      reached[at(core->mesh.component[at(v)])] |= mass > 0;
      for (int c = 0; c < channels; ++c) b(v, c) = mass * target[at(v) * channels + at(c)];
    }
    int i = 0;
    std::vector<std::size_t> slot_of;
    for (std::size_t s = 0; s < field.sites().slots().size(); ++s) {
      const auto& slot = field.sites().slots()[s];
      if (!slot.used()) continue;
      reached[at(slot.site.component)] = 1;
      slot_of.push_back(s);
      for (int q = 0; q < 3; ++q) {
        if (slot.site.vertex[q] < 0) continue;
        a(slot.site.vertex[q], n + i) -= slot.site.weight[q];
        a(n + i, slot.site.vertex[q]) += slot.site.weight[q];
      }
      a(n + i, n + i) = slot.site.compliance / core->mean_diagonal[at(slot.site.component)];
      for (int c = 0; c < channels; ++c) b(n + i, c) = field.sites().values()[s * channels + at(c)];
      ++i;
    }
    for (int v = 0; v < n; ++v) {
      if (!reached[at(core->mesh.component[at(v)])]) {
        a.row(v).setZero();
        a(v, v) = 1;
      }
    }
    const Eigen::MatrixXd exact = hf_test::DenseSolver(a, hf_test::DenseSolver::full).solve(b);
    const std::vector<double> u = solve();
    double most = 0;
    for (int v = 0; v < n; ++v) {
      for (int c = 0; c < channels; ++c) most = std::max(most, std::fabs(u[at(v) * channels + at(c)] - exact(v, c)));
    }
    hf_inner::Vector<double> flux(core->memory.get());
    field.flux(flux);
    for (int s = 0; s < k; ++s) {
      for (int c = 0; c < channels; ++c)
        most = std::max(most, std::fabs(flux[slot_of[at(s)] * channels + at(c)] - exact(n + s, c)));
    }
    return most;
  }
};

TEST(ScreenedField, IsTheDenseSolution) {
  Scene scene;
  scene.screen();
  EXPECT_LT(scene.error(), 1e-10);  // no site: the first island follows p, the second is 0
  scene.add({3, 20, 70, 90}, {0, 2.5, 0, 0});
  EXPECT_LT(scene.error(), 1e-9);
  hf_inner::JobRunner alone(1);
  scene.field.prepare_rebase();
  scene.add({31, 33}, {0, 0});  // takes the rebased factor
  EXPECT_LT(scene.error(), 1e-9);
}

TEST(ScreenedField, KeepsItsSitesAndACopyKeepsItsScreening) {
  Scene scene;
  scene.add({3, 20, 70, 90}, {0, 2.5, 0, 0});
  const std::vector<double> plain = scene.solve();
  const ScalarField before(scene.field);
  scene.screen();
  EXPECT_LT(scene.error(), 1e-9);
  const std::vector<double> screened = scene.solve();
  EXPECT_NE(plain, screened);
  const ScalarField copy(scene.field);
  scene.field.set_screening({}, nullptr);
  EXPECT_FALSE(scene.field.is_screened());
  const std::vector<double> again = scene.solve();
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_NEAR(again[i], plain[i], 1e-10);
  std::vector<double> copied(screened.size());
  copy.solve(copied.data());
  EXPECT_EQ(copied, screened);
  before.solve(copied.data());
  EXPECT_EQ(copied, plain);
}

// A rebase that was prepared before the screening does not bring the plain field back.
TEST(ScreenedField, APreparedFactorOfAnotherScreeningIsNotTaken) {
  Scene scene;
  scene.add({3, 20, 70, 90}, {0, 2.5, 0, 0});
  scene.field.prepare_rebase();
  scene.screen();
  scene.add({33}, {0});
  EXPECT_TRUE(scene.field.is_screened());
  EXPECT_LT(scene.error(), 1e-9);
}

TEST(ScreenedField, OtherEnginesAndLostScreeningAreRefused) {
  const Scene scene;
  ScalarField other(scene.core, channels, 100, hf_test::make_engine(hf_test::EngineKind::refactor, scene.core));
  EXPECT_THROW(other.set_screening({scene.strength.data(), scene.strength.size()}, nullptr), hf_inner::Error);
  ScalarField field(scene.core, channels, 100);
  const std::vector<double> tiny(at(scene.core->size()), 1e-30);
  EXPECT_THROW(field.set_screening({tiny.data(), tiny.size()}, nullptr), hf_inner::Error);
  EXPECT_FALSE(field.is_screened());
}

}  // namespace
