// Bi-harmonic fields whose operator is not formed: with a low limit of valence on small meshes against the dense
// oracle, and on fans, cones and drums of many triangles against long double.
#include "solve/mixed_solver.h"

#include <gtest/gtest.h>

#include "factor/factor_bytes.h"
#include "field/certificate.h"
#include "support/engines.h"
#include "support/hard_meshes.h"
#include "support/mixed_reference.h"
#include "unit/solve/edit_script.h"

namespace {

using hf_inner::at;
using hf_inner::mesh::FieldKind;
using hf_test::EditScript;
using hf_test::PlainMesh;

hf_inner::surface::CoreOptions unformed(FieldKind kind) {
  hf_inner::surface::CoreOptions options;
  options.field_kind = kind;
  options.formed_valence = 3;
  return options;
}

PlainMesh two_bodies() {
  PlainMesh mesh = hf_test::torus(16, 11);
  append(mesh, hf_test::grid(8, 7, 1, 0.2), 20);
  append(mesh, hf_test::grid(2, 2, 0.01), 40);
  return mesh;
}

constexpr double two_pi = 6.283185307179586;

void add_rim(PlainMesh& mesh, std::uint32_t count, double turns, double z) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = two_pi * turns * i / count;
    mesh.positions.insert(mesh.positions.end(), {std::cos(angle), std::sin(angle), z});
  }
}

void add_cone(PlainMesh& mesh, std::uint32_t hub, std::uint32_t rim, std::uint32_t count, bool closed) {
  for (std::uint32_t i = 0; i + !closed < count; ++i)
    mesh.triangles.insert(mesh.triangles.end(), {hub, rim + i, rim + (i + 1) % count});
}

PlainMesh closed_fan(std::uint32_t n) {
  PlainMesh mesh;
  mesh.positions = {0, 0, 0};
  add_rim(mesh, n, 1, 0);
  add_cone(mesh, 0, 1, n, true);
  return mesh;
}

PlainMesh open_fan(std::uint32_t n) {
  PlainMesh mesh;
  mesh.positions = {0, 0, 0};
  add_rim(mesh, n + 1, 0.4, 0);
  add_cone(mesh, 0, 1, n + 1, false);
  return mesh;
}

PlainMesh double_cone(std::uint32_t n) {
  PlainMesh mesh;
  mesh.positions = {0, 0, 0.7, 0, 0, -0.4};
  add_rim(mesh, n, 1, 0);
  add_cone(mesh, 0, 2, n, true);
  add_cone(mesh, 1, 2, n, true);
  return mesh;
}

// Two lids with their hubs and a mantle. The vertices of the rims alternate, so that the reference has little fill.
PlainMesh drum(std::uint32_t n) {
  PlainMesh mesh;
  mesh.positions = {0, 0, 0, 0, 0, 0.01};
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = two_pi * i / n;
    for (const double z : {0.0, 0.01})
      mesh.positions.insert(mesh.positions.end(), {std::cos(angle), std::sin(angle), z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % n);
    mesh.triangles.insert(mesh.triangles.end(), {0, a, b, 1, a + 1, b + 1, a, b, a + 1, b, b + 1, a + 1});
  }
  return mesh;
}

void expect_dense_oracle(const EditScript& script, double tolerance) {
  if (script.count() == 0) return;
  std::vector<hf_inner::solve::Site> used;
  Eigen::MatrixXd values;
  script.present(used, values);
  script.expect_fields(hf_test::dense_field(*script.core, used, values), used, tolerance, 0);
}

class MixedSolver : public testing::TestWithParam<FieldKind> {};

TEST_P(MixedSolver, gives_the_dense_oracles_field_and_fluxes) {
  const auto core = hf_test::make_core(two_bodies(), 2, unformed(GetParam()));
  ASSERT_TRUE(core->root);
  EXPECT_EQ(core->laplacian.size(), 0);
  EditScript script(core, {hf_test::EngineKind::green}, 9, 3, 0);
  script.apply(0, 0, 0, 30);
  std::vector<hf_inner::solve::Site> used;
  Eigen::MatrixXd values, lambda;
  script.present(used, values);
  script.expect_fields(hf_test::dense_field(*core, used, values, &lambda), used, 1e-10, 0);
  hf_inner::Vector<double> flux(core->memory.get());
  script.fields[0]->flux(flux);
  const double size = lambda.cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < lambda.rows(); ++i) {
    for (Eigen::Index c = 0; c < 9; ++c)
      EXPECT_NEAR(flux[static_cast<std::size_t>(9 * i + c)], lambda(i, c), 1e-8 * size);
  }
}

