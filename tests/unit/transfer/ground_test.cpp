// The ground under a transfer: feet that stand while the body turns, surfaces that would sink, bodies that lie.
#include <gtest/gtest.h>

#include "unit/transfer/transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Vec3;

constexpr double pi = 3.14159265358979323846;

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

Vec3 centroid_of(const Body& body, const std::vector<Vec3>& points) {
  hf_inner::Memory memory;
  const auto area = hf_inner::transfer::area_shares(body.core->mesh, memory);
  Vec3 sum;
  for (size_t v = 0; v < points.size(); ++v) sum = sum + area[v] * points[v];
  return sum;
}

// The horse turns about the vertical, by `angle` above `from` boxes over the ground and not at all at its feet.
std::vector<Vec3> twisted(const Body& horse, double angle, double from) {
  std::vector<Vec3> posed = horse.rest();
  const double ground = lowest_of(posed), box = horse.core->mesh.scale;
  const Vec3 middle = centroid_of(horse, posed);
  for (Vec3& p : posed) {
    const double share = from > 0 ? smooth(0.5 * from * box, from * box, p.y - ground) : 1.0;
    const Vec3 d = hf_inner::deform::rotate(hf_inner::deform::exponential({0, share * angle, 0}), p - middle);
    p = middle + d;
  }
  return posed;
}

// The walking horse falls to its side by `angle`, its lowest point on the ground.
std::vector<Vec3> falling(const Animals& a, double angle, double time) {
  std::vector<Vec3> posed = a.horse.posed(a.walk, time);
  const double ground = lowest_of(a.horse.rest());
  for (Vec3& p : posed) p = hf_inner::deform::rotate(hf_inner::deform::exponential({0, 0, angle}), p);
  const double low = lowest_of(posed);
  for (Vec3& p : posed) p.y += ground - low;
  return posed;
}

TEST(TransferGround, AFootThatStandsStaysWhileTheBodyTurnsOverIt) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const std::vector<Vec3> still = frame_of(transfer, a.horse.rest());
  for (const double degrees : {25.0, 40.0, 60.0}) {
    const std::vector<Vec3> out = frame_of(transfer, twisted(a.horse, degrees * pi / 180, 0.3));
    for (size_t foot = 2; foot < 6; ++foot) {
      Vec3 off = centre_of(a.pairs.target[foot], out) - centre_of(a.pairs.target[foot], still);
      off.y = 0;
      EXPECT_LT(hf_inner::norm(off) / a.box, 1e-3) << a.pairs.names[foot] << " at " << degrees << " degrees";
    }
  }
}

TEST(TransferGround, FeetThatTurnWithTheBodyComeRoundWithIt) {
  // all of it turned, and the head bent so that the motion is not rigid: the frame before, turned
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const auto bent = [&](std::vector<Vec3> points) {
    const std::vector<Vec3> rest = a.horse.rest();
    const double tip = centre_of(a.pairs.source[a.pair("nose")], rest).z;
    for (size_t v = 0; v < points.size(); ++v)
      points[v].y -= 0.15 * a.horse.core->mesh.scale * smooth(0.4 * tip, tip, rest[v].z);
    return points;
  };
  const std::vector<Vec3> straight = frame_of(transfer, bent(a.horse.rest()));
  const std::vector<Vec3> out = frame_of(transfer, bent(twisted(a.horse, 0.5 * pi, 0)));
  const hf_inner::deform::Quaternion turn = hf_inner::deform::exponential({0, 0.5 * pi, 0});
  const Vec3 from = centroid_of(a.bull, straight), to = centroid_of(a.bull, out);
  for (size_t foot = 2; foot < 6; ++foot) {
    const Vec3 expected = hf_inner::deform::rotate(turn, centre_of(a.pairs.target[foot], straight) - from) + to;
    EXPECT_LT(hf_inner::norm(centre_of(a.pairs.target[foot], out) - expected) / a.box, 0.01) << a.pairs.names[foot];
  }
}

