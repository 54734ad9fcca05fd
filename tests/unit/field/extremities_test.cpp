// Extremities: the tips of the sample creatures, where their makers put them, whatever the mesh and its place in space.
#include "field/extremities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <numeric>
#include <random>

#include "analysis_support.h"
#include "assets/creature.h"
#include "base/error.h"
#include "field/peaks.h"
#include "support/creature.h"
#include "support/full.h"

namespace {

using hf_inner::Vec3;
using hf_test::PlainMesh;

struct Tip {
  const char* name;
  Vec3 place;  // metres, as designed
};

// Hooves are found by their front or rear edge: the middle of the sole is given.
const std::map<std::string, std::vector<Tip>> tips = {{"horse",
                                                       {{"nose", {0, 1.43, 1.55}},
                                                        {"tail", {0, 0.45, -1.055}},
                                                        {"left front hoof", {0.15, 0, 0.545}},
                                                        {"right front hoof", {-0.15, 0, 0.545}},
                                                        {"left hind hoof", {0.15, 0, -0.615}},
                                                        {"right hind hoof", {-0.15, 0, -0.615}},
                                                        {"left ear", {0.066, 2.15, 1.13}},
                                                        {"right ear", {-0.066, 2.15, 1.13}}}},
                                                      {"bull",
                                                       {{"nose", {0, 0.80, 1.47}},
                                                        {"tail", {0, 0.33, -1.09}},
                                                        {"left front hoof", {0.18, 0, 0.56}},
                                                        {"right front hoof", {-0.18, 0, 0.56}},
                                                        {"left hind hoof", {0.18, 0, -0.66}},
                                                        {"right hind hoof", {-0.18, 0, -0.66}},
                                                        {"left horn", {0.36, 1.50, 1.17}},
                                                        {"right horn", {-0.36, 1.50, 1.17}}}},
                                                      {"biped",
                                                       {{"head", {0, 1.79, 0}},
                                                        {"left hand", {0.64, 0.835, 0.044}},
                                                        {"right hand", {-0.64, 0.835, 0.044}},
                                                        {"left foot", {0.13, 0.01, 0.20}},
                                                        {"right foot", {-0.13, 0.01, 0.20}}}}};

// Made once for the program.
const PlainMesh& creature(const std::string& name, std::uint32_t vertices) {
  static std::map<std::pair<std::string, std::uint32_t>, PlainMesh> made;
  const auto [entry, fresh] = made.try_emplace({name, vertices});
  if (fresh) entry->second = hf_test::from_shape(samples::welded_surface(hf_test::creature(name, vertices)));
  return entry->second;
}

struct Found {
  Vec3 place;
  double length;
};

// kind 0: Poisson, 1: geodesic. Lengths as shares of the box diagonal.
std::vector<Found> search(const PlainMesh& mesh, int kind, double least = 0.012, std::uint32_t threads = 1) {
  const auto core = hf_test::make_core(mesh, threads);
  const hf_inner::field::Extremities found =
      kind == 0 ? hf_inner::field::poisson_extremities(*core, least)
                : hf_inner::field::geodesic_extremities(hf_inner::field::Geodesics(core, 1), 40, least);
  std::vector<Found> list;
  for (const auto& point : found.points)
    list.push_back({core->mesh.to_given(core->mesh.positions[static_cast<std::size_t>(point.vertex)]), point.length});
  return list;
}

double diagonal(const PlainMesh& mesh) { return hf_test::make_core(mesh)->mesh.scale; }

// Every tip has a proposal within `near` of it, and the longest proposals are the tips: none that is no tip comes
// before the last of them.
void expect_tips(const std::string& name, const std::vector<Found>& found, double near, const char* what) {
  std::size_t last = 0;
  for (const Tip& tip : tips.at(name)) {
    std::size_t best = found.size();
    for (std::size_t i = found.size(); i-- > 0;) {
      if (norm(found[i].place - tip.place) < near) best = i;
    }
    EXPECT_LT(best, found.size()) << name << ", " << what << ": no proposal at the " << tip.name;
    last = std::max(last, best);
  }
  EXPECT_LT(last, tips.at(name).size()) << name << ", " << what << ": something else is proposed before the last tip";
}

class CreatureTips : public testing::TestWithParam<int> {};

TEST_P(CreatureTips, are_found_and_come_first) {
  for (const auto& [name, list] : tips) {
    const PlainMesh& mesh = creature(name, 6000);
    expect_tips(name, search(mesh, GetParam()), 0.06 * diagonal(mesh), "6,000 vertices");
  }
}

TEST_P(CreatureTips, stay_after_remeshing) {
  for (const auto& [name, list] : tips) {
    std::vector<std::uint32_t> sizes{4000};
    if (hf_test::is_full()) sizes = {4000, 15000, 50000};
    for (const std::uint32_t vertices : sizes) {
      const PlainMesh& mesh = creature(name, vertices);
      expect_tips(name, search(mesh, GetParam()), 0.06 * diagonal(mesh), std::to_string(vertices).c_str());
    }
  }
}

TEST_P(CreatureTips, stay_in_place_when_the_mesh_is_turned_scaled_and_renumbered) {
  for (const auto& [name, list] : tips) {
    const PlainMesh& mesh = creature(name, 6000);
    // vertices in reverse, millimetres, turned about two axes, far from the origin
    const double c = std::cos(0.7), s = std::sin(0.7), scale = 1000;
    const auto turn = [&](const Vec3& p) {
      const Vec3 q{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
      return Vec3{scale * q.x + 3e4, scale * (c * q.y - s * q.z) - 1e4, scale * (s * q.y + c * q.z)};
    };
    const std::uint32_t n = mesh.vertex_count();
    PlainMesh turned;
    turned.positions.resize(mesh.positions.size());
    for (std::uint32_t v = 0; v < n; ++v) {
      const Vec3 p = turn({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
      const std::size_t to = 3 * std::size_t(n - 1 - v);
      turned.positions[to] = p.x;
      turned.positions[to + 1] = p.y;
      turned.positions[to + 2] = p.z;
    }
    for (const std::uint32_t v : mesh.triangles) turned.triangles.push_back(n - 1 - v);
    const auto before = search(mesh, GetParam(), 0.03), after = search(turned, GetParam(), 0.03);
    EXPECT_EQ(before.size(), after.size()) << name;
    for (const Found& tip : before) {
      const auto match = std::min_element(after.begin(), after.end(), [&](const Found& a, const Found& b) {
        return norm(a.place - turn(tip.place)) < norm(b.place - turn(tip.place));
      });
      ASSERT_NE(match, after.end());
      EXPECT_LT(norm(match->place - turn(tip.place)), 0.03 * scale * diagonal(mesh)) << name;
      // in the Poisson field which of two tips stands for what lies behind both may change with the ring in the middle
      if (GetParam() == 1) {
        EXPECT_NEAR(match->length, tip.length, 0.1 * tip.length + 0.005) << name;
      }
    }
  }
}

// The mean distance is that to a few samples: they must be the same places, whichever vertex comes first.
TEST_P(CreatureTips, have_the_same_lengths_in_another_order_of_the_vertices) {
  const PlainMesh& mesh = creature("biped", 600);
  const std::vector<Found> one = search(mesh, GetParam());
  std::vector<std::uint32_t> order(mesh.vertex_count());
  std::iota(order.begin(), order.end(), 0u);
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    PlainMesh shuffled = mesh;
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
      std::copy_n(&mesh.positions[3 * std::size_t{v}], 3, &shuffled.positions[3 * std::size_t{order[v]}]);
    for (std::uint32_t& v : shuffled.triangles) v = order[v];
    const std::vector<Found> other = search(shuffled, GetParam());
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i].length, other[i].length, 1e-9) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(BothWays, CreatureTips, testing::Values(0, 1), [](const auto& info) {
  return info.param == 0 ? std::string("poisson") : std::string("geodesic");
});

TEST(Extremities, of_a_capped_tube_are_its_two_ends_and_their_length_is_half_the_tube) {
  const PlainMesh mesh = hf_test::from_shape(samples::cylinder(5, 60));  // radius 0.5, height 4
  for (const int kind : {0, 1}) {
    const auto found = search(mesh, kind, 0.1);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_GT(std::fabs(found[0].place.y - found[1].place.y), 3.9);
    // from the middle to the middle of the cap, give or take the caps
    EXPECT_NEAR(found[1].length * diagonal(mesh), kind == 0 ? 2.2 : 1.2, 0.5) << kind;
  }
}

TEST(Extremities, are_found_in_every_component_and_are_the_same_bits_for_any_threads) {
  PlainMesh mesh = hf_test::from_shape(samples::cylinder(5, 60));
  hf_test::append(mesh, hf_test::from_shape(samples::cylinder(6, 70)), 5);
  for (const int kind : {0, 1}) {
    const auto one = search(mesh, kind, 0.1), three = search(mesh, kind, 0.1, 3);
    ASSERT_EQ(one.size(), 4u) << kind;
    EXPECT_EQ(std::count_if(one.begin(), one.end(), [](const Found& f) { return f.place.x > 2.5; }), 2);
    ASSERT_EQ(three.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(one[i].length, three[i].length);
      EXPECT_EQ(norm(one[i].place - three[i].place), 0);
    }
  }
}

TEST(Extremities, can_be_cancelled) {
  const auto core = hf_test::make_core(hf_test::torus(20, 10));
  hf_inner::Progress progress;
  progress.cancel();
  const hf_inner::CallProgress call(&progress);
  try {
    hf_inner::field::poisson_extremities(*core, 0.05);
    FAIL();
  } catch (const hf_inner::Error& error) {
    EXPECT_EQ(error.code(), HF_ERROR_CANCELLED);
  }
  EXPECT_THROW(hf_inner::field::geodesic_extremities(hf_inner::field::Geodesics(core, 1), 8, 0.05), hf_inner::Error);
}

// Persistence by the definition: the lowest point of the best way from a peak to something higher, by flooding.
TEST(Peaks, have_the_persistence_that_flooding_from_the_top_finds) {
  const PlainMesh mesh = hf_test::torus(15, 11);
  const auto core = hf_test::make_core(mesh);
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    auto u = hf_test::random_field(mesh, seed);
    if (seed > 10) {  // with ties, which the larger number wins
      for (double& value : u) value = std::floor(value * (seed - 8));
    }
    const auto higher = [&](int a, int b) {
      const double x = u[static_cast<std::size_t>(a)], y = u[static_cast<std::size_t>(b)];
      return x != y ? x > y : a > b;
    };
    std::map<int, int> expected;
    std::vector<int> order(u.size()), name(u.size(), -1);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), higher);
    for (const int v : order) {
      const auto& start = core->topology().neighbour_start;
      std::vector<int> around;
      for (int i = start[static_cast<std::size_t>(v)]; i < start[static_cast<std::size_t>(v) + 1]; ++i) {
        const int w = core->topology().neighbour[static_cast<std::size_t>(i)];
        if (name[static_cast<std::size_t>(w)] >= 0) around.push_back(name[static_cast<std::size_t>(w)]);
      }
      std::sort(around.begin(), around.end(), higher);
      around.erase(std::unique(around.begin(), around.end()), around.end());
      if (around.empty()) {
        expected[v] = hf_inner::mesh::Mesh::none;
        name[static_cast<std::size_t>(v)] = v;
        continue;
      }
      for (std::size_t i = 1; i < around.size(); ++i) {
        expected[around[i]] = v;
        std::replace(name.begin(), name.end(), around[i], around[0]);
      }
      name[static_cast<std::size_t>(v)] = around[0];
    }
    const auto peaks = hf_inner::field::find_peaks(core->topology(), u, *core->memory);
    ASSERT_EQ(peaks.size(), expected.size());
    for (const hf_inner::field::Peak& peak : peaks)
      EXPECT_EQ(peak.saddle, expected.at(peak.vertex)) << "peak " << peak.vertex;
  }
}

}  // namespace
