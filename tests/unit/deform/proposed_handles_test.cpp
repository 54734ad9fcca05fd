// Handles proposed for creatures: feet, head and tail are found, whatever the place, the size and the order of the
// mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "assets/creature.h"
#include "gltf/animate.h"
#include "gltf/flat_mesh.h"
#include "hf/hf.hpp"
#include "support/creature.h"
#include "unit/gltf/gltf_support.h"

namespace {

using namespace hf_gltf;
using namespace samples_test;
using Proposals = std::vector<hf_handle_proposal>;

struct Body {
  std::vector<double> positions;
  std::vector<uint32_t> triangles;
  double diagonal = 0;
};

Body body_of(const FlatMesh& mesh) {
  Body out;
  out.positions = double_positions(mesh.positions);
  out.triangles = mesh.triangles;
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::dvec3& p : mesh.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  out.diagonal = glm::distance(low, high);
  return out;
}

hf::Surface surface_of(const Body& body, uint32_t threads = 1) {
  hf_surface_desc desc = HF_INIT(hf_surface_desc);
  desc.positions = HF_ARRAY(body.positions.data(), body.positions.size() / 3);
  desc.triangles = HF_ARRAY(body.triangles.data(), body.triangles.size() / 3);
  desc.thread_count = threads;
  return hf::Surface(desc);
}

Proposals propose(const Body& body, uint32_t threads = 1) { return surface_of(body, threads).propose_handles(); }

glm::dvec3 place_of(const hf_handle_proposal& o) { return {o.position[0], o.position[1], o.position[2]}; }

size_t count_of(const Proposals& list, int32_t reason) {
  return static_cast<size_t>(
      std::count_if(list.begin(), list.end(), [&](const hf_handle_proposal& o) { return o.reason == reason; }));
}

// Every proposal of one list has one of the other at the same place, of the same kind.
void expect_same_places(const Proposals& a, const Proposals& b, double scale, glm::dvec3 offset, double near) {
  ASSERT_EQ(a.size(), b.size());
  for (const hf_handle_proposal& o : a) {
    const bool found = std::any_of(b.begin(), b.end(), [&](const hf_handle_proposal& other) {
      return other.reason == o.reason && other.pinned == o.pinned &&
             glm::distance(scale * place_of(o) + offset, place_of(other)) <= near &&
             std::abs(scale * o.radius - other.radius) <= near;
    });
    EXPECT_TRUE(found) << "vertex " << o.vertex << " of reason " << o.reason;
  }
}

Body shared_body(const char* name) { return body_of(flatten(read_gltf(shared_data() / "gltf" / name))); }

TEST(Proposals, TheListDoesNotDependOnThreadsAndFollowsTranslationScaleAndCopies) {
  HF_NEED_SHARED_DATA();
  for (const char* name : {"q_Horse.glb", "q_Fox.glb", "q_Spider.glb", "CesiumMan.glb"}) {
    SCOPED_TRACE(name);
    const Body body = shared_body(name);
    const Proposals list = propose(body), again = propose(body, 2);
    ASSERT_EQ(list.size(), again.size());
    EXPECT_EQ(std::memcmp(list.data(), again.data(), list.size() * sizeof list[0]), 0);
    const double near = 1e-6 * body.diagonal;
    Body moved = body;
    const glm::dvec3 offset(3 * body.diagonal, -7 * body.diagonal, 0.1 * body.diagonal);
    for (size_t i = 0; i < moved.positions.size(); ++i) moved.positions[i] = 128 * body.positions[i] + offset[i % 3];
    expect_same_places(list, propose(moved), 128, offset, 128 * near);
    // every triangle with vertices of its own, in another order
    Body soup;
    for (size_t t = body.triangles.size() / 3; t-- > 0;) {
      for (size_t c = 0; c < 3; ++c) {
        const size_t v = body.triangles[3 * t + c];
        soup.triangles.push_back(static_cast<uint32_t>(soup.positions.size() / 3));
        soup.positions.insert(soup.positions.end(), &body.positions[3 * v], &body.positions[3 * v] + 3);
      }
    }
    expect_same_places(list, propose(soup), 1, glm::dvec3(0), near);
  }
}

TEST(Proposals, AllCanBeAddedAsHandlesAndTheFeetStayWhenATipIsDragged) {
  HF_NEED_SHARED_DATA();
  for (const char* name : {"q_Horse.glb", "q_Wolf.glb", "khr_Fox.glb", "q_Man_Casual.glb", "RiggedFigure.glb"}) {
    SCOPED_TRACE(name);
    const Body body = shared_body(name);
    const hf::Surface surface = surface_of(body);
    const Proposals list = surface.propose_handles();
    ASSERT_GE(list.size(), 2u);
    EXPECT_EQ(list[0].pinned, 1);
    hf_pose all = nullptr, some = nullptr;
    ASSERT_EQ(hf_pose_create(surface.get(), nullptr, &all), HF_OK);
    ASSERT_EQ(hf_pose_create(surface.get(), nullptr, &some), HF_OK);
    std::vector<std::pair<uint32_t, uint32_t>> held;  // handle, vertex
    uint32_t tip = HF_NO_INDEX;
    for (const hf_handle_proposal& o : list) {
      EXPECT_EQ(hf_pose_add_handle_at(all, o.position, o.radius, nullptr), HF_OK);
      const bool drag = tip == HF_NO_INDEX && o.reason == HF_HANDLE_REASON_TIP && o.component == list[0].component;
      if (!o.pinned && !drag) continue;
      uint32_t number = 0;
      ASSERT_EQ(hf_pose_add_handle_at(some, o.position, o.radius, &number), HF_OK);
      if (drag) tip = number;
      if (o.pinned) held.emplace_back(number, o.vertex);
    }
    ASSERT_NE(tip, HF_NO_INDEX);
    hf_transform drag = {{0, 0, 0, 1}, {0.05 * body.diagonal, 0.1 * body.diagonal, 0}};
    ASSERT_EQ(hf_pose_set_transform(some, tip, &drag), HF_OK);
    std::vector<float> posed(body.positions.size());
    ASSERT_EQ(hf_deform(some, posed.data(), nullptr), HF_OK);
    for (const auto& [number, vertex] : held) {
      for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(posed[3 * vertex + c], body.positions[3 * vertex + c], 1e-5 * body.diagonal);
      }
    }
    hf_pose_destroy(all);
    hf_pose_destroy(some);
  }
}

