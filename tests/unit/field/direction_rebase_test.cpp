// Direction fields with constraints in the factor: rows that come and go beside them, freed vertices, the cost model.
#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "base/index.h"
#include "direction_support.h"
#include "field/direction_field.h"
#include "support/dirty_meshes.h"
#include "support/meshes.h"

namespace {

using hf_inner::at;
using hf_inner::Index;
using hf_test::Complex;

// Constraints on a solver of their own, slot by slot, and the field they should give.
struct Constraints {
  explicit Constraints(const std::shared_ptr<const hf_inner::surface::Core>& core) : solver(core, 1) {}
  static Complex value_of(Index v) { return std::polar(1.0 + 0.1 * (v % 3), 0.7 * v); }
  void edit(const std::vector<Index>& remove, const std::vector<Index>& add, const std::vector<Index>& vertices) {
    solver.edit({remove, add, vertices});
    for (const Index slot : remove) vertex[at(slot)] = -1;
    for (std::size_t i = 0; i < add.size(); ++i) {
      if (vertex.size() <= at(add[i])) vertex.resize(at(add[i]) + 1, -1);
      vertex[at(add[i])] = vertices[i];
    }
  }
  std::vector<Complex> field() const {
    std::vector<Complex> values(vertex.size()), out(at(solver.core().size()));
    for (std::size_t s = 0; s < vertex.size(); ++s) values[s] = vertex[s] < 0 ? Complex(77, 77) : value_of(vertex[s]);
    solver.solve(values, out.data());
    return out;
  }
  double error() const {
    std::vector<Index> vertices;
    std::vector<Complex> values;
    for (const Index v : vertex) {
      if (v >= 0) {
        vertices.push_back(v);
        values.push_back(value_of(v));
      }
    }
    const std::vector<Complex> exact = hf_test::dense_field(solver, vertices, values), got = field();
    double worst = 0;
    for (std::size_t v = 0; v < got.size(); ++v) worst = std::max(worst, std::abs(got[v] - exact[v]));
    return worst;
  }
  hf_inner::field::DirectionSolver solver;
  std::vector<Index> vertex;  // by slot
};

// A curved component, and a flat one whose operator is singular but for its pins.
std::shared_ptr<const hf_inner::surface::Core> two_components() {
  hf_test::PlainMesh mesh = hf_test::torus(12, 9, 0.2);
  append(mesh, hf_test::sheared_patch(7, 6, 0.5), 30);
  return hf_test::make_core(mesh);
}

TEST(DirectionRebase, freed_vertices_give_the_dense_oracles_field) {
  Constraints c(two_components());
  c.edit({}, {0, 1, 2, 3, 4, 5, 6}, {3, 20, 21, 60, 90, 115, 130});  // 20 and 21 are neighbours; 115 on are the patch
  c.solver.rebase();
  EXPECT_TRUE(c.solver.eliminates());
  EXPECT_EQ(c.solver.counters().factorisations, 2u);
  EXPECT_LE(c.error(), 1e-11);
  c.edit({1}, {}, {});
  EXPECT_LE(c.error(), 1e-11);
  c.edit({2}, {}, {});  // its freed neighbour is coupled with it
  EXPECT_LE(c.error(), 1e-11);
  c.edit({0}, {0, 1}, {40, 20});  // a move, and a freed vertex that is constrained again
  EXPECT_LE(c.error(), 1e-11);
  c.edit({0, 3}, {0}, {21});
  EXPECT_LE(c.error(), 1e-11);
  EXPECT_TRUE(c.solver.eliminates());
  EXPECT_EQ(c.solver.counters().factorisations, 2u);
}

TEST(DirectionRebase, a_component_without_an_eliminated_vertex_stays_pinned) {
  Constraints c(two_components());
  c.edit({}, {0, 1, 2}, {3, 20, 60});
  c.solver.rebase();
  EXPECT_LE(c.error(), 1e-11);  // the patch is not reached
  c.edit({}, {3}, {120});       // one constraint on it: parallel, rows with a border beside the elimination
  EXPECT_LE(c.error(), 1e-11);
  c.edit({}, {4, 5}, {131, 140});
  EXPECT_LE(c.error(), 1e-11);
  c.edit({3, 1}, {}, {});
  EXPECT_LE(c.error(), 1e-11);
}

TEST(DirectionRebase, the_last_eliminated_vertex_of_a_component_ends_the_elimination) {
  Constraints c(two_components());
  c.edit({}, {0, 1}, {3, 120});
  c.solver.rebase();
  c.edit({}, {2}, {50});
  c.edit({0}, {}, {});  // only a row is left beside the freed vertex
  EXPECT_FALSE(c.solver.eliminates());
  EXPECT_LE(c.error(), 1e-11);
  c.edit({2, 1}, {}, {});
  for (const Complex z : c.field()) EXPECT_EQ(z, 0.0);
}

TEST(DirectionRebase, refuses_without_constraints_and_restores_the_same_bits) {
  Constraints c(two_components());
  try {
    c.solver.rebase();
    FAIL() << "there is nothing to eliminate";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_EMPTY);
  }
  c.edit({}, {0, 1, 2}, {3, 20, 60});
  const auto before = c.solver.snapshot();
  const std::vector<Complex> plain = c.field();
  c.solver.rebase();
  const auto eliminated = c.solver.snapshot();
  const std::vector<Complex> rebased = c.field();
  c.solver.edit({{}, std::vector<Index>{3}, std::vector<Index>{70}});
  c.solver.restore(*before);
  EXPECT_FALSE(c.solver.eliminates());
  EXPECT_EQ(c.field(), plain);
  c.solver.restore(*eliminated);
  EXPECT_EQ(c.field(), rebased);
}

