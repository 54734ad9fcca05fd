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
using hf_inner::Retarget;
using hf_inner::Turn;

constexpr double degree = 3.14159265358979323846 / 180;

// A box with a head, two arms and two legs. The arms hang by so many degrees; reach: how far the legs
// reach forward and back. spread: of legs of two bones without feet; 0 and below: legs are one bone.
struct Blocks {
  Rig rig;
  std::unique_ptr<PlacedRig> placed;
  hf_inner::CharacterInput input;
  Memory memory;
  std::unique_ptr<hf_inner::Character> character;

  enum class More { none, elbows, heels };  // heels: helpers at the ends of the shins
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
        if (more == More::heels) rig.add_helper(std::string("heel") + end, shin, {side * 0.15, 0, 0});
        rig.turn(leg, {0, 0, 1}, side * spread);
      } else {
        rig.add_block(leg, {side * 0.15 - 0.08, 0, -reach}, {side * 0.15 + 0.08, 0.4, reach});
        rig.turn(leg, {0, 0, 1}, -side * spread);
      }
      rig.turn(arm, {0, 0, 1}, -side * hang);
    }
    placed = std::make_unique<PlacedRig>(rig, Placing{});
    input = placed->input();
    character = std::make_unique<hf_inner::Character>(know_character(input, memory));
  }
  hf_inner::RetargetSide side() const { return {input, *character, nullptr}; }

  // Each vertex in a pose; the bodies are placed with turns of joints only at the pose.
  std::vector<Vec3> posed(const std::vector<double>& pose) const {
    const auto rest = world_of(placed->parents, rest_trs(input).data()), world = world_of(placed->parents, pose.data());
    const auto linear = [](const std::vector<double>& w, std::size_t j) {
      const double* p = &w[12 * j];
      return hf_inner::Linear{{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}};
    };
    const auto place = [](const std::vector<double>& w, std::size_t j) {
      return Vec3{w[12 * j + 9], w[12 * j + 10], w[12 * j + 11]};
    };
    std::vector<Vec3> out;
    for (std::size_t v = 0; v < rig.points.size(); ++v) {
      const auto j = static_cast<std::size_t>(rig.owners[v]);
      out.push_back(linear(world, j) * hf_inner::solve(linear(rest, j), rig.points[v] - place(rest, j)) +
                    place(world, j));
    }
    return out;
  }
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
  hf_inner::RetargetOptions options;
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
  hf_inner::RetargetOptions options;
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
  hf_inner::RetargetOptions options;
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
void turn_joint(const Blocks& body, const std::string& name, Turn turn, std::vector<double>& pose) {
  const auto j = static_cast<std::size_t>(body.rig.find(name));
  const auto world = world_of(body.placed->parents, pose.data());
  const auto turn_at = [&](std::size_t k) {
    const double* p = &world[12 * k];
    return hf_inner::turn_of({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}});
  };
  const Turn q = inverse(turn_at(static_cast<std::size_t>(body.placed->parents[j]))) * (turn * turn_at(j));
  const double numbers[] = {q.x, q.y, q.z, q.w};
  std::copy(numbers, numbers + 4, &pose[10 * j + 3]);
}

// A shin that is lifted behind does not kick a leg of one bone up: the leg points where the shin ends.
TEST(Blocks, ALegOfOneBonePointsToTheEndOfTheLegItFollows) {
  const Blocks source(0, 0.1, 1e-9), target(0);
  Memory memory;
  hf_inner::RetargetOptions options;
  options.goals = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  turn_joint(source, "leg.l", hf_inner::turn_about({1, 0, 0}, -40 * degree), pose);
  turn_joint(source, "shin.l", hf_inner::turn_about({1, 0, 0}, 100 * degree), pose);
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
  hf_inner::RetargetOptions options;
  options.goals = false;
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  turn_joint(source, "arm.l", hf_inner::turn_about({0, 1, 0}, 40 * degree), pose);
  turn_joint(source, "fore.l", hf_inner::turn_about({0, 1, 0}, -100 * degree), pose);
  retarget.frame(pose.data(), 0, out.data());
  const auto world = world_of(source.placed->parents, pose.data());
  const double* arm = &world[12 * static_cast<std::size_t>(source.rig.find("arm.l")) + 9];
  const double* fore = &world[12 * static_cast<std::size_t>(source.rig.find("fore.l")) + 9];
  const Vec3 upper{fore[0] - arm[0], fore[1] - arm[1], fore[2] - arm[2]};
  const Vec3 wanted = upper + 2.0 * source.bone("fore.l", pose), is = target.bone("arm.l", out);
  EXPECT_LT(std::atan2(norm(cross(is, wanted)), dot(is, wanted)) / degree, 1);
}

