// Parts that reach farther than their source's turn less: on bars of three clusters whose turns are known.
#include "transfer/levers.h"

#include <gtest/gtest.h>

#include "transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;
using hf_inner::deform::Quaternion;
using hf_inner::transfer::Levers;

constexpr double pi = 3.14159265358979323846;

// A square tube along x of three parts, one cluster each, that overlap at their ends. lengths: of the parts.
struct Bar {
  World world;
  std::shared_ptr<const hf_inner::surface::Core> core;
  std::vector<double> area;
  std::vector<int32_t> joint;
  std::vector<float> weight;

  explicit Bar(const glm::dvec3& lengths) {
    const int rings = 31;
    std::vector<glm::dvec3> positions;
    std::vector<uint32_t> triangles;
    std::vector<double> place;  // from 0 to 3: the part
    double x = 0;
    for (int i = 0; i < rings; ++i) {
      place.push_back(3.0 * i / (rings - 1));
      if (i > 0) x += lengths[std::min(2, (i - 1) / 10)] / 10;
      for (int k = 0; k < 4; ++k) positions.push_back({x, k < 2 ? 0.05 : -0.05, k % 3 == 0 ? 0.05 : -0.05});
    }
    for (int i = 0; i + 1 < rings; ++i)
      for (int k = 0; k < 4; ++k) {
        const auto a = static_cast<uint32_t>(4 * i + k), b = static_cast<uint32_t>(4 * i + (k + 1) % 4);
        triangles.insert(triangles.end(), {a, b, a + 4, b, b + 4, a + 4});
      }
    core = make_core(positions, triangles, world);
    area.assign(static_cast<size_t>(core->size()), 1.0 / core->size());
    for (const int32_t given : core->mesh.given_of_inner) {
      const double at = place[static_cast<size_t>(given) / 4];
      const int part = std::min(2, static_cast<int>(at));
      const double beyond = part < 2 ? std::max(0.0, (at - part - 0.8) / 0.4) : 0.0;
      const float next = static_cast<float>(std::floor(beyond * 1024) / 1024);
      joint.insert(joint.end(), {part, std::min(2, part + 1), 0, 0});
      weight.insert(weight.end(), {1 - next, next, 0, 0});
    }
  }
  hf_inner::transfer::WeightedSurface surface() const {
    return {core.get(), {area.data(), area.size()}, joint.data(), weight.data()};
  }
};

// end: how far the last part is a limb. longer: how many times as far it is from the second part to the end of its
// limb.
// outer: how far the width of parts counts as it is.
Levers levers(const Bar& from, const Bar& to, hf_inner::Memory& memory, double end = 1, double longer = 1,
              double outer = 1) {
  Levers out(memory);
  const double limb[3] = {0, 1, end}, ends[3] = {1, longer, 1}, outers[3] = {0, outer, outer * end};
  // lengths that are not the limb's: both bars in units of the first part
  const double scale = from.core->mesh.scale / to.core->mesh.scale;
  out.prepare(hf_inner::transfer::overlaps_of(3, from.surface(), memory),
              hf_inner::transfer::overlaps_of(3, to.surface(), memory), {limb, 3}, {outers, 3}, {ends, 3}, scale,
              to.core->mesh.to_inner({0, 0, 0}), memory);
  return out;
}

TEST(TransferLevers, APartThatReachesThreeTimesAsFarFollowsAThird) {
  const Bar from({1, 1, 1}), to({1, 1, 3});
  hf_inner::Memory memory;
  Levers found = levers(from, to, memory);
  EXPECT_EQ(found.follow(0), 1) << "the trunk turns as its source";
  EXPECT_NEAR(found.follow(1), 1, 0.1);
  EXPECT_NEAR(found.follow(2), 1.0 / 3, 0.05);
  Quaternion turned[3] = {Quaternion(), Quaternion(), hf_inner::deform::exponential({0, 0, 0.2})};
  found.turn(Quaternion(), 0, turned);
  EXPECT_NEAR(turned[2].angularDistance(Quaternion()), found.follow(2) * 0.2, 0.001);
  EXPECT_LT(turned[1].angularDistance(Quaternion()), 1e-12);
}

// At the root of a limb a part that is a little wider turns as its source; one that is clearly wider turns less.
TEST(TransferLevers, AtItsRootALimbFollowsLessWhereItIsClearlyWider) {
  const Bar from({1, 1, 1});
  hf_inner::Memory memory;
  EXPECT_EQ(levers(from, Bar({1, 1, 1.2}), memory, 1, 1, 0).follow(2), 1);
  EXPECT_LT(levers(from, Bar({1, 1, 1.2}), memory).follow(2), 0.95) << "farther out every width counts";
  const Bar to({1, 1, 3});
  EXPECT_NEAR(levers(from, to, memory, 1, 1, 0).follow(2), levers(from, to, memory).follow(2), 1e-12);
  double last = 1;
  for (double ratio = 0.5; ratio < 4; ratio += 0.01) {
    const double now = hf_inner::transfer::counted_ratio(ratio, 1.3, 1.8);
    EXPECT_GE(now, last) << ratio;
    EXPECT_LT(now - last, 0.04) << ratio;
    if (ratio < 1.3) {
      EXPECT_EQ(now, 1) << ratio;
    }
    if (ratio > 1.81) {
      EXPECT_NEAR(now, ratio, 1e-12) << ratio;
    }
    last = now;
  }
}

