// What must hold for every pair: identities, equal skeletons, root motion, planted feet, bad input, no allocation.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "poses.h"
#include "retarget/turns.h"
#include "rig_actor.h"

namespace hf_test {
namespace {

using hf_inner::Error;
using hf_inner::Memory;
using hf_inner::retarget::Retarget;
using hf_inner::retarget::RetargetOptions;

std::vector<double> run(Retarget& retarget, const std::vector<double>& source, std::size_t joints, double seconds = 0) {
  std::vector<double> out(10 * joints);
  retarget.frame(source.data(), seconds, out.data());
  return out;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = a.size() == b.size() ? 0 : 1e300;
  for (std::size_t k = 0; k < a.size() && k < b.size(); ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

Vec3 place_of(const std::vector<double>& world, std::size_t j) {
  return {world[12 * j + 9], world[12 * j + 10], world[12 * j + 11]};
}

double worst_place(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t j = 0; 12 * j < a.size(); ++j) most = std::max(most, norm(place_of(a, j) - place_of(b, j)));
  return most;
}

TEST(Identity, RestInIsRestOutWhereRestsAreAlike) {
  for (const std::string& from : biped_conventions) {
    const RigActor source(from, {});
    for (const char* to : {"mixamo", "rigify org", "quaternius", "kaykit"}) {
      const RigActor target(to, {});
      Memory memory;
      RetargetOptions options;
      options.copy_same = false;
      Retarget retarget(source.side(), target.side(), options, memory);
      const auto rest = rest_trs(target.side().input);
      const auto out = run(retarget, rest_trs(source.side().input), target.parents().size());
      EXPECT_LT(worst_place(world_of(target.parents(), out.data()), world_of(target.parents(), rest.data())),
                1e-6 * target.height())
          << from << " on " << to;
    }
  }
}

// The rest of a T pose on a rig that rests in A: its limbs come out as in T.
TEST(Identity, RestInIsAlignedRestOut) {
  const RigActor source("mixamo", {}), target("unreal", {1, 1, 1, 3, Rest::a}), as_t("unreal", {});
  Memory memory;
  Retarget retarget(source.side(), target.side(), {}, memory);
  const auto out =
      world_of(target.parents(), run(retarget, rest_trs(source.side().input), target.parents().size()).data());
  const auto truth = world_of(target.parents(), rest_trs(as_t.side().input).data());
  EXPECT_LT(worst_place(out, truth), 1e-6 * target.height());
}

// The thighs of a stout body run outward to shins that are upright. That is its build: the knee of a slim body does not
// turn outward, and legs that are apart are apart.
TEST(Identity, AKneeAsideOfItsFootIsABuildAndNoPose) {
  for (const char* convention : {"mixamo", "none"}) {  // with names and without
    const RigActor slim(convention, {}), plain(convention, {0.5}), stout(convention, {0.5, 1, 1, 3, Rest::t, 0.15});
    const auto left_leg = [](const RigActor& actor) {
      std::vector<std::size_t> out;
      for (std::size_t j = 0; j < actor.rig().joints.size(); ++j) {
        const RigJoint& joint = actor.rig().joints[j];
        if (joint.side == Side::left && !joint.helper && (joint.role == Role::leg || joint.role == Role::foot))
          out.push_back(j);
      }
      return out;
    };
    struct Leg {
      double bend, aside;  // degrees; of the knee from the line, in lengths of the leg
      Vec3 line;
    };
    const auto leg_of = [&](const RigActor& actor, const std::vector<double>& pose) {
      const auto world = world_of(actor.parents(), pose.data());
      const auto joints = left_leg(actor);
      const Vec3 thigh = place_of(world, joints[1]) - place_of(world, joints[0]);
      const Vec3 shin = place_of(world, joints[2]) - place_of(world, joints[1]), line = thigh + shin;
      const Vec3 out = thigh - (dot(thigh, line) / dot(line, line)) * line;
      return Leg{std::atan2(norm(cross(thigh, shin)), dot(thigh, shin)) * 180 / 3.14159265358979, out.x / norm(line),
                 (1 / norm(line)) * line};
    };
    const auto follow = [&](const RigActor& source, const RigActor& target) {
      Memory memory;
      RetargetOptions options;
      options.goals = false;
      Retarget retarget(source.side(), target.side(), options, memory);
      return leg_of(target, run(retarget, rest_trs(source.side().input), target.parents().size()));
    };
    ASSERT_EQ(left_leg(slim).size(), 3u);
    const Leg by = leg_of(stout, rest_trs(stout.side().input)), led = follow(stout, slim),
              plainly = follow(plain, slim);
    EXPECT_GT(by.aside, 0.1);
    EXPECT_NEAR(led.aside, plainly.aside, 0.01) << convention;
    EXPECT_NEAR(led.bend, plainly.bend, 2) << convention;
    EXPECT_GT(dot(led.line, by.line), 0.998) << convention;  // 3.6 degrees
    EXPECT_NEAR(follow(slim, stout).aside, by.aside, 0.02) << convention;
  }
}

// The plane of a knee turns with its foot: a leg that both rest with turned out comes out as the straight one, turned.
TEST(Identity, TheHingeOfALegTurnsWithItsFoot) {
  const RigActor slim("mixamo", {}), stout("mixamo", {0.5, 1, 1, 3, Rest::t, 0.15});
  const auto thigh_of = [](const RigActor& actor) {
    std::size_t j = 0;
    while (actor.rig().joints[j].side != Side::left || actor.rig().joints[j].role != Role::leg) ++j;
    return j;
  };
  const auto turned_rest = [&](const RigActor& actor, hf_inner::retarget::Turn turn) {
    std::vector<double> pose = rest_trs(actor.side().input);
    const auto world = world_of(actor.parents(), pose.data());
    const auto turn_at = [&](std::size_t k) {
      const double* p = &world[12 * k];
      return hf_inner::retarget::turn_of({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}});
    };
    const std::size_t j = thigh_of(actor);
    const hf_inner::retarget::Turn q =
        inverse(turn_at(static_cast<std::size_t>(actor.parents()[j]))) * (turn * turn_at(j));
    const double numbers[] = {q.x, q.y, q.z, q.w};
    std::copy(numbers, numbers + 4, &pose[10 * j + 3]);
    return pose;
  };
  const auto knee_with = [&](hf_inner::retarget::Turn turn) {
    const std::vector<double> a = turned_rest(stout, turn), b = turned_rest(slim, turn);
    Memory memory;
    RetargetOptions options;
    options.goals = false;
    Retarget retarget({stout.side().input, stout.side().character, a.data()},
                      {slim.side().input, slim.side().character, b.data()}, options, memory);
    const auto world = world_of(slim.parents(), run(retarget, a, slim.parents().size()).data());
    const std::size_t thigh = thigh_of(slim);
    std::size_t knee = thigh + 1;
    while (slim.parents()[knee] != static_cast<std::int32_t>(thigh)) ++knee;
    return place_of(world, knee) - place_of(world, thigh);
  };
  const hf_inner::retarget::Turn out = hf_inner::retarget::turn_about({0, 1, 0}, 0.7);
  const Vec3 straight = knee_with({}), turned = knee_with(out);
  EXPECT_LT(norm(turned - out * straight), 0.01 * norm(straight));
}

// A pose that both name as rest takes the place of what their files rest in.
TEST(Identity, AnyPoseCanBeNamedAsRest) {
  const RigActor source("mixamo", {}), target("unreal", {1, 1, 1, 3, Rest::a});
  const Acted a = source.act(0.3), b = target.act(0.3);
  Memory memory;
  RetargetOptions options;
  options.align_rests = false;
  Retarget retarget({source.side().input, source.side().character, a.trs.data()},
                    {target.side().input, target.side().character, b.trs.data()}, options, memory);
  for (const double time : {0.3, 0.5, 0.8}) {
    const auto out = world_of(target.parents(), run(retarget, source.act(time).trs, target.parents().size()).data());
    const auto truth = world_of(target.parents(), target.act(time).trs.data());
    EXPECT_LT(worst_place(out, truth), 0.01 * target.height()) << time;
  }
}

// The whole source turned about up and moved over the ground: the target turns and moves alike, its way scaled.
TEST(Identity, ARigidMotionOfTheSourceMovesTheTargetAlike) {
  const RigActor source("unreal", {}), target("mixamo", {0.6, 0.7, 1.5, 5, Rest::a});
  const hf_inner::retarget::Turn turn = hf_inner::retarget::turn_about({0, 1, 0}, 0.8);
  const Vec3 shift{0.4, 0, -0.7};
  Memory memory;
  RetargetOptions options;
  options.lock_feet = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> moved = source.act(0.4).trs;
  for (std::size_t j = 0; j < source.parents().size(); ++j) {
    if (source.parents()[j] >= 0) continue;
    double* p = &moved[10 * j];
    const Vec3 place = turn * Vec3{p[0], p[1], p[2]} + shift;
    const hf_inner::retarget::Turn own = turn * hf_inner::retarget::Turn{p[3], p[4], p[5], p[6]};
    const double numbers[] = {place.x, place.y, place.z, own.x, own.y, own.z, own.w};
    std::copy(numbers, numbers + 7, p);
  }
  const std::size_t n = target.parents().size();
  const auto before = world_of(target.parents(), run(retarget, source.act(0.4).trs, n).data());
  const auto after = world_of(target.parents(), run(retarget, moved, n).data());
  const double scale = retarget.report().scale;
  for (std::size_t j = 0; j < n; ++j) {
    if (target.rig().joints[j].helper) continue;
    EXPECT_LT(norm(place_of(after, j) - (turn * place_of(before, j) + scale * shift)), 1e-3 * target.height())
        << target.rig().joints[j].name;
  }
}

TEST(Same, KeysOfEqualSkeletonsAreCopied) {
  for (const std::string& convention : biped_conventions) {
    const RigActor source(convention, {}), target(convention, {});
    Memory memory;
    Retarget retarget(source.side(), target.side(), {}, memory);
    EXPECT_TRUE(retarget.report().same_skeleton) << convention;
    const Acted acted = source.act(0.7);
    EXPECT_EQ(largest_difference(run(retarget, acted.trs, target.parents().size()), acted.trs), 0) << convention;
  }
}

// Another unit, facing and place: one transform is between the rests.
TEST(Same, OneTransformBetweenTheRestsIsKept) {
  for (const double scale : {0.01, 1.0, 100.0}) {
    const RigActor source("mixamo", {}), target("mixamo", {}, {scale, 90, true, false, {1, 2, 3}});
    Memory memory;
    Retarget retarget(source.side(), target.side(), {}, memory);
    EXPECT_TRUE(retarget.report().same_skeleton) << scale;
    for (const double time : {0.2, 0.9}) {
      const auto out = world_of(target.parents(), run(retarget, source.act(time).trs, target.parents().size()).data());
      const auto truth = world_of(target.parents(), target.act(time).trs.data());
      EXPECT_LT(worst_place(out, truth), 1e-6 * target.height()) << scale;
    }
  }
}

TEST(Same, AnotherRestIsNotCopied) {
  const RigActor source("mixamo", {}), target("mixamo", {1, 1, 1, 3, Rest::a}),
      longer("mixamo", {1, 1.2, 1, 3, Rest::t});
  Memory memory;
  EXPECT_FALSE(Retarget(source.side(), target.side(), {}, memory).report().same_skeleton);
  EXPECT_FALSE(Retarget(source.side(), longer.side(), {}, memory).report().same_skeleton);
}

double level_travel(const RigActor& actor, const std::vector<double>& a, const std::vector<double>& b, std::size_t j) {
  const Vec3 d = place_of(world_of(actor.parents(), b.data()), j) - place_of(world_of(actor.parents(), a.data()), j);
  return std::hypot(d.x, d.z);
}

TEST(Root, TravelIsKeptMovedToTheRootOrLeftOut) {
  const RigActor source("mixamo", {}), target("unreal", {0.7, 1, 1, 3, Rest::t});
  const std::size_t n = target.parents().size();
  const auto hips = static_cast<std::size_t>(target.rig().find("pelvis"));
  std::vector<std::vector<double>> worlds;
  for (const auto way : {hf_inner::retarget::RootMotion::keep, hf_inner::retarget::RootMotion::to_root,
                         hf_inner::retarget::RootMotion::in_place}) {
    Memory memory;
    RetargetOptions options;
    options.root_motion = way;
    Retarget retarget(source.side(), target.side(), options, memory);
    const auto first = run(retarget, source.act(0).trs, n), last = run(retarget, source.act(1).trs, n, 0.03);
    const bool stays = way == hf_inner::retarget::RootMotion::in_place;
    EXPECT_NEAR(level_travel(target, first, last, hips), stays ? 0 : 0.8 * retarget.report().scale, 0.06);
    EXPECT_NEAR(level_travel(target, first, last, 0),
                way == hf_inner::retarget::RootMotion::to_root ? level_travel(target, first, last, hips) : 0, 2e-3);
    worlds.push_back(world_of(target.parents(), last.data()));
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (!target.rig().joints[j].helper) {
      EXPECT_LT(norm(place_of(worlds[0], j) - place_of(worlds[1], j)), 1e-9);
    }
  }
  const RigActor rootless("mixamo", {});
  Memory memory;
  RetargetOptions options;
  options.root_motion = hf_inner::retarget::RootMotion::to_root;
  EXPECT_THROW(Retarget(source.side(), rootless.side(), options, memory), Error);
}

// A foot that rests on the source rests on a body of other proportions, while the hips sway.
TEST(Feet, AFootThatStandsStaysWhereItStands) {
  const RigActor source("mixamo", {}), target("kaykit", {0.45, 0.6, 2.6, 3, Rest::a});
  // The hips and all above turn and sway; the feet of the source stay by construction of the pose below.
  Memory memory;
  Retarget retarget(source.side(), target.side(), {}, memory);
  const std::size_t n = target.parents().size();
  const auto rest = rest_trs(source.side().input);
  const RigActor lower("mixamo", {});
  std::size_t foot = 0;
  for (std::size_t j = 0; j < n; ++j) {
    if (target.rig().joints[j].role == Role::foot && target.rig().joints[j].side == Side::left) foot = j;
  }
  Vec3 first{};
  double worst = 0;
  for (int f = 0; f < 30; ++f) {
    std::vector<double> pose = rest;
    // A leg that swings about its foot: hips forward by a little, legs turned back by the same.
    const double angle = 0.1 * std::sin(0.2 * f);
    const std::size_t hips = static_cast<std::size_t>(source.rig().find("mixamorig:Hips"));
    auto world = world_of(source.parents(), rest.data());
    const Vec3 ankle = place_of(world, static_cast<std::size_t>(source.rig().find("mixamorig:LeftFoot")));
    const hf_inner::retarget::Turn lean = hf_inner::retarget::turn_about({1, 0, 0}, angle);
    const Vec3 place = ankle + lean * (place_of(world, hips) - ankle);
    const hf_inner::retarget::Turn own = lean * hf_inner::retarget::Turn{rest[10 * hips + 3], rest[10 * hips + 4],
                                                                         rest[10 * hips + 5], rest[10 * hips + 6]};
    const double numbers[] = {place.x, place.y, place.z, own.x, own.y, own.z, own.w};
    std::copy(numbers, numbers + 7, &pose[10 * hips]);
    // The feet stay flat.
    for (const char* name : {"mixamorig:LeftFoot", "mixamorig:RightFoot"}) {
      const std::size_t j = static_cast<std::size_t>(source.rig().find(name));
      const std::size_t p = static_cast<std::size_t>(source.parents()[j]);
      const auto turn_at = [&](std::size_t k) {
        const double* m = &world[12 * k];
        return hf_inner::retarget::turn_of({{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}});
      };
      const hf_inner::retarget::Turn local = inverse(lean * turn_at(p)) * turn_at(j);
      const double q[] = {local.x, local.y, local.z, local.w};
      std::copy(q, q + 4, &pose[10 * j + 3]);
    }
    const auto out = world_of(target.parents(), run(retarget, pose, n, f == 0 ? 0 : 1.0 / 30).data());
    if (f == 0) first = place_of(out, foot);
    const Vec3 d = place_of(out, foot) - first;
    worst = std::max(worst, std::hypot(d.x, d.z));
  }
  EXPECT_LT(worst, 0.005 * target.height());
}

TEST(Frame, AllocatesNothing) {
  for (const char* convention : {"unreal", "quaternius", "mixamo"}) {
    const RigActor source("mixamo", {}), target(convention, {0.7, 1, 1, 5, Rest::a});
    Memory memory;
    Retarget retarget(source.side(), target.side(), {}, memory);
    std::vector<double> out(10 * target.parents().size());
    std::vector<Acted> poses;
    for (int f = 0; f < 10; ++f) poses.push_back(source.act(0.05 * f));
    const std::uint64_t before = memory.allocation_count();
    for (const Acted& pose : poses) retarget.frame(pose.trs.data(), 0.05, out.data());
    retarget.reset();
    EXPECT_EQ(memory.allocation_count(), before);
  }
}

TEST(Frame, DependsOnItsPoseAloneWithoutTheLock) {
  const RigActor source("mixamo", {}), target("unreal", {0.6, 1, 1, 5, Rest::a});
  Memory memory;
  RetargetOptions options;
  options.lock_feet = false;
  Retarget a(source.side(), target.side(), options, memory), b(source.side(), target.side(), options, memory);
  const std::size_t n = target.parents().size();
  for (int f = 0; f < 10; ++f) run(a, source.act(0.05 * f).trs, n, 0.05);
  EXPECT_EQ(largest_difference(run(a, source.act(0.33).trs, n, 0.05), run(b, source.act(0.33).trs, n)), 0);
}

TEST(Frame, ResetForgetsTheFramesBefore) {
  const RigActor source("mixamo", {}), target("unreal", {0.6, 1, 1, 5, Rest::a});
  Memory memory;
  Retarget a(source.side(), target.side(), {}, memory), b(source.side(), target.side(), {}, memory);
  const std::size_t n = target.parents().size();
  for (int f = 0; f < 10; ++f) run(a, source.act(0.05 * f).trs, n, 0.05);
  a.reset();
  EXPECT_EQ(a.report().frames, 0u);
  for (int f = 0; f < 5; ++f)
    EXPECT_EQ(largest_difference(run(a, source.act(0.05 * f).trs, n, 0.05), run(b, source.act(0.05 * f).trs, n, 0.05)),
              0);
}

TEST(Bad, AFrameThatIsRefusedChangesNothing) {
  const RigActor source("mixamo", {}), target("unreal", {0.6, 1, 1, 5, Rest::a});
  Memory memory;
  Retarget a(source.side(), target.side(), {}, memory), b(source.side(), target.side(), {}, memory);
  const std::size_t n = target.parents().size();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<double> pose = source.act(0.2).trs;
    pose[10 * 4 + 2] = bad;
    std::vector<double> out(10 * n, 7.0);
    try {
      a.frame(pose.data(), 0.05, out.data());
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_NON_FINITE);
      EXPECT_EQ(error.index(), 4u);
    }
    for (const double number : out) EXPECT_EQ(number, 7.0);
  }
  std::vector<double> zero = source.act(0.2).trs;
  for (int k = 3; k < 7; ++k) zero[10 * 2 + static_cast<std::size_t>(k)] = 0;
  std::vector<double> out(10 * n);
  EXPECT_THROW(a.frame(zero.data(), 0.05, out.data()), Error);
  EXPECT_THROW(a.frame(nullptr, 0.05, out.data()), Error);
  EXPECT_THROW(a.frame(source.act(0.2).trs.data(), -1, out.data()), Error);
  EXPECT_THROW(a.frame(source.act(0.2).trs.data(), std::nan(""), out.data()), Error);
  for (int f = 0; f < 5; ++f)
    EXPECT_EQ(largest_difference(run(a, source.act(0.05 * f).trs, n, 0.05), run(b, source.act(0.05 * f).trs, n, 0.05)),
              0);
}

