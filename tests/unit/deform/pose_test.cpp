// Handles land on their targets, rest and rigid motions come back, handles come and go, nothing is left half done.
#include "deform/pose.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>

#include "base/error.h"
#include "cases.h"
#include "deform/normals.h"
#include "support/pose_modes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;

struct RandomMotion {
  std::mt19937 engine;
  std::normal_distribution<double> normal;
  explicit RandomMotion(unsigned seed) : engine(seed) {}
  Vec3 vector(double size) { return {size * normal(engine), size * normal(engine), size * normal(engine)}; }
  HandleTransform transform(double angle, double distance) { return {exponential(vector(angle)), vector(distance)}; }
};

hf_result code_of(const std::function<void()>& call, std::uint32_t* index = nullptr) {
  try {
    call();
  } catch (const Error& error) {
    if (index) *index = error.index();
    return error.code();
  }
  return HF_OK;
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

bool all_finite(const DeformReport& report) {
  for (const Vec3& x : report.positions) {
    if (!std::isfinite(x.x + x.y + x.z)) return false;
  }
  for (const Normal& n : report.normals) {
    if (!(std::fabs(norm(to_vec3(n)) - 1) < 2e-7)) return false;
  }
  return true;
}

class Modes : public ::testing::TestWithParam<int> {
 protected:
  PoseOptions options() const {
    PoseOptions o;
    o.scheme = hf_test::scheme_of(static_cast<hf_test::DeformMode>(GetParam()));
    return o;
  }
};
INSTANTIATE_TEST_SUITE_P(SmoothAndPaper, Modes, ::testing::Values(0, 1));

TEST_P(Modes, HandlesLandExactlyOnTheirTargets) {
  const auto core = hf_test::make_core(cactus(2000));
  const auto pose = Pose::make(core, options());
  const std::vector<std::vector<std::int32_t>> regions{select(*core, [](Vec3 p) { return p.y < 0.1; }),
                                                       select(*core, [](Vec3 p) { return p.x > 0.45 && p.y > 1.1; }),
                                                       select(*core, [](Vec3 p) { return p.y > 1.75; }),
                                                       {core->size() / 2}};
  const auto numbers = add(*pose, regions);
  RandomMotion random(5);
  for (int round = 0; round < 20; ++round) {
    std::vector<HandleTransform> transforms;
    for (const std::uint32_t n : numbers) {
      transforms.push_back(random.transform(1.5, 0.5));
      place(*pose, n, transforms.back());
    }
    const DeformReport report = pose->deform({});
    EXPECT_TRUE(all_finite(report));
    EXPECT_GE(report.iteration_count, 1u);
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const Vec3 centroid = pose->handle(numbers[i]).centroid;
      for (const std::int32_t v : regions[i]) {
        const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
        const Vec3 target = rotate(transforms[i].rotation, p - centroid) + centroid + transforms[i].translation;
        EXPECT_LT(norm(report.positions[v] - target), 1e-12 * core->mesh.scale);
      }
    }
  }
}

TEST_P(Modes, IdentityTransformsGiveTheRestPositionsBack) {
  const Case c = cactus_bend(70, 3000);
  Dragged d = set_up(c, options());
  EXPECT_LT(largest_distance(positions(d.pose->deform({})), rest(*d.core)), 1e-10 * d.core->mesh.scale);
  EXPECT_LT(largest_distance(positions(d.pose->deform({false, 50, false})), rest(*d.core)), 1e-10 * d.core->mesh.scale);
}

TEST(Pose, TheSameRigidMotionOnAllHandlesMovesTheWholeSurface) {
  for (const int handle_count : {2, 3, 5}) {
    const auto core = hf_test::make_core(cactus(3000));
    const auto pose = Pose::make(core, {});
    std::vector<std::vector<std::int32_t>> regions;
    for (int k = 0; k < handle_count; ++k)
      regions.push_back(
          select(*core, [&](Vec3 p) { return p.y > 1.8 * k / handle_count && p.y < 1.8 * k / handle_count + 0.08; }));
    const auto numbers = add(*pose, regions);
    RandomMotion random(9);
    double largest = 0;
    for (int round = 0; round < 20; ++round) {
      const HandleTransform motion = random.transform(1.2, 3);
      for (const std::uint32_t n : numbers) {
        // about the origin: R p + t = R (p - c) + c + (R c - c + t)
        const Vec3 centroid = pose->handle(n).centroid;
        place(*pose, n, {motion.rotation, rotate(motion.rotation, centroid) - centroid + motion.translation});
      }
      const DeformReport report = pose->deform({});
      for (std::int32_t v = 0; v < core->size(); ++v) {
        const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
        largest = std::max(
            largest, norm(report.positions[v] - rotate(motion.rotation, p) - motion.translation) / core->mesh.scale);
      }
    }
    std::printf("rigid motion, %d handles: %.1e of the box\n", handle_count, largest);
    EXPECT_LT(largest, 1e-9);
  }
}