TEST(TransferLevers, WhatHangsOnSuchAPartKeepsToIt) {
  const Bar from({1, 1, 1}), to({1, 3, 0.3});
  hf_inner::Memory memory;
  Levers found = levers(from, to, memory);
  ASSERT_LT(found.follow(1), 0.5);
  ASSERT_EQ(found.follow(2), 1);
  const Quaternion both = hf_inner::deform::exponential({0, 0.3, 0});
  Quaternion turned[3] = {Quaternion(), both, both};
  found.turn(Quaternion(), 0, turned);
  EXPECT_LT(turned[1].angularDistance(Quaternion()), 0.2);
  EXPECT_LT(turned[2].angularDistance(turned[1]), 1e-12) << "an ear keeps to its head";
}

TEST(TransferLevers, AFootBehindSuchAPartTurnsAsItsSource) {
  const Bar from({1, 1, 1}), to({1, 3, 1});
  hf_inner::Memory memory;
  Levers found = levers(from, to, memory, 0);
  const Quaternion foot = hf_inner::deform::exponential({0.1, 0.2, 0});
  Quaternion turned[3] = {Quaternion(), hf_inner::deform::exponential({0, 0.3, 0}), foot};
  found.turn(Quaternion(), 0, turned);
  EXPECT_TRUE(turned[2].coeffs() == foot.coeffs());
}

TEST(TransferLevers, NoTurnMakesAPartJump) {
  const Bar from({1, 1, 1});
  hf_inner::Memory memory;
  for (const double length : {1.3, 1.8, 2.2, 3.0, 8.0}) {
    Levers found = levers(from, Bar({1, 1, length}), memory);
    Quaternion last;
    const double step = 0.01;
    for (double angle = 0; angle < 2 * pi + step; angle += step) {
      Quaternion turned[3] = {Quaternion(), Quaternion(), hf_inner::deform::exponential({0.6 * angle, 0, 0.8 * angle})};
      found.turn(Quaternion(), 0, turned);
      EXPECT_LT(turned[2].angularDistance(last), 2 * step) << length << " times as long at " << angle;
      last = turned[2];
    }
  }
}

TEST(TransferLevers, TheSameBodyKeepsItsRotationsToTheLastBit) {
  const Bar bar({1, 2, 1});
  hf_inner::Memory memory;
  Levers found = levers(bar, bar, memory);
  const Quaternion given[3] = {hf_inner::deform::exponential({1, 0, 0}), hf_inner::deform::exponential({0, 2, 1}),
                               hf_inner::deform::exponential({0.4, -1, 3})};
  Quaternion turned[3] = {given[0], given[1], given[2]};
  found.turn(hf_inner::deform::exponential({0.1, 0, 0}), 0, turned);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(turned[c].coeffs() == given[c].coeffs()) << c;
}

TEST(TransferLevers, ADialTakesThePartToTheWholeTurn) {
  const Bar from({1, 1, 1}), to({1, 1, 3});
  hf_inner::Memory memory;
  Levers found = levers(from, to, memory);
  const Quaternion given = hf_inner::deform::exponential({0.3, 0, 1.9});
  double before = 0;
  for (const double whole : {0.0, 0.25, 0.5, 1.0}) {
    Quaternion turned[3] = {Quaternion(), Quaternion(), given};
    found.turn(Quaternion(), whole, turned);
    const double angle = turned[2].angularDistance(Quaternion()), all = given.angularDistance(Quaternion());
    if (whole == 0) before = angle;
    EXPECT_LT(before, 0.7 * all);
    EXPECT_NEAR(angle, before + whole * (all - before), 1e-9) << whole;
    if (whole == 1) {
      EXPECT_TRUE(turned[2].coeffs() == given.coeffs());
    }
  }
}

TEST(TransferLevers, APartWhoseLimbEndsFartherAwayFollowsLess) {
  const Bar bar({1, 1, 1});
  hf_inner::Memory memory;
  EXPECT_NEAR(levers(bar, bar, memory, 1, 2.5).follow(1), 0.4, 1e-12);
  EXPECT_EQ(levers(bar, bar, memory, 1, 0.4).follow(1), 1) << "no part turns more than its source";
  // the larger of both counts
  EXPECT_NEAR(levers(bar, Bar({1, 3, 1}), memory, 1, 1.5).follow(1), levers(bar, Bar({1, 3, 1}), memory).follow(1),
              1e-12);
}

}  // namespace
