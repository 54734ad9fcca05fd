// See slack.h.
#include "transfer/slack.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "base/progress.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {
namespace {

// 1 for equal numbers, less the more they differ. Both are above 0, or both below.
double likeness(double a, double b) noexcept { return std::min(a / b, b / a); }

}  // namespace

// The matrix of the fit, factored, and the sums that its right-hand side reads.
void Slack::prepare_fit(std::size_t count, const Side& source, Span<const double> mass, const Vec3* sum,
                        Memory& memory) {
  const std::size_t entries = source.area.size() * blend_count;
  Vector<std::int32_t> next(count, 0, &memory);
  for (std::size_t i = 0; i < entries; ++i)
    if (source.weight[i] > 0) ++next[at(source.joint[i])];
  start_.assign(1, 0);
  for (const std::int32_t size : next) start_.push_back(start_.back() + size);
  vertex_.resize(at(start_.back()));
  weight_.resize(at(start_.back()));
  std::copy(start_.begin(), start_.end() - 1, next.begin());
  for (std::size_t i = 0; i < entries; ++i) {
    if (!(source.weight[i] > 0)) continue;
    const std::size_t slot = at(next[at(source.joint[i])]++), v = i / blend_count;
    vertex_[slot] = static_cast<std::int32_t>(v);
    weight_[slot] = source.area[v] * static_cast<double>(source.weight[i]);
  }
  Buffer<double> matrix(memory, count * count);
  std::copy(mass.begin(), mass.end(), matrix.begin());
  double trace = 0;
  for (std::size_t c = 0; c < count; ++c) trace += mass[c * (count + 1)];
  for (std::size_t c = 0; c < count; ++c)
    matrix[c * (count + 1)] += fit_ridge * (mass[c * (count + 1)] + trace / static_cast<double>(count));
  for (std::size_t c = 0; c < count; ++c) {
    table_start_.push_back(static_cast<std::int32_t>(table_column_.size()));
    for (std::size_t d = 0; d < count; ++d) {
      if (!(mass[c * count + d] > 0)) continue;
      table_column_.push_back(static_cast<std::int32_t>(d));
      table_.push_back(sum[c * count + d]);
      table_mass_.push_back(mass[c * count + d]);
    }
  }
  table_start_.push_back(static_cast<std::int32_t>(table_column_.size()));
  factor_.factorise(std::move(matrix), static_cast<std::int32_t>(count), memory);
  matrix_.assign(count, Mat3());
  scratch_.assign(4 * count, 0.0);
}

void Slack::prepare(const Side& source, const Overlaps& from, const Overlaps& to, const Translations& translations,
                    const Mat3& axes, double scale, Memory& memory) {
  const std::size_t count = from.own.size();
  const SpreadTies ties = spread_ties(*source.core, source.joint, source.weight, count, memory);
  prepare_fit(count, source, {from.mass.data(), from.mass.size()}, from.sum.data(), memory);
  own_ = from.own;
  centroid_ = from.centroid;
  near_.assign(count, Vec3());
  double trace = 0;
  for (std::size_t c = 0; c < count; ++c) trace += from.mass[c * (count + 1)];
  const double least = least_common * trace / static_cast<double>(count);
  for (std::size_t c = 0; c < count; ++c) {
    for (std::size_t d = c + 1; d < count; ++d) {
      const std::size_t entry = c * count + d;
      // Where the edges of E_spread cancel, their centroid has no meaning.
      const double tie = -ties.matrix[entry], other_tie = translations.spread_tie(c, d);
      const bool tied = std::abs(tie) > certain_tie * ties.size[entry],
                 overlaps = from.mass[entry] > least && to.mass[entry] > 0;
      if (!overlaps && !(tied && tie * other_tie > 0)) continue;
      const Vec3 here = axes * (from.centroid[c] - from.centroid[d]), there = to.centroid[c] - to.centroid[d];
      const double far = norm(there), cosine = dot(here, there);
      Pair pair;
      pair.reach = norm(here);
      if (!(pair.reach > 0) || !(cosine > 0)) continue;
      pair.first = static_cast<std::int32_t>(c);
      pair.second = static_cast<std::int32_t>(d);
      const double common = overlaps ? likeness(from.mass[entry] / std::sqrt(from.own[c] * from.own[d]),
                                                to.mass[entry] / std::sqrt(to.own[c] * to.own[d]))
                                     : likeness(tie, other_tie);
      const double alike =
          likeness(far, scale * pair.reach) * common * (cosine / (pair.reach * far)) * (cosine / (pair.reach * far));
      pair.factor = scale * alike * alike;
      const Vec3 tie_point =
          tied ? (1 / tie) * Vec3{ties.table[3 * entry], ties.table[3 * entry + 1], ties.table[3 * entry + 2]} : Vec3();
      pair.overlap_point = overlaps ? (1 / from.mass[entry]) * from.sum[entry] : tie_point;
      pair.spread_point = tied ? tie_point : pair.overlap_point;
      pair.overlap_coupling = translations.overlap_coupling(c, d);
      pair.spread_coupling = translations.spread_coupling(c, d);
      pairs_.push_back(pair);
    }
  }
  slide_.assign(pairs_.size(), Vec3());
  force_.assign(count, Vec3());
}

