// Links of robots whose truth is known: pieces of one joint, and of parent and child, belong together; others only
// touch.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "base/error.h"
#include "mesh/joint_tree.h"
#include "mesh/link_constants.h"
#include "mesh/links.h"
#include "support/meshes.h"
#include "support/parts.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;
using hf_test::PlainMesh;

// Boxes with a joint each. Feet, thighs, and hands and thighs touch, as in many rest poses. Helper joints without
// vertices lie between some parents and children.
struct Robot {
  Robot() = default;
  explicit Robot(std::uint32_t seed) : random(seed) {
    const double near = uniform(0.001, 0.006), knee = uniform(0.013, 0.03), touch = 0.002;
    const int pelvis = add(-1, {-0.2, 0.9, 0}, {0.2, 1.1, 0.25});
    const int torso = add(pelvis, {-0.25, 1.1 + near, 0}, {0.25, 1.6, 0.25});
    add(torso, {-0.1, 1.6 + near, 0.05}, {0.1, 1.85, 0.2});
    int feet[2], thighs[2], hands[2];
    for (int side = 0; side < 2; ++side) {
      mirrored = side == 1;
      const int upper = add(torso, {0.25 + near, 1.25, 0}, {0.4, 1.6, 0.2});
      const int lower = add(upper, {0.26, 0.95, 0}, {0.4, 1.25 - knee, 0.2});
      hands[side] = add(lower, {0.24 + touch, 0.75, 0}, {0.4, 0.95 - near, 0.2});
      thighs[side] = add(pelvis, {touch / 2, 0.5, 0}, {0.24, 0.9 - near, 0.22});
      const int shin = add(thighs[side], {0.03, 0.13, 0.02}, {0.2, 0.5 - knee, 0.2});
      feet[side] = add(shin, {touch / 2, 0, 0}, {0.2, 0.13 - near, 0.35});
      append_box({0.03, 0.13, 0.2 + near}, {0.2, 0.4, 0.24}, shin);  // a plate; it touches the foot too
      plate_touches.push_back({parts - 1, feet[side]});
    }
    strangers = {{feet[0], feet[1]}, {thighs[0], thighs[1]}, {hands[0], thighs[0]}, {hands[1], thighs[1]}};
    vertex_weight.assign(mesh.vertex_count(), 1.0f);
  }
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }
  // Returns the part.
  int add(int part, std::array<double, 3> low, std::array<double, 3> high) {
    std::uint32_t above = part < 0 ? HF_NO_INDEX : joint_of[part];
    for (std::uint32_t helpers = random() % 3; helpers > 0; --helpers) {
      parents.push_back(above);
      above = static_cast<std::uint32_t>(parents.size()) - 1;
    }
    parents.push_back(above);
    kin.insert({part, parts});
    return append_box(low, high, -1);
  }
  int append_box(std::array<double, 3> low, std::array<double, 3> high, int like) {
    if (mirrored) {
      std::swap(low[0], high[0]);
      low[0] = -low[0];
      high[0] = -high[0];
    }
    const PlainMesh part = hf_test::box(4, {high[0] - low[0], high[1] - low[1], high[2] - low[2]}, low);
    hf_test::append(mesh, part, 0);
    const auto joint = like < 0 ? static_cast<std::uint32_t>(parents.size()) - 1 : joint_of[like];
    joint_of.push_back(joint);
    vertex_joint.insert(vertex_joint.end(), part.vertex_count(), static_cast<std::uint16_t>(joint));
    part_of.insert(part_of.end(), part.vertex_count(), parts);
    return parts++;
  }
  // The robot stands on its head and its last vertex comes first, so that children stand before parents.
  void turn_round() {
    const std::size_t n = part_of.size();
    std::vector<double> positions;
    for (std::size_t v = n; v-- > 0;) {
      const double* p = &mesh.positions[3 * v];
      positions.insert(positions.end(), {-p[0], -p[1], p[2]});
    }
    mesh.positions = positions;
    for (auto& corner : mesh.triangles) corner = static_cast<std::uint32_t>(n) - 1 - corner;
    std::reverse(vertex_joint.begin(), vertex_joint.end());
    std::reverse(part_of.begin(), part_of.end());
  }
  // The links of the parts, as pairs of parts.
  using Pairs = std::set<std::pair<int, int>>;
  std::shared_ptr<const Links> link(bool skeleton) {
    MeshInput input;
    input.vertex_count = mesh.vertex_count();
    input.triangle_count = mesh.triangle_count();
    input.positions = ConstRows(mesh.positions.data(), 3 * sizeof(double));
    input.triangles = IndexRows(mesh.triangles.data(), 3);
    shape = surface::Geometry::make(input, {}, std::make_shared<Memory>(), std::make_shared<JobRunner>(1u));
    LinkOptions options;
    options.mode = LinkMode::pieces;
    options.distance = default_link_distance;
    options.overlay = overlay;
    options.skin = {1, vertex_joint.data(), vertex_weight.data(), {}};
    if (skeleton) options.skin.parents = parents;
    return make_links(shape->mesh, shape->areas, options, *shape->memory, nullptr);
  }
  Pairs pairs_of(const Vector<Link>& links) const {
    Pairs out;
    for (const Link& link : links) {
      for (const Index corner : link.corner) {
        if (corner == Mesh::none) continue;
        const int a = part(link.vertex), b = part(corner);
        out.insert({std::min(a, b), std::max(a, b)});
      }
    }
    return out;
  }
  int part(Index inner) const { return part_of[at(shape->mesh.given_of_inner[at(inner)])]; }
  bool belong(std::pair<int, int> pair) const {
    const auto same = [&](int a, int b) { return joint_of[a] == joint_of[b]; };
    if (same(pair.first, pair.second)) return true;
    for (const auto& [a, b] : kin) {
      if (a >= 0 && ((same(a, pair.first) && same(b, pair.second)) || (same(a, pair.second) && same(b, pair.first))))
        return true;
    }
    return false;
  }

  std::mt19937 random;
  bool mirrored = false;
  double overlay = 0;  // no piece is light
  PlainMesh mesh;
  std::shared_ptr<const surface::Geometry> shape;
  int parts = 0;
  std::vector<std::uint32_t> parents, joint_of;
  std::vector<std::uint16_t> vertex_joint;
  std::vector<float> vertex_weight;
  std::vector<int> part_of;
  std::set<std::pair<int, int>> kin;
  std::vector<std::pair<int, int>> strangers, plate_touches;
};

