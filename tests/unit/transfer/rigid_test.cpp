// Rigid pieces of a target: a blade on a beam keeps its edges whatever the source does, and is a joint of the skin.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "hf/hf.hpp"
#include "support/parts.h"

namespace {

using Points = std::vector<double>;

hf_test::PlainMesh beam() { return hf_test::box(16, {3, 0.4, 0.4}, {0, 0, 0}); }

// The first vertex of the blade that lies on the beam.
uint32_t blade_start() {
  static const uint32_t count = beam().vertex_count();
  return count;
}

hf_test::PlainMesh beam_and_blade() {
  hf_test::PlainMesh mesh = beam();
  hf_test::append(mesh, hf_test::box(12, {1.8, 0.1, 0.25}, {0, 0.405, 0.07}), 0.9);
  return mesh;
}

hf::Surface surface_of(const hf_test::PlainMesh& mesh) {
  hf_links_desc links = HF_INIT(hf_links_desc);
  links.mode = HF_LINK_PIECES;
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(mesh.positions.data(), mesh.positions.size() / 3);
  desc.triangles = HF_ARRAY(mesh.triangles.data(), mesh.triangles.size() / 3);
  desc.links = &links;
  return hf::Surface(desc);
}

// The beam along x, bent into an arc that ends at an angle.
Points bent(const hf_test::PlainMesh& mesh, double angle) {
  Points out(mesh.positions.begin(), mesh.positions.end());
  for (size_t i = 0; i < out.size() && angle != 0; i += 3) {
    const double turn = angle * out[i] / 3, radius = 3 / angle, y = out[i + 1];
    out[i] = (radius - y) * std::sin(turn);
    out[i + 1] = radius - (radius - y) * std::cos(turn);
  }
  return out;
}

struct Scene {
  hf_test::PlainMesh from = beam(), to = beam_and_blade();
  hf::Surface source = surface_of(from), target = surface_of(to);
  Points rest;  // of the target
  hf_transfer transfer = nullptr;

