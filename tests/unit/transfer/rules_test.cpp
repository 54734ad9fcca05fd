// The rules every transfer obeys, whatever the shapes: identity, rigid motion, axes, scale, threads, memory, skin.
#include <gtest/gtest.h>

#include "peers/paper_transfer.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

hf_inner::transfer::TransferOptions options(bool paper, double alignment = -1) {
  hf_inner::transfer::TransferOptions out;
  if (paper) out.scheme = hf_inner::peers::paper_clusters();
  out.alignment_angle = alignment;
  return out;
}

TEST(TransferRules, TheRestFrameOfTheSourceGivesTheRestOfTheTarget) {
  const Animals& a = animals();
  for (const bool paper : {false, true}) {
    hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options(paper));
    add(transfer, a.pairs.inputs());
    EXPECT_LT(largest_distance(frame_of(transfer, a.horse.rest()), a.bull.rest()), 1e-6 * a.box) << "paper " << paper;
  }
}

TEST(TransferRules, ARigidMotionOfTheSourceIsTheSameRigidMotionWithScaledTranslation) {
  const Animals& a = animals();
  const std::vector<Vec3> rest = a.horse.rest(), target_rest = a.bull.rest();
  hf_inner::Memory memory;
  const auto source_area = hf_inner::transfer::area_shares(a.horse.core->mesh, memory),
             target_area = hf_inner::transfer::area_shares(a.bull.core->mesh, memory);
  Vec3 source_centroid, target_centroid;
  for (size_t v = 0; v < rest.size(); ++v) source_centroid = source_centroid + source_area[v] * rest[v];
  for (size_t v = 0; v < target_rest.size(); ++v) target_centroid = target_centroid + target_area[v] * target_rest[v];
  const Vec3 turns[] = {{0, 0, 0}, {0, 1.0, 0}, {0.2, 0, 0}, {1.1, -0.7, 2.0}, {0, 3.14, 0}};
  for (const bool paper : {false, true}) {
    hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options(paper));
    add(transfer, a.pairs.inputs());
    for (const Vec3& turn : turns) {
      const hf_inner::deform::Quaternion rotation = hf_inner::deform::exponential(turn);
      const Vec3 shift{3.0, -0.4, 11.0};
      std::vector<Vec3> posed, expected;
      for (const Vec3& p : rest) posed.push_back(hf_inner::deform::rotate(rotation, p) + shift);
      const Vec3 moved = hf_inner::deform::rotate(rotation, source_centroid) + shift - source_centroid;
      for (const Vec3& p : target_rest)
        expected.push_back(hf_inner::deform::rotate(rotation, p - target_centroid) + target_centroid +
                           transfer.scale() * moved);
      EXPECT_LT(largest_distance(frame_of(transfer, posed), expected), 1e-6 * a.box)
          << "paper " << paper << " turn " << turn.x << " " << turn.y << " " << turn.z;
    }
  }
}

TEST(TransferRules, TurningTheSourceAboutTheVerticalWithItsAxesGivesTheSameClip) {
  const Animals& a = animals();
  const double angle = 2.1;
  const auto turned = [&](const glm::dvec3& p) {
    return glm::dvec3(std::cos(angle) * p.x + std::sin(angle) * p.z, p.y,
                      -std::sin(angle) * p.x + std::cos(angle) * p.z);
  };
  Body other = a.horse;
  other.move(a.world, turned);
  ASSERT_EQ(other.core->size(), a.horse.core->size());
  hf_inner::transfer::TransferOptions straight = options(false, 0), rotated = straight;
  const glm::dvec3 right = turned({1, 0, 0}), forward = turned({0, 0, 1});
  const double axes[9] = {right.x, right.y, right.z, 0, 1, 0, forward.x, forward.y, forward.z};
  std::copy_n(axes, 9, rotated.source_axes);
  hf_inner::transfer::Transfer first(a.horse.core, a.bull.core, straight), second(other.core, a.bull.core, rotated);
  add(first, a.pairs.inputs());
  add(second, a.pairs.inputs());
  for (const double time : {0.0, 0.2, 0.55, 0.9}) {
    std::vector<glm::dvec3> posed = hf_gltf::posed_positions(a.horse.model, a.horse.mesh, a.walk, time), moved;
    for (const glm::dvec3& p : posed) moved.push_back(turned(p));
    EXPECT_LT(largest_distance(frame_of(first, a.horse.inner(posed)), frame_of(second, other.inner(moved))),
              1e-6 * a.box)
        << time;
  }
}

