// Handles that are added in place: the posed surface stays where it is, and goes over to the new pose as handles move.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "cases.h"
#include "deform/crossfade.h"
#include "deform/pose_stack.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;
using Surface = std::vector<Vec3>;

double largest_distance(const Surface& a, const Surface& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, norm(a[v] - b[v]));
  return largest;
}
bool same_bits(const Surface& a, const Surface& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

const Case& cactus() {
  static const Case scene = cactus_bend(70, 1800);
  return scene;
}
std::shared_ptr<const surface::Core> cactus_core() {
  static const std::shared_ptr<const surface::Core> core = hf_test::make_core(cactus().mesh);
  return core;
}

// A cactus that is bent while its arm gets a handle.
struct Plant {
  const Case& scene = cactus();
  std::shared_ptr<const surface::Core> core;
  std::shared_ptr<PoseStack> pose;
  std::vector<std::uint32_t> numbers{0, 0};
  double box;
  explicit Plant(hf_test::DeformMode mode = hf_test::DeformMode::smooth, std::uint32_t threads = 1)
      : core(threads == 1 ? cactus_core() : hf_test::make_core(scene.mesh, threads)), box(core->mesh.scale) {
    PoseOptions options;
    options.scheme = hf_test::scheme_of(mode);
    pose = PoseStack::make(core, options);
    for (int k = 0; k < 2; ++k) numbers[k] = add(select(*core, scene.regions[k]), false);
    bend(1);
  }
  std::uint32_t add(const std::vector<std::int32_t>& region, bool in_place, std::uint32_t layer = 0) {
    const std::uint32_t start[2] = {0, static_cast<std::uint32_t>(region.size())};
    std::uint32_t number = 0;
    pose->add_handles({start, 2}, region, layer, {&number, 1}, {in_place});
    return number;
  }
  std::uint32_t add_arm(bool in_place = true) {
    return add(select(*core, [](Vec3 p) { return p.x > 0.45 && p.y > 1.1; }), in_place);
  }
  void put(std::uint32_t handle, const HandleTransform& t) { pose->set_transforms({&handle, 1}, {&t, 1}); }
  void bend(double t) { put(numbers[1], scene.motion(1, t, pose->handle(numbers[1]).centroid)); }
  Surface frame(bool refine = false, bool restart = false) {
    DeformRequest request;
    request.refine = refine;
    request.restart = restart;
    const DeformReport report = pose->deform(request);
    return {report.positions.begin(), report.positions.end()};
  }
};

TEST(InPlace, TheSurfaceStaysAndTheHandleStandsWhereItsRegionDoes) {
  for (const bool refine : {false, true}) {
    for (const int frames : {1, 20}) {  // in a drag, and at rest
      Plant plant;
      Surface before;
      for (int f = 0; f < frames; ++f) before = plant.frame(refine);
      const std::uint32_t arm = plant.add_arm();
      const HandleTransform stands = plant.pose->placed(arm);
      EXPECT_GT(norm(stands.translation), 0.1 * plant.box);
      EXPECT_LT(largest_distance(plant.frame(refine), before), 1e-6 * plant.box);
      plant.put(arm, stands);  // what a host does in every frame; rounding makes it a motion, so the pose is solved
      EXPECT_LT(largest_distance(plant.frame(refine), before), 1e-4 * plant.box);
      Plant other;
      for (int f = 0; f < frames; ++f) other.frame(refine);
      const std::uint32_t moved = other.add_arm(false);
      other.put(moved, stands);
      EXPECT_GT(largest_distance(other.frame(refine), before), 2e-4 * plant.box);  // what it would jump
    }
  }
}

TEST(InPlace, HowMuchFollowsIsSetWhereTheSurfaceStands) {
  Plant plant;
  for (int f = 0; f < 20; ++f) plant.frame();
  const std::uint32_t arm = plant.add_arm();
  const Surface before = plant.frame();
  plant.pose->set_free_turns({&arm, 1}, true);
  plant.pose->set_following({&arm, 1}, 0.25);
  EXPECT_LT(largest_distance(plant.frame(), before), 1e-6 * plant.box);
  HandleTransform to = plant.pose->placed(arm);
  to.translation.z += 0.1 * plant.box;  // beyond the reach of what is left of the old surface
  plant.put(arm, to);
  const Surface moved = plant.frame();
  plant.pose->set_following({&arm, 1}, 1);
  EXPECT_GT(largest_distance(plant.frame(), moved), 1e-3 * plant.box);
}

TEST(InPlace, TheSurfaceGoesOverToTheNewPoseAsAHandleMoves) {
  Plant plant;
  for (int f = 0; f < 20; ++f) plant.frame();
  const std::uint32_t arm = plant.add_arm();
  HandleTransform to = plant.pose->placed(arm);
  Surface last = plant.frame(), now;
  const double step = 0.004 * plant.box;
  double largest = 0;
  for (int f = 0; f < 20; ++f) {
    to.translation.z += step;
    plant.put(arm, to);
    now = plant.frame();
    largest = std::max(largest, largest_distance(now, last));
    last = now;
  }
  EXPECT_LT(largest, 1.5 * step);
  // It has come farther than the reach: the handle is on its target to rounding.
  const auto region = select(*plant.core, [](Vec3 p) { return p.x > 0.45 && p.y > 1.1; });
  const Vec3 centroid = plant.pose->handle(arm).centroid;
  for (const std::int32_t v : region) {
    const Vec3 p = plant.core->mesh.to_given(plant.core->mesh.positions[v]);
    EXPECT_LT(norm(now[v] - (rotate(to.rotation, p - centroid) + centroid + to.translation)), 1e-12 * plant.box);
  }
}

TEST(InPlace, TheShareFallsSmoothlyWithTheWayAndTowardsRest) {
  Memory memory;
  Crossfade crossfade(1, memory);
  crossfade.placed.assign(2, RigidMotion());
  crossfade.placed[1] = {about({0, 0, 1}, 0.5), {0.1, 0, 0}};
  crossfade.from_rest = way_from_rest(crossfade.placed);
  EXPECT_NEAR(crossfade.from_rest, 0.1 + 0.5 * crossfade_turn, 1e-12);
  std::vector<RigidMotion> now(crossfade.placed.begin(), crossfade.placed.end());
  EXPECT_EQ(share_left(crossfade, now), 1);
  double last = 1;
  for (double way = 0.001; way < 1.2 * crossfade_reach; way += 0.001) {
    now[1].translation.y = way;
    const double share = share_left(crossfade, now);
    EXPECT_LE(share, last);
    EXPECT_LT(last - share, 0.05);
    last = share;
  }
  EXPECT_EQ(last, 0);
  now.assign(2, RigidMotion());
  EXPECT_EQ(share_left(crossfade, now), 0);
}

TEST(InPlace, RestartAndRemovalGiveTheBitsOfAPoseThatNeverHadIt) {
  Plant plant, other;
  for (int f = 0; f < 5; ++f) {
    plant.frame();
    other.frame();
  }
  const std::uint32_t arm = plant.add_arm();
  const HandleTransform stands = plant.pose->placed(arm);
  const Surface held = plant.frame();
  EXPECT_TRUE(same_bits(plant.pose->clone()->deform({}).positions.size() ? held : Surface(), held));
  const std::shared_ptr<PoseStack> copy = plant.pose->clone();
  const DeformReport copied = copy->deform({});
  EXPECT_TRUE(same_bits(Surface(copied.positions.begin(), copied.positions.end()), plant.frame()));
  plant.put(arm, stands);
  const Surface fresh = plant.frame(false, true);
  EXPECT_GT(largest_distance(fresh, held), 2e-4 * plant.box);
  Plant plain;
  const std::uint32_t same = plain.add_arm(false);
  plain.put(same, stands);
  EXPECT_TRUE(same_bits(plain.frame(false, true), fresh));
  const std::uint32_t again[1] = {arm};
  plant.pose->remove_handles({again, 1});
  EXPECT_TRUE(same_bits(plant.frame(), other.frame()));
}

TEST(InPlace, AtRestAndBeforeTheFirstFrameItIsAnOrdinaryHandle) {
  Plant plant;
  plant.bend(0);
  EXPECT_EQ(norm(plant.pose->placed(plant.add_arm()).translation), 0);  // no frame yet
  Plant other;
  other.bend(0);
  const Surface rest = other.frame();
  const std::uint32_t arm = other.add_arm();
  EXPECT_LT(norm(other.pose->placed(arm).translation), 1e-12 * other.box);
  EXPECT_LT(largest_distance(other.frame(), rest), 1e-12 * other.box);
}

TEST(InPlace, ThreadsDoNotChangeTheBitsAndThePapersModePlacesTheHandleOnly) {
  Plant one, three(hf_test::DeformMode::smooth, 3), paper(hf_test::DeformMode::paper);
  one.frame();
  three.frame();
  paper.frame();
  const std::uint32_t arm = one.add_arm(), other = three.add_arm(), third = paper.add_arm();
  EXPECT_TRUE(same_bits(one.frame(), three.frame()));
  HandleTransform to = one.pose->placed(arm);
  to.translation.x += 0.01;
  one.put(arm, to);
  three.put(other, to);
  EXPECT_TRUE(same_bits(one.frame(), three.frame()));
  EXPECT_GT(norm(paper.pose->placed(third).translation), 0.1 * paper.box);
}

}  // namespace
