// Rotations are proper, best, and exact on every degenerate input.
#include "deform/rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "cases.h"
#include "deform/rotation_batch.h"
#include "deform/rotation_step.h"
#include "support/dense.h"
#include "support/eigen.h"
#include "support/full.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using deform_test::pi;

Mat3 outer(Vec3 a, Vec3 b) {
  Mat3 m;
  add_outer(m, 1, a, b);
  return m;
}

struct Random {
  std::mt19937_64 engine{7};
  std::normal_distribution<double> normal;
  double next() { return normal(engine); }
  Vec3 vector() { return {next(), next(), next()}; }
  Quaternion rotation() { return normalised({{next(), next(), next()}, next()}); }
  Mat3 matrix() {
    Mat3 m;
    for (int k = 0; k < 9; ++k) m(k / 3, k % 3) = next();
    return m;
  }
  // full, planar, collinear, mirrored, symmetric, tiny, huge, nearly degenerate, zero
  Mat3 any(int kind) {
    switch (kind % 9) {
      case 0:
        return matrix();
      case 1:
        return outer(vector(), vector()) + outer(vector(), vector());
      case 2:
        return outer(vector(), vector());
      case 3:
        return -1.0 * rotation().toRotationMatrix();
      case 4: {
        const Mat3 m = matrix();
        return m * m.transpose();
      }
      case 5:
        return 1e-200 * matrix();
      case 6:
        return 1e200 * matrix();
      case 7:
        return outer(vector(), vector()) + 1e-9 * matrix();
      default:
        return Mat3::Zero();
    }
  }
};

// max tr(R'S) over rotations, also of tiny and huge ones
double best_value(const Mat3& s) {
  const double scale = s.cwiseAbs().maxCoeff();
  if (!(scale > 0)) return 0;
  const Mat3 unit = s / scale;
  return scale * hf_test::best_rotation_value(unit.data());
}

double deviation_from_rotation(const Mat3& r) {
  const Mat3 product = r.transpose() * r;
  double largest = std::fabs(r.determinant() - 1);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) largest = std::max(largest, std::fabs(product(i, j) - (i == j ? 1.0 : 0.0)));
  }
  return largest;
}

TEST(Rotation, IsProperAndBestOnRandomAndDegenerateMatrices) {
  Random random;
  double improper = 0, short_of_best = 0;
  const int count = hf_test::is_full() ? 1000000 : 200000;
  for (int k = 0; k < count; ++k) {
    const Mat3 s = random.any(k);
    const Quaternion near = random.rotation();
    const Mat3 r = (k % 2 ? best_rotation(s, near) : best_rotation_from(s, near)).toRotationMatrix();
    improper = std::max(improper, deviation_from_rotation(r));
    if (k % 10 < 2) {
      const double best = best_value(s), norm = s.stableNorm();
      if (norm > 0) short_of_best = std::max(short_of_best, (best - r.cwiseProduct(s).sum()) / norm);
    }
  }
  EXPECT_LT(improper, 1e-14);
  EXPECT_LT(short_of_best, 1e-13);
}

TEST(Rotation, BeatsEveryRotationOfAFineSearch) {
  Random random;
  for (int k = 0; k < 27; ++k) {
    const Mat3 s = random.any(k);
    const double value = best_rotation(s, {}).toRotationMatrix().cwiseProduct(s).sum();
    double searched = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 20000; ++i)
      searched = std::max(searched, random.rotation().toRotationMatrix().cwiseProduct(s).sum());
    EXPECT_GE(value, searched - 1e-12 * std::fabs(searched));
  }
}

TEST(Rotation, WarmStartGivesTheSameRotationAsTheColdOne) {
  Random random;
  for (int k = 0; k < 20000; ++k) {
    const Quaternion truth = random.rotation();
    const Mat3 m = random.matrix();
    const Mat3 s = truth.toRotationMatrix() * (m * m.transpose() + 0.1 * Mat3::Identity());
    const Quaternion near = exponential(0.6 * random.vector()) * truth;
    EXPECT_LT(best_rotation_from(s, near).angularDistance(truth), 1e-12);
    EXPECT_LT(best_rotation(s, near).angularDistance(truth), 1e-12);
  }
}

void set(RotationBatch& batch, int lane, const Mat3& s, const Quaternion& near) {
  double columns[3][4] = {};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) columns[j][i] = s(i, j);
  }
  batch.set_columns(lane, columns);
  batch.set_rotation(lane, near);
}

