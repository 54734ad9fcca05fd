// Unfolding: corners that face away from the normal of their quad are mended, and nothing moves away from the surface.
#include "remesh/unfold.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assets/creature.h"
#include "assets/shapes.h"
#include "quads/field_quads.h"
#include "remesh/relax.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::remesh;

constexpr double edge_length = 0.05;

struct Thrown {
  Thrown()
      : core(hf_test::make_core({shape.positions, shape.triangles})),
        surface(FluxSurface::make(core->mesh, core->topology(), *core->memory)),
        distance(surface, 0.25 * edge_length, *core->memory),
        mesh([&] {
          quads::FieldQuadOptions options;
          options.core = core;
          options.edge_length = edge_length;
          options.relax = 20;
          return quads::make_field_quads(options).mesh;
        }()) {}
  // Moves every tenth vertex by up to an edge, so that quads turn over.
  void fold(std::uint8_t pin) {
    for (std::int32_t v = 0; v < mesh.position.size(); v += 10) {
      const auto unit_of = [&](std::uint64_t k) {
        return samples::hash_to_unit(k, static_cast<std::uint64_t>(v)) - 0.5;
      };
      mesh.location[v] =
          walk_surface(surface, mesh.location[v], 2 * edge_length * Vec3{unit_of(1), unit_of(2), unit_of(3)});
      mesh.position[v] = position_of(surface, mesh.location[v]);
      mesh.pinned[v] = pin;
    }
    distance.turn_quads(mesh);
  }
  std::int32_t turned() const {
    std::int32_t count = 0;
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      Vec3 p[4], normal;
      for (std::int32_t k = 0; k < 4; ++k) p[k] = mesh.position[mesh.quad(f)[k]];
      for (std::int32_t k = 0; k < 4; ++k) normal = normal + cross(p[k], p[(k + 1) % 4]);
      for (std::int32_t k = 0; k < 4; ++k)
        count += dot(cross(p[(k + 1) % 4] - p[k], p[(k + 3) % 4] - p[k]), normal) <= 0;
    }
    return count;
  }
  samples::ShapeMesh shape = samples::jittered_torus(60, 40);
  std::shared_ptr<const surface::Core> core;
  FluxSurface surface;
  QuadDistance distance;
  QuadMesh mesh;
};

TEST(UnfoldQuads, NoCornerStaysTurnedOverAndTheMeshGetsNoFarther) {
  Thrown thrown;
  EXPECT_EQ(thrown.turned(), 0);
  for (const std::uint8_t pin : {QuadMesh::free, QuadMesh::snapped}) {
    Thrown now;
    now.fold(pin);
    ASSERT_GT(now.turned(), 20);
    const double before = now.distance.measure(now.mesh, 0, nullptr);
    const double after = unfold_quads(now.surface, now.distance, edge_length, before, now.mesh, *now.core->memory);
    EXPECT_EQ(now.turned(), 0);
    EXPECT_LE(after, before);
    EXPECT_LE(now.distance.measure(now.mesh, 0, nullptr), before);
    for (std::int32_t v = 0; v < now.mesh.position.size(); ++v)
      ASSERT_LT(norm(position_of(now.surface, now.mesh.location[v]) - now.mesh.position[v]), 1e-9) << v;
  }
}

TEST(UnfoldQuads, FeaturesStayAndAMeshWithoutTurnedCornersKeepsItsBits) {
  Thrown thrown;
  const QuadMesh flat = thrown.mesh;
  EXPECT_EQ(unfold_quads(thrown.surface, thrown.distance, edge_length, 0.25, thrown.mesh, *thrown.core->memory), 0.25);
  for (std::int32_t v = 0; v < flat.position.size(); ++v)
    EXPECT_EQ(norm(thrown.mesh.position[v] - flat.position[v]), 0);
  thrown.fold(QuadMesh::feature);
  const QuadMesh folded = thrown.mesh;
  const double before = thrown.distance.measure(thrown.mesh, 0, nullptr);
  unfold_quads(thrown.surface, thrown.distance, edge_length, before, thrown.mesh, *thrown.core->memory);
  for (std::int32_t v = 0; v < folded.position.size(); v += 10)
    EXPECT_EQ(norm(thrown.mesh.position[v] - folded.position[v]), 0);
}

// A vertex of a border that passed its neighbour comes back along the border. Corners of the border stay.
TEST(UnfoldQuads, VerticesOfABorderSlideAlongIt) {
  const auto core = hf_test::make_core(hf_test::grid(20, 20));
  const FluxSurface surface = FluxSurface::make(core->mesh, core->topology(), *core->memory);
  quads::FieldQuadOptions options;
  options.core = core;
  options.edge_length = edge_length;
  QuadMesh mesh = quads::make_field_quads(options).mesh;
  const QuadDistance distance(surface, 0.25 * edge_length, *core->memory);
  const auto turned = [&] {
    std::int32_t count = 0;
    for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
      for (std::int32_t k = 0; k < 4; ++k) {
        const std::int32_t* c = mesh.quad(f);
        const Vec3 p = mesh.position[c[k]];
        count += cross(mesh.position[c[(k + 1) % 4]] - p, mesh.position[c[(k + 3) % 4]] - p).z <= 0;
      }
    }
    return count;
  };
  ASSERT_EQ(turned(), 0);
  const Vec3 low = core->mesh.to_inner({0, 0, 0}), high = core->mesh.to_inner({20, 20, 0});
  std::int32_t moved = -1;
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = mesh.position[v];
    if (std::fabs(p.y - low.y) < 1e-9 && p.x > low.x + 3 * edge_length && p.x < high.x - 3 * edge_length) moved = v;
  }
  ASSERT_GE(moved, 0);
  ASSERT_TRUE(mesh.border[moved]);
  mesh.location[moved] = walk_surface(surface, mesh.location[moved], {1.1 * edge_length, 0, 0});
  mesh.position[moved] = position_of(surface, mesh.location[moved]);
  distance.turn_quads(mesh);
  ASSERT_GT(turned(), 0);
  unfold_quads(surface, distance, edge_length, edge_length, mesh, *core->memory);
  EXPECT_EQ(turned(), 0);
  EXPECT_NEAR(mesh.position[moved].y, low.y, 1e-12);
  std::int32_t corners = 0;
  for (std::int32_t v = 0; v < mesh.position.size(); ++v) {
    const Vec3 p = mesh.position[v];
    corners += (std::fabs(p.x - low.x) < 1e-9 || std::fabs(p.x - high.x) < 1e-9) &&
               (std::fabs(p.y - low.y) < 1e-9 || std::fabs(p.y - high.y) < 1e-9);
  }
  EXPECT_EQ(corners, 4);
}

// Where nothing may lie farther from the surface than a bound that is too small, all goes back.
TEST(UnfoldQuads, WhatWouldLieFartherGoesBack) {
  Thrown thrown;
  thrown.fold(QuadMesh::free);
  const QuadMesh folded = thrown.mesh;
  const double before = thrown.distance.measure(thrown.mesh, 0, nullptr);
  unfold_quads(thrown.surface, thrown.distance, edge_length, 0.01 * before, thrown.mesh, *thrown.core->memory);
  for (std::int32_t v = 0; v < folded.position.size(); ++v)
    EXPECT_EQ(norm(thrown.mesh.position[v] - folded.position[v]), 0);
}

}  // namespace
