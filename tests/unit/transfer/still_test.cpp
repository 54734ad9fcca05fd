// Motion without flicker: rotations that never jump, a source that stands still, rest poses, and no ground.
#include <gtest/gtest.h>

#include "transfer/soft_rotation.h"
#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Mat3;
using hf_inner::Vec3;
using hf_inner::deform::Quaternion;

constexpr double sharpness = 4;

TEST(TransferStill, NoiseOnACollinearMomentTurnsNothing) {
  // all moments along x, and noise across: the best rotation turns half round with its sign
  const auto moment = [](double noise) {
    Mat3 s;
    s(0, 0) = 1;
    s(1, 1) = noise;
    s(2, 2) = noise;
    return s;
  };
  const Quaternion guide = hf_inner::deform::exponential({0.3, 0, 0});
  const Quaternion plus = hf_inner::transfer::soft_rotation(moment(1e-5), guide, sharpness),
                   minus = hf_inner::transfer::soft_rotation(moment(-1e-5), guide, sharpness);
  EXPECT_LT(plus.angularDistance(minus), 1e-3);
  EXPECT_LT(plus.angularDistance(guide), 1e-3);
  EXPECT_GT(hf_inner::deform::best_rotation(moment(1e-5), guide)
                .angularDistance(hf_inner::deform::best_rotation(moment(-1e-5), guide)),
            2);
}

TEST(TransferStill, ARigidMomentGivesItsRotation) {
  const Quaternion turn = hf_inner::deform::exponential({0.7, -1.1, 0.4});
  Mat3 shape;
  shape(0, 0) = 0.7;
  shape(1, 1) = 0.25;
  shape(2, 2) = 0.05;
  shape(0, 1) = shape(1, 0) = 0.1;
  const Mat3 s = turn.toRotationMatrix() * shape;
  EXPECT_LT(hf_inner::transfer::soft_rotation(s, turn, sharpness).angularDistance(turn), 1e-12);
  // from a guide nearby it comes nearer, and a moment that is not finite leaves the guide
  const Quaternion near = hf_inner::deform::exponential({0.2, 0, 0}) * turn;
  EXPECT_LT(hf_inner::transfer::soft_rotation(s, near, sharpness).angularDistance(turn), 0.15);
  Mat3 bad = s;
  bad(1, 2) = std::nan("");
  EXPECT_EQ(hf_inner::transfer::soft_rotation(bad, near, sharpness).angularDistance(near), 0);
}

TEST(TransferStill, ASourceThatStandsStillGivesATargetThatStandsStill) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const double unit = std::max(transfer.scale(), a.box / a.horse.core->mesh.scale);
  uint32_t state = 1;
  const auto noise = [&] {
    state = state * 1664525u + 1013904223u;
    return (static_cast<double>(state >> 8) / 16777216.0 - 0.5) * 2e-5 * a.horse.core->mesh.scale;
  };
  for (const double time : {0.0, 0.21, 0.43, 0.6}) {
    std::vector<Vec3> before, before_out;
    for (int frame = 0; frame < 8; ++frame) {
      std::vector<Vec3> posed = a.horse.posed(a.walk, time);
      for (Vec3& p : posed) p = p + Vec3{noise(), noise(), noise()};
      const std::vector<Vec3> out = frame_of(transfer, posed);
      if (frame > 0) {
        double step = 0, moved = 0;
        for (size_t v = 0; v < posed.size(); ++v) step = std::max(step, hf_inner::norm(posed[v] - before[v]));
        for (size_t v = 0; v < out.size(); ++v) moved = std::max(moved, hf_inner::norm(out[v] - before_out[v]));
        EXPECT_LT(moved, 2 * unit * step) << "at " << time << " s, frame " << frame;
      }
      before = posed;
      before_out = out;
    }
  }
}

TEST(TransferStill, RestPosesOfTheCallerCorrespondAndMotionCountsFromThem) {
  const Animals& a = animals();
  const std::vector<Vec3> crouch = a.horse.posed(a.walk, 0.2), target = a.bull.rest();
  hf_inner::transfer::TransferOptions options;
  options.source_rest = {crouch.data(), crouch.size()};
  options.alignment_angle = -1;  // limbs that point elsewhere would turn
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options);
  add(transfer, a.pairs.inputs());
  const std::vector<Vec3> out = frame_of(transfer, crouch);
  for (size_t v = 0; v < out.size(); ++v) EXPECT_LT(hf_inner::norm(out[v] - target[v]), 1e-6 * a.box) << v;
  // and a rest pose of the target is what a still source gives
  const std::vector<Vec3> stride = a.horse.posed(a.walk, 0.4);
  options.target_rest = {stride.data(), stride.size()};
  hf_inner::transfer::Transfer own(a.horse.core, a.horse.core, options);
  Pairs self = a.pairs;
  self.target = self.source;
  add(own, self.inputs());
  const std::vector<Vec3> posed = frame_of(own, crouch);
  for (size_t v = 0; v < posed.size(); ++v)
    EXPECT_LT(hf_inner::norm(posed[v] - stride[v]), 1e-6 * a.horse.core->mesh.scale) << v;
}

TEST(TransferStill, ARestPoseThatIsNotFiniteIsNamed) {
  const Animals& a = animals();
  std::vector<Vec3> bad = a.horse.rest();
  bad[3].y = std::nan("");
  hf_inner::transfer::TransferOptions options;
  options.source_rest = {bad.data(), bad.size()};
  try {
    hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options);
    FAIL() << "it was taken";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_NON_FINITE);
    EXPECT_EQ(error.index(), static_cast<uint32_t>(a.horse.core->mesh.given_of_inner[3]));
  }
}

TEST(TransferStill, WithoutGroundNothingIsKeptAboveIt) {
  const Animals& a = animals();
  std::vector<Vec3> posed = a.horse.posed(a.walk, 0.2);
  for (Vec3& p : posed) p = hf_inner::deform::rotate(hf_inner::deform::exponential({0, 0, 1.2}), p);
  const double low = lowest_of(posed), ground = lowest_of(a.horse.rest());
  for (Vec3& p : posed) p.y += ground - low;
  double deep[2];
  for (const bool keep : {true, false}) {
    hf_inner::transfer::TransferOptions options;
    options.keep_ground = keep;
    hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, options);
    add(transfer, a.pairs.inputs());
    deep[keep ? 0 : 1] = (lowest_of(a.bull.rest()) - lowest_of(frame_of(transfer, posed))) / a.box;
  }
  EXPECT_LT(deep[0], 0.01);
  EXPECT_GT(deep[1], deep[0] + 0.005);
}

}  // namespace
