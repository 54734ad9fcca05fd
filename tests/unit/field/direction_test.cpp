// Direction fields: the connection against closed forms, the solver against a dense oracle, edits against a fresh
// solve.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.h"
#include "base/index.h"
#include "direction_support.h"
#include "field/direction_field.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_test::Complex;
using hf_test::dense_field;
using hf_test::PlainMesh;
constexpr double pi = 3.14159265358979323846;

std::vector<hf_inner::Vec3> solved(const hf_inner::field::DirectionField& field) {
  std::vector<hf_inner::Vec3> out(at(field.solver().core().size()));
  field.solve(out.data());
  return out;
}

double largest_difference(const std::vector<hf_inner::Vec3>& a, const std::vector<hf_inner::Vec3>& b) {
  double worst = 0;
  for (std::size_t v = 0; v < a.size(); ++v) worst = std::max(worst, norm(a[v] - b[v]));
  return worst;
}

std::uint32_t add(hf_inner::field::DirectionField& field, std::uint32_t vertex, hf_inner::Vec3 vector) {
  const double v[3] = {vector.x, vector.y, vector.z};
  std::uint32_t site = 99;
  field.add(1, &vertex, v, &site);
  return site;
}

// An open tube: curved in space, flat in itself, and every round trip comes back unturned.
PlainMesh tube(std::uint32_t around, std::uint32_t along) {
  PlainMesh mesh = hf_test::grid(around, along, 1, 0.3, 6);
  PlainMesh out;
  for (std::uint32_t j = 0; j <= along; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double* p = mesh.positions.data() + 3 * (j * (around + 1) + i);
      const double angle = 2 * pi * i / around, radius = around / (2 * pi);
      out.positions.insert(out.positions.end(), {radius * std::cos(angle), radius * std::sin(angle), p[1]});
    }
  }
  for (const std::uint32_t v : mesh.triangles)
    out.triangles.push_back(v / (around + 1) * around + v % (around + 1) % around);
  return out;
}

// The surface of a plate of blocks with `holes` of them left out: closed, of that genus.
PlainMesh plate_with_holes(int holes) {
  const int nx = 4 * holes + 3, ny = 7;
  const auto solid = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= nx || j >= ny) return false;
    return !(j == 3 && i % 4 == 3 && i < 4 * holes);
  };
  PlainMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  std::mt19937 random(4);
  const auto vertex = [&](int i, int j, int k) {
    const auto found = known.find({i, j, k});
    if (found != known.end()) return found->second;
    const auto wobble = [&] { return 0.15 * (static_cast<double>(random() % 1000) / 1000 - 0.5); };
    mesh.positions.insert(mesh.positions.end(), {i + wobble(), j + wobble(), k + wobble()});
    return known[{i, j, k}] = mesh.vertex_count() - 1;
  };
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
  };
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      if (!solid(i, j)) continue;
      quad(vertex(i, j, 1), vertex(i + 1, j, 1), vertex(i + 1, j + 1, 1), vertex(i, j + 1, 1));
      quad(vertex(i, j, 0), vertex(i, j + 1, 0), vertex(i + 1, j + 1, 0), vertex(i + 1, j, 0));
      if (!solid(i - 1, j)) quad(vertex(i, j, 0), vertex(i, j, 1), vertex(i, j + 1, 1), vertex(i, j + 1, 0));
      if (!solid(i + 1, j))
        quad(vertex(i + 1, j, 0), vertex(i + 1, j + 1, 0), vertex(i + 1, j + 1, 1), vertex(i + 1, j, 1));
      if (!solid(i, j - 1)) quad(vertex(i, j, 0), vertex(i + 1, j, 0), vertex(i + 1, j, 1), vertex(i, j, 1));
      if (!solid(i, j + 1))
        quad(vertex(i, j + 1, 0), vertex(i, j + 1, 1), vertex(i + 1, j + 1, 1), vertex(i + 1, j + 1, 0));
    }
  }
  return mesh;
}

