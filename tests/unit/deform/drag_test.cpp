// Dragging: turns beyond 180 degrees are kept, the way back leads back, nothing is allocated, threads do not matter.
#include <gtest/gtest.h>

#include <cstring>

#include "cases.h"
#include "support/full.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

// Turn of the surface from the lower to the upper end, section by section, in degrees.
double total_twist(const surface::Core& core, Span<const Vec3> x) {
  std::map<long, std::vector<std::int32_t>> sections;
  for (std::int32_t v = 0; v < core.size(); ++v)
    sections[std::lround(1e4 * core.mesh.to_given(core.mesh.positions[v]).y)].push_back(v);
  double total = 0, last = 0;
  bool first = true;
  for (const auto& section : sections) {
    double sine = 0, cosine = 0;
    Vec3 centre, posed_centre;
    for (const std::int32_t v : section.second) {
      centre = centre + core.mesh.to_given(core.mesh.positions[v]);
      posed_centre = posed_centre + x[v];
    }
    const double scale = 1.0 / static_cast<double>(section.second.size());
    for (const std::int32_t v : section.second) {
      const Vec3 a = core.mesh.to_given(core.mesh.positions[v]) - scale * centre, b = x[v] - scale * posed_centre;
      sine += a.z * b.x - a.x * b.z;
      cosine += a.x * b.x + a.z * b.z;
    }
    const double angle = std::atan2(sine, cosine);
    if (!first) total += std::remainder(angle - last, 2 * pi);
    last = angle;
    first = false;
  }
  return total * 180 / pi;
}

TEST(Drag, ATwistOf450DegreesIsKept) {
  for (const double degrees : hf_test::quick_and_full<double>({450}, {180, 360, 540})) {
    for (const int frames : {30, 90}) {
      const Case c = bar_twist(degrees, 10);
      Dragged d = drag(c, {}, frames, 5);
      const double dragged = total_twist(*d.core, d.report.positions);
      // held still, then held by a trembling hand
      for (int i = 0; i < 20; ++i) d.report = d.pose->deform({});
      const double held = total_twist(*d.core, d.report.positions);
      for (int i = 0; i < 300; ++i) {
        place(*d.pose, d.handles[1], {about({1e-3 * std::sin(i), 1, 0}, degrees * pi / 180), {}});
        d.report = d.pose->deform({});
      }
      const double trembled = total_twist(*d.core, d.report.positions);
      const Quality q = measure(*d.core, positions(d.report));
      std::printf("twist %.0f in %d frames: %.2f, held %.2f, trembling %.2f, volume %.1f %%, smallest stretch %.2f\n",
                  degrees, frames, dragged, held, trembled, q.volume, q.smallest_stretch);
      EXPECT_NEAR(dragged, degrees, 0.01);
      EXPECT_NEAR(held, degrees, 0.01);
      EXPECT_NEAR(trembled, degrees, 0.5);
      EXPECT_GT(q.smallest_stretch, 0.2);
    }
  }
}

TEST(Drag, RestartForgetsWholeTurns) {
  const Case c = bar_twist(360, 8);
  Dragged d = drag(c, {}, 30, 5);
  EXPECT_NEAR(total_twist(*d.core, d.report.positions), 360, 0.01);
  EXPECT_LT(largest_distance(positions(d.pose->deform({false, 20, true})), rest(*d.core)), 1e-9);
}

TEST(Drag, OutAndBackLeadsBackToRest) {
  for (const int mode : {0, 1}) {
    for (const Case& c : {cactus_bend(70, 4000), cylinder_bend(120, 8, 80), bar_twist(180, 10)}) {
      PoseOptions options;
      options.scheme = hf_test::scheme_of(static_cast<hf_test::DeformMode>(mode));
      const std::uint32_t iterations = options.scheme ? options.scheme->default_iterations : default_pose_iterations;
      Dragged d = drag(c, options, 30, iterations);
      const std::vector<Vec3> held = positions(d.report);
      for (int i = 0; i < 20; ++i) d.report = d.pose->deform({false, iterations, false});
      const double crept = largest_distance(positions(d.report), held) / d.core->mesh.scale;
      for (int frame = 29; frame >= 0; --frame) {
        move_to(c, d, frame / 30.0);
        d.report = d.pose->deform({false, iterations, false});
      }
      const double off = largest_distance(positions(d.report), rest(*d.core)) / d.core->mesh.scale;
      for (int i = 0; i < 20; ++i) d.report = d.pose->deform({false, iterations, false});
      const double settled = largest_distance(positions(d.report), rest(*d.core)) / d.core->mesh.scale;
      std::printf("%s, mode %d: creeps %.1e, out and back %.1e, settled %.1e of the box\n", c.name.c_str(), mode, crept,
                  off, settled);
      EXPECT_LT(crept, 2e-4);
      EXPECT_LT(off, 1e-3);
      EXPECT_LT(settled, 1e-6);
    }
  }
}

TEST(Drag, AThousandFramesAllocateNothing) {
  for (const int mode : {0, 1}) {
    const Case c = cactus_bend(70, 1500);
    PoseOptions options;
    options.scheme = hf_test::scheme_of(static_cast<hf_test::DeformMode>(mode));
    Dragged d = set_up(c, options);
    d.pose->deform({true, 5, false});
    const std::uint64_t before = d.core->memory->allocation_count();
    for (int frame = 0; frame < 1000; ++frame) {
      move_to(c, d, std::fabs(std::sin(0.01 * frame)));
      d.pose->deform({true, 5, frame % 100 == 99});
    }
    EXPECT_EQ(d.core->memory->allocation_count(), before);
  }
}

TEST(Drag, BitsDoNotDependOnTheNumberOfThreads) {
  for (const int mode : {0, 1}) {
    std::vector<Vec3> first;
    std::vector<Normal> first_normals;
    for (const std::uint32_t threads : {1u, 2u, 4u}) {
      const Case c = cactus_bend(70, 9000);
      PoseOptions options;
      options.scheme = hf_test::scheme_of(static_cast<hf_test::DeformMode>(mode));
      Dragged d = drag(c, options, 10, 5, threads);
      d.report = d.pose->deform({true, 5, false});
      const std::vector<Vec3> x = positions(d.report);
      const std::vector<Normal> n(d.report.normals.begin(), d.report.normals.end());
      if (threads == 1) {
        first = x;
        first_normals = n;
      } else {
        EXPECT_EQ(std::memcmp(x.data(), first.data(), x.size() * sizeof(Vec3)), 0);
        EXPECT_EQ(std::memcmp(n.data(), first_normals.data(), n.size() * sizeof(Normal)), 0);
      }
    }
  }
}

}  // namespace
