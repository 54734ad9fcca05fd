// Names that occur several times: joints, clips, shapes and nodes are told apart by the tree and by their order.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "gltf/animate.h"
#include "gltf/clip_binding.h"
#include "gltf/json_file.h"
#include "gltf/node_match.h"
#include "gltf/regions.h"
#include "gltf/skin_write.h"

namespace hf_gltf {
namespace {

// A body of two sides. order: the node numbers of the joints, which exporters give as they like.
struct JointPlan {
  const char* name;
  const char* own_name;  // when every joint has a name of its own
  int parent;
  glm::vec3 place;
};
const JointPlan plan[] = {{"root", "root", -1, {0, 0, 0}},          {"pelvis", "pelvis", 0, {0, 1, 0}},
                          {"thigh", "thigh_l", 1, {0.2, -0.1, 0}},  {"calf", "calf_l", 2, {0, -0.4, 0}},
                          {"thigh", "thigh_r", 1, {-0.2, -0.1, 0}}, {"calf", "calf_r", 4, {0, -0.4, 0}},
                          {"spine", "spine", 1, {0, 0.4, 0}},       {"arm", "arm_l", 6, {0.3, 0.1, 0}},
                          {"hand", "hand_l", 7, {0.3, 0, 0}},       {"arm", "arm_r", 6, {-0.3, 0.1, 0}},
                          {"hand", "hand_r", 9, {-0.3, 0, 0}},      {"tail", "tail_1", 1, {0, 0, -0.2}},
                          {"tail", "tail_2", 11, {0, 0, -0.2}},     {"tail", "tail_3", 12, {0, 0, -0.2}}};
constexpr size_t joint_count = sizeof plan / sizeof plan[0];

Model skeleton(const std::vector<int>& order, bool own_names, float scale) {
  Model model;
  model.name = "body";
  model.nodes.resize(joint_count);
  for (size_t j = 0; j < joint_count; ++j) {
    Node& node = model.nodes[static_cast<size_t>(order[j])];
    node.name = own_names ? plan[j].own_name : plan[j].name;
    node.translation = scale * plan[j].place;
    node.parent = plan[j].parent < 0 ? -1 : order[static_cast<size_t>(plan[j].parent)];
  }
  for (size_t n = 0; n < joint_count; ++n)
    if (model.nodes[n].parent >= 0)
      model.nodes[static_cast<size_t>(model.nodes[n].parent)].children.push_back(static_cast<int>(n));
  return model;
}

Channel turn_of(int node, std::vector<float> times, std::vector<float> values) {
  Channel out;
  out.node = node;
  out.path = Path::rotation;
  out.width = 4;
  out.times = std::move(times);
  out.values = std::move(values);
  return out;
}

std::vector<int> shuffled(uint32_t seed) {
  std::vector<int> out(joint_count);
  for (size_t j = 0; j < joint_count; ++j) out[j] = static_cast<int>(j);
  std::mt19937 random(seed);
  std::shuffle(out.begin(), out.end(), random);
  return out;
}

// The oracle is the same body with names of its own.
TEST(Names, JointsThatShareANameAreFoundByTheTree) {
  for (uint32_t seed = 0; seed < 30; ++seed) {
    const std::vector<int> a = shuffled(2 * seed), b = shuffled(2 * seed + 1);
    const std::vector<int>& all = a;
    const NodeMatch same = match_nodes(skeleton(a, false, 1), all, skeleton(b, false, 2.5f)),
                    own = match_nodes(skeleton(a, true, 1), all, skeleton(b, true, 2.5f));
    EXPECT_EQ(same.there, own.there) << "seed " << seed;
    for (size_t j = 0; j < joint_count; ++j) EXPECT_EQ(own.there[static_cast<size_t>(a[j])], b[j]);
  }
}

TEST(Names, AClipOfJointsThatShareANameMovesAllOfThem) {
  const std::vector<int> a = shuffled(5), b = shuffled(6);
  Model clips = skeleton(a, false, 1);
  const Model model = skeleton(b, false, 1);
  Animation walk;
  for (size_t j = 0; j < joint_count; ++j) {
    const float angle = 0.1f * static_cast<float>(j + 1);
    walk.channels.push_back(turn_of(a[j], {0}, {std::sin(angle), 0, 0, std::cos(angle)}));
  }
  clips.animations = {walk};
  const BoundClips bound = bind_clips(model, clips, "");
  EXPECT_EQ(bound.joints, joint_count);
  EXPECT_EQ(bound.shared, 11u);  // all but root, pelvis and spine
  EXPECT_TRUE(bound.missing.empty());
  const Pose pose = sample(bound.model, bound.model.animations[0], 0), wanted = sample(clips, walk, 0);
  for (size_t j = 0; j < joint_count; ++j)
    EXPECT_EQ(pose[static_cast<size_t>(b[j])].rotation, wanted[static_cast<size_t>(a[j])].rotation) << plan[j].own_name;
}

// Many of one name, in a chain, in a row and mixed: found in order, and not at the cost of their square.
TEST(Names, TenThousandJointsOfOneNameAreFoundInOrder) {
  for (const int kind : {0, 1, 2}) {
    Model model;
    std::vector<int> all;
    for (int n = 0; n < 10000; ++n) {
      Node node;
      node.name = "x";
      node.parent = n == 0 ? -1 : kind == 0 ? n - 1 : kind == 1 ? 0 : n / 2;
      if (node.parent >= 0) model.nodes[static_cast<size_t>(node.parent)].children.push_back(n);
      model.nodes.push_back(node);
      all.push_back(n);
    }
    EXPECT_EQ(match_nodes(model, all, model).there, all) << kind;
  }
}

// A triangle for each joint.
Model with_triangles(Model model) {
  Primitive primitive;
  Skin skin;
  for (size_t n = 0; n < model.nodes.size(); ++n) {
    skin.joints.push_back(static_cast<int>(n));
    skin.inverse_bind.emplace_back(1);
    for (uint32_t k = 0; k < 3; ++k) {
      primitive.indices.push_back(static_cast<uint32_t>(primitive.positions.size()));
      primitive.positions.emplace_back(n, k == 1, k == 2);
      Influences influences;
      influences.joints[0] = static_cast<uint16_t>(n);
      influences.weights[0] = 1;
      primitive.influences.push_back(influences);
    }
  }
  Node body;
  body.mesh = 0;
  body.skin = 0;
  model.nodes.push_back(body);
  model.skins = {skin};
  model.meshes.emplace_back();
  model.meshes[0].primitives = {primitive};
  return model;
}

TEST(Names, ARegionOfASharedNameIsRefusedAndANumberIsTaken) {
  const Model model = with_triangles(skeleton(shuffled(7), false, 1));
  const FlatMesh mesh = flatten(model);
  const RegionFinder finder(model, mesh, Axes());
  Selector selector;
  selector.where = "pairs[0].source";
  selector.joints = {"hand"};
  std::vector<int> hands = nodes_named(model, "hand");
  ASSERT_EQ(hands.size(), 2u);
  try {
    finder.find({selector});
    FAIL() << "the first hand was taken";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()), "pairs[0].source: body has 2 joints \"hand\"; name one by its number: #" +
                                             std::to_string(hands[0]) + ", #" + std::to_string(hands[1]));
  }
  for (const int hand : hands) {
    selector.joints = {"#" + std::to_string(hand)};
    EXPECT_EQ(finder.find({selector}).vertices.front(), 3 * static_cast<uint32_t>(hand));
  }
  selector.joints = {"#99"};
  EXPECT_THROW(finder.find({selector}), std::runtime_error);
  const std::vector<std::string> lines = finder.describe_joints();
  for (const int hand : hands)
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find("hand (#" + std::to_string(hand) + ")") == 0;
    }));
}

