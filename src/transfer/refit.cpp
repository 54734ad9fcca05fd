// See refit.h.
#include "transfer/refit.h"

#include <algorithm>

#include "base/index.h"
#include "base/progress.h"
#include "transfer/constants.h"
#include "transfer/soft_rotation.h"

namespace hf_inner::transfer {
void Refit::prepare(const mesh::Mesh& target, Span<const double> area, const Clusters& clusters, Memory& memory) {
  count_ = clusters.count;
  const std::size_t count = at(count_), width = at(clusters.field_count);
  Vector<double> mass(count * count, 0.0, &memory);
  Vector<Vec3> sum(count * count, &memory);
  Poller poller;
  for (std::size_t v = 0; v < area.size(); ++v) {
    poller.due();
    for (std::size_t i = v * blend_count; i < (v + 1) * blend_count; ++i) {
      for (std::size_t j = v * blend_count; j < (v + 1) * blend_count; ++j) {
        const double w = area[v] * static_cast<double>(clusters.weight[i]) * static_cast<double>(clusters.weight[j]);
        if (!(w > 0)) continue;
        const std::size_t entry = at(clusters.joint[i]) * count + at(clusters.joint[j]);
        mass[entry] += w;
        sum[entry] = sum[entry] + w * target.positions[v];
      }
    }
  }
  start_.assign(1, 0);
  spread_.assign(count, 0.0);
  centroid_.assign(count, Vec3());
  for (std::size_t c = 0; c < count; ++c) {
    double total = 0;
    const std::size_t begin = other_.size();
    for (std::size_t d = 0; d < count; ++d) {
      const double w = mass[c * count + d];
      if (!(w > 0)) continue;
      const Vec3 x = (1 / w) * sum[c * count + d];
      other_.push_back(static_cast<std::int32_t>(d));
      weight_.push_back(w);
      point_.push_back(x);
      centroid_[c] = centroid_[c] + w * x;
      total += w;
    }
    start_.push_back(static_cast<std::int32_t>(other_.size()));
    centroid_[c] = (1 / total) * centroid_[c];
    for (std::size_t i = begin; i < other_.size(); ++i) {
      const Vec3 x = point_[i] - centroid_[c];
      spread_[c] += weight_[i] * dot(x, x);
    }
    const double* centre = clusters.centre.data() + c * width;
    const bool is_point = !(spread_[c] > least_overlap_extent * total);
    if (is_point || *std::max_element(centre, centre + width) > handle_share) spread_[c] = 0;
  }
  pair_.assign(other_.size(), 0);
}

void Refit::take_pairs(Span<const Slack::Pair> pairs) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::int32_t ends[2] = {pairs[i].first, pairs[i].second};
    for (int side = 0; side < 2; ++side)
      for (std::int32_t k = start_[at(ends[side])]; k < start_[at(ends[side]) + 1]; ++k)
        if (other_[at(k)] == ends[1 - side]) pair_[at(k)] = (side ? -1 : 1) * static_cast<std::int32_t>(i + 1);
  }
}

void Refit::turn(const deform::Quaternion* given, const Vec3* slides, const Vec3* shifts, deform::Quaternion* rotations,
                 const Mat3* matrices) const noexcept {
  for (std::size_t c = 0; c < at(count_); ++c) {
    if (!(spread_[c] > 0)) continue;
    // The moment matrix sums posed places times rest points, which are relative to their mean. So the cluster's own
    // place has no effect there, and subtracting it first keeps more digits.
    const Vec3 place = matrices[c] * centroid_[c] + shifts[c];
    Mat3 moment;
    for (std::int32_t i = start_[c]; i < start_[c + 1]; ++i) {
      const auto d = at(other_[at(i)]);
      const Vec3 x = point_[at(i)];
      Vec3 other = matrices[d] * x + shifts[d];
      if (pair_[at(i)] > 0) other = other + slides[pair_[at(i)] - 1];
      if (pair_[at(i)] < 0) other = other - slides[-pair_[at(i)] - 1];
      const Vec3 y = 0.5 * ((matrices[c] * x + shifts[c]) + other);
      deform::add_outer(moment, weight_[at(i)] / spread_[c], y - place, x - centroid_[c]);
    }
    rotations[c] = soft_rotation(moment + keep_rotation * given[c].toRotationMatrix(), given[c], refit_sharpness);
  }
}

}  // namespace hf_inner::transfer
