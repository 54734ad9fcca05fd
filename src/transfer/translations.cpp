// See translations.h.
#include "transfer/translations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/index.h"
#include "base/progress.h"

namespace hf_inner::transfer {
namespace {

template <class Matrix>
double trace(const Matrix& matrix, std::size_t count) noexcept {
  double sum = 0;
  for (std::size_t c = 0; c < count; ++c) sum += matrix[c * count + c];
  return sum;
}

void add_point(Vector<double>& table, std::size_t entry, double w, Vec3 p) noexcept {
  table[3 * entry] += w * p.x;
  table[3 * entry + 1] += w * p.y;
  table[3 * entry + 2] += w * p.z;
}

}  // namespace

void Translations::add_overlap(Span<const double> area, const surface::Core& target, const Clusters& clusters,
                               Buffer<double>& matrix, Vector<double>& table) const {
  const std::size_t count = at(count_);
  Poller poller;
  for (std::size_t v = 0; v < area.size(); ++v) {
    poller.due();
    const std::int32_t* joint = clusters.joint.data() + v * blend_count;
    const float* weight = clusters.weight.data() + v * blend_count;
    for (std::int32_t i = 0; i < blend_count; ++i) {
      for (std::int32_t j = 0; j < blend_count; ++j) {
        if (joint[i] == joint[j] || weight[i] <= 0 || weight[j] <= 0) continue;
        const double w = area[v] * static_cast<double>(weight[i]) * static_cast<double>(weight[j]);
        const std::size_t c = at(joint[i]), d = at(joint[j]);
        matrix[c * count + c] += w;
        matrix[c * count + d] -= w;
        add_point(table, c * count + d, w, target.mesh.positions[v]);
        add_point(table, c * count + c, -w, target.mesh.positions[v]);
      }
    }
  }
}

SpreadTies spread_ties(const surface::Core& core, const std::int32_t* joint, const float* weight, std::size_t count,
                       Memory& memory) {
  SpreadTies out(count, memory);
  double floor = 0;
  for (const double w : core.weights()) floor += std::abs(w);
  floor = least_weight_share * floor / static_cast<double>(std::max<std::size_t>(1, core.weights().size()));
  Poller poller;
  for (std::int32_t e = 0; e < core.topology().edge_count(); ++e) {
    poller.due();
    const std::int32_t ends[2] = {core.topology().first(e), core.topology().second(e)};
    // The difference between the cluster weights of the edge's two ends. It has at most eight clusters.
    std::size_t cluster[2 * blend_count];
    double delta[2 * blend_count];
    std::size_t used = 0;
    for (int side = 0; side < 2; ++side) {
      for (std::size_t i = at(ends[side]) * blend_count; i < (at(ends[side]) + 1) * blend_count; ++i) {
        if (weight[i] <= 0) continue;
        const std::size_t c = at(joint[i]);
        std::size_t k = 0;
        while (k < used && cluster[k] != c) ++k;
        if (k == used) {
          cluster[used] = c;
          delta[used++] = 0;
        }
        delta[k] += (side ? -1.0 : 1.0) * static_cast<double>(weight[i]);
      }
    }
    const double w = std::clamp(core.weights()[at(e)], floor, std::max(floor, steepest_weight));
    const Vec3 middle = 0.5 * (core.mesh.positions[at(ends[0])] + core.mesh.positions[at(ends[1])]);
    for (std::size_t i = 0; i < used; ++i) {
      for (std::size_t j = 0; j < used; ++j) {
        const double product = w * delta[i] * delta[j];
        const std::size_t entry = cluster[i] * count + cluster[j];
        out.matrix[entry] += product;
        out.size[entry] += std::abs(product);
        add_point(out.table, entry, -product, middle);
      }
    }
  }
  const double sum = trace(out.matrix, count);
  const double unit = sum > 0 ? 1 / sum : 0.0;
  for (double& x : out.matrix) x *= unit;
  for (double& x : out.size) x *= unit;
  for (double& x : out.table) x *= unit;
  return out;
}

void Translations::add_row(Span<const std::int32_t> vertices, Span<const double> weights, const surface::Core& target,
                           const Clusters& clusters) {
  Vector<double> weight(at(count_), 0.0, target.memory.get());
  Vector<Vec3> point(at(count_), target.memory.get());
  double sum = 0;
  for (const double w : weights) sum += w;
  Poller poller;
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    poller.due();
    const std::size_t v = at(vertices[k]);
    for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
      const double w = weights[k] / sum * static_cast<double>(clusters.weight[i]);
      weight[at(clusters.joint[i])] += w;
      point[at(clusters.joint[i])] = point[at(clusters.joint[i])] + w * target.mesh.positions[v];
    }
  }
  for (std::int32_t c = 0; c < count_; ++c) {
    if (!(weight[at(c)] > 0)) continue;
    row_column_.push_back(c);
    row_weight_.push_back(weight[at(c)]);
    row_point_.push_back(point[at(c)]);
  }
  row_start_.push_back(static_cast<std::int32_t>(row_column_.size()));
}