TEST(Pose, ConvergesInAFewIterationsFromTheFields) {
  for (const Case& c : {plane_lift(61), cylinder_bend(120, 8, 80), bar_twist(135, 10), cactus_bend(70, 3000)}) {
    Dragged d = set_up(c, {});
    move_to(c, d, 1);
    const std::vector<Vec3> p = rest(*d.core);
    const DeformReport three = d.pose->deform({false, 3, true});
    EXPECT_EQ(three.iteration_count, 3u);
    const double early = arap_energy(*d.core, p, positions(three));
    const DeformReport many = d.pose->deform({false, 200, true});
    const double late = arap_energy(*d.core, p, positions(many));
    std::printf("%s: energy %.4f after 3, %.4f after %u iterations (last change %.1e)\n", c.name.c_str(), early, late,
                many.iteration_count, many.last_change);
    EXPECT_LT(early, 1.03 * late);
    EXPECT_LT(many.last_change, 2e-4);
  }
}

TEST_P(Modes, ASettledPoseIsNotSolvedAgain) {
  Dragged d = set_up(cactus_bend(70, 1500), options());
  std::uint32_t iterations = 1;
  for (int i = 0; i < 60 && iterations; ++i) iterations = d.pose->deform({}).iteration_count;
  EXPECT_EQ(iterations, 0u);
  const std::vector<Vec3> before = positions(d.pose->deform({}));
  EXPECT_TRUE(same_bits(before, positions(d.pose->deform({}))));
}

TEST_P(Modes, AddingAndRemovingHandlesRestoresThePoseBitForBit) {
  const Case c = cactus_bend(70, 2000);
  Dragged a = set_up(c, options()), b = set_up(c, options());
  for (int frame = 1; frame <= 5; ++frame) {
    move_to(c, a, 0.2 * frame);
    move_to(c, b, 0.2 * frame);
    a.pose->deform({});
    b.pose->deform({});
  }
  const auto arm = select(*b.core, [](Vec3 p) { return p.x > 0.45 && p.y > 1.1; });
  const auto added = add(*b.pose, {arm, {b.core->size() / 3}});
  place(*b.pose, added[0], {about({1, 0, 0}, 0.4), {0, 0.1, 0}});
  b.pose->deform({});
  b.pose->remove_handles(added);
  EXPECT_EQ(b.pose->handle_count(), 2u);
  EXPECT_TRUE(same_bits(positions(a.pose->deform({})), positions(b.pose->deform({}))));
  // and with a handle moved while the others were there
  const auto again = add(*b.pose, {arm});
  move_to(c, a, 0.8);
  move_to(c, b, 0.8);
  b.pose->deform({});
  b.pose->remove_handles(again);
  EXPECT_TRUE(same_bits(positions(a.pose->deform({})), positions(b.pose->deform({}))));
}

