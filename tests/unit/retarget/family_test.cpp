// One body in the conventions of many tools: a motion that is known on each of them goes from one to another.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "plain_retarget.h"
#include "poses.h"
#include "rig_actor.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::retarget::Retarget;

constexpr double degree = 3.14159265358979323846 / 180;

struct Faults {
  double arm = 0, leg = 0, trunk = 0;  // degrees: directions of bones against the truth
  double place = 0;                    // of the hips, in heights
  double sole = 1e300;                 // of the feet over the ground, in heights
  double reported_arm = 0;             // degrees: against the source, by the report
};

Vec3 place_of(const std::vector<double>& world, std::size_t j) {
  return {world[12 * j + 9], world[12 * j + 10], world[12 * j + 11]};
}

// Bones that the source does not have are not judged: nothing tells what they do.
void compare(const RigActor& source, const RigActor& target, const std::vector<double>& trs, const Acted& truth,
             Faults& out) {
  const std::vector<double> world = world_of(target.parents(), trs.data());
  const auto& joints = target.rig().joints;
  std::set<Role> known;
  for (const RigJoint& joint : source.rig().joints) known.insert(joint.role);
  bool hips = true;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (joints[j].role == Role::spine && hips) {
      out.place = std::max(out.place, norm(place_of(world, j) - truth.places[j]) / target.height());
      hips = false;
    }
    const int c = target.carrier(j);
    if (c < 0 || joints[j].helper || !joints[j].judged || joints[static_cast<std::size_t>(c)].helper) continue;
    const Role by = joints[static_cast<std::size_t>(c)].role;
    if (!known.count(by)) continue;
    const Vec3 is = place_of(world, j) - place_of(world, static_cast<std::size_t>(c));
    const Vec3 should = truth.places[j] - truth.places[static_cast<std::size_t>(c)];
    if (norm(should) < 1e-3 * target.height()) continue;
    const double angle = std::atan2(norm(cross(is, should)), dot(is, should)) / degree;
    double& worst = by == Role::arm || by == Role::hand || by == Role::finger ? out.arm
                    : by == Role::leg || by == Role::foot                     ? out.leg
                                                                              : out.trunk;
    worst = std::max(worst, angle);
  }
  out.sole = std::min(out.sole, target.sole_height(world) / target.height());
}

// What plays a frame: of the source, seconds since the last one, of the target.
template <class Play>
Faults play_by(const RigActor& source, const RigActor& target, const Play& frame) {
  const bool mirrored = source.placing().mirrored != target.placing().mirrored;
  Faults out;
  std::vector<double> trs(10 * target.parents().size());
  for (int f = 0; f < 12; ++f) {
    const double time = 0.09 * f;
    frame(source.act(time).trs.data(), f == 0 ? 0 : 0.09, trs.data());
    compare(source, target, trs, target.act(time, mirrored), out);
  }
  return out;
}

Faults play(const RigActor& source, const RigActor& target) {
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.copy_same = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  Faults out = play_by(source, target,
                       [&](const double* from, double seconds, double* to) { retarget.frame(from, seconds, to); });
  for (const auto& chain : retarget.report().chains) {
    if (chain.role == Role::arm) out.reported_arm = std::max(out.reported_arm, chain.worst_degrees);
  }
  return out;
}

Faults play_plain(const RigActor& source, const RigActor& target) {
  const PlainRetarget peer(source.side().input, target.side().input);
  return play_by(source, target, [&](const double* from, double, double* to) { peer.frame(from, to); });
}

// Directions of limbs to a degree. The trunk bends by arc length, which two numbers of joints share differently.
void expect_alike(const Faults& faults, const std::string& what) {
  EXPECT_LT(faults.arm, 1) << what;
  EXPECT_LT(faults.leg, 1) << what;
  EXPECT_LT(faults.trunk, 3) << what;
  EXPECT_LT(faults.place, 0.005) << what;
  EXPECT_GT(faults.sole, -1e-4) << what;
}

class Family : public testing::TestWithParam<std::string> {};

TEST_P(Family, TheTruthIsWhatTheRigDoes) {
  for (const Rest rest : {Rest::t, Rest::a, Rest::crouched}) {
    const RigActor actor(GetParam(), {1, 1, 1, 3, rest}, {100, 30, true, true, {1, 2, 3}});
    Faults faults;
    for (int f = 0; f < 12; ++f) {
      const Acted acted = actor.act(0.09 * f);
      compare(actor, actor, acted.trs, acted, faults);
    }
    EXPECT_LT(faults.arm + faults.leg + faults.trunk, 1e-4);
    EXPECT_NEAR(faults.sole, 0, 1e-9);
  }
}

