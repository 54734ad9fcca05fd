// The dials of a transfer: neutral ones change no bit, and each does what its name says.
#include <gtest/gtest.h>

#include <cstring>

#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;
using hf_inner::transfer::Dials;

constexpr double pi = 3.14159265358979323846;
using Frames = std::vector<std::vector<Vec3>>;

// The horse on the bull. Nose and tail tip are the ends of dialled limbs, and so is the left front foot in place of an
// arm where a test asks for one.
struct Dialled {
  explicit Dialled(uint32_t arm = 0) : pairs(animals().pairs), transfer(a.horse.core, a.bull.core, {}) {
    pairs.flags[a.pair("nose")] |= HF_PAIR_NECK;
    pairs.flags[a.pair("tail")] |= HF_PAIR_TAIL;
    for (const char* name : {"front foot left", "front foot right"})
      if (arm) pairs.flags[a.pair(name)] = arm;
    add(transfer, pairs.inputs());
  }
  Frames walk(const Dials& dials, int count = 24) {
    transfer.set_dials(dials);
    Frames out;
    for (int k = 0; k < count; ++k) out.push_back(frame_of(transfer, a.horse.posed(a.walk, 1.0 * k / count)));
    return out;
  }
  Vec3 place(const char* pair, const std::vector<Vec3>& points) const {
    return centre_of(pairs.target[a.pair(pair)], points);
  }
  const Animals& a = animals();
  Pairs pairs;
  hf_inner::transfer::Transfer transfer;
};

constexpr const char* feet[] = {"front foot left", "front foot right", "hind foot left", "hind foot right"};

Dials with_stride(double value) {
  Dials out;
  out.stride = value;
  return out;
}
Dials with_hips(double value) {
  Dials out;
  out.hip_height_share = value;
  return out;
}
Dials with_neck(double value) {
  Dials out;
  out.neck_follow = value;
  return out;
}

TEST(TransferDials, NeutralDialsGiveTheBitsOfNoDials) {
  Dialled d;
  hf_inner::transfer::Transfer plain(d.a.horse.core, d.a.bull.core, {});
  add(plain, d.a.pairs.inputs());
  const Dials turned{1.3, 0.1, 0.5, -0.5, 0.3, 1};
  for (const double time : {0.0, 0.3, 0.7}) {
    const std::vector<Vec3> posed = d.a.horse.posed(d.a.walk, time);
    const std::vector<Vec3> expected = frame_of(plain, posed);
    d.transfer.set_dials(turned);
    const std::vector<Vec3> other = frame_of(d.transfer, posed);
    d.transfer.set_dials(Dials());
    const std::vector<Vec3> out = frame_of(d.transfer, posed);
    EXPECT_EQ(std::memcmp(out.data(), expected.data(), out.size() * sizeof(Vec3)), 0) << time;
    EXPECT_GT(largest_distance(out, other) / d.a.box, 0.02) << "the dials did nothing at " << time;
  }
}

TEST(TransferDials, DialsSetBeforeThePairsAreThoseSetAfterThem) {
  Dialled d;
  const Dials turned{1.2, -0.1, 0.7, -0.4, 0.2, 0.6};
  hf_inner::transfer::Transfer before(d.a.horse.core, d.a.bull.core, {});
  before.set_dials(turned);
  add(before, d.pairs.inputs());
  d.transfer.set_dials(turned);
  const std::vector<Vec3> posed = d.a.horse.posed(d.a.walk, 0.4);
  EXPECT_EQ(largest_distance(frame_of(before, posed), frame_of(d.transfer, posed)), 0);
  EXPECT_EQ(d.transfer.source_counters().factorisations, 1u) << "a dial factorised";
  EXPECT_EQ(d.transfer.target_counters().factorisations, 1u) << "a dial factorised";
}

TEST(TransferDials, AStrideScalesThePathOfEveryFootAlongTheGround) {
  Dialled d;
  const auto excursion = [&](const Frames& frames, const char* foot) {
    double low = 1e300, high = -1e300;
    for (const auto& frame : frames) {
      low = std::min(low, d.place(foot, frame).z);
      high = std::max(high, d.place(foot, frame).z);
    }
    return high - low;
  };
  const Frames neutral = d.walk(Dials());
  for (const double stride : {0.7, 1.2, 1.5}) {
    const Frames dialled = d.walk(with_stride(stride));
    for (const char* foot : feet)
      EXPECT_NEAR(excursion(dialled, foot) / excursion(neutral, foot), stride, 0.01 * stride) << foot;
    for (size_t k = 0; k < neutral.size(); ++k)
      for (const char* foot : feet)
        EXPECT_NEAR(d.place(foot, dialled[k]).y, d.place(foot, neutral[k]).y, 2e-3 * d.a.box) << foot << " in " << k;
  }
}