TEST(Pose, RemovingOlderHandlesLeavesAPoseLikeAFreshOne) {
  const Case c = cactus_bend(70, 2000);
  Dragged d = set_up(c, {});
  const auto arm = select(*d.core, [](Vec3 p) { return p.x > 0.45 && p.y > 1.1; });
  const auto added = add(*d.pose, {arm});
  d.pose->deform({});
  d.pose->remove_handles({&d.handles[1], 1});
  EXPECT_EQ(add(*d.pose, {{d.core->size() / 3}})[0], d.handles[1]) << "numbers are used again";
  d.pose->remove_handles({&d.handles[1], 1});
  const auto fresh = Pose::make(d.core, {});
  const auto numbers = add(*fresh, {select(*d.core, c.regions[0]), arm});
  for (std::int32_t v = 0; v < d.core->size(); ++v) EXPECT_EQ(d.pose->field(added[0])[v], fresh->field(numbers[1])[v]);
  const HandleTransform turn{about({0, 0, 1}, 0.5), {0.1, 0.2, 0}};
  place(*d.pose, added[0], turn);
  place(*fresh, numbers[1], turn);
  EXPECT_TRUE(same_bits(positions(d.pose->deform({false, 100, true})), positions(fresh->deform({false, 100, true}))));
  d.pose->remove_handles(std::vector<std::uint32_t>{d.handles[0], added[0]});
  EXPECT_EQ(d.pose->handle_count(), 0u);
  EXPECT_EQ(code_of([&] { d.pose->deform({}); }), HF_ERROR_EMPTY);
}

TEST(Pose, CloneGoesItsOwnWayFromTheSamePose) {
  const Case c = cactus_bend(70, 1500);
  Dragged d = set_up(c, {});
  move_to(c, d, 0.5);
  d.pose->deform({});
  const auto copy = d.pose->clone();
  EXPECT_EQ(copy->handle_count(), 2u);
  EXPECT_TRUE(same_bits(positions(d.pose->deform({})), positions(copy->deform({}))));
  place(*copy, d.handles[1], {});
  copy->deform({false, 100, false});
  const std::vector<Vec3> mine = positions(d.pose->deform({}));
  EXPECT_GT(largest_distance(mine, positions(copy->deform({}))), 0.1);
  d.pose.reset();
  EXPECT_TRUE(all_finite(copy->deform({true, 0, false})));
}

TEST(Pose, NormalsAreAreaWeightedAndOfUnitLength) {
  const auto core = hf_test::make_core(plain(samples::sphere(20)));
  const auto pose = Pose::make(core, {});
  const auto number = add(*pose, {select(*core, [](Vec3 p) { return p.y > 0.9; })})[0];
  const Quaternion turn = about({1, 2, 3}, 0.7);
  place(*pose, number, {turn, {5, 0, 0}});
  const DeformReport report = pose->deform({true, 0, false});
  ASSERT_EQ(report.normals.size(), static_cast<std::size_t>(core->size()));
  for (std::int32_t v = 0; v < core->size(); ++v) {
    const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
    EXPECT_GT(dot(to_vec3(report.normals[v]), rotate(turn, p)), 0.9995);
    EXPECT_NEAR(norm(to_vec3(report.normals[v])), 1, 2e-7);
  }
}

TEST_P(Modes, ComponentsWithOneHandleMoveRigidlyAndThoseWithoutStay) {
  hf_test::PlainMesh mesh = plain(samples::sphere(5));
  for (int k = 1; k < 12; ++k) hf_test::append(mesh, plain(samples::sphere(3)), 3 * k);
  const auto core = hf_test::make_core(mesh);
  const auto pose = Pose::make(core, options());
  // one handle on two components, another on one of them too
  const auto numbers = add(*pose, {select(*core, [](Vec3 p) { return p.y > 0.8 && p.x < 4; }),
                                   select(*core, [](Vec3 p) { return p.y < -0.8 && p.x > 2 && p.x < 4; })});
  const HandleTransform motion{about({0, 1, 1}, 0.8), {0, 4, 0}};
  place(*pose, numbers[0], motion);
  const Vec3 centroid = pose->handle(numbers[0]).centroid;
  const DeformReport report = pose->deform({true, 0, false});
  EXPECT_TRUE(all_finite(report));
  std::uint32_t unreached = 0;
  for (std::int32_t v = 0; v < core->size(); ++v) {
    const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
    if (p.x < 1.5) {
      EXPECT_LT(norm(report.positions[v] - rotate(motion.rotation, p - centroid) - centroid - motion.translation),
                1e-12 * core->mesh.scale);
    }
    if (p.x > 4.5) {
      EXPECT_LT(norm(report.positions[v] - p), 1e-12 * core->mesh.scale);
    }
    unreached += p.x > 4.5;
  }
  EXPECT_EQ(report.unreached_vertex_count, unreached);
}

