// Fields against closed forms: what a harmonic field is, not what it was last time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <set>

#include "assets/shapes.h"
#include "field/scalar_field.h"
#include "field/vector_field.h"
#include "support/engines.h"
#include "support/full.h"
#include "support/meshes.h"

namespace {

using hf_test::PlainMesh;

PlainMesh from_shape(samples::ShapeMesh shape) { return {std::move(shape.positions), std::move(shape.triangles)}; }

hf_inner::field::ScalarField make_field(const PlainMesh& mesh, hf_test::EngineKind engine = hf_test::EngineKind::green,
                                        int channels = 1) {
  const auto core = hf_test::make_core(mesh);
  return hf_inner::field::ScalarField(core, channels, 100000, hf_test::make_engine(engine, core));
}

void add(hf_inner::field::ScalarField& field, const std::vector<std::uint32_t>& vertices,
         const std::vector<double>& values, const std::vector<double>& stiffness = {}) {
  hf_inner::field::FieldEdit edit;
  edit.add.count = static_cast<std::uint32_t>(vertices.size());
  edit.add.vertices = vertices.data();
  edit.add_holds.values = values.data();
  if (!stiffness.empty()) edit.add_holds.stiffness = stiffness.data();
  field.edit(edit, nullptr);
}

std::vector<double> solve(const hf_inner::field::ScalarField& field) {
  std::vector<double> u(static_cast<std::size_t>(field.core().size() * field.sites().channels()));
  field.solve(u.data());
  return u;
}

TEST(HarmonicField, is_linear_on_a_flat_patch_with_linear_borders) {
  const std::uint32_t nx = 30, ny = 20;
  const PlainMesh mesh = hf_test::grid(nx, ny, 1, 0.35, 3);
  hf_inner::field::ScalarField field = make_field(mesh);
  std::vector<std::uint32_t> border;
  std::vector<double> values;
  const auto linear = [&](std::uint32_t v) {
    return 1 + 0.1 * mesh.positions[3 * v] - 0.07 * mesh.positions[3 * v + 1];
  };
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t i = v % (nx + 1), j = v / (nx + 1);
    if (i == 0 || j == 0 || i == nx || j == ny) {
      border.push_back(v);
      values.push_back(linear(v));
    }
  }
  add(field, border, values);
  const auto u = solve(field);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(u[v], linear(v), 1e-12);
}

TEST(HarmonicField, has_natural_borders) {
  // sites on the short sides only: linear along the strip, zero flux through the long sides
  const std::uint32_t nx = 40, ny = 9;
  const PlainMesh mesh = hf_test::grid(nx, ny, 1, 0.3, 8);
  hf_inner::field::ScalarField field = make_field(mesh);
  std::vector<std::uint32_t> ends;
  std::vector<double> values;
  for (std::uint32_t j = 0; j <= ny; ++j) {
    ends.insert(ends.end(), {j * (nx + 1), j * (nx + 1) + nx});
    values.insert(values.end(), {0.0, 1.0});
  }
  add(field, ends, values);
  const auto u = solve(field);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) EXPECT_NEAR(u[v], mesh.positions[3 * v] / nx, 1e-12);
}

// Annulus 1 <= r <= 3, u = 0 inside, 1 outside: u = log r / log 3.
double annulus_error(std::uint32_t rings) {
  PlainMesh mesh;
  const std::uint32_t around = 6 * rings;
  const double two_pi = 8 * std::atan(1.0);
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const double r = 1 + 2.0 * i / rings, a = two_pi * (j + 0.5 * (i % 2)) / around;
      mesh.positions.insert(mesh.positions.end(), {r * std::cos(a), r * std::sin(a), 0.0});
    }
  }
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t a = i * around + j, b = i * around + (j + 1) % around, c = a + around,
                          d = (i + 1) * around + (j + 1) % around;
      if (i % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {a, c, b, b, c, d});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, c, d, a, d, b});
    }
  }
  hf_inner::field::ScalarField field = make_field(mesh);
  std::vector<std::uint32_t> rim;
  std::vector<double> values;
  for (std::uint32_t j = 0; j < around; ++j) {
    rim.insert(rim.end(), {j, rings * around + j});
    values.insert(values.end(), {0.0, 1.0});
  }
  add(field, rim, values);
  const auto u = solve(field);
  double worst = 0;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    worst = std::max(worst, std::fabs(u[v] - std::log(std::hypot(mesh.positions[3 * v], mesh.positions[3 * v + 1])) /
                                                 std::log(3.0)));
  }
  return worst;
}

