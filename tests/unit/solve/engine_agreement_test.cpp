// All engines against the dense saddle-point oracle, over random edit scripts.
#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "support/engines.h"
#include "support/meshes.h"
#include "support/oracle.h"

namespace {

using hf_test::engines;
using hf_test::PlainMesh;

// hard sites of updown are penalties of 1e8 mean diagonals
double tolerance(hf_test::EngineKind kind) { return kind == hf_test::EngineKind::updown ? 2e-6 : 1e-11; }

struct Script {
  explicit Script(std::shared_ptr<const hf_inner::surface::Core> c, int channels, std::uint32_t seed, double offset = 0)
      : core(std::move(c)), m(channels), random(seed), shift(offset) {}

  // a random site: a vertex, or a point in a triangle that shares no triangle with another point
  hf_inner::solve::Site random_site() {
    const auto pick = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
    const double compliance = pick(3) ? 0.0 : std::pow(10.0, -2.0 + pick(4));
    for (;;) {
      if (pick(3)) {
        const int v = pick(core->size());
        bool free = true;
        for (const hf_inner::solve::Site& s : sites) {
          for (const int w : s.vertex) free = free && w != v;
        }
        if (free) return hf_inner::solve::Site::at_vertex(core->mesh, v, compliance);
        continue;
      }
      const int t = pick(core->mesh.triangle_count());
      hf_inner::solve::Site site;
      bool free = true;
      double w[3] = {0.2 + 0.1 * pick(5), 0.3, 0};
      w[2] = 1 - w[0] - w[1];
      for (int k = 0; k < 3; ++k) {
        site.vertex[k] = core->mesh.triangle(t)[k];
        site.weight[k] = w[k];
        for (const hf_inner::solve::Site& s : sites) {
          for (const int x : s.vertex) free = free && x != site.vertex[k];
        }
      }
      site.component = core->mesh.component[static_cast<std::size_t>(site.vertex[0])];
      site.compliance = compliance;
      if (free) return site;
    }
  }
  void add(int count, hf_inner::solve::SiteSolver& solver) {
    std::vector<std::int32_t> slots;
    std::vector<hf_inner::solve::Site> fresh;
    for (int i = 0; i < count; ++i) {
      hf_inner::solve::Site site = random_site();
      std::size_t slot = 0;
      while (slot < sites.size() && sites[slot].component >= 0) ++slot;
      if (slot == sites.size()) {
        sites.emplace_back();
        values.resize(sites.size() * static_cast<std::size_t>(m));
      }
      sites[slot] = site;
      for (int c = 0; c < m; ++c)
        values[slot * static_cast<std::size_t>(m) + static_cast<std::size_t>(c)] =
            shift + std::uniform_real_distribution<double>(-1, 1)(random);
      slots.push_back(static_cast<std::int32_t>(slot));
      fresh.push_back(site);
    }
    hf_inner::solve::SiteEdit edit;
    edit.add = slots;
    edit.sites = fresh;
    solver.edit(edit);
  }
  void remove(int count, hf_inner::solve::SiteSolver& solver) {
    std::vector<std::int32_t> used, slots;
    for (std::size_t s = 0; s < sites.size(); ++s) {
      if (sites[s].component >= 0) used.push_back(static_cast<std::int32_t>(s));
    }
    std::shuffle(used.begin(), used.end(), random);
    for (int i = 0; i < count && i < static_cast<int>(used.size()); ++i) {
      slots.push_back(used[static_cast<std::size_t>(i)]);
      sites[static_cast<std::size_t>(used[static_cast<std::size_t>(i)])] = hf_inner::solve::Site{};
    }
    hf_inner::solve::SiteEdit edit;
    edit.remove = slots;
    solver.edit(edit);
  }
  void expect_oracle(const hf_inner::solve::SiteSolver& solver, double tolerance_of_range) const {
    std::vector<hf_inner::solve::Site> used;
    Eigen::MatrixXd s(0, m);
    std::vector<std::size_t> slot;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      if (sites[i].component < 0) continue;
      used.push_back(sites[i]);
      slot.push_back(i);
      s.conservativeResize(s.rows() + 1, m);
      for (int c = 0; c < m; ++c)
        s(s.rows() - 1, c) = values[i * static_cast<std::size_t>(m) + static_cast<std::size_t>(c)];
    }
    Eigen::MatrixXd lambda;
    const Eigen::MatrixXd exact = hf_test::dense_field(*core, used, s, &lambda);
    std::vector<double> field(static_cast<std::size_t>(core->size() * m), -7), flux(values.size());
    solver.solve(values.data(), m, field.data(), flux.data());
    double worst = 0, worst_flux = 0;
    for (int v = 0; v < core->size(); ++v) {
      for (int c = 0; c < m; ++c)
        worst = std::max(worst, std::fabs(field[static_cast<std::size_t>(v * m + c)] - exact(v, c)));
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      for (int c = 0; c < m; ++c)
        worst_flux =
            std::max(worst_flux, std::fabs(flux[slot[i] * static_cast<std::size_t>(m) + static_cast<std::size_t>(c)] -
                                           lambda(static_cast<int>(i), c)));
    }
    const double range = 2;
    EXPECT_LE(worst, tolerance_of_range * range);
    EXPECT_LE(worst_flux, 100 * tolerance_of_range * range);