TEST(TransferGround, ABodyThatTurnsFastDoesNotSwingOut) {
  // Offsets of trunk and feet turn by a share of the body's angle; a share that grows fast makes them run ahead of it.
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const double nod = 0.05 * a.horse.core->mesh.scale;  // so that the motion is not rigid
  const std::vector<Vec3> rest = a.horse.rest();
  double fastest = 0;
  Vec3 before;
  for (int step = 0; step <= 36; ++step) {
    std::vector<Vec3> posed = twisted(a.horse, step * pi / 72, 0);
    for (size_t v = 0; v < posed.size(); ++v) posed[v].y -= nod * smooth(0.5, 1.5, rest[v].z);
    const std::vector<Vec3> out = frame_of(transfer, posed);
    const size_t k = a.pair("withers");
    const Vec3 offset = centre_of(a.pairs.target[k], out) - transfer.scale() * centre_of(a.pairs.source[k], posed);
    if (step > 0) fastest = std::max(fastest, hf_inner::norm(offset - before) / a.box);
    before = offset;
  }
  std::printf("an offset moves by up to %.5f boxes in 2.5 degrees\n", fastest);
  EXPECT_LT(fastest, 0.0051);
}

// Deepest vertex of the bull under the ground, beyond what the source sinks, in boxes. Thin parts do not count.
double sunk(const Animals& a, const std::vector<Vec3>& posed, const std::vector<Vec3>& out,
            hf_inner::transfer::Transfer& transfer) {
  const double source = std::min(0.0, lowest_of(posed) - lowest_of(a.horse.rest()));
  double low = 1e300;
  for (size_t v = 0; v < out.size(); ++v)
    if (!transfer.sinking()[v]) low = std::min(low, out[v].y);
  return (lowest_of(a.bull.rest()) + transfer.scale() * source - low) / a.box;
}

TEST(TransferGround, NoPartOfTheSurfaceSinks) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  std::vector<hf_inner::transfer::PairInput> inputs = a.pairs.inputs();
  add(transfer, inputs);
  const std::vector<Vec3> rest = a.horse.rest();
  const double ground = lowest_of(rest), box = a.horse.core->mesh.scale;
  // upright: the trunk sinks between the legs until it all but lies; head and tail hang
  for (const double drop : {0.2, 0.3, 0.4}) {
    std::vector<Vec3> posed = rest;
    for (Vec3& p : posed) {
      const double height = p.y - ground;
      p.y = ground + std::max(0.25 * height, height - drop * box * smooth(0, 0.3 * box, height));
    }
    EXPECT_LT(sunk(a, posed, frame_of(transfer, posed), transfer), 1e-3) << "drop " << drop;
  }
  // on its side, and on the way there
  double deepest = 0;
  for (int k = 0; k <= 12; ++k) {
    const std::vector<Vec3> posed = falling(a, k * pi / 24, 0.05 * k);
    deepest = std::max(deepest, sunk(a, posed, frame_of(transfer, posed), transfer));
  }
  std::printf("falling to the side: sunk by %.5f of the box\n", deepest);
  EXPECT_LT(deepest, 1e-3);
}

