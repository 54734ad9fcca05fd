// Strain limits of rotation groups: what a sheet says, and the equations of a settled pose on the whole mesh.
#include "deform/strain.h"

#include <gtest/gtest.h>

#include <random>

#include "cases.h"
#include "deform/groups.h"
#include "support/dense.h"
#include "support/eigen.h"

namespace {

using namespace hf_inner;
using namespace hf_inner::deform;
using namespace deform_test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// The target R (1 + E X E') of a group from its definition: dense eigenproblems, one strain after the other.
Matrix3d target_of(const Matrix3d& moments, const Matrix3d& s, const Matrix3d& r, const StrainLimits& limits) {
  Vector3d moment;
  Matrix3d axes;
  hf_test::symmetric_eigen(moments.data(), 3, moment.data(), axes.data());
  Eigen::Matrix<double, 3, 2> e;
  e << axes.col(2), axes.col(1);
  const Eigen::Vector2d m(moment[2], moment[1]);
  if (m[1] <= 0.01 * m[0]) return r;
  Eigen::Matrix2d u = e.transpose() * r.transpose() * s * e * m.cwiseInverse().asDiagonal();
  u = (0.5 * (u + u.transpose())).eval();
  Eigen::Vector2d strain;
  Eigen::Matrix2d along;
  hf_test::symmetric_eigen(u.data(), 2, strain.data(), along.data());
  Eigen::Matrix2d x = Eigen::Matrix2d::Zero();
  for (int k = 0; k < 2; ++k) {
    const double sigma = strain[k], other = strain[1 - k];
    const auto kept = [&](double value) { return std::min(limits.high, std::max(limits.low, value)); };
    const double force = limits.stiffness * (kept(sigma) - sigma);
    x += (std::min(limits.largest, std::max(-limits.largest, force)) - limits.contraction * (kept(other) - 1)) *
         along.col(k) * along.col(k).transpose();
  }
  return r * (Matrix3d::Identity() + e * x * e.transpose());
}

TEST(Strain, AxesOfASymmetricMatrixAreItsEigenvectors) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    Mat3 a;
    for (int k = 0; k < 9; ++k) a(k / 3, k % 3) = normal(random);
    if (i % 4 == 1) a(2, 0) = a(2, 1) = a(2, 2) = 0;  // flat
    if (i % 4 == 2) {
      a(1, 0) = a(0, 0);
      a(1, 1) = a(0, 1) = 0.3;
    }  // nearly equal directions
    const Mat3 square = a * a.transpose();
    const PrincipalAxes axes = principal_axes(square);
    const Mat3 v = axes.axes, d = v.transpose() * square * v;
    const double size = square.trace();
    EXPECT_NEAR(v.determinant(), 1, 1e-12);
    EXPECT_LT(std::fabs(d(0, 1)) + std::fabs(d(0, 2)) + std::fabs(d(1, 2)), 1e-13 * size) << i;
    EXPECT_LT((d.diagonal() - axes.moment).norm(), 1e-13 * size) << i;
    for (int k = 0; k < 2; ++k) EXPECT_GE(axes.moment(k), axes.moment(k + 1));
  }
}

