#include "weights/mirror_bones.h"

#include <algorithm>
#include <cmath>

#include "mesh/box_tree.h"
#include "weights/bone_names.h"
#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

// A name without its side: a hash of the other letters, and the side that was taken out.
struct SideKey {
  std::uint64_t hash;
  Index bone;
  bool right;
};

constexpr std::uint64_t hash_start = 1469598103934665603u, hash_step = 1099511628211u;  // FNV-1a

std::uint64_t hash_without(const BoneName& name, std::size_t begin, std::size_t end, std::size_t length) noexcept {
  std::uint64_t hash = hash_start;
  for (std::size_t i = 0; i < length; ++i) {
    if (i == begin) hash = (hash ^ 1u) * hash_step;
    if (i >= begin && i < end) continue;
    hash = (hash ^ static_cast<unsigned char>(lower(name[i]))) * hash_step;
  }
  return hash;
}

// Without the number that exporters put behind a name: arm_l_012.
std::size_t unnumbered(const BoneName& name) noexcept {
  std::size_t end = name.size();
  while (end > 0 && is_digit(name[end - 1])) --end;
  return end > 1 && end < name.size() && !is_letter(name[end - 1]) ? end - 1 : name.size();
}

void add_keys(const BoneName& name, Index bone, bool numbered, Vector<SideKey>& keys) {
  const std::size_t length = numbered ? name.size() : unnumbered(name);
  for_words(name, [&](std::size_t begin, std::size_t end) {
    if (end > length) return;
    for (const bool right : {false, true}) {
      if (is_word(name, begin, end, right ? "r" : "l") || is_word(name, begin, end, right ? "right" : "left"))
        keys.push_back({hash_without(name, begin, end, length), bone, right});
    }
  });
  // Inside a word: upperleftarm.
  for (std::size_t i = 0; i < length; ++i) {
    for (const bool right : {false, true}) {
      const std::size_t end = i + (right ? 5 : 4);
      if (end <= length && is_word(name, i, end, right ? "right" : "left"))
        keys.push_back({hash_without(name, i, end, length), bone, right});
    }
  }
}

}  // namespace

Vector<Index> pair_names(Span<const char> names, std::size_t count, Memory& memory) {
  Vector<Index> partner(count, -1, &memory);
  const Vector<BoneName> list = split_names(names, memory);
  for (const bool numbered : {true, false}) {
    Vector<SideKey> keys(&memory);
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (partner[b] < 0) add_keys(list[b], static_cast<Index>(b), numbered, keys);
    }
    std::sort(keys.begin(), keys.end(), [](const SideKey& a, const SideKey& b) {
      return a.hash != b.hash ? a.hash < b.hash : a.right != b.right ? !a.right : a.bone < b.bone;
    });
    keys.erase(std::unique(keys.begin(), keys.end(),
                           [](const SideKey& a, const SideKey& b) {
                             return a.hash == b.hash && a.right == b.right && a.bone == b.bone;
                           }),
               keys.end());
    for (std::size_t i = 0; i < keys.size();) {
      std::size_t end = i;
      while (end < keys.size() && keys[end].hash == keys[i].hash) ++end;
      // A key with more than one bone of a side says nothing.
      if (end == i + 2 && !keys[i].right && keys[i + 1].right) {
        const Index left = keys[i].bone, right = keys[i + 1].bone;
        if (partner[at(left)] < 0 && partner[at(right)] < 0 && left != right) {
          partner[at(left)] = right;
          partner[at(right)] = left;
        }
      }
      i = end;
    }
  }
  return partner;
}

BonePairs pair_bones(const Vector<Vec3>& heads, const Vector<Index>& named, const Vector<std::uint8_t>& given,
                     const mesh::MirrorPlane& plane, Memory& memory) {
  const std::size_t count = heads.size();
  BonePairs out(memory);
  out.partner.assign(count, -1);
  out.by.assign(count, PairedBy::none);
  out.off.assign(count, 0.0);
  Vector<Index> rest(&memory);
  Vector<mesh::ItemBox> boxes(&memory);
  for (std::size_t b = 0; b < count; ++b) {
    if (named[b] >= 0) {
      out.partner[b] = named[b];
      out.by[b] = given[b] ? PairedBy::given : PairedBy::name;
      continue;
    }
    rest.push_back(static_cast<Index>(b));
    boxes.push_back(mesh::ItemBox::of(heads[b]));
  }
  const mesh::BoxTree tree(boxes, memory);
  // The nearest bone without a partner to the reflection of each; of equal ones itself, then the lowest number.
  Vector<Index> nearest(count, -1, &memory);
  for (const Index b : rest) {
    const Vec3 there = plane.reflect(heads[at(b)]);
    double best = paired_off * paired_off;
    Index found = -1;
    tree.near(
        there, [&] { return best; },
        [&](Index i) {
          const Index other = rest[at(i)];
          const Vec3 away = heads[at(other)] - there;
          const double squared = dot(away, away);
          const bool tie = squared == best && (found < 0 || other == b || (found != b && other < found));
          if (squared < best || tie) {
            best = squared;
            found = other;
          }
        });
    nearest[at(b)] = found;
  }
  for (const Index b : rest) {
    const Index other = nearest[at(b)];
    if (other < 0 || nearest[at(other)] != b) continue;
    out.partner[at(b)] = other;
    out.by[at(b)] = other == b ? PairedBy::centre : PairedBy::place;
  }
  for (std::size_t b = 0; b < count; ++b) {
    if (out.partner[b] < 0) {
      out.partner[b] = static_cast<Index>(b);
      // Bones at one place: each is its own partner if that place lies on the plane. It is twice as far from its
      // reflection.
      if (2 * std::fabs(plane.side(heads[b])) <= paired_off) out.by[b] = PairedBy::centre;
    }
    out.off[b] = norm(plane.reflect(heads[b]) - heads[at(out.partner[b])]);
  }
  return out;
}

}  // namespace hf_inner::weights
