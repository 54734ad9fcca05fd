// Bodies of blocks: arms and legs of one bone, whose ends only their vertices tell.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "../skeleton/rig_family.h"
#include "base/memory.h"
#include "poses.h"
#include "retarget/retarget.h"
#include "retarget/turns.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::retarget::Retarget;
using hf_inner::retarget::Turn;

constexpr double degree = 3.14159265358979323846 / 180;

// Each vertex in a pose; the bodies are placed with turns of joints only at the pose.
std::vector<Vec3> posed_points(const Rig& rig, const PlacedRig& placed, const hf_inner::skeleton::CharacterInput& input,
                               const std::vector<double>& pose) {
  const auto rest = world_of(placed.parents, rest_trs(input).data()), world = world_of(placed.parents, pose.data());
  const auto linear = [](const std::vector<double>& w, std::size_t j) {
    const double* p = &w[12 * j];
    return hf_inner::retarget::Linear{{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}};
  };
  const auto place = [](const std::vector<double>& w, std::size_t j) {
    return Vec3{w[12 * j + 9], w[12 * j + 10], w[12 * j + 11]};
  };
  std::vector<Vec3> out;
  for (std::size_t v = 0; v < rig.points.size(); ++v) {
    const auto j = static_cast<std::size_t>(rig.owners[v]);
    out.push_back(linear(world, j) * hf_inner::retarget::solve(linear(rest, j), rig.points[v] - place(rest, j)) +
                  place(world, j));
  }
  return out;
}

double lowest_of(const std::vector<Vec3>& points) {
  double low = 1e300;
  for (const Vec3& p : points) low = std::min(low, p.y);
  return low;
}

// A box with a head, two arms and two legs. The arms hang by so many degrees; reach: how far the legs
// reach forward and back. spread: of legs of two bones without feet; 0 and below: legs are one bone.
struct Blocks {
  Rig rig;
  std::unique_ptr<PlacedRig> placed;
  hf_inner::skeleton::CharacterInput input;
  Memory memory;
  std::unique_ptr<hf_inner::skeleton::Character> character;

  enum class More { none, elbows };
  explicit Blocks(double hang, double reach = 0.1, double spread = 0, More more = More::none) {
    const int body = rig.add("body", -1, {0, 0.4, 0}, Role::spine);
    rig.add_block(body, {-0.3, 0.4, -0.2}, {0.3, 1, 0.2});
    const int head = rig.add("head", body, {0, 1, 0}, Role::head);
    rig.add_block(head, {-0.2, 1, -0.2}, {0.2, 1.4, 0.3});
    for (const double side : {1.0, -1.0}) {
      const Side s = side > 0 ? Side::left : Side::right;
      const char* end = side > 0 ? ".l" : ".r";
      const int arm = rig.add(std::string("arm") + end, body, {side * 0.3, 0.9, 0}, Role::arm, s);
      rig.add_box(arm, {side * 0.3, 0.9, 0}, {side * (more == More::elbows ? 0.55 : 0.8), 0.9, 0}, 0.06);
      if (more == More::elbows) {
        const int fore = rig.add(std::string("fore") + end, arm, {side * 0.55, 0.9, 0}, Role::arm, s);
        rig.add_box(fore, {side * 0.55, 0.9, 0}, {side * 0.8, 0.9, 0}, 0.06);
      }
      const int leg = rig.add(std::string("leg") + end, body, {side * 0.15, 0.4, 0}, Role::leg, s);
      if (spread > 0) {  // two bones
        rig.add_block(leg, {side * 0.15 - 0.08, 0.2, -reach}, {side * 0.15 + 0.08, 0.4, reach});
        const int shin = rig.add(std::string("shin") + end, leg, {side * 0.15, 0.2, 0}, Role::leg, s);
        rig.add_block(shin, {side * 0.15 - 0.08, 0, -reach}, {side * 0.15 + 0.08, 0.2, reach});
        rig.turn(leg, {0, 0, 1}, side * spread);
      } else {
        rig.add_block(leg, {side * 0.15 - 0.08, 0, -reach}, {side * 0.15 + 0.08, 0.4, reach});
        rig.turn(leg, {0, 0, 1}, -side * spread);
      }
      rig.turn(arm, {0, 0, 1}, -side * hang);
    }
    placed = std::make_unique<PlacedRig>(rig, Placing{});
    input = placed->input();
    character = std::make_unique<hf_inner::skeleton::Character>(know_character(input, memory));
  }
  hf_inner::retarget::RetargetSide side() const { return {input, *character, nullptr}; }

