// Characters of parts in poses: cloth over a joint, hair, eyes, teeth, armour, a held sword, a rider.
//
// A handle at one end turns by 60 degrees and the other end is held. Contacts are measured apart from the library's
// links: every vertex of a part, and the vertices of a triangle of the body that are nearest at rest. The bars are
// those of links.md: gaps of 0.5 % of the box for 95 % of the contacts and 3 % at worst.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hf/hf.h"
#include "mesh/nearest_triangle.h"
#include "support/arrays.h"
#include "support/part_scenes.h"

namespace {

using hf_test::PlainMesh;
using Scene = hf_test::PartScene;

constexpr double turn_degrees = 60, gap_95 = 0.005, gap_worst = 0.03;

double diagonal(const PlainMesh& mesh) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = 1e300, high = -1e300;
    for (std::size_t i = k; i < mesh.positions.size(); i += 3) {
      low = std::min(low, mesh.positions[i]);
      high = std::max(high, mesh.positions[i]);
    }
    sum += (high - low) * (high - low);
  }
  return std::sqrt(sum);
}

hf_inner::Vec3 point(const std::vector<double>& xyz, std::size_t v) {
  return {xyz[3 * v], xyz[3 * v + 1], xyz[3 * v + 2]};
}

struct Posed {
  std::vector<double> positions;
  std::uint32_t unreached = 0, pieces = 0, light = 0, groups = 0;
};

// Turns about the y axis through the pivot. tags: by vertex, or empty.
Posed pose_of(const Scene& scene, bool with, const std::vector<std::uint32_t>& tags = {}) {
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  links.tags = tags.empty() ? nullptr : tags.data();
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(scene.mesh.positions.data(), scene.mesh.vertex_count());
  desc.triangles = HF_ARRAY(scene.mesh.triangles.data(), scene.mesh.triangle_count());
  desc.weld = HF_WELD_EXACT;
  desc.links = with ? &links : nullptr;
  hf_surface surface = nullptr;
  EXPECT_EQ(hf_surface_create(&desc, &surface), HF_OK);
  hf_pose pose = nullptr;
  EXPECT_EQ(hf_pose_create(surface, nullptr, &pose), HF_OK);
  std::uint32_t turned = 0, held = 0;
  EXPECT_EQ(hf_pose_add_handle_at(pose, scene.turned.data(), scene.radius, &turned), HF_OK);
  EXPECT_EQ(hf_pose_add_handle_at(pose, scene.held.data(), scene.radius, &held), HF_OK);
  const double angle = turn_degrees / 45 * std::atan(1.0), c = std::cos(angle), s = std::sin(angle);
  const auto& p = scene.pivot;
  const double matrix[16] = {
      c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, p[0] - c * p[0] - s * p[2], 0, p[2] + s * p[0] - c * p[2], 1};
  EXPECT_EQ(hf_pose_set_matrices(pose, 1, &turned, matrix), HF_OK);
  Posed out;
  out.positions.resize(scene.mesh.positions.size());
  hf_deform_desc frame = HF_INIT(hf_deform_desc);
  frame.positions = ROWS_OUT(out.positions.data());
  hf_deform_info info = HF_INIT(hf_deform_info);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(hf_pose_deform(pose, &frame, &info), HF_OK);
  hf_links_info joined = HF_INIT(hf_links_info);
  EXPECT_EQ(hf_surface_get_links_info(surface, &joined), HF_OK);
  out.unreached = info.unreached_vertex_count;
  hf_surface_report counts = HF_INIT(hf_surface_report);
  EXPECT_EQ(hf_surface_get_report(surface, &counts), HF_OK);
  out.pieces = joined.piece_count;
  out.light = joined.light_piece_count;
  out.groups = counts.component_count;
  hf_pose_destroy(pose);
  hf_surface_destroy(surface);
  return out;
}

struct Gaps {
  double share_95 = 0, worst = 0;  // of the diagonal
  int through = 0;                 // vertices of parts that went through the body, and were outside
};