// The bull is bound with slanting legs, which the rest alignment turns upright: without a ground its hooves would sink,
// also while the horse stands as it was bound. A breath of the horse must not lift them out at once.
TEST(TransferGround, LimbsThatAreAlignedAtRestDoNotSinkAtRest) {
  const Animals& a = animals();
  Body bull = creature("bull", 1600, a.world);
  const double ground = lowest_of(bull.rest()), box = bull.core->mesh.scale, top = ground + 0.35 * box;
  bull.move(a.world, [&](glm::dvec3 p) {
    if (p.y < top) p.z += 0.9 * (top - p.y);
    return p;
  });
  hf_inner::transfer::TransferOptions options;
  options.alignment_angle = 0.1;  // every limb that differs is aligned
  const auto depth = [&](const std::vector<Vec3>& out) { return (ground - lowest_of(out)) / box; };
  hf_inner::transfer::TransferOptions off = options;
  off.keep_ground = false;
  hf_inner::transfer::Transfer transfer(a.horse.core, bull.core, options), bare(a.horse.core, bull.core, off);
  const Pairs pairs = find_pairs("horse_to_bull.json", a.horse, bull);
  add(transfer, pairs.inputs());
  add(bare, pairs.inputs());
  const std::vector<Vec3> rest = a.horse.rest();
  EXPECT_GT(depth(frame_of(bare, rest)), 0.005) << "nothing sinks: no test";
  const std::vector<Vec3> still = frame_of(transfer, rest);
  EXPECT_LT(depth(still), 3e-4);
  // a breath: from 1e-6 to 1e-3 boxes
  const double horse_box = a.horse.core->mesh.scale, horse_ground = lowest_of(rest);
  for (const double size : {1e-6, 1e-5, 1e-4, 1e-3}) {
    std::vector<Vec3> breath = rest;
    for (Vec3& p : breath) p.x *= 1 + size * smooth(0.3, 0.6, (p.y - horse_ground) / horse_box);
    const std::vector<Vec3> out = frame_of(transfer, breath);
    EXPECT_LT(depth(out), 3e-4) << size;
    EXPECT_LT(largest_distance(out, still) / box, 0.003) << size;
  }
  // and a rigid motion carries the standing bull along
  const hf_inner::deform::Quaternion turn = hf_inner::deform::exponential({0.3, 1.2, -0.4});
  std::vector<Vec3> turned = rest;
  for (Vec3& p : turned) p = hf_inner::deform::rotate(turn, p) + Vec3{1, 2, 3};
  const std::vector<Vec3> out = frame_of(transfer, turned);
  const Vec3 shift = out[0] - hf_inner::deform::rotate(turn, still[0]);
  for (size_t v = 0; v < out.size(); ++v)
    ASSERT_LT(hf_inner::norm(out[v] - hf_inner::deform::rotate(turn, still[v]) - shift) / box, 1e-6) << v;
}

// Gives the bull a thin rod that begins at a place, a piece of its own as a held weapon is. Returns its vertices.
std::vector<int32_t> hold_a_rod(Body& bull, const World& world, Vec3 from, double length) {
  const auto first = static_cast<uint32_t>(bull.mesh.positions.size());
  const glm::dvec3 low(from.x, from.y, from.z), high = low + glm::dvec3(length, 0.02, 0.02);
  for (uint32_t i = 0; i < 8; ++i)
    bull.mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  for (const uint32_t corner :
       {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5})
    bull.mesh.triangles.push_back(first + corner);
  bull.build(world);
  return bull.inner_of({first, first + 1, first + 2, first + 3, first + 4, first + 5, first + 6, first + 7});
}

// A slab under a body, a piece of its own that reaches lower than the feet: a cape, or scenery.
void add_slab(Body& body, const World& world) {
  const auto first = static_cast<uint32_t>(body.mesh.positions.size());
  const double box = body.core->mesh.scale, low = lowest_of(body.rest()) - 0.1 * box;
  for (uint32_t i = 0; i < 8; ++i)
    body.mesh.positions.emplace_back((i & 1 ? 0.05 : -0.05) * box, low + (i & 2 ? 0.3 * box : 0),
                                     (i & 4 ? 0.05 : -0.05) * box);
  for (const uint32_t corner :
       {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5})
    body.mesh.triangles.push_back(first + corner);
  body.build(world);
}