    std::vector<std::int32_t> probes;
    for (int v = 0; v < core->size(); v += 7) probes.push_back(v);
    std::vector<double> some(probes.size() * static_cast<std::size_t>(m));
    solver.solve_at(values.data(), m, probes, some.data());
    for (std::size_t i = 0; i < probes.size(); ++i) {
      for (int c = 0; c < m; ++c) {
        EXPECT_NEAR(some[i * static_cast<std::size_t>(m) + static_cast<std::size_t>(c)],
                    field[static_cast<std::size_t>(probes[i] * m + c)], 1e-12 * (range + std::fabs(shift)) + 1e-13);
      }
    }
  }

  std::shared_ptr<const hf_inner::surface::Core> core;
  int m;
  std::mt19937 random;
  double shift;
  std::vector<hf_inner::solve::Site> sites;
  std::vector<double> values;
};

PlainMesh three_islands() {
  PlainMesh mesh = hf_test::grid(9, 7, 1, 0.3);
  append(mesh, hf_test::torus(12, 9), 20);
  append(mesh, hf_test::grid(3, 2, 0.01), 40);
  return mesh;
}

TEST(Engines, give_the_dense_oracles_field_over_random_edits) {
  const auto core = hf_test::make_core(three_islands());
  for (const hf_test::EngineKind kind : engines()) {
    const auto solver = hf_test::make_engine(kind, core);
    Script script(core, 2, 11);
    for (int round = 0; round < 40; ++round) {
      script.add(1 + round % 4, *solver);
      if (round % 3 == 2) script.remove(2 + round % 5, *solver);
      SCOPED_TRACE(testing::Message() << "engine " << static_cast<int>(kind) << " round " << round);
      script.expect_oracle(*solver, tolerance(kind));
    }
  }
}

TEST(Engines, walk_through_zero_sites_and_back) {
  const auto core = hf_test::make_core(three_islands());
  for (const hf_test::EngineKind kind : engines()) {
    const auto solver = hf_test::make_engine(kind, core);
    Script script(core, 1, 5);
    for (int round = 0; round < 30; ++round) {
      script.add(1 + round % 3, *solver);
      script.expect_oracle(*solver, tolerance(kind));
      script.remove(round % 2 ? 100 : 1, *solver);
      script.expect_oracle(*solver, tolerance(kind));
    }
  }
}

TEST(Engines, lose_no_digits_to_a_common_offset) {
  const auto core = hf_test::make_core(three_islands());
  for (const hf_test::EngineKind kind : engines()) {
    const auto solver = hf_test::make_engine(kind, core);
    Script script(core, 1, 7, 1e4);
    script.add(12, *solver);
    script.expect_oracle(*solver, kind == hf_test::EngineKind::updown ? 2e-6 : 1e-10);
  }
}

TEST(Green, many_channels_are_the_single_channels) {
  const auto core = hf_test::make_core(hf_test::torus(30, 20));
  const auto solver = hf_inner::solve::SiteSolver::make(core);
  Script script(core, 13, 3);
  script.add(20, *solver);
  script.expect_oracle(*solver, 1e-11);
}

