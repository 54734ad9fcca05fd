// Creases that meet in corners too sharp for the grid: the tips of saw blades.
#include "quads/sharp_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "quads/feature_crosses.h"
#include "quads/field_quads.h"
#include "quads/side_crosses.h"
#include "remesh/quad_faults.h"
#include "support/full.h"
#include "support/meshes.h"
#include "support/quad_oracle.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::quads;

constexpr double turn = 6.283185307179586476925286766559;
// Edges of quads that have no room beside another in any tooth.
constexpr double coarse = 10;

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

// A mesh turned off the axes: its flat faces are flat but for rounding.
hf_test::PlainMesh leaning(hf_test::PlainMesh mesh) {
  constexpr double c = 0.8, s = 0.6;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    double* p = &mesh.positions[i];
    const Vec3 about_z{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
    p[0] = about_z.x;
    p[1] = c * about_z.y - s * about_z.z;
    p[2] = s * about_z.y + c * about_z.z;
  }
  return mesh;
}

struct Figures {
  std::int32_t most_valence = 0, turned_over = 0;
  double aspect = 0;  // longest over shortest edge: 95 of 100 quads have less
};

Figures figures_of(const remesh::QuadMesh& mesh) {
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

remesh::QuadMesh quads_of(const std::shared_ptr<const surface::Core>& core, std::int32_t faces,
                          FieldQuadReport& report) {
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
  for (const std::uint32_t teeth : hf_test::quick_and_full<std::uint32_t>({12, 40}, {16, 20, 24})) {
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

TEST(SharpCorners, thin_teeth_keep_their_creases_from_quads_as_wide_as_a_tooth_to_quads_of_a_quarter_of_it) {
  Memory memory;
  const auto core = hf_test::make_core(saw(40));
  // The quick form takes the ends, HF_FULL_TESTS what lies between.
  for (const std::int32_t faces : hf_test::quick_and_full<std::int32_t>({1500, 9000}, {2000, 2600, 2900, 4000})) {
    FieldQuadReport report;
    const remesh::QuadMesh mesh = quads_of(core, faces, report);
    const Figures found = figures_of(mesh);
    EXPECT_EQ(report.substitutes, 0) << faces;
    EXPECT_EQ(found.turned_over, 0) << faces;
    EXPECT_LE(found.most_valence, 6) << faces;
    EXPECT_EQ(remesh::faults_near(mesh, Vec3{}, 1, memory).crossing, 0) << faces;
    for (const int tooth : {0, 7, 13, 39}) {
      const Vec3 tip{std::cos(turn * tooth / 40), std::sin(turn * tooth / 40), 0.25};
      double nearest = HUGE_VAL;
      for (const Vec3& p : mesh.position) nearest = std::min(nearest, norm(core->mesh.to_given(p) - tip));
      EXPECT_LT(nearest, 1e-6) << faces << ", tooth " << tooth;
    }
  }
}

TEST(SharpCorners, a_blade_that_leans_has_no_vertex_of_many_quads) {
  const auto core = hf_test::make_core(leaning(saw(40)));
  for (const std::int32_t faces : {1000, 4000}) {
    FieldQuadReport report;
    const Figures found = figures_of(quads_of(core, faces, report));
    EXPECT_EQ(report.substitutes, 0) << faces;
    EXPECT_LE(found.most_valence, 8) << faces;
    EXPECT_EQ(found.turned_over, 0) << faces;
  }
}

TEST(SharpCorners, crosses_stay_turned_only_where_two_quads_have_no_room) {
  // A wedge of 24 degrees between two walls: its two edges have a vertex at every whole distance from the tip.
  constexpr std::uint32_t steps = 10;
  const double half = turn / 30;
  hf_test::PlainMesh wedge;
  wedge.positions = {0, 0, 0};
  for (std::uint32_t i = 1; i <= steps; ++i) {
    const double x = i * std::cos(half), y = i * std::sin(half);
    wedge.positions.insert(wedge.positions.end(), {x, -y, 0, x, y, 0});
    const std::uint32_t low = 2 * i - 1, high = 2 * i;
    if (i == 1) wedge.triangles = {0, low, high};
    if (i > 1) wedge.triangles.insert(wedge.triangles.end(), {low - 2, low, high, low - 2, high, high - 2});
  }
  const std::uint32_t below = 2 * steps + 1;
  for (std::uint32_t v = 0; v < below; ++v) {
    const double x = wedge.positions[3 * v], y = wedge.positions[3 * v + 1];
    wedge.positions.insert(wedge.positions.end(), {x, y, -1});
  }
  for (std::uint32_t v = 0; v + 2 < below; ++v) {
    const std::uint32_t a = v, b = v + 2, c = a + below, d = b + below;
    if (v % 2 == 1) wedge.triangles.insert(wedge.triangles.end(), {a, d, b, a, c, d});
    if (v % 2 == 0) wedge.triangles.insert(wedge.triangles.end(), {a, b, d, a, d, c});
  }
  wedge.triangles.insert(wedge.triangles.end(), {0, below, below + 1, 0, below + 1, 1});
  Memory memory;
  const auto core = hf_test::make_core(wedge);
  const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
  const remesh::Table<std::uint8_t> features = find_features(surface, turn / 12, memory);
  for (const double length : {0.5, 3.0}) {
    const SharpCorners corners = SharpCorners::find(surface, features, length / core->mesh.scale, memory);
    ASSERT_EQ(corners.count, 1);
    for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
      const auto distance = [&](std::int32_t v) {
        const Vec3 p = core->mesh.to_given(surface.position[v]);
        return std::round(std::hypot(p.x, p.y));
      };
      const double begin = std::min(distance(surface.tail[h]), distance(surface.head(h)));
      // Two quads of 0.5 have room from 0.5 / sin(12 degrees) = 2.4 on, and two of 3 nowhere in the wedge.
      bool on_top = true;
      for (const std::int32_t k : {h, remesh::FluxSurface::next(h), remesh::FluxSurface::previous(h)})
        on_top &= core->mesh.to_given(surface.position[surface.tail[k]]).z > -0.5;
      const bool turned = on_top && features[h] && surface.is_real(surface.twin[h]) && begin < (length < 1 ? 3 : 10);
      EXPECT_EQ(corners.turn[h] != 0, turned) << length << ", from " << begin;
    }
  }
}

TEST(SharpCorners, each_side_of_a_crease_at_a_tip_has_its_own_cross) {
  Memory memory;
  const auto core = hf_test::make_core(saw(40));
  const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
  const field::Connection connection = field::Connection::make(core->mesh, core->topology(), memory);
  const remesh::Table<std::uint8_t> features = find_features(surface, turn / 12, memory);
  const SharpCorners corners = SharpCorners::find(surface, features, 0.05, memory);
  Vector<HardCross> hard = feature_crosses(*core, surface, connection, features, corners, 2);
  const SideCrosses sides = SideCrosses::find(surface, connection, features, corners, hard, memory);
  std::int32_t turned = 0;
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    const Vec3 tail = core->mesh.to_given(surface.position[surface.tail[h]]);
    const bool at_tip = std::hypot(tail.x, tail.y) > 0.99 && (tail.z < 1e-6 || tail.z > 0.25 - 1e-6);
    if (!features[h] || !at_tip) continue;
    ASSERT_NE(sides.of_corner[h], std::complex<double>(0, 0));
    // In the plane of the triangle, the cross at the tail stands as far from the edge as the corner says.
    const Vec3 a = surface.position[surface.tail[h]], edge = unit_vector(surface.position[surface.head(h)] - a),
               normal = unit_vector(cross(edge, surface.position[surface.tail[remesh::FluxSurface::previous(h)]] - a));
    const Index v = surface.mesh_vertex[surface.tail[h]];
    const std::complex<double> arm = std::polar(1.0, std::arg(sides.of_corner[h]) / 4);
    // A triangle may face away from the normal of a vertex as sharp as this.
    const Vec3 own = connection.normal[static_cast<std::size_t>(v)];
    const Vec3 seen = field::carry(connection.to_space(v, arm), own, dot(own, normal) < 0 ? -1.0 * normal : normal);
    const double angle = std::atan2(dot(seen, cross(normal, edge)), dot(seen, edge)) - corners.turn[h];
    EXPECT_NEAR(std::remainder(angle, turn / 4), 0, 1e-9) << h;
    turned += corners.turn[h] != 0;
  }
  EXPECT_EQ(turned, 80);  // one on the left of which lies a tooth, above and below
  EXPECT_TRUE(std::is_sorted(hard.begin(), hard.end(),
                             [](const HardCross& x, const HardCross& y) { return x.vertex < y.vertex; }));
}

TEST(SharpCorners, a_corner_below_45_degrees_is_opened_to_a_right_angle) {
  Memory memory;
  for (const std::uint32_t teeth : {12u, 40u}) {
    const auto core = hf_test::make_core(saw(teeth, true));
    const remesh::FluxSurface surface = remesh::FluxSurface::make(core->mesh, core->topology(), memory);
    const remesh::Table<std::uint8_t> features = find_features(surface, HUGE_VAL, memory);
    const SharpCorners corners = SharpCorners::find(surface, features, coarse, memory);
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
