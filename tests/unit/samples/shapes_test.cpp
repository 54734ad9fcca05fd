// The generated test shapes are what their names promise.
#include "assets/shapes.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "mesh_checks.h"

namespace {

using mesh_checks::examine;
using mesh_checks::Report;
using samples::ShapeMesh;

void expect_closed_sphere(const ShapeMesh& mesh, const char* name, double least_angle = 10) {
  SCOPED_TRACE(name);
  const Report report = examine(mesh.positions, mesh.triangles);
  EXPECT_TRUE(report.manifold);
  EXPECT_EQ(report.borders, 0u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.euler(), 2);
  EXPECT_EQ(report.used_vertices, mesh.vertex_count());
  EXPECT_GT(report.volume, 0);
  EXPECT_GT(report.smallest_angle, least_angle);
}

TEST(Shapes, TorusHasExactlyNuTimesNvVertices) {
  const uint32_t sizes[4][3] = {{205, 206, 42230}, {290, 290, 84100}, {416, 416, 173056}, {551, 552, 304152}};
  for (const auto& [nu, nv, vertices] : sizes) {
    const ShapeMesh mesh = samples::jittered_torus(nu, nv);
    EXPECT_EQ(mesh.vertex_count(), vertices);
    EXPECT_EQ(mesh.triangle_count(), 2 * vertices);
  }
}

TEST(Shapes, TorusIsOneClosedManifoldOfGenusOne) {
  const ShapeMesh mesh = samples::jittered_torus(205, 206);
  const Report report = examine(mesh.positions, mesh.triangles);
  EXPECT_TRUE(report.manifold);
  EXPECT_EQ(report.borders, 0u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.euler(), 0);
  EXPECT_GT(report.smallest_angle, 1);
  // volume 2 pi^2 R r^2
  EXPECT_NEAR(report.volume, 2 * 9.8696044 * 0.16, 0.01);
}

TEST(Shapes, TorusVerticesLieOnTheTorusAndJitterIsBounded) {
  const ShapeMesh jittered = samples::jittered_torus(60, 40), regular = samples::jittered_torus(60, 40, 0);
  double moved = 0;
  for (size_t v = 0; v < jittered.positions.size(); v += 3) {
    const double x = jittered.positions[v], y = jittered.positions[v + 1], z = jittered.positions[v + 2];
    const double ring = std::sqrt(x * x + z * z) - 1;
    EXPECT_NEAR(std::sqrt(ring * ring + y * y), 0.4, 1e-12);
    double d = 0;
    for (size_t k = 0; k < 3; ++k) d += std::pow(jittered.positions[v + k] - regular.positions[v + k], 2);
    moved = std::max(moved, std::sqrt(d));
  }
  EXPECT_GT(moved, 0.02);
  // a quarter of the spacing in each direction: 0.25 * 2 pi 1.4 / 60 and 0.25 * 2 pi 0.4 / 40
  EXPECT_LT(moved, 0.25 * std::hypot(6.2832 * 1.4 / 60, 6.2832 * 0.4 / 40) * 1.01);
}

TEST(Shapes, TheSameArgumentsGiveTheSameBits) {
  EXPECT_EQ(samples::jittered_torus(31, 17).positions, samples::jittered_torus(31, 17).positions);
  EXPECT_NE(samples::jittered_torus(31, 17, 0.25, 1, 0.4, 1).positions,
            samples::jittered_torus(31, 17, 0.25, 1, 0.4, 2).positions);
  EXPECT_EQ(samples::cactus(3000).positions, samples::cactus(3000).positions);
}

TEST(Shapes, ClosedShapesAreClosedAndFaceOutwards) {
  expect_closed_sphere(samples::sphere(1), "icosahedron");
  expect_closed_sphere(samples::sphere(12), "sphere");
  expect_closed_sphere(samples::box(1, 2, 3, 2, 5, 4), "box");
  expect_closed_sphere(samples::bar(19), "bar");
  expect_closed_sphere(samples::cylinder(1, 2), "least cylinder", 5);
  expect_closed_sphere(samples::cylinder(16, 120), "cylinder");
  expect_closed_sphere(samples::cactus(6000), "cactus");
  expect_closed_sphere(samples::cactus(500), "coarse cactus");
  expect_closed_sphere(samples::cactus(40000), "fine cactus");
}

TEST(Shapes, VertexCountsAreThoseOfTheHeader) {
  EXPECT_EQ(samples::sphere(20).vertex_count(), 10u * 400 + 2);
  EXPECT_EQ(samples::bar(19).vertex_count(), 6500u);
  EXPECT_EQ(samples::plane(7, 5).vertex_count(), 35u);
  EXPECT_EQ(samples::cactus(5261).vertex_count(), 5261u);
  EXPECT_NEAR(samples::cactus(40000).vertex_count(), 40000, 40);
}

TEST(Shapes, VolumesMatchTheSolids) {
  const ShapeMesh box = samples::box(1, 2, 3, 2, 5, 4), ball = samples::sphere(30), can = samples::cylinder(20, 60);
  EXPECT_NEAR(examine(box.positions, box.triangles).volume, 6, 1e-12);
  EXPECT_NEAR(examine(ball.positions, ball.triangles).volume, 4.18879, 0.02);
  EXPECT_NEAR(examine(can.positions, can.triangles).volume, 3.14159, 0.02);
}

TEST(Shapes, PlanesHaveOneBorderAndFaceUp) {
  for (const ShapeMesh& mesh : {samples::plane(20, 30), samples::bumpy_plane(100, 100)}) {
    const Report report = examine(mesh.positions, mesh.triangles);
    EXPECT_TRUE(report.manifold);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.euler(), 1);
    EXPECT_GT(report.borders, 0u);
    for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
      const double* p[3];
      for (size_t k = 0; k < 3; ++k) p[k] = &mesh.positions[3 * size_t(mesh.triangles[t + k])];
      const double up = (p[1][2] - p[0][2]) * (p[2][0] - p[0][0]) - (p[1][0] - p[0][0]) * (p[2][2] - p[0][2]);
      ASSERT_GT(up, 0);
    }
  }
}

TEST(Shapes, BadArgumentsAreRefused) {
  EXPECT_THROW(samples::jittered_torus(2, 10), std::runtime_error);
  EXPECT_THROW(samples::jittered_torus(100000, 100000), std::runtime_error);
  EXPECT_THROW(samples::jittered_torus(10, 10, 0.6), std::runtime_error);
  EXPECT_THROW(samples::jittered_torus(10, 10, 0.1, 0.4, 1.0), std::runtime_error);
  EXPECT_THROW(samples::sphere(0), std::runtime_error);
  EXPECT_THROW(samples::plane(1, 5), std::runtime_error);
  EXPECT_THROW(samples::box(0, 1, 1, 1, 1, 1), std::runtime_error);
  EXPECT_THROW(samples::cylinder(0, 5), std::runtime_error);
  EXPECT_THROW(samples::cactus(10), std::runtime_error);
}

}  // namespace
