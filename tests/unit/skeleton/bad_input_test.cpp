// Bad input is refused with the index, or known with a low confidence; time is bounded.
#include <gtest/gtest.h>

#include <cstdio>
#include <ctime>
#include <limits>

#include "base/error.h"
#include "rig_family.h"

namespace hf_test {
namespace {

using hf_inner::Memory;
using hf_inner::skeleton::Character;
using hf_inner::skeleton::CharacterInput;
using hf_inner::skeleton::know_character;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Arrays {
  std::vector<std::int32_t> parents, vertex_joints;
  std::vector<double> trs, positions, weights;
  std::vector<std::uint32_t> triangles, starts, joints;
  std::vector<std::uint8_t> bound;
  void add(int parent, Vec3 place) {
    parents.push_back(parent);
    trs.insert(trs.end(), {place.x, place.y, place.z, 0, 0, 0, 1, 1, 1, 1});
  }
  CharacterInput input() const {
    CharacterInput in;
    in.joint_count = static_cast<std::uint32_t>(parents.size());
    in.parents = parents.data();
    in.trs = trs.data();
    in.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
    in.positions = positions.data();
    in.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
    in.triangles = triangles.data();
    if (!vertex_joints.empty()) in.vertex_joints = vertex_joints.data();
    if (!starts.empty()) {
      in.influence_starts = starts.data();
      in.influence_joints = joints.data();
      in.influence_weights = weights.data();
    }
    if (!bound.empty()) in.bound = bound.data();
    return in;
  }
};

// Three joints and a triangle.
Arrays small() {
  Arrays a;
  a.add(-1, {0, 1, 0});
  a.add(0, {0, 1, 0});
  a.add(1, {0, 1, 0});
  a.positions = {0, 0, 0, 1, 0, 0, 0, 3, 0};
  a.triangles = {0, 1, 2};
  a.vertex_joints = {0, 1, 2};
  return a;
}

void expect_refused(const CharacterInput& in, hf_result code, std::uint32_t index, const std::string& part) {
  Memory memory;
  try {
    know_character(in, memory);
    ADD_FAILURE() << "taken, not refused: " << part;
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(error.index(), index) << error.what();
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
  EXPECT_EQ(memory.live_bytes(), 0u);
}

TEST(BadCharacter, IsRefusedWithTheIndex) {
  expect_refused({}, HF_ERROR_EMPTY, HF_NO_INDEX, "joint_count is 0");
  Arrays a = small();
  a.parents[0] = 2;
  expect_refused(a.input(), HF_ERROR_INVALID_ARGUMENT, 0, "its own ancestor");
  a = small();
  a.parents[1] = 3;
  expect_refused(a.input(), HF_ERROR_OUT_OF_RANGE, 1, "parents[1] is 3");
  a = small();
  a.trs[12] = nan;
  expect_refused(a.input(), HF_ERROR_NON_FINITE, 1, "rest transform of joint 1");
  a = small();
  a.trs[26] = 0;
  expect_refused(a.input(), HF_ERROR_INVALID_ARGUMENT, 2, "rotation of joint 2");
  a = small();
  a.trs[0] = 1e308;
  a.trs[10] = 1e308;
  expect_refused(a.input(), HF_ERROR_NON_FINITE, 1, "leave the range");
  a = small();
  a.positions[4] = nan;
  expect_refused(a.input(), HF_ERROR_NON_FINITE, 1, "position 1");
  a = small();
  a.triangles[2] = 3;
  expect_refused(a.input(), HF_ERROR_OUT_OF_RANGE, 0, "names vertex 3");
  a = small();
  a.vertex_joints[2] = 3;
  expect_refused(a.input(), HF_ERROR_OUT_OF_RANGE, 2, "vertex_joints[2] is 3");
  a = small();
  a.bound = {0, 0, 0};
  expect_refused(a.input(), HF_ERROR_EMPTY, HF_NO_INDEX, "bound is 0");
  a = small();
  a.starts = {0, 1, 2, 3};
  a.joints = {0, 1, 7};
  a.weights = {1, 1, 1};
  expect_refused(a.input(), HF_ERROR_OUT_OF_RANGE, 2, "influence_joints[2] is 7");
  a = small();
  a.starts = {0, 2, 1, 3};
  a.joints = {0, 1, 2};
  a.weights = {1, 1, 1};
  expect_refused(a.input(), HF_ERROR_INVALID_ARGUMENT, 1, "influence_starts[1]");
}

TEST(BadCharacter, DeclarationsAreChecked) {
  Arrays a = small();
  CharacterInput in = a.input();
  const double none[] = {0, 0, 0};
  in.up = none;
  expect_refused(in, HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "up is no direction");
  in = a.input();
  const double travels[] = {0, 0, 1, 0, nan, 0};
  in.travel_count = 2;
  in.travels = travels;
  expect_refused(in, HF_ERROR_NON_FINITE, 1, "travel 1");
  in.travels = nullptr;
  expect_refused(in, HF_ERROR_NULL_POINTER, HF_NO_INDEX, "travels");
  in = a.input();
  const std::int32_t roles[] = {-1, 99, -1}, sides[] = {0, 0, 5}, good[] = {-1, -1, 3};
  in.roles = roles;
  expect_refused(in, HF_ERROR_INVALID_ARGUMENT, 1, "roles[1] is 99");
  in.roles = good;
  in.sides = sides;
  expect_refused(in, HF_ERROR_INVALID_ARGUMENT, 2, "sides[2] is 5");
}

TEST(OddCharacter, IsKnownWithALowConfidence) {
  Memory memory;
  Arrays a = small();
  EXPECT_LE(know_character(a.input(), memory).role_confidence, 0.4);
  // Weights that are no numbers count as 0.
  a.starts = {0, 1, 2, 3};
  a.joints = {0, 1, 2};
  a.weights = {nan, 1, -1};
  a.vertex_joints.clear();
  EXPECT_LE(know_character(a.input(), memory).role_confidence, 0.4);
  // No vertices, one joint, all in one place.
  Arrays one;
  one.add(-1, {0, 0, 0});
  EXPECT_LE(know_character(one.input(), memory).role_confidence, 0.1);
  one.add(0, {0, 0, 0});
  one.add(1, {0, 0, 0});
  one.add(1, {0, 0, 0});
  const Character found = know_character(one.input(), memory);
  EXPECT_LE(found.role_confidence, 0.4);
  EXPECT_NE(std::string(found.why.begin(), found.why.end()).find("one place"), std::string::npos);
  // Names may be missing, and no name is that long.
  std::string endless(100000, 'L');
  const char* names[] = {nullptr, endless.c_str(), "", nullptr};
  CharacterInput in = one.input();
  in.names = names;
  EXPECT_LE(know_character(in, memory).role_confidence, 0.4);
}

TEST(OddCharacter, WithoutASurfaceNamesAreEnough) {
  const Rig rig = make_biped("mixamo", {});
  const PlacedRig placed(rig, {});
  CharacterInput in = placed.input();
  in.vertex_count = in.triangle_count = 0;
  Memory memory;
  const Character found = know_character(in, memory);
  EXPECT_GT(found.forward.z, 0.99);
  EXPECT_GT(found.up.y, 0.99);
  const auto joint = [&](const char* name) { return static_cast<std::size_t>(rig.find(name)); };
  EXPECT_EQ(found.roles[joint("mixamorig:LeftForeArm")], Role::arm);
  EXPECT_EQ(found.roles[joint("mixamorig:RightLeg")], Role::leg);
  EXPECT_EQ(found.sides[joint("mixamorig:RightLeg")], Side::right);
}

// The limit is twenty times what an optimised build takes, of this thread's own time.
void expect_quick(const CharacterInput& in, const char* what) {
  Memory memory;
  const std::clock_t start = std::clock();
  know_character(in, memory);
  const double ms = 1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%s: %.1f ms\n", what, ms);
  EXPECT_LT(ms, 4000) << what;
}

TEST(OddCharacter, FiveThousandJointsTakeAMoment) {
  constexpr int count = 5000;
  Arrays chain, star, flat, random, tree;
  std::uint32_t state = 1;
  const auto next = [&] { return state = 1664525 * state + 1013904223, static_cast<double>(state >> 8) / 16777216; };
  for (int j = 0; j < count; ++j) {
    const Vec3 p{next(), next(), next()};
    chain.add(j - 1, {0.001, 0.001 * (j % 7), 0.01});
    star.add(j == 0 ? -1 : 0, p);
    flat.add(-1, p);
    random.add(j == 0 ? -1 : static_cast<int>(next() * j), {0.1 * (p.x - 0.5), 0.1 * (p.y - 0.5), 0.1 * (p.z - 0.5)});
    tree.add((j + 1) / 2 - 1, {0.1 * (j % 2 ? 1 : -1), 0.05, 0.01});
  }
  // A triangle for every joint, where it lies.
  for (Arrays* a : {&star, &flat}) {
    for (int j = 0; j < count; ++j) {
      for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < 3; ++k)
          a->positions.push_back(a->trs[static_cast<std::size_t>(10 * j + k)] + 0.01 * (c == k));
        a->triangles.push_back(static_cast<std::uint32_t>(3 * j + c));
        a->vertex_joints.push_back(j);
      }
    }
  }
  expect_quick(chain.input(), "a chain");
  expect_quick(star.input(), "a star with skin");
  expect_quick(flat.input(), "joints without parents, with skin");
  expect_quick(random.input(), "a random tree");
  expect_quick(tree.input(), "a binary tree");
}

TEST(OddCharacter, TheSameBitsInAnyUnitThatIsAPowerOfTwo) {
  const Rig rig = make_biped("none", {});
  Memory memory;
  const PlacedRig one(rig, {}), large(rig, Placing{1024, 0, false, false, {}});
  const Character a = know_character(one.input(), memory), b = know_character(large.input(), memory);
  EXPECT_TRUE(a.roles == b.roles && a.sides == b.sides && a.mates == b.mates && a.chain_joints == b.chain_joints);
  EXPECT_EQ(1024 * a.leg_length, b.leg_length);
  EXPECT_EQ(a.forward_confidence, b.forward_confidence);
}

}  // namespace
}  // namespace hf_test