TEST_P(MixedSolver, stays_exact_under_edits_and_a_clone_keeps_its_bits) {
  const auto core = hf_test::make_core(two_bodies(), 1, unformed(GetParam()));
  EditScript script(core, {hf_test::EngineKind::green}, 2, 7, 1e3);
  for (int round = 0; round < 40; ++round) {
    script.step(round % 3 ? 25 : 4, 12);
    if (round % 4 == 0) script.refused_step();
    if (round % 5) continue;
    SCOPED_TRACE(round);
    expect_dense_oracle(script, 1e-9);
    if (HasFailure()) return;
  }
  hf_inner::field::ScalarField& field = *script.fields[0];
  const std::size_t size = at(core->size()) * 2;
  std::vector<double> before(size), after(size);
  field.solve(before.data());
  const hf_inner::field::ScalarField copy(field);
  script.apply(3, 3, 3, 3);
  copy.solve(after.data());
  EXPECT_EQ(before, after);
}

TEST_P(MixedSolver, stays_exact_when_sites_were_moved_into_the_factor) {
  const auto core = hf_test::make_core(two_bodies(), 1, unformed(GetParam()));
  EditScript script(core, {hf_test::EngineKind::green}, 2, 11, 0);
  int freed = 0;
  for (int round = 0; round < 4; ++round) {
    script.apply(0, 0, 0, core->size() / 4, true);
    script.fields[0]->prepare_rebase();
    for (int i = 0; i < 5; ++i) {
      script.step(core->size() / 5, 6);
      const hf_inner::solve::EngineCounters counters = script.fields[0]->engine().counters();
      freed += counters.eliminated > 5 && counters.dense_rows > 0;
      expect_dense_oracle(script, 1e-9);
      if (HasFailure()) return;
    }
  }
  EXPECT_GE(script.fields[0]->engine().counters().rebases, 2u);
  EXPECT_GT(freed, 5);
}

TEST_P(MixedSolver, has_soft_sites_of_any_stiffness_and_points_that_depend) {
  const auto core = hf_test::make_core(hf_test::torus(14, 9), 1, unformed(GetParam()));
  std::vector<hf_inner::solve::Site> sites;
  std::vector<std::int32_t> slots;
  for (int i = 0; i < 25; ++i) {
    hf_inner::solve::Site site = hf_inner::solve::Site::at_vertex(core->mesh, 5 * i, std::pow(10.0, i - 12));
    if (i % 5 == 0) {  // five soft points in one triangle
      for (int k = 0; k < 3; ++k) {
        site.vertex[k] = core->mesh.triangle(7)[k];
        site.weight[k] = k == i % 3 ? 0.2 : 0.4;
      }
    }
    slots.push_back(i);
    sites.push_back(site);
  }
  Eigen::MatrixXd values(25, 1);
  for (int i = 0; i < 25; ++i) values(i) = std::sin(1.0 + i);
  hf_inner::solve::MixedSolver solver(core);
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver.edit(edit);
  std::vector<double> field(at(core->size()));
  solver.solve(values.data(), 1, field.data(), nullptr);
  const Eigen::MatrixXd exact = hf_test::dense_field(*core, sites, values);
  for (int v = 0; v < core->size(); ++v) EXPECT_NEAR(field[at(v)], exact(v), 1e-8);

  // a hard point that depends on three others is refused by its position, and nothing changes
  const std::int32_t there[] = {25, 26, 27, 28};
  std::vector<hf_inner::solve::Site> points(4);
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) {
      points[at(i)].vertex[k] = core->mesh.triangle(90)[k];
      points[at(i)].weight[k] = i == k ? 0.5 : i == 3 ? 1.0 / 3 : 0.25;
    }
    points[at(i)].component = 0;
  }
  edit.add = {there, 4};
  edit.sites = points;
  try {
    solver.edit(edit);
    ADD_FAILURE() << "a dependent point was taken";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_CONFLICT);
    EXPECT_EQ(error.index(), 3u);
  }
  std::vector<double> again(field.size());
  solver.solve(values.data(), 1, again.data(), nullptr);
  EXPECT_EQ(field, again);
}

TEST_P(MixedSolver, stays_exact_on_hard_meshes) {
  PlainMesh mesh = hf_test::slab_with_holes(2, 2);
  append(mesh, hf_test::dirty(), 100);
  const auto core = hf_test::make_core(mesh, 1, unformed(GetParam()));
  EditScript script(core, {hf_test::EngineKind::green}, 1, 13, 1e2);
  for (int round = 0; round < 12; ++round) {
    script.step(20, 10);
    SCOPED_TRACE(round);
    expect_dense_oracle(script, 1e-8);
    if (HasFailure()) return;
  }
}

