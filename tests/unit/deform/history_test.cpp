// Earlier handles leave no trace: fields and restarted frames have the bits of a fresh object with the same handles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "deform/pose_stack.h"
#include "solve/green.h"
#include "support/full.h"
#include "support/meshes.h"
#include "support/pose_modes.h"

namespace {

using hf_inner::Vec3;
using hf_inner::deform::Handles;
using hf_inner::deform::HandleTransform;
using hf_inner::deform::PoseStack;

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

// Regions of 1 to `most` vertices around vertices that lie far apart.
std::vector<std::vector<std::int32_t>> regions_on(const hf_inner::surface::Core& core, std::int32_t count,
                                                  std::int32_t most) {
  std::vector<std::vector<std::int32_t>> regions;
  for (std::int32_t i = 0; i < count; ++i) {
    const std::int32_t first = i * (core.size() / count);
    regions.push_back({first});
    for (std::int32_t k = 1; k < 1 + i % most; ++k) regions.back().push_back(first + k);
  }
  return regions;
}

class Sites : public testing::TestWithParam<std::int32_t> {};

// most: vertices of a region. With many the factor eliminates the sites, with few they are rows.
TEST_P(Sites, EveryHistoryOfHandlesGivesTheBitsOfAFreshSolver) {
  const auto core = hf_test::make_core(hf_test::torus(60, 40, 0.2));
  hf_inner::Memory& memory = *core->memory;
  std::vector<hf_inner::deform::Handle> all;
  for (const auto& region : regions_on(*core, 24, GetParam()))
    all.push_back({static_cast<std::uint32_t>(all.size()),
                   hf_inner::deform::make_region(*core, {region.data(), region.size()}, 0, memory)});
  const auto field_of = [&](hf_inner::solve::SiteSolver& solver, const Handles& handles) {
    const hf_inner::deform::Reach reach(core->mesh, handles, memory);
    const auto fields = solve_handle_fields(*core, solver, handles, reach, memory);
    return std::vector<double>(fields.values.data(), fields.values.data() + fields.values.size());
  };
  std::mt19937 random(5);
  hf_inner::solve::GreenSolver solver(core);
  Handles present(&memory);
  int dense = 0, eliminated = 0;
  for (int step = 0; step < 60; ++step) {
    Handles next(present, &memory);
    if (step % 3 == 2 && next.size() > 1)
      next.erase(next.begin() + static_cast<std::ptrdiff_t>(random() % next.size()));
    for (std::uint32_t added = step % 3 == 2 ? 0 : 1 + random() % 3; added > 0; --added) {
      const hf_inner::deform::Handle& handle = all[random() % all.size()];
      bool there = false;
      for (const auto& h : next) there = there || h.number == handle.number;
      if (!there) next.push_back(handle);
    }
    set_handle_sites(*core, solver, present, next, memory);
    present = next;
    hf_inner::solve::GreenSolver batch(core), single(core);
    set_handle_sites(*core, batch, Handles(&memory), present, memory);
    Handles some(&memory);
    for (const auto& handle : present) {
      const Handles before(some, &memory);
      some.push_back(handle);
      set_handle_sites(*core, single, before, some, memory);
    }
    const std::vector<double> here = field_of(solver, present);
    ASSERT_TRUE(same_bits(here, field_of(batch, present))) << "step " << step;
    ASSERT_TRUE(same_bits(here, field_of(single, present))) << "step " << step;
    (solver.counters().eliminated > 0 ? eliminated : dense) += 1;
  }
  EXPECT_GT(dense, 0);
  if (GetParam() > 8) {
    EXPECT_GT(eliminated, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, Sites, testing::Values(3, 40));

TEST(Sites, AHandleMoreKeepsTheFactorThatEliminatesTheOthers) {
  const auto core = hf_test::make_core(hf_test::torus(60, 40, 0.2));
  hf_inner::Memory& memory = *core->memory;
  hf_inner::solve::GreenSolver solver(core);
  Handles present(&memory);
  const auto add = [&](std::int32_t first, std::int32_t count) {
    std::vector<std::int32_t> region(static_cast<std::size_t>(count));
    for (std::int32_t k = 0; k < count; ++k) region[static_cast<std::size_t>(k)] = first + k;
    const Handles before(present, &memory);
    present.push_back({static_cast<std::uint32_t>(present.size()),
                       hf_inner::deform::make_region(*core, {region.data(), region.size()}, 0, memory)});
    set_handle_sites(*core, solver, before, present, memory);
  };
  for (std::int32_t i = 0; i < 6; ++i) add(400 * i, 240);
  const auto before = solver.counters();
  ASSERT_GT(before.eliminated, 0);
  add(300, 3);
  EXPECT_EQ(solver.counters().factorisations, before.factorisations);
  EXPECT_EQ(solver.counters().eliminated, before.eliminated);
}

struct Placed {
  std::uint32_t number, layer;
  std::vector<std::int32_t> region;
  HandleTransform transform;
};

void add_to(PoseStack& pose, Placed& handle) {
  const std::uint32_t start[2] = {0, static_cast<std::uint32_t>(handle.region.size())};
  pose.add_handles({start, 2}, {handle.region.data(), handle.region.size()}, handle.layer, {&handle.number, 1});
  pose.set_transforms({&handle.number, 1}, {&handle.transform, 1});
}

std::vector<double> restarted(PoseStack& pose, bool refine) {
  hf_inner::deform::DeformRequest request;
  request.restart = true;
  request.refine = refine ? 3 : 0;
  std::vector<double> out;
  for (const Vec3& p : pose.deform(request).positions) out.insert(out.end(), {p.x, p.y, p.z});
  return out;
}

class Histories : public testing::TestWithParam<hf_test::DeformMode> {};

TEST_P(Histories, ARestartedFrameHasTheBitsOfAFreshPose) {
  const auto core = hf_test::make_core(hf_test::torus(30, 20, 0.2));
  hf_inner::deform::PoseOptions options;
  options.scheme = hf_test::scheme_of(GetParam());
  const auto pose = PoseStack::make(core, options);
  const auto regions = regions_on(*core, 12, 6);
  std::mt19937 random(9);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  std::vector<Placed> present;
  const int steps = hf_test::is_full() ? 40 : 20;
  for (int step = 0; step < steps; ++step) {
    if (step % 4 == 3 && present.size() > 1) {
      const std::size_t i = random() % present.size();
      pose->remove_handles({&present[i].number, 1});
      present.erase(present.begin() + static_cast<std::ptrdiff_t>(i));
    }
    Placed fresh{0, static_cast<std::uint32_t>(random() % 3), regions[random() % regions.size()], {}};
    fresh.transform = {hf_inner::deform::exponential({number(), number(), number()}), {number(), number(), number()}};
    bool there = false;
    for (const Placed& other : present) there = there || other.region == fresh.region;
    if (!there) {
      add_to(*pose, fresh);
      present.push_back(fresh);
    }
    pose->deform({});
    if (step % 3) continue;
    const bool refine = step % 2 == 0;
    const auto other = PoseStack::make(core, options);
    for (Placed handle : present) add_to(*other, handle);
    ASSERT_TRUE(same_bits(restarted(*pose, refine), restarted(*other, refine))) << "step " << step;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, Histories, testing::Values(hf_test::DeformMode::smooth, hf_test::DeformMode::paper));

}  // namespace