// Of two joints beside each other one is proposed: which one must not follow from their order in the skin.
TEST(Proposals, OfAGivenSkeletonDoNotDependOnTheOrderOfItsJoints) {
  const samples::Creature horse = hf_test::creature("horse", 600);
  const std::vector<double> world = samples::rest_pose(horse);
  const auto count = static_cast<uint32_t>(horse.skeleton.size());
  Body body;
  body.positions.assign(horse.positions.begin(), horse.positions.end());
  body.triangles = horse.triangles;
  const hf::Surface surface = surface_of(body);
  std::vector<uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  Proposals first;
  for (unsigned seed = 0; seed < 8; ++seed) {
    std::vector<double> joints(3 * size_t{count});
    std::vector<uint32_t> parents(count);
    for (uint32_t j = 0; j < count; ++j) {
      std::copy_n(&world[16 * size_t{j} + 12], 3, &joints[3 * size_t{order[j]}]);
      const int32_t parent = horse.skeleton[j].parent;
      parents[order[j]] = parent < 0 ? HF_NO_INDEX : order[static_cast<size_t>(parent)];
    }
    hf_handle_proposals_desc desc = HF_INIT(hf_handle_proposals_desc);
    desc.joint_count = count;
    desc.joints = joints.data();
    desc.parents = parents.data();
    Proposals list(HF_HANDLE_LIMIT);
    uint32_t found = 0;
    ASSERT_EQ(hf_surface_propose_handles(surface.get(), &desc, HF_HANDLE_LIMIT, list.data(), &found), HF_OK);
    list.resize(found);
    if (seed == 0) first = list;
    EXPECT_GT(count_of(list, HF_HANDLE_REASON_JOINT), 1u);
    expect_same_places(first, list, 1, glm::dvec3(0), 1e-9);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  }
}

glm::dvec3 vertex_of(const Body& body, uint32_t v) {
  return {body.positions[3 * size_t{v}], body.positions[3 * size_t{v} + 1], body.positions[3 * size_t{v} + 2]};
}

struct KnownBody {
  Body body;
  std::map<std::string, glm::dvec3> joints;
};