void Translations::prepare(const surface::Core& target, Span<const double> area, const Clusters& clusters,
                           Span<const Span<const std::int32_t>> regions, Span<const Span<const std::int32_t>> loose,
                           const TranslationOptions& options) {
  Memory& memory = *target.memory;
  count_ = clusters.count;
  const std::size_t count = at(count_);
  Buffer<double> matrix(memory, count * count);
  std::fill(matrix.begin(), matrix.end(), 0.0);
  Vector<double> table(3 * count * count, 0.0, &memory);
  add_overlap(area, target, clusters, matrix, table);
  const double sum = trace(matrix, count);
  if (sum > 0) {
    for (double& x : matrix) x /= sum;
    for (double& x : table) x /= sum;
  }
  overlap_coupling_.resize(count * count);
  spread_coupling_.assign(count * count, 0.0);
  for (std::size_t i = 0; i < matrix.size(); ++i) overlap_coupling_[i] = -matrix[i];
  if (options.spread_share > 0) {
    spread_share_ = options.spread_share;
    const SpreadTies ties = spread_ties(target, clusters.joint.data(), clusters.weight.data(), count, memory);
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      matrix[i] += options.spread_share * ties.matrix[i];
      spread_coupling_[i] = -options.spread_share * ties.matrix[i];
    }
    for (std::size_t i = 0; i < table.size(); ++i) table[i] += options.spread_share * ties.table[i];
  }
  const double total = trace(matrix, count);
  const double mean = total > 0 ? total / static_cast<double>(count) : 1.0;
  anchor_ = options.anchor * mean;
  root_ = options.root * mean;
  whole_ = options.whole * mean;

  // A row gives a point as weights of clusters. Each anchored region counts by the mean of its vertices, the whole body
  // (root) by area.
  row_start_.assign(1, 0);
  Vector<double> weights(&memory);
  Vector<std::int32_t> all(&memory);
  for (const Span<const std::int32_t>& region : regions) {
    weights.assign(region.size(), 1.0);
    add_row(region, {weights.data(), weights.size()}, target, clusters);
  }
  for (std::int32_t v = 0; v < target.size(); ++v) all.push_back(v);
  add_row({all.data(), all.size()}, area, target, clusters);
  anchored_ = regions.size();
  for (std::size_t row = 0; row <= anchored_; ++row) {
    const double l = row == regions.size() ? root_ : anchor_;
    for (std::int32_t i = row_start_[row]; i < row_start_[row + 1]; ++i) {
      for (std::int32_t j = row_start_[row]; j < row_start_[row + 1]; ++j) {
        matrix[at(row_column_[at(i)]) * count + at(row_column_[at(j)])] += l * row_weight_[at(i)] * row_weight_[at(j)];
      }
    }
  }
  for (std::size_t c = 0; c < count; ++c) matrix[c * count + c] += whole_;
  factor_.factorise(std::move(matrix), count_, memory);
  scratch_.assign(4 * count, 0.0);
  for (const Span<const std::int32_t>& region : loose) {
    weights.assign(region.size(), 1.0);
    add_row(region, {weights.data(), weights.size()}, target, clusters);
  }
  add_influences();

  // The right-hand side multiplies cluster rotations by a table with one vector per pair of clusters. Only the vectors
  // that are not zero are stored.
  for (std::size_t c = 0; c < count; ++c) {
    table_start_.push_back(static_cast<std::int32_t>(table_column_.size()));
    for (std::size_t d = 0; d < count; ++d) {
      const Vec3 g{table[3 * (c * count + d)], table[3 * (c * count + d) + 1], table[3 * (c * count + d) + 2]};
      if (g.x != 0 || g.y != 0 || g.z != 0) {
        table_column_.push_back(static_cast<std::int32_t>(d));
        table_.push_back(g);
      }
    }
  }
  table_start_.push_back(static_cast<std::int32_t>(table_column_.size()));
}

