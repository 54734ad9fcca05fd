// Pieces that move with one bone: parts of robots, buttons on creatures; what stays smooth.
#include <algorithm>

#include "weights/piece_contacts.h"
#include "weights_support.h"

namespace {

using namespace hf_test;
using hf_inner::Vec3;
using hf_inner::weights::Bones;
using hf_inner::weights::Weights;

// A closed tube from `low` to `high` along x, around the line at height y.
PlainMesh part(double low, double high, double radius, double y = 0, std::uint32_t rings = 6) {
  PlainMesh out = tube(10, rings, 1);
  for (std::size_t i = 0; i < out.positions.size(); i += 3) {
    out.positions[i] = low + (high - low) * out.positions[i];
    out.positions[i + 1] = y + radius * out.positions[i + 1];
    out.positions[i + 2] *= radius;
  }
  return out;
}

void add_bone(Bones& bones, const Vec3& head, const Vec3& tail) {
  bones.has_tails = true;
  bones.head.push_back(head);
  bones.tail.push_back(tail);
  bones.parent.push_back(bones.head.size() < 2 ? -1 : 0);
  bones.deforms.push_back(1);
}

// Two limbs whose bones meet at 5, and what lies between or beside them.
struct Robot {
  explicit Robot(std::vector<PlainMesh> parts, std::uint32_t threads = 1) {
    for (const PlainMesh& one : parts) {
      first.push_back(static_cast<Index>(mesh.vertex_count()));
      append(mesh, one, 0);
    }
    first.push_back(static_cast<Index>(mesh.vertex_count()));
    skin = skin_of(mesh, threads);
    bones = std::make_unique<Bones>(*skin->core->memory);
    add_bone(*bones, {0, 0, 0}, {5, 0, 0});
    add_bone(*bones, {5, 0, 0}, {9, 0, 0});
  }
  Weights make() const { return Weights(skin, 4, *bones); }
  // The least and the largest weight of a bone in a part.
  std::pair<double, double> range(const Weights& weights, std::size_t of, std::uint32_t bone) const {
    std::pair<double, double> out{1, 0};
    for (Index v = first[of]; v < first[of + 1]; ++v) {
      const double w = weight_of(weights, v, bone);
      out = {std::min(out.first, w), std::max(out.second, w)};
    }
    return out;
  }
  PlainMesh mesh;
  std::vector<Index> first;  // vertex of each part, one more
  std::shared_ptr<const hf_inner::weights::SkinSurface> skin;
  std::unique_ptr<Bones> bones;
};

constexpr std::pair<double, double> whole{1, 1};

// The second limb begins where the first bone still is.
TEST(RigidPieces, APartOfARobotTakesTheBoneThatItHolds) {
  const Robot robot({part(0, 4, 1), part(4.2, 9, 1)});
  const Weights weights = robot.make();
  expect_valid(weights);
  EXPECT_EQ(robot.range(weights, 0, 0), whole);
  EXPECT_EQ(robot.range(weights, 1, 1), whole);
}

// The ball touches the first limb only.
TEST(RigidPieces, ABallInAJointTakesTheBoneThatBeginsThere) {
  const Robot robot({part(0, 4.4, 1), part(4.6, 5.4, 0.4), part(6.6, 9, 1)});
  EXPECT_EQ(robot.range(robot.make(), 1, 1), whole);
}

// The plate faces away from the limb below it, so it asks the bone above.
TEST(RigidPieces, APartWithoutABoneTakesThatOfThePartThatItTouches) {
  const Robot robot({part(0, 4.4, 1), part(5.6, 9, 1), part(1.5, 2.5, 0.3, 1.33)});
  add_bone(*robot.bones, {2, 2.2, 0}, {2, 3.2, 0});
  const Weights weights = robot.make();
  EXPECT_EQ(robot.range(weights, 2, 0), whole);
  const Robot alone({part(0, 4.4, 1), part(5.6, 9, 1), part(1.5, 2.5, 0.3, 2)});
  add_bone(*alone.bones, {2, 2.5, 0}, {2, 3.5, 0});
  EXPECT_EQ(alone.range(alone.make(), 2, 2), whole) << "it touches nothing";
}

// The plate asks the bone above alone and touches the limb alone: the sums are equal in exact numbers.
TEST(RigidPieces, EqualSumsAreDecidedByContactsInEveryUnit) {
  for (int i = 0; i < 60; ++i) {
    const double unit = 0.01 + i / 7.0;  // some units round a sum up, others down
    std::vector<PlainMesh> parts = {part(0, 4.4, 1), part(5.6, 9, 1), part(1.5, 2.5, 0.3, 1.33)};
    for (PlainMesh& one : parts) {
      for (double& x : one.positions) x *= unit;
    }
    Robot robot(parts);
    robot.bones = std::make_unique<Bones>(*robot.skin->core->memory);
    add_bone(*robot.bones, {2 * unit, 2.2 * unit, 0}, {2 * unit, 3.2 * unit, 0});
    add_bone(*robot.bones, {0, 0, 0}, {5 * unit, 0, 0});
    add_bone(*robot.bones, {5 * unit, 0, 0}, {9 * unit, 0, 0});
    EXPECT_EQ(robot.range(robot.make(), 2, 1), whole) << unit;
  }
}

// No part holds a bone of this skeleton, so all take bones from one another.
TEST(RigidPieces, TheOrderOfThePartsDoesNotDecideWhichBoneTheyTake) {
  const std::vector<PlainMesh> parts = {part(0, 2, 1), part(2.1, 5, 1.2), part(5.1, 6.5, 0.9), part(6.6, 9, 0.8)};
  std::vector<std::vector<std::uint32_t>> taken;
  std::vector<std::size_t> order = {0, 1, 2, 3};
  do {
    std::vector<PlainMesh> list;
    for (const std::size_t i : order) list.push_back(parts[i]);
    Robot robot(list);
    robot.bones = std::make_unique<Bones>(*robot.skin->core->memory);
    add_bone(*robot.bones, {-0.5, 2, 0}, {4.6, 2, 0});
    add_bone(*robot.bones, {4.6, 2, 0}, {9.5, 2, 0});
    const Weights weights = robot.make();
    std::vector<std::uint32_t> bones(4);
    for (std::size_t i = 0; i < 4; ++i) bones[order[i]] = weight_of(weights, robot.first[i], 1) > 0.5;
    taken.push_back(bones);
  } while (std::next_permutation(order.begin(), order.end()));
  for (const auto& bones : taken) EXPECT_EQ(bones, taken.front());
}

TEST(RigidPieces, APinInAPartIsExactAndFades) {
  const Robot robot({part(0, 4, 1), part(4.2, 9, 1)});
  Weights weights = robot.make();
  hf_inner::weights::Pins pins(*robot.skin->core->memory);
  const Index pinned = robot.first[1];
  pins.places.push_back(hf_inner::solve::Site::at_vertex(robot.skin->core->mesh, pinned));
  pins.radius.push_back(0);
  pins.bone.push_back(0);
  pins.share.push_back(1);
  pins.start.push_back(1);
  weights.set_pins(pins);
  expect_valid(weights);
  EXPECT_EQ(weight_of(weights, pinned, 0), 1);
  EXPECT_GT(weight_of(weights, robot.first[2] - 1, 1), 0.9);  // the other end
  EXPECT_EQ(robot.range(weights, 0, 0), whole);
  weights.set_pins(hf_inner::weights::Pins(*robot.skin->core->memory));
  EXPECT_TRUE(same_weights(weights, robot.make()));
}

TEST(RigidPieces, ThreadsDoNotChangeTheBits) {
  const std::vector<PlainMesh> parts = {part(0, 4.4, 1), part(4.6, 5.4, 0.4), part(5.6, 9, 1),
                                        part(1.5, 2.5, 0.3, 1.33)};
  EXPECT_TRUE(same_weights(Robot(parts).make(), Robot(parts, 4).make()));
}

// A body of six bones, a button in the middle of one of them, and one over a joint.
TEST(RigidPieces, AButtonOnACreatureTakesOneBoneWhereThatIsClear) {
  const PlainMesh body = tube(12, 49, 12);
  const PlainMesh button = part(4.8, 5.2, 0.2, 1.25), over = part(7.7, 8.3, 0.2, 1.25);
  PlainMesh mesh = body;
  append(mesh, button, 0);
  append(mesh, over, 0);
  const auto skin = skin_of(mesh);
  const Weights weights(skin, 4, chain(*skin->core->memory, 6, 12));
  expect_valid(weights);
  const Index first = static_cast<Index>(body.vertex_count()),
              second = first + static_cast<Index>(button.vertex_count());
  double least = 1, largest = 0;
  for (Index v = first; v < second; ++v) least = std::min(least, weight_of(weights, v, 2));
  for (Index v = second; at(v) < mesh.vertex_count(); ++v)
    largest = std::max({largest, weight_of(weights, v, 3), weight_of(weights, v, 4)});
  EXPECT_EQ(least, 1);
  EXPECT_LT(largest, 0.9);
  EXPECT_NEAR(weight_of(weights, 12 * 16, 1), 0.5, 0.05) << "the body bends at its joints";
}

// An arm of two bones is a whole family of bones, whatever lies on it: it bends as it does alone. A second arm is a
// family of its own under a root that no part holds, and bones without parents are one family.
TEST(RigidPieces, AButtonACuffAndASleeveChangeNothingOfAnArmOfTwoBones) {
  const PlainMesh arm = part(0, 10, 1, 0, 21), button = part(3.8, 4.2, 0.2, 1.1), cuff = part(6.8, 8, 1.2),
                  sleeve = part(0.5, 9.5, 1.3), other = part(0, 10, 1, 8, 21);
  const auto weights_of = [](const PlainMesh& mesh, int arms, bool parents) {
    const auto skin = skin_of(mesh);
    Bones bones(*skin->core->memory);
    bones.has_tails = true;
    const auto add = [&](Vec3 head, Vec3 tail, Index parent) {
      bones.head.push_back(head);
      bones.tail.push_back(tail);
      bones.parent.push_back(parents ? parent : -1);
      bones.deforms.push_back(1);
    };
    add({-4, 4, 0}, {-3, 4, 0}, -1);
    for (int a = 0; a < arms; ++a) {
      const double y = 8.0 * a;
      add({0, y, 0}, {5, y, 0}, 0);
      add({5, y, 0}, {10, y, 0}, 2 * a + 1);
    }
    return Weights(skin, 4, bones);
  };
  const auto with = [&](std::vector<PlainMesh> more) {
    PlainMesh out = arm;
    for (const PlainMesh& one : more) append(out, one, 0);
    return out;
  };
  const Weights alone = weights_of(arm, 1, true);
  const auto expect_same = [&](const Weights& dressed, const char* what) {
    double most = 0;
    for (Index v = 0; at(v) < arm.vertex_count(); ++v)
      most = std::max(most, std::fabs(weight_of(dressed, v, 1) - weight_of(alone, v, 1)));
    EXPECT_LT(most, 0.02) << what;
  };
  double bent = 1;
  for (Index v = 0; at(v) < arm.vertex_count(); ++v)
    bent = std::min(bent, std::max(weight_of(alone, v, 1), weight_of(alone, v, 2)));
  EXPECT_LT(bent, 0.7) << "the arm bends";
  expect_same(weights_of(with({button}), 1, true), "button");
  expect_same(weights_of(with({button}), 1, false), "button, no parents");
  expect_same(weights_of(with({cuff}), 1, true), "cuff");
  expect_same(weights_of(with({sleeve}), 1, true), "sleeve");
  expect_same(weights_of(with({button, other}), 2, true), "two arms and a button");
}

// Around x, with a tube of this radius.
PlainMesh ring_around_bones(double radius) {
  PlainMesh ring;
  constexpr std::uint32_t along = 16, across = 10;
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t k = 0; k < across; ++k) {
      const double u = 8 * std::atan(1.0) * i / along, v = 8 * std::atan(1.0) * k / across;
      const double r = 1 + radius * std::cos(v);
      ring.positions.insert(ring.positions.end(), {radius * std::sin(v), r * std::cos(u), r * std::sin(u)});
      const std::uint32_t next = (i + 1) % along * across, own = i * across, beside = (k + 1) % across;
      ring.triangles.insert(ring.triangles.end(),
                            {own + k, own + beside, next + beside, own + k, next + beside, next + k});
    }
  }
  return ring;
}

