// Finds out whether two skeletons are equal, and then copies keys. Equal skeletons have the same names and tree, and
// their rests differ by one transform.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "retarget/retargeter.h"

namespace hf_inner::retarget {
namespace {

const char* name_of(const skeleton::CharacterInput& input, Index joint) {
  const char* const name = input.names ? input.names[joint] : nullptr;
  return name ? name : "";
}

// Joints of one name below one parent pair in their order; a joint that only one side has stays without. Children of
// the source are sorted by parent and name, and each group of equals remembers how many are taken.
void pair_children(const RetargetSide& s, const RetargetSide& t, const Vector<Index>& order, Vector<Index>& partners,
                   Memory& memory) {
  const std::size_t ns = s.input.joint_count;
  Vector<Index> sorted(ns, 0, &memory);
  std::iota(sorted.begin(), sorted.end(), 0);
  const auto compare = [&](Index i, Index parent, const char* name) {
    const Index p = s.input.parents[i];
    return p != parent ? (p < parent ? -1 : 1) : std::strcmp(name_of(s.input, i), name);
  };
  std::sort(sorted.begin(), sorted.end(), [&](Index i, Index k) {
    const int c = compare(i, s.input.parents[k], name_of(s.input, k));
    return c != 0 ? c < 0 : i < k;
  });
  Vector<std::size_t> taken(ns, 0, &memory);  // by the first of a group
  for (const Index j : order) {
    const Index p = t.input.parents[j], parent = p < 0 ? -1 : partners[at(p)];
    if (p >= 0 && parent < 0) continue;
    const char* const name = name_of(t.input, j);
    const auto first =
        std::lower_bound(sorted.begin(), sorted.end(), 0, [&](Index i, int) { return compare(i, parent, name) < 0; });
    const std::size_t begin = static_cast<std::size_t>(first - sorted.begin());
    if (begin == ns) continue;
    const std::size_t next = begin + taken[begin];
    if (next == ns || compare(sorted[next], parent, name) != 0) continue;
    ++taken[begin];
    partners[at(j)] = sorted[next];
  }
}

bool same_turns(Turn a, Turn b) noexcept { return 1 - std::fabs(dot(a, b)) < same_turn * same_turn; }
bool same_vectors(Vec3 a, Vec3 b, double size) noexcept { return norm(a - b) <= same_rest * size; }

}  // namespace

// Below the roots the local rests are equal, with one ratio of translations. The roots give the one transform.
void Retargeter::find_same(const RetargetSide& s, const RetargetSide& t) {
  same.partners.assign(at(target.count), -1);
  pair_children(s, t, target.order, same.partners, memory);
  double sum_source = 0, sum_target = 0, far = 0;
  Index root_joint = -1;
  for (std::size_t j = 0; j < at(target.count); ++j) {
    const Index i = same.partners[j];
    if (i < 0) {
      if (t.character.kinds[j] == skeleton::JointKind::body) return;
      continue;
    }
    if (target.parents[j] < 0) {
      if (root_joint < 0 || target.is_under(target.mover, static_cast<Index>(j))) root_joint = static_cast<Index>(j);
      continue;
    }
    sum_source += norm(source.translations[at(i)]);
    sum_target += norm(target.translations[j]);
    far = std::max(far, norm(target.translations[j]));
  }
  Vector<std::uint8_t> found(at(source.count), 0, &memory);
  for (const Index i : same.partners) {
    if (i >= 0) found[at(i)] = 1;
  }
  for (std::size_t i = 0; i < at(source.count); ++i) {
    if (!found[i] && s.character.kinds[i] == skeleton::JointKind::body) return;
  }
  if (root_joint < 0 || (sum_source > 0) != (sum_target > 0)) return;
  const double bones = sum_source > 0 ? sum_target / sum_source : 1;  // 0: every joint is a root
  same.bones = std::fabs(bones - 1) < same_rest ? 1 : bones;
  bool exact = same.bones == 1;
  for (std::size_t j = 0; j < at(target.count); ++j) {
    const Index i = same.partners[j];
    if (i < 0) continue;
    const bool turns = same_turns(source.rotations[at(i)], target.rotations[j]);
    const bool scales = same_vectors(source.scales[at(i)], target.scales[j], norm(target.scales[j]));
    const bool places = same_vectors(same.bones * source.translations[at(i)], target.translations[j],
                                     std::max(far, norm(target.translations[j])));
    if (target.parents[j] < 0) {
      exact = exact && turns && scales && places;
      const bool flips = source.flipped[at(i)] != target.flipped[j];
      if (flips) return;
    } else if (!turns || !scales || !places) {
      return;
    }
  }
  const std::size_t i = at(same.partners[at(root_joint)]);
  const auto size = [](Vec3 v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); };
  same.found = true;
  same.exact = exact;
  same.turn = unit_turn(target.rest.turn[at(root_joint)] * inverse(source.rest.turn[i]));
  same.scale = same.bones * size(target.scales[at(root_joint)]) / size(source.scales[i]);
  same.root = root_joint;
  report_.scale_source = ScaleSource::legs;
}

// Below the roots keys are copied; roots move by the one transform.
void Retargeter::copy_same(const double* poses, double* out) {
  for (std::size_t j = 0; j < at(target.count); ++j, out += 10) {
    const Index i = same.partners[j];
    Vec3 t = target.translations[j], s = target.scales[j];
    Turn q = target.rotations[j];
    if (i >= 0) {
      const double* key = poses + 10 * at(i);
      if (same.exact || target.parents[j] >= 0) {
        std::copy(key, key + 10, out);
        if (same.bones != 1) {
          for (int k = 0; k < 3; ++k) out[k] = same.bones * key[k];
        }
        continue;
      }
      const std::size_t r = at(same.root), by = at(same.partners[r]);
      t = target.rest.place[r] + same.scale * (same.turn * (from.place[at(i)] - source.rest.place[by]));
      q = unit_turn(same.turn * from.turn[at(i)] * target.posts[j]);
      const Vec3 own = source.scales[at(i)];
      s = {own.x != 0 ? s.x * key[7] / own.x : s.x, own.y != 0 ? s.y * key[8] / own.y : s.y,
           own.z != 0 ? s.z * key[9] / own.z : s.z};
    }
    const double numbers[] = {t.x, t.y, t.z, q.x, q.y, q.z, q.w, s.x, s.y, s.z};
    std::copy(numbers, numbers + 10, out);
  }
}

}  // namespace hf_inner::retarget
