// Welding by tolerance against its definition: all pairs compared, sets joined, the smallest vertex stands for its set.
#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/progress.h"

namespace {

using hf_inner::Vec3;
using Points = std::vector<Vec3>;
using Representatives = std::vector<std::int32_t>;

Representatives welded(const Points& points, double tolerance) {
  hf_inner::mesh::MeshInput input;
  input.vertex_count = static_cast<std::uint32_t>(points.size());
  input.positions = hf_inner::ConstRows(&points.data()->x, sizeof(Vec3));
  input.weld = hf_inner::mesh::Weld::tolerance;
  input.weld_tolerance = tolerance;
  hf_inner::Memory memory;
  const auto found = hf_inner::mesh::weld(input, memory);
  return {found.begin(), found.end()};
}

Representatives by_definition(const Points& points, double tolerance, double scale = 1) {
  Representatives parent(points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](std::int32_t v) {
    while (parent[static_cast<std::size_t>(v)] != v) v = parent[static_cast<std::size_t>(v)];
    return v;
  };
  const double limit = (scale * tolerance) * (scale * tolerance);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Vec3 d = scale * (points[j] - points[i]);
      if (dot(d, d) > limit) continue;
      const std::int32_t a = find(static_cast<std::int32_t>(i)), b = find(static_cast<std::int32_t>(j));
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  for (std::size_t v = 0; v < points.size(); ++v) parent[v] = find(static_cast<std::int32_t>(v));
  return parent;
}

// The same set in another order finds another smallest vertex; both orders are compared.
void expect_the_definition(Points points, double tolerance, const char* what, double scale = 1) {
  EXPECT_EQ(welded(points, tolerance), by_definition(points, tolerance, scale)) << what;
  std::mt19937 random(7);
  std::shuffle(points.begin(), points.end(), random);
  EXPECT_EQ(welded(points, tolerance), by_definition(points, tolerance, scale)) << what << ", shuffled";
}

std::size_t sets_of(const Representatives& found) {
  std::size_t count = 0;
  for (std::size_t v = 0; v < found.size(); ++v) count += found[v] == static_cast<std::int32_t>(v);
  return count;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * (double(engine_()) / 4294967296.0); }
  Vec3 in_box(double side) { return {(*this)(0, side), (*this)(0, side), (*this)(0, side)}; }
  Vec3 on_sphere() {
    for (;;) {
      const Vec3 p = in_box(2) - Vec3{1, 1, 1};
      if (const double length = norm(p); length > 0.1 && length < 1) return (1 / length) * p;
    }
  }

 private:
  std::mt19937 engine_;
};

// From a few points a cell to all in one, so that sets percolate, split and merge.
TEST(WeldTolerance, joins_scattered_points_as_all_pairs_would) {
  Random random(1);
  for (const double side : {20.0, 8.0, 5.0, 3.0, 1.5, 0.7, 0.3}) {
    for (int round = 0; round < 4; ++round) {
      Points points(500);
      for (Vec3& p : points) p = random.in_box(side);
      expect_the_definition(points, 1, "scattered");
      expect_the_definition(points, 0.1, "scattered, fine");
    }
  }
}

// Spacings of exactly one tolerance join, the next number above does not; 0.1 is no binary fraction.
TEST(WeldTolerance, joins_a_grid_at_exactly_the_tolerance) {
  for (const double tolerance : {1.0, 0.1, 1e-3, 0.30000000000000004, 7e5}) {
    for (const double spacing : {tolerance, std::nextafter(tolerance, 0), std::nextafter(tolerance, 1e9),
                                 1.0000001 * tolerance, tolerance / std::sqrt(2.0), tolerance / std::sqrt(3.0)}) {
      for (const double offset : {0.0, -0.37 * tolerance, 1000.1 * tolerance}) {
        Points points;
        for (int i = 0; i < 343; ++i)
          points.push_back({offset + (i % 7) * spacing, offset + (i / 7 % 7) * spacing, offset + (i / 49) * spacing});
        expect_the_definition(points, tolerance, "grid");
      }
    }
  }
}

// Lone pairs in every direction, the diagonals of a cell among them, just within the tolerance and just beyond.
TEST(WeldTolerance, decides_lone_pairs_in_every_direction) {
  Random random(8);
  for (const double distance : {0.9999, 1.0, 1.0001, 1.05}) {
    Points points;
    for (int i = 0; i < 600; ++i) {
      const Vec3 direction =
          i % 4 ? random.on_sphere() : Vec3{std::sqrt(1.0 / 3), std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)};
      const Vec3 start{10.0 * i, 10.0 * (i % 7), 10.0 * (i % 11)};
      points.push_back(start);
      points.push_back(start + distance * direction);
    }
    expect_the_definition(points, 1, "lone pairs");
  }
}

TEST(WeldTolerance, joins_clusters_and_copies_as_all_pairs_would) {
  Random random(2);
  for (const double gap : {0.9, 1.0, 1.0001, 1.02, 1.2}) {
    Points points;
    for (int cluster = 0; cluster < 12; ++cluster) {
      const Vec3 centre{gap * (cluster % 3), gap * (cluster / 3 % 2), gap * (cluster / 6)};
      for (int i = 0; i < 60; ++i) points.push_back(centre + random.in_box(0.01));
      for (int i = 0; i < 8; ++i) points.push_back(points[points.size() - 20]);
    }
    points.push_back({-0.0, 0.0, -0.0});
    points.push_back({0.0, -0.0, 0.0});
    expect_the_definition(points, 1, "clusters");
  }
}