KnownBody known_body(const char* name) {
  const samples::Creature& creature = hf_test::creature(name, 3000);
  KnownBody out;
  out.body.positions.assign(creature.positions.begin(), creature.positions.end());
  out.body.triangles = creature.triangles;
  glm::dvec3 low(1e300), high(-1e300);
  for (size_t v = 0; v < out.body.positions.size(); v += 3) {
    const glm::dvec3 p(out.body.positions[v], out.body.positions[v + 1], out.body.positions[v + 2]);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  out.body.diagonal = glm::distance(low, high);
  const std::vector<double> world = samples::rest_pose(creature);
  for (size_t j = 0; j < creature.skeleton.size(); ++j)
    out.joints[creature.skeleton[j].name] = {world[16 * j + 12], world[16 * j + 13], world[16 * j + 14]};
  return out;
}

// The share of the vertices that move by more than 0.01 of the box when a tip goes up by 0.2 of it; what is held: the
// feet, or all that holds.
double share_that_moves(const KnownBody& known, const hf::Surface& surface, const Proposals& list, size_t tip,
                        bool all) {
  hf::Pose pose(surface);
  for (const hf_handle_proposal& o : list) {
    if (o.pinned && (all || o.reason == HF_HANDLE_REASON_FOOT)) {
      EXPECT_EQ(hf_pose_add_handle_at(pose.get(), o.position, o.radius, nullptr), HF_OK);
    }
  }
  uint32_t hand = 0;
  EXPECT_EQ(hf_pose_add_handle_at(pose.get(), list[tip].position, list[tip].radius, &hand), HF_OK);
  EXPECT_EQ(hf_pose_set_free_rotations(pose.get(), 1, &hand, 1), HF_OK);
  const std::vector<double>& rest = known.body.positions;
  std::vector<float> posed(rest.size());
  for (int k = 1; k <= 20; ++k) {
    const hf_transform up = {{0, 0, 0, 1}, {0, 0.01 * k * known.body.diagonal, 0}};
    EXPECT_EQ(hf_pose_set_transform(pose.get(), hand, &up), HF_OK);
    EXPECT_EQ(hf_deform(pose.get(), posed.data(), nullptr), HF_OK);
  }
  size_t moved = 0;
  for (size_t v = 0; v < rest.size(); v += 3) {
    const glm::dvec3 way(posed[v] - rest[v], posed[v + 1] - rest[v + 1], posed[v + 2] - rest[v + 2]);
    moved += glm::length(way) > 0.01 * known.body.diagonal;
  }
  return 3.0 * static_cast<double>(moved) / static_cast<double>(rest.size());
}

TEST(Proposals, TheChestOrTheTrunkBetweenTheLegsHoldsSoThatATipIsPulledAndNotTheBody) {
  // the trunk is between these joints along this axis
  const std::map<std::string, std::tuple<int, std::string, std::string>> between = {
      {"biped", {1, "hips", "neck"}}, {"horse", {2, "hips", "neck_1"}}, {"bull", {2, "hips", "neck_1"}}};
  for (const auto& [name, where] : between) {
    SCOPED_TRACE(name);
    const KnownBody known = known_body(name.c_str());
    const hf::Surface surface = surface_of(known.body);
    const Proposals list = surface.propose_handles();
    ASSERT_EQ(count_of(list, HF_HANDLE_REASON_MIDDLE), 1u);
    const hf_handle_proposal& trunk =
        *std::find_if(list.begin(), list.end(), [](const auto& o) { return o.reason == HF_HANDLE_REASON_MIDDLE; });
    EXPECT_EQ(trunk.pinned, 1);
    const auto& [axis, from, to] = where;
    EXPECT_GT(trunk.position[axis], known.joints.at(from)[axis]);
    EXPECT_LT(trunk.position[axis], known.joints.at(to)[axis]);
    EXPECT_NEAR(trunk.position[0], 0, 0.02 * known.body.diagonal);
    EXPECT_GT(glm::distance(place_of(trunk), vertex_of(known.body, trunk.vertex)), 0.02 * known.body.diagonal);
    size_t pulled = 0;
    for (size_t i = 0; i < list.size(); ++i) {
      if (list[i].reason != HF_HANDLE_REASON_TIP || list[i].length < 0.2 * known.body.diagonal) continue;
      const double feet = share_that_moves(known, surface, list, i, false);
      const double all = share_that_moves(known, surface, list, i, true);
      EXPECT_LT(all, 0.8 * feet) << "tip " << i;
      std::printf("%s tip %zu: %.2f of the vertices move with feet alone, %.2f with the trunk\n", name.c_str(), i, feet,
                  all);
      ++pulled;
    }
    EXPECT_GE(pulled, 2u);
  }
}

TEST(Proposals, WithoutAGroundTheMiddleAloneHoldsAndPiecesWithoutTipsGetTheirEnds) {
  // a stick beside a flat sheet that lies across the vertical axis
  std::vector<glm::dvec3> points;
  std::vector<uint32_t> triangles;
  constexpr uint32_t width = 12;
  for (uint32_t j = 0; j < width; ++j) {
    for (uint32_t i = 0; i < width; ++i) {
      points.emplace_back(i, 0, j);
      if (i + 1 == width || j + 1 == width) continue;
      const uint32_t a = j * width + i, up = a + width;
      triangles.insert(triangles.end(), {a, up, a + 1, a + 1, up, up + 1});
    }
  }
  Body body = body_of([&] {
    FlatMesh mesh;
    mesh.positions = points;
    mesh.triangles = triangles;
    return mesh;
  }());
  Proposals list = propose(body);
  EXPECT_EQ(count_of(list, HF_HANDLE_REASON_FOOT), 0u);
  ASSERT_EQ(count_of(list, HF_HANDLE_REASON_MIDDLE), 1u);
  EXPECT_EQ(list[0].reason, HF_HANDLE_REASON_MIDDLE);
  EXPECT_EQ(list[0].pinned, 1);
  for (size_t i = 1; i < list.size(); ++i) EXPECT_EQ(list[i].pinned, 0);
}

// The ends of the skeleton on the surface: for each joint without children the vertex it carries that is farthest from
// the joint above. Helpers carry none.
std::vector<std::pair<std::string, glm::dvec3>> joint_ends(const Model& model, const FlatMesh& mesh) {
  std::vector<std::pair<std::string, glm::dvec3>> out;
  if (model.skins.empty()) return out;
  const std::vector<glm::dmat4> globals = global_matrices(model, rest_pose(model));
  const std::vector<int>& joints = model.skins[0].joints;
  std::vector<double> farthest(joints.size(), -1);
  std::vector<glm::dvec3> ends(joints.size());
  for (uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const FlatPart& part = mesh.part_of_vertex(v);
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    if (primitive.influences.empty()) continue;
    const Influences& o = primitive.influences[v - part.first_vertex];
    const size_t slot = static_cast<size_t>(std::max_element(o.weights.begin(), o.weights.end()) - o.weights.begin());
    const size_t joint = o.joints[slot];
    const Node& node = model.nodes[static_cast<size_t>(joints[joint])];
    const glm::dvec3 above(globals[static_cast<size_t>(node.parent < 0 ? joints[joint] : node.parent)][3]);
    const double d = glm::distance(mesh.positions[v], above);
    if (d > farthest[joint]) {
      farthest[joint] = d;
      ends[joint] = mesh.positions[v];
    }
  }
  for (size_t j = 0; j < joints.size(); ++j) {
    const Node& node = model.nodes[static_cast<size_t>(joints[j])];
    const bool inner = std::any_of(node.children.begin(), node.children.end(), [&](int child) {
      return std::find(joints.begin(), joints.end(), child) != joints.end();
    });
    if (!inner && farthest[j] >= 0) out.emplace_back(node.name, ends[j]);
  }
  return out;
}

TEST(Proposals, FeetHeadAndTailOfTheSharedAnimalsAreFound) {
  HF_NEED_SHARED_DATA();
  std::printf("%-20s %4s %4s %4s %4s  ends of end joints with a proposal within 3 %% and 6 %% of the box, of all\n",
              "model", "feet", "tips", "ends", "all");
  const std::vector<std::pair<const char*, size_t>> feet = {
      {"q_Horse.glb", 4},    {"q_Wolf.glb", 4},         {"q_Fox.glb", 4},         {"q_Cow.glb", 4},
      {"q_Husky.glb", 4},    {"q_Deer.glb", 4},         {"q_Alpaca.glb", 4},      {"farm_Cow.glb", 4},
      {"farm_Llama.glb", 4}, {"farm_Pug.glb", 4},       {"farm_Sheep.glb", 4},    {"khr_Fox.glb", 4},
      {"q_Trex.glb", 2},     {"q_Velociraptor.glb", 2}, {"q_Triceratops.glb", 4}, {"q_Spider.glb", 8},
      {"CesiumMan.glb", 2},  {"RiggedFigure.glb", 2}};
  for (const auto& [name, count] : feet) {
    SCOPED_TRACE(name);
    const Model model = read_gltf(shared_data() / "gltf" / name);
    const FlatMesh mesh = flatten(model);
    const Body body = body_of(mesh);
    const Proposals list = propose(body);
    const auto joints = joint_ends(model, mesh);
    size_t near = 0, beside = 0;
    std::string missed;
    for (const auto& [joint, place] : joints) {
      double least = 1e300;
      for (const hf_handle_proposal& o : list) least = std::min(least, glm::distance(place_of(o), place));
      near += least <= 0.03 * body.diagonal;
      beside += least <= 0.06 * body.diagonal;
      if (least > 0.06 * body.diagonal) missed += " " + joint;
    }
    std::printf("%-20s %4zu %4zu %4zu %4zu  %zu, %zu of %zu; not%s\n", name, count_of(list, HF_HANDLE_REASON_FOOT),
                count_of(list, HF_HANDLE_REASON_TIP), count_of(list, HF_HANDLE_REASON_END), list.size(), near, beside,
                joints.size(), missed.substr(0, 300).c_str());
    EXPECT_EQ(count_of(list, HF_HANDLE_REASON_FOOT), count);
    EXPECT_GE(count_of(list, HF_HANDLE_REASON_TIP), 1u);
  }
}

}  // namespace
