// One body in the conventions of many tools: axes, roles and sides are found for all of them.
#include <gtest/gtest.h>

#include "rig_family.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::skeleton::Character;
using hf_inner::skeleton::know_character;

std::string why(const Character& c) { return {c.why.begin(), c.why.end()}; }

std::vector<std::pair<const char*, BodyShape>> shapes() {
  std::vector<std::pair<const char*, BodyShape>> out;
  for (const auto& [name, rest] :
       {std::pair{"T", Rest::t}, std::pair{"A", Rest::a}, std::pair{"crouched", Rest::crouched}}) {
    for (const int spine : {3, 5}) {
      for (const auto& [leg, arm, head] :
           {std::tuple{1.0, 1.0, 1.0}, std::tuple{0.45, 0.6, 2.6}, std::tuple{1.5, 1.5, 0.9}})
        out.push_back({name, {leg, arm, head, spine, rest}});
    }
  }
  return out;
}

class Biped : public testing::TestWithParam<std::string> {};

TEST_P(Biped, AxesRolesAndSidesAreFoundInEveryShape) {
  for (const auto& [name, shape] : shapes()) {
    const Rig rig = make_biped(GetParam(), shape);
    Memory memory;
    const PlacedRig placed(rig, {});
    const Character found = know_character(placed.input(), memory);
    EXPECT_EQ(placed.faults(found), "") << name << " leg " << shape.leg << " spine " << shape.spine << "\n"
                                        << why(found);
  }
}

TEST_P(Biped, ScaleUpAxisFacingAndMirrorDoNotMatter) {
  const Rig rig = make_biped(GetParam(), {});
  for (const Placing& placing :
       {Placing{0.01, 0, false, false, {}}, Placing{100, 0, false, false, {5, -3, 8}}, Placing{1, 90, false, false, {}},
        Placing{1, 180, false, false, {}}, Placing{1, 217, false, false, {1, 0, 0}}, Placing{1, 0, true, false, {}},
        Placing{1, 180, true, false, {}}, Placing{100, 90, true, false, {}}, Placing{1, 0, false, true, {}},
        Placing{1, 90, true, true, {}}}) {
    Memory memory;
    const PlacedRig placed(rig, placing);
    const Character found = know_character(placed.input(), memory);
    EXPECT_EQ(placed.faults(found), "") << "yaw " << placing.yaw << " z up " << placing.z_up << " mirrored "
                                        << placing.mirrored << " scale " << placing.scale << "\n"
                                        << why(found);
  }
}

INSTANTIATE_TEST_SUITE_P(Conventions, Biped, testing::ValuesIn(biped_conventions), [](const auto& info) {
  std::string name = info.param;
  for (char& c : name) c = c == ' ' ? '_' : c;
  return name;
});

// A rest pose in mid-stride has no plane of symmetry. The pose of binding has one.
TEST(Doubt, ABodyThatRestsInAStrideIsMirroredAsItWasBound) {
  Rig rig = make_biped("mixamo", {});
  for (std::size_t j = 0; j < rig.joints.size(); ++j) rig.joints[j].name = "bone" + std::to_string(j);
  std::vector<double> binds;
  const PlacedRig bound(rig, {});
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const Vec3 p = rig.joints[j].pivot;
    binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -p.x, -p.y, -p.z, 1});
  }
  Rig striding = rig;
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    const RigJoint& joint = rig.joints[j];
    const int parent = joint.parent;
    if (joint.side == Side::middle || parent < 0 || rig.joints[static_cast<std::size_t>(parent)].side != Side::middle)
      continue;
    striding.turn(static_cast<int>(j), {1, 0, 0}, joint.side == Side::left ? -50 : 50);
    striding.turn(static_cast<int>(j), {0, 0, 1}, joint.side == Side::left ? 40 : 10);
  }
  const PlacedRig placed(striding, {});
  Memory memory;
  auto input = placed.input();
  const Character alone = know_character(input, memory);
  EXPECT_EQ(why(alone).find("pose of binding"), std::string::npos) << why(alone);
  input.inverse_binds = binds.data();
  const Character found = know_character(input, memory);
  EXPECT_NE(why(found).find("pose of binding"), std::string::npos) << why(found);
  EXPECT_GT(std::fabs(found.left.x), 0.9) << why(found);
}