  // angle: how far source and target are bent at rest.
  explicit Scene(int32_t mode = HF_TRANSFER_FIELDS, double angle = 0) : rest(bent(to, angle)) {
    const Points source_rest = bent(from, angle);
    hf_transfer_desc desc = HF_INIT(hf_transfer_desc);
    if (angle != 0) {
      desc.source_rest = HF_ARRAY(source_rest.data(), source_rest.size() / 3);
      desc.target_rest = HF_ARRAY(rest.data(), rest.size() / 3);
    }
    desc.mode = mode;
    desc.ground = HF_GROUND_OFF;
    EXPECT_EQ(hf_transfer_create(source.get(), target.get(), &desc, &transfer), HF_OK);
    std::vector<uint32_t> counts, vertices;
    for (const double x : {0.0, 1.5, 3.0}) {
      const size_t before = vertices.size();
      for (uint32_t v = 0; v < blade_start(); ++v) {
        if (std::abs(from.positions[3 * v] - x) < 0.3) vertices.push_back(v);
      }
      counts.push_back(static_cast<uint32_t>(vertices.size() - before));
    }
    hf_pairs_desc pairs = HF_INIT(hf_pairs_desc);
    pairs.pair_count = 3;
    pairs.source_counts = pairs.target_counts = counts.data();
    pairs.source_vertices = pairs.target_vertices = vertices.data();
    EXPECT_EQ(hf_transfer_add_pairs(transfer, &pairs, nullptr), HF_OK);
  }
  ~Scene() { hf_transfer_destroy(transfer); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  void rigid(const std::vector<uint32_t>& vertices) {
    EXPECT_EQ(hf_transfer_set_rigid_pieces(transfer, static_cast<uint32_t>(vertices.size()), vertices.data()), HF_OK);
  }
  Points frame(double angle) {
    const Points posed = bent(from, angle);
    Points out(to.positions.size());
    hf_transfer_frame frame = HF_INIT(hf_transfer_frame);
    frame.source_positions = HF_ARRAY(posed.data(), posed.size() / 3);
    frame.target_positions = HF_ARRAY_OUT(out.data(), out.size() / 3);
    EXPECT_EQ(hf_transfer_apply(transfer, &frame), HF_OK);
    return out;
  }
  // The largest change of an edge of the blade, as a share of it.
  double stretch(const Points& x) const {
    double most = 0;
    for (size_t k = 0; k < to.triangles.size(); ++k) {
      const uint32_t a = to.triangles[k], b = to.triangles[k - k % 3 + (k + 1) % 3];
      if (a < blade_start()) continue;
      const auto length = [&](const Points& at) {
        return std::hypot(at[3 * a] - at[3 * b], at[3 * a + 1] - at[3 * b + 1], at[3 * a + 2] - at[3 * b + 2]);
      };
      most = std::max(most, std::abs(length(x) / length(rest) - 1));
    }
    return most;
  }
};

TEST(RigidTargets, EdgesOfABladeKeepTheirLengthsAndOtherVerticesTheirBits) {
  for (const int32_t mode : {HF_TRANSFER_FIELDS, HF_TRANSFER_STRETCH}) {
    Scene scene(mode);
    const Points before = scene.frame(1.2);
    EXPECT_GT(scene.stretch(before), 1e-3);
    scene.rigid({blade_start() + 3, blade_start() + 7});
    const Points after = scene.frame(1.2);
    EXPECT_LT(scene.stretch(after), 1e-6);
    EXPECT_EQ(std::memcmp(before.data(), after.data(), 3 * blade_start() * sizeof(double)), 0);
    // it stays at the beam, and goes back with it
    double farthest = 0;
    for (size_t i = 3 * size_t{blade_start()}; i < after.size(); ++i)
      farthest = std::max(farthest, std::abs(after[i] - before[i]));
    EXPECT_LT(farthest, 0.3);
    const Points rest = scene.frame(0);
    for (size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(rest[i], scene.to.positions[i], 1e-9);
    scene.rigid({});
    const Points again = scene.frame(1.2);
    EXPECT_EQ(std::memcmp(before.data(), again.data(), before.size() * sizeof(double)), 0);
  }
}

TEST(RigidTargets, APieceHasTheShapeOfTheRestPose) {
  Scene scene(HF_TRANSFER_FIELDS, 0.8);
  scene.rigid({blade_start()});
  EXPECT_LT(scene.stretch(scene.frame(-0.5)), 1e-6);
  const Points rest = scene.frame(0.8);
  for (size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(rest[i], scene.rest[i], 1e-9);
}

TEST(RigidTargets, TheSkinReplaysAFrameWithAJointForThePiece) {
  Scene scene;
  hf_transfer_info info = HF_INIT(hf_transfer_info);
  ASSERT_EQ(hf_transfer_get_info(scene.transfer, &info), HF_OK);
  scene.rigid({blade_start()});
  const Points frame = scene.frame(1.2);
  const uint32_t joints = info.cluster_count + 1, vertices = static_cast<uint32_t>(frame.size() / 3);
  Points pivots(3 * joints), rotations(4 * joints), places(3 * joints);
  std::vector<uint32_t> vertex_joints(4 * vertices);
  std::vector<float> weights(4 * vertices);
  hf_skin_info skin = HF_INIT(hf_skin_info);
  skin.influence_count = 4;
  skin.joint_capacity = joints;
  skin.vertex_capacity = vertices;
  skin.pivots = pivots.data();
  skin.rotations = rotations.data();
  skin.translations = places.data();
  skin.vertex_joints = vertex_joints.data();
  skin.vertex_weights = weights.data();
  ASSERT_EQ(hf_transfer_get_skin(scene.transfer, &skin), HF_OK);
  ASSERT_EQ(skin.joint_count, joints);
  for (uint32_t v = 0; v < vertices; ++v) {
    Points sum(3, 0.0);
    for (size_t k = 4 * v; k < 4 * (v + 1); ++k) {
      const size_t j = vertex_joints[k];
      const double x = rotations[4 * j], y = rotations[4 * j + 1], z = rotations[4 * j + 2], w = rotations[4 * j + 3];
      const double d[3] = {scene.to.positions[3 * v] - pivots[3 * j], scene.to.positions[3 * v + 1] - pivots[3 * j + 1],
                           scene.to.positions[3 * v + 2] - pivots[3 * j + 2]};
      const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                              {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                              {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
      for (size_t c = 0; c < 3; ++c)
        sum[c] +=
            static_cast<double>(weights[k]) * (r[c][0] * d[0] + r[c][1] * d[1] + r[c][2] * d[2] + places[3 * j + c]);
    }
    if (v >= blade_start()) {
      EXPECT_EQ(vertex_joints[4 * v], joints - 1);
    }
    for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], frame[3 * v + c], 1e-6);
  }
}

}  // namespace
