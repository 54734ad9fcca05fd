// Poles: vertices of three or five quads where the caller wants them.
#include "quads/poles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "assets/shapes.h"
#include "base/error.h"
#include "field/vector_field.h"
#include "support/full.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;

// The distance from a place to the nearest inner vertex of so many quads.
double nearest_pole(const remesh::QuadMesh& mesh, Vec3 place, std::int32_t quads) {
  std::vector<std::int32_t> valence(mesh.position.size(), 0);
  for (const std::int32_t v : mesh.corner) ++valence[v];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < valence.size(); ++v) {
    if (valence[v] == quads) least = std::min(least, norm(mesh.position[v] - place));
  }
  return least;
}

std::shared_ptr<const surface::Core> torus() {
  static const std::shared_ptr<const surface::Core> core = hf_test::make_core(hf_test::torus(90, 45));
  return core;
}

remesh::QuadMesh quads_with(const surface::Core& core, std::shared_ptr<const surface::Core> owner,
                            const std::vector<QuadPole>& poles, double edge, std::int32_t relax = 0) {
  Vector<QuadGuide> guides(core.memory.get());
  add_pole_guides(core, {poles.data(), poles.size()}, edge, guides);
  FieldQuadOptions options;
  options.core = std::move(owner);
  options.edge_length = edge;
  options.relax = relax;
  options.guides = {guides.data(), guides.size()};
  options.poles = {poles.data(), poles.size()};
  return std::move(make_field_quads(options).mesh);
}

// At how many of 12 places a vertex of so many quads lies, to a fiftieth of an edge.
int held_places(const std::shared_ptr<const surface::Core>& core, std::int32_t quads, double edge,
                std::int32_t relax = 0) {
  std::mt19937 random(3);
  int held = 0;
  for (int i = 0; i < 12; ++i) {
    const Vec3 place = core->mesh.positions[random() % core->mesh.positions.size()];
    const remesh::QuadMesh mesh = quads_with(*core, core, {{place, quads, {}}}, edge, relax);
    held += nearest_pole(mesh, place, quads) < 0.02 * edge;
  }
  return held;
}

// A torus has no pole by itself, and a sphere has eight of three quads. A pole of five needs another one of three.
TEST(Poles, LieWhereTheyAreWanted) {
  const double edge = 0.03;
  EXPECT_TRUE(std::isinf(nearest_pole(quads_with(*torus(), torus(), {}, edge), {}, 3)));
  EXPECT_GE(held_places(torus(), 3, edge), 11);
  const samples::ShapeMesh shape = samples::sphere(24);
  const auto sphere = hf_test::make_core({shape.positions, shape.triangles});
  EXPECT_GE(held_places(sphere, 5, edge), 11);
  // evening out and fitting leave them there
  EXPECT_GE(held_places(sphere, 3, edge, 30), 11);
  if (!hf_test::is_full()) return;
  EXPECT_GE(held_places(sphere, 3, edge), 11);
  EXPECT_GE(held_places(torus(), 3, edge, 30), 11);
}

// The directions of the ring make a quarter turn: their fourth degree has an index of 1 or -1.
TEST(Poles, GuidesMakeAQuarterTurnAndBeginAlongTheDirection) {
  const auto core = torus();
  for (const std::int32_t quads : {3, 5}) {
    const Vec3 place = core->mesh.positions[700];
    const Vec3 up = field::vertex_normal(core->mesh, core->topology(), 700);
    const Vec3 direction = cross(up, Vec3{0.2, 0.7, 0.4});
    Vector<QuadGuide> guides(core->memory.get());
    const QuadPole pole{place, quads, direction};
    add_pole_guides(*core, {&pole, 1}, 0.04, guides);
    ASSERT_GT(guides.size(), 6u);
    const Vec3 x = unit_vector(direction), y = cross(up, x);
    for (const QuadGuide& guide : guides) {
      const Vec3 arm = core->mesh.positions[guide.vertex] - place;
      EXPECT_GT(norm(arm), 0.04);
      EXPECT_LT(norm(arm), 0.1);
      const double at_arm = std::atan2(dot(arm, y), dot(arm, x));
      const double wanted = 0.25 * (4 - quads) * at_arm;
      const double found = std::atan2(dot(guide.vector, y), dot(guide.vector, x));
      EXPECT_NEAR(std::remainder(found - wanted, 2 * std::acos(-1.0)), 0, 0.2);
      EXPECT_NEAR(dot(guide.vector, field::vertex_normal(core->mesh, core->topology(), guide.vertex)), 0, 1e-9);
    }
  }
}

TEST(Poles, APlaceBesideTheSurfaceIsTakenOntoIt) {
  const auto core = torus();
  const Vec3 place = core->mesh.positions[900], up = field::vertex_normal(core->mesh, core->topology(), 900);
  Vector<QuadGuide> on(core->memory.get()), beside(core->memory.get());
  const QuadPole first{place, 3, {1, 0, 0}}, second{place + 0.01 * up, 3, {1, 0, 0}};
  add_pole_guides(*core, {&first, 1}, 0.04, on);
  add_pole_guides(*core, {&second, 1}, 0.04, beside);
  ASSERT_EQ(on.size(), beside.size());
  for (std::size_t i = 0; i < on.size(); ++i) {
    EXPECT_EQ(on[i].vertex, beside[i].vertex);
    EXPECT_LT(norm(on[i].vector - beside[i].vector), 0.05);
  }
}

// Two triangles of one area, folded onto each other.
TEST(Poles, ASurfaceWithoutANormalIsRefusedByThePole) {
  const auto core = hf_test::make_core({{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0.5, 0}, {0, 1, 2, 0, 2, 3}});
  Vector<QuadGuide> guides(core->memory.get());
  const QuadPole poles[1] = {{core->mesh.positions[0], 3, {}}};
  try {
    add_pole_guides(*core, {poles, 1}, 0.1, guides);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(error.index(), 0u);
  }
}

}  // namespace
