#include "mesh/box_tree.h"

#include "base/progress.h"

namespace hf_inner {
namespace {

// Items of a leaf. It trades tests of boxes for tests of items; no result depends on it. 2 and 8 take up to a tenth
// longer.
constexpr Index leaf_items = 4;

double axis_of(const Vec3& p, int axis) noexcept { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

}  // namespace

BoxTree::BoxTree(const Vector<ItemBox>& items, Memory& memory) : order_(items.size(), &memory), nodes_(&memory) {
  for (std::size_t i = 0; i < items.size(); ++i) order_[i] = static_cast<Index>(i);
  nodes_.reserve(items.size() / 2 + 2);
  if (!items.empty()) build(items, 0, static_cast<Index>(items.size()));
}

// Builds the node of order_[first .. first + count): cut at the median of the centres along the longest side.
Index BoxTree::build(const Vector<ItemBox>& items, Index first, Index count) {
  poll();
  const Index here = static_cast<Index>(nodes_.size());
  ItemBox box = items[at(order_[at(first)])];
  ItemBox centres = ItemBox::of(0.5 * (box.low + box.high));
  for (Index i = first + 1; i < first + count; ++i) {
    const ItemBox& item = items[at(order_[at(i)])];
    box.take(item), centres.take(0.5 * (item.low + item.high));
  }
  nodes_.push_back({box, first, count, -1});
  if (count <= leaf_items) return here;
  const Vec3 size = centres.high - centres.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto key = [&](Index i) { return axis_of(items[at(i)].low, axis) + axis_of(items[at(i)].high, axis); };
  const auto begin = order_.begin() + first;
  // A full order of the items: equal centres are told apart by number.
  std::nth_element(begin, begin + count / 2, begin + count, [&](Index a, Index b) {
    const double ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  });
  std::sort(begin, begin + count / 2), std::sort(begin + count / 2, begin + count);
  build(items, first, count / 2);
  const Index right = build(items, first + count / 2, count - count / 2);
  nodes_[at(here)].right = right;
  return here;
}

bool BoxTree::touches(const ItemBox& box, const Vec3& from, const Vec3& along) noexcept {
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    const double p = axis_of(from, k), d = axis_of(along, k), low = axis_of(box.low, k), high = axis_of(box.high, k);
    if (d == 0) {
      if (p < low || p > high) return false;
      continue;
    }
    const double s = (low - p) / d, t = (high - p) / d;
    enter = std::max(enter, std::min(s, t)), leave = std::min(leave, std::max(s, t));
  }
  return enter <= leave;
}

double crossing(const Vec3& from, const Vec3& way, const Vec3& a, const Vec3& b, const Vec3& c,
                bool& entering) noexcept {
  const Vec3 ab = b - a, ac = c - a, normal = cross(ab, ac);
  const double slope = dot(way, normal);
  entering = slope < 0;
  if (slope == 0) return -1;
  const Vec3 out = from - a, q = cross(way, out);
  const double u = dot(ac, q) / slope, v = -dot(ab, q) / slope;
  if (u < 0 || v < 0 || u + v > 1) return -1;
  const double t = -dot(out, normal) / slope;
  return t >= 0 && t <= 1 ? t : -1;
}

}  // namespace hf_inner
