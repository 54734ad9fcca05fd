#include "deform/pose_solver.h"

#include <algorithm>
#include <cmath>

#include "base/compiler.h"
#include "deform/rotation_batch.h"

namespace hf_inner::deform {
namespace {

constexpr double pi = 3.14159265358979323846;

// Sets the rotation that the next solve for the cluster transforms should give the edges of vertex group g: the group's
// rotation, changed by its stress.
void set_target(const SmoothSystem& system, std::size_t g, SmoothState& state) noexcept {
  const Mat3 target =
      strained(system.sheet[g], state.stress[g], state.rotation[system.subspace.group[g]].toRotationMatrix());
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) state.columns[12 * g + 4 * j + i] = target(i, j);
  }
}

// Writes the transforms of the handles into X, the matrix of all transforms.
void set_handle_rows(const SmoothSystem& system, const Affine* transforms, SmoothState& state) noexcept {
  for (std::int32_t h = 0; h < system.handle_count; ++h) {
    double* x = state.rows.data() + 16 * static_cast<std::size_t>(h);
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) x[4 * i + k] = transforms[h].a[k][i];
    }
  }
}

// Computes the right-hand side of the known handle transforms X_h: known = -L_fh X_h. L_fh couples free clusters with
// handles. The four rows of a cluster are summed together: four sums hide the latency of additions.
HF_FOUR_LANES
void set_known(const SmoothSystem& system, SmoothState& state) noexcept {
  const std::size_t columns = 4 * static_cast<std::size_t>(system.handle_count);
  const double* x = state.rows.data();
  for (std::size_t f = 0; f < static_cast<std::size_t>(system.free_count); ++f) {
    const double* coupling = system.subspace.coupling.data() + 4 * f * columns;
    double sum[4][4] = {};
    for (std::size_t column = 0; column < columns; ++column) {
      for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t k = 0; k < 4; ++k) sum[row][k] += coupling[row * columns + column] * x[4 * column + k];
      }
    }
    for (std::size_t row = 0; row < 4; ++row) {
      for (std::size_t k = 0; k < 4; ++k) state.known[16 * f + 4 * row + k] = -sum[row][k];
    }
  }
}

// Adds the rotations R_g of the vertex groups to the right-hand side of the free clusters c. rows = known + sum_g Q_gc
// R_g', where the matrix Q_gc couples group and cluster (subspace.h).
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

// Computes the moment matrix S_g of vertex group g (subspace.h): sum[j][i] = S_g(i, j) = sum_c sum_a X_c(a, i) Q_gc(a,
// j). X_c is the transform of cluster c, and Q_gc couples g and c.
HF_FOUR_LANES
void match_group(const Subspace& s, std::size_t g, const double* rows, double (&sum)[3][4]) noexcept {
  double total[3][4] = {};
  for (std::int32_t e = s.entry_start[g]; e < s.entry_start[g + 1]; ++e) {
    const Subspace::Entry& entry = s.entry[e];
    const double* x = rows + 16 * static_cast<std::size_t>(entry.cluster);
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 4; ++i)
        total[j][i] +=
            x[i] * entry.q[0][j] + x[4 + i] * entry.q[1][j] + x[8 + i] * entry.q[2][j] + x[12 + i] * entry.q[3][j];
    }
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) sum[j][i] = total[j][i];
  }
}

// Sums the rotations R_g of the vertex groups under one cluster, weighted by area: sum[j][i] = sum of area times R_g(i,
// j).
HF_FOUR_LANES
void mean_of_groups(const Subspace& s, std::int32_t first, std::int32_t last, const double* columns,
                    double (&sum)[3][4]) noexcept {
  double total[12] = {};
  for (std::int32_t k = first; k < last; ++k) {
    const double area = s.mean[k].area;
    const double* r = columns + 12 * static_cast<std::size_t>(s.mean[k].group);
    for (int i = 0; i < 12; ++i) total[i] += area * r[i];
  }
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 4; ++i) sum[j][i] = total[4 * j + i];
  }
}