// Five bones lie in the hole of a ring. A thick ring holds one of them, a thin one none. A button beside it makes no
// robot of it. Eight weights, so that none of five is dropped.
TEST(RigidPieces, AButtonChangesNothingOfARingAroundItsBones) {
  for (const double radius : {0.4, 0.2}) {
    const PlainMesh ring = ring_around_bones(radius);
    PlainMesh dressed = ring;
    append(dressed, part(-0.02, 0.02, 0.02, 1.6), 0);
    const auto weights_of = [](const PlainMesh& mesh) {
      const auto skin = skin_of(mesh);
      Bones bones = chain(*skin->core->memory, 5, 0.8);
      for (Vec3& head : bones.head) head.x -= 0.4;
      for (Vec3& tail : bones.tail) tail.x -= 0.4;
      return Weights(skin, 8, bones);
    };
    const Weights alone = weights_of(ring), both = weights_of(dressed);
    double most = 0, bent = 1;
    for (Index v = 0; at(v) < ring.vertex_count(); ++v) {
      bent = std::min(bent, static_cast<double>(alone.state().weights[8 * at(v)]));
      for (std::uint32_t b = 0; b < 5; ++b)
        most = std::max(most, std::fabs(weight_of(alone, v, b) - weight_of(both, v, b)));
    }
    EXPECT_LT(most, 1e-5) << radius;
    EXPECT_LT(bent, 0.8) << "it bends";
  }
}