TEST_P(Modes, RegionsThatFillAComponentHaveNoSitesAndStillMove) {
  hf_test::PlainMesh mesh = plain(samples::sphere(4));
  hf_test::append(mesh, plain(samples::sphere(4)), 3);
  const auto core = hf_test::make_core(mesh);
  const auto pose = Pose::make(core, options());
  const auto left = add(*pose, {select(*core, [](Vec3 p) { return p.x < 1.5; })})[0];
  EXPECT_EQ(pose->handle(left).site_count, 0u);
  EXPECT_EQ(pose->handle(left).leak, 0.0);
  // two handles that share a component between them: no free vertex
  const auto halves = add(*pose, {select(*core, [](Vec3 p) { return p.x > 1.5 && p.y > 0; }),
                                  select(*core, [](Vec3 p) { return p.x > 1.5 && p.y <= 0; })});
  EXPECT_GT(pose->handle(halves[0]).site_count, 0u);
  place(*pose, left, {{}, {-1, 0, 0}});
  place(*pose, halves[0], {{}, {0, 1, 0}});
  const DeformReport report = pose->deform({true, 0, false});
  EXPECT_TRUE(all_finite(report));
  for (std::int32_t v = 0; v < core->size(); ++v) {
    const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
    const Vec3 moved = p.x < 1.5 ? Vec3{-1, 0, 0} : (p.y > 0 ? Vec3{0, 1, 0} : Vec3{});
    EXPECT_LT(norm(report.positions[v] - p - moved), 1e-12 * core->mesh.scale);
  }
}

TEST_P(Modes, TinyMeshesAndOddHandlesArePosedWithFiniteNumbers) {
  std::vector<hf_test::PlainMesh> meshes;
  meshes.push_back({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}});                                      // a triangle
  meshes.push_back({{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}});  // a tetrahedron
  meshes.push_back(plain(samples::box(1, 1, 1, 1, 1, 1)));
  meshes.push_back({{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 1.5, 1e-12, 0}, {0, 1, 4, 1, 2, 4, 2, 3, 4}});  // needles
  meshes.push_back({{0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}, {0, 1, 2, 1, 2, 3}});  // no area at all
  meshes.push_back(
      {{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, .5, .5, 1}, {0, 1, 2, 1, 3, 2, 1, 2, 4}});  // three triangles at an edge
  meshes.push_back(hf_test::grid(2, 2));
  meshes.push_back(hf_test::grid(12, 1));
  meshes.push_back(plain(samples::sphere(3)));
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const auto core = hf_test::make_core(meshes[m]);
    const std::int32_t n = core->size();
    // one vertex each; neighbours; all but one vertex; every vertex its own handle
    std::vector<std::vector<std::vector<std::int32_t>>> sets{{{0}, {n - 1}}, {{0}, {1}}, {{0}}};
    sets.push_back({{}, {n - 1}});
    for (std::int32_t v = 0; v + 2 < n; ++v) sets.back()[0].push_back(v);
    sets.push_back({});
    for (std::int32_t v = 0; v < std::min(n, 100); ++v) sets.back().push_back({v});
    for (std::size_t s = 0; s < sets.size(); ++s) {
      if (sets[s][0].empty()) continue;
      const auto pose = Pose::make(core, options());
      const auto numbers = add(*pose, sets[s]);
      const DeformReport still = pose->deform({true, 0, false});
      EXPECT_TRUE(all_finite(still)) << "mesh " << m << " set " << s;
      EXPECT_LT(largest_distance(positions(still), rest(*core)), 1e-10 * core->mesh.scale)
          << "mesh " << m << " set " << s;
      RandomMotion random(1);
      for (int round = 0; round < 4; ++round) {
        for (const std::uint32_t number : numbers) place(*pose, number, random.transform(1, 1));
        EXPECT_TRUE(all_finite(pose->deform({true, 0, false}))) << "mesh " << m << " set " << s;
      }
      // the same motion on all handles, mesh too coarse for the bands or not
      if (options().scheme) continue;
      const HandleTransform motion = random.transform(0.5, 1);
      for (const std::uint32_t number : numbers) {
        const Vec3 centroid = pose->handle(number).centroid;
        place(*pose, number, {motion.rotation, rotate(motion.rotation, centroid) - centroid + motion.translation});
      }
      const DeformReport moved = pose->deform({true, 200, true});
      for (std::int32_t v = 0; v < n; ++v) {
        const Vec3 p = core->mesh.to_given(core->mesh.positions[v]);
        EXPECT_LT(norm(moved.positions[v] - rotate(motion.rotation, p) - motion.translation), 1e-7 * core->mesh.scale)
            << "mesh " << m << " set " << s << " vertex " << v;
      }
    }
  }
}