TEST(RobotLinks, no_link_is_false_and_every_joint_holds) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    Robot robot(seed);
    const auto links = robot.link(true);
    const Robot::Pairs pairs = robot.pairs_of(links->links);
    for (const auto& pair : pairs)
      EXPECT_TRUE(robot.belong(pair)) << "seed " << seed << ": parts " << pair.first << " and " << pair.second;
    for (const auto& pair : robot.kin) {
      if (pair.first >= 0) {
        EXPECT_EQ(pairs.count(pair), 1u) << "seed " << seed << ": parts " << pair.first << " and " << pair.second;
      }
    }
    EXPECT_EQ(links->group_count, 1);
  }
}

TEST(RobotLinks, every_contact_of_parent_and_child_is_linked_and_not_that_of_the_tree_alone) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Robot robot(seed);
    for (const bool round : {false, true}) {
      if (round) robot.turn_round();
      const Robot::Pairs pairs = robot.pairs_of(robot.link(true)->links);
      for (const auto& [plate, foot] : robot.plate_touches)
        EXPECT_EQ(pairs.count({std::min(plate, foot), std::max(plate, foot)}), 1u) << "seed " << seed << " " << round;
    }
  }
}

// The tree has cheaper links, and looks at no contact of the plate with the foot.
TEST(RobotLinks, parent_and_child_that_the_tree_does_not_need_are_linked) {
  for (const bool round : {false, true}) {
    Robot robot;
    const int shin = robot.add(-1, {0, 0.13, 0}, {0.2, 1.85, 0.2}),
              foot = robot.add(shin, {0, 0, 0}, {0.2, 0.129, 0.35}),
              plate = robot.append_box({0, 0.133, 0.201}, {0.2, 0.6, 0.24}, shin);
    robot.vertex_weight.assign(robot.part_of.size(), 1.0f);
    if (round) robot.turn_round();
    EXPECT_EQ(robot.pairs_of(robot.link(true)->links).count({foot, plate}), 1u) << round;
  }
}