// Contacts: vertices of parts within `range` of the body, both in shares of the diagonal.
Gaps gaps_of(const Scene& scene, const std::vector<double>& posed, double range) {
  const double size = diagonal(scene.mesh);
  const std::vector<double>& rest = scene.mesh.positions;
  std::vector<double> gaps;
  Gaps out;
  for (std::size_t v = scene.body; v < scene.mesh.vertex_count(); ++v) {
    double least = 1e300, share[3] = {};
    const std::uint32_t* nearest = nullptr;
    for (std::size_t t = 0; t < scene.mesh.triangles.size(); t += 3) {
      const std::uint32_t* c = &scene.mesh.triangles[t];
      if (c[0] >= scene.body) continue;
      double w[3];
      const double d = hf_inner::mesh::squared_to_triangle(point(rest, v), point(rest, c[0]), point(rest, c[1]),
                                                           point(rest, c[2]), w);
      if (d < least) {
        least = d;
        nearest = c;
        std::copy(w, w + 3, share);
      }
    }
    if (std::sqrt(least) > range * size) continue;
    const auto apart = [&](const std::vector<double>& xyz) {
      hf_inner::Vec3 away = point(xyz, v);
      for (std::size_t k = 0; k < 3; ++k) away = away - share[k] * point(xyz, nearest[k]);
      return away;
    };
    const auto above = [&](const std::vector<double>& xyz) {
      const hf_inner::Vec3 a = point(xyz, nearest[0]);
      return dot(apart(xyz), cross(point(xyz, nearest[1]) - a, point(xyz, nearest[2]) - a)) > 0;
    };
    gaps.push_back(std::max(0.0, norm(apart(posed)) - std::sqrt(least)) / size);
    out.through += above(rest) && !above(posed);
  }
  std::sort(gaps.begin(), gaps.end());
  if (gaps.empty()) return out;
  out.share_95 = gaps[(95 * gaps.size() + 99) / 100 - 1];
  out.worst = gaps.back();
  return out;
}

void expect_parts_follow(const Scene& scene, double range, std::uint32_t pieces, std::uint32_t light) {
  const Posed without = pose_of(scene, false), with = pose_of(scene, true);
  EXPECT_EQ(with.pieces, pieces);
  EXPECT_EQ(with.groups, 1u);
  EXPECT_EQ(with.light, light);
  EXPECT_EQ(with.unreached, 0u);
  EXPECT_GT(without.unreached, 0u);
  const Gaps left = gaps_of(scene, without.positions, range), held = gaps_of(scene, with.positions, range);
  ::testing::Test::RecordProperty("gap", std::to_string(100 * held.share_95) + " / " +
                                             std::to_string(100 * held.worst) + ", without " +
                                             std::to_string(100 * left.worst));
  EXPECT_GT(left.worst, gap_worst) << "nothing moves: no test";
  EXPECT_LE(held.share_95, gap_95);
  EXPECT_LE(held.worst, gap_worst);
  EXPECT_EQ(held.through, 0);
}

TEST(Parts, a_sleeve_over_an_elbow_and_a_trouser_leg_over_a_knee_follow_and_stay_outside) {
  for (const double sign : {1.0, -1.0}) {
    Scene scene = hf_test::cloth();
    if (sign < 0) std::swap(scene.turned, scene.held);  // the body turns, the hand is held
    expect_parts_follow(scene, 0.02, 2, 1);
    // The cloth hardly pulls the arm.
    const Posed with = pose_of(scene, true);
    Scene bare = hf_test::limb();
    if (sign < 0) std::swap(bare.turned, bare.held);
    const Posed alone = pose_of(bare, false);
    double moved = 0;
    for (std::size_t i = 0; i < alone.positions.size(); ++i)
      moved = std::max(moved, std::fabs(alone.positions[i] - with.positions[i]));
    EXPECT_LT(moved, 2e-3 * diagonal(scene.mesh));
  }
}

TEST(Parts, eyes_and_teeth_follow_the_head) {
  const Scene scene = hf_test::eyes_and_teeth();
  expect_parts_follow(scene, 0.01, 9, 8);  // small and near the skin: they follow and do not pull
}