// Names whose left is the viewer's: each joint bears the name of its mate.
TEST(Doubt, SidesOfTheViewerAreOverruledByTheShapeAndSaidSo) {
  Rig rig = make_biped("mixamo", {});
  for (RigJoint& joint : rig.joints) {
    for (const auto& [from, to] : {std::pair{"Left", "Right"}, std::pair{"Right", "Left"}}) {
      const auto at = joint.name.find(from);
      if (at == std::string::npos) continue;
      joint.name.replace(at, std::string(from).size(), to);
      break;
    }
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "");
  EXPECT_LE(found.forward_confidence, 0.5);
  EXPECT_NE(why(found).find("viewer"), std::string::npos) << why(found);
}

TEST(Doubt, ABodyThatLiesAtRestHasItsOwnUp) {
  const Rig rig = make_biped("unreal", {});
  Memory memory;
  const PlacedRig placed(rig, Placing{1, 0, true, false, {}});  // on its back, in a file whose up is y
  hf_inner::skeleton::CharacterInput in = placed.input();
  const double up[] = {0, 1, 0};
  in.up = up;
  const Character found = know_character(in, memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
  EXPECT_LE(found.up_confidence, 0.6);
}

TEST(Doubt, ADeclaredForwardIsTakenAndADisagreementSaid) {
  const Rig rig = make_biped("unity", {});
  Memory memory;
  const PlacedRig placed(rig, {});
  hf_inner::skeleton::CharacterInput in = placed.input();
  const double back[] = {0, 0, -1}, across[] = {1, 0, 0};
  in.forward = back;
  const Character turned = know_character(in, memory);
  EXPECT_LT(turned.forward.z, -0.99);
  EXPECT_LE(turned.forward_confidence, 0.6);
  in.forward = across;
  const Character kept = know_character(in, memory);
  EXPECT_GT(kept.forward.z, 0.99);
  EXPECT_LE(kept.forward_confidence, 0.5);
}

// A body that rests in mid-stride, without names, whose feet and face say nothing.
Rig make_strider() {
  Rig rig;
  const int hips = rig.add("", -1, {0, 1, 0}, Role::spine);
  rig.add_block(hips, {-0.2, 0.9, -0.1}, {0.2, 1.5, 0.1});
  const int head = rig.add("", hips, {0, 1.55, 0}, Role::head);
  rig.add_block(head, {-0.1, 1.55, -0.1}, {0.1, 1.8, 0.1});
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const int thigh = rig.add("", hips, {s * 0.12, 0.9, 0}, Role::leg, side);
    rig.add_box(thigh, {s * 0.12, 0.9, 0}, {s * 0.12, 0.5, 0}, 0.06);
    const int shin = rig.add("", thigh, {s * 0.12, 0.5, 0}, Role::leg, side);
    rig.add_box(shin, {s * 0.12, 0.5, 0}, {s * 0.12, 0, 0}, 0.05);
    rig.turn(thigh, {1, 0, 0}, s * 20);
  }
  return rig;
}

TEST(Travel, OfAClipSaysWhereABodyLooksThatSaysNothingItself) {
  const Rig rig = make_strider();
  for (const Placing& placing : {Placing{}, Placing{0.01, 180, false, false, {}}, Placing{100, 90, false, false, {}}}) {
    for (const double way : {1.0, -1.0}) {
      Memory memory;
      const PlacedRig placed(rig, placing);
      hf_inner::skeleton::CharacterInput in = placed.input();
      const Vec3 walk = placing.scale * placing.along({0.1, 0, 3 * way}), still = 0.01 * walk;
      const double travels[] = {walk.x, walk.y, walk.z, still.x, still.y, still.z}, up[] = {0, 1, 0};
      in.up = up;
      EXPECT_LT(know_character(in, memory).forward_confidence, 0.6);
      in.travels = travels;
      in.travel_count = 2;
      const Character found = know_character(in, memory);
      EXPECT_GT(hf_inner::dot(found.forward, placing.along({0, 0, way})), 0.9) << why(found);
      EXPECT_GE(found.forward_confidence, 0.7) << why(found);
    }
  }
}

