// The nearest point of a triangle: needles too.
#include "mesh/nearest_triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace hf_inner;
using namespace hf_inner::mesh;

// The nearest of many points of the triangle, as an upper bound.
double sampled(Vec3 p, const Vec3 (&corner)[3]) {
  double least = HUGE_VAL;
  for (int i = 0; i <= 60; ++i) {
    for (int j = 0; j <= 60 - i; ++j) {
      const Vec3 q = (i / 60.0) * corner[0] + (j / 60.0) * corner[1] + ((60 - i - j) / 60.0) * corner[2];
      least = std::min(least, norm(p - q));
    }
  }
  return least;
}

// Rounding once decided the weights of needles: they were negative, and the distance was 0.
TEST(NearestTriangle, weights_of_needles_are_those_of_a_point_inside) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&] { return Vec3{unit(random), unit(random), unit(random)}; };
  for (int i = 0; i < 3000; ++i) {
    const double width = std::pow(10.0, -18.0 * (i % 20) / 19);
    const Vec3 a = point(), b = point(), along = a + (0.5 + 0.5 * unit(random)) * (b - a);
    const Vec3 corner[3] = {a, b, along + width * point()};
    const Vec3 p = i % 3 == 0 ? along + width * point() : point();
    double weight[3];
    const double distance = std::sqrt(squared_to_triangle(p, corner[0], corner[1], corner[2], weight));
    Vec3 nearest;
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(weight[k], 0) << i;
      nearest = nearest + weight[k] * corner[k];
    }
    EXPECT_NEAR(weight[0] + weight[1] + weight[2], 1, 1e-12) << i;
    EXPECT_NEAR(norm(p - nearest), distance, 1e-7) << i;
    EXPECT_LE(distance, sampled(p, corner) + 1e-5) << i;
  }
}

}  // namespace
