// Bodies of other plans: four legs, wings, eight legs, none.
#include <gtest/gtest.h>

#include "rig_family.h"

namespace hf_test {
namespace {

using hf_inner::Character;
using hf_inner::know_character;
using hf_inner::Memory;

std::string why(const Character& c) { return {c.why.begin(), c.why.end()}; }

class Beasts : public testing::TestWithParam<std::string> {};

TEST_P(Beasts, NamesGiveAxesRolesAndSidesWhereverTheyStand) {
  const Rig rig = make_beast(GetParam(), true);
  const bool sided = GetParam() != "snake";
  for (const Placing& placing : {Placing{}, Placing{0.01, 90, false, false, {}}, Placing{100, 180, false, false, {}},
                                 Placing{1, 140, false, false, {3, 0, 1}}, Placing{1, 0, true, false, {}}}) {
    Memory memory;
    const PlacedRig placed(rig, placing);
    hf_inner::CharacterInput in = placed.input();
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
    hf_inner::CharacterInput in = placed.input();
    const double up[] = {0, 1, 0};
    in.up = up;
    const Character found = know_character(in, memory);
    if (found.forward_confidence > 0.6) {
      EXPECT_EQ(placed.faults(found, false), "") << why(found);
    }
    const bool stands = GetParam() == "horse" || GetParam() == "fox with hands" || GetParam() == "tyrannosaur";
    EXPECT_TRUE(!stands || found.forward_confidence > 0.6) << why(found);
  }
}

INSTANTIATE_TEST_SUITE_P(Plans, Beasts, testing::ValuesIn(beasts), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

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
