// Geodesic distance against closed forms, and what must hold of it whatever the mesh.
#include "field/geodesics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "analysis_support.h"
#include "base/error.h"
#include "field/directions.h"
#include "field/spread.h"

namespace {

using hf_test::PlainMesh;

std::vector<double> distance(const PlainMesh& mesh, const std::vector<std::int32_t>& sources, double smoothing = 1,
                             std::uint32_t threads = 1) {
  const auto core = hf_test::make_core(mesh, threads);
  const hf_inner::field::Geodesics geodesics(core, smoothing);
  std::vector<double> d(mesh.vertex_count());
  geodesics.distance(sources, d.data());
  for (double& value : d) value *= value < 0 ? 1 : core->mesh.scale;
  return d;
}

TEST(GeodesicDistance, on_a_sphere_is_the_angle_and_the_error_falls_with_the_edge_length) {
  double last = 1;
  for (const std::uint32_t frequency : {12u, 24u, 48u}) {
    const PlainMesh mesh = hf_test::from_shape(samples::sphere(frequency));
    const auto d = distance(mesh, {7});
    double worst = 0, mean = 0;
    for (std::size_t v = 0; v < d.size(); ++v) {
      double cosine = 0;
      for (std::size_t k = 0; k < 3; ++k) cosine += mesh.positions[3 * v + k] * mesh.positions[21 + k];
      const double error = std::fabs(d[v] - std::acos(std::min(1.0, std::max(-1.0, cosine))));
      worst = std::max(worst, error);
      mean += error / static_cast<double>(d.size());
    }
    EXPECT_LT(worst, 0.8 * last) << "frequency " << frequency;
    EXPECT_LT(mean, 0.02);
    last = worst;
  }
  EXPECT_LT(last, 0.02);
}

TEST(GeodesicDistance, on_a_flat_patch_is_the_distance_to_the_nearest_source) {
  const PlainMesh mesh = hf_test::grid(80, 80, 1.0 / 80, 0.25, 2);
  const std::int32_t a = 20 * 81 + 20, b = 60 * 81 + 55;
  const auto d = distance(mesh, {a, b});
  double worst = 0, mean = 0;
  for (std::size_t v = 0; v < d.size(); ++v) {
    double nearest = 1e9;
    for (const std::int32_t s : {a, b}) {
      const std::size_t i = 3 * static_cast<std::size_t>(s);
      nearest = std::min(nearest, std::hypot(mesh.positions[3 * v] - mesh.positions[i],
                                             mesh.positions[3 * v + 1] - mesh.positions[i + 1]));
    }
    worst = std::max(worst, std::fabs(d[v] - nearest));
    mean += std::fabs(d[v] - nearest) / static_cast<double>(d.size());
  }
  EXPECT_LT(worst, 0.05);
  EXPECT_LT(mean, 0.02);
  EXPECT_EQ(d[static_cast<std::size_t>(a)], 0.0);
  EXPECT_EQ(d[static_cast<std::size_t>(b)], 0.0);
}

TEST(GeodesicDistance, scales_with_the_mesh_and_does_not_move_with_it) {
  const PlainMesh mesh = hf_test::torus(40, 20);
  PlainMesh moved = mesh;
  for (std::size_t i = 0; i < moved.positions.size(); ++i)
    moved.positions[i] = 1000 * mesh.positions[i] + 5e4 * static_cast<double>(i % 3);
  const auto d = distance(mesh, {3}), e = distance(moved, {3});
  for (std::size_t v = 0; v < d.size(); ++v) EXPECT_NEAR(e[v], 1000 * d[v], 1e-6);
}

TEST(GeodesicDistance, is_minus_one_where_no_source_is_and_the_same_bits_for_any_threads) {
  PlainMesh mesh = hf_test::torus(120, 100);
  const std::uint32_t first = mesh.vertex_count();
  hf_test::append(mesh, hf_test::from_shape(samples::sphere(6)), 10);
  const auto d = distance(mesh, {5}), e = distance(mesh, {5}, 1, 3);
  EXPECT_EQ(d, e);
  for (std::size_t v = 0; v < d.size(); ++v) EXPECT_EQ(d[v] < 0, v >= first);
}

TEST(GeodesicDistance, is_finite_on_needles_and_far_from_the_source) {
  // a strip 2,000 edges long: the heat at its end would be exp(-2000)
  const PlainMesh strip = hf_test::grid(2000, 1);
  const auto d = distance(strip, {0});
  for (std::uint32_t i = 1; i <= 2000; ++i) EXPECT_GT(d[i], d[i - 1]);
  EXPECT_NEAR(d[2000], 2000, 20);
  PlainMesh needles = hf_test::grid(20, 20);
  for (std::size_t v = 0; v < needles.positions.size(); v += 3) needles.positions[v] *= 1e-7;
  for (const double value : distance(needles, {0})) EXPECT_TRUE(std::isfinite(value) && value >= 0);
}

TEST(SpreadSamples, are_far_apart_cover_every_component_and_share_its_area) {
  PlainMesh mesh = hf_test::torus(40, 24);
  hf_test::append(mesh, hf_test::grid(1, 1), 10);
  const auto core = hf_test::make_core(mesh);
  const auto areas = hf_inner::mesh::vertex_areas(core->mesh, *core->memory);
  const auto samples = hf_inner::field::spread_samples(core->mesh, core->topology(), areas, 12, *core->memory);
  for (int c = 0; c < 2; ++c) {
    double sum = 0;
    std::vector<int> chosen;
    for (std::size_t i = 0; i < 12; ++i) {
      const std::size_t k = static_cast<std::size_t>(c) * 12 + i;
      sum += samples.share[k];
      if (samples.vertex[k] != hf_inner::mesh::Mesh::none) chosen.push_back(samples.vertex[k]);
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_EQ(chosen.size(), c == 0 ? 12u : 4u);
    std::sort(chosen.begin(), chosen.end());
    EXPECT_EQ(std::unique(chosen.begin(), chosen.end()), chosen.end());
  }
  double nearest = 1e9;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      nearest = std::min(nearest, norm(core->mesh.positions[static_cast<std::size_t>(samples.vertex[i])] -
                                       core->mesh.positions[static_cast<std::size_t>(samples.vertex[j])]));
    }
  }
  EXPECT_GT(nearest * core->mesh.scale, 1.0);  // the torus has an area of 79: discs of radius 1.4
}

