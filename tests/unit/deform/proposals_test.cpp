// Handles proposed for a shape whose list is known: a foot, tips, and joints of a skeleton.
#include "deform/proposals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "deform/handles.h"
#include "support/meshes.h"

namespace {

using hf_inner::Vec3;
using hf_inner::deform::HandleProposal;
using hf_inner::deform::HandleReason;
using hf_test::PlainMesh;

constexpr std::uint32_t none = 0xffffffffu;

// A closed tube of unit radius along x from 0 to `length`.
PlainMesh tube(std::uint32_t around, std::uint32_t rings, double length) {
  PlainMesh mesh;
  const double two_pi = 8 * std::atan(1.0);
  for (std::uint32_t i = 0; i < rings; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = two_pi * k / around;
      mesh.positions.insert(mesh.positions.end(), {length * i / (rings - 1), std::cos(a), std::sin(a)});
    }
  }
  for (std::uint32_t i = 0; i + 1 < rings; ++i) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const std::uint32_t a = i * around + k, b = i * around + (k + 1) % around, c = a + around, d = b + around;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  for (std::uint32_t end = 0; end < 2; ++end) {
    const std::uint32_t middle = mesh.vertex_count(), ring = end * (rings - 1) * around;
    mesh.positions.insert(mesh.positions.end(), {end * length, 0.0, 0.0});
    for (std::uint32_t k = 0; k < around; ++k)
      mesh.triangles.insert(mesh.triangles.end(), {middle, ring + (k + end) % around, ring + (k + 1 - end) % around});
  }
  return mesh;
}

std::vector<HandleProposal> propose(const hf_inner::surface::Core& core,
                                    const hf_inner::deform::ProposalOptions& options) {
  const auto found = propose_handles(core, options).list;
  return {found.begin(), found.end()};
}

hf_inner::deform::ProposalOptions plain() {
  hf_inner::deform::ProposalOptions options;
  options.least_length_share = 0.05;
  options.limit = hf_inner::deform::handle_limit;
  return options;
}

std::vector<HandleProposal> of(const std::vector<HandleProposal>& list, HandleReason reason) {
  std::vector<HandleProposal> out;
  for (const HandleProposal& p : list) {
    if (p.reason == reason) out.push_back(p);
  }
  return out;
}

// The regions of all are disjoint, and pinned ones come first.
void expect_list(const hf_inner::surface::Core& core, const std::vector<HandleProposal>& list) {
  std::vector<int> owners(static_cast<std::size_t>(core.size()), 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto region = hf_inner::deform::RegionSearch(core).near(core.mesh.to_inner(list[i].position),
                                                                  list[i].radius / core.mesh.scale);
    for (const std::int32_t v : region) ++owners[static_cast<std::size_t>(v)];
    EXPECT_GE(region.size(), 1u);
    if (i == 0) continue;
    EXPECT_GE(list[i - 1].pinned, list[i].pinned);
    if (list[i - 1].pinned == list[i].pinned) {
      EXPECT_GE(list[i - 1].length, list[i].length);
    }
  }
  EXPECT_LE(*std::max_element(owners.begin(), owners.end()), 1);
}