TEST(Strain, TheStressOfASheetIsTheOneOfItsDefinitionAndTurnsWithIt) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 4000; ++i) {
    const std::int32_t kind = i % 2;
    // rest edges in a slanted sheet, stretched, sheared and turned
    Matrix3d frame = normalised({{normal(random), normal(random), normal(random)}, normal(random)}).toRotationMatrix();
    Matrix3d stretch = Matrix3d::Identity();
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) stretch(a, b) += 0.25 * normal(random);
    }
    Matrix3d moments = Matrix3d::Zero();
    for (int k = 0; k < 12; ++k) {
      const Vector3d p = frame * Vector3d(normal(random), 0.6 * normal(random), 0.1 * normal(random));
      moments += p * p.transpose();
    }
    const Matrix3d s = frame * stretch * frame.transpose() * moments;
    const Mat3 r = best_rotation(s, {}).toRotationMatrix();
    const Sheet sheet = make_sheet(moments, kind);
    double columns[3][4];
    const auto stress = [&](const Matrix3d& from, const Mat3& rotation) {
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) columns[b][a] = from(a, b);
      }
      return stress_of(sheet, columns, rotation);
    };
    const Stress x = stress(s, r);
    const Matrix3d target = strained(sheet, x, r);
    EXPECT_LT((target - target_of(moments, s, r, strain_limits[kind])).norm(), 1e-9) << i;
    // a common rotation of the surface and the group: the same stress
    const Mat3 turn = normalised({{normal(random), normal(random), normal(random)}, normal(random)}).toRotationMatrix();
    const Stress y = stress(turn * s, turn * r);
    EXPECT_LT(std::fabs(x.along - y.along) + std::fabs(x.across - y.across) + std::fabs(x.beside - y.beside), 1e-11);
    // at rest: none
    const Stress none = stress(turn * moments, turn);
    EXPECT_LT(std::fabs(none.along) + std::fabs(none.across) + std::fabs(none.beside), 1e-12);
  }
}

TEST(Strain, LinesPointsAndBadNumbersAreUnderNoStress) {
  double columns[3][4] = {{5, 1, 0, 0}, {0, 7, 0, 0}, {0, 0, 3, 0}};
  Mat3 line;
  line(1, 1) = 2;
  line(0, 0) = 1e-3;
  for (const Mat3& moments : {line, Mat3(Mat3::Zero())}) {
    const Stress x = stress_of(make_sheet(moments, 1), columns, Mat3::Identity());
    EXPECT_EQ(std::fabs(x.along) + std::fabs(x.across) + std::fabs(x.beside), 0);
  }
  for (const double bad : {std::nan(""), 1e300, -1e300}) {
    columns[0][0] = bad;
    const Stress x = stress_of(make_sheet(Mat3::Identity(), 1), columns, Mat3::Identity());
    EXPECT_TRUE(std::isfinite(x.along) && std::isfinite(x.across) && std::isfinite(x.beside)) << bad;
  }
}

