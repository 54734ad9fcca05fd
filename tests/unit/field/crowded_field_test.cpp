// Hard and soft points that crowd in one triangle, and screening of any size, against a solve in long double.
#include <gtest/gtest.h>

#include <cmath>
#include <Eigen/LU>
#include <random>

#include "base/error.h"
#include "base/index.h"
#include "field/certificate.h"
#include "field/scalar_field.h"
#include "support/engines.h"
#include "support/meshes.h"
#include "support/oracle.h"
#include "support/place_in.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::field::ScalarField;
using hf_test::EngineKind;
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

hf_test::PlainMesh one_triangle() { return {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}; }
hf_test::PlainMesh tetrahedron() {
  return {{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2}};
}

// A field with random sites, and what it should be.
struct Trial {
  ScalarField field;
  std::vector<double> strength, target;
  Trial(std::shared_ptr<const hf_inner::surface::Core> core, EngineKind engine)
      : field(core, 1, 1000, hf_test::make_engine(engine, core)) {}

  void screen(std::mt19937& random, double exponents) {
    std::uniform_real_distribution<double> one(0, 1);
    for (Index v = 0; v < field.core().size(); ++v) {
      strength.push_back(one(random) < 0.6 ? std::pow(10, exponents * (one(random) - 0.5)) : 0.0);
      target.push_back(one(random));
    }
    field.set_screening({strength.data(), strength.size()}, target.data());
  }
  // A vertex or a point of a triangle, hard or soft. A site that depends on others is refused.
  void add(std::mt19937& random, const hf_test::PlainMesh& mesh) {
    std::uniform_real_distribution<double> one(0, 1);
    const std::uint32_t vertex = random() % mesh.vertex_count(), triangle = random() % mesh.triangle_count();
    const double a = 0.02 + 0.94 * one(random), b = 0.02 + (0.96 - a) * one(random), point[3] = {a, b, 1 - a - b};
    const double value = 2 * one(random) - 1, stiffness = one(random) < 0.5 ? 0 : std::pow(10, 16 * one(random) - 8);
    const hf_place place = place_in(mesh.triangles.data(), mesh.triangle_count(), triangle, point);
    hf_inner::field::FieldEdit edit;
    edit.add.count = 1;
    edit.add_holds.values = &value;
    edit.add_holds.stiffness = &stiffness;
    if (random() % 2)
      edit.add.vertices = &vertex;
    else
      edit.add.places = &place;
    std::uint32_t number = 0;
    try {
      field.edit(edit, &number);
    } catch (const hf_inner::Error&) {
    }
  }
  // The largest difference from the solution in long double, and the largest value of that.
  double error(double& size) const {
    const hf_inner::surface::Core& core = field.core();
    const int n = core.size(), k = static_cast<int>(field.sites().count());
    Matrix a = Matrix::Zero(n + k, n + k);
    Column b = Column::Zero(n + k);
    a.topLeftCorner(n, n) = hf_test::dense_operator(core).cast<long double>();
    for (int v = 0; v < n; ++v) {
      a(v, v) = 0;  // exactly what keeps constants
      a(v, v) = -a.row(v).head(n).sum();
    }
    for (int v = 0; v < n && !strength.empty(); ++v) {
      const long double mass = static_cast<long double>(core.areas[at(v)]) * strength[at(v)];
      a(v, v) += mass;
      b(v) = mass * target[at(v)];
    }
    int i = n;
    for (std::size_t s = 0; s < field.sites().slots().size(); ++s) {
      const auto& slot = field.sites().slots()[s];
      if (!slot.used()) continue;
      for (int q = 0; q < 3; ++q) {
        if (slot.site.vertex[q] < 0) continue;
        a(slot.site.vertex[q], i) -= slot.site.weight[q];
        a(i, slot.site.vertex[q]) += slot.site.weight[q];
      }
      a(i, i) = static_cast<long double>(slot.site.compliance) / core.mean_diagonal[0];
      b(i++) = field.sites().values()[s];
    }
    const Column exact = a.fullPivLu().solve(b);
    std::vector<double> u(at(n));
    field.solve(u.data());
    double worst = 0;
    size = 0;
    for (int v = 0; v < n; ++v) {
      worst = std::max(worst, std::fabs(static_cast<double>(exact(v) - u[at(v)])));
      size = std::max(size, std::fabs(static_cast<double>(exact(v))));
    }
    return worst;
  }
};

// Every field is right, and a certificate is never given to one that is not.
void play(EngineKind engine, double exponents, int least_certified) {
  for (const hf_test::PlainMesh& mesh : {one_triangle(), tetrahedron(), hf_test::grid(6, 6, 1, 0.3)}) {
    const auto core = hf_test::make_core(mesh);
    std::mt19937 random(7);
    int certified = 0;
    for (int trial = 0; trial < 300; ++trial) {
      Trial made(core, engine);
      if (exponents > 0) made.screen(random, exponents);
      for (int sites = 1 + static_cast<int>(random() % 8); sites > 0; --sites) made.add(random, mesh);
      if (made.field.sites().count() == 0) continue;
      double size = 0;
      const double error = made.error(size);
      EXPECT_LE(error, 1e-8 * std::max(size, 1.0)) << "trial " << trial << " of " << mesh.vertex_count() << " vertices";
      const hf_inner::field::Certificate found = hf_inner::field::certify(made.field);
      const double worst = std::max({found.error, found.site_error, found.overshoot});
      certified += worst <= 1e-8;
      if (worst <= 1e-8 && found.value_range > 0) {
        EXPECT_LE(error, 1e-7 * found.value_range) << "certified, trial " << trial;
      }
    }
    EXPECT_GE(certified, least_certified);
  }
}

