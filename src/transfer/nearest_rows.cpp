// See nearest_rows.h.
#include "transfer/nearest_rows.h"

#include <algorithm>
#include <limits>

#include "base/index.h"
#include "transfer/constants.h"

namespace hf_inner::transfer {

NearestRows::NearestRows(Span<const double> rows, std::size_t width, Memory& memory)
    : rows_(rows), width_(width), order_(&memory), nodes_(&memory) {
  for (std::size_t i = 0; i < rows.size() / width; ++i) order_.push_back(static_cast<std::int32_t>(i));
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()));
}

// The depth is bounded: each step halves the rows.
std::int32_t NearestRows::build(std::int32_t first, std::int32_t last) {
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.emplace_back();
  nodes_[at(index)].first = first;
  nodes_[at(index)].last = last;
  if (last - first <= rows_in_leaf) return index;
  std::int32_t axis = 0;
  double widest = 0;
  for (std::size_t k = 0; k < width_; ++k) {
    double low = no_height, high = -no_height;
    for (std::int32_t i = first; i < last; ++i) {
      const double x = rows_[at(order_[at(i)]) * width_ + k];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (high - low > widest) {
      widest = high - low;
      axis = static_cast<std::int32_t>(k);
    }
  }
  if (!(widest > 0)) return index;  // equal rows
  const std::int32_t middle = first + (last - first) / 2;
  const auto value = [&](std::int32_t row) { return rows_[at(row) * width_ + at(axis)]; };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::int32_t a, std::int32_t b) { return value(a) != value(b) ? value(a) < value(b) : a < b; });
  const double split = value(order_[at(middle)]);
  const std::int32_t left = build(first, middle), right = build(middle, last);
  Node& node = nodes_[at(index)];
  node.left = left;
  node.right = right;
  node.axis = axis;
  node.split = split;
  return index;
}

void NearestRows::search(std::int32_t index, const double* row, std::int32_t& best, double& distance) const noexcept {
  const Node& node = nodes_[at(index)];
  if (node.left < 0) {
    for (std::int32_t i = node.first; i < node.last; ++i) {
      const std::int32_t candidate = order_[at(i)];
      const double* other = rows_.data() + at(candidate) * width_;
      double d = 0;
      for (std::size_t k = 0; k < width_; ++k) d += (row[k] - other[k]) * (row[k] - other[k]);
      if (d < distance || (d == distance && candidate < best)) {
        distance = d;
        best = candidate;
      }
    }
    return;
  }
  const double off = row[at(node.axis)] - node.split;
  search(off < 0 ? node.left : node.right, row, best, distance);
  if (off * off <= distance) search(off < 0 ? node.right : node.left, row, best, distance);
}

std::int32_t NearestRows::find(const double* row) const noexcept {
  std::int32_t best = -1;
  double distance = std::numeric_limits<double>::infinity();
  if (!nodes_.empty()) search(0, row, best, distance);
  return best;
}

}  // namespace hf_inner::transfer
