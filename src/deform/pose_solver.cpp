#include "deform/pose_solver.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

constexpr double over_relaxation = 1.5;
constexpr double pi = 3.14159265358979323846;

// known = -L_fh X_h
void set_known(const SmoothSystem& system, const Affine* transforms, SmoothState& state) noexcept {
  const std::size_t columns = 4 * static_cast<std::size_t>(system.handle_count);
  for (std::size_t row = 0; row < 4 * static_cast<std::size_t>(system.free_count); ++row) {
    const double* coupling = system.subspace.coupling.data() + row * columns;
    double sum[3] = {0, 0, 0};
    for (std::size_t column = 0; column < columns; ++column) {
      const auto& a = transforms[column / 4].a;
      for (int k = 0; k < 3; ++k) sum[k] += coupling[column] * a[k][column % 4];
    }
    double* known = state.known.data() + 4 * row;
    for (int k = 0; k < 3; ++k) known[k] = -sum[k];
    known[3] = 0;
  }
}

// unknown <- known + sum_g Q_gc R_g' + eps_c Rbar_c'
void set_right_hand_side(const SmoothSystem& system, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  std::copy(state.known.begin(), state.known.end(), state.unknown.begin());
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    const auto& r = state.matrix[g].m;
    for (std::int32_t k = s.entry_start[g]; k < s.entry_start[g + 1]; ++k) {
      const Subspace::Entry& entry = s.entry[k];
      const std::int32_t f = entry.cluster - system.handle_count;
      if (f < 0) continue;
      double* x = state.unknown.data() + 16 * static_cast<std::size_t>(f);
      for (int a = 0; a < 4; ++a) {
        for (int b = 0; b < 3; ++b)
          x[4 * a + b] += entry.q[a][0] * r[b][0] + entry.q[a][1] * r[b][1] + entry.q[a][2] * r[b][2];
      }
    }
  }
  for (std::int32_t f = 0; f < system.free_count; ++f) {
    Mat3 sum;
    double heaviest = -1;
    std::int32_t nearest = -1;
    for (std::int32_t k = s.mean_start[f]; k < s.mean_start[f + 1]; ++k) {
      const Subspace::Share& share = s.mean[k];
      sum = sum + share.area * state.matrix[share.group];
      if (share.area > heaviest) heaviest = share.area, nearest = share.group;
    }
    if (nearest < 0) continue;
    const Mat3 mean = to_matrix(best_rotation_from(sum, state.rotation[s.group[nearest]]));
    double* x = state.unknown.data() + 16 * static_cast<std::size_t>(f);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) x[4 * a + b] += s.stiffness[f] * mean.m[b][a];
    }
  }
}

void read_transforms(const SmoothSystem& system, const SmoothState& state, Affine* transforms) noexcept {
  for (std::int32_t f = 0; f < system.free_count; ++f) {
    const double* x = state.unknown.data() + 16 * static_cast<std::size_t>(f);
    auto& a = transforms[system.handle_count + f].a;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) a[k][i] = x[4 * i + k];
    }
  }
}

// The rotation of one group that fits the transforms best.
Quaternion fit_group(const Subspace& s, std::size_t g, const Affine* transforms, const Quaternion& near) noexcept {
  Mat3 sum;
  for (std::int32_t k = s.entry_start[g]; k < s.entry_start[g + 1]; ++k) {
    const Subspace::Entry& entry = s.entry[k];
    const auto& a = transforms[entry.cluster].a;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        sum.m[i][j] +=
            a[i][0] * entry.q[0][j] + a[i][1] * entry.q[1][j] + a[i][2] * entry.q[2][j] + a[i][3] * entry.q[3][j];
    }
  }
  return best_rotation_from(sum, near);
}

// sum_i phi_i(seed) turn_i of active group g
Vec3 blended_turn(const SmoothSystem& system, std::size_t g, Span<const Vec3> turns) noexcept {
  Vec3 turn;
  for (std::size_t i = 0; i < turns.size(); ++i) turn = turn + system.seed_field[g * turns.size() + i] * turns[i];
  return turn;
}

Quaternion on_leash(const Quaternion& q, const Quaternion& anchor, double leash) noexcept {
  const double angle = angle_between(q, anchor);
  if (angle <= leash) return q;
  return normalised(exponential((leash / angle) * logarithm(q * conjugate(anchor))) * anchor);
}

