// The machine under fields: what an edit does when the route it chose cannot be gone.
#include "solve/constraint_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "base/index.h"
#include "solve/green.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_inner::solve::Site;

std::vector<double> field_of(const hf_inner::solve::SiteSolver& solver, Index vertices) {
  std::vector<double> values(at(solver.slot_count())), field(at(vertices));
  for (std::size_t s = 0; s < values.size(); ++s) values[s] = std::sin(0.3 * static_cast<double>(s));
  solver.solve(values.data(), 1, field.data(), nullptr);
  return field;
}

// A buffer that a refused call left behind made a later frame meet the limit (reliability_unchanged, poses 1913).
TEST(Workspaces, keep_no_buffer_under_a_memory_limit) {
  for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{1} << 20}) {
    hf_inner::Memory memory({}, limit);
    hf_inner::surface::WorkspacePool pool(memory);
    const std::uint64_t before = memory.live_bytes();
    { hf_inner::surface::Workspace(pool, 1024).data()[1023] = 1; }
    EXPECT_EQ(memory.live_bytes() - before, limit ? 0u : 8192u);
  }
}

// Many hard vertices in one batch go into the factor; a point that they decide cannot stand beside them.
TEST(ConstraintSystem, names_a_point_that_depends_on_the_vertices_eliminated_with_it) {
  const auto core = hf_test::make_core(hf_test::torus(40, 30, 0.2));
  hf_inner::solve::GreenSolver solver(core);
  std::vector<Index> slots;
  std::vector<Site> sites;
  for (Index v = 0; v < core->size(); v += 2) {
    slots.push_back(static_cast<Index>(slots.size()));
    sites.push_back(Site::at_vertex(core->mesh, v));
  }
  solver.edit({{}, slots, sites});
  ASSERT_EQ(solver.counters().last_route, hf_inner::solve::EditRoute::rebase);
  const std::vector<double> before = field_of(solver, core->size());

  // an edge between two of them
  Site point;
  for (Index t = 0; t < core->mesh.triangle_count() && point.component < 0; ++t) {
    const Index* v = core->mesh.triangle(t);
    for (int k = 0; k < 3; ++k) {
      if (v[k] % 2 || v[(k + 1) % 3] % 2) continue;
      point.vertex[0] = v[k];
      point.vertex[1] = v[(k + 1) % 3];
      point.weight[0] = 0.25;
      point.weight[1] = 0.75;
      point.component = 0;
    }
  }
  ASSERT_EQ(point.component, 0);
  const auto conflict_at = [&](hf_inner::solve::GreenSolver& engine, const std::vector<Index>& add,
                               const std::vector<Site>& where) {
    try {
      engine.edit({{}, add, where});
    } catch (const hf_inner::Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_CONFLICT);
      return error.index();
    }
    return std::uint32_t{0xffff};
  };
  EXPECT_EQ(conflict_at(solver, {static_cast<Index>(slots.size())}, {point}), 0u);
  EXPECT_EQ(field_of(solver, core->size()), before);

  // all in one batch: the route of the batch is the rebase
  hf_inner::solve::GreenSolver fresh(core);
  slots.push_back(static_cast<Index>(slots.size()));
  sites.push_back(point);
  EXPECT_EQ(conflict_at(fresh, slots, sites), static_cast<std::uint32_t>(slots.size()) - 1);
  EXPECT_EQ(fresh.slot_count(), 0);
}

}  // namespace
