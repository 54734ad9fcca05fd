// The classic cases keep their volume, their smoothness and their triangles: dragged in 30 frames of 5 iterations,
// beside the paper's scheme.
#include <gtest/gtest.h>

#include "cases.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

struct Both {
  Quality smooth, paper;  // the paper's scheme solved to the end
};

Both measure_both(const Case& c) {
  Both both;
  const Dragged smooth = drag(c, {});
  both.smooth = measure(*smooth.core, positions(smooth.report));
  PoseOptions options;
  options.scheme = hf_test::scheme_of(hf_test::DeformMode::paper);
  Dragged paper = drag(c, options, 30, 100);
  paper.report = paper.pose->deform({false, 1000, false});
  both.paper = measure(*paper.core, positions(paper.report));
  for (const auto& entry : {std::make_pair("smooth", both.smooth), std::make_pair("paper", both.paper)}) {
    const Quality& q = entry.second;
    std::printf(
        "%-13s %-6s E %8.4f in %6.2f %% edges %.2f..%.2f volume %6.2f %% smallest stretch %.3f dihedral %5.1f "
        "roughness %.3f\n",
        c.name.c_str(), entry.first, q.energy, q.edge_share, q.edge_min, q.edge_max, c.closed ? q.volume : 0.0,
        q.smallest_stretch, q.dihedral_max, q.roughness);
  }
  return both;
}

TEST(Quality, ACylinderBends120DegreesWithoutBandsOrCollapse) {
  const Both q = measure_both(cylinder_bend());
  EXPECT_GE(q.smooth.edge_share, 99);
  EXPECT_LE(std::fabs(q.smooth.volume), 4);
  EXPECT_GE(q.smooth.smallest_stretch, 0.70);
  EXPECT_LE(q.smooth.dihedral_max, 8);
  EXPECT_LE(3 * q.smooth.roughness, q.paper.roughness);
  EXPECT_LE(1.1 * q.smooth.energy, q.paper.energy);
}

TEST(Quality, ABarTwists135DegreesWithoutACandyWrapper) {
  const Both q = measure_both(bar_twist(135));
  EXPECT_GE(q.smooth.edge_share, 99.99);
  EXPECT_GE(q.smooth.volume, -6);
  EXPECT_GE(q.smooth.smallest_stretch, 0.80);
  EXPECT_LE(q.smooth.dihedral_max, 22);
  EXPECT_LE(1.1 * q.smooth.energy, q.paper.energy);
}

TEST(Quality, ABarTwists180DegreesWithoutACandyWrapper) {
  const Both q = measure_both(bar_twist(180));
  EXPECT_GE(q.smooth.edge_share, 99.9);
  EXPECT_GE(q.smooth.volume, -10);
  EXPECT_GE(q.smooth.smallest_stretch, 0.80);
  EXPECT_LE(q.smooth.dihedral_max, 22);
  EXPECT_LE(1.1 * q.smooth.energy, q.paper.energy);
}

TEST(Quality, ACactusBends70DegreesAndItsArmsFollowUnharmed) {
  const Both q = measure_both(cactus_bend());
  EXPECT_GE(q.smooth.edge_share, 99.99);
  EXPECT_LE(std::fabs(q.smooth.volume), 2);
  EXPECT_GE(q.smooth.smallest_stretch, 0.80);
  EXPECT_LE(q.smooth.dihedral_max, 6);
  EXPECT_LE(3 * q.smooth.roughness, q.paper.roughness);
  EXPECT_LE(1.35 * q.smooth.energy, q.paper.energy);
}

TEST(Quality, ABumpyPlaneIsLiftedWithoutChimneyWalls) {
  const Both q = measure_both(plane_lift());
  EXPECT_GE(q.smooth.edge_share, 72);
  EXPECT_GE(q.smooth.smallest_stretch, 0.60);
  EXPECT_LE(q.smooth.dihedral_max, 106);
  EXPECT_LE(q.smooth.edge_max, 3.1);
  EXPECT_LE(1.8 * q.smooth.energy, q.paper.energy);
}

}  // namespace
