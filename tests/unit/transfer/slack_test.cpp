// The slides of clusters, measured on a bar of two clusters whose motion is known.
#include "transfer/slack.h"

#include <gtest/gtest.h>

#include "transfer_support.h"

namespace {

using namespace transfer_test;
using hf_inner::Mat3;
using hf_inner::Vec3;
using hf_inner::deform::Quaternion;
using hf_inner::transfer::Slack;

// A square tube along x from -1 to 1. Cluster 1 takes over from cluster 0 between -0.2 and 0.4, or between two rings if
// it is coarse. Then no vertex belongs to both.
struct Bar {
  World world;
  std::shared_ptr<const hf_inner::surface::Core> core;
  std::vector<double> area;
  hf_inner::transfer::Clusters clusters{*world.memory};
  hf_inner::transfer::Translations translations{*world.memory};

  explicit Bar(bool coarse = false) {
    const int rings = 41;
    std::vector<glm::dvec3> positions;
    std::vector<uint32_t> triangles;
    for (int i = 0; i < rings; ++i)
      for (int k = 0; k < 4; ++k)
        positions.push_back({-1 + 2.0 * i / (rings - 1), k < 2 ? 0.1 : -0.1, k % 3 == 0 ? 0.1 : -0.1});
    for (int i = 0; i + 1 < rings; ++i) {
      for (int k = 0; k < 4; ++k) {
        const auto a = static_cast<uint32_t>(4 * i + k), b = static_cast<uint32_t>(4 * i + (k + 1) % 4);
        triangles.insert(triangles.end(), {a, b, a + 4, b, b + 4, a + 4});
      }
    }
    core = make_core(positions, triangles, world);
    const auto n = static_cast<size_t>(core->size());
    area.assign(n, 1.0 / static_cast<double>(n));
    clusters.count = 2;
    clusters.field_count = 1;
    for (size_t v = 0; v < n; ++v) {
      const double share = std::clamp((given(core->mesh.positions[v]).x + 0.2) / 0.6, 0.0, 1.0);
      const auto far = static_cast<float>(coarse ? std::round(share) : std::floor(share * 1024) / 1024);
      for (int k = 0; k < hf_inner::transfer::blend_count; ++k) {
        clusters.joint.push_back(k == 1 ? 1 : 0);
        clusters.weight.push_back(k == 0 ? 1 - far : k == 1 ? far : 0.0f);
      }
    }
    clusters.pivot.assign(2, Vec3());
    clusters.centre.assign(2, 0.5);
    clusters.mass.assign(2, 0.5);
    translations.prepare(*core, {area.data(), area.size()}, clusters, {}, {}, {});
  }
  Vec3 given(Vec3 inner) const { return core->mesh.to_given(inner); }
  Slack slack(double scale) {
    Slack out(*world.memory);
    const Slack::Side side{core.get(), {area.data(), area.size()}, clusters.joint.data(), clusters.weight.data()};
    const hf_inner::transfer::Overlaps overlaps = hf_inner::transfer::overlaps_of(2, side, *world.memory);
    out.prepare(side, overlaps, overlaps, translations, Mat3::Identity(), scale, *world.memory);
    return out;
  }
  std::vector<Vec3> pose(const Quaternion (&turn)[2], const Vec3 (&shift)[2]) const {
    std::vector<Vec3> out;
    for (size_t v = 0; v < area.size(); ++v) {
      Vec3 place;
      for (size_t i = v * hf_inner::transfer::blend_count; i < (v + 1) * hf_inner::transfer::blend_count; ++i) {
        const auto c = static_cast<size_t>(clusters.joint[i]);
        place = place + static_cast<double>(clusters.weight[i]) *
                            (turn[c].toRotationMatrix() * core->mesh.positions[v] + shift[c]);
      }
      out.push_back(place);
    }
    return out;
  }
  Vec3 slide(const Quaternion (&turn)[2], const std::vector<Vec3>& posed, double scale = 1) {
    Slack slack = this->slack(scale);
    EXPECT_EQ(slack.pairs().size(), 1u);
    slack.measure(turn, posed.data(), Quaternion(), *world.jobs);
    const Vec3 sum = slack.forces()[0] + slack.forces()[1];
    EXPECT_LT(hf_inner::norm(sum), 1e-12) << "forces between two clusters are opposite";
    return slack.slides()[0];
  }
};

const Quaternion bent[2] = {Quaternion(), hf_inner::deform::exponential({0, 0, 0.8})};

TEST(TransferSlack, ATurnAboutAnotherPointIsTheSlideThatWasPutIn) {
  Bar bar;
  const Mat3 turn = bent[1].toRotationMatrix();
  // the overlap's middle is at 0.1; the joint lies a little before it, and above
  const Vec3 middle = bar.slack(1).pairs()[0].overlap_point;
  for (const Vec3 off : {Vec3{-0.03, 0.02, 0}, Vec3{0.02, -0.04, 0.01}, Vec3{0, 0, 0}}) {
    const Vec3 joint = middle + off;
    const Vec3 shift[2] = {Vec3(), joint - turn * joint};
    const Vec3 expected = (middle - joint) - turn * (middle - joint);
    const Vec3 found = bar.slide(bent, bar.pose(bent, shift));
    // the soft limit takes 0.2 % away here, the ridge of the fit 0.1 %
    EXPECT_LT(hf_inner::norm(found - expected), 0.005 * hf_inner::norm(expected) + 1e-9);
    const Vec3 doubled = bar.slide(bent, bar.pose(bent, shift), 2);
    // on a target of the same size, twice the scale says that the bodies are not alike, and only a quarter of it counts
    EXPECT_LT(hf_inner::norm(doubled - 0.5 * found), 1e-9);
  }
}

TEST(TransferSlack, WhereTheBodyIsDoesNotMatter) {
  Bar bar;
  const Vec3 shift[2] = {Vec3(), Vec3{0.05, -0.02, 0.03}};
  const std::vector<Vec3> posed = bar.pose(bent, shift);
  std::vector<Vec3> moved = posed;
  for (Vec3& p : moved) p = p + Vec3{70, -20, 40};
  EXPECT_LT(hf_inner::norm(bar.slide(bent, posed) - bar.slide(bent, moved)), 1e-9);
}

TEST(TransferSlack, RigidMotionsAndStretchHaveNone) {
  Bar bar;
  const Quaternion same[2] = {bent[1], bent[1]}, none[2] = {Quaternion(), Quaternion()};
  const Vec3 shift[2] = {Vec3{1, 2, 3}, Vec3{1, 2, 3}};
  EXPECT_LT(hf_inner::norm(bar.slide(same, bar.pose(same, shift))), 1e-12);
  std::vector<Vec3> doubled;
  for (const Vec3& p : bar.core->mesh.positions) doubled.push_back(2.0 * p);
  EXPECT_LT(hf_inner::norm(bar.slide(none, doubled)), 1e-12);
}

// Two rigid halves that only edges tie: played on itself, the bar takes its own pose.
TEST(TransferSlack, ClustersWithoutACommonVertexSlideToo) {
  Bar bar(true);
  const Mat3 turn[2] = {bent[0].toRotationMatrix(), bent[1].toRotationMatrix()};
  const Vec3 shift[2] = {Vec3(), Vec3{0.01, -0.05, 0.02}};
  const std::vector<Vec3> posed = bar.pose(bent, shift);
  Slack slack = bar.slack(1);
  ASSERT_EQ(slack.pairs().size(), 1u);
  slack.measure(bent, posed.data(), Quaternion(), *bar.world.jobs);
  Vec3 centroid, found[2];
  for (size_t v = 0; v < posed.size(); ++v) centroid = centroid + bar.area[v] * posed[v];
  bar.translations.solve(bar.clusters, turn, {}, centroid, shift, slack.forces(), found);
  // without slides the halves meet in the middle between the rings, 0.06 away
  EXPECT_LT(hf_inner::norm(found[1] - found[0] - (shift[1] - shift[0])), 0.001);
}

TEST(TransferSlack, ClustersThatDoNotCorrespondGetLess) {
  Bar bar;
  const Slack::Side side{
      bar.core.get(), {bar.area.data(), bar.area.size()}, bar.clusters.joint.data(), bar.clusters.weight.data()};
  const hf_inner::transfer::Overlaps overlaps = hf_inner::transfer::overlaps_of(2, side, *bar.world.memory);
  const auto factor = [&](const Vec3& axis, double angle) {
    Slack slack(*bar.world.memory);
    slack.prepare(side, overlaps, overlaps, bar.translations,
                  hf_inner::deform::exponential(angle * axis).toRotationMatrix(), 1, *bar.world.memory);
    return slack.pairs().empty() ? 0.0 : slack.pairs()[0].factor;
  };
  EXPECT_NEAR(factor({0, 0, 1}, 0), 1, 1e-9);
  EXPECT_NEAR(factor({0, 0, 1}, 0.5), std::pow(std::cos(0.5), 4), 1e-6);
  EXPECT_EQ(factor({0, 0, 1}, 2.0), 0.0);
}

}  // namespace
