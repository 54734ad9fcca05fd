// The order of inner vertices: good orders stay, bad ones follow a Hilbert curve, and no result depends on it.
#include "mesh/vertex_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "solve/site_solver.h"
#include "support/meshes.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;

// The same mesh with its vertices in another order: vertex v becomes to[v].
hf_test::PlainMesh renamed(const hf_test::PlainMesh& mesh, const std::vector<std::uint32_t>& to) {
  hf_test::PlainMesh out = mesh;
  for (std::size_t v = 0; v < to.size(); ++v)
    std::copy_n(&mesh.positions[3 * v], 3, &out.positions[3 * static_cast<std::size_t>(to[v])]);
  for (std::uint32_t& corner : out.triangles) corner = to[corner];
  return out;
}

std::vector<std::uint32_t> shuffled(std::size_t count) {
  std::vector<std::uint32_t> to(count);
  std::iota(to.begin(), to.end(), 0u);
  std::shuffle(to.begin(), to.end(), std::mt19937(5));
  return to;
}

TEST(VertexOrder, CellsInARowShareASideAtEveryDepth) {
  for (const int side : {2, 4, 16}) {
    std::vector<std::pair<std::uint64_t, Vec3>> cells;
    for (int x = 0; x < side; ++x) {
      for (int y = 0; y < side; ++y) {
        for (int z = 0; z < side; ++z) {
          const Vec3 p{(x + 0.5) / side - 0.5, (y + 0.5) / side - 0.5, (z + 0.5) / side - 0.5};
          cells.push_back({hilbert_key(p), p});
        }
      }
    }
    std::sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 1; i < cells.size(); ++i) {
      EXPECT_NE(cells[i].first, cells[i - 1].first);
      EXPECT_NEAR(norm(cells[i].second - cells[i - 1].second), 1.0 / side, 1e-12) << side << " " << i;
    }
  }
  EXPECT_LT(hilbert_key({-0.5, -0.5, -0.5}), hilbert_key({0.5, 0.5, 0.5}));  // the corners are inside
}

TEST(VertexOrder, AShuffledMeshBecomesLocalAndAGoodOneKeepsItsOrder) {
  const hf_test::PlainMesh mesh = hf_test::grid(160, 160);
  const auto plain = hf_test::make_core(mesh);
  for (std::int32_t v = 0; v < plain->size(); ++v) ASSERT_EQ(plain->mesh.given_of_inner[v], v);
  const std::vector<std::uint32_t> to = shuffled(mesh.positions.size() / 3);
  const hf_test::PlainMesh other = renamed(mesh, to);
  std::vector<std::int32_t> corners(other.triangles.begin(), other.triangles.end());
  EXPECT_FALSE(is_local(corners, to.size()));
  const auto core = hf_test::make_core(other);
  EXPECT_TRUE(is_local(core->mesh.corners, to.size()));
  for (std::size_t v = 0; v < to.size(); ++v) {
    const std::int32_t inner = core->mesh.inner_of_given[v];
    ASSERT_EQ(core->mesh.given_of_inner[inner], static_cast<std::int32_t>(v));
    const Vec3 p = core->mesh.to_given(core->mesh.positions[inner]);
    EXPECT_NEAR(p.x, other.positions[3 * v], 1e-12);
    EXPECT_NEAR(p.y, other.positions[3 * v + 1], 1e-12);
  }
}

TEST(VertexOrder, AFieldDoesNotDependOnTheOrder) {
  const hf_test::PlainMesh mesh = hf_test::grid(130, 130);
  const std::vector<std::uint32_t> to = shuffled(mesh.positions.size() / 3);
  const auto field = [](const hf_test::PlainMesh& given, std::vector<std::uint32_t> sites) {
    const auto core = hf_test::make_core(given);
    auto solver = solve::SiteSolver::make(core);
    std::vector<solve::Site> list;
    std::vector<double> values;
    for (const std::uint32_t v : sites) {
      list.push_back(solve::Site::at_vertex(core->mesh, core->mesh.inner_of_given[v]));
      values.push_back(static_cast<double>(values.size() % 3));
    }
    std::vector<std::int32_t> slots(list.size());
    std::iota(slots.begin(), slots.end(), 0);
    solve::SiteEdit edit;
    edit.add = slots;
    edit.sites = list;
    solver->edit(edit);
    std::vector<double> inner(static_cast<std::size_t>(core->size())), out(given.positions.size() / 3);
    solver->solve(values.data(), 1, inner.data(), nullptr);
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = inner[core->mesh.inner_of_given[v]];
    return out;
  };
  const std::vector<std::uint32_t> sites{3, 900, 5000, 16000};
  std::vector<std::uint32_t> moved;
  for (const std::uint32_t v : sites) moved.push_back(to[v]);
  const std::vector<double> plain = field(mesh, sites), other = field(renamed(mesh, to), moved);
  for (std::size_t v = 0; v < plain.size(); ++v) ASSERT_NEAR(plain[v], other[to[v]], 1e-12);
}

// Two grids, of which the second has the first vertex: it is component 0, wherever the curve begins.
TEST(VertexOrder, ComponentsAreNumberedByTheCallersVertices) {
  const hf_test::PlainMesh half = hf_test::grid(90, 90);
  hf_test::PlainMesh both = half;
  const std::uint32_t count = static_cast<std::uint32_t>(half.positions.size() / 3);
  for (std::size_t i = 0; i < half.positions.size(); ++i)
    both.positions.push_back(half.positions[i] - (i % 3 == 0 ? 300.0 : 0.0));
  for (const std::uint32_t corner : half.triangles) both.triangles.push_back(corner + count);
  std::vector<std::uint32_t> to = shuffled(2 * std::size_t{count});
  std::swap(*std::find(to.begin(), to.end(), 0u), to[count + 5]);  // a vertex of the second grid is the first
  const auto core = hf_test::make_core(renamed(both, to));
  ASSERT_EQ(core->mesh.component_count(), 2);
  for (std::uint32_t v = 0; v < 2 * count; ++v)
    EXPECT_EQ(core->mesh.component[core->mesh.inner_of_given[to[v]]], v < count ? 1 : 0);
}

}  // namespace