TEST(HarmonicField, converges_with_h_squared_to_the_logarithm_on_an_annulus) {
  const double coarse = annulus_error(10), middle = annulus_error(20), fine = annulus_error(40);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(coarse / middle, 3.5);
  EXPECT_GT(middle / fine, 3.5);
}

TEST(PenaltySites, stay_within_1e_6_of_exact_elimination_on_six_meshes) {
  const struct {
    const char* name;
    PlainMesh mesh;
  } cases[] = {{"torus 2.5K", hf_test::torus(50, 50)},
               {"plane 10K", from_shape(samples::bumpy_plane(100, 100))},
               {"sphere 16K", from_shape(samples::sphere(40))},
               {"bar 6.5K", from_shape(samples::bar(19))},
               {"cylinder", from_shape(samples::cylinder(16, 100))},
               // the long form takes the largest mesh, of 304,152 vertices
               {"large torus", hf_test::is_full() ? from_shape(samples::jittered_torus(551, 552))
                                                  : from_shape(samples::jittered_torus(205, 206))}};
  for (const auto& entry : cases) {
    hf_inner::field::ScalarField exact = make_field(entry.mesh, hf_test::EngineKind::refactor);
    hf_inner::field::ScalarField soft(exact.shared_core(), 1, 1000);
    std::set<std::uint32_t> seen;
    std::vector<std::uint32_t> vertices;
    std::vector<double> values;
    for (std::uint32_t i = 0; vertices.size() < 60; ++i) {
      const std::uint32_t v = static_cast<std::uint32_t>(samples::hash_to_unit(4, i) * entry.mesh.vertex_count());
      if (seen.insert(v).second) {
        vertices.push_back(v);
        values.push_back(samples::hash_to_unit(9, i));
      }
    }
    add(exact, vertices, values);
    add(soft, vertices, values, std::vector<double>(60, 1e8));
    const auto u = solve(exact), penalty = solve(soft);
    hf_inner::field::ScalarField hard(exact.shared_core(), 1, 1000);
    add(hard, vertices, values);
    const auto green = solve(hard);
    double penalty_error = 0, green_error = 0;
    for (std::size_t v = 0; v < u.size(); ++v) {
      penalty_error = std::max(penalty_error, std::fabs(u[v] - penalty[v]));
      green_error = std::max(green_error, std::fabs(u[v] - green[v]));
    }
    std::printf("%-12s penalty 1e8 against exact elimination %.2e, hard sites %.2e\n", entry.name, penalty_error,
                green_error);
    EXPECT_LE(penalty_error, 1e-6) << entry.name;
    EXPECT_LE(green_error, 1e-11) << entry.name;
#ifdef HF_WITH_GPL
    hf_inner::field::ScalarField updown(exact.shared_core(), 1, 1000,
                                        hf_test::make_engine(hf_test::EngineKind::updown, exact.shared_core()));
    add(updown, vertices, values);
    const auto paper = solve(updown);
    double paper_error = 0, same = 0;
    for (std::size_t v = 0; v < u.size(); ++v) {
      paper_error = std::max(paper_error, std::fabs(u[v] - paper[v]));
      same = std::max(same, std::fabs(penalty[v] - paper[v]));
    }
    std::printf("%-12s the paper's engine %.2e; soft sites of green differ from it by %.2e\n", entry.name, paper_error,
                same);
    EXPECT_LE(paper_error, 1e-6) << entry.name;
#endif
  }
}