TEST(TransferDials, AStrideLetsNoPlantedFootSlide) {
  // The horse walks over the ground: its clip, moved so that one standing foot stays.
  Dialled d;
  const size_t foot = d.a.pair("hind foot left");
  const double ground = lowest_of(d.a.horse.rest());
  std::vector<std::vector<Vec3>> posed;
  Vec3 anchor;
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec3> frame = d.a.horse.posed(d.a.walk, k / 60.0);
    if (lowest_of(d.a.pairs.source[foot], frame) - ground > 0.005 * d.a.horse.core->mesh.scale) {
      if (posed.size() > 8) break;
      posed.clear();
      continue;
    }
    const Vec3 now = centre_of(d.a.pairs.source[foot], frame);
    if (posed.empty()) anchor = now;
    for (Vec3& p : frame) p = p + Vec3{anchor.x - now.x, 0, anchor.z - now.z};
    posed.push_back(frame);
  }
  ASSERT_GT(posed.size(), 8u);
  for (const double stride : {0.6, 1.4}) {
    d.transfer.set_dials(with_stride(stride));
    Vec3 low{1e300, 0, 1e300}, high{-1e300, 0, -1e300};
    double first = 0, last = 0;
    for (const auto& frame : posed) {
      const std::vector<Vec3> out = frame_of(d.transfer, frame);
      const Vec3 at = d.place("hind foot left", out);
      low = {std::min(low.x, at.x), 0, std::min(low.z, at.z)};
      high = {std::max(high.x, at.x), 0, std::max(high.z, at.z)};
      (&frame == posed.data() ? first : last) = d.place("rump", out).z;
    }
    EXPECT_LT(hf_inner::norm(high - low) / d.a.box, 1e-3) << stride;
    const double source = centre_of(d.a.pairs.source[d.a.pair("rump")], posed.back()).z -
                          centre_of(d.a.pairs.source[d.a.pair("rump")], posed.front()).z;
    EXPECT_NEAR((last - first) / (d.transfer.scale() * source), stride, 0.05 * stride) << "the body travels as far";
  }
}

TEST(TransferDials, HipHeightMovesTheHipsByItsShareAndKeepsTheFeet) {
  Dialled d;
  const std::vector<Vec3> rest = d.a.bull.rest();
  const double ground = lowest_of(rest);
  const auto hips = [&](const std::vector<Vec3>& points) {
    return 0.5 * (d.place("rump", points).y + d.place("withers", points).y) - ground;
  };
  const Frames neutral = d.walk(Dials());
  for (const double share : {-0.15, 0.1}) {
    const Frames dialled = d.walk(with_hips(share));
    double mean = 0;
    for (size_t k = 0; k < neutral.size(); ++k) {
      mean += (hips(dialled[k]) - hips(neutral[k])) / static_cast<double>(neutral.size());
      for (const char* foot : feet)
        EXPECT_LT(hf_inner::norm(d.place(foot, dialled[k]) - d.place(foot, neutral[k])) / d.a.box, 2e-3)
            << foot << " in frame " << k;
    }
    EXPECT_NEAR(mean / hips(rest), share, 0.02 * std::abs(share));
  }
}

// The direction of the neck: from the middle of the trunk's upper front to the nose.
Vec3 neck(const Dialled& d, const std::vector<Vec3>& points) {
  return d.place("nose", points) - d.place("withers", points);
}

// The vertices where the neck leaves the chest: those whose field of the nose has the values of root_window.
std::vector<int32_t> neck_root(const Dialled& d, const Body& body, const std::vector<std::vector<int32_t>>& regions) {
  hf_inner::transfer::PairFields fields(body.core);
  std::vector<uint32_t> numbers;
  std::vector<hf_inner::Span<const int32_t>> lists;
  for (const std::vector<int32_t>& region : regions) {
    numbers.push_back(static_cast<uint32_t>(numbers.size()));
    lists.push_back({region.data(), region.size()});
  }
  fields.add({numbers.data(), numbers.size()}, {lists.data(), lists.size()}, "body");
  std::vector<double> field(regions.size() * static_cast<size_t>(body.core->size())), leaks(regions.size());
  fields.solve({numbers.data(), numbers.size()}, field.data(), leaks.data());
  std::vector<int32_t> out;
  for (int32_t v = 0; v < body.core->size(); ++v) {
    const double u = field[static_cast<size_t>(v) * regions.size() + d.a.pair("nose")];
    if (u > hf_inner::transfer::root_window.low && u < hf_inner::transfer::root_window.high) out.push_back(v);
  }
  return out;
}