int euler_characteristic(const hf_inner::surface::Core& core) {
  return core.size() - core.topology().edge_count() + core.mesh.triangle_count();
}

TEST(Connection, curvature_of_a_closed_surface_sums_to_its_euler_characteristic) {
  const std::vector<std::pair<PlainMesh, int>> cases = {
      {hf_test::sphere(9), 2}, {hf_test::torus(30, 20, 0.3), 0}, {plate_with_holes(3), -4}};
  for (const auto& [mesh, euler] : cases) {
    const auto core = hf_test::make_core(mesh);
    ASSERT_EQ(euler_characteristic(*core), euler);
    const hf_inner::field::Connection connection =
        hf_inner::field::Connection::make(core->mesh, core->topology(), *core->memory);
    EXPECT_EQ(connection.irregular_count, 0u);
    EXPECT_EQ(connection.closed[0], 1);
    double sum = 0;
    for (const double c : connection.curvature) sum += c;
    EXPECT_NEAR(sum, 2 * pi * euler, 1e-10);
    // the turns around a triangle are its curvature
    for (std::int32_t t = 0; t < core->mesh.triangle_count(); ++t) {
      const std::int32_t* v = core->mesh.triangle(t);
      Complex trip = 1;
      for (int k = 0; k < 3; ++k) {
        for (std::int32_t i = core->topology().neighbour_start[at(v[k])];
             i < core->topology().neighbour_start[at(v[k]) + 1]; ++i) {
          if (core->topology().neighbour[at(i)] == v[(k + 1) % 3])
            trip *= std::polar(
                1.0, connection.turn(core->topology(), core->topology().neighbour_edge[at(i)], v[(k + 1) % 3]));
        }
      }
      EXPECT_LE(std::abs(trip - std::polar(1.0, connection.curvature[at(t)])), 1e-12);
    }
  }
}

TEST(Connection, frames_are_tangent_and_right_handed_on_any_surface) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    SCOPED_TRACE(name);
    const auto core = hf_test::make_core(mesh);
    const hf_inner::field::Connection c =
        hf_inner::field::Connection::make(core->mesh, core->topology(), *core->memory);
    for (std::size_t v = 0; v < c.x.size(); ++v) {
      EXPECT_NEAR(norm(c.normal[v]), 1, 1e-14);
      EXPECT_NEAR(norm(c.x[v]), 1, 1e-14);
      EXPECT_LE(std::fabs(dot(c.x[v], c.normal[v])), 1e-14);
      EXPECT_LE(norm(cross(c.normal[v], c.x[v]) - c.y[v]), 1e-14);
    }
    for (const double r : c.rotation) EXPECT_TRUE(std::isfinite(r));
  }
}

TEST(Direction, one_constraint_on_a_flat_patch_or_a_tube_gives_a_parallel_field) {
  const PlainMesh patch = hf_test::sheared_patch(12, 9, 0.4);
  const auto core = hf_test::make_core(patch);
  hf_inner::field::DirectionField field(core, 1, 100);
  add(field, 20, {1, 2, 0});
  for (const hf_inner::Vec3 v : solved(field)) EXPECT_LE(norm(v - hf_inner::Vec3{1, 2, 0}), 1e-10);

  // on a tube the field turns with the surface and keeps its part along the axis; K is singular there
  hf_inner::field::DirectionField around(hf_test::make_core(tube(24, 10)), 1, 100);
  const hf_inner::mesh::Mesh& mesh = around.solver().core().mesh;
  const hf_inner::Vec3 p0 = mesh.to_given(mesh.positions[0]);
  add(around, 0, 2 * ((1 / std::hypot(p0.x, p0.y)) * hf_inner::Vec3{-p0.y, p0.x, 0}) + hf_inner::Vec3{0, 0, 1});
  const std::vector<hf_inner::Vec3> u = solved(around);
  for (std::size_t v = 0; v < u.size(); ++v) {
    const hf_inner::Vec3 p = mesh.to_given(mesh.positions[v]);
    const hf_inner::Vec3 along = (1 / std::hypot(p.x, p.y)) * hf_inner::Vec3{-p.y, p.x, 0};
    EXPECT_NEAR(norm(u[v]), std::sqrt(5.0), 1e-9);
    if (v >= 24 && v + 24 < u.size()) {  // away from the border, where normals lean
      EXPECT_NEAR(dot(u[v], along), 2, 0.05);
      EXPECT_NEAR(u[v].z, 1, 0.05);
    }
  }
}