TEST(Names, AClipOfASharedNameIsRefusedAndItsIndexIsTaken) {
  Model model;
  model.name = "body";
  model.animations.resize(3);
  model.animations[0].name = "A|walk";
  model.animations[1].name = "B|walk";
  model.animations[2].name = "A|walk";
  for (const char* name : {"walk", "A|walk"}) EXPECT_THROW(choose_clips(model, name), std::runtime_error) << name;
  EXPECT_EQ(choose_clips(model, "B|walk"), std::vector<const Animation*>{&model.animations[1]});
  EXPECT_EQ(choose_clips(model, "2"), std::vector<const Animation*>{&model.animations[2]});
  try {
    choose_clips(model, "A|walk");
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "body has 2 clips \"A|walk\"; give the index of one: 0, 2");
  }
}

// Two meshes of one name, each with words of its own, and two shapes of one name on one mesh.
TEST(Names, NodesAndShapesThatShareANameKeepWhatIsTheirs) {
  Model model;
  model.name = "body";
  for (int n = 0; n < 2; ++n) {
    Primitive primitive;
    primitive.positions = {{n, 0, 0}, {n + 0.5f, 0, 0}, {n, 1, 0}};
    primitive.indices = {0, 1, 2};
    primitive.targets.resize(2);
    for (int t = 0; t < 2; ++t) primitive.targets[static_cast<size_t>(t)].positions.assign(3, glm::vec3(0, 0, t + 1));
    MeshData mesh;
    mesh.primitives = {primitive};
    mesh.target_names = {"smile", "smile"};
    mesh.weights = {0, 0};
    Node node;
    node.name = "eye";
    node.mesh = n;
    node.carried.extras = n == 0 ? "{\"side\":\"left\"}" : "{\"side\":\"right\"}";
    model.scene_roots.push_back(n);
    model.nodes.push_back(node);
    model.meshes.push_back(mesh);
  }
  const FlatMesh mesh = flatten(model);
  Model still = bake(model, mesh, mesh.positions);
  keep_carried(model, still);
  ASSERT_EQ(still.nodes.size(), 2u);
  for (size_t n = 0; n < 2; ++n) EXPECT_EQ(still.nodes[n].carried.extras, model.nodes[n].carried.extras);
  Model one = bake(model, mesh, mesh.positions);
  one.meshes.resize(1);
  one.meshes[0].primitives.push_back(one.meshes[0].primitives[0]);
  keep_shapes(model, mesh, one);
  EXPECT_EQ(one.meshes[0].target_names, (std::vector<std::string>{"smile", "smile (2)"}));
  ASSERT_EQ(one.meshes[0].primitives[0].targets.size(), 2u);
  EXPECT_FLOAT_EQ(one.meshes[0].primitives[0].targets[1].positions[0].z, 2);
}

// Joints without a vertex: the surface is posed as before, whatever they are.
TEST(Names, NodesThatMoveNoVertexAreNotPosed) {
  Model model = with_triangles(skeleton(shuffled(8), true, 1));
  for (int n = 0; n < 500; ++n) {
    Node idle;
    idle.parent = n % static_cast<int>(joint_count);
    model.nodes[static_cast<size_t>(idle.parent)].children.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(idle);
  }
  Animation clip;
  for (int n = 0; n < static_cast<int>(model.nodes.size()); n += 3) {
    clip.channels.push_back(turn_of(n, {0, 1}, {0, 0, 0, 1, std::sin(0.3f), 0, 0, std::cos(0.3f)}));
  }
  const FlatMesh mesh = flatten(model);
  SurfacePoser surface(model, mesh);
  for (const double time : {0.0, 0.4, 1.0, 0.2})
    EXPECT_EQ(surface.at(clip, time), posed_positions(model, mesh, clip, time)) << time;
}

}  // namespace
}  // namespace hf_gltf