TEST(TransferDials, ANeckThatFollowsTakesTheSourcesDirection) {
  Dialled d;
  const std::vector<int32_t> source_root = neck_root(d, d.a.horse, d.pairs.source),
                             root = neck_root(d, d.a.bull, d.pairs.target);
  const std::vector<Vec3> rest = d.a.horse.rest();
  const Vec3 source = centre_of(d.pairs.source[d.a.pair("nose")], rest) - centre_of(source_root, rest);
  const auto angle = [&](double follow) {
    d.transfer.set_dials(with_neck(follow));
    const std::vector<Vec3> out = frame_of(d.transfer, rest);
    const Vec3 now = d.place("nose", out) - centre_of(root, out);
    return std::acos(hf_inner::dot(now, source) / (hf_inner::norm(now) * hf_inner::norm(source)));
  };
  const double neutral = angle(0);
  EXPECT_GT(neutral, 12 * pi / 180) << "the two carry their heads alike: no test";
  EXPECT_NEAR(angle(0.5), 0.5 * neutral, 0.15 * neutral);
  EXPECT_LT(angle(1), 0.25 * neutral);
}

TEST(TransferDials, ANeckThatDoesNotFollowKeepsItsShapeOnTheTrunk) {
  // the horse lowers its head; the bull's head stays where its trunk carries it
  Dialled d;
  const std::vector<Vec3> rest = d.a.horse.rest();
  const double from = centre_of(d.pairs.source[d.a.pair("withers")], rest).z,
               tip = centre_of(d.pairs.source[d.a.pair("nose")], rest).z;
  std::vector<Vec3> posed = rest;
  const Vec3 pivot = centre_of(d.pairs.source[d.a.pair("withers")], rest);
  for (Vec3& p : posed) {
    const double t = std::clamp((p.z - from) / (0.4 * (tip - from)), 0.0, 1.0);
    p = pivot + hf_inner::deform::rotate(hf_inner::deform::exponential({0.6 * t * t * (3 - 2 * t), 0, 0}), p - pivot);
  }
  const std::vector<Vec3> still = frame_of(d.transfer, rest);
  const double moved = hf_inner::norm(neck(d, frame_of(d.transfer, posed)) - neck(d, still));
  d.transfer.set_dials(with_neck(-0.5));
  const double half = hf_inner::norm(neck(d, frame_of(d.transfer, posed)) - neck(d, still));
  d.transfer.set_dials(with_neck(-1));
  const double none = hf_inner::norm(neck(d, frame_of(d.transfer, posed)) - neck(d, still));
  EXPECT_GT(moved / d.a.box, 0.1);
  EXPECT_LT(half, 0.75 * moved);
  EXPECT_LT(none, 0.4 * moved);
}

TEST(TransferDials, ArmSpaceTurnsTheArmOfEachSideAwayByItsAngle) {
  Dialled d(HF_PAIR_ARM);
  const std::vector<Vec3> rest = d.a.horse.rest(), still = frame_of(d.transfer, rest);
  Dials dials;
  dials.arm_space = 0.4;
  d.transfer.set_dials(dials);
  const std::vector<Vec3> out = frame_of(d.transfer, rest);
  const auto place = [&](const char* pair, const std::vector<Vec3>& points) { return d.place(pair, points); };
  const double left = place("front foot left", out).x - place("front foot left", still).x,
               right = place("front foot right", out).x - place("front foot right", still).x;
  const double side = place("front foot left", still).x > 0 ? 1 : -1;
  EXPECT_GT(side * left / d.a.box, 0.04);
  EXPECT_NEAR(left, -right, 0.05 * std::abs(left));
  // the clusters at the end of the arm turn by the whole angle
  std::vector<hf_inner::deform::Quaternion> turns(static_cast<size_t>(d.transfer.cluster_count()));
  d.transfer.skin_motion(nullptr, turns.data(), nullptr);
  const int32_t end = d.pairs.target[d.a.pair("front foot left")].front();
  uint32_t joints[4];
  float weights[4];
  d.transfer.skin_weights(end, 4, joints, weights);
  EXPECT_NEAR(hf_inner::deform::angle_between(turns[joints[0]], {}), 0.4, 1e-6);
}

TEST(TransferDials, LongPartsMakeTheWholeTurnAndNothingElseChanges) {
  Dialled d;
  const auto farthest = [&](double follow) {
    Dials dials;
    dials.long_follow = follow;
    d.transfer.set_dials(dials);
    return frame_of(d.transfer, d.a.horse.posed(d.a.walk, 0.35));
  };
  const std::vector<Vec3> none = farthest(0), half = farthest(0.5), whole = farthest(1);
  EXPECT_GT(largest_distance(none, whole) / d.a.box, 5e-4);
  EXPECT_LT(largest_distance(none, half), largest_distance(none, whole));
  for (const char* foot : feet)
    EXPECT_LT(hf_inner::norm(d.place(foot, none) - d.place(foot, whole)) / d.a.box, 0.002) << foot;
  const std::vector<Vec3> rest = d.a.horse.rest();
  Dials dials;
  const std::vector<Vec3> still = (d.transfer.set_dials(dials), frame_of(d.transfer, rest));
  dials.long_follow = 1;
  d.transfer.set_dials(dials);
  EXPECT_LT(largest_distance(frame_of(d.transfer, rest), still) / d.a.box, 1e-6) << "at rest";
}

