// Sites of finite radius: geodesic discs, fields that do not change with the mesh, and what a disc is to its user.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "assets/shapes.h"
#include "base/error.h"
#include "base/index.h"
#include "field/scalar_field.h"
#include "mesh/geodesic_disc.h"
#include "support/engines.h"
#include "support/full.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_test::PlainMesh;

PlainMesh from_shape(samples::ShapeMesh shape) { return {std::move(shape.positions), std::move(shape.triangles)}; }

struct Field {
  explicit Field(const PlainMesh& mesh, hf_test::EngineKind engine = hf_test::EngineKind::green,
                 hf_inner::surface::CoreOptions options = {})
      : core(hf_test::make_core(mesh, 1, options)), field(core, 1, 5000, hf_test::make_engine(engine, core)) {}
  std::vector<std::uint32_t> add(const std::vector<std::uint32_t>& vertices, const std::vector<double>& values,
                                 const std::vector<double>& radii, const std::vector<double>& stiffness = {}) {
    hf_inner::field::FieldEdit edit;
    edit.add.count = static_cast<std::uint32_t>(vertices.size());
    edit.add.vertices = vertices.data();
    edit.add_holds.radii = radii.data();
    edit.add_holds.values = values.data();
    if (!stiffness.empty()) edit.add_holds.stiffness = stiffness.data();
    std::vector<std::uint32_t> numbers(vertices.size());
    field.edit(edit, numbers.data());
    return numbers;
  }
  std::vector<double> solve() const {
    std::vector<double> u(at(field.core().size()));
    field.solve(u.data());
    return u;
  }
  std::shared_ptr<const hf_inner::surface::Core> core;
  hf_inner::field::ScalarField field;
};

TEST(GeodesicDisc, is_exact_on_a_plane) {
  hf_test::PlainMesh mesh = hf_test::grid(60, 60, 0.1, 0.3, 5);
  const auto core = hf_test::make_core(mesh);
  const std::int32_t middle = 30 * 61 + 30;
  const std::int32_t point[3] = {middle, -1, -1};
  const double weight[3] = {1, 0, 0};
  const auto disc =
      hf_inner::mesh::geodesic_disc(core->mesh, core->topology(), point, weight, 2.0 / core->mesh.scale, *core->memory);
  ASSERT_GT(disc.size(), 1000u);
  double last = 0;
  for (const hf_inner::mesh::DiscVertex& v : disc) {
    const hf_inner::Vec3 d = core->mesh.positions[at(v.vertex)] - core->mesh.positions[at(middle)];
    EXPECT_NEAR(v.distance, norm(d), 1e-12);
    EXPECT_GE(v.distance, last);
    last = v.distance;
  }
}

TEST(GeodesicDisc, follows_great_circles_from_a_point_in_a_face) {
  const PlainMesh mesh = from_shape(samples::sphere(60));
  const auto core = hf_test::make_core(mesh);
  std::int32_t point[3];
  const double weight[3] = {0.2, 0.5, 0.3};
  hf_inner::Vec3 source;
  for (int k = 0; k < 3; ++k) {
    point[k] = core->mesh.triangle(777)[k];
    source = source + weight[k] * core->mesh.positions[at(point[k])];
  }
  const double radius = norm(core->mesh.positions[0]);
  source = (radius / norm(source)) * source;
  const auto disc = hf_inner::mesh::geodesic_disc(core->mesh, core->topology(), point, weight, radius, *core->memory);
  for (const hf_inner::mesh::DiscVertex& v : disc) {
    const double arc = radius * std::atan2(norm(cross(source, core->mesh.positions[at(v.vertex)])),
                                           dot(source, core->mesh.positions[at(v.vertex)]));
    EXPECT_NEAR(v.distance, arc, 0.01 * radius);
  }
}