// The ground is under the feet, though something hangs lower: feet of the source stand, and the target does not sink.
TEST(TransferGround, WhatHangsBelowTheFeetIsNoGround) {
  const Animals& a = animals();
  Body horse = a.horse, bull = a.bull;
  const double ground = lowest_of(bull.rest());
  add_slab(horse, a.world);
  add_slab(bull, a.world);
  const Pairs& pairs = a.pairs;  // a piece at the end of the list leaves the numbers of the others
  ASSERT_EQ(lowest_of(pairs.source[2], horse.rest()), lowest_of(pairs.source[2], a.horse.rest()));
  ASSERT_EQ(lowest_of(pairs.target[2], bull.rest()), lowest_of(pairs.target[2], a.bull.rest()));
  hf_inner::transfer::Transfer transfer(horse.core, bull.core, {});
  add(transfer, pairs.inputs());
  const std::vector<Vec3> still = frame_of(transfer, horse.rest());
  for (const double degrees : {25.0, 40.0}) {
    std::vector<Vec3> posed = horse.rest();
    const double feet = lowest_of(pairs.source[2], posed), box = horse.core->mesh.scale;
    const Vec3 middle = centroid_of(horse, posed);
    for (Vec3& p : posed) {
      const double share = smooth(0.15 * box, 0.3 * box, p.y - feet);
      p = middle +
          hf_inner::deform::rotate(hf_inner::deform::exponential({0, share * degrees * pi / 180, 0}), p - middle);
    }
    const std::vector<Vec3> out = frame_of(transfer, posed);
    for (size_t foot = 2; foot < 6; ++foot) {
      Vec3 off = centre_of(pairs.target[foot], out) - centre_of(pairs.target[foot], still);
      off.y = 0;
      EXPECT_LT(hf_inner::norm(off) / a.box, 1e-3) << pairs.names[foot] << " at " << degrees << " degrees";
    }
  }
  // the trunk sinks between the legs
  std::vector<Vec3> posed = horse.rest();
  const double feet = lowest_of(pairs.source[2], posed), box = horse.core->mesh.scale;
  for (Vec3& p : posed) {
    const double height = p.y - feet;
    if (height > 0) p.y = feet + std::max(0.25 * height, height - 0.4 * box * smooth(0, 0.3 * box, height));
  }
  const std::vector<Vec3> out = frame_of(transfer, posed);
  double low = 1e300;
  for (size_t v = 0; v < out.size(); ++v)
    if (!transfer.sinking()[v]) low = std::min(low, out[v].y);
  EXPECT_LT((ground - low) / bull.core->mesh.scale, 2e-3);
  size_t free = 0;  // but for what hangs there at rest
  for (size_t v = 0; v < out.size(); ++v) free += transfer.sinking()[v] && bull.rest()[v].y < ground - 1e-6;
  EXPECT_EQ(free, 4u);
}