TEST(Parts, hair_cards_follow_the_head) {
  const Scene scene = hf_test::hair_cards();
  const Posed with = pose_of(scene, true);
  EXPECT_GE(with.light, 1u);
  expect_parts_follow(scene, 0.02, 7, with.light);
}

TEST(Parts, a_plate_of_armour_follows_the_chest_and_a_sword_the_hand) {
  const Scene scene = hf_test::armour_and_sword();
  expect_parts_follow(scene, 0.01, 3, 1);
  // The sword keeps its shape.
  const Posed with = pose_of(scene, true);
  const std::vector<double>& rest = scene.mesh.positions;
  const std::size_t first = scene.body + hf_test::plate_vertices, last = scene.mesh.vertex_count() - 1;
  double stretch = 0;
  for (std::size_t v = first; v <= last; ++v) {
    const double before = norm(point(rest, v) - point(rest, first)),
                 after = norm(point(with.positions, v) - point(with.positions, first));
    stretch = std::max(stretch, std::fabs(after - before) / diagonal(scene.mesh));
  }
  EXPECT_LT(stretch, 0.01);
}

// The tips among the handles that are proposed for the linked surface.
std::vector<hf_handle_proposal> tips_of(const PlainMesh& mesh) {
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(mesh.positions.data(), mesh.vertex_count());
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangle_count());
  desc.weld = HF_WELD_EXACT;
  desc.links = &links;
  hf_surface surface = nullptr;
  EXPECT_EQ(hf_surface_create(&desc, &surface), HF_OK);
  std::uint32_t count = 0;
  std::vector<hf_handle_proposal> out(HF_HANDLE_LIMIT);
  EXPECT_EQ(hf_surface_propose_handles(surface, nullptr, HF_HANDLE_LIMIT, out.data(), &count), HF_OK);
  out.resize(count);
  out.erase(std::remove_if(out.begin(), out.end(),
                           [](const hf_handle_proposal& p) { return p.reason != HF_HANDLE_REASON_TIP; }),
            out.end());
  hf_surface_destroy(surface);
  return out;
}

TEST(Parts, a_light_piece_is_no_tip_and_leaves_those_of_the_body) {
  const std::pair<Scene, Scene> scenes[] = {{hf_test::cloth(), hf_test::limb()},
                                            {hf_test::hair_cards(), hf_test::bust()}};
  for (const auto& [dressed, bare] : scenes) {
    const auto with = tips_of(dressed.mesh), without = tips_of(bare.mesh);
    ASSERT_EQ(with.size(), without.size());
    for (std::size_t i = 0; i < with.size(); ++i) {
      // The length counts from the middle, half way in edges: a sheet moves it a little.
      EXPECT_NEAR(with[i].length, without[i].length, 0.25 * without[i].length);
      double least = 1e300;
      for (const hf_handle_proposal& tip : without)
        least = std::min(least,
                         norm(point(dressed.mesh.positions, with[i].vertex) - point(bare.mesh.positions, tip.vertex)));
      EXPECT_LT(least, 0.02 * diagonal(bare.mesh));
    }
  }
}

// Two bodies touch and must not link: the host says so by tags.
TEST(Parts, a_rider_turns_and_the_horse_stays) {
  const Scene scene = hf_test::rider();
  const Posed apart = pose_of(scene, true, scene.tags), together = pose_of(scene, true);
  EXPECT_EQ(apart.groups, 2u);
  EXPECT_EQ(together.groups, 1u);
  EXPECT_EQ(apart.unreached, scene.body) << "no handle holds the horse, and the library says so";
  double tagged = 0, untagged = 0;
  for (std::size_t i = 0; i < 3 * std::size_t{scene.body}; ++i) {
    tagged = std::max(tagged, std::fabs(apart.positions[i] - scene.mesh.positions[i]));
    untagged = std::max(untagged, std::fabs(together.positions[i] - scene.mesh.positions[i]));
  }
  EXPECT_LT(tagged, 1e-12);
  EXPECT_GT(untagged, 1e-3);
  const std::size_t last = scene.mesh.vertex_count() - 1;  // what the rider holds follows
  EXPECT_GT(norm(point(apart.positions, last) - point(scene.mesh.positions, last)), 0.01);
}

}  // namespace
