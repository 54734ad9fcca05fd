// A point in space becomes the nearest point of the surface: compared with every triangle.
#include "mesh/place_reader.h"

#include <gtest/gtest.h>

#include <random>

#include "base/index.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace {

using hf_inner::at;
using hf_inner::Vec3;
using hf_inner::mesh::PlaceReader;
using hf_inner::mesh::Places;
using hf_inner::mesh::SurfacePlace;

TEST(PlaceReader, no_triangle_is_nearer_than_the_place_of_a_point) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> one(-1, 1);
  for (const hf_test::PlainMesh& plain : {hf_test::grid(9, 7), hf_test::torus(20, 12)}) {
    const auto core = hf_test::make_core(plain);
    const hf_inner::mesh::Mesh& mesh = core->mesh;
    std::vector<double> points;
    for (int n = 0; n < 200; ++n) {
      const Vec3 p = mesh.to_given({one(random), one(random), one(random)});
      points.insert(points.end(), {p.x, p.y, p.z});
    }
    const Places given(200, nullptr, nullptr, points.data());
    const PlaceReader reader(mesh, given, *core->memory);
    for (std::uint32_t i = 0; i < 200; ++i) {
      const Vec3 p = mesh.to_inner({points[3 * i], points[3 * i + 1], points[3 * i + 2]});
      double least = 1e9;
      for (std::int32_t t = 0; t < mesh.triangle_count(); ++t) {
        const std::int32_t* v = mesh.triangle(t);
        least = std::min(least, hf_inner::mesh::squared_to_triangle(
                                    p, mesh.positions[at(v[0])], mesh.positions[at(v[1])], mesh.positions[at(v[2])]));
      }
      const SurfacePlace place = reader.read(i);
      double sum = 0;
      for (const double w : place.weight) sum += w;
      EXPECT_NEAR(sum, 1, 1e-15);
      EXPECT_NEAR(norm(mesh.to_inner(position_of(mesh, place)) - p), std::sqrt(least), 1e-12) << i;
      const Places one(1, nullptr, nullptr, points.data() + 3 * i);  // without a tree
      const SurfacePlace alone = PlaceReader(mesh, one, *core->memory).read(0);
      EXPECT_NEAR(norm(mesh.to_inner(position_of(mesh, alone)) - p), std::sqrt(least), 1e-12) << i;
    }
  }
}

TEST(PlaceReader, the_position_of_a_vertex_is_the_vertex) {
  const auto core = hf_test::make_core(hf_test::torus(20, 12));
  const hf_inner::mesh::Mesh& mesh = core->mesh;
  std::vector<double> points;
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.to_given(mesh.positions[at(v)]);
    points.insert(points.end(), {p.x, p.y, p.z});
  }
  const Places given(static_cast<std::uint32_t>(mesh.vertex_count()), nullptr, nullptr, points.data());
  const PlaceReader reader(mesh, given, *core->memory);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    const SurfacePlace place = reader.read(static_cast<std::uint32_t>(v));
    EXPECT_TRUE(place.is_vertex());
    EXPECT_EQ(place.vertex[0], v);
  }
}

TEST(PlaceReader, weights_of_single_precision_sum_to_one_afterwards) {
  const auto core = hf_test::make_core(hf_test::grid(3, 3));
  const hf_place rounded{{0, 1, 4}, 0, {0.25, 0.25, 0.5 + 4e-7}};
  const SurfacePlace place = read_place(core->mesh, rounded, 0, "places");
  EXPECT_NEAR(place.weight[0] + place.weight[1] + place.weight[2], 1, 1e-15);
}

TEST(PlaceReader, corners_that_are_one_vertex_add_their_weights) {
  const auto core = hf_test::make_core(hf_test::grid(3, 3));
  const hf_place twice{{4, 5, 4}, 0, {0.25, 0.5, 0.25}};
  const SurfacePlace place = read_place(core->mesh, twice, 0, "places");
  EXPECT_EQ(place.vertex[2], hf_inner::mesh::Mesh::none);
  EXPECT_EQ(place.weight[0], 0.5);
  EXPECT_EQ(place.weight[1], 0.5);
}

}  // namespace