TEST(TransferGround, ThinPartsThatNoPairMovesAndTailsMaySink) {
  const Animals& a = animals();
  Body bull = creature("bull", 1600, a.world);
  const Pairs pairs = find_pairs("horse_to_bull.json", a.horse, bull);
  const std::vector<int32_t> before(bull.core->mesh.given_of_inner.begin(), bull.core->mesh.given_of_inner.end());
  const std::vector<int32_t> rod = hold_a_rod(bull, a.world, centre_of(pairs.target[a.pair("nose")], bull.rest()), 0.9);
  std::vector<std::vector<int32_t>> regions;
  std::vector<hf_inner::transfer::PairInput> inputs = pairs.inputs();
  for (size_t i = 0; i < inputs.size(); ++i) {
    std::vector<uint32_t> flat;
    for (const int32_t v : pairs.target[i]) flat.push_back(static_cast<uint32_t>(before[static_cast<size_t>(v)]));
    regions.push_back(bull.inner_of(flat));
  }
  for (size_t i = 0; i < inputs.size(); ++i) inputs[i].target = {regions[i].data(), regions[i].size()};
  inputs[a.pair("tail")].flags |= HF_PAIR_TAIL;
  hf_inner::transfer::Transfer transfer(a.horse.core, bull.core, {});
  add(transfer, inputs);
  const std::vector<Vec3> rest = bull.rest();
  const uint8_t* sinking = transfer.sinking();
  ASSERT_NE(sinking, nullptr);
  size_t horns = 0, tuft = 0, legs = 0, trunk = 0, low_legs = 0;
  for (size_t v = 0; v < rest.size(); ++v) {
    const Vec3& p = rest[v];
    if (std::find(rod.begin(), rod.end(), static_cast<int32_t>(v)) != rod.end()) {
      EXPECT_EQ(sinking[v], 1) << "the rod, " << v;
      continue;
    }
    const bool is_tail = p.z < -1.0 && p.y < 0.9;
    const bool is_horn = std::abs(p.x) > 0.2 && p.y > 1.38 && p.z > 0.97, is_tuft = is_tail && p.y < 0.5;
    horns += is_horn;
    tuft += is_tuft;
    if (is_horn || is_tuft) {
      EXPECT_EQ(sinking[v], 1) << p.x << " " << p.y << " " << p.z;
    }
    if (p.y < 0.5 && !is_tail) {
      low_legs += 1;
      legs += sinking[v];
    }
    if (p.y > 0.8 && p.z < 0.5 && p.z > -0.8) trunk += sinking[v];
  }
  std::printf("%zu vertices of horns, %zu of the tail's tuft, %zu of lower legs\n", horns, tuft, low_legs);
  EXPECT_GT(horns, 4u);
  EXPECT_GT(tuft, 4u);
  EXPECT_EQ(legs, 0u);
  EXPECT_EQ(trunk, 0u);
  // Lying, the rod goes into the ground as deep as it is long and keeps its shape; what may not sink does not.
  for (const double degrees : {60.0, 90.0, 120.0}) {
    const std::vector<Vec3> posed = falling(a, degrees * pi / 180, 0.3), out = frame_of(transfer, posed);
    const double ground =
        lowest_of(rest) + transfer.scale() * std::min(0.0, lowest_of(posed) - lowest_of(a.horse.rest()));
    double deepest = 0, of_sinking = 0;
    for (size_t v = 0; v < out.size(); ++v)
      (sinking[v] ? of_sinking : deepest) = std::max(sinking[v] ? of_sinking : deepest, ground - out[v].y);
    std::printf("at %.0f degrees: parts that may sink %.4f under the ground, the others %.5f\n", degrees,
                of_sinking / a.box, deepest / a.box);
    EXPECT_LT(deepest / a.box, 1e-3) << degrees;
    for (const int32_t u : rod)
      for (const int32_t v : rod)
        EXPECT_NEAR(hf_inner::norm(out[static_cast<size_t>(u)] - out[static_cast<size_t>(v)]),
                    hf_inner::norm(rest[static_cast<size_t>(u)] - rest[static_cast<size_t>(v)]), 0.01 * a.box);
  }
  // A contact is held above the ground with what is thin around it, and without a ground nothing is named.
  inputs[a.pair("tail")].flags = HF_PAIR_CONTACT;
  hf_inner::transfer::Transfer touching(a.horse.core, bull.core, {});
  add(touching, inputs);
  for (const int32_t v : regions[a.pair("tail")]) EXPECT_EQ(touching.sinking()[v], 0);
  hf_inner::transfer::TransferOptions off;
  off.keep_ground = false;
  hf_inner::transfer::Transfer flying(a.horse.core, bull.core, off);
  add(flying, inputs);
  EXPECT_EQ(flying.sinking(), nullptr);
}

