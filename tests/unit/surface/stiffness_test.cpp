// Fields on surfaces whose stiffness was edited, against a core made with that stiffness and against dense solves.
#include "support/dirty_meshes.h"
#include "support/engines.h"
#include "support/hard_meshes.h"
#include "surface/edited_core.h"
#include "unit/solve/edit_script.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::solve::Site;
using hf_inner::surface::Core;
using hf_test::EditScript;

using Stiffness = std::shared_ptr<const hf_inner::Vector<double>>;
constexpr double always_rows = 1e9, never_rows = 0;

hf_test::PlainMesh islands() {
  hf_test::PlainMesh mesh = hf_test::grid(14, 11, 1, 0.3);
  append(mesh, hf_test::torus(16, 9), 30);
  return mesh;
}

// Vertices near a random one, as a brush takes them.
Stiffness stroke(const Core& core, const Stiffness& before, double radius, double s, std::uint32_t seed) {
  auto out = std::make_shared<hf_inner::Vector<double>>(at(core.size()), 1.0, core.memory.get());
  if (before) *out = *before;
  const hf_inner::Vec3 centre = core.mesh.positions[seed * 2654435761u % at(core.size())];
  for (std::size_t v = 0; v < out->size(); ++v) {
    if (norm(core.mesh.positions[v] - centre) < radius) (*out)[v] = s;
  }
  return out;
}

// The field of three sites an island, one of them soft and one in a triangle.
std::vector<Site> sites_on(const Core& core) {
  std::vector<Site> sites;
  for (Index c = 0; c < core.mesh.component_count(); ++c) {
    std::vector<Index> there;
    for (Index v = 0; v < core.size(); ++v) {
      if (core.mesh.component[at(v)] == c) there.push_back(v);
    }
    sites.push_back(Site::at_vertex(core.mesh, there[3]));
    sites.push_back(Site::at_vertex(core.mesh, there[there.size() - 5], 0.3));
    sites.push_back(Site::at_vertex(core.mesh, there[there.size() / 2]));
  }
  return sites;
}

double value_of(std::size_t site) { return site % 2 == 0 ? 1.0 : -2.5; }

std::vector<double> field_of(const std::shared_ptr<const Core>& core) {
  const std::vector<Site> sites = sites_on(*core);
  std::vector<Index> slots;
  std::vector<double> values;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    slots.push_back(static_cast<Index>(i));
    values.push_back(value_of(i));
  }
  const auto solver = hf_inner::solve::SiteSolver::make(core);
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver->edit(edit);
  std::vector<double> u(at(core->size()));
  solver->solve(values.data(), 1, u.data(), nullptr);
  return u;
}

double error_of(const std::shared_ptr<const Core>& core) {
  const std::vector<Site> sites = sites_on(*core);
  Eigen::MatrixXd exact(static_cast<Eigen::Index>(sites.size()), 1);
  for (std::size_t i = 0; i < sites.size(); ++i) exact(static_cast<Eigen::Index>(i), 0) = value_of(i);
  const std::vector<double> u = field_of(core);
  const Eigen::MatrixXd field = hf_test::dense_field(*core, sites, exact);
  double worst = 0;
  for (Index v = 0; v < core->size(); ++v) worst = std::max(worst, std::fabs(u[at(v)] - field(v, 0)));
  return worst;
}

TEST(Stiffness, AnEditedCoreHasTheOperatorOfAFreshOne) {
  for (const double most : {always_rows, never_rows}) {
    const auto plain = hf_test::make_core(islands());
    hf_inner::surface::CoreOptions options;
    options.stiffness = stroke(*plain, nullptr, 0.06, 30, 5);
    const auto fresh = hf_test::make_core(islands(), 1, options);
    const auto edited = hf_inner::surface::edit_core(plain, options.stiffness, most);
    EXPECT_EQ(edited->factored != nullptr, most == always_rows);
    ASSERT_EQ(edited->matrix().row, fresh->matrix().row);
    EXPECT_EQ(edited->matrix().value, fresh->matrix().value);
    EXPECT_EQ(edited->mean_diagonal, fresh->mean_diagonal);
    EXPECT_EQ(edited->ground, fresh->ground);
    EXPECT_NE(edited->matrix().value, plain->matrix().value);
  }
}

TEST(Stiffness, FieldsAreThoseOfADenseSolve) {
  for (const double s : {1e-4, 1e-2, 3.0, 1e2, 1e4}) {
    const auto plain = hf_test::make_core(islands());
    for (const double most : {always_rows, never_rows}) {
      const auto edited = hf_inner::surface::edit_core(plain, stroke(*plain, nullptr, 0.06, s, 5), most);
      EXPECT_LT(error_of(edited), 1e-10) << s << " " << most;
    }
  }
}