  std::vector<Vec3> posed(const std::vector<double>& pose) const { return posed_points(rig, *placed, input, pose); }
  // From the joint to the middle of its vertices.
  Vec3 bone(const std::string& name, const std::vector<double>& pose) const {
    const int j = rig.find(name);
    const std::vector<Vec3> points = posed(pose);
    Vec3 sum;
    double count = 0;
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (rig.owners[v] != j) continue;
      sum = sum + points[v];
      count += 1;
    }
    const auto world = world_of(placed->parents, pose.data());
    const double* p = &world[12 * static_cast<std::size_t>(j) + 9];
    return (1 / count) * sum - Vec3{p[0], p[1], p[2]};
  }
};

TEST(Blocks, ArmsOfOneBoneMeetByTheirVertices) {
  const Blocks source(0), target(70);
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.copy_same = false;  // the joints are equal, the vertices are not
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  retarget.frame(pose.data(), 0, out.data());
  for (const char* arm : {"arm.l", "arm.r"}) {
    const Vec3 a = source.bone(arm, pose), b = target.bone(arm, out);
    EXPECT_LT(std::atan2(norm(cross(a, b)), dot(a, b)) / degree, 0.5) << arm;
  }
}

TEST(Blocks, LegsWithoutFeetMeetByTheirVertices) {
  const Blocks source(0, 0.1, 1), target(0, 0.1, 15);
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.copy_same = false;  // the joints are nearly equal
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  retarget.frame(pose.data(), 0, out.data());
  for (const char* bone : {"leg.l", "leg.r", "shin.l", "shin.r"}) {
    const Vec3 a = source.bone(bone, pose), b = target.bone(bone, out);
    EXPECT_LT(std::atan2(norm(cross(a, b)), dot(a, b)) / degree, 0.5) << bone;
  }
}

TEST(Blocks, LegsOfOneBoneMeetByTheirVertices) {
  const Blocks source(0), target(0, 0.1, -15);
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.copy_same = false;  // the joints are equal
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  retarget.frame(pose.data(), 0, out.data());
  for (const char* leg : {"leg.l", "leg.r"}) {
    const Vec3 a = source.bone(leg, pose), b = target.bone(leg, out);
    EXPECT_LT(std::atan2(norm(cross(a, b)), dot(a, b)) / degree, 0.5) << leg;
  }
}

// Turns a joint of a pose in the space of the model, from where it is.
template <class Body>
void turn_joint(const Body& body, const std::string& name, Turn turn, std::vector<double>& pose) {
  const auto j = static_cast<std::size_t>(body.rig.find(name));
  const auto world = world_of(body.placed->parents, pose.data());
  const auto turn_at = [&](std::size_t k) {
    const double* p = &world[12 * k];
    return hf_inner::retarget::turn_of({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}});
  };
  const Turn q = inverse(turn_at(static_cast<std::size_t>(body.placed->parents[j]))) * (turn * turn_at(j));
  const double numbers[] = {q.x, q.y, q.z, q.w};
  std::copy(numbers, numbers + 4, &pose[10 * j + 3]);
}

// A shin that is lifted behind does not kick a leg of one bone up: the leg points where the shin ends.
TEST(Blocks, ALegOfOneBonePointsToTheEndOfTheLegItFollows) {
  const Blocks source(0, 0.1, 1e-9), target(0);
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.goals = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  turn_joint(source, "leg.l", hf_inner::retarget::turn_about({1, 0, 0}, -40 * degree), pose);
  turn_joint(source, "shin.l", hf_inner::retarget::turn_about({1, 0, 0}, 100 * degree), pose);
  retarget.frame(pose.data(), 0, out.data());
  const auto world = world_of(source.placed->parents, pose.data());
  const double* leg = &world[12 * static_cast<std::size_t>(source.rig.find("leg.l")) + 9];
  const double* shin = &world[12 * static_cast<std::size_t>(source.rig.find("shin.l")) + 9];
  const Vec3 thigh{shin[0] - leg[0], shin[1] - leg[1], shin[2] - leg[2]};
  const Vec3 wanted = thigh + 2.0 * source.bone("shin.l", pose), is = target.bone("leg.l", out);
  EXPECT_LT(std::atan2(norm(cross(is, wanted)), dot(is, wanted)) / degree, 1);
  EXPECT_TRUE(retarget.report().unmatched_source.empty());  // the shin is followed, too
}

