// hf.hpp: the thin C++ wrapper.
#include <gtest/gtest.h>

#include <cmath>

#include "hf/hf.hpp"

namespace {

struct Strip {
  std::vector<float> positions;
  std::vector<uint32_t> triangles;
  explicit Strip(uint32_t n) {
    for (uint32_t i = 0; i <= n; ++i) positions.insert(positions.end(), {float(i), 0, 0, float(i), 1, 0});
    for (uint32_t i = 0; i < n; ++i)
      triangles.insert(triangles.end(), {2 * i, 2 * i + 2, 2 * i + 1, 2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
};

TEST(Wrapper, solves_edits_and_undoes) {
  const Strip strip(8);
  hfpp::Solver solver(strip.positions, strip.triangles);
  const auto sites = solver.add_sites({0, 1, 16, 17}, {0, 0, 1, 1});
  EXPECT_FLOAT_EQ(solver.solve()[8], 0.5f);
  EXPECT_DOUBLE_EQ(solver.solve_at({8})[0], solver.solve_f64()[8]);
  solver.record();
  solver.set_site_values({sites[2], sites[3]}, {2, 2});
  EXPECT_FLOAT_EQ(solver.solve()[8], 1.0f);
  solver.undo();
  EXPECT_FLOAT_EQ(solver.solve()[8], 0.5f);
  solver.move_sites({sites[0]}, {2});
  solver.remove_sites({sites[1]});
  EXPECT_EQ(solver.site_count(), 3u);
  EXPECT_EQ(solver.statistics().factorisation_count, 1u);
}

TEST(Wrapper, throws_with_code_and_index) {
  const Strip strip(2);
  hfpp::Solver solver(strip.positions, strip.triangles);
  try {
    solver.add_sites({0, 99}, {0, 1});
    FAIL();
  } catch (const hfpp::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_OUT_OF_RANGE);
    EXPECT_EQ(error.index(), 1u);
    EXPECT_NE(std::string(error.what()).find("hf_add_sites"), std::string::npos);
  }
  EXPECT_THROW(solver.add_sites({0}, {}), std::invalid_argument);
  EXPECT_EQ(solver.site_count(), 0u);
}

TEST(Wrapper, handles_move_and_children_outlive_parents) {
  const Strip strip(8);
  auto solver = std::make_unique<hfpp::Solver>(strip.positions, strip.triangles);
  hfpp::Solver clone = solver->clone();
  hfpp::Pose pose(*solver);
  hfpp::Transfer transfer(*solver, clone);
  solver.reset();
  hfpp::Solver moved = std::move(clone);
  moved.add_sites({0, 17}, {0, 1});
  EXPECT_EQ(moved.solve().size(), 18u);

  const auto handles = pose.add_handles({{0, 1}, {16, 17}});
  const auto rest = pose.deform();
  for (size_t i = 0; i < rest.size(); ++i) EXPECT_NEAR(rest[i], strip.positions[i], 1e-6);
  pose.set_transform(handles[1], {{0, 0, 0, 1}, {0, 0, 2}});
  EXPECT_NEAR(pose.clone().deform()[3 * 17 + 2], 2, 1e-6);

  transfer.add_pair({0, 1}, {0, 1});
  transfer.add_pair({16, 17}, {16, 17});
  const auto played = transfer.apply(strip.positions);
  for (size_t i = 0; i < played.size(); ++i) EXPECT_NEAR(played[i], strip.positions[i], 1e-5);
}

}  // namespace
