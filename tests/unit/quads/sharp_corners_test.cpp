// Creases that meet in corners too sharp for the grid: the tips of saw blades.
#include "quads/sharp_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "quads/field_quads.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"

namespace {

using namespace hf_inner;

constexpr double turn = 6.283185307179586476925286766559;

// A blade of radius 1 with n teeth: a rim of three layers, and two fans. flat: one fan.
hf_test::PlainMesh saw(std::uint32_t n, bool flat = false) {
  constexpr double depth = 0.28, height = 0.25;
  constexpr std::uint32_t layers = 3;
  const std::uint32_t around = 2 * n, last = flat ? 0 : layers;
  hf_test::PlainMesh mesh;
  for (std::uint32_t layer = 0; layer <= last; ++layer) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double r = i % 2 == 0 ? 1 : 1 - depth, angle = turn * i / around;
      mesh.positions.insert(mesh.positions.end(), {r * std::cos(angle), r * std::sin(angle), height * layer / layers});
    }
  }
  const std::uint32_t centre = (last + 1) * around;
  mesh.positions.insert(mesh.positions.end(), {0, 0, height * last / layers});
  if (!flat) mesh.positions.insert(mesh.positions.end(), {0, 0, 0});
  for (std::uint32_t i = 0; i < around; ++i) {
    const std::uint32_t j = (i + 1) % around;
    for (std::uint32_t k = 0; k < last; ++k) {
      const std::uint32_t a = k * around + i, b = k * around + j;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, b + around, a, b + around, a + around});
    }
    mesh.triangles.insert(mesh.triangles.end(), {centre, last * around + i, last * around + j});
    if (!flat) mesh.triangles.insert(mesh.triangles.end(), {centre + 1, j, i});
  }
  return mesh;
}

struct Figures {
  std::int32_t most_valence = 0, turned_over = 0;
  double aspect = 0;  // longest over shortest edge: 95 of 100 quads have less
};

Figures figures_of(const QuadMesh& mesh) {
  Figures out;
  std::vector<std::int32_t> valence(static_cast<std::size_t>(mesh.position.size()));
  std::vector<double> aspect;
  for (std::int32_t f = 0; f < mesh.face_count(); ++f) {
    const std::int32_t* c = mesh.quad(f);
    double low = HUGE_VAL, high = 0;
    const Vec3 normal = cross(mesh.position[c[2]] - mesh.position[c[0]], mesh.position[c[3]] - mesh.position[c[1]]);
    for (int k = 0; k < 4; ++k) {
      out.most_valence = std::max(out.most_valence, ++valence[static_cast<std::size_t>(c[k])]);
      const Vec3 p = mesh.position[c[k]], a = mesh.position[c[(k + 1) % 4]] - p, b = mesh.position[c[(k + 3) % 4]] - p;
      low = std::min(low, norm(a));
      high = std::max(high, norm(a));
      // A corner of 180 degrees, on a straight crease, is not turned over.
      out.turned_over += dot(cross(a, b), normal) < -1e-2 * norm(a) * norm(b) * norm(normal);
    }
    aspect.push_back(high / low);
  }
  std::sort(aspect.begin(), aspect.end());
  out.aspect = aspect[aspect.size() * 95 / 100];
  return out;
}

QuadMesh quads_of(const std::shared_ptr<const Core>& core, std::int32_t faces, FieldQuadReport& report) {
  FieldQuadOptions options;
  options.core = core;
  options.faces = faces;
  options.crease = 0.5236;
  QuadResult result = make_field_quads(options, &report);
  hf_test::expect_manifold(*core, result.mesh, std::to_string(faces));
  EXPECT_NEAR(result.mesh.face_count(), faces, 0.1 * faces);
  return std::move(result.mesh);
}

TEST(SharpCorners, a_blade_of_many_teeth_gets_quads_as_good_as_one_of_twelve) {
  for (const std::uint32_t teeth : {12u, 16u, 20u, 24u, 40u}) {
    const auto core = hf_test::make_core(saw(teeth));
    for (const std::int32_t faces : {400, 1000}) {
      FieldQuadReport report;
      const Figures found = figures_of(quads_of(core, faces, report));
      EXPECT_EQ(report.split, 0) << teeth << " teeth, " << faces;  // no component got quads of its triangles
      EXPECT_LE(found.most_valence, 12) << teeth << " teeth, " << faces;
      EXPECT_LE(found.turned_over, 4) << teeth << " teeth, " << faces;
      EXPECT_LE(found.aspect, teeth < 40 ? 4 : 6) << teeth << " teeth, " << faces;
    }
  }
}

TEST(SharpCorners, a_corner_below_45_degrees_is_opened_to_a_right_angle) {
  Memory memory;
  for (const std::uint32_t teeth : {12u, 40u}) {
    const auto core = hf_test::make_core(saw(teeth, true));
    const FluxSurface surface = FluxSurface::make(core->mesh, core->topology, memory);
    const Table<std::uint8_t> features = find_features(surface, HUGE_VAL, memory);
    const SharpCorners corners = SharpCorners::find(surface, features, memory);
    EXPECT_EQ(corners.count, teeth == 12 ? 0 : static_cast<std::int32_t>(teeth));
    if (corners.empty()) continue;
    // The crosses along the two edges of a tip, each turned from its edge, are a quarter turn apart.
    const double half = std::atan2(0.72 * std::sin(turn / 80), 1 - 0.72 * std::cos(turn / 80));
    for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
      if (!features[h]) continue;
      EXPECT_NEAR(std::fabs(corners.turn[h]), turn / 8 - half, 1e-9);
      EXPECT_EQ(corners.turn[h] > 0, norm(surface.position[surface.head(h)]) > norm(surface.position[surface.tail[h]]));
    }
  }
}

}  // namespace