TEST(Blocks, AnArmOfOneBonePointsToTheEndOfTheArmItFollows) {
  const Blocks source(0, 0.1, 0, Blocks::More::elbows), target(0);
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.goals = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  turn_joint(source, "arm.l", hf_inner::retarget::turn_about({0, 1, 0}, 40 * degree), pose);
  turn_joint(source, "fore.l", hf_inner::retarget::turn_about({0, 1, 0}, -100 * degree), pose);
  retarget.frame(pose.data(), 0, out.data());
  const auto world = world_of(source.placed->parents, pose.data());
  const double* arm = &world[12 * static_cast<std::size_t>(source.rig.find("arm.l")) + 9];
  const double* fore = &world[12 * static_cast<std::size_t>(source.rig.find("fore.l")) + 9];
  const Vec3 upper{fore[0] - arm[0], fore[1] - arm[1], fore[2] - arm[2]};
  const Vec3 wanted = upper + 2.0 * source.bone("fore.l", pose), is = target.bone("arm.l", out);
  EXPECT_LT(std::atan2(norm(cross(is, wanted)), dot(is, wanted)) / degree, 1);
}

// The body of the family; with_feet: else shins own the skin of the feet.
struct Walker {
  Rig rig;
  std::unique_ptr<PlacedRig> placed;
  hf_inner::skeleton::CharacterInput input;
  Memory memory;
  std::unique_ptr<hf_inner::skeleton::Character> character;

  Walker(bool with_feet, const BodyShape& shape) {
    const Rig whole = make_biped("words", shape);
    std::vector<int> number;  // of the joint that stands for each
    for (const RigJoint& joint : whole.joints) {
      const int parent = joint.parent < 0 ? -1 : number[static_cast<std::size_t>(joint.parent)];
      if (joint.role == Role::foot && !with_feet) {
        number.push_back(parent);
        continue;
      }
      number.push_back(static_cast<int>(rig.joints.size()));
      rig.joints.push_back(joint);
      rig.joints.back().parent = parent;
    }
    rig.points = whole.points;
    rig.triangles = whole.triangles;
    for (const int owner : whole.owners) rig.owners.push_back(number[static_cast<std::size_t>(owner)]);
    place();
  }
  // A joint between the shin and the foot, with a vertex of its own.
  void add_heel(const std::string& foot) {
    const auto j = static_cast<std::size_t>(rig.find(foot));
    const int heel = rig.add(foot.substr(0, foot.find('_')) + "_foot heel", rig.joints[j].parent,
                             rig.joints[j].pivot + Vec3{0, 0, 1e-9}, Role::leg, rig.joints[j].side);
    rig.joints[j].parent = heel;
    rig.add_block(heel, rig.joints[j].pivot - Vec3{0.02, 0.02, 0.02}, rig.joints[j].pivot + Vec3{0.02, 0.02, 0.02});
    rig.joints[static_cast<std::size_t>(heel)].name =
        (rig.joints[j].side == Side::left ? "left" : "right") + std::string("_leg heel");
  }
  void place() {
    placed = std::make_unique<PlacedRig>(rig, Placing{});
    input = placed->input();
    character = std::make_unique<hf_inner::skeleton::Character>(know_character(input, memory));
  }
  hf_inner::retarget::RetargetSide side() const { return {input, *character, nullptr}; }
  Turn turn_of(const std::string& name, const std::vector<double>& pose) const {
    const auto world = world_of(placed->parents, pose.data());
    const double* p = &world[12 * static_cast<std::size_t>(rig.find(name))];
    return hf_inner::retarget::turn_of({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}});
  }
};

// Both stand on flat soles, whichever of them has feet.
TEST(Walkers, AShinWithoutAFootStandsLikeOneWithAFoot) {
  for (const bool from : {true, false}) {
    const Walker source(from, {}), target(!from, {});
    Memory memory;
    Retarget retarget(source.side(), target.side(), {}, memory);
    const std::vector<double> rest = rest_trs(target.input);
    std::vector<double> out(rest.size());
    retarget.frame(rest_trs(source.input).data(), 0, out.data());
    for (const char* bone : {"left_leg", "left_knee", "right_leg", "right_knee"}) {
      const Turn since = target.turn_of(bone, out) * inverse(target.turn_of(bone, rest));
      const double angle = 2 * std::acos(std::min(1.0, std::fabs(since.w))) / degree;
      EXPECT_LT(angle, 4) << bone << (from ? " of the one without" : " of the one with");
    }
  }
}