struct Script {
  Script(std::shared_ptr<const hf_inner::surface::Core> core, std::int32_t degree, std::uint32_t seed)
      : field(std::move(core), degree, 100000), random(seed) {}
  hf_inner::Vec3 random_vector() {
    std::normal_distribution<double> normal;
    return {normal(random), normal(random), normal(random)};
  }
  std::vector<std::uint32_t> present() const {
    std::vector<std::uint32_t> sites;
    for (std::uint32_t s = 0; s < field.constraints().size(); ++s) {
      if (field.constraints()[s].vertex >= 0) sites.push_back(s);
    }
    return sites;
  }
  std::uint32_t free_vertex() {
    for (;;) {
      const std::uint32_t v = random() % static_cast<std::uint32_t>(field.solver().core().size());
      bool taken = false;
      for (const auto& c : field.constraints()) taken = taken || c.vertex == static_cast<std::int32_t>(v);
      if (!taken) return v;
    }
  }
  void step() {
    const std::vector<std::uint32_t> sites = present();
    const std::uint32_t one = sites.empty() ? 0 : sites[random() % sites.size()];
    const hf_inner::Vec3 v = random_vector();
    const double vector[3] = {v.x, v.y, v.z}, angle = v.x;
    switch (sites.size() < 2 ? 0 : random() % 6) {
      case 0:
      case 1:
        add(field, free_vertex(), v);
        break;
      case 2:
        field.remove(1, &one);
        break;
      case 3: {
        const std::int32_t home = field.solver().core().mesh.component[at(field.constraints()[one].vertex)];
        for (;;) {
          const std::uint32_t to = free_vertex();
          if (field.solver().core().mesh.component[to] != home) continue;
          field.move(1, &one, &to);
          break;
        }
        break;
      }
      case 4:
        field.rotate(1, &one, &angle);
        break;
      default:
        field.set_vectors(1, &one, vector);
    }
  }
  hf_inner::field::DirectionField field;
  std::mt19937 random;
};

TEST(Direction, edits_give_the_dense_oracles_field) {
  PlainMesh mesh = hf_test::torus(12, 9, 0.2);
  append(mesh, hf_test::sheared_patch(7, 6, 0.5), 30);
  const auto core = hf_test::make_core(mesh);
  Script script(core, 1, 3);
  for (int round = 0; round < 60; ++round) {
    script.step();
    if (round % 4) continue;
    std::vector<std::int32_t> vertices;
    std::vector<Complex> values;
    for (const auto& c : script.field.constraints()) {
      if (c.vertex >= 0) {
        vertices.push_back(c.vertex);
        values.push_back(c.vector);
      }
    }
    const std::vector<Complex> exact = dense_field(script.field.solver(), vertices, values);
    const std::vector<hf_inner::Vec3> u = solved(script.field);
    for (std::int32_t v = 0; v < core->size(); ++v)
      EXPECT_LE(norm(u[at(v)] - script.field.solver().connection().to_space(v, exact[at(v)])), 1e-11)
          << "round " << round;
  }
}