// -grad / |grad| of a linear function by the textbook formula, times the weight, summed.
TEST(Directions, are_unit_vectors_to_1e_9_however_faint_the_heat_and_many_the_channels) {
  std::mt19937_64 random(5);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (const double faint : {1.0, 1e-200, 1e-290}) {
    for (std::int32_t channels = 1; channels <= 8; ++channels) {
      const std::size_t k = static_cast<std::size_t>(channels);
      std::vector<hf_inner::field::TriangleFrame> frames;
      std::vector<double> heat(20 * k), weight(2 * k), sums(100, 0.0);
      for (double& u : heat) u = faint * number();
      for (double& w : weight) w = number();
      for (std::int32_t t = 0; t < 50; ++t) {
        const std::int32_t row = t % 18;
        frames.push_back({0.1 + number(), number() - 0.5, 0.01 + number(), {row, row + 2, row + 1}, t % 2});
      }
      for (std::size_t c = 0; c < k; ++c) heat[3 * k + c] = heat[4 * k + c] = heat[5 * k + c] = 0.5 * faint;  // flat
      hf_inner::field::add_directions({frames.data(), heat.data(), weight.data(), channels, sums.data()}, 0, 50);
      for (std::size_t t = 0; t < frames.size(); ++t) {
        const hf_inner::field::TriangleFrame& f = frames[t];
        double x = 0, y = 0;
        for (std::size_t c = 0; c < k; ++c) {
          const auto u = [&](std::size_t corner) {
            return heat[static_cast<std::size_t>(f.row[corner]) * k + c] / faint;
          };
          const double gx = (u(1) - u(0)) / f.along, gy = (u(2) - u(0) - gx * f.px) / f.py, length = std::hypot(gx, gy);
          if (!(length > 0)) continue;
          const double w = weight[static_cast<std::size_t>(f.component) * k + c];
          x -= w * gx / length;
          y -= w * gy / length;
        }
        EXPECT_NEAR(sums[2 * t], x, 1e-9) << faint << ", " << channels << " channels";
        EXPECT_NEAR(sums[2 * t + 1], y, 1e-9) << faint << ", " << channels << " channels";
      }
    }
  }
}

TEST(MeanDistance, of_a_component_is_the_one_it_has_alone) {
  const PlainMesh torus = hf_test::torus(40, 24);
  PlainMesh backwards = torus;  // numbered backwards: other samples with other shares
  const std::uint32_t n = torus.vertex_count();
  for (std::uint32_t v = 0; v < n; ++v) {
    for (std::uint32_t k = 0; k < 3; ++k) backwards.positions[3 * (n - 1 - v) + k] = torus.positions[3 * v + k];
  }
  for (std::uint32_t& v : backwards.triangles) v = n - 1 - v;
  PlainMesh both = torus;
  append(both, backwards, 10);
  const auto mean = [](const PlainMesh& mesh) {
    const auto core = hf_test::make_core(mesh);
    std::vector<double> d(mesh.vertex_count());
    hf_inner::field::Geodesics(core, 1).average(12, d.data());
    for (double& x : d) x *= core->mesh.scale;
    return d;
  };
  const auto a = mean(torus), b = mean(backwards), together = mean(both);
  for (std::size_t v = 0; v < n; ++v) {
    EXPECT_NEAR(together[v] - together[0], a[v] - a[0], 1e-8);
    EXPECT_NEAR(together[n + v] - together[n], b[v] - b[0], 1e-8);
  }
}