// A shin without a foot stands: its end stays where it is while the body passes over it, at any scale of the travel.
class Standing : public testing::TestWithParam<Blocks::More> {};
TEST_P(Standing, ALegWithoutAFootStaysWhereItStands) {
  const Blocks body(0, 0.02, 1e-9, GetParam());
  Memory memory;
  hf_inner::RetargetOptions options;
  options.scale = 0.5;
  const auto slide = [&](bool goals) {
    options.goals = goals;
    Retarget retarget(body.side(), body.side(), options, memory);
    std::vector<double> out(10 * body.placed->parents.size());
    double least = 1e300, most = -1e300;
    for (int f = 0; f <= 8; ++f) {
      std::vector<double> pose = rest_trs(body.input);
      const double angle = (f - 4) * 5 * degree;
      turn_joint(body, "leg.l", hf_inner::turn_about({1, 0, 0}, angle), pose);
      pose[1] += 0.4 * (std::cos(angle) - 1);
      pose[2] += 0.4 * std::sin(angle);
      retarget.frame(pose.data(), f == 0 ? 0 : 0.1, out.data());
      const std::vector<Vec3> points = body.posed(out);
      double end = 0;
      for (std::size_t v = 0; v < points.size(); ++v) {
        if (body.rig.owners[v] == body.rig.find("shin.l") && body.rig.points[v].y < 0.1) end += points[v].z / 4;
      }
      least = std::min(least, end);
      most = std::max(most, end);
    }
    return most - least;
  };
  EXPECT_GT(slide(false), 0.1);
  EXPECT_LT(slide(true), 0.1);  // its offset stays below a share of the leg
}

INSTANTIATE_TEST_SUITE_P(Blocks, Standing, testing::Values(Blocks::More::none, Blocks::More::heels));

TEST(Blocks, LegsOfOneBoneLiftTheBodyOverTheGround) {
  const Blocks source(0), target(70, 0.4);
  Memory memory;
  hf_inner::RetargetOptions options;
  options.copy_same = false;  // the joints are equal
  Retarget retarget(source.side(), target.side(), options, memory);
  std::vector<double> pose = rest_trs(source.input), out(10 * target.placed->parents.size());
  for (const auto& [leg, angle] : {std::pair<const char*, double>("leg.l", 40), {"leg.r", -40}}) {
    const auto world = world_of(source.placed->parents, pose.data());
    const auto turn_at = [&](std::size_t j) {
      const double* p = &world[12 * j];
      return hf_inner::turn_of({{p[0], p[1], p[2]}, {p[3], p[4], p[5]}, {p[6], p[7], p[8]}});
    };
    const Turn own = turn_at(static_cast<std::size_t>(source.rig.find(leg)));
    const Turn turn = inverse(turn_at(0)) * (hf_inner::turn_about({1, 0, 0}, angle * degree) * own);
    const double numbers[] = {turn.x, turn.y, turn.z, turn.w};
    std::copy(numbers, numbers + 4, &pose[10 * static_cast<std::size_t>(source.rig.find(leg)) + 3]);
  }
  pose[1] += 0.05;  // the source stays over the ground
  const auto lowest = [](const std::vector<Vec3>& points) {
    double low = 1e300;
    for (const Vec3& p : points) low = std::min(low, p.y);
    return low;
  };
  ASSERT_GE(lowest(source.posed(pose)), 0);
  retarget.frame(pose.data(), 0, out.data());
  EXPECT_GT(lowest(target.posed(out)), -1e-6);
  options.goals = false;
  Retarget without(source.side(), target.side(), options, memory);
  without.frame(pose.data(), 0, out.data());
  EXPECT_LT(lowest(target.posed(out)), -0.01);
}

}  // namespace
}  // namespace hf_test
