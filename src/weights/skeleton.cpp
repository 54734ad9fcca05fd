#include "weights/skeleton.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/progress.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

Vec3 place_of(const mesh::Mesh& mesh, const Vec3& given) noexcept {
  const Vec3 p = mesh.to_inner(given);
  const auto clamped = [](double x) { return std::min(std::max(x, -farthest), farthest); };
  return {clamped(p.x), clamped(p.y), clamped(p.z)};
}

// Finds where joints end that have no tails.
class Tails {
 public:
  Tails(const Bones& bones, const mesh::Mesh& mesh, const mesh::SkinShape& skin, Memory& memory)
      : head(&memory), bones_(bones), skin_(skin), first_child_(&memory), first_end_(&memory), next_(&memory) {
    const std::size_t count = bones.head.size();
    for (const Vec3& p : bones.head) head.push_back(place_of(mesh, p));
    first_child_.assign(count, -1);
    first_end_.assign(count, -1);
    next_.assign(count, -1);
    Vector<double> lengths(&memory);
    for (Index j = bones.count() - 1; j >= 0; --j) {
      const Index parent = bones.parent[at(j)];
      if (parent < 0) continue;
      const double length = norm(head[at(j)] - head[at(parent)]);
      if (length < no_length) continue;
      const bool deforms = bones.deforms[at(j)] != 0;
      if (deforms) lengths.push_back(length);
      Index& first = deforms ? first_child_[at(parent)] : first_end_[at(parent)];
      next_[at(j)] = first;
      first = j;
    }
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    if (!lengths.empty()) std::nth_element(lengths.begin(), middle, lengths.end());
    typical_ = lengths.empty() ? 1.0 : *middle;
    if (!bones.axis.empty()) find_loose_axes(memory);
  }

  // Appends the segments of a joint: one, or one to each child.
  void append(Index j, Vector<BoneSegment>& out) const {
    const Vec3 axis = bones_.axis.empty() ? Vec3{} : bones_.axis[at(j)];
    const bool has_axis = dot(axis, axis) > 0;
    const Index first = first_child_[at(j)];
    const Index child = end_among(first, j, axis);
    if (child >= 0) {
      out.push_back({head[at(j)], head[at(child)], j});
    } else if (has_axis && loose_axes_ && first >= 0 && met(j, axis) < 0) {
      for (Index c = first; c >= 0; c = next_[at(c)]) out.push_back({head[at(j)], head[at(c)], j});
    } else {
      out.push_back({head[at(j)], !has_axis && first >= 0 ? mean_of_children(j) : end_of(j, axis), j});
    }
  }

  Vector<Vec3> head;

 private:
  static double cosine(const Vec3& way, const Vec3& axis) noexcept { return dot(way, axis) / norm(way); }
  // The child in a list at which a joint ends, or -1: the child that is best along the axis. Without an axis, the only
  // one.
  Index end_among(Index first, Index j, const Vec3& axis) const {
    if (!(dot(axis, axis) > 0)) return first >= 0 && next_[at(first)] < 0 ? first : -1;
    double best = axis_cosine;
    Index found = -1;
    for (Index c = first; c >= 0; c = next_[at(c)]) {
      const double found_cosine = cosine(head[at(c)] - head[at(j)], axis);
      if (found_cosine > best) {
        best = found_cosine;
        found = c;
      }
    }
    return found;
  }
  // Looks for a joint whose only child, deforming or not, lies off its axis, and that no other joint ends.
  void find_loose_axes(Memory& memory) {
    Vector<Index> children(head.size(), 0, &memory);
    for (const Index parent : bones_.parent) {
      if (parent >= 0) ++children[at(parent)];
    }
    Poller poller(bones_per_poll);
    for (Index j = 0; j < bones_.count() && !loose_axes_; ++j) {
      poller.due();
      const Index parent = bones_.parent[at(j)];
      if (parent < 0 || children[at(parent)] != 1) continue;
      const Vec3 axis = bones_.axis[at(parent)], way = head[at(j)] - head[at(parent)];
      loose_axes_ =
          dot(axis, axis) > 0 && norm(way) >= no_length && !(cosine(way, axis) > axis_cosine) && met(parent, axis) < 0;
    }
  }
  bool descends(Index j, Index from) const noexcept {
    while (j >= 0 && j != from) j = bones_.parent[at(j)];
    return j == from;
  }
  // The way to the parent, or a typical one: the size of a joint that no child tells.
  double unit_of(Index j) const noexcept {
    const Index parent = bones_.parent[at(j)];
    const double length = parent < 0 ? 0 : norm(head[at(j)] - head[at(parent)]);
    return length >= no_length ? length : typical_;
  }
  // The nearest joint along a direction at which a joint ends that no child continues, or -1. A leg often ends where
  // the target that steers it begins, and that target is no child of the leg.
  Index met(Index j, const Vec3& direction) const {
    double nearest = meet_length * unit_of(j);
    Index found = -1;
    for (Index k = 0; k < bones_.count(); ++k) {
      const Vec3 way = head[at(k)] - head[at(j)];
      const double distance = norm(way);
      if (!(distance >= no_length && distance < nearest) || !(cosine(way, direction) > axis_cosine)) continue;
      if (descends(j, k) || descends(k, j)) continue;
      nearest = distance;
      found = k;
    }
    return found;
  }
  // Where a joint ends that no child continues.
  Vec3 end_of(Index j, const Vec3& given) const {
    const bool has_axis = dot(given, given) > 0, leaf = first_child_[at(j)] < 0;
    const Index parent = bones_.parent[at(j)];
    const Vec3 from_parent = parent < 0 ? Vec3{} : head[at(j)] - head[at(parent)];
    const double length = norm(from_parent);
    const bool has_length = length >= no_length;
    // A mirrored joint has its axis the wrong way round: no leaf lies on the bone above it.
    const bool back = leaf && has_axis && has_length && cosine(from_parent, given) < -axis_cosine;
    const Vec3 axis = back ? (1 / length) * from_parent : given;
    const Index end = leaf && has_axis ? end_among(first_end_[at(j)], j, axis) : -1;
    if (end >= 0) return head[at(end)];
    if (!has_axis && !has_length) return head[at(j)];
    const Vec3 direction = has_axis ? axis : (1 / length) * from_parent;
    const Index other = met(j, direction);
    if (other >= 0) return head[at(other)];
    const double unit = unit_of(j);
    // A leaf away from the end of its parent, as a foot below the root, has a parent that tells nothing about its size.
    const Vec3 parent_axis = parent < 0 || bones_.axis.empty() ? Vec3{} : bones_.axis[at(parent)];
    const bool apart =
        leaf && has_length && dot(parent_axis, parent_axis) > 0 && !(cosine(from_parent, parent_axis) > axis_cosine);
    const double most = leaf ? leaf_length * (apart ? std::min(unit, typical_) : unit)
                             : std::min(hub_length * unit, hub_reach * nearest_child(j));
    return head[at(j)] + std::min(most, skin_.way_out(head[at(j)], direction, most)) * direction;
  }
  double nearest_child(Index j) const noexcept {
    double nearest = HUGE_VAL;
    for (Index c = first_child_[at(j)]; c >= 0; c = next_[at(c)])
      nearest = std::min(nearest, norm(head[at(c)] - head[at(j)]));
    return nearest;
  }
  Vec3 mean_of_children(Index j) const {
    Vec3 sum;
    double count = 0;
    for (Index c = first_child_[at(j)]; c >= 0; c = next_[at(c)]) {
      sum = sum + head[at(c)];
      ++count;
    }
    return (1 / count) * sum;
  }