// One point would draw a chest out to a spike where its head is pulled.
TEST(RobotLinks, a_joint_holds_all_around_its_contact) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Robot robot(seed);
    const auto extent = [&](bool skeleton, std::size_t& count) {
      const auto links = robot.link(skeleton);
      double low = 1e300, high = -1e300;
      for (const Link& link : links->links) {
        const std::set<int> ends = {robot.part(link.vertex),
                                    robot.part(*std::max_element(link.corner, link.corner + 3))};
        if (ends != std::set<int>{0, 1}) continue;  // pelvis and torso
        const double x = robot.mesh.positions[3 * at(robot.shape->mesh.given_of_inner[at(link.vertex)])];
        low = std::min(low, x);
        high = std::max(high, x);
        ++count;
      }
      return high - low;
    };
    std::size_t known = 0, plain = 0;
    EXPECT_GT(extent(true, known), 0.35) << "seed " << seed;  // the pelvis is 0.4 wide
    EXPECT_GE(known, 8u);
    extent(false, plain);
    EXPECT_LE(plain, 2u) << "a hinge without a skeleton";
  }
}

// A sheet on an arm, longer than the arm. Its end is near a horn of the head.
TEST(RobotLinks, a_light_piece_links_to_no_stranger) {
  Robot robot;
  const int body = robot.add(-1, {0, 0, 0}, {0.4, 1, 0.4}), arm = robot.add(body, {0.402, 0.7, 0}, {1.2, 0.8, 0.1}),
            head = robot.add(body, {0, 1.002, 0}, {1.5, 1.3, 0.4}),
            horn = robot.append_box({1.32, 0.75, 0}, {1.5, 1, 0.4}, head),
            sheet = robot.append_box({0.45, 0.803, 0}, {1.3, 0.813, 0.1}, arm);
  robot.vertex_weight.assign(robot.part_of.size(), 1.0f);
  robot.overlay = default_overlay;
  Robot plain = robot;
  const auto links = robot.link(true);
  const auto first = std::find(robot.part_of.begin(), robot.part_of.end(), sheet) - robot.part_of.begin();
  const Index inner = robot.shape->mesh.inner_of_given[static_cast<std::size_t>(first)];
  ASSERT_EQ(links->light[at(links->piece[at(inner)])], 1);
  const Robot::Pairs pairs = robot.pairs_of(links->links);
  EXPECT_EQ(pairs.count({horn, sheet}), 0u);
  EXPECT_EQ(pairs.count({arm, sheet}), 1u);
  EXPECT_EQ(plain.pairs_of(plain.link(false)->links).count({horn, sheet}), 1u) << "it is near";
}

TEST(RobotLinks, contacts_of_strangers_are_noted_and_have_no_spring) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Robot robot(seed);
    const auto links = robot.link(true);
    const Robot::Pairs open = robot.pairs_of(links->open), linked = robot.pairs_of(links->links);
    for (const auto& [a, b] : robot.strangers) {
      const std::pair<int, int> pair{std::min(a, b), std::max(a, b)};
      EXPECT_EQ(open.count(pair), 1u) << "seed " << seed << ": parts " << a << " and " << b;
      EXPECT_EQ(linked.count(pair), 0u);
    }
    for (const auto& pair : open) EXPECT_EQ(linked.count(pair), 0u);
  }
}

TEST(RobotLinks, an_open_contact_is_measured) {
  Robot robot(5);
  const auto links = robot.link(true);
  const auto [left, right] = robot.strangers[0];
  std::vector<double> posed = robot.mesh.positions;
  for (std::size_t v = 0; v < robot.part_of.size(); ++v) {
    if (robot.part_of[v] == left) posed[3 * v] += 0.125;
  }
  Vector<double> gaps(links->open.size(), 0.0, robot.shape->memory.get());
  measure_gaps(robot.shape->mesh, links->open, ConstRows(posed.data(), 3 * sizeof(double)), gaps);
  double widest = 0;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const int a = robot.part(links->open[i].vertex);
    if (a != left && a != right) {
      EXPECT_LT(gaps[i], 1e-12);
    }
    widest = std::max(widest, gaps[i]);
  }
  EXPECT_NEAR(widest, 0.125, 1e-6);
}

// The skeleton is needed: without it, feet that touch are nearer than a knee.
TEST(RobotLinks, without_a_skeleton_strangers_take_the_place_of_a_knee) {
  Robot robot(3);
  const auto links = robot.link(false);
  bool wrong = false;
  for (const auto& pair : robot.pairs_of(links->links)) wrong = wrong || !robot.belong(pair);
  EXPECT_TRUE(wrong);
  EXPECT_TRUE(links->open.empty());
}