hf_result code_of(const RigActor& source, const hf_inner::skeleton::CharacterInput& input,
                  const RetargetOptions& options = {}, const double* rest = nullptr) {
  Memory memory;
  try {
    Retarget retarget(source.side(), {input, source.side().character, rest}, options, memory);
  } catch (const Error& error) {
    EXPECT_GT(std::string(error.what()).size(), 10u);
    return error.code();
  }
  return HF_OK;
}

TEST(Bad, SidesThatAreNoCharactersAreRefused) {
  const RigActor actor("mixamo", {});
  const hf_inner::skeleton::CharacterInput good = actor.side().input;
  EXPECT_EQ(code_of(actor, good), HF_OK);
  hf_inner::skeleton::CharacterInput in = good;
  in.joint_count = 0;
  EXPECT_EQ(code_of(actor, in), HF_ERROR_EMPTY);
  in = good;
  in.joint_count -= 1;
  EXPECT_EQ(code_of(actor, in), HF_ERROR_INVALID_ARGUMENT);
  in = good;
  in.parents = nullptr;
  EXPECT_EQ(code_of(actor, in), HF_ERROR_NULL_POINTER);
  in = good;
  in.matrices = nullptr;
  EXPECT_EQ(code_of(actor, in), HF_ERROR_NULL_POINTER);
  std::vector<std::int32_t> parents(good.parents, good.parents + good.joint_count);
  in = good;
  in.parents = parents.data();
  parents[1] = 2;
  parents[2] = 1;
  EXPECT_EQ(code_of(actor, in), HF_ERROR_INVALID_ARGUMENT);
  parents[1] = 5000;
  EXPECT_EQ(code_of(actor, in), HF_ERROR_OUT_OF_RANGE);
  std::vector<double> matrices(good.matrices, good.matrices + 16 * good.joint_count);
  in = good;
  in.matrices = matrices.data();
  matrices[16 * 3 + 12] = std::nan("");
  EXPECT_EQ(code_of(actor, in), HF_ERROR_NON_FINITE);
  std::vector<double> rest = rest_trs(good);
  rest[10 * 3 + 1] = std::nan("");
  EXPECT_EQ(code_of(actor, good, {}, rest.data()), HF_ERROR_NON_FINITE);
  RetargetOptions options;
  options.scale = -1;
  EXPECT_EQ(code_of(actor, good, options), HF_ERROR_INVALID_ARGUMENT);
  options.scale = std::nan("");
  EXPECT_EQ(code_of(actor, good, options), HF_ERROR_NON_FINITE);
  options.scale = 0;
  options.root_motion = static_cast<hf_inner::retarget::RootMotion>(3);
  EXPECT_EQ(code_of(actor, good, options), HF_ERROR_INVALID_ARGUMENT);
}