TEST(Pose, UnitAndPlaceOfTheMeshDoNotMatter) {
  const Case c = cactus_bend(70, 1500);
  Dragged d = set_up(c, {});
  Case far = c;
  for (std::size_t i = 0; i < far.mesh.positions.size(); ++i)
    far.mesh.positions[i] = 1000 * far.mesh.positions[i] + (i % 3 == 1 ? 65536 : 0);
  const auto core = hf_test::make_core(far.mesh);
  const auto pose = Pose::make(core, {});
  const auto numbers = add(*pose, {select(*d.core, c.regions[0]), select(*d.core, c.regions[1])});
  const HandleTransform t = c.motion(1, 1, d.pose->handle(d.handles[1]).centroid);
  place(*d.pose, d.handles[1], t);
  place(*pose, numbers[1], {t.rotation, 1000.0 * t.translation});
  const DeformReport a = d.pose->deform({false, 100, false}), b = pose->deform({false, 100, false});
  for (std::int32_t v = 0; v < core->size(); ++v)
    EXPECT_LT(norm(0.001 * (b.positions[v] - Vec3{0, 65536, 0}) - a.positions[v]), 1e-6);
}

TEST(Pose, BadInputIsNamedAndChangesNothing) {
  const auto core = hf_test::make_core(plain(samples::sphere(6)));
  const auto pose = Pose::make(core, {});
  const auto numbers = add(*pose, {{0, 1}, {50}});
  place(*pose, numbers[1], {about({1, 0, 0}, 0.5), {0.1, 0, 0}});
  const std::vector<Vec3> before = positions(pose->deform({false, 200, false}));
  const auto try_add = [&](const std::vector<std::vector<std::int32_t>>& regions, std::uint32_t* index) {
    return code_of([&] { add(*pose, regions); }, index);
  };
  std::uint32_t index = 0;
  EXPECT_EQ(try_add({}, &index), HF_ERROR_EMPTY);
  EXPECT_EQ(try_add({{7}, {}}, &index), HF_ERROR_EMPTY);
  EXPECT_EQ(try_add({{7, 8}, {9, 8}}, &index), HF_ERROR_CONFLICT);
  EXPECT_EQ(index, 3u);
  EXPECT_EQ(try_add({{7, 50}}, &index), HF_ERROR_CONFLICT);
  EXPECT_EQ(index, 1u);
  try {
    add(*pose, {{7, 50}});
    ADD_FAILURE() << "a vertex of another handle was taken";
  } catch (const hf_inner::Error& error) {
    EXPECT_NE(std::string(error.what()).find("belongs to handle " + std::to_string(numbers[1]) + " already"),
              std::string::npos)
        << error.what();
  }
  EXPECT_EQ(try_add({{7, mesh::Mesh::none}}, &index), HF_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(try_add({{7, core->size()}}, &index), HF_ERROR_OUT_OF_RANGE);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(try_add(std::vector<std::vector<std::int32_t>>(255, {7}), &index), HF_ERROR_TOO_LARGE);
  const auto remove = [&](std::vector<std::uint32_t> list) {
    return code_of([&] { pose->remove_handles(list); }, &index);
  };
  EXPECT_EQ(remove({0, 5}), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(remove({0, 0}), HF_ERROR_NOT_FOUND);
  const auto transform = [&](HandleTransform t) {
    return code_of([&] { pose->set_transforms(numbers, std::vector<HandleTransform>{{}, t}); }, &index);
  };
  EXPECT_EQ(transform({{Vec3(), std::numeric_limits<double>::quiet_NaN()}, {}}), HF_ERROR_NON_FINITE);
  EXPECT_EQ(index, 1u);
  EXPECT_EQ(transform({{}, {0, std::numeric_limits<double>::infinity(), 0}}), HF_ERROR_NON_FINITE);
  EXPECT_EQ(transform({{}, {1e300, 0, 0}}), HF_ERROR_NON_FINITE);
  EXPECT_EQ(code_of([&] { pose->set_transforms(std::vector<std::uint32_t>{9}, std::vector<HandleTransform>(1)); }),
            HF_ERROR_NOT_FOUND);
  EXPECT_EQ(code_of([&] { pose->handle(9); }), HF_ERROR_NOT_FOUND);
  EXPECT_EQ(code_of([&] { pose->deform({false, 1001, false}); }), HF_ERROR_INVALID_ARGUMENT);
  for (PoseOptions bad : {PoseOptions{1, 0, 0, 0, nullptr}, PoseOptions{65, 0, 0, 0, nullptr},
                          PoseOptions{0, 1001, 0, 0, nullptr}, PoseOptions{0, 0, 2001, 0, nullptr}}) {
    EXPECT_EQ(code_of([&] { Pose::make(core, bad); }), HF_ERROR_INVALID_ARGUMENT);
  }
  EXPECT_EQ(pose->handle_count(), 2u);
  EXPECT_TRUE(same_bits(before, positions(pose->deform({}))));
  // an unnormalised quaternion is normalised, a zero one is the identity, a repeated vertex counts once
  place(*pose, numbers[1], {{Vec3(), 0}, {}});
  EXPECT_LT(largest_distance(positions(pose->deform({false, 100, true})), rest(*core)), 1e-9);
  EXPECT_EQ(pose->handle(add(*pose, {{7, 7, 8, 7}})[0]).vertex_count, 2u);
}

struct FailingAllocator {
  std::int64_t left = -1;  // allocations that still succeed; negative: all
  std::int64_t live = 0;
  hf_allocator hooks() {
    return {[](void* user, std::size_t size, std::size_t alignment) -> void* {
              auto& self = *static_cast<FailingAllocator*>(user);
              if (self.left == 0) return nullptr;
              if (self.left > 0) --self.left;
              ++self.live;
              return std::aligned_alloc(std::max<std::size_t>(alignment, 16), (size + alignment + 63) / 64 * 64 + 64);
            },
            [](void* user, void* block, std::size_t, std::size_t) {
              --static_cast<FailingAllocator*>(user)->live;
              std::free(block);
            },
            this};
  }
};

TEST_P(Modes, WhenMemoryRunsOutThePoseIsAsBefore) {
  FailingAllocator allocator;
  std::uint64_t faults = 0;
  {
    auto memory = std::make_shared<Memory>(allocator.hooks());
    const auto core = hf_test::make_core(plain(samples::sphere(6)), 1, {}, memory);
    const auto make = [&] {
      const auto pose = Pose::make(core, options());
      add(*pose, {{0, 1}, {50}});
      place(*pose, 1, {about({1, 0, 0}, 0.5), {0.1, 0, 0}});
      pose->deform({});
      return pose;
    };
    const auto reference = make();
    const std::vector<Vec3> expected = positions(reference->deform({}));
    const std::vector<std::function<void(Pose&)>> scenarios{[](Pose& pose) {
                                                              add(pose, {{100}, {120, 121}});
                                                            },
                                                            [](Pose& pose) {
                                                              const std::uint32_t n = 0;
                                                              pose.remove_handles({&n, 1});
                                                            },
                                                            [](Pose& pose) { pose.clone(); },
                                                            [](Pose& pose) {
                                                              pose.deform({true, 1, false});
                                                            }};
    for (std::size_t s = 0; s < scenarios.size(); ++s) {
      const auto pose = make();
      for (std::int64_t k = 0;; ++k) {
        allocator.left = k;
        bool failed = false;
        try {
          scenarios[s](*pose);
        } catch (const std::bad_alloc&) {
          failed = true;
        }
        allocator.left = -1;
        if (!failed) break;
        ++faults;
        ASSERT_EQ(pose->handle_count(), 2u);
      }
      if (s == 0) {
        pose->remove_handles(std::vector<std::uint32_t>{2, 3});
      }
      if (s != 1 && s != 3) {
        EXPECT_TRUE(same_bits(positions(pose->deform({})), expected)) << "scenario " << s;
      }
    }
  }
  std::printf("%llu faults\n", static_cast<unsigned long long>(faults));
  EXPECT_GT(faults, 50u);
  EXPECT_EQ(allocator.live, 0);
}

}  // namespace
