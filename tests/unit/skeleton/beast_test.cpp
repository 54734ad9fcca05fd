// Bodies of other plans: four legs, wings, eight legs, none.
#include <gtest/gtest.h>

#include "rig_family.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::skeleton::Character;
using hf_inner::skeleton::know_character;

std::string why(const Character& c) { return {c.why.begin(), c.why.end()}; }

class Beasts : public testing::TestWithParam<std::string> {};

TEST_P(Beasts, NamesGiveAxesRolesAndSidesWhereverTheyStand) {
  const Rig rig = make_beast(GetParam(), true);
  const bool sided = GetParam() != "snake";
  for (const Placing& placing : {Placing{}, Placing{0.01, 90, false, false, {}}, Placing{100, 180, false, false, {}},
                                 Placing{1, 140, false, false, {3, 0, 1}}, Placing{1, 0, true, false, {}}}) {
    Memory memory;
    const PlacedRig placed(rig, placing);
    hf_inner::skeleton::CharacterInput in = placed.input();
    // A fish does not stand: its file says what is up.
    const Vec3 truth = placing.along({0, 1, 0});
    const double up[] = {truth.x, truth.y, truth.z};
    if (GetParam() == "fish" || !sided) in.up = up;
    const Character found = know_character(in, memory);
    EXPECT_EQ(placed.faults(found), "") << "yaw " << placing.yaw << " z up " << placing.z_up << "\n" << why(found);
  }
}

TEST_P(Beasts, WithoutNamesAxesAreRightOrUnsure) {
  const Rig rig = make_beast(GetParam(), false);
  for (const Placing& placing : {Placing{}, Placing{0.01, 90, false, false, {}}, Placing{100, 180, false, false, {}}}) {
    Memory memory;
    const PlacedRig placed(rig, placing);
    hf_inner::skeleton::CharacterInput in = placed.input();
    const double up[] = {0, 1, 0};
    in.up = up;
    const Character found = know_character(in, memory);
    if (found.forward_confidence > 0.6) {
      EXPECT_EQ(placed.faults(found, false), "") << why(found);
    }
    const bool stands = GetParam().find("horse") == 0 || GetParam() == "fox with hands" || GetParam() == "tyrannosaur";
    EXPECT_TRUE(!stands || found.forward_confidence > 0.6) << why(found);
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, Beasts, testing::ValuesIn(beasts), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

// An animal that was made of the bones of a person: the tail goes on with the numbers of the spine, and hind legs have
// the word back.
TEST(Quadruped, ATailWithTheNameOfTheSpineIsATail) {
  Rig rig = make_beast("horse", true);
  for (RigJoint& joint : rig.joints) {
    if (joint.role == Role::tail) joint.name = "spine.00" + joint.name.substr(4);
    const bool hind = joint.role == Role::leg && joint.pivot.z < 0;
    if (hind)
      joint.name =
          "back_" + std::to_string(static_cast<int>(100 * joint.pivot.y)) + joint.name.substr(joint.name.size() - 2);
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// The wings of a dragon begin with a joint of the name of a shoulder.
TEST(Bird, AWingWhoseFirstJointIsAShoulderIsAWing) {
  Rig rig = make_beast("bird", true);
  for (RigJoint& joint : rig.joints) {
    if (joint.name.rfind("Wing1", 0) == 0) joint.name = "Shoulder" + joint.name.substr(5);
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// A dog whose front legs are shoulder, elbow and foot has no bone more above the elbow.
TEST(Quadruped, AShoulderAboveElbowAndFootIsTheUpperLeg) {
  Rig rig = make_beast("horse", true);
  for (RigJoint& joint : rig.joints) {
    for (const auto& [was, is] : {std::pair{"FrontUpperLeg", "Shoulder"}, {"FrontLowerLeg", "Elbow"}}) {
      if (joint.name.rfind(was, 0) == 0) joint.name = is + joint.name.substr(std::string(was).size());
    }
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// Its file says that y is up, but a node has put the body on its side, on its back, or its z up.
TEST(Quadruped, ThatLiesHasTheUpOfItsLegs) {
  const Rig rig = make_beast("horse", true);
  const PlacedRig placed(rig, {});
  for (const auto& [up, matrix] : {std::pair<Vec3, std::array<double, 9>>{{0, 0, 1}, {1, 0, 0, 0, 0, 1, 0, -1, 0}},
                                   {{-1, 0, 0}, {0, 1, 0, -1, 0, 0, 0, 0, 1}},
                                   {{0, -1, 0}, {-1, 0, 0, 0, -1, 0, 0, 0, 1}}}) {
    const auto turned = [&, m = matrix](Vec3 v) {  // columns first
      return Vec3{m[0] * v.x + m[3] * v.y + m[6] * v.z, m[1] * v.x + m[4] * v.y + m[7] * v.z,
                  m[2] * v.x + m[5] * v.y + m[8] * v.z};
    };
    std::vector<double> matrices = placed.matrices, positions = placed.positions;
    for (std::size_t j = 0; j < placed.parents.size(); ++j) {
      for (std::size_t c = 0; c < 4 && placed.parents[j] < 0; ++c) {
        double* m = matrices.data() + 16 * j + 4 * c;
        const Vec3 v = turned({m[0], m[1], m[2]});
        m[0] = v.x;
        m[1] = v.y;
        m[2] = v.z;
      }
    }
    for (std::size_t k = 0; k < positions.size(); k += 3) {
      const Vec3 p = turned({positions[k], positions[k + 1], positions[k + 2]});
      positions[k] = p.x;
      positions[k + 1] = p.y;
      positions[k + 2] = p.z;
    }
    hf_inner::skeleton::CharacterInput in = placed.input();
    const double declared[] = {0, 1, 0};
    in.matrices = matrices.data();
    in.positions = positions.data();
    in.up = declared;
    Memory memory;
    const Character found = know_character(in, memory);
    EXPECT_GT(hf_inner::dot(found.up, up), 0.99) << why(found);
    EXPECT_GT(hf_inner::dot(found.forward, turned({0, 0, 1})), 0.99) << why(found);
    EXPECT_LE(found.up_confidence, 0.6);
  }
}

TEST(Quadruped, LegsAreNumberedFromTheFrontAndMeasuredBehind) {
  const Rig rig = make_beast("horse", true);
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  std::vector<std::uint32_t> counts(2, 0);
  for (const auto& chain : found.chains) {
    if (chain.role != Role::leg || chain.side != Side::left) continue;
    EXPECT_EQ(rig.joints[found.chain_joints[chain.first]].name,
              chain.number == 0 ? "FrontUpperLeg.L" : "BackUpperLeg.L");
    EXPECT_EQ(chain.count, chain.number == 0 ? 2u : 3u);
  }
  EXPECT_NEAR(found.hip_height, 1.05, 1e-9);
}

}  // namespace
}  // namespace hf_test
