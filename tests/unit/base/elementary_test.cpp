// Sines, angles, exponentials and logarithms against those of long double, in units of the last place.
#include "base/elementary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>

namespace {

using namespace hf_inner;

// Points a function is tried at, over all tests 1e7 and more.
constexpr long points = 1700000;

class Random {
 public:
  std::uint64_t next() { return state_ = state_ * 6364136223846793005u + 1442695040888963407u, state_ >> 11; }
  double between(double a, double b) { return a + (b - a) * (static_cast<double>(next()) * 0x1p-53); }
  // A number of either sign whose exponent is between the two.
  double any(int low, int high) {
    return std::ldexp(between(-1, 1), low + static_cast<int>(next() % static_cast<unsigned>(high - low)));
  }

 private:
  std::uint64_t state_ = 7;
};

double units(double got, long double right) {
  if (right == 0) return got == 0 ? 0 : HUGE_VAL;
  int exponent = 0;
  std::frexp(right, &exponent);
  return static_cast<double>(std::fabs(got - right) / std::ldexp(1.0L, (exponent < -1021 ? -1021 : exponent) - 53));
}

template <class Sample>
double worst(Sample&& sample) {
  if (LDBL_MANT_DIG < 64) return 0;  // nothing to compare with
  double found = 0;
  for (long i = 0; i < points; ++i) found = std::max(found, sample(i));
  return found;
}

TEST(Elementary, SinesAndCosinesAreRightToOneUnit) {
  Random random;
  const auto angle = [&](long i) {
    return i % 4 == 0   ? random.between(-1e6, 1e6)
           : i % 4 == 1 ? random.between(-10, 10)
           : i % 4 == 2 ? random.any(-40, 1)
                        : std::floor(random.between(-1e5, 1e5)) * 1.5707963267948966;
  };
  EXPECT_LT(worst([&](long i) {
              const double x = angle(i);
              return std::max(units(sine(x), std::sin(static_cast<long double>(x))),
                              units(cosine(x), std::cos(static_cast<long double>(x))));
            }),
            1);
}

TEST(Elementary, AnglesAreRightToOneUnit) {
  Random random;
  EXPECT_LT(worst([&](long i) {
              const double y = i % 2 ? random.between(-1, 1) : random.any(-30, 30),
                           x = i % 3 ? random.between(-1, 1) : random.any(-30, 30);
              return units(arc_tangent(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
            }),
            1);
  EXPECT_LT(worst([&](long i) {
              const double x = i % 2 ? random.between(-1, 1) : (1 - std::fabs(random.any(-50, 0))) * (i % 4 ? 1 : -1);
              return units(arc_cosine(x), std::acos(static_cast<long double>(x)));
            }),
            1);
}

TEST(Elementary, ExponentialsAndLogarithmsAreRightToOneUnit) {
  Random random;
  EXPECT_LT(worst([&](long i) {
              const double x = i % 2 ? random.between(-708, 709.7) : random.any(-50, 1);
              return units(exponential(x), std::exp(static_cast<long double>(x)));
            }),
            1);
  EXPECT_LT(worst([&](long i) {
              const double x = i % 2 ? std::fabs(random.any(-1070, 1020)) : 1 + random.any(-50, 0);
              return units(logarithm(x), std::log(static_cast<long double>(x)));
            }),
            1);
}

// The bits that atan2 of the standard has at zeros and infinities.
TEST(Elementary, ZerosInfinitiesAndNansAreThoseOfTheStandard) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (const double y : {0.0, -0.0, 1.0, -1.0, inf, -inf, 1e-310, -1e-310, 1e308, 5e-324}) {
    for (const double x : {0.0, -0.0, 1.0, -1.0, inf, -inf, 1e-310, -1e-310, 1e308, 5e-324}) {
      EXPECT_DOUBLE_EQ(arc_tangent(y, x), std::atan2(y, x)) << y << " " << x;
      EXPECT_EQ(std::signbit(arc_tangent(y, x)), std::signbit(y));
    }
  }
  EXPECT_TRUE(std::isnan(arc_tangent(nan, 1)) && std::isnan(arc_tangent(1, nan)));
  EXPECT_TRUE(std::isnan(sine(inf)) && std::isnan(cosine(-inf)) && std::isnan(sine(nan)));
  EXPECT_TRUE(std::isnan(arc_cosine(1.0000000000000002)) && std::isnan(arc_cosine(nan)));
  EXPECT_EQ(arc_cosine(1), 0);
  EXPECT_EQ(sine(-0.0), 0);
  EXPECT_TRUE(std::signbit(sine(-0.0)));
  EXPECT_EQ(cosine(0), 1);
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-inf), 0);
  EXPECT_EQ(exponential(inf), inf);
  EXPECT_EQ(exponential(1000), inf);
  EXPECT_TRUE(std::isnan(exponential(nan)) && std::isnan(logarithm(nan)) && std::isnan(logarithm(-1)));
  EXPECT_EQ(logarithm(0), -inf);
  EXPECT_EQ(logarithm(1), 0);
  EXPECT_EQ(logarithm(inf), inf);
}

}  // namespace
