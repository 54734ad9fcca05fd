#include "deform/pose_solver.h"

#include <algorithm>
#include <cmath>

#include "deform/lanes.h"

namespace hf {
namespace {

constexpr double over_relaxation = 1.5;
constexpr double pi = 3.14159265358979323846;

// The rotation of active group g as a matrix, and its columns padded.
void set_matrix(SmoothState& state, std::size_t g, const Quaternion& q) noexcept {
  const Mat3 r = to_matrix(q);
  state.matrix[g] = r;
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) state.columns[12 * g + 4 * j + i] = r.m[i][j];
  }
}

// The transforms of the handles as rows of X.
void set_handle_rows(const SmoothSystem& system, const Affine* transforms, SmoothState& state) noexcept {
  for (std::int32_t h = 0; h < system.handle_count; ++h) {
    double* x = state.rows.data() + 16 * static_cast<std::size_t>(h);
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) x[4 * i + k] = transforms[h].a[k][i];
    }
  }
}

// known = -L_fh X_h
HF_FOUR_LANES
void set_known(const SmoothSystem& system, SmoothState& state) noexcept {
  const std::size_t columns = 4 * static_cast<std::size_t>(system.handle_count);
  const double* x = state.rows.data();
  for (std::size_t row = 0; row < 4 * static_cast<std::size_t>(system.free_count); ++row) {
    const double* coupling = system.subspace.coupling.data() + row * columns;
    double sum[4] = {0, 0, 0, 0};
    for (std::size_t column = 0; column < columns; ++column) {
      for (int k = 0; k < 4; ++k) sum[k] += coupling[column] * x[4 * column + k];
    }
    for (int k = 0; k < 4; ++k) state.known[4 * row + k] = -sum[k];
  }
}

// rows <- known + sum_g Q_gc R_g' for the free clusters.
HF_FOUR_LANES
void add_groups(const SmoothSystem& system, const double* columns, const double* known, double* rows) noexcept {
  const Subspace& s = system.subspace;
  for (std::int32_t f = 0; f < system.free_count; ++f) {
    const std::size_t first = 16 * static_cast<std::size_t>(f);
    double x[4][4];
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t k = 0; k < 4; ++k) x[a][k] = known[first + 4 * a + k];
    }
    for (std::int32_t u = s.use_start[f]; u < s.use_start[f + 1]; ++u) {
      const auto& q = s.entry[s.use[u].entry].q;
      const double* r = columns + 12 * static_cast<std::size_t>(s.use[u].group);
      for (int a = 0; a < 4; ++a) {
        for (int k = 0; k < 4; ++k) x[a][k] += q[a][0] * r[k] + q[a][1] * r[4 + k] + q[a][2] * r[8 + k];
      }
    }
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t k = 0; k < 4; ++k) rows[first + 4 * a + k] = x[a][k];
    }
  }
}

// sum[j][i] = S_g(i, j) = sum_c sum_a X_c(a, i) Q_gc(a, j)
HF_FOUR_LANES
void match_group(const Subspace& s, std::size_t g, const double* rows, double (&sum)[3][4]) noexcept {
  double total[3][4] = {};
  for (std::int32_t e = s.entry_start[g]; e < s.entry_start[g + 1]; ++e) {
    const Subspace::Entry& entry = s.entry[e];
    const double* x = rows + 16 * static_cast<std::size_t>(entry.cluster);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 4; ++i)
        total[j][i] += x[i] * entry.q[0][j] + x[4 + i] * entry.q[1][j] + x[8 + i] * entry.q[2][j] +
                       x[12 + i] * entry.q[3][j];
    }
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) sum[j][i] = total[j][i];
  }
}

// rows of the free clusters <- known + sum_g Q_gc R_g' + eps_c Rbar_c'
void set_right_hand_side(const SmoothSystem& system, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  double* free_rows = state.rows.data() + 16 * static_cast<std::size_t>(system.handle_count);
  add_groups(system, state.columns.data(), state.known.data(), free_rows);
  for (std::int32_t f = 0; f < system.free_count; ++f) {
    Mat3 sum;
    double heaviest = -1;
    std::int32_t nearest = -1;
    for (std::int32_t k = s.mean_start[f]; k < s.mean_start[f + 1]; ++k) {
      const Subspace::Share& share = s.mean[k];
      const auto& r = state.matrix[share.group].m;
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) sum.m[a][b] += share.area * r[a][b];
      }
      if (share.area > heaviest) heaviest = share.area, nearest = share.group;
    }
    if (nearest < 0) continue;
    const Mat3 mean = to_matrix(best_rotation_from(sum, state.rotation[s.group[nearest]]));
    double* x = free_rows + 16 * static_cast<std::size_t>(f);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) x[4 * a + b] += s.stiffness[f] * mean.m[b][a];
    }
  }
}

void read_transforms(const SmoothSystem& system, const SmoothState& state, Affine* transforms) noexcept {
  for (std::int32_t c = system.handle_count; c < system.handle_count + system.free_count; ++c) {
    const double* x = state.rows.data() + 16 * static_cast<std::size_t>(c);
    auto& a = transforms[c].a;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) a[k][i] = x[4 * i + k];
    }
  }
}

// The rotation of one group that fits the transforms best.
Quaternion fit_group(const Subspace& s, std::size_t g, const double* rows, const Quaternion& near) noexcept {
  double sum[3][4];
  match_group(s, g, rows, sum);
  Mat3 matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) matrix.m[i][j] = sum[j][i];
  }
  return best_rotation_from(matrix, near);
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
double fit_rotations(const SmoothSystem& system, bool relax, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  double largest = 0;
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    Quaternion& q = state.rotation[s.group[g]];
    Quaternion fit = fit_group(s, g, state.rows.data(), q);
    double cosine = dot(fit, q);
    if (cosine < 0) fit = {-fit.x, -fit.y, -fit.z, -fit.w}, cosine = -cosine;
    // |R - R'|_F = 2 sqrt(2) sin(angle / 2)
    const Quaternion d{fit.x - q.x, fit.y - q.y, fit.z - q.z, fit.w - q.w};
    largest = std::max(largest, 2.0 * std::sqrt(2.0 * dot(d, d) * (1.0 - 0.25 * dot(d, d))));
    const double on = relax && cosine > 0.7 ? over_relaxation : 1.0, back = 1.0 - on;
    q = normalised(
        {on * fit.x + back * q.x, on * fit.y + back * q.y, on * fit.z + back * q.z, on * fit.w + back * q.w});
    if (state.leash < pi) q = on_leash(q, state.anchor[g], state.leash);
    set_matrix(state, g, q);
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
  columns.assign(12 * system.subspace.group.size(), 0.0);
  rows.assign(16 * static_cast<std::size_t>(system.handle_count + system.free_count), 0.0);
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
  for (std::size_t g = 0; g < s.group.size(); ++g) set_matrix(state, g, state.rotation[s.group[g]]);
  set_handle_rows(system, transforms, state);
  set_known(system, state);
  while (report.iterations < iterations) {
    const bool last = ++report.iterations == iterations;
    set_right_hand_side(system, state);
    s.factor.solve(state.rows.data() + 16 * static_cast<std::size_t>(system.handle_count));
    report.last_change = fit_rotations(system, !last, state);
    if (report.last_change < tolerance) break;
  }
  read_transforms(system, state, transforms);
  return report;
}

}  // namespace hf