TEST(Direction, many_edits_equal_a_fresh_solve) {
  const auto core = hf_test::make_core(hf_test::torus(40, 25, 0.2));
  for (const int degree : {1, 2, 4}) {
    Script script(core, degree, 5);
    for (int round = 0; round < 400; ++round) script.step();
    hf_inner::field::DirectionField fresh(core, degree, 1000);
    for (const auto& c : script.field.constraints()) {
      if (c.vertex >= 0)
        add(fresh, static_cast<std::uint32_t>(c.vertex), fresh.solver().connection().to_space(c.vertex, c.vector));
    }
    EXPECT_EQ(script.field.solver().counters().factorisations, 1u);
    EXPECT_LE(largest_difference(solved(script.field), solved(fresh)), 1e-10);
  }
}

TEST(Direction, thousands_of_constraints_go_into_the_factor_and_come_back) {
  const auto core = hf_test::make_core(hf_test::torus(60, 40, 0.2));
  hf_inner::field::DirectionField field(core, 1, 100000);
  std::vector<std::uint32_t> vertices, sites;
  std::vector<double> vectors;
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(core->size()); v += 2) {
    vertices.push_back(v);
    for (int k = 0; k < 3; ++k) vectors.push_back(normal(random));
  }
  sites.resize(vertices.size());
  field.add(static_cast<std::uint32_t>(vertices.size()), vertices.data(), vectors.data(), sites.data());
  EXPECT_TRUE(field.solver().eliminates());
  const auto expect_solved = [&](double tolerance) {
    std::vector<std::int32_t> inner;
    std::vector<Complex> values;
    for (const auto& c : field.constraints()) {
      if (c.vertex >= 0) {
        inner.push_back(c.vertex);
        values.push_back(c.vector);
      }
    }
    // residual of the free vertices: K z = 0 there
    const std::vector<hf_inner::Vec3> u = solved(field);
    const hf_inner::SymmetricMatrix& k = field.solver().matrix();
    std::vector<double> z(at(k.size())), kz(at(k.size()), 0.0);
    std::vector<int> fixed(at(k.size()), 0);
    for (std::int32_t v = 0; v < core->size(); ++v) {
      const Complex c = field.solver().connection().to_frame(v, u[at(v)]);
      const std::int32_t row = field.solver().system().unknown(v, 0);
      z[at(row)] = c.real();
      z[at(row) + 1] = c.imag();
    }
    for (const std::int32_t v : inner)
      fixed[at(field.solver().system().unknown(v, 0))] = fixed[at(field.solver().system().unknown(v, 0)) + 1] = 1;
    for (std::int32_t c = 0; c < k.size(); ++c) {
      for (std::int32_t i = k.column_start[at(c)]; i < k.column_start[at(c) + 1]; ++i)
        kz[at(k.row[at(i)])] += k.value[at(i)] * z[at(c)];
    }
    for (std::size_t r = 0; r < kz.size(); ++r) {
      if (!fixed[r]) {
        EXPECT_LE(std::fabs(kz[r]), tolerance);
      }
    }
  };
  expect_solved(1e-11);
  std::vector<std::uint32_t> gone(sites.begin() + 20, sites.end());
  field.remove(static_cast<std::uint32_t>(gone.size()), gone.data());
  EXPECT_FALSE(field.solver().eliminates());
  expect_solved(1e-10);
}

TEST(Direction, indices_sum_to_the_euler_characteristic_and_survive_edits) {
  for (const int holes : {0, 1, 2, 5}) {
    const auto core = hf_test::make_core(holes == 0 ? hf_test::sphere(10) : plate_with_holes(holes));
    const int euler = euler_characteristic(*core);
    EXPECT_EQ(euler, 2 - 2 * holes);
    for (const int degree : {1, 2, 4}) {
      Script script(core, degree, 7 + static_cast<std::uint32_t>(holes));
      for (int round = 0; round < 12; ++round) {
        script.step();
        int sum = 0;
        for (const hf_inner::field::Singularity& s : script.field.singularities()) sum += s.index;
        EXPECT_EQ(sum, degree * euler) << holes << " holes, degree " << degree << ", round " << round;
      }
    }
  }
}

TEST(Direction, a_lone_constraint_on_a_sphere_leaves_few_singularities) {
  hf_inner::field::DirectionField field(hf_test::make_core(hf_test::sphere(16)), 1, 10);
  add(field, 40, {1, 1, 1});
  EXPECT_LE(field.singularities().size(), 4u);
}