// Neither half of the tube is solid, and none holds a bone.
TEST(RigidPieces, HalfShellsStaySmooth) {
  PlainMesh mesh;
  constexpr std::uint32_t across = 7, along = 41;
  for (const double side : {1.0, -1.0}) {
    const std::uint32_t first = mesh.vertex_count();
    for (std::uint32_t i = 0; i < along; ++i) {
      for (std::uint32_t k = 0; k < across; ++k) {
        const double a = 4 * std::atan(1.0) * k / (across - 1);
        mesh.positions.insert(mesh.positions.end(), {0.25 * i, std::cos(a), side * (std::sin(a) + 0.01)});
      }
    }
    for (std::uint32_t i = 0; i + 1 < along; ++i) {
      for (std::uint32_t k = 0; k + 1 < across; ++k) {
        std::uint32_t a = first + i * across + k, b = a + 1, c = a + across, d = c + 1;
        if (side < 0) std::swap(b, c);
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
      }
    }
  }
  const auto skin = skin_of(mesh);
  const Weights weights(skin, 4, chain(*skin->core->memory, 2, 10));
  expect_valid(weights);
  for (const Index v : {20 * 7 + 3, 41 * 7 + 20 * 7 + 3}) EXPECT_NEAR(weight_of(weights, v, 0), 0.5, 0.1);
}

// The samples of a marked part find the part below, and each contact is listed at both.
TEST(RigidPieces, ContactsNameBothParts) {
  const Robot robot({part(0, 4.4, 1), part(1.5, 2.5, 0.3, 1.33), part(5.6, 9, 1)});
  hf_inner::Memory& memory = *robot.skin->core->memory;
  hf_inner::Vector<std::uint8_t> marked(3, 0, &memory);
  marked[1] = 1;
  const hf_inner::weights::PieceContacts contacts(*robot.skin->core, marked, memory);
  ASSERT_GT(contacts.all.size(), 0u);
  EXPECT_EQ(contacts.from(1).size(), contacts.all.size());
  EXPECT_EQ(contacts.to(0).size(), contacts.all.size());
  EXPECT_EQ(contacts.to(2).size(), 0u);
  for (const hf_inner::weights::PieceContact& contact : contacts.all) {
    EXPECT_LT(contact.vertex, robot.first[1]);
    EXPECT_GT(contact.strength, 0);
  }
}

}  // namespace