// Adds eps_c Rbar_c' to the right-hand side of several clusters. Rbar_c is the mean rotation of the vertex groups under
// cluster c, found in one lane of the batch. eps_c is a small stiffness.
void add_means(const SmoothSystem& system, RotationBatch& batch, const std::int32_t* cluster, int count,
               double* rows) noexcept {
  best_rotations_from(batch, count);
  for (int l = 0; l < count; ++l) {
    const Mat3 mean = batch.rotation(l).toRotationMatrix();
    const double stiffness = system.subspace.stiffness[cluster[l]];
    double* x = rows + 16 * static_cast<std::size_t>(cluster[l]);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) x[4 * a + b] += stiffness * mean(b, a);
    }
  }
}

// Sets the right-hand side for the clusters that are no handles. For cluster c it is known + sum_g Q_gc R_g' + eps_c
// Rbar_c'. The part `known` comes from the handles. R_g is the rotation of vertex group g, and Q_gc couples it to the
// cluster. Rbar_c is the mean rotation under the cluster, eps_c a small stiffness (subspace.h).
void set_right_hand_side(const SmoothSystem& system, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  double* free_rows = state.rows.data() + 16 * static_cast<std::size_t>(system.handle_count);
  add_groups(system, state.columns.data(), state.known.data(), free_rows);
  RotationBatch batch;
  std::int32_t cluster[RotationBatch::lanes];
  int count = 0;
  for (std::int32_t f = 0; f < system.free_count; ++f) {
    const std::int32_t first = s.mean_start[f], last = s.mean_start[f + 1];
    if (first == last) continue;
    double heaviest = -1, sum[3][4];
    std::int32_t nearest = 0;
    mean_of_groups(s, first, last, state.columns.data(), sum);
    for (std::int32_t k = first; k < last; ++k) {
      if (s.mean[k].area > heaviest) {
        heaviest = s.mean[k].area;
        nearest = s.mean[k].group;
      }
    }
    batch.set_columns(count, sum);
    batch.set_rotation(count, state.rotation[s.group[nearest]]);
    cluster[count++] = f;
    if (count == RotationBatch::lanes) {
      add_means(system, batch, cluster, count, free_rows);
      count = 0;
    }
  }
  if (count > 0) add_means(system, batch, cluster, count, free_rows);
}

// Returns the moment matrix S_g (subspace.h) of vertex group g at rest, where every cluster's transform is the
// identity.
Mat3 rest_moments(const Subspace& s, std::size_t g) noexcept {
  Mat3 sum;
  for (std::int32_t e = s.entry_start[g]; e < s.entry_start[g + 1]; ++e) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sum(i, j) += s.entry[e].q[i][j];
    }
  }
  return 0.5 * (sum + sum.transpose());
}

void read_transforms(const SmoothSystem& system, const SmoothState& state, Affine* transforms) noexcept {
  const auto read = [&](std::int32_t c) {
    const double* x = state.rows.data() + 16 * static_cast<std::size_t>(c);
    auto& a = transforms[c].a;
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 3; ++k) a[k][i] = x[4 * i + k];
    }
  };
  for (std::int32_t c = system.handle_count; c < system.handle_count + system.free_count; ++c) read(c);
  for (std::size_t k = 0; state.turns && k < state.turns->count(); ++k) read(state.turns->handle[k]);
}

// Returns the handles' turns at vertex group g, blended by the handles' fields phi_i at the group's first vertex
// (seed): sum_i phi_i(seed) turn_i.
Vec3 blended_turn(const SmoothSystem& system, std::size_t g, Span<const Vec3> turns) noexcept {
  Vec3 turn;
  for (std::size_t i = 0; i < turns.size(); ++i) turn = turn + system.seed_field[g * turns.size() + i] * turns[i];
  return turn;
}

Quaternion within_turn_limit(const Quaternion& q, const Quaternion& anchor, double turn_limit) noexcept {
  const double angle = angle_between(q, anchor);
  if (angle <= turn_limit) return q;
  return normalised(exponential((turn_limit / angle) * logarithm(q * anchor.conjugate())) * anchor);
}

// The weight of a quaternion's change: |R - R'|_F = 2 sqrt(2) sin(angle / 2), so that rotation and stress compare.
constexpr double root_of_two = 1.41421356237309504880, quaternion_weight = 2.0 * root_of_two;