TEST(TransferDials, ResultsAreContinuousInEveryDial) {
  Dialled d;
  Dialled arms(HF_PAIR_ARM);
  const std::vector<Vec3> posed = d.a.horse.posed(d.a.walk, 0.35);
  for (int which = 0; which < 6; ++which) {
    Dialled& body = which == 4 ? arms : d;
    const auto frame = [&](double x) {
      Dials dials;
      double* const values[] = {&dials.stride,      &dials.hip_height_share, &dials.neck_follow,
                                &dials.tail_follow, &dials.arm_space,        &dials.long_follow};
      *values[which] += which == 5 ? 0.5 + x : x;
      body.transfer.set_dials(dials);
      return frame_of(body.transfer, posed);
    };
    for (const double at : {-0.3, -1e-4, 0.0, 0.2}) {
      const double step = largest_distance(frame(at), frame(at + 1e-4)) / d.a.box;
      EXPECT_LT(step, 2e-4) << "dial " << which << " at " << at;
      EXPECT_GT(step, 1e-7) << "dial " << which << " does nothing at " << at;
    }
  }
}

TEST(TransferDials, AHeldRegionStaysUnderEveryDial) {
  Dialled d;
  uint32_t numbers[16];
  hf_inner::transfer::Transfer transfer(d.a.horse.core, d.a.bull.core, {});
  add(transfer, d.pairs.inputs(), numbers);
  const std::vector<Vec3> posed = d.a.horse.posed(d.a.walk, 0.2);
  transfer.set_dials({1.4, 0.2, 0.5, 0.5, 0});
  std::vector<Vec3> out(d.a.bull.rest().size());
  for (const char* name : {"nose", "rump", "front foot left"}) {
    const Vec3 place = d.place(name, d.a.bull.rest()) + Vec3{0.1, 0.2, 0.1};
    const hf_inner::transfer::PairHold hold{numbers[d.a.pair(name)], place};
    transfer.apply(posed.data(), out.data(), {&hold, 1});
    EXPECT_LT(hf_inner::norm(d.place(name, out) - place) / d.a.box, 1e-8) << name;
  }
}

TEST(TransferDials, ARefusedDialLeavesTheOthers) {
  Dialled d;
  const Dials set{1.2, 0.1, 0.2, 0.3, 0.1};
  d.transfer.set_dials(set);
  const std::vector<Vec3> posed = d.a.horse.posed(d.a.walk, 0.2), before = frame_of(d.transfer, posed);
  for (const Dials& bad : {Dials{0.09, 0, 0, 0, 0}, Dials{4.1, 0, 0, 0, 0}, Dials{1, 0.6, 0, 0, 0},
                           Dials{1, 0, -1.1, 0, 0}, Dials{1, 0, 0, 1.1, 0}, Dials{1, 0, 0, 0, 1.6},
                           Dials{1, 0, 0, 0, 0, 1.1}, Dials{1, 0, 0, 0, 0, -0.1}, Dials{std::nan(""), 0, 0, 0, 0}})
    EXPECT_ANY_THROW(d.transfer.set_dials(bad));
  EXPECT_EQ(d.transfer.dials().stride, 1.2);
  EXPECT_EQ(largest_distance(frame_of(d.transfer, posed), before), 0);
}

TEST(TransferFeet, StandUnderABodyThatLeans) {
  Dialled d;
  const std::vector<Vec3> rest = d.a.horse.rest(), still = frame_of(d.transfer, rest);
  const double ground = lowest_of(rest), size = d.a.horse.core->mesh.scale;
  for (const double lean : {0.7, 1.0}) {
    // all but the feet turns about an axis through the ground
    std::vector<Vec3> posed = rest;
    for (Vec3& p : posed) {
      const double share = std::min(1.0, std::max(0.0, (p.y - ground) / size - 0.06) / 0.2), angle = lean * share;
      const double y = p.y - ground, x = p.x;
      p.x = x * std::cos(angle) - y * std::sin(angle);
      p.y = ground + x * std::sin(angle) + y * std::cos(angle);
    }
    const std::vector<Vec3> out = frame_of(d.transfer, posed);
    for (const char* foot : feet) {
      const Vec3 moved = d.place(foot, out) - d.place(foot, still);
      EXPECT_LT(std::hypot(moved.x, moved.z) / d.a.box, 1e-4) << foot << " at " << lean;
    }
  }
}

}  // namespace