TEST(Rotation, EightAtATimeAreTheBestOnesAndDoNotSeeEachOther) {
  Random random;
  constexpr int lanes = RotationBatch::lanes;
  for (int round = 0; round < 20000; ++round) {
    Mat3 s[lanes];
    Quaternion near[lanes];
    RotationBatch batch;
    const int count = 1 + round % lanes;
    for (int l = 0; l < count; ++l) {
      // a warm start, a cold one, and whatever is degenerate side by side
      near[l] = random.rotation();
      s[l] =
          (round + l) % 3 ? (exponential(0.05 * random.vector()) * near[l]).toRotationMatrix() : random.any(round + l);
      set(batch, l, s[l], near[l]);
    }
    best_rotations_from(batch, count);
    for (int l = 0; l < count; ++l) {
      const Quaternion q = batch.rotation(l), cold = best_rotation(s[l], near[l]);
      ASSERT_NEAR(q.squaredNorm(), 1, 1e-12);
      const double size = s[l].norm();
      ASSERT_NEAR(q.toRotationMatrix().cwiseProduct(s[l]).sum(), cold.toRotationMatrix().cwiseProduct(s[l]).sum(),
                  1e-11 * size);
      // alone in another lane the bits are the same
      RotationBatch alone;
      set(alone, 0, s[l], near[l]);
      best_rotations_from(alone, 1);
      const Quaternion r = alone.rotation(0);
      ASSERT_EQ(q.coeffs(), r.coeffs()) << round << " " << l;
    }
  }
}

TEST(Rotation, EightAtATimeArriveWithinRoundingInFourSteps) {
  Random random;
  constexpr int lanes = RotationBatch::lanes;
  for (int round = 0; round < 2000; ++round) {
    Quaternion truth[lanes];
    RotationBatch batch;
    for (int l = 0; l < lanes; ++l) {
      const Mat3 m = random.matrix();
      truth[l] = random.rotation();
      set(batch, l, truth[l].toRotationMatrix() * (m * m.transpose() + Mat3::Identity()),
          exponential(0.1 * random.vector()) * truth[l]);
    }
    RotationBatch stepped = batch;
    best_rotations_from(batch, lanes);
    RotationStep step;
    for (int iteration = 0; iteration < 5; ++iteration) {
      step_rotations(stepped.s[0], stepped.q[0], step, false);
      step_rotations(stepped.s[0], stepped.q[0], step, true);
    }
    for (int l = 0; l < lanes; ++l) {
      EXPECT_LT(batch.rotation(l).angularDistance(truth[l]), 1e-12);
      EXPECT_LT(step.square[l], 1e-20);  // the fifth step has nothing left to do: each squares the error
    }
  }
}

TEST(Rotation, StepsHaveTheSameBitsOnAllLanes) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no wider lanes";
  Random random;
  for (int round = 0; round < 1000; ++round) {
    alignas(64) double s[9][8], q[3][4][8];
    for (int l = 0; l < 8; ++l) {
      const Quaternion near = random.rotation();
      const Mat3 matrix = random.any(round + l) + near.toRotationMatrix();
      for (int k = 0; k < 9; ++k) s[k][l] = matrix(k / 3, k % 3);
      for (auto& one : q) {
        for (int k = 0; k < 4; ++k) one[k][l] = near.coeffs()(k);
      }
    }
    const auto run = [&](StepLoop loop, int which) {
      RotationStep step;
      for (int iteration = 0; iteration < 3; ++iteration) {
        loop(s[0], q[which][0], step, false);
        loop(s[0], q[which][0], step, true);
      }
    };
    run(&step_rotations, 0);
    run(&step_rotations_avx2, 1);
    EXPECT_EQ(std::memcmp(q[0], q[1], sizeof q[0]), 0) << round;
    if (!__builtin_cpu_supports("avx512f")) continue;
    run(rotation_loop(), 2);
    EXPECT_EQ(std::memcmp(q[0], q[2], sizeof q[0]), 0) << round;
  }
#endif
}

