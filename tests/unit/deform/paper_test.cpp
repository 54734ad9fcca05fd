// The paper's scheme, piece by piece: shape matching of overlapping clusters finds a rigid motion exactly, rests there,
// and arrives there from elsewhere when its handles ask for it.
#include <gtest/gtest.h>

#include "cases.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

struct PaperRig {
  std::shared_ptr<const surface::Core> core;
  std::shared_ptr<Pose> pose;
  std::vector<std::uint32_t> handles;
  RigidMotion motion{about({1, 2, -1}, 0.7), {0.3, -0.2, 0.4}};  // in the mesh's own unit

  PaperRig() {
    const Case c = cactus_bend(70, 1800);
    core = hf_test::make_core(c.mesh);
    PoseOptions options;
    options.scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
    pose = Pose::make(core, options);
    handles = add(*pose, {select(*core, c.regions[0]), select(*core, c.regions[1])});
  }
  double off(Span<const Affine> transforms) const {
    double largest = 0;
    for (std::int32_t v = 0; v < core->size(); ++v) {
      const Vec3 x = blend_vertex(core->mesh, *pose->weights(), transforms.data(), v);
      largest = std::max(largest, norm(x - apply(motion, core->mesh.positions[v])));
    }
    return largest;
  }
};

// Section 5.2: linear bands between equal steps of the field.
TEST(PaperScheme, ItsBandsAreThoseOfThePaper) {
  const auto scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
  EXPECT_EQ(scheme->bands.degree, 1);
  EXPECT_EQ(scheme->bands.spacing, BandSpacing::equal_value);
}

TEST(PaperScheme, FindsARigidMotionOfTheSurfaceAndRestsThere) {
  const PaperRig rig;
  const ClusterWeights& weights = *rig.pose->weights();
  Memory& memory = *rig.core->memory;
  const peers::PaperSystem system(*rig.core, weights, memory);
  peers::PaperState state(memory);
  state.fit(system);
  std::vector<Vec3> moved;
  for (const Vec3& p : rig.core->mesh.positions) moved.push_back(apply(rig.motion, p));
  system.fit(rig.core->mesh, moved.data(), state);
  ASSERT_GT(state.motion.size(), 8u);
  for (const RigidMotion& found : state.motion) {
    EXPECT_LT(found.rotation.angularDistance(rig.motion.rotation), 1e-9);
    EXPECT_LT(norm(found.translation - rig.motion.translation), 1e-9);
  }
  // with the handles there too, nothing moves on
  std::vector<Affine> transforms(static_cast<std::size_t>(weights.cluster_count));
  const Mat3 r = rig.motion.rotation.toRotationMatrix();
  const double t[3] = {rig.motion.translation.x, rig.motion.translation.y, rig.motion.translation.z};
  for (std::int32_t h = 0; h < weights.handle_count; ++h) {
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) transforms[h].a[i][k] = r(i, k);
      transforms[h].a[i][3] = t[i];
    }
  }
  const SolveReport report = system.solve(rig.core->mesh, weights, 3, 0, state, transforms.data());
  EXPECT_LT(report.last_change, 1e-9);
  EXPECT_LT(rig.off({transforms.data(), transforms.size()}), 1e-9);
}

TEST(PaperScheme, ArrivesAtTheRigidMotionItsHandlesShare) {
  const PaperRig rig;
  for (const std::uint32_t handle : rig.handles) {
    const Vec3 centroid = rig.core->mesh.to_inner(rig.pose->handle(handle).centroid);
    place(*rig.pose, handle, {rig.motion.rotation, rig.core->mesh.scale * (apply(rig.motion, centroid) - centroid)});
  }
  rig.pose->deform({false, 1, false});
  const double after_one = rig.off(rig.pose->cluster_transforms());
  for (int i = 0; i < 2; ++i) rig.pose->deform({false, 1000, false});
  const double settled = rig.off(rig.pose->cluster_transforms());
  std::printf("paper's scheme, one rigid motion: off by %.1e after one iteration, %.1e in the end\n", after_one,
              settled);
  EXPECT_GT(after_one, 0.05);
  EXPECT_LT(settled, 0.05 * after_one);  // Jacobi: the motion travels one band an iteration
}

// A bar pulled along its axis: clusters move without turning, so only their translations tell that they are under way.
TEST(PaperScheme, AMotionWithoutTurnsIsNotTakenForRest) {
  const Case c = bar_twist(0, 8);
  const auto core = hf_test::make_core(c.mesh);
  PoseOptions options;
  options.scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
  const auto pose = Pose::make(core, options);
  add(*pose, {select(*core, c.regions[0]), select(*core, c.regions[1])});
  const ClusterWeights& weights = *pose->weights();
  const peers::PaperSystem system(*core, weights, *core->memory);
  peers::PaperState state(*core->memory);
  state.fit(system);
  const Affine rest{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}, pulled{{{1, 0, 0, 0}, {0, 1, 0, 5}, {0, 0, 1, 0}}};
  std::vector<Affine> transforms(static_cast<std::size_t>(weights.cluster_count), rest);
  transforms[1] = pulled;            // the upper handle
  constexpr double tolerance = 0.5;  // a turn of 20 degrees, half a box
  const SolveReport report = system.solve(core->mesh, weights, 2, tolerance, state, transforms.data());
  EXPECT_EQ(report.iterations, 2u);
  EXPECT_LT(report.last_change, tolerance);
}

}  // namespace
