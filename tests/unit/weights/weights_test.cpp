// Skin weights on tubes: smooth, of sum 1, the nearest bone leads; pins, locks, moved bones, pieces, welded
// copies, threads.
#include "weights/weights.h"

#include <Eigen/Core>

#include "base/error.h"
#include "support/dense.h"
#include "weights_support.h"

namespace {

using namespace hf_test;
using hf_inner::solve::Site;
using hf_inner::weights::Bones;
using hf_inner::weights::Pins;
using hf_inner::weights::Weights;

constexpr std::uint32_t around = 12, rings = 31;
constexpr double length = 9;

Index ring_vertex(Index ring, Index k = 0) { return ring * static_cast<Index>(around) + k; }

// Welded meshes number their vertices in the order of the caller, where nothing is welded.
struct Scene {
  std::shared_ptr<const hf_inner::weights::SkinSurface> skin;
  hf_inner::Memory& memory;
  Bones bones;
  explicit Scene(int count = 3, const PlainMesh& mesh = tube(around, rings, length), std::uint32_t threads = 1)
      : skin(skin_of(mesh, threads)), memory(*skin->core->memory), bones(chain(memory, count, length)) {}
  Weights make(std::int32_t influences = 4) const { return Weights(skin, influences, bones); }
};

void add_pin(Pins& pins, const Site& place, const std::vector<std::pair<Index, double>>& shares, double radius = 0) {
  pins.places.push_back(place);
  pins.radius.push_back(radius);
  for (const auto& [bone, share] : shares) {
    pins.bone.push_back(bone);
    pins.share.push_back(share);
  }
  pins.start.push_back(static_cast<Index>(pins.bone.size()));
}

TEST(Weights, TheNearestBoneLeadsAndJointsAreSmooth) {
  const Scene scene;
  const Weights weights = scene.make();
  expect_valid(weights);
  EXPECT_GT(weight_of(weights, ring_vertex(5), 0), 0.9);
  EXPECT_GT(weight_of(weights, ring_vertex(15), 1), 0.9);
  EXPECT_GT(weight_of(weights, ring_vertex(25), 2), 0.9);
  EXPECT_NEAR(weight_of(weights, ring_vertex(10), 0), 0.5, 0.02);  // at the joint
  EXPECT_NEAR(weight_of(weights, ring_vertex(10), 1), 0.5, 0.02);
  for (Index ring = 1; ring < 15; ++ring)
    EXPECT_LE(weight_of(weights, ring_vertex(ring), 0), weight_of(weights, ring_vertex(ring - 1), 0) + 1e-6);
  EXPECT_EQ(weights.state().counts.by_origin[0], 2 + around * rings);
}

TEST(Weights, TheSmoothFieldsSumToOneAndStayBetweenZeroAndOne) {
  const Scene scene(7);
  const Weights weights = scene.make();
  const hf_inner::weights::Solution& solution = *weights.state().solution;
  for (std::size_t v = 0; v < at(scene.skin->core->size()); ++v) {
    double sum = 0;
    for (std::size_t c = 0; c < solution.width(); ++c) {
      EXPECT_GE(solution.field[v * solution.width() + c], -1e-12);
      sum += solution.field[v * solution.width() + c];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Weights, WeldedCopiesAndThreadsGiveTheSameBits) {
  const PlainMesh whole = tube(around, rings, length);
  PlainMesh raw;  // three vertices of its own for each triangle
  for (const std::uint32_t v : whole.triangles) {
    raw.triangles.push_back(raw.vertex_count());
    raw.positions.insert(raw.positions.end(), &whole.positions[3 * v], &whole.positions[3 * v] + 3);
  }
  const Scene a(5, whole), b(5, raw), c(5, whole, 3);
  const Weights first = a.make(), second = b.make(), third = c.make();
  EXPECT_TRUE(same_weights(first, third));
  const auto& mesh = b.skin->core->mesh;
  for (std::size_t i = 0; i < whole.triangles.size(); ++i) {
    for (std::uint32_t bone = 0; bone < 5; ++bone)
      EXPECT_NEAR(weight_of(first, static_cast<Index>(whole.triangles[i]), bone),
                  weight_of(second, mesh.inner_of_given[i], bone), 1e-6);
  }
}

TEST(Weights, AMovedBoneGivesAFreshObject) {
  Scene scene(4);
  Weights weights = scene.make();
  const Weights before = scene.make();
  scene.bones.head[2].y = 0.4;
  scene.bones.tail[1].y = 0.4;
  weights.set_joints(scene.bones, {});
  const Weights fresh = scene.make();
  EXPECT_FALSE(same_weights(weights, before));
  EXPECT_LT(worst_difference(weights, fresh), 1e-12);
  EXPECT_TRUE(same_weights(weights, fresh));
}

TEST(Weights, RemovedAndAddedBonesKeepPinsAndLocks) {
  Scene scene(3);
  Weights weights = scene.make();
  Pins pins(scene.memory);
  add_pin(pins, Site::at_vertex(scene.skin->core->mesh, ring_vertex(3)), {{2, 0.5}, {0, 0.5}});
  weights.set_pins(pins);
  Bones fewer(scene.memory);  // the last bone alone, and a new one before it
  fewer.has_tails = true;
  for (const int b : {0, 2}) {
    fewer.head.push_back(scene.bones.head[at(b)]);
    fewer.tail.push_back(scene.bones.tail[at(b)]);
    fewer.parent.push_back(-1);
    fewer.deforms.push_back(1);
  }
  const Index sources[] = {-1, 2};
  weights.set_joints(fewer, {sources, 2});
  expect_valid(weights);
  EXPECT_EQ(weight_of(weights, ring_vertex(3), 1), 1.0);  // the share of the removed bone goes to the other
  const Index none[] = {-1, -1};
  const auto joints = weights.state().joints;
  EXPECT_THROW(weights.set_joints(fewer, {none, 2}), hf_inner::Error);
  EXPECT_EQ(weights.state().joints, joints);
}

TEST(Weights, PinsAreExactAndFade) {
  const Scene scene;
  Weights weights = scene.make();
  const Weights plain = scene.make();
  const auto& mesh = scene.skin->core->mesh;
  Pins pins(scene.memory);
  add_pin(pins, Site::at_vertex(mesh, ring_vertex(5)), {{1, 0.25}, {0, 0.75}});
  weights.set_pins(pins);
  expect_valid(weights);
  EXPECT_EQ(weight_of(weights, ring_vertex(5), 1), 0.25);
  EXPECT_EQ(weight_of(weights, ring_vertex(5), 0), 0.75);
  EXPECT_GT(weight_of(weights, ring_vertex(5, 1), 1), weight_of(plain, ring_vertex(5, 1), 1) + 0.05);
  for (Index k = 0; k < 12; ++k)
    EXPECT_EQ(weight_of(weights, ring_vertex(28, k), 2), weight_of(plain, ring_vertex(28, k), 2));
  EXPECT_EQ(weights.state().counts.factorisations, 1u);  // a pin does not factorise
  EXPECT_EQ(weights.state().counts.path_solves, 1u);
  // other weights at the same place solve no path, and equal a fresh object
  Pins other(scene.memory);
  add_pin(other, Site::at_vertex(mesh, ring_vertex(5)), {{2, 1.0}});
  weights.set_pins(other);
  EXPECT_EQ(weights.state().counts.path_solves, 1u);
  Weights fresh = scene.make();
  fresh.set_pins(other);
  EXPECT_TRUE(same_weights(weights, fresh));
  weights.set_pins(Pins(scene.memory));
  EXPECT_TRUE(same_weights(weights, plain));
}

// The pinned field solves K + A H with the pins as constraints: against a fresh dense solve.
TEST(Weights, APinnedFieldIsTheDenseSolution) {
  const Scene scene(3, tube(8, 9, length));
  Weights weights = scene.make();
  const auto& core = *scene.skin->core;
  Site point;
  for (int k = 0; k < 3; ++k) {
    point.vertex[k] = core.mesh.triangle(40)[k];
    point.weight[k] = k ? 0.25 : 0.5;
  }
  point.component = 0;
  Pins pins(scene.memory);
  add_pin(pins, Site::at_vertex(core.mesh, 20), {{1, 0.5}, {2, 0.5}});
  add_pin(pins, point, {{0, 1.0}});
  weights.set_pins(pins);
  const auto& solution = *weights.state().solution;
  const auto& pinned = *weights.state().pinned;
  const int n = core.size();
  for (std::uint32_t bone = 0; bone < 3; ++bone) {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + 2, n + 2);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 2);
    const auto& k = solution.screened->matrix;
    for (int v = 0; v < n; ++v) {
      for (int i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) a(v, k.row[at(i)]) = k.value[at(i)];
      for (const Index own : solution.informants.of(v)) {
        if (own == static_cast<Index>(bone))
          b(v) = solution.screened->mass[at(v)] / static_cast<double>(solution.informants.of(v).size());
      }
    }
    a(20, n) = -1;
    a(n, 20) = 1;
    b(n) = bone == 0 ? 0 : 0.5;
    for (int q = 0; q < 3; ++q) {
      a(point.vertex[q], n + 1) = -point.weight[q];
      a(n + 1, point.vertex[q]) = point.weight[q];
    }
    b(n + 1) = bone == 0;
    const Eigen::VectorXd exact = hf_test::DenseSolver(a, hf_test::DenseSolver::full).solve(b);
    ASSERT_GE(pinned.column_of[bone], 0);
    for (int v = 0; v < n; ++v)
      EXPECT_NEAR(pinned.field[at(v) * pinned.bone_of.size() + at(pinned.column_of[bone])], exact(v), 1e-11);
  }
}

TEST(Weights, ADiscIsPinnedWholeAndOverlapsAreNamed) {
  const Scene scene;
  Weights weights = scene.make();
  const auto& mesh = scene.skin->core->mesh;
  Pins pins(scene.memory);
  add_pin(pins, Site::at_vertex(mesh, ring_vertex(5)), {{2, 1.0}}, 0.7 / mesh.scale);
  weights.set_pins(pins);
  EXPECT_GT(weights.state().counts.by_origin[2], 5u);
  EXPECT_EQ(weight_of(weights, ring_vertex(5, 1), 2), 1.0);
  add_pin(pins, Site::at_vertex(mesh, ring_vertex(5, 1)), {{0, 1.0}});
  const auto joints = weights.state().joints;
  try {
    weights.set_pins(pins);
    ADD_FAILURE() << "two pins on one vertex pass";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_DUPLICATE);
    EXPECT_EQ(error.index(), 1u);
  }
  EXPECT_EQ(weights.state().joints, joints);
}