TEST(TransferGround, ABodyThatLiesRestsOnItsTrunkNotOnWhateverReachesLowest) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const std::vector<Vec3> rest = a.bull.rest(), source_rest = a.horse.rest();
  const auto trunk_height = [](const Body& body, const std::vector<Vec3>& still, const std::vector<Vec3>& points) {
    // the barrel: the middle of the body's length, off the ground at rest
    double front = -1e300, back = 1e300, low = 1e300;
    for (const Vec3& p : still) {
      front = std::max(front, p.z);
      back = std::min(back, p.z);
    }
    for (size_t v = 0; v < points.size(); ++v) {
      const double along = (still[v].z - back) / (front - back);
      if (along > 0.4 && along < 0.6 && still[v].y - lowest_of(still) > 0.25 * body.core->mesh.scale)
        low = std::min(low, points[v].y);
    }
    return low - lowest_of(still);
  };
  for (const double degrees : {80.0, 90.0, 100.0}) {
    const std::vector<Vec3> posed = falling(a, degrees * pi / 180, 0.3), out = frame_of(transfer, posed);
    const double source = transfer.scale() * trunk_height(a.horse, source_rest, posed),
                 target = trunk_height(a.bull, rest, out);
    std::printf("lying at %.0f degrees: barrel %.4f over the ground, the source's %.4f\n", degrees, target / a.box,
                source / a.box);
    EXPECT_NEAR(target, source, 0.03 * a.box) << degrees;
  }
}

TEST(TransferGround, FallingIsAsSmoothAsItsSource) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  std::vector<Vec3> before, source_before;
  double worst = 0;
  for (int k = 0; k <= 90; ++k) {
    const std::vector<Vec3> posed = falling(a, k * pi / 180, 0.3), out = frame_of(transfer, posed);
    if (k > 0)
      worst =
          std::max(worst, largest_distance(out, before) / (transfer.scale() * largest_distance(posed, source_before)));
    before = out;
    source_before = posed;
  }
  std::printf("falling: largest step of a vertex %.2f times the source's\n", worst);
  EXPECT_LT(worst, 3.0);
}

TEST(TransferGround, ARegionTheCallerHoldsUnderTheGroundStaysThere) {
  // a foot on a step down
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  std::vector<uint32_t> numbers(a.pairs.names.size());
  add(transfer, a.pairs.inputs(), numbers.data());
  const std::vector<Vec3> posed = a.horse.posed(a.walk, 0.3), still = frame_of(transfer, posed);
  const size_t foot = a.pair("front foot left");
  const Vec3 step = centre_of(a.pairs.target[foot], still) - Vec3{0, 0.06 * a.box, 0};
  const hf_inner::transfer::PairHold hold{numbers[foot], step};
  std::vector<Vec3> out(still.size());
  transfer.apply(posed.data(), out.data(), {&hold, 1});
  EXPECT_LT(hf_inner::norm(centre_of(a.pairs.target[foot], out) - step), 1e-6 * a.box);
  // its sole too: nothing of it is bent up to the ground
  EXPECT_NEAR(lowest_of(a.pairs.target[foot], out) - step.y,
              lowest_of(a.pairs.target[foot], still) - centre_of(a.pairs.target[foot], still).y, 0.01 * a.box);
  const size_t other = a.pair("hind foot right");
  EXPECT_LT(hf_inner::norm(centre_of(a.pairs.target[other], out) - centre_of(a.pairs.target[other], still)),
            0.01 * a.box);
}

TEST(TransferGround, FramesInWhichSomethingSinksAllocateNothingAndRepeat) {
  const Animals& a = animals();
  hf_inner::transfer::Transfer transfer(a.horse.core, a.bull.core, {});
  add(transfer, a.pairs.inputs());
  const std::vector<Vec3> posed = falling(a, 1.2, 0.2);
  const std::vector<Vec3> first = frame_of(transfer, posed);
  std::vector<Vec3> out = first;
  const uint64_t before = a.world.memory->allocation_count();
  for (const double angle : {0.3, 0.8, 1.5}) transfer.apply(falling(a, angle, 0.4).data(), out.data());
  transfer.apply(posed.data(), out.data());
  EXPECT_EQ(a.world.memory->allocation_count(), before);
  EXPECT_EQ(largest_distance(out, first), 0.0);
}

}  // namespace
