#include "mesh/box_tree.h"

#include "base/progress.h"

namespace hf_inner::mesh {
namespace {

// Items of a leaf. It trades tests of boxes for tests of items; no result depends on it. 2 and 8 take up to a tenth
// longer.
constexpr Index leaf_items = 4;

// A segment that misses a box by this share of its length touches it, so that rounding loses no edge. A larger number
// tests more items; no result depends on it.
constexpr double touch_slack = 1e-12;

}  // namespace

Vector<ItemBox> triangle_boxes(Span<const Vec3> positions, Span<const Index> corners, Memory& memory) {
  Vector<ItemBox> boxes(&memory);
  boxes.reserve(corners.size() / 3);
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3) {
    ItemBox box = ItemBox::of(positions[at(corners[c])]);
    box.take(positions[at(corners[c + 1])]);
    box.take(positions[at(corners[c + 2])]);
    boxes.push_back(box);
  }
  return boxes;
}

// An item while the tree is built: the sum of its box's corners, so that no axis needs the box.
struct BoxTree::Entry {
  double key[3];
  Index item;
};

BoxTree::BoxTree(Span<const ItemBox> items, Memory& memory) : BoxTree(items, {}, 1, memory) {}

BoxTree::BoxTree(Span<const ItemBox> items, Span<const Index> group, Index group_count, Memory& memory)
    : order_(items.size(), &memory),
      start_(at(group_count) + 1, 0, &memory),
      root_(at(group_count), -1, &memory),
      nodes_(&memory) {
  const auto group_of = [&](std::size_t i) { return group.empty() ? std::size_t{0} : at(group[i]); };
  for (std::size_t i = 0; i < items.size(); ++i) ++start_[group_of(i) + 1];
  for (std::size_t g = 0; g < root_.size(); ++g) start_[g + 1] += start_[g];
  Vector<Index> next(start_.begin(), start_.end() - 1, &memory);
  Vector<Entry> entries(items.size(), &memory);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Vec3 sum = items[i].low + items[i].high;
    entries[at(next[group_of(i)]++)] = {{sum.x, sum.y, sum.z}, static_cast<Index>(i)};
  }
  nodes_.reserve(items.size() / 2 + 2 * root_.size());
  for (std::size_t g = 0; g < root_.size(); ++g) {
    if (start_[g] < start_[g + 1]) root_[g] = build(items, entries.data(), start_[g], start_[g + 1] - start_[g]);
  }
}

// Builds the node of the entries [first, first + count): cut at the median of the centres along their longest side.
Index BoxTree::build(Span<const ItemBox> items, Entry* entries, Index first, Index count) {
  const Index here = static_cast<Index>(nodes_.size());
  nodes_.push_back({{}, first, count, -1});
  Entry* const begin = entries + first;
  if (count <= leaf_items) {
    std::sort(begin, begin + count, [](const Entry& a, const Entry& b) { return a.item < b.item; });
    ItemBox box = items[at(begin->item)];
    for (Index i = 0; i < count; ++i) {
      order_[at(first + i)] = begin[i].item;
      box.take(items[at(begin[i].item)]);
    }
    nodes_[at(here)].box = box;
    return here;
  }
  poll();
  double low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k] = high[k] = begin->key[k];
  for (Index i = 1; i < count; ++i) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], begin[i].key[k]);
      high[k] = std::max(high[k], begin[i].key[k]);
    }
  }
  const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
  const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  // A full order of the items: equal centres are told apart by number.
  std::nth_element(begin, begin + count / 2, begin + count, [axis](const Entry& a, const Entry& b) {
    return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis] : a.item < b.item;
  });
  build(items, entries, first, count / 2);
  const Index right = build(items, entries, first + count / 2, count - count / 2);
  ItemBox box = nodes_[at(here) + 1].box;
  box.take(nodes_[at(right)].box);
  nodes_[at(here)].box = box;
  nodes_[at(here)].right = right;
  return here;
}

BoxTree::Segment::Segment(const Vec3& start, const Vec3& way) noexcept
    : from{start.x, start.y, start.z}, inverse{way.x, way.y, way.z} {
  for (double& x : inverse) x = std::fabs(x) < 1e-300 ? 0 : 1 / x;  // the inverse of less is not finite
}

bool BoxTree::touches(const ItemBox& box, const Segment& segment) noexcept {
  const double low[3] = {box.low.x, box.low.y, box.low.z}, high[3] = {box.high.x, box.high.y, box.high.z};
  double enter = 0, leave = 1;
  for (int k = 0; k < 3; ++k) {
    const double p = segment.from[k], inverse = segment.inverse[k];
    if (inverse == 0) {
      if (p < low[k] || p > high[k]) return false;
      continue;
    }
    const double s = (low[k] - p) * inverse, t = (high[k] - p) * inverse;
    enter = std::max(enter, std::min(s, t));
    leave = std::min(leave, std::max(s, t));
  }
  return enter <= leave + touch_slack;
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

}  // namespace hf_inner::mesh