struct Thousand {
  static constexpr std::uint32_t count = 1000, columns = 160, rows = 80;
  explicit Thousand(std::shared_ptr<const hf_inner::surface::Core> core) : field(std::move(core), 1, 100000) {}
  std::vector<hf_inner::Vec3> solved() const {
    std::vector<hf_inner::Vec3> out(at(field.solver().core().size()));
    field.solve(out.data());
    return out;
  }
  std::uint32_t free_vertex() {
    for (;;) {
      const std::uint32_t v = random() % (columns * rows);
      if (!taken[v]) return v;
    }
  }
  std::vector<std::uint32_t> add(std::uint32_t n) {
    std::vector<std::uint32_t> vertices, sites(n);
    std::vector<double> vectors;
    std::normal_distribution<double> normal;
    for (std::uint32_t i = 0; i < n; ++i) {
      vertices.push_back(free_vertex());
      taken[vertices.back()] = true;
      for (int k = 0; k < 3; ++k) vectors.push_back(normal(random));
    }
    field.add(n, vertices.data(), vectors.data(), sites.data());
    return sites;
  }
  void remove(std::uint32_t site) {
    taken[field.constraints()[site].given_vertex] = false;
    field.remove(1, &site);
  }
  void move(std::uint32_t site) {
    const std::uint32_t to = free_vertex();
    taken[field.constraints()[site].given_vertex] = false;
    taken[to] = true;
    field.move(1, &site, &to);
  }
  hf_inner::field::DirectionField field;
  std::vector<bool> taken = std::vector<bool>(columns * rows, false);
  std::mt19937 random{5};
};

TEST(DirectionRebase, edits_among_a_thousand_constraints_do_not_factorise) {
  const auto core = hf_test::make_core(hf_test::torus(Thousand::columns, Thousand::rows, 0.2));
  Thousand t(core);
  t.add(Thousand::count);
  EXPECT_TRUE(t.field.solver().eliminates());
  const std::uint32_t factorisations = t.field.solver().counters().factorisations;
  for (std::uint32_t round = 0; round < 15; ++round) {
    t.add(1);
    t.move(round * 31 % Thousand::count);
    t.remove(500 + round);
  }
  EXPECT_EQ(t.field.solver().counters().factorisations, factorisations);
  EXPECT_EQ(t.field.count(), Thousand::count);

  hf_inner::field::DirectionField fresh(core, 1, 100000);
  std::vector<std::uint32_t> vertices;
  std::vector<double> vectors;
  for (const auto& c : t.field.constraints()) {
    if (c.vertex < 0) continue;
    const hf_inner::Vec3 v = fresh.solver().connection().to_space(c.vertex, c.vector);
    vertices.push_back(c.given_vertex);
    vectors.insert(vectors.end(), {v.x, v.y, v.z});
  }
  fresh.add(static_cast<std::uint32_t>(vertices.size()), vertices.data(), vectors.data(), nullptr);
  std::vector<hf_inner::Vec3> expected(at(core->size()));
  fresh.solve(expected.data());
  const std::vector<hf_inner::Vec3> got = t.solved();
  double worst = 0;
  for (std::size_t v = 0; v < got.size(); ++v) worst = std::max(worst, norm(got[v] - expected[v]));
  EXPECT_LE(worst, 1e-9);
}

TEST(DirectionRebase, long_sessions_rebase_now_and_then_and_a_kept_copy_has_the_bits_of_then) {
  const auto core = hf_test::make_core(hf_test::torus(Thousand::columns, Thousand::rows, 0.2));
  Thousand t(core);
  t.add(Thousand::count);
  const std::uint32_t factorisations = t.field.solver().counters().factorisations;
  const Thousand kept(t);
  const std::vector<hf_inner::Vec3> before = t.solved();
  std::uint32_t edits = 0;
  while (t.field.solver().counters().factorisations == factorisations && edits < 3000) {
    t.move(t.random() % Thousand::count);
    ++edits;
  }
  EXPECT_GE(edits, 50u);
  EXPECT_LT(edits, 3000u);
  const std::vector<hf_inner::Vec3> after = kept.solved();
  for (std::size_t v = 0; v < after.size(); ++v) EXPECT_EQ(norm(after[v] - before[v]), 0.0);
}

}  // namespace