TEST_P(Family, OneBodyActsAlikeInEveryConvention) {
  const RigActor source(GetParam(), {});
  for (const std::string& convention : biped_conventions)
    expect_alike(play(source, RigActor(convention, {})), "on " + convention);
}

// T, A and crouch, three and five joints of the spine, on each side.
TEST_P(Family, RestsMeetAboutShoulderAndHip) {
  for (const Rest from : {Rest::t, Rest::a, Rest::crouched}) {
    for (const int spine : {3, 5}) {
      const RigActor source(GetParam(), {1, 1, 1, spine, from});
      for (const char* convention : {"mixamo", "rigify", "quaternius", "none"}) {
        for (const Rest to : {Rest::t, Rest::a, Rest::crouched})
          expect_alike(play(source, RigActor(convention, {1, 1, 1, 3, to})),
                       std::string("on ") + convention + " rests " + std::to_string(static_cast<int>(from)) + " " +
                           std::to_string(static_cast<int>(to)) + " spine " + std::to_string(spine));
      }
    }
  }
}

TEST_P(Family, UnitsAxesAndMirrorsDoNotMatter) {
  const Placing placings[] = {
      {}, {0.01, 90, true, false, {}}, {100, 217, false, false, {5, -3, 8}}, {1, 180, false, true, {}}};
  for (const Placing& from : placings) {
    const RigActor source(GetParam(), {}, from);
    for (const Placing& to : placings)
      expect_alike(play(source, RigActor("unreal", {1, 1, 1, 3, Rest::a}, to)),
                   "yaws " + std::to_string(from.yaw) + " " + std::to_string(to.yaw));
  }
}

// Bodies of other proportions: the arms point as those of the source do, feet stay over the ground, and legs differ by
// what soles need. The elbows of other arms rest at another angle, so that what they do themselves is 3 degrees off.
TEST_P(Family, OtherProportionsPointAlike) {
  const BodyShape shapes[] = {{}, {0.45, 0.6, 2.6, 3, Rest::a}, {1.5, 1.5, 0.9, 3, Rest::t}};
  for (const BodyShape& from : shapes) {
    const RigActor source(GetParam(), from);
    for (const BodyShape& to : shapes) {
      const Faults faults = play(source, RigActor("mixamo", to));
      const std::string what = "legs " + std::to_string(from.leg) + " " + std::to_string(to.leg);
      EXPECT_LT(faults.arm, 3) << what;
      EXPECT_LT(faults.reported_arm, 1e-6) << what;
      EXPECT_LT(faults.leg, 15) << what;
      EXPECT_LT(faults.trunk, 3) << what;
      EXPECT_GT(faults.sole, -1e-3) << what;
    }
  }
}

// Names that the plain peer knows.
const std::vector<std::string> plain_conventions = {"mixamo",          "unreal", "unity",     "vrm",
                                                    "ready player me", "kaykit", "quaternius"};

// The peer is competent: on one body at one rest it does what the rig does. Feet that hang on the root of a rig, as
// those of Quaternius do, are beyond it.
TEST(Plain, ThePeerPlaysOneBodyAtOneRest) {
  for (const std::string& from : plain_conventions) {
    const RigActor source(from, {});
    for (const std::string& to : plain_conventions) {
      if (to == "quaternius") continue;
      expect_alike(play_plain(source, RigActor(to, {}, {100, 90, true, false, {5, -3, 8}})), from + " on " + to);
    }
  }
}

// A body of other proportions that rests in A: the peer's arms are off by the rests, its hips by the legs, and its
// soles go under the ground.
TEST(Plain, TheRetargetHoldsWhatThePeerLoses) {
  for (const std::string& from : plain_conventions) {
    const RigActor source(from, {}), target("unreal", {0.45, 0.6, 2.6, 3, Rest::a});
    const Faults ours = play(source, target), plain = play_plain(source, target);
    EXPECT_LT(ours.arm, 0.1 * plain.arm) << from;
    EXPECT_LT(ours.place, plain.place) << from;
    EXPECT_GT(ours.sole, plain.sole + 0.005) << from;
  }
}

// Bones of the source are halved: both halves lead, though the target has one joint for two.
TEST(Report, AJointInsideABoneThatLeadsHasAPartner) {
  const RigActor source("rigify", {}), target("mixamo", {});
  Memory memory;
  const Retarget retarget(source.side(), target.side(), {}, memory);
  for (const std::uint32_t j : retarget.report().unmatched_source) ADD_FAILURE() << source.rig().joints[j].name;
}

INSTANTIATE_TEST_SUITE_P(Conventions, Family, testing::ValuesIn(biped_conventions), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace hf_test