TEST(Weights, LockedBonesKeepTheirWeights) {
  Scene scene;
  Weights weights = scene.make();
  const Weights plain = scene.make();
  const Index locked[] = {1};
  weights.set_locks({locked, 1}, nullptr);
  scene.bones.tail[0].y = 0.8;
  scene.bones.head[1].y = 0.8;
  weights.set_joints(scene.bones, {});
  expect_valid(weights);
  double moved = 0;
  for (Index v = 0; v < scene.skin->core->size(); ++v) {
    EXPECT_EQ(weight_of(weights, v, 1), weight_of(plain, v, 1));
    moved = std::max(moved, std::fabs(weight_of(weights, v, 0) - weight_of(plain, v, 0)));
  }
  weights.set_locks({}, nullptr);
  EXPECT_TRUE(same_weights(weights, scene.make()));
}

TEST(Weights, PiecesWithoutInformationTakeTheWeightsOfTheirNeighbours) {
  PlainMesh mesh = tube(around, rings, length);
  const PlainMesh cube = tube(4, 2, 0.1);
  append(mesh, cube, length + 3);  // a speck behind the end
  const Scene scene(3, mesh);
  const Weights weights = scene.make();
  expect_valid(weights);
  const Index speck = static_cast<Index>(around * rings + 2);
  for (Index v = speck; v < scene.skin->core->size(); ++v) EXPECT_GT(weight_of(weights, v, 2), 0.9);
}