struct Edge {
  std::size_t a, b;
  double length;
};

std::vector<Edge> edges_of(const hf_inner::surface::Core& core) {
  std::vector<Edge> edges;
  for (std::int32_t e = 0; e < core.topology().edge_count(); ++e) {
    const std::size_t a = static_cast<std::size_t>(core.topology().first(e));
    const std::size_t b = static_cast<std::size_t>(core.topology().second(e));
    edges.push_back({a, b, norm(core.mesh.positions[a] - core.mesh.positions[b])});
  }
  return edges;
}

// Distance from the nearest of the sources by Bellman and Ford, over the edges.
std::vector<double> edge_distance(const hf_inner::surface::Core& core, const std::vector<Edge>& edges,
                                  const std::vector<std::int32_t>& sources) {
  std::vector<double> d(static_cast<std::size_t>(core.size()), 1e9);
  for (const std::int32_t s : sources) d[static_cast<std::size_t>(s)] = 0;
  double* const to = d.data();
  for (bool again = true; again;) {
    again = false;
    for (const Edge& e : edges) {
      const double from_a = to[e.a] + e.length, from_b = to[e.b] + e.length;
      if (from_a < to[e.b]) {
        to[e.b] = from_a;
        again = true;
      }
      if (from_b < to[e.a]) {
        to[e.a] = from_b;
        again = true;
      }
    }
  }
  return d;
}

// What Gonzalez's choice gives: no vertex is much farther from the samples than they are from one another, and the
// shares are about those of the vertices nearest to each. By patches (10,000 vertices, 12 samples) and without (30).
TEST(SpreadSamples, lie_as_far_apart_as_the_surface_is_from_them_by_patches_too) {
  const PlainMesh mesh = hf_test::torus(125, 80);
  const auto core = hf_test::make_core(mesh);
  const std::vector<Edge> edges = edges_of(*core);
  for (const std::int32_t count : {12, 30}) {
    const auto samples =
        hf_inner::field::spread_samples(core->mesh, core->topology(), core->areas, count, *core->memory);
    const std::vector<std::int32_t> chosen(samples.vertex.begin(), samples.vertex.end());
    const std::vector<double> nearest = edge_distance(*core, edges, chosen);
    const double radius = *std::max_element(nearest.begin(), nearest.end());
    double apart = 1e9, worst_share = 0;
    std::vector<std::vector<double>> from;
    for (const std::int32_t s : chosen) from.push_back(edge_distance(*core, edges, {s}));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) apart = std::min(apart, from[i][static_cast<std::size_t>(chosen[j])]);
      double share = 0, total = 0;
      for (std::size_t v = 0; v < core->areas.size(); ++v) {
        total += core->areas[v];
        if (from[i][v] == nearest[v]) share += core->areas[v];
      }
      worst_share = std::max(worst_share, std::fabs(share / total - samples.share[i]) * count);
    }
    EXPECT_LT(radius, 1.25 * apart) << count;
    EXPECT_LT(worst_share, count == 12 ? 0.35 : 1e-9) << count;
  }
}

TEST(SpreadSamples, share_out_the_area_of_every_vertex_of_a_patch) {
  const auto core = hf_test::make_core(hf_test::torus(100, 60));
  hf_inner::Vector<double> areas(core->areas.size(), 0.0, core->memory.get());
  areas[1] = 2;  // beside the middle of the first patch
  double sum = 0;
  for (const double share :
       hf_inner::field::spread_samples(core->mesh, core->topology(), areas, 6, *core->memory).share)
    sum += share;
  EXPECT_EQ(sum, 1);
}

TEST(SpreadSamples, are_as_many_as_asked_for_around_a_vertex_of_ten_thousand_edges) {
  const std::uint32_t around = 10000;
  PlainMesh fan;
  fan.positions = {0, 0, 0};
  for (std::uint32_t i = 0; i < around; ++i) {
    const double angle = 8 * std::atan(1.0) * i / around;
    fan.positions.insert(fan.positions.end(), {std::cos(angle), std::sin(angle), 0.0});
    fan.triangles.insert(fan.triangles.end(), {0, i + 1, (i + 1) % around + 1});
  }
  const auto core = hf_test::make_core(fan);
  const auto samples = hf_inner::field::spread_samples(core->mesh, core->topology(), core->areas, 8, *core->memory);
  double sum = 0;
  for (const double share : samples.share) sum += share;
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(std::count(samples.vertex.begin(), samples.vertex.end(), hf_inner::mesh::Mesh::none), 0);
}

}  // namespace