// Writes where group g is, and how far its fit is from there. Returns the change (Frobenius norm, squared).
double note_group(const SmoothSystem& system, std::size_t g, Quaternion fit, const Stress& wanted,
                  SmoothState& state) noexcept {
  const Quaternion& q = state.rotation[system.subspace.group[g]];
  if (fit.dot(q) < 0) fit.coeffs() *= -1;
  double *z = state.iterate.data() + 7 * g, *f = state.residual.data() + 7 * g;
  double square = 0;
  for (int i = 0; i < 4; ++i) {
    const double change = fit.coeffs()[i] - q.coeffs()[i];
    z[i] = quaternion_weight * q.coeffs()[i];
    f[i] = quaternion_weight * change;
    square += change * change;
  }
  const Stress& stress = state.stress[g];
  const double share = strain_limits[system.sheet[g].limits].follow;
  z[4] = stress.along;
  z[5] = root_of_two * stress.across;
  z[6] = stress.beside;
  f[4] = share * (wanted.along - stress.along);
  f[5] = root_of_two * share * (wanted.across - stress.across);
  f[6] = share * (wanted.beside - stress.beside);
  return std::max(8.0 * square * (1.0 - 0.25 * square), f[4] * f[4] + f[5] * f[5] + f[6] * f[6]);
}

// Takes the rotation and the stress of group g from the iterate.
void take_group(const SmoothSystem& system, std::size_t g, SmoothState& state) noexcept {
  const double* z = state.iterate.data() + 7 * g;
  Quaternion& q = state.rotation[system.subspace.group[g]];
  Quaternion next = normalised(Quaternion(hf_eigen::Vector4d(z[0], z[1], z[2], z[3])));
  if (state.turn_limit < pi) next = within_turn_limit(next, state.anchor[g], state.turn_limit);
  if (next.dot(q) < 0) next.coeffs() *= -1;
  q = next;
  state.stress[g] = {z[4], z[5] / root_of_two, z[6]};
}

// Fits the rotations and stresses of all vertex groups (the local step), and takes the next iterate. Returns the
// largest distance to a fit.
double fit_rotations(const SmoothSystem& system, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  constexpr std::size_t lanes = RotationBatch::lanes;
  RotationBatch batch;
  double largest = 0;
  for (std::size_t first = 0; first < s.group.size(); first += lanes) {
    const int count = static_cast<int>(std::min(lanes, s.group.size() - first));
    double sum[lanes][3][4];
    for (int l = 0; l < count; ++l) {
      const std::size_t g = first + static_cast<std::size_t>(l);
      match_group(s, g, state.rows.data(), sum[l]);
      batch.set_columns(l, sum[l]);
      batch.set_rotation(l, state.rotation[s.group[g]]);
    }
    best_rotations_from(batch, count);
    for (int l = 0; l < count; ++l) {
      const std::size_t g = first + static_cast<std::size_t>(l);
      const Stress wanted = stress_of(system.sheet[g], sum[l], batch.rotation(l).toRotationMatrix());
      largest = std::max(largest, note_group(system, g, batch.rotation(l), wanted, state));
    }
  }
  state.anderson.step(state.iterate, state.residual, 7, longest_leap);
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    take_group(system, g, state);
    set_target(system, g, state);
  }
  return std::sqrt(largest);
}

}  // namespace

SmoothSystem::SmoothSystem(const surface::Core& core, const Rest& rest, const ClusterWeights& weights,
                           const Groups& groups, const HandleFields& fields, Memory& memory)
    : subspace(make_subspace(core, rest, weights, groups, memory)),
      handle_count(weights.handle_count),
      free_count(weights.free_count()),
      seed_field(&memory),
      sheet(&memory) {
  seed_field.reserve(subspace.group.size() * static_cast<std::size_t>(handle_count));
  for (const std::int32_t g : subspace.group) {
    for (std::int32_t i = 0; i < handle_count; ++i) seed_field.push_back(fields.of(i)[groups.seed[g]]);
  }
  sheet.reserve(subspace.group.size());
  for (std::size_t g = 0; g < subspace.group.size(); ++g)
    sheet.push_back(make_sheet(rest_moments(subspace, g), subspace.shared[g]));
}