TEST(Weights, EightWeightsAndBonesThatDoNotDeform) {
  Scene scene(6);
  scene.bones.deforms[2] = 0;
  const Weights weights = scene.make(8);
  expect_valid(weights);
  for (Index v = 0; v < scene.skin->core->size(); ++v) EXPECT_EQ(weight_of(weights, v, 2), 0.0);
  scene.bones.deforms.assign(6, 0);
  EXPECT_THROW(scene.make(), hf_inner::Error);
}

TEST(Weights, FaultsOfBonesAreNamed) {
  Scene scene(3);
  const auto add = [&](hf_inner::Vec3 head, hf_inner::Vec3 tail) {
    scene.bones.head.push_back(head);
    scene.bones.tail.push_back(tail);
    scene.bones.parent.push_back(-1);
    scene.bones.deforms.push_back(1);
  };
  add({4, 0, 0}, {4, 0, 0});
  add(scene.bones.head[1], scene.bones.tail[1]);
  add({4, 30, 0}, {5, 30, 0});
  const Weights weights = scene.make();
  expect_valid(weights);
  const auto& faults = weights.state().solution->faults;
  EXPECT_EQ(faults[0] | faults[1] | faults[2], 0u);
  EXPECT_TRUE(faults[3] & hf_inner::weights::bone_no_length);
  EXPECT_EQ(faults[4], static_cast<std::uint32_t>(hf_inner::weights::bone_coincident));
  EXPECT_EQ(faults[5],
            static_cast<std::uint32_t>(hf_inner::weights::bone_outside | hf_inner::weights::bone_informs_none));
  EXPECT_NEAR(weight_of(weights, ring_vertex(13), 1), weight_of(weights, ring_vertex(13), 4), 1e-6);
}