// A boot tilts with its shin. The leg still points as that of the source does, and boots that dip lift the body.
TEST(Walkers, ALegWithoutAFootTurnsAsTheSourceAndLiftsTheBody) {
  const Walker source(true, {}), target(false, {0.8, 1, 1, 3, Rest::t});
  Memory memory;
  Retarget retarget(source.side(), target.side(), {}, memory);
  std::vector<double> out(10 * target.placed->parents.size());
  for (int f = 0; f <= 8; ++f) {
    const double angle = (f - 4) * 5 * degree;
    std::vector<double> pose = rest_trs(source.input);
    turn_joint(source, "left_leg", hf_inner::retarget::turn_about({1, 0, 0}, angle), pose);
    turn_joint(source, "right_leg", hf_inner::retarget::turn_about({1, 0, 0}, -angle), pose);
    pose[1] -= lowest_of(posed_points(source.rig, *source.placed, source.input, pose));
    retarget.frame(pose.data(), f == 0 ? 0 : 0.1, out.data());
    EXPECT_GT(lowest_of(posed_points(target.rig, *target.placed, target.input, out)), -1e-6) << f;
  }
  for (const auto& chain : retarget.report().chains) {
    if (chain.role == Role::leg) {
      EXPECT_LT(chain.worst_degrees, 0.01);
    }
  }
}

// A joint in the place of the ankle carries the foot, a hair away: controls of heels stand so. It is no bone of the
// leg, and it turns as the foot does.
TEST(Walkers, AControlInThePlaceOfTheAnkleIsNoBoneOfTheLeg) {
  Walker source(true, {}), target(true, {});
  for (const char* side : {"left", "right"}) source.add_heel(std::string(side) + "_foot");
  source.place();
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.goals = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  turn_joint(source, "left_leg", hf_inner::retarget::turn_about({1, 0, 0}, -40 * degree), pose);
  turn_joint(source, "left_knee", hf_inner::retarget::turn_about({1, 0, 0}, 70 * degree), pose);
  turn_joint(source, "left_leg heel", hf_inner::retarget::turn_about({1, 0, 0}, -60 * degree), pose);
  retarget.frame(pose.data(), 0, out.data());
  for (const auto& chain : retarget.report().chains) {
    if (chain.role == Role::leg) {
      EXPECT_LT(chain.worst_degrees, 0.01);
    }
  }
}

TEST(Blocks, LegsOfOneBoneLiftTheBodyOverTheGround) {
  const Blocks source(0), target(70, 0.4);
  Memory memory;
  hf_inner::retarget::RetargetOptions options;
  options.copy_same = false;  // the joints are equal
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  for (const auto& [leg, angle] : {std::pair<const char*, double>("leg.l", 40), {"leg.r", -40}}) {
    const auto world = world_of(source.placed->parents, pose.data());
    const auto turn_at = [&](std::size_t j) {
      const double* p = &world[12 * j];
      return hf_inner::retarget::turn_of({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}});
    };
    const Turn own = turn_at(static_cast<std::size_t>(source.rig.find(leg)));
    const Turn turn = inverse(turn_at(0)) * (hf_inner::retarget::turn_about({1, 0, 0}, angle * degree) * own);
    const double numbers[] = {turn.x, turn.y, turn.z, turn.w};
    std::copy(numbers, numbers + 4, &pose[10 * static_cast<std::size_t>(source.rig.find(leg)) + 3]);
  }
  pose[1] += 0.05;  // the source stays over the ground
  ASSERT_GE(lowest_of(source.posed(pose)), 0);
  retarget.frame(pose.data(), 0, out.data());
  EXPECT_GT(lowest_of(target.posed(out)), -1e-6);
  options.goals = false;
  Retarget without(source.side(), target.side(), options, memory);
  without.frame(pose.data(), 0, out.data());
  EXPECT_LT(lowest_of(target.posed(out)), -0.01);
}

}  // namespace
}  // namespace hf_test