TEST(VectorField, is_tangent_and_its_constraints_turn_without_touching_the_factor) {
  const PlainMesh mesh = hf_test::torus(60, 40);
  hf_inner::field::ScalarField field = make_field(mesh, hf_test::EngineKind::green, 3);
  const auto normals = hf_inner::field::vertex_normals(field.core().mesh, *field.core().memory);
  const std::vector<std::uint32_t> vertices = {3, 700, 1500};
  add(field, vertices, {1, 0, 0, 0, 1, 0, 0, 0, 1});
  const auto tangent = [&] {
    auto v = solve(field);
    hf_inner::field::project_on_tangent_planes(normals, v.data());
    double worst = 0;
    for (std::size_t i = 0; i < normals.size(); ++i)
      worst = std::max(worst,
                       std::fabs(normals[i].x * v[3 * i] + normals[i].y * v[3 * i + 1] + normals[i].z * v[3 * i + 2]));
    EXPECT_LE(worst, 1e-15);
    return v;
  };
  const auto before = tangent();
  const auto counters = field.engine().counters();
  for (int step = 1; step <= 8; ++step) {  // turn the first vector about z
    const double a = 0.1 * step, turned[] = {std::cos(a), std::sin(a), 0};
    const std::uint32_t site[] = {0};
    hf_inner::field::FieldEdit edit;
    edit.set_count = 1;
    edit.set_sites = site;
    edit.set_values = turned;
    field.edit(edit, nullptr);
    EXPECT_NE(tangent(), before);
  }
  EXPECT_EQ(field.engine().counters().factorisations, counters.factorisations);
  EXPECT_EQ(field.engine().counters().path_solves, counters.path_solves);
  // insert, move and delete come back to where they began
  const std::uint32_t first[] = {0};
  const double x[] = {1, 0, 0};
  hf_inner::field::FieldEdit back;
  back.set_count = 1;
  back.set_sites = first;
  back.set_values = x;
  field.edit(back, nullptr);
  add(field, {99}, {0.5, 0.5, 0});
  const std::uint32_t there[] = {101}, fourth[] = {3};
  hf_inner::field::FieldEdit move;
  move.move_count = 1;
  move.move_sites = fourth;
  move.move_to.count = 1;
  move.move_to.vertices = there;
  field.edit(move, nullptr);
  EXPECT_EQ(solve(field)[3 * 101], 0.5);
  hf_inner::field::FieldEdit remove;
  remove.remove_count = 1;
  remove.remove_sites = fourth;
  field.edit(remove, nullptr);
  const auto after = tangent();
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_NEAR(after[i], before[i], 1e-12);
}

TEST(MaximumPrinciple, holds_with_clamped_weights_on_an_obtuse_mesh) {
  PlainMesh mesh = hf_test::grid(40, 8, 1, 0.3, 2);
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) mesh.positions[i] += 2 * mesh.positions[i + 1];
  hf_inner::surface::CoreOptions options;
  options.operator_kind = hf_inner::mesh::OperatorKind::clamped;
  const auto core = hf_test::make_core(mesh, 1, options);
  for (int trial = 0; trial < 100; ++trial) {
    hf_inner::field::ScalarField field(core, 1, 100);
    std::set<std::uint32_t> seen;
    std::vector<double> values;
    for (std::uint32_t i = 0; seen.size() < 5; ++i)
      seen.insert(static_cast<std::uint32_t>(samples::hash_to_unit(static_cast<std::uint64_t>(trial), i) *
                                             mesh.vertex_count()));
    for (const std::uint32_t v : seen) values.push_back(samples::hash_to_unit(5, v));
    add(field, {seen.begin(), seen.end()}, values);
    const auto u = solve(field);
    EXPECT_GE(*std::min_element(u.begin(), u.end()), *std::min_element(values.begin(), values.end()) - 1e-13);
    EXPECT_LE(*std::max_element(u.begin(), u.end()), *std::max_element(values.begin(), values.end()) + 1e-13);
  }
}

}  // namespace