TEST(HandleProposals, of_a_lying_tube_are_a_foot_its_ends_and_joints_by_the_skeleton) {
  const auto core = hf_test::make_core(tube(16, 101, 20));
  auto options = plain();
  const std::vector<HandleProposal> bare = propose(*core, options);
  expect_list(*core, bare);
  EXPECT_EQ(of(bare, HandleReason::foot).size(), 1u);  // all of its lowest line is one sole
  EXPECT_TRUE(bare[0].pinned);
  const auto tips = of(bare, HandleReason::tip);
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_NEAR(std::fabs(tips[0].position.x - tips[1].position.x), 20, 1e-6);
  EXPECT_TRUE(of(bare, HandleReason::joint).empty());

  // A root where two limbs begin, joints in both tips, one away from the surface, and a chain to a joint in the side.
  const std::vector<double> joints = {5, 0, 0, 0.2, 0, 0, 20, 0, 0, 5, 9, 0, 14, 0.5, 0, 9, 0, 0};
  const std::vector<std::uint32_t> parents = {none, 0, 0, 0, 5, 0};
  options.joints = joints;
  options.parents = parents;
  const std::vector<HandleProposal> list = propose(*core, options);
  expect_list(*core, list);
  std::vector<std::uint32_t> named;
  for (const HandleProposal& p : of(list, HandleReason::tip)) {
    named.push_back(p.joint);
    EXPECT_NEAR(p.position.x, p.joint == 1 ? 0.0 : 20.0, 1e-6);
  }
  std::sort(named.begin(), named.end());
  EXPECT_EQ(named, (std::vector<std::uint32_t>{1, 2}));
  auto own = of(list, HandleReason::joint);
  ASSERT_EQ(own.size(), 2u);
  if (own[0].joint > own[1].joint) std::swap(own[0], own[1]);
  EXPECT_EQ(own[0].joint, 0u);
  EXPECT_EQ(own[1].joint, 4u);
  EXPECT_NEAR(own[0].position.x, 5, 1e-9);
  EXPECT_NEAR(own[0].position.y, 0, 1e-9);  // the joint itself, so that its region goes around
  EXPECT_NEAR(own[1].position.x, 14, 1e-9);

  options.limit = 2;
  const std::vector<HandleProposal> two = propose(*core, options);
  ASSERT_EQ(two.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(two[i].vertex, list[i].vertex);
}

// No region of a thick body goes around.
TEST(HandleProposals, a_drum_is_held_at_a_vertex_because_its_middle_is_too_deep) {
  const auto core = hf_test::make_core(tube(16, 21, 2));
  const std::vector<HandleProposal> list = propose(*core, plain());
  expect_list(*core, list);
  const auto trunk = of(list, HandleReason::middle);
  ASSERT_EQ(trunk.size(), 1u);
  EXPECT_TRUE(trunk[0].pinned);
  const Vec3 vertex = core->mesh.to_given(core->mesh.positions[static_cast<std::size_t>(trunk[0].vertex)]);
  EXPECT_NEAR(norm(trunk[0].position - vertex), 0, 1e-9);
}

TEST(HandleProposals, the_region_of_the_trunk_goes_around_the_axis) {
  const auto core = hf_test::make_core(tube(16, 101, 20));
  const auto trunk = of(propose(*core, plain()), HandleReason::middle);
  ASSERT_EQ(trunk.size(), 1u);
  const auto region = hf_inner::deform::RegionSearch(*core).near(core->mesh.to_inner(trunk[0].position),
                                                                 trunk[0].radius / core->mesh.scale);
  double low = 0, high = 0;
  for (const std::int32_t v : region) {
    const Vec3 p = core->mesh.to_given(core->mesh.positions[static_cast<std::size_t>(v)]);
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_NEAR(low, -1, 1e-6);
  EXPECT_NEAR(high, 1, 1e-6);
}

TEST(HandleProposals, the_end_farther_from_the_middle_comes_first_in_any_numbering) {
  PlainMesh mesh = tube(16, 41, 30);  // lies below; the other tube has no foot, and no tip is long enough
  append(mesh, tube(8, 11, 6), 12);
  for (std::uint32_t v = 16 * 41 + 2; v < mesh.vertex_count(); ++v) {
    double* const p = &mesh.positions[3 * v];
    p[1] = 20 + 0.3 * p[1];
    p[0] += 0.01 * p[2] + 0.03 * p[1];         // no two vertices are equally far
    p[0] += 0.05 * (p[0] - 15) * (p[0] - 15);  // vertices are denser at one end, so the middle is nearer to it
  }
  PlainMesh turned = mesh;
  const std::uint32_t last = mesh.vertex_count() - 1;
  for (std::uint32_t v = 0; v <= last; ++v) {
    for (std::uint32_t k = 0; k < 3; ++k) turned.positions[3 * v + k] = mesh.positions[3 * (last - v) + k];
  }
  for (std::uint32_t& v : turned.triangles) v = last - v;
  auto options = plain();
  options.least_length_share = 0.9;
  const auto ends = of(propose(*hf_test::make_core(mesh), options), HandleReason::end);
  const auto other = of(propose(*hf_test::make_core(turned), options), HandleReason::end);
  ASSERT_EQ(ends.size(), 2u);
  ASSERT_EQ(other.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(norm(ends[i].position - other[i].position), 0, 1e-9);
}

}  // namespace