// Joints along x in a tube of length 9: heads, the axis of each, the parents.
std::vector<hf_inner::weights::BoneSegment> segments_of(const std::vector<double>& x, const std::vector<double>& axis_x,
                                                        const std::vector<Index>& parents,
                                                        const std::vector<int>& deforms) {
  const Scene scene;
  Bones bones(scene.memory);
  for (std::size_t j = 0; j < x.size(); ++j) {
    bones.head.push_back({x[j], 0, 0});
    const double across = std::sqrt(1 - axis_x[j] * axis_x[j]);
    bones.axis.push_back({axis_x[j], across, 0});
    bones.parent.push_back(parents[j]);
    bones.deforms.push_back(static_cast<std::uint8_t>(deforms[j]));
  }
  const auto found = bone_segments(bones, scene.skin->core->mesh, scene.skin->skin, scene.memory);
  std::vector<hf_inner::weights::BoneSegment> out;
  for (hf_inner::weights::BoneSegment s : found) {
    s.head = scene.skin->core->mesh.to_given(s.head);
    s.tail = scene.skin->core->mesh.to_given(s.tail);
    out.push_back(s);
  }
  return out;
}

TEST(Weights, ALeafEndsAtTheJointThatItMeets) {
  // Hip, leg, foot: the foot is a child of the hip's parent. Joint 3 does not deform.
  const auto found = segments_of({1, 2, 4, 6.5}, {1, 1, 1, 1}, {-1, 0, 1, -1}, {1, 1, 1, 0});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[2].tail.x, 6.5, 1e-6);
  // Farther than 1.5 lengths of the parent, the leaf ends on its own.
  EXPECT_NEAR(segments_of({1, 2, 4, 7.5}, {1, 1, 1, 1}, {-1, 0, 1, -1}, {1, 1, 1, 0})[2].tail.x, 7, 1e-6);
  // A joint that the leaf hangs from is no end.
  EXPECT_NEAR(segments_of({1, 5, 4, 3}, {1, 1, -1, 1}, {3, 0, 1, -1}, {1, 1, 1, 0})[2].tail.x, 2.5, 1e-6);
}