// Their distance is a thousandth of the triangle, so the harmonic system of the sites is nearly singular.
TEST_P(MixedSolver, holds_crowded_points) {
  const auto core = hf_test::make_core(hf_test::torus(14, 9), 1, unformed(GetParam()));
  std::vector<hf_inner::solve::Site> sites;
  std::vector<std::int32_t> slots;
  for (int i = 0; i < 6; ++i) {
    hf_inner::solve::Site site = hf_inner::solve::Site::at_vertex(core->mesh, 10 * i);
    if (i < 3) {
      const double weight[3] = {0.3 + 1e-3 * i, 0.4 - 5e-4 * i * i, 0.3 - 1e-3 * i + 5e-4 * i * i};
      for (int k = 0; k < 3; ++k) {
        site.vertex[k] = core->mesh.triangle(120)[k];
        site.weight[k] = weight[k];
      }
    }
    slots.push_back(i);
    sites.push_back(site);
  }
  Eigen::MatrixXd values(6, 1);
  values << 0, 1e-3, 3e-3, 1, -1, 0.5;
  hf_inner::solve::MixedSolver solver(core);
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver.edit(edit);
  std::vector<double> field(at(core->size()));
  solver.solve(values.data(), 1, field.data(), nullptr);
  const Eigen::MatrixXd exact = hf_test::dense_field(*core, sites, values);
  for (int v = 0; v < core->size(); ++v) EXPECT_NEAR(field[at(v)], exact(v), 1e-8 * exact.cwiseAbs().maxCoeff());
  EXPECT_LE(solver.counters().sweeps, 200u);
}

TEST_P(MixedSolver, gives_the_same_bits_for_threads_and_a_loaded_factor) {
  const PlainMesh mesh = two_bodies();
  std::vector<double> fields[3];
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 3; ++i) {
    hf_inner::surface::CoreOptions options = unformed(GetParam());
    if (i == 2) options.saved_factor = bytes;
    const auto core = hf_test::make_core(mesh, i == 1 ? 4 : 1, options);
    if (i == 0) {
      bytes.resize(hf_inner::factor::saved_factor_size(*core->factor));
      hf_inner::factor::save_factor(*core->factor, hf_inner::surface::grounded_hash(*core),
                                    {bytes.data(), bytes.size()}, *core->memory, *core->jobs);
    }
    EXPECT_EQ(core->factor->statistics().loaded, i == 2);
    EditScript script(core, {hf_test::EngineKind::green}, 2, 5, 0);
    script.apply(0, 0, 0, 20);
    fields[i].resize(at(core->size()) * 2);
    script.fields[0]->solve(fields[i].data());
  }
  EXPECT_EQ(fields[0], fields[1]);
  EXPECT_EQ(fields[0], fields[2]);
}

TEST_P(MixedSolver, is_the_only_engine_where_the_operator_is_not_formed) {
  const auto core = hf_test::make_core(two_bodies(), 1, unformed(GetParam()));
  EXPECT_THROW(hf_test::make_engine(hf_test::EngineKind::refactor, core), hf_inner::Error);
  hf_inner::surface::CoreOptions options;
  options.field_kind = GetParam();
  EXPECT_FALSE(hf_test::make_core(two_bodies(), 1, options)->root);
  EXPECT_FALSE(hf_test::make_core(closed_fan(hf_inner::surface::most_formed_valence), 1, options)->root);
  EXPECT_TRUE(hf_test::make_core(closed_fan(hf_inner::surface::most_formed_valence + 1), 1, options)->root);
}

INSTANTIATE_TEST_SUITE_P(Kinds, MixedSolver, testing::Values(FieldKind::biharmonic, FieldKind::biharmonic_graph),
                         [](const auto& info) { return info.param == FieldKind::biharmonic ? "areas" : "graph"; });

struct Shape {
  const char* name;
  PlainMesh (*make)(std::uint32_t);
  std::uint32_t size, rim;  // rim: its first vertex
};
void PrintTo(const Shape& s, std::ostream* out) { *out << s.name; }

class HighValence : public testing::TestWithParam<Shape> {};