// A settled pose satisfies its equations on the whole mesh: for every free cluster c
//     sum_e w_e z_c(e) (x_i - x_j - (T_g + T_h) / 2 (p_i - p_j))' + eps_c (A_c - Rbar_c)' = 0,
// the targets T made here from the posed surface, edge by edge.
void expect_equilibrium(const Case& c, double border_stiffness) {
  Dragged d = drag(c, {}, 10, 5);
  for (int i = 0; i < 20; ++i) d.report = d.pose->deform({});
  const surface::Core& core = *d.core;
  const mesh::Topology& topology = core.topology();
  ASSERT_LT(topology.edge_count(), 50000) << "all edges must be in the sum";
  const ClusterWeights& weights = *d.pose->weights();
  const Rest& rest = d.pose->rest();
  const auto groups = Groups::with(nullptr, core, rest, {weights.elastic_components.data(), 1}, 250, *core.memory);
  const std::int32_t kind = weights.shared[0];
  std::vector<Vec3> x;
  for (const Vec3& p : d.report.positions) x.push_back(core.mesh.to_inner(p));
  const std::vector<Vec3> p(core.mesh.positions.begin(), core.mesh.positions.end());
  std::vector<double> hold(p.size(), 0.0), w(static_cast<std::size_t>(topology.edge_count()));
  for (std::size_t v = 0; v < p.size(); ++v) {
    for (std::int32_t k = weights.start[v]; k < weights.start[v + 1]; ++k) {
      if (weights.cluster[k] < weights.handle_count) hold[v] = std::max<double>(hold[v], weights.weight[k]);
    }
  }
  const std::size_t count = static_cast<std::size_t>(groups->count());
  std::vector<Matrix3d> moments(count, Matrix3d::Zero()), s(count, Matrix3d::Zero()), target(count);
  for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
    const std::int32_t i = topology.first(e), j = topology.second(e);
    w[e] = rest.stiffness[e] * (1 + border_stiffness * std::pow(std::max(hold[i], hold[j]), 4));
    for (const std::int32_t v : {i, j}) {
      const std::int32_t g = groups->group_of[v];
      moments[g] += 0.5 * w[e] * to_eigen(p[i] - p[j]) * to_eigen(p[i] - p[j]).transpose();
      s[g] += 0.5 * w[e] * to_eigen(x[i] - x[j]) * to_eigen(p[i] - p[j]).transpose();
    }
  }
  int strained_groups = 0;
  for (std::size_t g = 0; g < count; ++g) {
    const Matrix3d r = best_rotation(s[g], {}).toRotationMatrix();
    target[g] = target_of(moments[g], s[g], r, strain_limits[kind]);
    strained_groups += (target[g] - r).norm() > 1e-3;
  }
  const std::size_t clusters = static_cast<std::size_t>(weights.cluster_count);
  std::vector<Eigen::Matrix<double, 4, 3>> force(clusters, Eigen::Matrix<double, 4, 3>::Zero());
  std::vector<double> size(clusters, 0.0), trace(clusters, 0.0);
  std::vector<Matrix3d> mean(clusters, Matrix3d::Zero());
  for (std::int32_t e = 0; e < topology.edge_count(); ++e) {
    const std::int32_t i = topology.first(e), j = topology.second(e);
    const Matrix3d both = 0.5 * (target[groups->group_of[i]] + target[groups->group_of[j]]);
    const Vector3d missing = to_eigen(x[i] - x[j]) - both * to_eigen(p[i] - p[j]);
    std::map<std::int32_t, Eigen::Vector4d> z;
    for (const auto& [v, sign] : {std::make_pair(i, 1.0), std::make_pair(j, -1.0)}) {
      for (std::int32_t k = weights.start[v]; k < weights.start[v + 1]; ++k) {
        auto& to = z.emplace(weights.cluster[k], Eigen::Vector4d::Zero()).first->second;
        to += sign * weights.weight[k] * Eigen::Vector4d(p[v].x, p[v].y, p[v].z, 1);
      }
    }
    for (const auto& [cluster, row] : z) {
      force[cluster] += w[e] * row * missing.transpose();
      size[cluster] += w[e] * row.norm() * to_eigen(x[i] - x[j]).norm();
      trace[cluster] += w[e] * row.head<3>().squaredNorm();
    }
  }
  for (std::size_t v = 0; v < p.size(); ++v) {
    for (std::int32_t k = weights.start[v]; k < weights.start[v + 1]; ++k)
      mean[weights.cluster[k]] += rest.area[v] * weights.weight[k] * target[groups->group_of[v]];
  }
  double worst = 0;
  for (std::size_t f = static_cast<std::size_t>(weights.handle_count); f < clusters; ++f) {
    Matrix3d a;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) a(i, j) = d.pose->cluster_transforms()[f].a[i][j];
    }
    const Matrix3d near = best_rotation(mean[f], {}).toRotationMatrix();
    force[f].topRows<3>() += 1e-3 * trace[f] / 3 * (a - near).transpose();
    worst = std::max(worst, force[f].norm() / size[f]);
  }
  std::printf("%s: %d of %zu groups strained, largest force left %.1e\n", c.name.c_str(), strained_groups, count,
              worst);
  EXPECT_GT(strained_groups, 5);
  EXPECT_LT(worst, 1e-5);
}

TEST(Strain, ASettledPoseIsInEquilibriumEdgeByEdge) {
  expect_equilibrium(plane_lift(61), 0.25);
  Case pulled = cactus_bend(40, 3000);
  pulled.name = "cactus, an arm pulled";
  pulled.regions.push_back([](Vec3 p) { return p.x > 0.55; });
  const auto bend = pulled.motion;
  pulled.motion = [bend](std::size_t handle, double t, Vec3 centroid) {
    return handle == 1 ? bend(handle, t, centroid) : HandleTransform{about({0, 0, 1}, 0.6 * t), {0.25 * t, 0.1 * t, 0}};
  };
  expect_equilibrium(pulled, 3.5);
}

}  // namespace