TEST(Weights, ALeafEndsAtAChildThatDoesNotDeform) {
  // Joint 3 hangs from the leaf at 4 and lies along its axis, nearer than the joint 4 that the leaf would meet.
  const auto found = segments_of({1, 2, 4, 4.5, 5}, {1, 1, 1, 1, 1}, {-1, 0, 1, 2, -1}, {1, 1, 1, 0, 0});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[2].tail.x, 4.5, 1e-6);
  // However far it is.
  EXPECT_NEAR(segments_of({1, 2, 4, 8.5}, {1, 1, 1, 1}, {-1, 0, 1, 2}, {1, 1, 1, 0})[2].tail.x, 8.5, 1e-6);
  // Off the axis it says nothing; nor does it where a child deforms.
  EXPECT_NEAR(segments_of({1, 2, 4, 3.5}, {1, 1, 1, 1}, {-1, 0, 1, 2}, {1, 1, 1, 0})[2].tail.x, 7, 1e-6);
  EXPECT_NEAR(segments_of({1, 2, 4, 2.5}, {1, 1, 1, 1}, {-1, 0, 1, 1}, {1, 1, 1, 0})[1].tail.x, 4, 1e-6);
}

TEST(Weights, AJointWhoseChildrenLieElsewhereEndsAtTheJointThatItMeets) {
  // The only child of joint 1 lies behind it; joint 3, a child of its parent, lies along its axis. So the axes hold.
  const auto found = segments_of({2, 4, 3, 5.5}, {1, 1, 1, 1}, {-1, 0, 1, 0}, {1, 1, 1, 1});
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found[1].tail.x, 5.5, 1e-6);
  // Without a joint to meet, it is half as long as its parent, but at most twice as long as its nearest child is away.
  EXPECT_NEAR(segments_of({2, 6, 4, 3}, {1, 1, 1, 1}, {-1, 0, 1, 1}, {1, 1, 1, 1})[1].tail.x, 8, 1e-6);
  EXPECT_NEAR(segments_of({2, 6, 5.5, 3}, {1, 1, 1, 1}, {-1, 0, 1, 1}, {1, 1, 1, 1})[1].tail.x, 7, 1e-6);
}

TEST(Weights, ALeafAwayFromItsParentHasATypicalLength) {
  // The foot at 6 hangs from the root at 0.5, across its axis. Lengths: 1, 1, 5.5.
  const auto found = segments_of({0.5, 1.5, 2.5, 6}, {0, 1, 1, 1}, {-1, 0, 1, 0}, {1, 1, 1, 1});
  EXPECT_NEAR(found.back().tail.x, 7.5, 1e-6);
}

TEST(Weights, ARigWhoseAxesDoNotHoldTakesAllChildren) {
  // The only child of joint 2 lies off its axis, so joint 1 reaches to both of its children.
  const auto found = segments_of({4, 5, 6, 7, 3}, {1, 0, 0, 1, 1}, {-1, 0, 1, 2, 1}, {1, 1, 1, 1, 1});
  int of_one = 0, of_two = 0;
  for (const auto& s : found) {
    of_one += s.bone == 1;
    of_two += s.bone == 2;
  }
  EXPECT_EQ(of_one, 2);
  EXPECT_EQ(of_two, 1);
  // Where every only child lies on its axis, the joint ends on its own.
  const auto kept = segments_of({4, 5, 6, 7, 3}, {1, 0, 1, 1, 1}, {-1, 0, 1, 2, 1}, {1, 1, 1, 1, 1});
  EXPECT_EQ(kept.size(), 5u);
}

}  // namespace