TEST(Green, refuses_a_dependent_site_and_stays_as_it_was) {
  const auto core = hf_test::make_core(hf_test::torus(10, 10));
  const auto solver = hf_inner::solve::SiteSolver::make(core);
  std::vector<std::int32_t> slots;
  std::vector<hf_inner::solve::Site> sites;
  for (int k = 0; k < 3; ++k) {
    sites.push_back(hf_inner::solve::Site::at_vertex(core->mesh, core->mesh.triangle(5)[k]));
    slots.push_back(k);
  }
  hf_inner::solve::SiteEdit edit;
  edit.add = slots;
  edit.sites = sites;
  solver->edit(edit);
  hf_inner::solve::Site point;
  for (int k = 0; k < 3; ++k) {
    point.vertex[k] = core->mesh.triangle(5)[k];
    point.weight[k] = 1.0 / 3;
  }
  point.component = 0;
  const std::int32_t slot[] = {3};
  edit.add = hf_inner::Span<const std::int32_t>(slot, 1);
  edit.sites = hf_inner::Span<const hf_inner::solve::Site>(&point, 1);
  try {
    solver->edit(edit);
    FAIL() << "a point in a triangle of three hard corners was accepted";
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_CONFLICT);
    EXPECT_EQ(error.index(), 0u);
  }
  EXPECT_EQ(solver->site_count(0), 3);
  const std::vector<double> values = {1, 2, 3};
  std::vector<double> field(static_cast<std::size_t>(core->size()));
  solver->solve(values.data(), 1, field.data(), nullptr);
  EXPECT_EQ(field[static_cast<std::size_t>(sites[1].vertex[0])], 2.0);
}

TEST(Green, gives_the_same_bits_for_any_number_of_threads) {
  std::vector<double> first;
  for (const std::uint32_t threads : {1u, 2u, 4u}) {
    const auto core = hf_test::make_core(hf_test::torus(120, 90), threads);
    const auto solver = hf_inner::solve::SiteSolver::make(core);
    Script script(core, 3, 21);
    script.add(150, *solver);
    script.remove(40, *solver);
    script.add(30, *solver);
    std::vector<double> field(static_cast<std::size_t>(core->size() * 3));
    solver->solve(script.values.data(), 3, field.data(), nullptr);
    if (first.empty()) first = field;
    EXPECT_EQ(first, field) << threads << " threads";
  }
}

TEST(Green, moves_many_sites_into_the_factor_and_stays_exact_under_edits) {
  PlainMesh mesh = hf_test::torus(22, 16);
  append(mesh, hf_test::grid(9, 8, 1, 0.3), 20);
  const auto core = hf_test::make_core(mesh);
  std::uint32_t rebased = 0, freed = 0;
  for (std::uint32_t seed = 1; seed <= 6; ++seed) {
    const auto solver = hf_inner::solve::SiteSolver::make(core);
    Script script(core, 2, seed);
    // hard vertex sites only at first, all at once
    std::vector<std::int32_t> slots;
    std::vector<hf_inner::solve::Site> sites;
    for (int v = 0; v < core->size(); v += 3) {
      sites.push_back(hf_inner::solve::Site::at_vertex(core->mesh, v));
      slots.push_back(static_cast<std::int32_t>(slots.size()));
    }
    script.sites = sites;
    for (std::size_t i = 0; i < 2 * sites.size(); ++i) script.values.push_back(std::sin(static_cast<double>(i)));
    hf_inner::solve::SiteEdit edit;
    edit.add = slots;
    edit.sites = sites;
    solver->edit(edit);
    script.expect_oracle(*solver, 1e-11);
    for (int round = 0; round < 12; ++round) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << " round " << round);
      const std::uint32_t before = solver->counters().factorisations;
      script.remove(round == 7 ? 90 : 1 + round % 5, *solver);
      script.expect_oracle(*solver, 1e-10);
      freed += solver->counters().factorisations == before;
      script.add(1 + round % 4, *solver);
      script.expect_oracle(*solver, 1e-10);
    }
    rebased += solver->counters().factorisations > 1;
    script.remove(10000, *solver);
    script.expect_oracle(*solver, 1e-11);
    script.add(5, *solver);
    script.expect_oracle(*solver, 1e-11);
  }
  EXPECT_EQ(rebased, 6u) << "the cost model never eliminated";
  EXPECT_GT(freed, 20u) << "no eliminated site was ever freed";
}

TEST(Green, ten_thousand_edits_drift_by_nothing) {
  const auto core = hf_test::make_core(hf_test::torus(40, 25));
  const auto solver = hf_inner::solve::SiteSolver::make(core);
  Script script(core, 1, 99, 1e4);
  script.add(50, *solver);
  for (int i = 0; i < 5000; ++i) {
    script.add(1, *solver);
    script.remove(1, *solver);
  }
  script.expect_oracle(*solver, 1e-10);
  EXPECT_EQ(solver->counters().factorisations, 1u);
}

}  // namespace