// Rows for a region of 1e4 beside one of 1e-4 lose eight digits; corrections bring them back.
TEST(Stiffness, ASoftRegionBesideAStiffOneKeepsItsDigits) {
  const auto plain = hf_test::make_core(islands());
  const Stiffness stiff = stroke(*plain, nullptr, 0.1, 1e4, 11), both = stroke(*plain, stiff, 0.07, 1e-4, 77);
  EXPECT_LT(error_of(hf_inner::surface::edit_core(plain, both, always_rows)), 1e-10);
}

TEST(Stiffness, AFactorThatWasMadeAgainIsLongWhereAFreshOneIs) {
  const hf_test::PlainMesh mesh = hf_test::sheared_patch(12, 8, 30);
  const auto plain = hf_test::make_core(mesh);
  EXPECT_FALSE(plain->is_long);
  hf_inner::surface::CoreOptions options;
  auto patches = std::make_shared<hf_inner::Vector<double>>(at(plain->size()), 1e-4, plain->memory.get());
  for (std::size_t v = 0; v < patches->size(); v += 2) (*patches)[v] = 1e4;
  options.stiffness = patches;
  EXPECT_TRUE(hf_test::make_core(mesh, 1, options)->is_long);
  EXPECT_TRUE(hf_inner::surface::edit_core(plain, options.stiffness, never_rows)->is_long);
}

// A stroke over a thousand vertices, and one over a whole island, have the fields of a new factor: here the inside has
// supernodes of many columns.
TEST(Stiffness, LargeStrokesHaveTheFieldsOfANewFactor) {
  hf_test::PlainMesh mesh = hf_test::torus(70, 40);
  append(mesh, hf_test::grid(14, 11, 1, 0.3), 30);
  const auto plain = hf_test::make_core(mesh);
  for (const double radius : {0.07, 0.6}) {
    auto stiffness =
        std::make_shared<hf_inner::Vector<double>>(*stroke(*plain, nullptr, radius, 40, 5), plain->memory.get());
    ASSERT_GT(std::count(stiffness->begin(), stiffness->end(), 40.0), 800);
    for (std::size_t v = 0; v < stiffness->size(); v += 3) (*stiffness)[v] = (*stiffness)[v] == 40 ? 0.2 : 1;
    const auto rows = hf_inner::surface::edit_core(plain, {stiffness}, always_rows),
               fresh = hf_inner::surface::edit_core(plain, {stiffness}, never_rows);
    ASSERT_EQ(rows->factored, plain);
    const std::vector<double> a = field_of(rows), b = field_of(fresh);
    for (std::size_t v = 0; v < a.size(); ++v) ASSERT_NEAR(a[v], b[v], 1e-11) << v;
  }
}

// Strokes over strokes: rows are always counted from the factor, so errors do not add up.
TEST(Stiffness, ManyStrokesLoseNoDigits) {
  auto core = hf_test::make_core(islands());
  const auto first = core;
  Stiffness stiffness;
  std::uint32_t factors = 0;
  for (std::uint32_t i = 0; i < 60; ++i) {
    stiffness = stroke(*core, stiffness, 0.03 + 0.002 * (i % 7), std::pow(10.0, -2.0 + i % 5), 31 * i + 7);
    const auto next = hf_inner::surface::edit_core(core, stiffness, i % 20 == 19 ? never_rows : always_rows);
    factors += next->factored == nullptr;
    if (next->factored) {
      EXPECT_EQ(next->factored, core->factored ? core->factored : core);
    }
    core = next;
    if (i % 6 == 0) {
      ASSERT_LT(error_of(core), 1e-10) << i;
    }
  }
  EXPECT_EQ(factors, 3u);
  EXPECT_EQ(hf_inner::surface::edit_core(core, {}), first);
}

// Ribbons whose fields lose digits, needles, books of sheets on one edge, holes, faults, and a doubled sheet.
TEST(Stiffness, HardMeshesAreEditedToo) {
  hf_test::PlainMesh ribbon = hf_test::grid(300, 1), doubled = hf_test::grid(6, 5, 1, 0.2);
  const std::vector<std::uint32_t> once = doubled.triangles;
  for (std::size_t t = 0; t + 2 < once.size(); t += 3)
    doubled.triangles.insert(doubled.triangles.end(), {once[t], once[t + 2], once[t + 1]});
  const std::vector<hf_test::PlainMesh> meshes = {ribbon,
                                                  hf_test::sheared_patch(20, 12, 30),
                                                  hf_test::book(3, 8, 6, 0.4),
                                                  hf_test::slab_with_holes(3),
                                                  hf_test::dirty(),
                                                  doubled,
                                                  hf_test::disk(6)};
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto plain = hf_test::make_core(meshes[i]);
    for (const double s : {0.01, 100.0, 1e4}) {
      Stiffness stiffness = stroke(*plain, nullptr, 0.1, s, 11);
      stiffness = stroke(*plain, stiffness, 0.07, 1 / s, 77);
      const auto rows = hf_inner::surface::edit_core(plain, {stiffness}, always_rows),
                 fresh = hf_inner::surface::edit_core(plain, {stiffness}, never_rows);
      const double error = error_of(rows), least = error_of(fresh);
      EXPECT_LT(error, std::max(1e-10, 20 * least)) << i << " " << s << " fresh " << least;
    }
  }
}