TEST(CrowdedField, hard_and_soft_points_of_one_triangle_are_right) { play(EngineKind::green, 0, 280); }
TEST(CrowdedField, the_engine_refactor_has_as_many_digits) { play(EngineKind::refactor, 0, 280); }
TEST(CrowdedField, screened_points_are_right_and_certified) { play(EngineKind::green, 8, 280); }
TEST(CrowdedField, screening_of_many_sizes_is_right) { play(EngineKind::green, 12, 270); }

// Without sites a field of weak screening is nearly the mean of its targets. Rounding of K must not show.
TEST(CrowdedField, weak_screening_loses_no_digits) {
  const hf_test::PlainMesh mesh = hf_test::grid(6, 6, 1, 0.3);
  const auto core = hf_test::make_core(mesh);
  for (const double h : {1.0, 1e-4, 1e-7}) {
    Trial made(core, EngineKind::green);
    for (Index v = 0; v < core->size(); ++v) {
      made.strength.push_back(h * (1 + v % 3));
      made.target.push_back(v % 7);
    }
    made.field.set_screening({made.strength.data(), made.strength.size()}, made.target.data());
    double size = 0;
    EXPECT_LE(made.error(size), 1e-9) << h;
    EXPECT_LE(hf_inner::field::certify(made.field).error, 1e-7) << h;
  }
}

// Three vertices of a triangle given by three hard points: what is there to screen does not matter, or is refused.
TEST(CrowdedField, three_points_fix_their_triangle_under_any_screening) {
  const auto core = hf_test::make_core(one_triangle());
  for (const double h : {0.0, 3e3, 1e7, 1e12, 1e190}) {
    ScalarField field(core, 1, 100);
    const double strength[3] = {0, h, 0};
    if (h > 1e13) {
      EXPECT_THROW(field.set_screening({strength, 3}, nullptr), hf_inner::Error);
      EXPECT_FALSE(field.is_screened());
      continue;
    }
    if (h > 0) field.set_screening({strength, 3}, nullptr);
    // the values are the weights of the first corner
    const double values[3] = {0.2, 0.5, 0.8};
    const hf_place spread[3] = {
        {{0, 1, 2}, 0, {0.2, 0.7, 0.1}}, {{0, 1, 2}, 0, {0.5, 0.3, 0.2}}, {{0, 1, 2}, 0, {0.8, 0.1, 0.1}}};
    hf_inner::field::FieldEdit edit;
    edit.add.count = 3;
    edit.add.places = spread;
    edit.add_holds.values = values;
    std::uint32_t numbers[3];
    try {
      field.edit(edit, numbers);
    } catch (const hf_inner::Error& error) {
      EXPECT_GE(h, 1e7) << error.what();  // beyond the digits of a double: refused
      continue;
    }
    double u[3];
    field.solve(u);
    EXPECT_NEAR(u[0], 1, 1e-8) << h;
    EXPECT_NEAR(u[1], 0, 1e-8) << h;
    EXPECT_NEAR(u[2], 0, 1e-8) << h;
  }
}

// The error of a preview is measured where single precision may have no digit, or nothing is said of it.
TEST(CrowdedField, previews_say_their_error) {
  for (const auto kind : {hf_inner::mesh::FieldKind::harmonic, hf_inner::mesh::FieldKind::biharmonic}) {
    for (const auto& mesh :
         {hf_test::grid(200, 1, 1, 0.1), hf_test::grid(40, 40, 1, 0.3), hf_test::grid(600, 2, 1, 0)}) {
      hf_inner::surface::CoreOptions options;
      options.field_kind = kind;
      const auto core = hf_test::make_core(mesh, 1, options);
      ScalarField field(core, 1, 1000);
      const std::uint32_t n = mesh.vertex_count(), vertices[4] = {0, n / 3, n / 2, n - 1};
      const double values[4] = {0, 100, -300, 50};
      hf_inner::field::FieldEdit edit;
      edit.add.count = 4;
      edit.add.vertices = vertices;
      edit.add_holds.values = values;
      std::uint32_t numbers[4];
      field.edit(edit, numbers);
      std::vector<double> exact(n), preview(n);
      field.solve(exact.data());
      for (const int corrections : {0, 1, 3}) {
        const hf_inner::solve::PreviewInfo info = field.solve_preview(corrections, preview.data());
        double error = 0;
        for (std::size_t v = 0; v < n; ++v) error = std::max(error, std::fabs(preview[v] - exact[v]));
        EXPECT_EQ(std::isinf(info.error_estimate), corrections == 0 && kind == hf_inner::mesh::FieldKind::biharmonic);
        EXPECT_LE(error, info.error_estimate + 1e-9)
            << n << " vertices, " << corrections << " corrections, kind " << static_cast<int>(kind);
      }
    }
  }
}

}  // namespace