// One joint on another: no part is known, and nothing matches but the joints themselves.
TEST(Same, KeysAreCopiedBetweenEqualSkeletonsThatNobodyUnderstands) {
  const std::int32_t parents[] = {-1};
  const char* const names[] = {"q1"};
  const char* const others[] = {"q2"};
  const double trs[] = {1, 0, 0, 0, 0, 0, 1, 1, 1, 1};
  hf_inner::skeleton::CharacterInput one;
  one.joint_count = 1;
  one.parents = parents;
  one.names = names;
  one.trs = trs;
  hf_inner::skeleton::CharacterInput other = one;
  other.names = others;
  Memory memory;
  const hf_inner::skeleton::Character character = hf_inner::skeleton::know_character(one, memory),
                                      stranger = hf_inner::skeleton::know_character(other, memory);
  Retarget retarget({one, character, nullptr}, {one, character, nullptr}, {}, memory);
  EXPECT_TRUE(retarget.report().same_skeleton);
  std::vector<double> pose(trs, trs + 10);
  pose[2] = 0.3;
  pose[3] = 0.6;
  pose[6] = 0.8;
  EXPECT_EQ(run(retarget, pose, 1), pose);
  EXPECT_THROW(Retarget({one, character, nullptr}, {other, stranger, nullptr}, {}, memory), Error);
}

// A body whose joints are parts of nothing.
TEST(Bad, NoChainInCommonIsRefused) {
  const RigActor source("mixamo", {});
  hf_inner::skeleton::CharacterInput one;
  const std::int32_t parent = -1;
  const double matrix[] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  one.joint_count = 1;
  one.parents = &parent;
  one.matrices = matrix;
  Memory memory;
  const hf_inner::skeleton::Character character = hf_inner::skeleton::know_character(one, memory);
  try {
    Retarget retarget(source.side(), {one, character, nullptr}, {}, memory);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_EMPTY);
  }
}

TEST(Report, ScaleIsTheRatioOfLegLengths) {
  for (const double leg : {0.45, 0.8, 1.5}) {
    const RigActor source("mixamo", {}), target("unreal", {leg, 1, 1, 3, Rest::a}, {100, 0, false, false, {}});
    Memory memory;
    Retarget retarget(source.side(), target.side(), {}, memory);
    EXPECT_NEAR(retarget.report().scale, target.side().character.leg_length / source.side().character.leg_length, 1e-9);
    EXPECT_EQ(retarget.report().scale_source, hf_inner::retarget::ScaleSource::legs);
  }
}

}  // namespace
}  // namespace hf_test