// Sites across the rim, two and three beside one another, with and without a hub.
TEST_P(HighValence, fields_are_those_of_long_double_and_certified) {
  const Shape& shape = GetParam();
  const std::uint32_t rim = shape.rim, n = shape.size;
  for (const FieldKind kind : {FieldKind::biharmonic, FieldKind::biharmonic_graph}) {
    for (const bool crowded : {false, true}) {
      SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << " crowded " << crowded);
      hf_inner::surface::CoreOptions options;
      options.field_kind = kind;
      const auto core = hf_test::make_core(shape.make(n), 1, options);
      ASSERT_TRUE(core->root);
      std::vector<std::uint32_t> sites = {rim, rim + n / 3, rim + n / 2, rim + n / 7 * 6};
      std::vector<double> values = {1, -1, 0.5, 0.2};
      if (crowded) {
        sites.insert(sites.end(), {0, rim + 1, rim + 2, rim + n / 2 + 1});
        values.insert(values.end(), {0.3, 0.9, 0.95, 0.4});
      }
      hf_inner::field::ScalarField field(core, 1, 100);
      hf_inner::field::FieldEdit edit;
      edit.add.count = static_cast<std::uint32_t>(sites.size());
      edit.add.vertices = sites.data();
      edit.add_holds.values = values.data();
      std::vector<std::uint32_t> numbers(sites.size());
      field.edit(edit, numbers.data());
      std::vector<double> u(at(core->size()));
      field.solve(u.data());
      std::vector<int> places;
      for (const std::uint32_t v : sites) places.push_back(core->mesh.inner_of_given[v]);
      const auto exact = hf_test::MixedReference(core->root->laplacian, core->inverse_mass, places).field(values);
      double worst = 0, largest = 2;
      for (std::size_t v = 0; v < u.size(); ++v) {
        largest = std::max(largest, static_cast<double>(std::fabs(exact[v])));
        worst = std::max(worst, static_cast<double>(std::fabs(u[v] - exact[v])));
      }
      EXPECT_LE(worst, 1e-9 * largest);
      const hf_inner::field::Certificate found = hf_inner::field::certify(field);
      EXPECT_LE(found.error, 1e-9 * largest);
      EXPECT_EQ(found.site_error, 0);
      if (std::getenv("HF_SHOW"))
        std::printf("%s %u kind %d crowded %d: error %.2g of %.2g, estimate %.2g, sweeps %u, %.1f MB\n", shape.name, n,
                    static_cast<int>(kind), crowded, worst, largest, found.error, field.engine().counters().sweeps,
                    static_cast<double>(core->memory->peak_bytes()) / 1e6);
    }
  }
}

// A disc around a vertex of the rim holds about 90 vertices beside one another.
TEST(HighValenceDisc, holds_its_value) {
  const std::uint32_t n = 3000;
  hf_inner::surface::CoreOptions options;
  options.field_kind = FieldKind::biharmonic;
  const auto core = hf_test::make_core(closed_fan(n), 1, options);
  hf_inner::field::ScalarField field(core, 1, 10000);
  const std::uint32_t vertices[] = {1, 1 + n / 2, 1 + n / 3};
  const double values[] = {1, -1, 0}, radii[] = {0.1, 0, 0};
  hf_inner::field::FieldEdit edit;
  edit.add.count = 3;
  edit.add.vertices = vertices;
  edit.add_holds.radii = radii;
  edit.add_holds.values = values;
  std::uint32_t numbers[3];
  field.edit(edit, numbers);
  std::vector<double> u(at(core->size())), held;
  field.solve(u.data());
  std::vector<int> places;
  for (std::size_t slot = 0; slot < field.sites().slots().size(); ++slot) {
    const hf_inner::solve::SiteSet::Slot& site = field.sites().slots()[slot];
    if (site.used()) {
      places.push_back(site.site.vertex[0]);
      held.push_back(field.sites().values()[slot]);
    }
  }
  EXPECT_GT(places.size(), 80u);
  const auto exact = hf_test::MixedReference(core->root->laplacian, core->inverse_mass, places).field(held);
  for (std::size_t v = 0; v < u.size(); ++v) EXPECT_NEAR(u[v], static_cast<double>(exact[v]), 1e-9);
  EXPECT_LE(hf_inner::field::certify(field).error, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Shapes, HighValence,
                         testing::Values(Shape{"closed_fan_3000", closed_fan, 3000, 1},
                                         Shape{"closed_fan_20000", closed_fan, 20000, 1},
                                         Shape{"open_fan_3000", open_fan, 3000, 1},
                                         Shape{"double_cone_3000", double_cone, 3000, 2},
                                         Shape{"drum_5000", drum, 5000, 2}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
