// Poses that move to edited surfaces: each frame against a new pose on a surface made with the same stiffness.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cases.h"
#include "deform/pose_stack.h"
#include "support/full.h"
#include "support/parts.h"
#include "surface/edited_core.h"
#include "surface/link_change.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;
using Surface = std::vector<Vec3>;
using Region = std::vector<std::int32_t>;
using Stiffness = std::shared_ptr<const Vector<double>>;

constexpr double always_rows = 1e9;  // small meshes would be factorised again

// A beam along x from 0 to 3, and a blade beside it that no link holds. Vertices are moved at random: on a regular mesh
// bands end exactly at vertices, and rounding decides whether two pieces of a band are one.
std::shared_ptr<const surface::Core> beam_and_blade() {
  static const std::shared_ptr<const surface::Core> core = [] {
    hf_test::PlainMesh mesh = hf_test::box(14, {3, 0.4, 0.4}, {0, 0, 0});
    hf_test::append(mesh, hf_test::box(10, {1.8, 0.1, 0.25}, {0, 0.45, 0.07}), 0.9);
    std::mt19937 random(3);
    for (double& x : mesh.positions) x += std::uniform_real_distribution<double>(-0.006, 0.006)(random);
    return hf_test::make_core(mesh);
  }();
  return core;
}

// What a pose has beside its handles.
struct Options {
  bool layer = false, free = false, following = false, limb = false, rigid = false;
};