// Local step of all groups; returns the largest change.
double fit_rotations(const SmoothSystem& system, const Affine* transforms, bool relax, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  double largest = 0;
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    Quaternion& q = state.rotation[s.group[g]];
    Quaternion fit = fit_group(s, g, transforms, q);
    double cosine = dot(fit, q);
    if (cosine < 0) fit = {-fit.x, -fit.y, -fit.z, -fit.w}, cosine = -cosine;
    // |R - R'|_F = 2 sqrt(2) sin(angle / 2)
    const Quaternion d{fit.x - q.x, fit.y - q.y, fit.z - q.z, fit.w - q.w};
    largest = std::max(largest, 2.0 * std::sqrt(2.0 * dot(d, d) * (1.0 - 0.25 * dot(d, d))));
    const double on = relax && cosine > 0.7 ? over_relaxation : 1.0, back = 1.0 - on;
    q = normalised(
        {on * fit.x + back * q.x, on * fit.y + back * q.y, on * fit.z + back * q.z, on * fit.w + back * q.w});
    if (state.leash < pi) q = on_leash(q, state.anchor[g], state.leash);
    state.matrix[g] = to_matrix(q);
  }
  return largest;
}

}  // namespace

SmoothSystem::SmoothSystem(const Core& core, const Rest& rest, const ClusterWeights& weights, const Groups& groups,
                           const HandleFields& fields, Memory& memory)
    : subspace(make_subspace(core, rest, weights, groups, memory)),
      handle_count(weights.handle_count),
      free_count(weights.free_count()),
      seed_field(&memory) {
  seed_field.reserve(subspace.group.size() * static_cast<std::size_t>(handle_count));
  for (const std::int32_t g : subspace.group) {
    for (std::int32_t i = 0; i < handle_count; ++i) seed_field.push_back(fields.of(i)[groups.seed[g]]);
  }
}

void SmoothState::fit(const SmoothSystem& system, const Groups& groups) {
  rotation.resize(groups.count());
  anchor.assign(system.subspace.group.size(), Quaternion());
  leash = 10;
  matrix.assign(system.subspace.group.size(), Mat3::identity());
  unknown.assign(16 * static_cast<std::size_t>(system.free_count), 0.0);
  known.assign(16 * static_cast<std::size_t>(system.free_count), 0.0);
}

void start_rotations(const SmoothSystem& system, const Groups& groups, std::int32_t component, Span<const Vec3> turns,
                     SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    if (component >= 0 && groups.component[s.group[g]] != component) continue;
    const Vec3 turn = blended_turn(system, g, turns);
    state.rotation[s.group[g]] = exponential(turn);
  }
}

void predict_rotations(const SmoothSystem& system, Span<const Vec3> increments, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    const Vec3 turn = blended_turn(system, g, increments);
    state.rotation[s.group[g]] = normalised(exponential(turn) * state.rotation[s.group[g]]);
  }
}

void set_leash(const SmoothSystem& system, Span<const Vec3> turns, SmoothState& state) noexcept {
  double apart = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) apart = std::max(apart, norm(turns[i] - turns[j]));
  }
  constexpr double slack = 5.0, tight = 7.0, shortest = 0.3;
  state.leash = apart <= slack ? 10.0 : std::max(shortest, pi + (shortest - pi) * (apart - slack) / (tight - slack));
  if (state.leash >= pi) return;
  for (std::size_t g = 0; g < system.subspace.group.size(); ++g)
    state.anchor[g] = exponential(blended_turn(system, g, turns));
}

SolveReport solve_pose(const SmoothSystem& system, std::uint32_t iterations, double tolerance, SmoothState& state,
                       Affine* transforms) noexcept {
  SolveReport report;
  if (system.free_count == 0) return report;
  const Subspace& s = system.subspace;
  for (std::size_t g = 0; g < s.group.size(); ++g) state.matrix[g] = to_matrix(state.rotation[s.group[g]]);
  set_known(system, transforms, state);
  while (report.iterations < iterations) {
    const bool last = ++report.iterations == iterations;
    set_right_hand_side(system, state);
    s.factor.solve(state.unknown.data());
    read_transforms(system, state, transforms);
    report.last_change = fit_rotations(system, transforms, !last, state);
    if (report.last_change < tolerance) break;
  }
  return report;
}

}  // namespace hf
