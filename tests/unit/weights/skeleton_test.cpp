// Where bones end that are given as joints, which side of a skin is outside, and what locks of removed bones become.
#include "weights/skeleton.h"

#include "weights_support.h"

namespace {

using namespace hf_test;
using hf_inner::Vec3;
using hf_inner::weights::Bones;
using hf_inner::weights::Weights;

constexpr double length = 9;

void expect_near(const Vec3& a, const Vec3& b, const char* what) { EXPECT_LT(norm(a - b), 1e-9) << what; }

TEST(Skeleton, JointsEndAtTheirChildrenAlongTheirAxisOrInTheSkin) {
  const auto skin = skin_of(tube(12, 31, length));
  const auto& mesh = skin->core->mesh;
  hf_inner::Memory& memory = *skin->core->memory;
  Bones bones(memory);
  const auto add = [&](Vec3 head, Index parent, Vec3 axis = {}, bool deforms = true) {
    bones.head.push_back(head);
    bones.parent.push_back(parent);
    bones.axis.push_back(axis);
    bones.deforms.push_back(deforms);
  };
  const double turn = std::atan(1.0) / 3;  // to the middle of a side of the tube
  const Vec3 side = {0, std::cos(turn), std::sin(turn)};
  add({0.5, 0, 0}, -1);             // 0: the mean of its children
  add({3, 0.3, 0}, 0);              // 1: its only child
  add({3, -0.3, 0}, 0);             // 2: a leaf, 1.5 times the way from its parent
  add({6.07, 0, 0}, 1, side);       // 3: along its axis, as far as the skin lets it
  add({3, 0.3, 0}, 1);              // 4: on its parent: a point
  add({5, -0.3, 0}, 2, {}, false);  // 5: no bone
  add({8, 0, 0}, -1);               // 6: nothing says where it ends: a point
  add({1, 0, 0}, -1, {1, 0, 0});    // 7: no child along its axis: half the usual length
  add({1, 0.9, 0}, 7);              // 8
  add({4, 0, 2}, -1, {1, 0, 0});    // 9: the child along its axis
  add({4, 0.5, 2}, 9);              // 10
  add({5, 0, 2}, 9);                // 11
  add({1, -0.5, 0}, 7, {}, false);  // 12: no bone; with one child off its axis alone, 7 would reach to it
  const auto segments = hf_inner::weights::bone_segments(bones, mesh, skin->skin, memory);
  ASSERT_EQ(segments.size(), 11u);
  const auto tail = [&](Index bone) {
    for (const auto& s : segments) {
      if (s.bone == bone) return mesh.to_given(s.tail);
    }
    ADD_FAILURE() << "no bone " << bone;
    return Vec3{};
  };
  const double way = norm(bones.head[2] - bones.head[0]);
  expect_near(tail(0), {3, 0, 0}, "mean of two children");
  expect_near(tail(1), bones.head[3], "only child");
  expect_near(tail(2), bones.head[2] + 1.5 * (bones.head[2] - bones.head[0]), "leaf");
  expect_near(tail(3), bones.head[3] + std::cos(turn) * side, "skin");
  expect_near(tail(4), bones.head[4], "on its parent");
  expect_near(tail(6), bones.head[6], "alone");
  expect_near(tail(7), bones.head[7] + Vec3{0.5 * way, 0, 0}, "hub");  // way is the middle one of six lengths
  expect_near(tail(9), bones.head[11], "child along the axis");
}

// The axes of a leaf of scale -1 point back along the bone above it, and so does that of one turned a little.
TEST(Skeleton, ALeafDoesNotLieOnTheBoneAboveIt) {
  const auto skin = skin_of(tube(12, 31, length));
  hf_inner::Memory& memory = *skin->core->memory;
  for (const double slant : {0.0, 0.05}) {
    Bones bones(memory);
    for (const double x : {0.0, 4.5}) {
      bones.head.push_back({x, 0, 0});
      bones.parent.push_back(x > 0 ? 0 : -1);
      bones.axis.push_back(x > 0 ? hf_inner::unit_vector({-1, slant, 0}) : Vec3{1, 0, 0});
      bones.deforms.push_back(1);
    }
    const auto segments = hf_inner::weights::bone_segments(bones, skin->core->mesh, skin->skin, memory);
    ASSERT_EQ(segments.size(), 2u);
    expect_near(skin->core->mesh.to_given(segments[0].tail), {4.5, 0, 0}, "the bone above");
    expect_near(skin->core->mesh.to_given(segments[1].tail), {length, 0, 0}, "the leaf");
    EXPECT_EQ(hf_inner::weights::bone_faults(2, segments, skin->skin, memory)[1] & hf_inner::weights::bone_coincident,
              0u);
  }
}

TEST(Skeleton, AnInsideOutTubeHasTheWeightsOfTheTube) {
  PlainMesh turned = tube(12, 31, length);
  for (std::size_t t = 0; t < turned.triangles.size(); t += 3)
    std::swap(turned.triangles[t + 1], turned.triangles[t + 2]);
  const auto one = skin_of(tube(12, 31, length)), other = skin_of(turned);
  EXPECT_TRUE(one->skin.inside(one->core->mesh.to_inner({4.1, 0.2, 0.1})));
  EXPECT_TRUE(other->skin.inside(other->core->mesh.to_inner({4.1, 0.2, 0.1})));
  EXPECT_FALSE(other->skin.inside(other->core->mesh.to_inner({4.1, 1.2, 0.1})));
  const Weights a(one, 4, chain(*one->core->memory, 3, length)), b(other, 4, chain(*other->core->memory, 3, length));
  EXPECT_LT(worst_difference(a, b), 1e-6);
}

TEST(Skeleton, LocksOfRemovedBonesGo) {
  const auto skin = skin_of(tube(12, 31, length));
  hf_inner::Memory& memory = *skin->core->memory;
  Weights weights(skin, 4, chain(memory, 3, length));
  const Weights before(weights);
  const Index locked[] = {0, 2};
  weights.set_locks({locked, 2}, nullptr);
  Bones fewer(memory);  // without bone 0; bone 2 moves
  const Bones all = chain(memory, 3, length);
  fewer.has_tails = true;
  for (const int b : {1, 2}) {
    fewer.head.push_back(all.head[at(b)]);
    fewer.tail.push_back(all.tail[at(b)] + Vec3{0, 0.2 * (b - 1), 0});
    fewer.parent.push_back(-1);
    fewer.deforms.push_back(1);
  }
  const Index sources[] = {1, 2};
  weights.set_joints(fewer, {sources, 2});
  expect_valid(weights);
  ASSERT_TRUE(weights.state().inputs->locks);
  ASSERT_EQ(weights.state().inputs->locks->bones.size(), 1u);
  for (Index v = 0; v < skin->core->size(); ++v) EXPECT_EQ(weight_of(weights, v, 1), weight_of(before, v, 2));
  Bones last(memory);
  last.has_tails = true;
  last.head.push_back(all.head[1]);
  last.tail.push_back(all.tail[1]);
  last.parent.push_back(-1);
  last.deforms.push_back(1);
  const Index first[] = {0};
  weights.set_joints(last, {first, 1});
  EXPECT_FALSE(weights.state().inputs->locks);  // no lock is left
}

}  // namespace