class Moves : public ::testing::Test {
 protected:
  double number(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  std::int32_t below(std::int32_t limit) { return std::uniform_int_distribution<std::int32_t>(0, limit - 1)(random_); }

  // A stroke of 1e-3 to 1e4 over the vertices about one of them.
  Stiffness stroke(const Stiffness& before) {
    const auto out =
        std::make_shared<Vector<double>>(static_cast<std::size_t>(plain_->size()), 1.0, plain_->memory.get());
    if (before) std::copy(before->begin(), before->end(), out->begin());
    const double s = std::pow(10.0, number(-3, 4)), radius = number(0.03, 0.12);
    const Vec3 centre = plain_->mesh.positions[below(plain_->size())];
    for (std::int32_t v = 0; v < plain_->size(); ++v)
      if (norm(plain_->mesh.positions[v] - centre) < radius) (*out)[v] = s;
    return out;
  }
  std::shared_ptr<const surface::Geometry> with_link(const surface::Core& from) {
    const mesh::Mesh& mesh = plain_->mesh;
    mesh::Link link;
    do {
      link.vertex = below(mesh.vertex_count());
      link.corner[0] = below(mesh.vertex_count());
    } while (mesh.component[link.vertex] == mesh.component[link.corner[0]]);
    link.share[0] = 1;
    link.weight = number(0.5, 20);
    const std::size_t present = from.geometry->links ? from.geometry->links->links.size() : 0;
    const std::vector<std::uint8_t> removed(present, number(0, 1) < 0.3);
    return surface::Geometry::relinked(
        from.geometry,
        surface::edited_links(mesh, from.geometry->links.get(), {removed.data(), present}, {&link, 1}, *from.memory));
  }
  std::shared_ptr<PoseStack> pose_on(std::shared_ptr<const surface::Core> core, const Options& options) {
    const auto pose = PoseStack::make(core, {});
    numbers_.clear();
    const auto add = [&](const std::function<bool(Vec3)>& inside, std::uint32_t layer = 0, bool free = false) {
      const Region region = select(*core, inside);
      const std::uint32_t start[2] = {0, static_cast<std::uint32_t>(region.size())};
      std::uint32_t number = 0;
      pose->add_handles({start, 2}, region, layer, {&number, 1}, {false, free});
      numbers_.push_back(number);
    };
    add([](Vec3 p) { return p.x < 0.3 && p.y < 0.42; });
    add([](Vec3 p) { return p.x > 2.7 && p.y < 0.42; }, 0, options.free);
    add([](Vec3 p) { return std::fabs(p.x - 1.5) < 0.15 && p.y > 0.35 && p.y < 0.42; });
    if (options.layer) add([](Vec3 p) { return std::fabs(p.x - 2.2) < 0.12 && p.y < 0.1; }, 1);
    if (options.following) pose->set_following({&numbers_[2], 1}, 0.3);
    if (options.limb) pose->set_limb_steps({&numbers_[1], 1}, 2);
    if (options.rigid) pose->set_rigid_pieces(select(*core, [](Vec3 p) { return p.y > 0.42; }));
    place(*pose, 1);
    return pose;
  }
  // Places the handles at t of their way.
  void place(PoseStack& pose, double t) const {
    const HandleTransform moved[4] = {{},
                                      {about({0, 1, 0.4}, 0.5 * t), {-0.1 * t, 0.35 * t, 0.2 * t}},
                                      {about({1, 0, 0}, 0.1 * t), {0, 0.06 * t, 0}},
                                      {about({0, 0, 1}, 0.2 * t), {0, -0.05 * t, 0}}};
    for (std::size_t i = 0; i < numbers_.size(); ++i) pose.set_transforms({&numbers_[i], 1}, {&moved[i], 1});
  }
  static Surface frame(PoseStack& pose, bool restart, std::uint32_t iterations = 1000) {
    DeformRequest request;
    request.restart = restart;
    request.iteration_count = iterations;
    DeformReport report = pose.deform(request);
    for (int k = 0; k < 3; ++k) {
      request.restart = false;
      report = pose.deform(request);
    }
    return {report.positions.begin(), report.positions.end()};
  }
  double distance(const Surface& a, const Surface& b) const {
    double most = 0;
    for (std::size_t v = 0; v < a.size(); ++v) most = std::max(most, norm(a[v] - b[v]) / plain_->mesh.scale);
    return most;
  }
  // Moves a pose through random edits, and compares it with new poses.
  void expect_new_poses(const Options& options, int moves, bool links, double tolerance) {
    const auto pose = pose_on(plain_, options);
    frame(*pose, false);
    std::shared_ptr<const surface::Core> core = plain_;
    double worst = 0, worst_field = 0;
    for (int k = 0; k < moves; ++k) {
      if (k % 5 == 4) {
        core = plain_;
      } else {
        surface::SurfaceEdit edit(core->stiffness, nullptr);
        if (!links || k % 2 == 0) edit.stiffness = stroke(core->stiffness);
        if (links && k % 3 != 1) edit.geometry = with_link(*core);
        core = surface::edit_core(core, edit, k % 4 == 3 ? 1 : always_rows);
      }
      pose->move_to(core);
      surface::CoreOptions anew;
      anew.stiffness = core->stiffness;
      const auto fresh = pose_on(surface::Core::make(core->geometry, anew), options);
      for (const std::uint32_t number : numbers_) {
        const auto a = pose->field(number), b = fresh->field(number);
        for (std::int32_t v = 0; v < core->size(); ++v) worst_field = std::max(worst_field, std::fabs(a[v] - b[v]));
      }
      const double off = distance(frame(*pose, true), frame(*fresh, true));
      EXPECT_LT(off, tolerance) << "move " << k;
      worst = std::max(worst, off);
    }
    EXPECT_LT(worst_field, 1e-8);
    std::printf("fields within %.1e, surfaces within %.1e of the box\n", worst_field, worst);
  }

  std::mt19937 random_{7};
  std::shared_ptr<const surface::Core> plain_ = beam_and_blade();
  std::vector<std::uint32_t> numbers_;
};

TEST_F(Moves, StrokesGiveTheFramesOfNewPoses) { expect_new_poses({}, 12, false, 1e-6); }
TEST_F(Moves, LinksGiveTheFramesOfNewPoses) { expect_new_poses({}, 12, true, 1e-6); }
TEST_F(Moves, LayersGiveTheFramesOfNewPoses) {
  Options options;
  options.layer = true;
  expect_new_poses(options, 6, true, 1e-6);
}
TEST_F(Moves, FreeHandlesGiveTheFramesOfNewPoses) {
  Options options;
  options.free = true;
  expect_new_poses(options, 8, false, 1e-5);
}
TEST_F(Moves, FollowingGivesTheFramesOfNewPoses) {
  Options options;
  options.following = true;
  expect_new_poses(options, 8, false, 1e-6);
}
TEST_F(Moves, LimbsGiveTheFramesOfNewPoses) {
  Options options;
  options.limb = true;
  expect_new_poses(options, 6, false, 1e-6);
}
TEST_F(Moves, RigidPiecesGiveTheFramesOfNewPoses) {
  Options options;
  options.rigid = true;
  expect_new_poses(options, 6, false, 1e-6);
}

// A stroke that changes next to nothing moves next to nothing: no pose starts anew, or falls into another rest.
TEST_F(Moves, AFaintStrokeMovesNothing) {
  for (const bool free : {false, true}) {
    for (const bool following : {false, true}) {
      if (free != following && !hf_test::is_full()) continue;
      Options options;
      options.free = free;
      options.following = following;
      const auto pose = pose_on(plain_, options);
      for (int k = 1; k <= 20; ++k) {
        place(*pose, 0.05 * k);
        frame(*pose, false, 10);
      }
      const Surface before = frame(*pose, false);
      const auto stiffness =
          std::make_shared<Vector<double>>(static_cast<std::size_t>(plain_->size()), 1.0, plain_->memory.get());
      for (std::int32_t v = 0; v < plain_->size(); v += 3) (*stiffness)[v] = 1 + 1e-9;
      const auto core = surface::edit_core(plain_, {stiffness, nullptr}, always_rows);
      pose->move_to(core);
      EXPECT_LT(distance(frame(*pose, false, 1), before), 1e-6) << free << following;
      EXPECT_LT(distance(frame(*pose, false), before), 1e-6) << free << following;
      pose->move_to(plain_);
      EXPECT_LT(distance(frame(*pose, false), before), 1e-6) << free << following;
    }
  }
}

}  // namespace
