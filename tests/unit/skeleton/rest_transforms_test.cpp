// The skin in the pose of `rest`, beside products of 4 x 4 matrices.
#include "skeleton/rest_transforms.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "base/error.h"
#include "base/memory.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::Vector;
using hf_inner::skeleton::CharacterInput;
using hf_inner::skeleton::pose_skin_at_rest;

// Four joints, of which the first hangs on the second. Joint 3 has no inverse bind. Vertex 5 has no other joint.
struct Skin {
  std::vector<std::int32_t> parents = {1, -1, 0, 0};
  std::vector<double> trs, matrices, binds, positions, weights;
  std::vector<std::uint8_t> bound = {1, 1, 1, 0};
  std::vector<std::uint32_t> starts = {0, 1, 3, 5, 8, 10, 11}, joints = {0, 1, 2, 0, 2, 0, 1, 2, 2, 3, 3};
  std::vector<Eigen::Matrix4d> local, bind;

  Skin() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1, 1);
    for (std::size_t j = 0; j < parents.size(); ++j) {
      const Eigen::Quaterniond turn(1.5 * number(random), number(random), number(random), number(random));
      const Eigen::Vector3d place(number(random), number(random), number(random)), scale(0.5, 1.5, 2 + number(random));
      const double of_joint[10] = {place.x(), place.y(), place.z(),  turn.x(),   turn.y(),
                                   turn.z(),  turn.w(),  scale.x(), scale.y(), scale.z()};
      trs.insert(trs.end(), of_joint, of_joint + 10);
      Eigen::Affine3d m = Eigen::Affine3d::Identity();
      m.linear() = turn.normalized().toRotationMatrix() * scale.asDiagonal();
      m.translation() = place;
      local.push_back(m.matrix());
      matrices.insert(matrices.end(), m.data(), m.data() + 16);
      Eigen::Affine3d b = Eigen::Affine3d::Identity();
      b.linear() = Eigen::Matrix3d::NullaryExpr([&] { return number(random); });
      b.translation() = Eigen::Vector3d::NullaryExpr([&] { return number(random); });
      bind.push_back(b.matrix());
      binds.insert(binds.end(), b.data(), b.data() + 16);
    }
    for (std::size_t k = 0; k < 3 * (starts.size() - 1); ++k) positions.push_back(number(random));
    for (std::size_t k = 0; k < joints.size(); ++k) weights.push_back(1.5 + number(random));
  }
  CharacterInput input() const {
    CharacterInput in;
    in.joint_count = static_cast<std::uint32_t>(parents.size());
    in.parents = parents.data();
    in.trs = trs.data();
    in.inverse_binds = binds.data();
    in.bound = bound.data();
    in.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    in.positions = positions.data();
    in.influence_starts = starts.data();
    in.influence_joints = joints.data();
    in.influence_weights = weights.data();
    return in;
  }
  // Where vertex v is in the pose of `rest`.
  Eigen::Vector3d expected(std::size_t v, bool with_joint_3) const {
    Eigen::Vector4d p(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1), sum = Eigen::Vector4d::Zero();
    double weight = 0;
    for (std::uint32_t k = starts[v]; k < starts[v + 1]; ++k) {
      if (joints[k] == 3 && !with_joint_3) continue;
      Eigen::Matrix4d global = local[joints[k]];
      for (int j = parents[joints[k]]; j >= 0; j = parents[static_cast<std::size_t>(j)])
        global = (local[static_cast<std::size_t>(j)] * global).eval();
      sum += weights[k] * global * bind[joints[k]] * p;
      weight += weights[k];
    }
    return weight > 0 ? Eigen::Vector3d(sum.head<3>() / weight) : Eigen::Vector3d(p.head<3>());
  }
};

void expect_posed(const Skin& skin, const CharacterInput& in, bool with_joint_3) {
  Memory memory;
  Vector<double> posed(skin.positions.begin(), skin.positions.end(), &memory);
  pose_skin_at_rest(in, posed, memory);
  for (std::size_t v = 0; v < in.vertex_count; ++v) {
    const Eigen::Vector3d off = Eigen::Map<const Eigen::Vector3d>(posed.data() + 3 * v) - skin.expected(v, with_joint_3);
    EXPECT_LT(off.norm(), 1e-13) << v;
  }
}

TEST(RestTransforms, PoseTheSkinAsProductsOfMatricesDo) {
  const Skin skin;
  expect_posed(skin, skin.input(), false);
  CharacterInput all = skin.input();
  all.bound = nullptr;
  expect_posed(skin, all, true);
  CharacterInput by_matrices = skin.input();
  by_matrices.trs = nullptr;
  by_matrices.matrices = skin.matrices.data();
  expect_posed(skin, by_matrices, false);
}

TEST(RestTransforms, AVertexThatLeavesTheNumbersIsNamed) {
  Skin skin;
  skin.positions[3 * 4] = 1e308;
  for (double& m : skin.binds) m *= 1e10;
  Memory memory;
  Vector<double> posed(skin.positions.begin(), skin.positions.end(), &memory);
  try {
    pose_skin_at_rest(skin.input(), posed, memory);
    ADD_FAILURE();
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_NON_FINITE);
    EXPECT_EQ(error.index(), 4u);
  }
}

}  // namespace
}  // namespace hf_test