TEST(Direction, turning_and_rewriting_constraints_touch_no_factor_and_no_path) {
  Script script(hf_test::make_core(hf_test::torus(30, 20)), 1, 2);
  for (std::uint32_t v : {3u, 77u, 200u}) add(script.field, v, {1, 2, 3});
  const auto before = script.field.solver().counters();
  const std::uint32_t site = 1;
  const double quarter = pi / 2, vector[3] = {0, 1, 5};
  const hf_inner::Vec3 old = solved(script.field)[77];
  script.field.rotate(1, &site, &quarter);
  const hf_inner::Vec3 turned = solved(script.field)[77];
  EXPECT_NEAR(dot(old, turned), 0, 1e-12);
  EXPECT_NEAR(norm(old), norm(turned), 1e-12);
  EXPECT_GT(dot(cross(old, turned), script.field.solver().connection().normal[77]), 0);
  script.field.set_vectors(1, &site, vector);
  EXPECT_EQ(script.field.solver().counters().factorisations, before.factorisations);
  EXPECT_EQ(script.field.solver().counters().path_solves, before.path_solves);
}

TEST(Direction, moving_carries_the_vector_along_the_surface) {
  hf_inner::field::DirectionField field(hf_test::make_core(hf_test::sheared_patch(12, 9, 0.4)), 1, 10);
  const std::uint32_t site = add(field, 20, {1, 2, 0}), to = 100;
  field.move(1, &site, &to);
  EXPECT_LE(norm(solved(field)[100] - hf_inner::Vec3{1, 2, 0}), 1e-10);
  // there and back again
  Script script(hf_test::make_core(hf_test::torus(30, 20)), 1, 2);
  const std::uint32_t there = 321, home = 5, one = add(script.field, home, {1, 2, 3});
  add(script.field, 200, {0, 0, 1});
  const std::vector<hf_inner::Vec3> before = solved(script.field);
  script.field.move(1, &one, &there);
  script.field.move(1, &one, &home);
  EXPECT_LE(largest_difference(before, solved(script.field)), 1e-11);
}

TEST(Direction, fields_are_finite_and_tangent_on_dirty_surfaces) {
  for (const auto& [name, mesh] : hf_test::dirty_meshes()) {
    SCOPED_TRACE(name);
    for (const int degree : {1, 4}) {
      const auto core = hf_test::make_core(mesh);
      hf_inner::field::DirectionField field(core, degree, 100);
      for (std::int32_t v = 0; v < core->size(); v += 11) {
        const auto& c = field.solver().connection();
        add(field, static_cast<std::uint32_t>(core->mesh.given_of_inner[at(v)]), c.x[at(v)] + 0.3 * c.y[at(v)]);
      }
      const std::vector<hf_inner::Vec3> u = solved(field);
      for (std::size_t v = 0; v < u.size(); ++v) {
        EXPECT_TRUE(std::isfinite(norm(u[v])));
        EXPECT_LE(norm(u[v]), 1.1 * std::sqrt(1.09));
        EXPECT_LE(std::fabs(dot(u[v], field.solver().connection().normal[v])), 1e-12);
      }
      field.singularities();
    }
  }
}