// The skin names a joint for each vertex, but says nothing by a weight of 0.
TEST(RobotLinks, where_all_weights_are_0_a_skeleton_changes_no_link) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    Robot robot(seed);
    std::fill(robot.vertex_weight.begin(), robot.vertex_weight.end(), 0.0f);
    Robot same = robot;
    const auto with = robot.link(true), without = same.link(false);
    ASSERT_EQ(with->links.size(), without->links.size()) << "seed " << seed;
    for (std::size_t i = 0; i < with->links.size(); ++i) {
      const Link &a = with->links[i], &b = without->links[i];
      EXPECT_EQ(a.vertex, b.vertex);
      EXPECT_TRUE(std::equal(a.corner, a.corner + 3, b.corner));
      EXPECT_EQ(a.weight, b.weight);
    }
  }
}

TEST(RobotLinks, a_piece_that_only_strangers_touch_is_linked_to_them) {
  Robot robot(0);
  robot.parents[robot.joint_of[2]] = HF_NO_INDEX;  // the head has a skeleton of its own
  EXPECT_EQ(robot.link(true)->group_count, 1);
}

TEST(JointTree, steps_count_joints_that_own_vertices) {
  Memory memory;
  // 0 - 1 (helper) - 2 - 3, 1 - 4, 5 is a root
  const std::vector<std::uint32_t> parents = {HF_NO_INDEX, 0, 1, 2, 1, HF_NO_INDEX};
  const std::vector<std::uint8_t> owns = {1, 0, 1, 1, 1, 1};
  const JointTree tree(parents, owns, memory);
  EXPECT_EQ(tree.steps(3, 3), 0);
  EXPECT_EQ(tree.steps(0, 2), 1);
  EXPECT_EQ(tree.steps(3, 2), 1);
  EXPECT_EQ(tree.steps(2, 4), 2);
  EXPECT_EQ(tree.steps(3, 4), 3);
  EXPECT_EQ(tree.steps(0, 5), 2);
  EXPECT_EQ(joint_in_circle(parents, memory), HF_NO_INDEX);
  const std::vector<std::uint32_t> circle = {HF_NO_INDEX, 3, 1, 2};
  EXPECT_NE(joint_in_circle(circle, memory), HF_NO_INDEX);
  EXPECT_NE(joint_in_circle(circle, memory), 0u);
}

// Walks up joint by joint.
Index slow_steps(Span<const std::uint32_t> parents, Span<const std::uint8_t> owns, std::uint32_t a, std::uint32_t b) {
  const auto way = [&](std::uint32_t joint) {
    std::vector<std::uint32_t> out;
    for (; joint != HF_NO_INDEX; joint = parents[joint]) out.push_back(joint);
    return out;
  };
  std::vector<std::uint32_t> to_a = way(a), to_b = way(b);
  while (!to_a.empty() && !to_b.empty() && to_a.back() == to_b.back()) {
    const std::uint32_t common = to_a.back();
    to_a.pop_back();
    to_b.pop_back();
    // from the joint itself its own step does not count
    if (owns[common] && (to_a.empty() || to_b.empty())) break;
  }
  Index out = 0;
  for (const auto* part : {&to_a, &to_b}) {
    for (const std::uint32_t joint : *part) out += owns[joint];
  }
  return out;
}

TEST(JointTree, steps_are_those_of_a_walk_in_chains_bushes_and_forests) {
  Memory memory;
  std::mt19937 random(7);
  for (int forest = 0; forest < 60; ++forest) {
    const std::uint32_t count = 1 + random() % 200, reach = forest % 3 == 0 ? 1 : 1 + random() % 20;
    std::vector<std::uint32_t> order(count), parents(count);
    for (std::uint32_t j = 0; j < count; ++j) order[j] = j;
    std::shuffle(order.begin(), order.end(), random);  // parents stand anywhere
    std::vector<std::uint8_t> owns(count);
    for (std::uint32_t j = 0; j < count; ++j) {
      const bool root = j == 0 || random() % 50 == 0;
      parents[order[j]] = root ? HF_NO_INDEX : order[j - 1 - random() % std::min(j, reach)];
      owns[j] = random() % 4 != 0;
    }
    const JointTree tree(parents, owns, memory);
    for (int k = 0; k < 300; ++k) {
      const std::uint32_t a = random() % count, b = random() % count;
      if (owns[a] && owns[b]) {
        ASSERT_EQ(tree.steps(a, b), slow_steps(parents, owns, a, b)) << "forest " << forest;
      }
    }
  }
}

}  // namespace