TEST(TransferRules, OnlyRotationsAreTransferredSoTheTargetsScaleDoesNotChangeThem) {
  const Animals& a = animals();
  const auto rotations = [&](double scale) {
    Body bull = a.bull;
    bull.move(a.world, [&](const glm::dvec3& p) { return scale * p; });
    hf_inner::transfer::Transfer transfer(a.horse.core, bull.core, options(false, 0));
    add(transfer, a.pairs.inputs());
    std::vector<hf_inner::deform::Quaternion> all;
    for (const double time : {0.1, 0.6}) {
      const std::vector<Vec3> posed = frame_of(transfer, a.horse.posed(a.walk, time));
      std::vector<hf_inner::deform::Quaternion> frame(static_cast<size_t>(transfer.cluster_count()));
      transfer.skin_motion(nullptr, frame.data(), nullptr);
      all.insert(all.end(), frame.begin(), frame.end());
    }
    return all;
  };
  const auto one = rotations(1);
  for (const double scale : {0.5, 2.0}) {
    const auto other = rotations(scale);
    ASSERT_EQ(one.size(), other.size());
    for (size_t c = 0; c < one.size(); ++c) EXPECT_LT(one[c].angularDistance(other[c]), 1e-6) << c;
  }
}

TEST(TransferRules, TheTargetIsNotStretchedByAStretchedSource) {
  // the source twice as large in every frame: rotations only, so the target's edges keep their lengths
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options(false));
  std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  for (hf_inner::transfer::PairInput& input : inputs) input.flags &= ~uint32_t{HF_PAIR_ANCHOR | HF_PAIR_FOOT};
  add(transfer, inputs);
  std::vector<Vec3> posed = a.horse.rest();
  for (Vec3& p : posed) p = 2.0 * p;
  const std::vector<Vec3> out = frame_of(transfer, posed), rest = a.bull.rest();
  const hf_inner::mesh::Topology& topology = a.bull.core->topology();
  for (int32_t e = 0; e < topology.edge_count(); ++e) {
    const auto i = static_cast<size_t>(topology.first(e)), j = static_cast<size_t>(topology.second(e));
    ASSERT_NEAR(hf_inner::norm(out[i] - out[j]), hf_inner::norm(rest[i] - rest[j]), 1e-6 * a.box);
  }
}

TEST(TransferRules, ResultsAreTheSameBitsForAnyNumberOfThreads) {
  const Animals& a = animals();
  std::vector<Vec3> expected;
  for (const uint32_t threads : {1u, 2u, 5u}) {
    const World world(threads);
    Body horse = a.horse, bull = a.bull;
    horse.build(world);
    bull.build(world);
    hf_inner::transfer::Transfer transfer(horse.core, bull.core, options(false, 0));
    add(transfer, a.pairs.inputs());
    const std::vector<Vec3> out = frame_of(transfer, horse.posed(a.walk, 0.37));
    if (expected.empty()) expected = out;
    for (size_t v = 0; v < out.size(); ++v) {
      ASSERT_EQ(out[v].x, expected[v].x) << threads;
      ASSERT_EQ(out[v].y, expected[v].y) << threads;
      ASSERT_EQ(out[v].z, expected[v].z) << threads;
    }
  }
}

TEST(TransferRules, SteadyFramesAllocateNothing) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options(false, 0));
  add(transfer, a.pairs.inputs());
  const std::vector<Vec3> posed = a.horse.posed(a.walk, 0.2);
  std::vector<Vec3> out = frame_of(transfer, posed);
  const uint64_t before = a.world.memory->allocation_count();
  for (int i = 0; i < 100; ++i) transfer.apply(posed.data(), out.data());
  EXPECT_EQ(a.world.memory->allocation_count(), before);
}