// Nearly touching sets, where boxes overlap and only the points themselves tell.
TEST(WeldTolerance, decides_sets_that_almost_touch) {
  Random random(3);
  for (const double excess : {-1e-3, -1e-9, -1e-14, 0.0, 1e-15, 1e-14, 1e-12, 1e-6, 1e-3}) {
    const double radius = 1 + excess;
    Points ball, sheets, wheel;
    const Vec3 centre{0.3, 0.2, 0.1}, axis{2.0 / 3, 2.0 / 3, 1.0 / 3}, u{-2.0 / 3, 1.0 / 3, 2.0 / 3},
        w{1.0 / 3, -2.0 / 3, 2.0 / 3};
    for (int i = 0; i < 300; ++i) {
      // a sphere round a speck, two slanted sheets, a circle round a piece of its axis
      ball.push_back(centre + radius * random.on_sphere());
      ball.push_back(centre + 1e-9 * random.on_sphere());
      const double s = random(0, 0.5), t = random(0, 0.5);
      sheets.push_back(s * u + t * w);
      sheets.push_back(s * u + t * w + radius * axis);
      const double angle = random(0, 6.28);
      wheel.push_back(centre + radius * std::cos(angle) * u + radius * std::sin(angle) * w);
      wheel.push_back(centre + random(-1e-8, 1e-8) * axis);
    }
    expect_the_definition(ball, 1, "sphere round a speck");
    expect_the_definition(sheets, 1, "slanted sheets");
    expect_the_definition(wheel, 1, "circle round its axis");
  }
}

// Cells keep their size however far the points lie apart; differences keep their digits at any scale.
TEST(WeldTolerance, holds_at_any_distance_and_scale) {
  Random random(4);
  for (const double far : {1e6, 1e10, 1e15, 1e250}) {
    Points points;
    for (int i = 0; i < 200; ++i) points.push_back(random.in_box(3e-8));
    for (int i = 0; i < 50; ++i) points.push_back({-far, -far * random(0.5, 1), far});
    expect_the_definition(points, 1e-8, "far points among fine ones");
  }
  for (const double scale : {1e-300, 1e-200, 1e-160, 1e160, 1e200, 1e290}) {
    Points points(300);
    for (Vec3& p : points) p = scale * random.in_box(4);
    expect_the_definition(points, scale, "scaled", 1 / scale);
  }
  const double least = std::numeric_limits<double>::denorm_min();
  expect_the_definition({{0, 0, 0}, {least, 0, 0}, {3 * least, 0, 0}, {5, 0, 0}}, least, "smallest tolerance", 1e300);
  EXPECT_EQ(sets_of(welded({{0, 0, 0}, {1, 2, 3}, {-1e290, 0, 0}}, 1e300)), 1u);
}

TEST(WeldTolerance, refuses_a_tolerance_that_is_none) {
  for (const double tolerance : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(welded({{0, 0, 0}}, tolerance), hf_inner::Error) << tolerance;
  }
}

TEST(WeldTolerance, reports_shares_that_never_fall) {
  Random random(5);
  Points points(200000);
  for (Vec3& p : points) p = random.in_box(40);
  hf_inner::Progress progress;
  std::atomic<bool> done{false};
  bool fell = false;
  std::thread watcher([&] {
    for (float last = 0; !done; std::this_thread::yield()) {
      const float now = progress.fraction();
      fell = fell || now < last;
      last = now;
    }
  });
  {
    const hf_inner::CallProgress call(&progress);
    welded(points, 1);
  }
  done = true;
  watcher.join();
  EXPECT_FALSE(fell);
  EXPECT_EQ(progress.fraction(), 1.0f);
}

// Cancels inside the nth allocation, so that every part of the work is met.
struct Stopper {
  hf_inner::Progress progress;
  int left = 0;
};

TEST(WeldTolerance, heeds_a_cancel_in_every_part_of_its_work) {
  Random random(6);
  Points scattered(20000), dense(20000);
  for (Vec3& p : scattered) p = random.in_box(17);
  for (std::size_t i = 0; i < dense.size(); ++i) dense[i] = (i % 2 ? 1.001 : 0.001) * random.on_sphere();
  for (const Points* points : {&scattered, &dense}) {
    hf_inner::mesh::MeshInput input;
    input.vertex_count = static_cast<std::uint32_t>(points->size());
    input.positions = hf_inner::ConstRows(&points->data()->x, sizeof(Vec3));
    input.weld = hf_inner::mesh::Weld::tolerance;
    input.weld_tolerance = 1;
    for (int allocation = 0;; ++allocation) {
      Stopper stopper;
      stopper.left = allocation;
      hf_allocator hooks{};
      hooks.user = &stopper;
      hooks.allocate = [](void* user, std::size_t bytes, std::size_t) {
        auto& own = *static_cast<Stopper*>(user);
        if (own.left-- == 0) own.progress.cancel();
        return std::malloc(bytes);
      };
      hooks.release = [](void*, void* block, std::size_t, std::size_t) { std::free(block); };
      hf_inner::Memory memory(hooks);
      try {
        const hf_inner::CallProgress call(&stopper.progress);
        hf_inner::mesh::weld(input, memory);
        EXPECT_GE(stopper.left, 0) << "allocation " << allocation << " was not the last, and nothing stopped";
        EXPECT_GT(allocation, 10);
        break;
      } catch (const hf_inner::Error& error) {
        EXPECT_EQ(error.code(), HF_ERROR_CANCELLED);
        EXPECT_LT(stopper.progress.fraction(), 1.0f) << allocation;
      }
      EXPECT_EQ(memory.live_bytes(), 0u);
    }
  }
}

}  // namespace
