#include "weights/prune.h"

#include <algorithm>
#include <utility>

#include "base/unit_weights.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

bool before(const Share& a, const Share& b) noexcept {
  return a.weight != b.weight ? a.weight > b.weight : a.bone < b.bone;
}

double pruned(double weight) noexcept {
  if (weight >= keep_above) return weight;
  return weight <= drop_below ? 0 : (weight - drop_below) / (keep_above - drop_below) * keep_above;
}

// Keeps the `most` largest shares, descending. Returns their sum.
double keep_largest(Vector<Share>& shares, std::size_t most) {
  const std::size_t kept = std::min(most, shares.size());
  std::partial_sort(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(kept), shares.end(), before);
  shares.resize(kept);
  double sum = 0;
  for (const Share& share : shares) sum += share.weight;
  return sum;
}

}  // namespace

void write_influences(Vector<Share>& shares, const Vector<Share>& locked, bool small_drop, std::int32_t count,
                      std::uint32_t* joints, float* weights) {
  Share out[most_influences];
  std::int32_t used = 0;
  double free_units = weight_units;
  for (const Share& share : locked) {
    const double units = std::min(share.weight, free_units);
    if (units > 0 && used < count) {
      out[used++] = {share.bone, units};
      free_units -= units;
    }
  }
  if (small_drop) {
    const bool any = std::any_of(shares.begin(), shares.end(), [](const Share& s) { return pruned(s.weight) > 0; });
    for (Share& share : shares) share.weight = any ? pruned(share.weight) : std::max(share.weight, 0.0);
  }
  const double sum = free_units > 0 ? keep_largest(shares, at(count - used)) : 0.0;
  if (sum > 0) {
    const Index present = static_cast<Index>(shares.size());
    split_units(
        present, free_units, sum, [&](std::int32_t i) { return shares[at(i)].weight; },
        [&](std::int32_t i, double units) {
          if (units > 0) out[used++] = {shares[at(i)].bone, units};
        });
  } else if (used > 0) {
    out[0].weight += free_units;  // nothing else can take the rest
  } else {
    out[used++] = {shares.empty() ? 0 : shares[0].bone, weight_units};
  }
  // By hand: g++ 12 warns about std::sort on short arrays.
  for (std::int32_t i = 1; i < used; ++i) {
    for (std::int32_t j = i; j > 0 && before(out[j], out[j - 1]); --j) std::swap(out[j], out[j - 1]);
  }
  for (std::int32_t i = 0; i < count; ++i) {
    joints[i] = static_cast<std::uint32_t>(out[i < used ? i : 0].bone);
    weights[i] = i < used ? static_cast<float>(out[i].weight / weight_units) : 0.0f;
  }
}

}  // namespace hf_inner::weights
