// dependent_site against what geometry says: how many independent values a triangle, a line and an edge take.
#include "solve/dependence.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "base/index.h"
#include "base/memory.h"

namespace {

using hf_inner::at;
using hf_inner::solve::HardSite;
using hf_inner::solve::Site;

Site corner(std::int32_t vertex) {
  Site site;
  site.vertex[0] = vertex;
  site.weight[0] = 1;
  site.component = 0;
  return site;
}

// A point of triangle (a, a + 1, a + 2).
Site point(std::int32_t a, double u, double v) {
  Site site;
  for (int k = 0; k < 3; ++k) site.vertex[k] = a + k;
  site.weight[0] = u;
  site.weight[1] = v;
  site.weight[2] = 1 - u - v;
  site.component = 0;
  return site;
}

std::int32_t lost_of(const std::vector<Site>& sites, bool suspect = true) {
  hf_inner::Memory memory;
  std::vector<HardSite> hard;
  for (const Site& site : sites) hard.push_back({&site, static_cast<std::int32_t>(hard.size()), suspect});
  return hf_inner::solve::dependent_site({hard.data(), hard.size()}, memory);
}

TEST(Dependence, a_triangle_takes_three_points_and_names_the_fourth) {
  const std::vector<Site> three = {point(0, 0.2, 0.3), point(0, 0.6, 0.1), point(0, 0.1, 0.8)};
  EXPECT_EQ(lost_of(three), -1);
  std::vector<Site> four = three;
  four.push_back(point(0, 0.3, 0.3));
  EXPECT_EQ(lost_of(four), 3);
  EXPECT_EQ(lost_of(four, false), -1) << "only groups with a suspect are looked at";
}

TEST(Dependence, points_on_a_line_and_an_edge_between_its_ends) {
  EXPECT_EQ(lost_of({point(0, 0.25, 0.25), point(0, 0.5, 0.25), point(0, 0.625, 0.25)}), 2);
  EXPECT_EQ(lost_of({corner(0), point(0, 0.5, 0.5), corner(1)}), 2);
  EXPECT_EQ(lost_of({corner(0), corner(1), corner(2), point(0, 0.5, 0.25)}), 3);
}

TEST(Dependence, triangles_share_what_their_common_edge_takes) {
  // triangles 0 1 2 and 1 2 3: four vertices, so four independent points, not five
  const std::vector<Site> four = {point(0, 0.5, 0.25), point(0, 0.25, 0.5), point(1, 0.25, 0.25), point(1, 0.1, 0.2)};
  EXPECT_EQ(lost_of(four), -1);
  std::vector<Site> five = four;
  five.push_back(point(1, 0.5, 0.2));
  EXPECT_EQ(lost_of(five), 4);
}

TEST(Dependence, crowded_points_are_independent_and_far_ones_have_nothing_to_do_with_them) {
  const double d = 1e-4;
  EXPECT_EQ(lost_of({point(0, 0.3, 0.3), point(0, 0.3 + d, 0.3), point(0, 0.3, 0.3 + d)}), -1);
  EXPECT_EQ(lost_of({point(0, 0.3, 0.3), point(0, 0.3 + d, 0.3), point(0, 0.3, 0.3 + d), point(0, 0.3 + d, 0.3 + d)}),
            3);
  EXPECT_EQ(lost_of({point(0, 0.3, 0.3), point(10, 0.3, 0.3), corner(20), corner(0)}), -1);
  EXPECT_EQ(lost_of({}), -1);
}

// Three points near a line, at distances from far above to far below what counts as dependent. Their order changes what
// each finds before it, and must not change whether the set is taken.
TEST(Dependence, the_set_decides_and_not_its_order) {
  int taken = 0, refused = 0;
  for (int step = 0; step <= 60; ++step) {
    const double d = 1e-3 * std::pow(10.0, -step / 15.0);
    std::vector<Site> sites = {point(0, 0.2, 0.2), point(0, 0.2 + 0.01, 0.2), point(0, 0.7, 0.2 + d)};
    const bool first = lost_of(sites) < 0;
    (first ? taken : refused)++;
    for (const auto& order : {std::array<int, 3>{0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}) {
      const std::vector<Site> other = {sites[at(order[0])], sites[at(order[1])], sites[at(order[2])]};
      EXPECT_EQ(lost_of(other) < 0, first) << "d " << d;
    }
  }
  EXPECT_GT(taken, 5);
  EXPECT_GT(refused, 5);
}

}  // namespace