// Names of sides stand against one clip that walks backward.
TEST(Travel, OfOneClipDoesNotTurnABodyRoundWhoseSidesAreNamed) {
  const Rig rig = make_biped("mixamo", {});
  Memory memory;
  const PlacedRig placed(rig, {});
  hf_inner::skeleton::CharacterInput in = placed.input();
  const double back[] = {0, 0, -3};
  in.travels = back;
  in.travel_count = 1;
  const Character found = know_character(in, memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// A word in every name says nothing, even if it is a word of the table.
TEST(Names, APrefixOfAllNamesIsDropped) {
  Rig rig = make_biped("unity", {});
  for (RigJoint& joint : rig.joints) joint.name = "tail_" + joint.name;
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// A pad on the shin does not end the leg.
TEST(Limbs, ALegFollowsTheGroundPastWhatHangsOnIt) {
  Rig rig = make_biped("none", {});
  const std::size_t count = rig.joints.size();
  for (std::size_t j = 0; j < count; ++j) {
    const RigJoint shin = rig.joints[j];
    if (shin.role != Role::leg || shin.pivot.y > 0.6) continue;
    const int pad = rig.add("", static_cast<int>(j), shin.pivot + Vec3{0, -0.05, 0.06}, Role::other, shin.side);
    rig.joints.back().judged = false;
    rig.add_box(pad, shin.pivot + Vec3{0, -0.05, 0.06}, shin.pivot + Vec3{0, -0.1, 0.5}, 0.03);
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// What hangs on a leg above the foot is no toe, and what hangs on an arm above the hand is no finger.
TEST(Limbs, AHolsterIsNoToeAndABracerNoFinger) {
  Rig rig = make_biped("mixamo", {});
  for (const auto& [bone, name] : {std::pair{"mixamorig:RightUpLeg", "Item01"}, {"mixamorig:RightForeArm", "Item02"}}) {
    const int on = rig.find(bone);
    const Vec3 place = rig.joints[static_cast<size_t>(on)].pivot + Vec3{-0.1, -0.1, 0};
    rig.add_box(rig.add(name, on, place, Role::other, Side::right), place, place + Vec3{0, -0.08, 0.02}, 0.02);
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// Between trunk and arm stands a sleeve that the arm hangs on: it is no bone of the arm.
TEST(Limbs, ASleeveThatCarriesAnArmIsItsCollar) {
  Rig rig = make_biped("mixamo", {});
  rig.joints[static_cast<size_t>(rig.find("mixamorig:LeftShoulder"))].name = "mixamorig:Sleeve.L";
  rig.joints[static_cast<size_t>(rig.find("mixamorig:RightShoulder"))].name = "mixamorig:Sleeve.R";
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// Head and tail of a worm mirror each other; they are no pair, since one carries the other.
// Rigify puts both joints of the pelvis at one place.
TEST(Limbs, HipsAtOnePlaceDoNotSwapTheSides) {
  Rig rig = make_biped("rigify", {});
  for (const auto& [pelvis, thigh] :
       {std::pair{"DEF-pelvis.R", "DEF-thigh.R"}, std::pair{"DEF-pelvis.L", "DEF-thigh.L"}}) {
    const int leg = rig.find(thigh), hips = rig.joints[static_cast<size_t>(leg)].parent;
    const int between = rig.add(pelvis, hips, rig.joints[static_cast<size_t>(hips)].pivot, Role::other);
    rig.joints.back().judged = false;
    rig.joints[static_cast<size_t>(leg)].parent = between;
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

// A head in the place where both shoulders begin is no part of their bones: without it the arms have no trunk to hang
// on.
TEST(Limbs, AHeadWhereTheShouldersBeginIsAHead) {
  Rig rig;
  const int hips = rig.add("Root", -1, {0, 1, 0}, Role::spine),
            chest = rig.add("Spine", hips, {0, 1.4, 0}, Role::spine);
  const int head = rig.add("Head", chest, {0, 1.7, 0}, Role::head);
  rig.add_box(hips, {0, 0.95, 0}, {0, 1.3, 0}, 0.2);
  rig.add_box(chest, {0, 1.3, 0}, {0, 1.7, 0}, 0.2);
  rig.add_box(head, {0, 1.7, 0}, {0, 2.1, 0}, 0.2);
  for (const double s : {1.0, -1.0}) {
    const Side side = s > 0 ? Side::left : Side::right;
    const std::string end = s > 0 ? ".L" : ".R";
    const int shoulder = rig.add("Shoulder" + end, chest, {0, 1.7, 0}, Role::shoulder, side);
    const int arm = rig.add("UpperArm" + end, shoulder, {s * 0.3, 1.65, 0}, Role::arm, side);
    const int elbow = rig.add("LowerArm" + end, arm, {s * 0.6, 1.65, 0}, Role::arm, side);
    const int leg = rig.add("UpperLeg" + end, hips, {s * 0.15, 0.95, 0}, Role::leg, side);
    const int knee = rig.add("LowerLeg" + end, leg, {s * 0.15, 0.5, 0.01}, Role::leg, side);
    rig.add_box(arm, {s * 0.3, 1.65, 0}, {s * 0.6, 1.65, 0}, 0.06);
    rig.add_box(elbow, {s * 0.6, 1.65, 0}, {s * 0.9, 1.65, 0}, 0.06);
    rig.add_box(leg, {s * 0.15, 0.95, 0}, {s * 0.15, 0.5, 0}, 0.08);
    rig.add_box(knee, {s * 0.15, 0.5, 0}, {s * 0.15, 0, 0}, 0.08);
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
}

TEST(Mirror, NoJointMirrorsItsAncestor) {
  Rig rig;
  for (int k = 0; k < 8; ++k) {
    const double z = 0.3 * (3.5 - k);
    const int joint = rig.add("", k - 1, {0, 0, z}, Role::spine);
    rig.add_box(joint, {0, 0, z - 0.15}, {0, 0, z + 0.15}, 0.1);
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  hf_inner::skeleton::CharacterInput in = placed.input();
  const double up[] = {0, 1, 0};
  in.up = up;
  const Character found = know_character(in, memory);
  EXPECT_GT(std::fabs(found.left.x), 0.99) << why(found);
  for (const std::int32_t mate : found.mates) EXPECT_EQ(mate, -1);
}

// What the generator knows of lengths.
TEST(Lengths, AreThoseOfTheBodyInItsUnit) {
  for (const double scale : {0.01, 1.0, 100.0}) {
    const Rig rig = make_biped("mixamo", {});
    Memory memory;
    const PlacedRig placed(rig, Placing{scale, 90, true, false, {}});
    const Character found = know_character(placed.input(), memory);
    const double thigh = std::hypot(0.45, 0.02), shin = std::hypot(0.42, 0.04);
    EXPECT_NEAR(found.leg_length, scale * (thigh + shin + 0.08), 1e-6 * scale);
    EXPECT_NEAR(found.hip_height, scale * 0.95, 1e-6 * scale);
    EXPECT_NEAR(found.arm_length, scale * (std::hypot(0.27, 0.01) + std::hypot(0.25, 0.01)), 1e-6 * scale);
  }
}

// A miner with a pickaxe that hangs lower than his feet stands on his feet. So does one with a low cape. A body that
// stands on its hands has its ground under the hands.
TEST(Lengths, TheGroundIsUnderTheFeet) {
  for (const char* convention : {"mixamo", "kaykit", "words"}) {
    const double bare = 0;
    Rig rig = make_biped(convention, {});
    const auto hand = std::find_if(rig.joints.begin(), rig.joints.end(),
                                   [](const RigJoint& j) { return j.role == Role::hand && j.side == Side::right; });
    ASSERT_NE(hand, rig.joints.end());
    const int pickaxe = rig.add("pick", static_cast<int>(hand - rig.joints.begin()), hand->pivot, Role::other);
    rig.joints.back().judged = false;
    rig.add_block(pickaxe, {-0.75, -0.4, -0.02}, {-0.71, 1.4, 0.02});
    rig.add_block(pickaxe, {-0.95, -0.4, -0.02}, {-0.51, -0.35, 0.02});
    const auto spine =
        std::find_if(rig.joints.begin(), rig.joints.end(), [](const RigJoint& j) { return j.role == Role::spine; });
    ASSERT_NE(spine, rig.joints.end());
    const int chest = static_cast<int>(spine - rig.joints.begin());
    const int cape = rig.add("cape", chest, {0, 1.3, -0.15}, Role::other);
    rig.joints.back().judged = false;
    rig.add_block(cape, {-0.2, -0.2, -0.17}, {0.2, 1.3, -0.15});
    Memory memory;
    const PlacedRig placed(rig, {});
    const Character found = know_character(placed.input(), memory);
    EXPECT_NEAR(found.ground, bare, 1e-6) << convention;
    EXPECT_NEAR(dot(found.middle, found.up), bare, 1e-6) << convention;
    EXPECT_NEAR(found.hip_height, 0.95, 0.01) << convention;
    EXPECT_EQ(placed.faults(found), "") << convention;
    for (const hf_inner::skeleton::Chain& chain : found.chains) {
      if (chain.role == Role::leg) {
        EXPECT_NEAR(chain.low, 0, 1e-6) << convention;
      }
    }
  }
  Rig upside_down = make_biped("none", {});
  for (Vec3& p : upside_down.points) p.y = -p.y;
  for (RigJoint& j : upside_down.joints) {
    j.pivot.y = -j.pivot.y;
    // legs and a head that are both known say which end is up, whatever is declared
    j.declared = j.role == Role::leg || j.role == Role::foot || j.role == Role::toe;
  }
  double low = 0;
  for (const Vec3& p : upside_down.points) low = std::min(low, p.y);
  Memory memory;
  const PlacedRig placed(upside_down, {});
  hf_inner::skeleton::CharacterInput input = placed.input();
  const double up[] = {0, 1, 0};
  input.up = up;
  const Character found = know_character(input, memory);
  ASSERT_GT(found.up.y, 0.9);
  EXPECT_NEAR(found.ground, low, 1e-6);
}

// A body that stands on its hands may hold bars. It stands on these, though its feet are known: they are above it.
TEST(Lengths, ABodyOnItsHandsStandsOnWhatTheyHold) {
  Rig rig = make_biped("none", {});
  for (Vec3& p : rig.points) p.y = -p.y;
  double low = 0;
  for (const Vec3& p : rig.points) low = std::min(low, p.y);
  for (RigJoint& j : rig.joints) {
    j.pivot.y = -j.pivot.y;
    j.declared = j.role == Role::leg || j.role == Role::foot || j.role == Role::toe;
  }
  for (const Side side : {Side::left, Side::right}) {
    const auto hand = std::find_if(rig.joints.begin(), rig.joints.end(),
                                   [&](const RigJoint& j) { return j.role == Role::hand && j.side == side; });
    ASSERT_NE(hand, rig.joints.end());
    const double x = hand->pivot.x;
    const int bar = rig.add("", static_cast<int>(hand - rig.joints.begin()), hand->pivot, Role::other);
    rig.joints[static_cast<std::size_t>(bar)].judged = false;
    rig.add_block(bar, {x - 0.03, low - 0.3, -0.03}, {x + 0.03, low + 0.1, 0.03});
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  hf_inner::skeleton::CharacterInput input = placed.input();
  const double up[] = {0, 1, 0};
  input.up = up;
  const Character found = know_character(input, memory);
  ASSERT_GT(found.up.y, 0.9) << why(found);
  EXPECT_NEAR(found.ground, low - 0.3, 1e-6) << why(found);
}

// Wings that hang, as a tail may, reach lower than the feet and carry nothing.
TEST(Lengths, WingsThatHangAreNoGround) {
  Rig rig = make_beast("bird", true);
  for (const double s : {1.0, -1.0}) rig.turn(rig.find(s > 0 ? "Wing1.L" : "Wing1.R"), {0, 0, 1}, s * -80);
  double low = 0;
  for (const Vec3& p : rig.points) low = std::min(low, p.y);
  ASSERT_LT(low, -0.2);
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(placed.faults(found), "") << why(found);
  EXPECT_NEAR(found.ground, 0, 1e-6);
  EXPECT_NEAR(found.hip_height, 0.9, 0.01);
}

// The ends of a scarf, which hang on a knot beside the neck.
TEST(Limbs, APairOnSomethingAsideDoesNotSayWhereTheNeckBegins) {
  Rig rig = make_biped("none", {});
  int neck = -1, chest = -1;
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    if (rig.joints[j].role == Role::neck) neck = static_cast<int>(j);
    if (rig.joints[j].role == Role::spine) chest = static_cast<int>(j);
  }
  ASSERT_GE(neck, 0);
  const double y = rig.joints[static_cast<std::size_t>(neck)].pivot.y + 0.05;
  const int knot = rig.add("", chest, {0.12, y, 0.1}, Role::other);
  rig.joints.back().judged = false;
  rig.add_block(knot, {0.1, y - 0.02, 0.08}, {0.14, y + 0.02, 0.16});
  for (const double s : {1.0, -1.0}) {
    int end = knot;
    for (int k = 0; k < 3; ++k) {
      const Vec3 from{s * (0.1 + 0.15 * k), y - 0.05 * k, 0.12}, to{s * (0.25 + 0.15 * k), y - 0.05 - 0.05 * k, 0.12};
      end = rig.add("", end, from, Role::other);
      rig.joints.back().judged = false;
      rig.add_box(end, from, to, 0.02);
    }
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  EXPECT_EQ(found.roles[static_cast<std::size_t>(neck)], Role::neck) << placed.faults(found);
}

// A man of boxes: arms and spine hang on one control at the hips.
TEST(Limbs, WhatLiesFarBelowTheShouldersIsNoNeck) {
  Rig rig = make_biped("none", {});
  std::vector<std::size_t> spine;
  for (std::size_t j = 0; j < rig.joints.size(); ++j) {
    if (rig.joints[j].role == Role::spine) spine.push_back(j);
  }
  ASSERT_GE(spine.size(), 3u);
  for (RigJoint& joint : rig.joints) {
    const bool arm = joint.role == Role::arm || joint.role == Role::shoulder;
    if (arm && joint.parent == static_cast<int>(spine.back())) joint.parent = static_cast<int>(spine.front());
  }
  Memory memory;
  const PlacedRig placed(rig, {});
  const Character found = know_character(placed.input(), memory);
  for (std::size_t k = 0; k + 1 < spine.size(); ++k)
    EXPECT_EQ(found.roles[spine[k]], Role::spine) << rig.joints[spine[k]].pivot.y << why(found);
}

// Every joint of the body is in one chain, after its carrier if that is in the same one; frames are rotations.
TEST(Chains, HoldEveryJointOnceFromRootToTip) {
  for (const std::string& convention : biped_conventions) {
    const Rig rig = make_biped(convention, {});
    Memory memory;
    const PlacedRig placed(rig, {});
    const Character c = know_character(placed.input(), memory);
    std::vector<int> seen(rig.joints.size(), 0);
    for (std::size_t k = 0; k < c.chains.size(); ++k) {
      const auto& chain = c.chains[k];
      EXPECT_LT(chain.parent, static_cast<int>(k));
      for (std::uint32_t i = 0; i < chain.count; ++i) {
        const std::uint32_t j = c.chain_joints[chain.first + i];
        ++seen[j];
        EXPECT_EQ(c.joint_chains[j], static_cast<int>(k));
        EXPECT_TRUE(i == 0 || c.carriers[j] == static_cast<int>(c.chain_joints[chain.first + i - 1]));
        EXPECT_TRUE(c.mates[j] < 0 || c.mates[static_cast<std::size_t>(c.mates[j])] == static_cast<int>(j));
      }
    }
    for (std::size_t j = 0; j < seen.size(); ++j) {
      EXPECT_EQ(seen[j], c.kinds[j] == hf_inner::skeleton::JointKind::body ? 1 : 0) << convention << " " << j;
      const auto& f = c.frames[j];
      EXPECT_NEAR(hf_inner::dot(hf_inner::cross(f.x, f.y), f.z), 1, 1e-9);
      EXPECT_NEAR(hf_inner::norm(f.origin - placed.placing(rig.joints[j].pivot)), 0, 1e-9);
    }
  }
}

// The second of two bones of an arm has the name of the hand at its end. A hand that is no longer than its arm is one.
TEST(Arms, AHandThatIsLongerThanItsArmIsAForearm) {
  for (const bool longer : {true, false}) {
    Rig rig = make_biped("words", {});
    for (const char* side : {"left", "right"}) {
      const int elbow = rig.find(std::string(side) + "_elbow"), hand = rig.find(std::string(side) + "_hand");
      const int arm = rig.find(std::string(side) + "_arm");
      for (int& owner : rig.owners)
        if (owner == hand || (!longer && owner == elbow)) owner = longer ? elbow : owner == hand ? hand : arm;
      rig.joints[static_cast<std::size_t>(longer ? hand : elbow)].helper = true;
      rig.joints[static_cast<std::size_t>(longer ? hand : elbow)].judged = false;
      rig.joints[static_cast<std::size_t>(hand)].parent = longer ? elbow : arm;
      if (longer) {
        rig.joints[static_cast<std::size_t>(elbow)].name = std::string(side) + "_hand";
        rig.joints[static_cast<std::size_t>(hand)].name = "tip";
      }
    }
    Memory memory;
    const PlacedRig placed(rig, {});
    const Character found = know_character(placed.input(), memory);
    EXPECT_EQ(placed.faults(found), "") << longer;
  }
}

}  // namespace
}  // namespace hf_test