void Translations::add_influences() {
  region_rows_ = row_start_.size() - 1;
  const std::size_t rows = row_start_.size() - 1;
  influence_.assign(rows * at(count_), 0.0);
  gram_.assign(rows * rows, 0.0);
  hold_matrix_.assign(rows * rows, 0.0);
  hold_rhs_.assign(rows, Vec3());
  fill_influences(0, region_rows_);
  const std::size_t count = at(count_);
  compliance_.assign(count * count, 0.0);
  for (std::size_t c = 0; c < count; c += 4) {
    const std::size_t width = std::min<std::size_t>(4, count - c);
    std::fill(scratch_.begin(), scratch_.end(), 0.0);
    for (std::size_t k = 0; k < width; ++k) scratch_[4 * (c + k) + k] = 1;
    factor_.solve_four(scratch_.data());
    for (std::size_t k = 0; k < width; ++k)
      for (std::size_t d = 0; d < count; ++d) compliance_[(c + k) * count + d] = scratch_[4 * d + k];
  }
}

void Translations::fill_influences(std::size_t first, std::size_t last) noexcept {
  const std::size_t rows = row_start_.size() - 1, count = at(count_);
  for (std::size_t row = first; row < last; row += 4) {
    const std::size_t width = std::min<std::size_t>(4, last - row);
    std::fill(scratch_.begin(), scratch_.end(), 0.0);
    for (std::size_t k = 0; k < width; ++k) {
      for (std::int32_t i = row_start_[row + k]; i < row_start_[row + k + 1]; ++i)
        scratch_[4 * at(row_column_[at(i)]) + k] += row_weight_[at(i)];
    }
    factor_.solve_four(scratch_.data());
    for (std::size_t k = 0; k < width; ++k)
      for (std::size_t c = 0; c < count; ++c) influence_[(row + k) * count + c] = scratch_[4 * c + k];
  }
  for (std::size_t a = 0; a < last; ++a) {
    for (std::size_t b = first; b < last; ++b) {
      double sum = 0;
      for (std::int32_t i = row_start_[a]; i < row_start_[a + 1]; ++i)
        sum += row_weight_[at(i)] * influence_[b * count + at(row_column_[at(i)])];
      gram_[a * rows + b] = gram_[b * rows + a] = sum;
    }
  }
}

std::int32_t Translations::heaviest(std::size_t row) const noexcept {
  std::int32_t best = row_start_[row];
  for (std::int32_t i = best; i < row_start_[row + 1]; ++i)
    if (row_weight_[at(i)] > row_weight_[at(best)]) best = i;
  return row_column_[at(best)];
}

double Translations::row_weight(std::size_t row, std::int32_t cluster) const noexcept {
  for (std::int32_t i = row_start_[row]; i < row_start_[row + 1]; ++i)
    if (row_column_[at(i)] == cluster) return row_weight_[at(i)];
  return 0;
}

Vec3 Translations::place(std::size_t row, const Mat3* rotations, const Vec3* shifts) const noexcept {
  Vec3 sum = turned(row, rotations);
  for (std::int32_t i = row_start_[row]; i < row_start_[row + 1]; ++i)
    sum = sum + row_weight_[at(i)] * shifts[row_column_[at(i)]];
  return sum;
}

// Solves a small positive definite system by Cholesky in place, for three right-hand sides at once. It is written by
// hand, because Eigen allocates when the size is only known at run time. A constraint (hold) that this pass skips gets
// a row of the identity matrix.
void Translations::solve_holds(Span<const Hold> holds, bool with_vertical) noexcept {
  const std::size_t k = holds.size(), rows = row_start_.size() - 1;
  double* m = hold_matrix_.data();
  const auto absent = [&](std::size_t i) { return holds[i].vertical && !with_vertical; };
  for (std::size_t i = 0; i < k; ++i) {
    if (absent(i)) hold_rhs_[i] = Vec3();
    for (std::size_t j = 0; j <= i; ++j) {
      double x = absent(i) || absent(j) ? 0.0 : gram_[holds[i].row * rows + holds[j].row];
      if (i == j) x = absent(i) ? 1.0 : x * (1 + hold_ridge + (1 - holds[i].share) / holds[i].share);
      for (std::size_t l = 0; l < j; ++l) x -= m[i * k + l] * m[j * k + l];
      m[i * k + j] = i == j ? std::sqrt(std::max(x, least_pivot)) : x / m[j * k + j];
    }
  }
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t l = 0; l < i; ++l) hold_rhs_[i] = hold_rhs_[i] - m[i * k + l] * hold_rhs_[l];
    hold_rhs_[i] = (1 / m[i * k + i]) * hold_rhs_[i];
  }
  for (std::size_t i = k; i-- > 0;) {
    for (std::size_t l = i + 1; l < k; ++l) hold_rhs_[i] = hold_rhs_[i] - m[l * k + i] * hold_rhs_[l];
    hold_rhs_[i] = (1 / m[i * k + i]) * hold_rhs_[i];
  }
}