// Edits, rebases, refused batches, partial fields and previews of sites on an edited surface.
TEST(Stiffness, SitesAreEditedAsOnAnyOtherSurface) {
  const auto plain = hf_test::make_core(islands());
  const auto core = hf_inner::surface::edit_core(plain, stroke(*plain, nullptr, 0.08, 25, 3), always_rows);
  ASSERT_NE(core->factored, nullptr);
  EditScript script(core, hf_test::engines(), 2, 17, 0);
  for (int i = 0; i < 60; ++i) {
    script.step(i % 20 < 10 ? 20 : 3, 6);
    if (i % 12 == 5) script.refused_step();
    if (i % 10 != 9 || script.count() == 0) continue;
    std::vector<Site> used;
    Eigen::MatrixXd values;
    script.present(used, values);
    script.expect_fields(hf_test::dense_field(*core, used, values), used, 1e-9, 1e-4);
  }
}

TEST(Stiffness, OtherKindsOfFieldAreMadeAnew) {
  for (const auto kind : {hf_inner::mesh::FieldKind::biharmonic, hf_inner::mesh::FieldKind::biharmonic_graph}) {
    for (const std::int32_t valence : {hf_inner::surface::most_formed_valence, 5}) {
      hf_inner::surface::CoreOptions options;
      options.field_kind = kind;
      options.formed_valence = valence;
      const auto plain = hf_test::make_core(islands(), 1, options);
      const auto edited = hf_inner::surface::edit_core(plain, stroke(*plain, nullptr, 0.06, 20, 5));
      EXPECT_EQ(edited->root != nullptr, valence == 5);
      for (std::size_t c = 0; c < plain->mean_diagonal.size(); ++c)
        EXPECT_NEAR(edited->mean_diagonal[c], plain->mean_diagonal[c], 1e-12 * plain->mean_diagonal[c]);
      EXPECT_LT(error_of(edited), 1e-6) << static_cast<int>(kind) << " " << valence;
    }
  }
}

// Bi-harmonic operators square the stiffness. A sheared sheet with all that may be given has a matrix of 20 digits.
TEST(Stiffness, BiharmonicOperatorsLimitIt) {
  hf_inner::surface::CoreOptions options;
  options.field_kind = hf_inner::mesh::FieldKind::biharmonic;
  const auto plain = hf_test::make_core(hf_test::sheared_patch(12, 8, 30), 1, options);
  const Stiffness both = stroke(*plain, stroke(*plain, nullptr, 0.1, 1e4, 11), 0.07, 1e-4, 77),
                  limited = stroke(*plain, stroke(*plain, nullptr, 0.1, 100, 11), 0.07, 0.01, 77);
  const auto edited = hf_inner::surface::edit_core(plain, both);
  EXPECT_EQ(edited->stiffness, both);
  EXPECT_EQ(edited->matrix().value, hf_inner::surface::edit_core(plain, limited)->matrix().value);
}

TEST(Stiffness, MovedSolversHaveTheFieldsOfNewOnes) {
  const auto plain = hf_test::make_core(islands());
  const auto edited = hf_inner::surface::edit_core(plain, stroke(*plain, nullptr, 0.07, 40, 9), always_rows);
  for (const bool screened : {false, true}) {
    std::vector<double> u(at(plain->size())), again(u), fresh(u);
    const std::uint32_t vertices[3] = {2, 60, 200};
    const double values[3] = {1, -1, 4};
    const std::vector<double> strength(u.size(), 3.0), target(u.size(), 0.5);
    const auto fill = [&](hf_inner::field::ScalarField& field) {
      hf_inner::field::FieldEdit edit;
      edit.add = {3, vertices, nullptr, nullptr};
      edit.add_holds.values = values;
      field.edit(edit, nullptr);
      if (screened) field.set_screening(strength, target.data());
    };
    hf_inner::field::ScalarField field(plain, 1, 100), made(edited, 1, 100);
    fill(field);
    fill(made);
    field.solve(u.data());
    made.solve(fresh.data());
    field.move_to(edited);
    field.solve(again.data());
    EXPECT_EQ(again, fresh);
    EXPECT_NE(again, u);
    field.move_to(plain);
    field.solve(again.data());
    EXPECT_EQ(again, u);
  }
}

}  // namespace