TEST(TransferRules, TheSkinReplaysTheFrameAndItsWeightsSumToExactlyOne) {
  const Animals& a = animals();
  for (const bool paper : {false, true}) {
    hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options(paper, 0));
    add(transfer, a.pairs.inputs());
    const std::vector<Vec3> out = frame_of(transfer, a.horse.posed(a.walk, 0.7)), rest = a.bull.rest();
    const auto count = static_cast<size_t>(transfer.cluster_count());
    std::vector<Vec3> pivots(count), places(count);
    std::vector<hf_inner::deform::Quaternion> rotations(count);
    transfer.skin_motion(pivots.data(), rotations.data(), places.data());
    for (const uint32_t width : {4u, 8u}) {
      std::vector<uint32_t> joints(width);
      std::vector<float> weights(width);
      for (size_t v = 0; v < out.size(); ++v) {
        transfer.skin_weights(static_cast<int32_t>(v), width, joints.data(), weights.data());
        float sum = 0;
        Vec3 p;
        for (uint32_t i = 0; i < width; ++i) {
          sum += weights[i];
          if (i > 0) {
            ASSERT_LE(weights[i], weights[i - 1]);
          }
          p = p + static_cast<double>(weights[i]) *
                      (hf_inner::deform::rotate(rotations[joints[i]], rest[v] - pivots[joints[i]]) + places[joints[i]]);
        }
        ASSERT_EQ(sum, 1.0f) << v;
        ASSERT_LT(hf_inner::norm(p - out[v]), 1e-9 * a.box) << v;
      }
    }
  }
}

TEST(TransferRules, WeightsOfAVertexAreRoundedToAnExactSum) {
  for (int trial = 0; trial < 1000; ++trial) {
    hf_inner::transfer::ClusterWeight candidates[6];
    const int count = 1 + trial % 6;
    for (int i = 0; i < count; ++i) {
      candidates[i].cluster = i;
      candidates[i].weight = trial % 7 == 0 ? 0.0 : std::fmod(0.137 * (trial + 1) * (i + 1), 1.0);
    }
    int32_t joint[4];
    float weight[4];
    hf_inner::transfer::write_weights(candidates, count, joint, weight);
    ASSERT_EQ(((weight[0] + weight[1]) + weight[2]) + weight[3], 1.0f);
    for (int i = 0; i < 4; ++i) {
      ASSERT_GE(weight[i], 0.0f);
      ASSERT_GE(joint[i], 0);
      ASSERT_LT(joint[i], count);
    }
  }
}

// The overlap of such a cluster with itself is one point. Rounding gave it an extent, whose rotation was random.
TEST(TransferRules, AClusterThatOverlapsNoOtherKeepsTheRotationOfItsSource) {
  hf_inner::Memory memory;
  for (int trial = 1; trial <= 200; ++trial) {
    hf_inner::mesh::Mesh mesh(memory);
    hf_inner::transfer::Clusters clusters(memory);
    std::vector<double> area;
    clusters.count = 1;
    clusters.field_count = 1;
    clusters.centre.assign(1, 0.5);
    for (int v = 0; v < 3; ++v) {
      const double x = std::fmod(0.137 * trial * (v + 1), 1.0);
      mesh.positions.push_back({x, x * x - 0.3, std::sin(7 * x)});
      area.push_back(0.1 + 0.2 * x);
      for (int k = 0; k < hf_inner::transfer::blend_count; ++k) {
        clusters.joint.push_back(0);
        clusters.weight.push_back(k == 0 ? 1.0f : 0.0f);
      }
    }
    hf_inner::transfer::Refit refit(memory);
    refit.prepare(mesh, {area.data(), area.size()}, clusters, memory);
    const hf_inner::deform::Quaternion given = hf_inner::deform::exponential({0.3, -0.2, 0.01 * trial});
    const hf_inner::Mat3 matrix = given.toRotationMatrix();
    const Vec3 shift{0.1, 0.2, -0.3};
    hf_inner::deform::Quaternion turned = given;
    refit.turn(&given, nullptr, &shift, &turned, &matrix);
    ASSERT_LT(turned.angularDistance(given), 1e-12) << "trial " << trial;
  }
}

}  // namespace