TEST(Rotation, TiesGoToTheRotationNearestToTheGivenOne) {
  Random random;
  for (int k = 0; k < 500; ++k) {
    // collinear: the turn about the line is free
    const Vec3 axis = random.vector();
    const Quaternion turn = random.rotation(), near = random.rotation();
    const Quaternion best = best_rotation(outer(rotate(turn, axis), axis), near);
    EXPECT_LT(norm(rotate(best, axis) - rotate(turn, axis)), 1e-12 * norm(axis));
    for (int i = 0; i < 64; ++i) {
      const Quaternion other = best * exponential((0.1 * i / norm(axis)) * axis);
      EXPECT_LE(best.angularDistance(near), other.angularDistance(near) + 1e-9);
    }
    EXPECT_LT(best_rotation(Mat3::Zero(), near).angularDistance(near), 1e-15);
  }
}

TEST(Rotation, NonFiniteMatricesGiveTheRotationTheyWereToBeNearTo) {
  Random random;
  const Quaternion near = random.rotation();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mat3 s = Mat3::Identity();
    s(1, 2) = bad;
    EXPECT_EQ(best_rotation(s, near).x(), near.x());
    EXPECT_EQ(best_rotation_from(s, near).w(), near.w());
  }
}

TEST(Rotation, VectorsQuaternionsAndMatricesAgree) {
  Random random;
  for (int k = 0; k < 20000; ++k) {
    const double size = std::pow(10.0, -12 + 12.0 * (k % 1000) / 999);
    Vec3 v = random.vector();
    v = (std::min(size, 0.999999) * pi / norm(v)) * v;
    EXPECT_LT(norm(logarithm(exponential(v)) - v), 1e-13 * (1 + norm(v)));
    const Quaternion q = random.rotation();
    EXPECT_LT(Quaternion(q.toRotationMatrix()).angularDistance(q), 1e-14);
    const Vec3 p = random.vector();
    EXPECT_LT(norm(q.toRotationMatrix() * p - rotate(q, p)), 1e-14 * norm(p) * 10);
  }
  EXPECT_EQ(normalised({Vec3(), 0}).w(), 1.0);
  EXPECT_LT(norm(to_vec3(normalised({{3e-300, 4e-300, 0}, 0}).vec()) - Vec3{0.6, 0.8, 0}), 1e-15);
}

TEST(Rotation, TurnsAddUpBeyondHalfAndWholeTurns) {
  const Vec3 axis{0.6, 0, 0.8};
  for (const double step : {0.05, 0.3, 1.2}) {
    Vec3 turn;
    for (double angle = 0; angle < 6 * pi; angle += step) {
      turn = continued_logarithm(exponential(angle * axis), turn);
      EXPECT_NEAR(dot(turn, axis), angle, 1e-9);
      EXPECT_NEAR(norm(turn), angle, 1e-9);
    }
    // and back
    for (double angle = std::floor(norm(turn) / step) * step; angle > -2 * pi; angle -= step)
      turn = continued_logarithm(exponential(angle * axis), turn);
    EXPECT_LT(dot(turn, axis), -2 * pi + 2 * step);
  }
}

TEST(Rotation, TurnsAreKeptWhenTheAxisTrembles) {
  Random random;
  Vec3 turn;
  for (double angle = 0; angle < 5 * pi; angle += 0.1) {
    const Quaternion tremble = exponential(0.01 * random.vector());
    const Quaternion q = tremble * exponential({0, angle, 0});
    turn = continued_logarithm(q, turn);
    // away from whole turns, where the axis is lost, the vector is the rotation's own
    if (std::fabs(std::remainder(angle, 2 * pi)) > 1) {
      EXPECT_LT(exponential(turn).angularDistance(q), 1e-9);
    }
  }
  EXPECT_NEAR(turn.y, 5 * pi - 0.1, 0.3);
}

TEST(Rotation, RigidFitFindsTheMotionBackFromAnyNumberOfPoints) {
  Random random;
  for (int count = 1; count < 12; ++count) {
    std::vector<Vec3> rest, posed;
    const RigidMotion motion{random.rotation(), random.vector()};
    for (int i = 0; i < count; ++i) {
      rest.push_back(random.vector());
      posed.push_back(apply(motion, rest.back()));
    }
    const RigidMotion fit = fit_rigid(rest, posed, {}, {});
    for (int i = 0; i < count; ++i) EXPECT_LT(norm(apply(fit, rest[i]) - posed[i]), 1e-13 * 10);
  }
  EXPECT_EQ(norm(fit_rigid({}, {}, {}, {}).translation), 0.0);
}

}  // namespace
