// The acceleration of fixed-point iterations, on linear maps whose fixed point is known.
#include "deform/anderson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using hf_inner::Memory;
using hf_inner::deform::Anderson;

// z <- rate z + (1 - rate): every entry goes to 1, entry i by its own rate.
struct Map {
  std::vector<double> rate;
  std::vector<double> residual(const std::vector<double>& z) const {
    std::vector<double> f(z.size());
    for (std::size_t i = 0; i < z.size(); ++i) f[i] = (1 - rate[i % rate.size()]) * (1 - z[i]);
    return f;
  }
};

double off(const std::vector<double>& z) {
  double largest = 0;
  for (const double x : z) largest = std::max(largest, std::fabs(x - 1));
  return largest;
}

// With five rates, five differences hold all there is to learn; damping costs two steps more.
TEST(Anderson, AFewSlowMotionsAreFoundInAFewSteps) {
  const Map map{{0.999, 0.99, 0.9, 0.5, 0.0}};
  Memory memory;
  Anderson anderson(memory);
  std::vector<double> z(100, 0.0), plain = z;
  anderson.fit(z.size());
  for (int i = 0; i < 9; ++i) {
    const std::vector<double> f = map.residual(z), g = map.residual(plain);
    anderson.step(z, f, 1, 1e9);
    for (std::size_t k = 0; k < plain.size(); ++k) plain[k] += g[k];
  }
  EXPECT_LT(off(z), 1e-6);
  EXPECT_GT(off(plain), 0.99);
}

TEST(Anderson, WithoutStepsItIsThePlainIteration) {
  const Map map{{0.5, 0.25}};
  Memory memory;
  Anderson anderson(memory);
  std::vector<double> z(8, 0.0);
  anderson.fit(z.size());
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> f = map.residual(z);
    std::vector<double> next = z;
    for (std::size_t k = 0; k < z.size(); ++k) next[k] += f[k];
    anderson.forget();
    anderson.step(z, f, 1, 1e9);
    EXPECT_EQ(z, next);
  }
}

// The map's target moves and its rates stay: what was learnt before still holds.
TEST(Anderson, StepsOfEarlierFramesCountOn) {
  const Map map{{0.999, 0.99, 0.9}};
  Memory memory;
  Anderson anderson(memory);
  std::vector<double> z(9, 0.0);
  anderson.fit(z.size());
  for (int i = 0; i < 5; ++i) anderson.step(z, map.residual(z), 1, 1e9);
  for (double& x : z) x -= 0.5;  // as if the target had moved by 0.5
  anderson.break_off();
  anderson.step(z, map.residual(z), 1, 1e9);
  EXPECT_LT(off(z), 1e-6);
}

// A leap is shortened as a whole: its direction stays, and no block goes farther than allowed.
TEST(Anderson, LeapsAreShortened) {
  const Map map{{0.999, 0.99}};
  Memory memory;
  Anderson free(memory), held(memory);
  std::vector<double> z(4, 0.0), far = z;
  free.fit(4);
  held.fit(4);
  for (int i = 0; i < 2; ++i) {
    const std::vector<double> f = map.residual(z);
    free.step(z, f, 2, 1e9);
    const std::vector<double> from = far, g = map.residual(far);
    held.step(far, g, 2, 0.01);
    for (std::size_t b = 0; b < 4; b += 2)
      EXPECT_LE(std::hypot(far[b] - from[b] - g[b], far[b + 1] - from[b + 1] - g[b + 1]), 0.01 * (1 + 1e-12));
  }
  EXPECT_GT(z[1], 0.05);
  EXPECT_LT(far[1], 0.05);
}

TEST(Anderson, AtTheFixedPointNothingMoves) {
  Memory memory;
  Anderson anderson(memory);
  std::vector<double> z(12, 1.0);
  anderson.fit(z.size());
  for (int i = 0; i < 30; ++i) {
    anderson.step(z, std::vector<double>(12, 0.0), 1, 1e9);
    EXPECT_EQ(off(z), 0.0);
  }
}

TEST(Anderson, ACopyGoesOnAsTheOriginal) {
  const Map map{{0.99, 0.7}};
  Memory memory;
  Anderson anderson(memory);
  std::vector<double> z(6, 0.0);
  anderson.fit(z.size());
  for (int i = 0; i < 3; ++i) anderson.step(z, map.residual(z), 1, 1e9);
  Anderson copy(anderson, memory);
  std::vector<double> same = z;
  anderson.step(z, map.residual(z), 1, 1e9);
  copy.step(same, map.residual(same), 1, 1e9);
  EXPECT_EQ(z, same);
}

}  // namespace