  const Bones& bones_;
  const mesh::SkinShape& skin_;
  // Lists of children that do not lie on their parent: those that deform, and others, which say where leaves end.
  Vector<Index> first_child_, first_end_, next_;
  double typical_ = 1;
  bool loose_axes_ = false;  // some joint's only child lies off its axis: axes do not tell where joints end
};

}  // namespace

Vector<BoneSegment> bone_segments(const Bones& bones, const mesh::Mesh& mesh, const mesh::SkinShape& skin,
                                  Memory& memory) {
  Vector<BoneSegment> out(&memory);
  if (!bones.has_tails) {
    const Tails tails(bones, mesh, skin, memory);
    Poller poller(bones_per_poll);
    for (Index j = 0; j < bones.count(); ++j) {
      poller.due();
      if (bones.deforms[at(j)]) tails.append(j, out);
    }
    return out;
  }
  for (Index b = 0; b < bones.count(); ++b) {
    if (bones.deforms[at(b)]) out.push_back({place_of(mesh, bones.head[at(b)]), place_of(mesh, bones.tail[at(b)]), b});
  }
  return out;
}

Vector<std::uint32_t> bone_faults(Index count, const Vector<BoneSegment>& segments, const mesh::SkinShape& skin,
                                  Memory& memory) {
  Vector<std::uint32_t> faults(at(count), 0, &memory);
  Vector<std::uint8_t> is_inside(at(count), 0, &memory), is_long(at(count), 0, &memory), exists(at(count), 0, &memory);
  Vector<const BoneSegment*> sorted(&memory);
  Poller poller(bones_per_poll);
  for (const BoneSegment& s : segments) {
    poller.due();
    const std::size_t b = at(s.bone);
    exists[b] = 1;
    is_long[b] |= norm(s.tail - s.head) >= no_length;
    for (std::size_t i = 0; i < std::size(probed_shares) && !is_inside[b]; ++i)
      is_inside[b] = skin.inside(s.head + probed_shares[i] * (s.tail - s.head));
    sorted.push_back(&s);
  }
  const auto key = [](const BoneSegment* s) {
    return std::tie(s->head.x, s->head.y, s->head.z, s->tail.x, s->tail.y, s->tail.z, s->bone);
  };
  std::sort(sorted.begin(), sorted.end(), [&](const auto* a, const auto* b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const BoneSegment &a = *sorted[i - 1], &b = *sorted[i];
    if (norm(a.head - b.head) == 0 && norm(a.tail - b.tail) == 0 && a.bone != b.bone)
      faults[at(b.bone)] |= bone_coincident;
  }
  for (std::size_t b = 0; b < faults.size(); ++b) {
    if (!exists[b]) continue;
    if (!is_long[b]) faults[b] |= bone_no_length;
    if (!is_inside[b]) faults[b] |= bone_outside;
  }
  return faults;
}

}  // namespace hf_inner::weights