void SmoothState::fit(const SmoothSystem& system, const Groups& groups) {
  rotation.resize(groups.count());
  anchor.assign(system.subspace.group.size(), Quaternion());
  turn_limit = no_turn_limit;
  stress.assign(system.subspace.group.size(), Stress());
  iterate.assign(7 * system.subspace.group.size(), 0.0);
  residual.assign(7 * system.subspace.group.size(), 0.0);
  anderson.fit(7 * system.subspace.group.size());
  columns.assign(12 * system.subspace.group.size(), 0.0);
  rows.assign(16 * static_cast<std::size_t>(system.handle_count + system.free_count), 0.0);
  known.assign(16 * static_cast<std::size_t>(system.free_count), 0.0);
}

void start_rotations(const SmoothSystem& system, const Groups& groups, std::int32_t component, Span<const Vec3> turns,
                     SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  state.anderson.forget();
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    if (component >= 0 && groups.component[s.group[g]] != component) continue;
    const Vec3 turn = blended_turn(system, g, turns);
    state.rotation[s.group[g]] = exponential(turn);
    state.stress[g] = Stress();
  }
}

void predict_rotations(const SmoothSystem& system, Span<const Vec3> increments, SmoothState& state) noexcept {
  const Subspace& s = system.subspace;
  for (std::size_t g = 0; g < s.group.size(); ++g) {
    const Vec3 turn = blended_turn(system, g, increments);
    state.rotation[s.group[g]] = normalised(exponential(turn) * state.rotation[s.group[g]]);
  }
}

void set_turn_limit(const SmoothSystem& system, Span<const Vec3> turns, SmoothState& state) noexcept {
  double apart = 0;
  const auto is_free = [&](std::size_t i) {
    return state.turns &&
           std::binary_search(state.turns->handle.begin(), state.turns->handle.end(), static_cast<std::int32_t>(i));
  };
  for (std::size_t i = 0; i < turns.size(); ++i) {
    if (is_free(i)) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_free(j)) apart = std::max(apart, norm(turns[i] - turns[j]));
    }
  }
  const double share = (apart - turn_limit_from) / (turn_limit_full - turn_limit_from);
  state.turn_limit =
      share <= 0 ? SmoothState::no_turn_limit : std::max(least_turn_limit, pi + (least_turn_limit - pi) * share);
  if (state.turn_limit >= pi) return;
  for (std::size_t g = 0; g < system.subspace.group.size(); ++g)
    state.anchor[g] = exponential(blended_turn(system, g, turns));
}

SolveReport solve_pose(const SmoothSystem& system, std::uint32_t iterations, double tolerance, SmoothState& state,
                       Affine* transforms) noexcept {
  SolveReport report;
  if (system.free_count == 0) return report;
  const Subspace& s = system.subspace;
  for (std::size_t g = 0; g < s.group.size(); ++g) set_target(system, g, state);
  state.anderson.break_off();
  set_handle_rows(system, transforms, state);
  const FreeTurns* const turns = state.turns.get();
  const Holds* const holds = state.holds.get();
  if (turns) begin_turns(*turns, s, state.rows.data(), state.free);
  if (holds) begin_holds(*holds, static_cast<std::size_t>(system.handle_count), state.rows.data(), state.held);
  set_known(system, state);
  double* const solved = state.rows.data() + 16 * static_cast<std::size_t>(system.handle_count);
  const std::size_t size = 4 * static_cast<std::size_t>(system.free_count);
  while (report.iterations < iterations) {
    ++report.iterations;
    set_right_hand_side(system, state);
    if (turns) {
      if (holds) gap_before(*holds, solved, size, state.held);
      find_turns(*turns, solved, size, state.columns.data(), state.held.pull.data(), state.rows.data(), state.free);
    }
    s.factor.solve(solved);
    if (turns) respond_to_turns(*turns, state.free, solved, size);
    if (holds) add_holds(*holds, state.rows.data(), solved, size, state.held);
    report.last_change = fit_rotations(system, state);
    if (report.last_change < tolerance) break;
  }
  read_transforms(system, state, transforms);
  return report;
}

}  // namespace hf_inner::deform