void Translations::hold(Span<const Hold> holds, Vec3 up, const Mat3* rotations, Vec3* shifts) noexcept {
  if (holds.empty()) return;
  const std::size_t count = at(count_);
  // The first pass moves across the up direction, with those constraints (holds) that are not vertical. The second
  // moves along up, with all constraints. Neither pass changes the entries of the other.
  for (const bool along : {false, true}) {
    for (std::size_t i = 0; i < holds.size(); ++i) {
      const Vec3 miss = holds[i].goal - place(holds[i].row, rotations, shifts);
      const Vec3 upward = dot(up, miss) * up;
      hold_rhs_[i] = along ? upward : miss - upward;
    }
    solve_holds(holds, along);
    for (std::size_t i = 0; i < holds.size(); ++i) {
      const double* influence = influence_.data() + holds[i].row * count;
      for (std::size_t c = 0; c < count; ++c) shifts[c] = shifts[c] + influence[c] * hold_rhs_[i];
    }
  }
}

Vec3 Translations::turned(std::size_t anchor, const Mat3* rotations) const noexcept {
  Vec3 sum;
  for (std::int32_t i = row_start_[anchor]; i < row_start_[anchor + 1]; ++i)
    sum = sum + rotations[row_column_[at(i)]] * row_point_[at(i)];
  return sum;
}

double Translations::mean(std::size_t row, const double* numbers) const noexcept {
  double sum = 0;
  for (std::int32_t i = row_start_[row]; i < row_start_[row + 1]; ++i)
    sum += row_weight_[at(i)] * numbers[row_column_[at(i)]];
  return sum;
}

Mat3 Translations::mean_rotation(std::size_t anchor, const Mat3* rotations) const noexcept {
  Mat3 sum;
  for (std::int32_t i = row_start_[anchor]; i < row_start_[anchor + 1]; ++i)
    sum = sum + row_weight_[at(i)] * rotations[row_column_[at(i)]];
  return sum;
}

void Translations::solve(const Clusters& clusters, const Mat3* rotations, Span<const Vec3> goals, Vec3 centroid,
                         const Vec3* cluster_goals, const Vec3* forces, Vec3* out) noexcept {
  for (std::int32_t c = 0; c < count_; ++c) {
    Vec3 rhs = forces[c] + whole_ * (cluster_goals[c] - rotations[c] * clusters.pivot[at(c)]);
    for (std::int32_t i = table_start_[at(c)]; i < table_start_[at(c) + 1]; ++i)
      rhs = rhs + rotations[table_column_[at(i)]] * table_[at(i)];
    out[c] = rhs;
  }
  for (std::size_t row = 0; row <= anchored_; ++row) {
    const bool is_root = row == goals.size();
    const Vec3 miss = (is_root ? root_ : anchor_) * ((is_root ? centroid : goals[row]) - turned(row, rotations));
    for (std::int32_t i = row_start_[row]; i < row_start_[row + 1]; ++i)
      out[row_column_[at(i)]] = out[row_column_[at(i)]] + row_weight_[at(i)] * miss;
  }
  for (std::size_t c = 0; c < at(count_); ++c) {
    scratch_[4 * c] = out[c].x;
    scratch_[4 * c + 1] = out[c].y;
    scratch_[4 * c + 2] = out[c].z;
    scratch_[4 * c + 3] = 0;
  }
  factor_.solve(scratch_.data());
  for (std::size_t c = 0; c < at(count_); ++c) out[c] = {scratch_[4 * c], scratch_[4 * c + 1], scratch_[4 * c + 2]};
}

}  // namespace hf_inner::transfer