// Share of the area where the field of two opposite discs lies in (0.4, 0.6), as triangles' mean values.
double middle_share(std::uint32_t side, double radius) {
  const samples::ShapeMesh shape = samples::jittered_torus(side, side);
  Field field(from_shape(shape));
  field.add({0, side * side / 2 + side / 2}, {0, 1}, {radius, radius});
  const std::vector<double> u = field.solve();
  const hf_inner::mesh::Mesh& mesh = field.field.core().mesh;
  double inside = 0, all = 0;
  for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::int32_t* v = mesh.triangle(t);
    const double area = norm(cross(mesh.positions[at(v[1])] - mesh.positions[at(v[0])],
                                   mesh.positions[at(v[2])] - mesh.positions[at(v[0])]));
    const double mean = (u[at(v[0])] + u[at(v[1])] + u[at(v[2])]) / 3;
    all += area;
    inside += mean > 0.4 && mean < 0.6 ? area : 0;
  }
  return inside / all;
}

TEST(FiniteRadius, field_shares_stay_from_4096_to_262144_vertices_where_points_drift) {
  const double box = hf_test::make_core(from_shape(samples::jittered_torus(16, 16)))->mesh.report.bounding_box_diagonal;
  std::vector<std::uint32_t> sides = {64, 128, 256};
  if (hf_test::is_full()) sides.push_back(512);
  std::vector<double> discs, points;
  for (const std::uint32_t side : sides) {
    discs.push_back(middle_share(side, 0.06 * box));
    points.push_back(middle_share(side, 0));
  }
  for (std::size_t i = 0; i < sides.size(); ++i)
    std::printf("%u vertices: share in (0.4, 0.6) of discs %.4f, of points %.4f\n", sides[i] * sides[i], discs[i],
                points[i]);
  for (const double share : discs) EXPECT_NEAR(share, discs.back(), 0.02 * discs.back());
  EXPECT_GT(points.back() - points.front(), 0.03) << "points should drift: the discs show nothing";
}

TEST(FiniteRadius, holds_its_value_on_the_whole_disc_and_its_flux_balances) {
  for (const hf_test::EngineKind engine : {hf_test::EngineKind::green, hf_test::EngineKind::refactor}) {
    Field field(hf_test::torus(60, 40), engine);
    const auto numbers = field.add({0, 1220}, {-2, 3}, {0.5, 0.3});
    const std::vector<double> u = field.solve();
    EXPECT_EQ(field.field.sites().count(), 2u);
    int on_disc = 0;
    for (const double x : u) {
      EXPECT_GE(x, -2 - 1e-12);
      EXPECT_LE(x, 3 + 1e-12);
      on_disc += std::fabs(x + 2) < 1e-12;
    }
    EXPECT_GT(on_disc, 20);
    hf_inner::Vector<double> flux(field.field.core().memory.get());
    field.field.flux(flux);
    double sum = 0, one = 0;
    for (std::size_t s = 0; s < flux.size(); ++s) {
      sum += flux[s];
      const auto& slot = field.field.sites().slots()[s];
      if (s == numbers[1] || slot.owner == static_cast<std::int32_t>(numbers[1])) one += flux[s];
    }
    EXPECT_NEAR(sum, 0, 1e-9);
    EXPECT_GT(one, 1);
  }
}

TEST(FiniteRadius, moves_and_changes_value_as_one_site_and_leaves_nothing_behind) {
  Field field(hf_test::torus(60, 40));
  const auto numbers = field.add({0, 1220}, {0, 1}, {0.5, 0.3});
  const std::vector<double> before = field.solve();
  const std::uint32_t away = 700, back = 1220;
  const double two = 2, one = 1;
  hf_inner::field::FieldEdit edit;
  edit.move_count = 1;
  edit.move_sites = &numbers[1];
  edit.move_to.count = 1;
  edit.move_to.vertices = &away;
  edit.set_count = 1;
  edit.set_sites = &numbers[1];
  edit.set_values = &two;
  field.field.edit(edit, nullptr);
  const std::vector<double> moved = field.solve();
  EXPECT_NEAR(moved[700], 2.0, 1e-12);
  EXPECT_GT(std::fabs(moved[1220] - 2), 1e-3);
  edit.move_to.vertices = &back;
  edit.set_values = &one;
  field.field.edit(edit, nullptr);
  const std::vector<double> after = field.solve();
  for (std::size_t v = 0; v < before.size(); ++v) EXPECT_NEAR(after[v], before[v], 1e-12);
  hf_inner::field::FieldEdit out;
  out.remove_count = 2;
  out.remove_sites = numbers.data();
  field.field.edit(out, nullptr);
  EXPECT_EQ(field.field.sites().count(), 0u);
  for (const auto& slot : field.field.sites().slots()) EXPECT_FALSE(slot.used());
  EXPECT_EQ(field.add({0}, {0}, {0.5}).size(), 1u);
}