void Slack::measure(const deform::Quaternion* rotations, const Vec3* posed, const deform::Quaternion& axes,
                    JobRunner& jobs) {
  const std::size_t count = matrix_.size();
  for (std::size_t c = 0; c < count; ++c) matrix_[c] = rotations[c].toRotationMatrix();
  jobs.for_each(static_cast<std::uint32_t>(count), [&](std::uint32_t c) {
    Vec3 sum;
    for (std::int32_t i = start_[c]; i < start_[c + 1]; ++i) sum = sum + weight_[at(i)] * posed[vertex_[at(i)]];
    near_[c] = own_[c] > 0 ? (1 / own_[c]) * sum - matrix_[c] * centroid_[c] : Vec3();
    double* to = scratch_.data() + 4 * std::size_t{c};
    to[0] = sum.x;
    to[1] = sum.y;
    to[2] = sum.z;
    to[3] = 0;
  });
  for (std::size_t c = 0; c < count; ++c) {
    double* to = scratch_.data() + 4 * c;
    for (std::int32_t i = table_start_[c]; i < table_start_[c + 1]; ++i) {
      const std::size_t d = at(table_column_[at(i)]);
      const Vec3 less = matrix_[d] * table_[at(i)] + table_mass_[at(i)] * near_[d];
      to[0] -= less.x;
      to[1] -= less.y;
      to[2] -= less.z;
    }
  }
  factor_.solve(scratch_.data());
  std::fill(force_.begin(), force_.end(), Vec3());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Pair& pair = pairs_[i];
    const double *t = scratch_.data() + 4 * at(pair.first), *other = scratch_.data() + 4 * at(pair.second);
    const Vec3 apart = near_[pair.first] - near_[pair.second] + Vec3{t[0] - other[0], t[1] - other[1], t[2] - other[2]};
    const Mat3 turned = matrix_[at(pair.first)] - matrix_[at(pair.second)];
    const double limit = most_offset * pair.reach * turned.norm();
    const auto carried = [&](Vec3 point) {
      const Vec3 slide = turned * point + apart;
      const double share = limit > 0 ? limit / std::sqrt(limit * limit + dot(slide, slide)) : 0.0;
      return pair.factor * share * deform::rotate(axes, slide);
    };
    slide_[i] = carried(pair.overlap_point);
    const Vec3 force = pair.overlap_coupling * slide_[i] + pair.spread_coupling * carried(pair.spread_point);
    force_[at(pair.first)] = force_[at(pair.first)] + force;
    force_[at(pair.second)] = force_[at(pair.second)] - force;
  }
}

}  // namespace hf_inner::transfer