TEST(Direction, does_not_depend_on_the_numbering_or_the_place_of_the_surface) {
  const PlainMesh mesh = hf_test::torus(20, 14, 0.25);
  hf_inner::field::DirectionField first(hf_test::make_core(mesh), 1, 10);
  const auto& frame = first.solver().connection();
  const std::uint32_t sites[] = {3, 100, 222};
  for (const std::uint32_t v : sites) add(first, v, frame.x[v] + frame.y[v]);
  const std::vector<hf_inner::Vec3> expected = solved(first);
  std::vector<std::uint32_t> place;
  hf_inner::field::DirectionField second(hf_test::make_core(hf_test::shuffled_and_rotated(mesh, 3, place)), 1, 10);
  const double a = 0.7 * 3, b = 1.3 * 3;  // as shuffled_and_rotated turns
  const auto turn = [&](hf_inner::Vec3 p) {
    const double x = std::cos(a) * p.x - std::sin(a) * p.y, y = std::sin(a) * p.x + std::cos(a) * p.y;
    return hf_inner::Vec3{x, std::cos(b) * y - std::sin(b) * p.z, std::sin(b) * y + std::cos(b) * p.z};
  };
  for (const std::uint32_t v : sites) add(second, place[v], turn(frame.x[v] + frame.y[v]));
  const std::vector<hf_inner::Vec3> found = solved(second);
  for (std::size_t v = 0; v < expected.size(); ++v) {
    const std::int32_t inner = second.solver().core().mesh.inner_of_given[place[v]];
    EXPECT_LE(norm(turn(expected[v]) - found[at(inner)]), 1e-10);
  }
}

TEST(Direction, refuses_bad_edits_and_stays_as_it_was) {
  hf_inner::field::DirectionField field(hf_test::make_core(hf_test::torus(12, 9)), 1, 4);
  add(field, 5, {1, 2, 3});
  add(field, 50, {1, 0, 3});
  const std::vector<hf_inner::Vec3> before = solved(field);
  const auto code = [&](auto&& edit, std::uint32_t* index) {
    try {
      edit();
    } catch (const hf_inner::Error& error) {
      *index = error.index();
      return error.code();
    }
    return static_cast<hf_result>(HF_OK);
  };
  std::uint32_t index = 0;
  const std::uint32_t vertices[] = {7, 5}, wrong[] = {7, 99999}, sites[] = {0, 0}, absent[] = {0, 8};
  const double vectors[] = {1, 2, 3, 4, 5, 6}, bad[] = {1, 2, 3, std::nan(""), 0, 0};
  EXPECT_EQ(code([&] { field.add(2, vertices, vectors, nullptr); }, &index), HF_ERROR_DUPLICATE);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(code([&] { field.add(2, wrong, vectors, nullptr); }, &index), HF_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(code([&] { field.set_vectors(2, absent, vectors); }, &index), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(code([&] { field.remove(2, sites); }, &index), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(code([&] { field.move(2, sites, vertices); }, &index), HF_ERROR_NOT_FOUND);
  const std::uint32_t both[] = {0, 1};
  EXPECT_EQ(code([&] { field.set_vectors(2, both, bad); }, &index), HF_ERROR_NON_FINITE);
  EXPECT_EQ(index, 1u);
  const hf_inner::Vec3 n = field.solver().connection().normal[5];
  const double upright[] = {n.x, n.y, n.z};
  EXPECT_EQ(code([&] { field.set_vectors(1, both, upright); }, &index), HF_ERROR_INVALID_ARGUMENT);
  const std::uint32_t five[] = {60, 61, 62, 63, 64};
  const double many[15] = {1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0};
  EXPECT_EQ(code([&] { field.add(5, five, many, nullptr); }, &index), HF_ERROR_TOO_LARGE);
  EXPECT_EQ(largest_difference(before, solved(field)), 0.0);
}

TEST(Direction, its_factor_does_not_fill_where_the_surface_has_other_edges) {
  // a third of the edges of this torus are not those of the intrinsic operator, whose ordering separates other things
  const PlainMesh mesh = hf_test::torus(160, 80, 0.35);
  hf_inner::surface::CoreOptions plain;
  plain.operator_kind = hf_inner::mesh::OperatorKind::cotangent;
  const hf_inner::field::DirectionSolver own(hf_test::make_core(mesh, 1, plain), 1), other(hf_test::make_core(mesh), 1);
  EXPECT_LE(other.statistics().entries, 1.2 * own.statistics().entries);
  EXPECT_LE(other.statistics().flops, 1.4 * own.statistics().flops);
}

}  // namespace