hf_result code_of(const std::function<void()>& work, std::uint32_t* index = nullptr) {
  try {
    work();
  } catch (const hf_inner::Error& error) {
    if (index) *index = error.index();
    return error.code();
  }
  return HF_OK;
}

TEST(FiniteRadius, refuses_overlaps_hidden_numbers_and_too_many_vertices) {
  Field field(hf_test::torus(60, 40));
  const auto numbers = field.add({0}, {1}, {0.5});
  const std::vector<double> before = field.solve();
  std::uint32_t index = 99;
  EXPECT_EQ(code_of([&] { field.add({1200, 1}, {2, 5}, {0, 0}); }, &index), HF_ERROR_CONFLICT);  // inside the disc
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(code_of([&] { field.add({1}, {1}, {0}); }), HF_ERROR_DUPLICATE);
  EXPECT_EQ(code_of([&] { field.add({1200}, {1}, {20.0}); }), HF_ERROR_DUPLICATE);  // reaches the other disc
  EXPECT_EQ(code_of([&] { field.add({1200}, {1}, {-1.0}); }), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(code_of([&] { field.add({1200}, {1}, {std::nan("")}); }), HF_ERROR_NON_FINITE);
  std::uint32_t hidden = 0;
  for (std::uint32_t s = 0; s < field.field.sites().slots().size(); ++s) {
    if (field.field.sites().slots()[s].owner == static_cast<std::int32_t>(numbers[0])) hidden = s;
  }
  ASSERT_NE(hidden, numbers[0]);
  EXPECT_EQ(code_of([&] {
              hf_inner::field::FieldEdit edit;
              edit.remove_count = 1;
              edit.remove_sites = &hidden;
              field.field.edit(edit, nullptr);
            }),
            HF_ERROR_NOT_FOUND);
  EXPECT_EQ(field.solve(), before);
  hf_inner::field::ScalarField small(field.field.shared_core(), 1, 10);
  const std::uint32_t v = 0;
  const double radius = 0.5;
  hf_inner::field::FieldEdit edit;
  edit.add.count = 1;
  edit.add.vertices = &v;
  edit.add_holds.radii = &radius;
  EXPECT_EQ(code_of([&] { small.edit(edit, nullptr); }), HF_ERROR_TOO_LARGE);
}

TEST(FiniteRadius, below_the_spacing_is_a_point_and_above_the_surface_is_a_constant) {
  Field tiny(hf_test::torus(60, 40)), point(hf_test::torus(60, 40)), huge(hf_test::torus(60, 40));
  tiny.add({0, 1220}, {0, 1}, {1e-9, 1e-9});
  point.add({0, 1220}, {0, 1}, {0, 0});
  EXPECT_EQ(tiny.solve(), point.solve());
  huge.add({5}, {4}, {1e6});
  for (const double x : huge.solve()) EXPECT_NEAR(x, 4, 1e-12);
}

TEST(FiniteRadius, soft_discs_share_their_stiffness) {
  Field soft(hf_test::torus(60, 40));
  soft.add({0, 1220}, {0, 1}, {0.4, 0.4}, {1e6, 1e6});
  Field hard(hf_test::torus(60, 40));
  hard.add({0, 1220}, {0, 1}, {0.4, 0.4});
  const auto a = soft.solve(), b = hard.solve();
  for (std::size_t v = 0; v < a.size(); ++v) EXPECT_NEAR(a[v], b[v], 1e-3);
}

TEST(FiniteRadius, holds_whole_discs_of_a_biharmonic_field) {
  hf_inner::surface::CoreOptions options;
  options.field_kind = hf_inner::mesh::FieldKind::biharmonic;
  Field field(hf_test::torus(60, 40), hf_test::EngineKind::green, options);
  field.add({0, 1220}, {0, 1}, {0.5, 0.5});
  int held = 0;
  for (const double x : field.solve()) held += x == 1.0;
  EXPECT_GT(held, 20);
}

}  // namespace
