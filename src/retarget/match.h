// Finds the partner of every joint of the target, and how its rest is aligned.
#pragma once
#include "retarget/retargeter.h"

namespace hf_inner::retarget {

enum class Aligning : std::int32_t { none, line, whole, segments };

// The turns that bring the segments of the target at rest to the directions of the source; `before` comes first.
// line: the chain turns as one, the shortest way. whole: then about its line to the bend of the source. segments: then
// bone by bone.
void align_chain(const Retargeter& r, ChainPair& pair, Aligning how, Turn before);  // align.cpp

// Place k of a chain at rest: where segment k begins, or the tip.
Vec3 segment_place(const Rig& rig, const Segments& chain, std::size_t k) noexcept;  // align.cpp
// Segments whose both ends are known.
std::size_t bone_count(const Segments& chain) noexcept;  // align.cpp

struct Matcher {
  Matcher(Retargeter& retargeter, const RetargetSide& source_side, const RetargetSide& target_side, Memory& m)
      : r(retargeter), s(source_side), t(target_side), memory(m), used(at(r.source.count), 0, &m) {}
  Retargeter& r;
  const RetargetSide &s, &t;
  Memory& memory;
  Vector<std::uint8_t> used;  // joints of the source with a partner

  void follow(Index target, Index a, Index b, double share, Turn align);
  void one_to_one(Index source, Index target);
  // Adds the pair and lets each joint of the target follow.
  void add_pair(ChainPair pair, Aligning how, Turn before);
  void add_path(const Vector<Index>& a, const Vector<Index>& b, Index a_before, Index b_before, Index a_end,
                Index b_end, skeleton::Role role);
  void add_limb(const skeleton::Chain& a, const skeleton::Chain& b, Aligning how, bool standing);
  void add_collars(const Segments& a, const Segments& b);
  void add_next(const skeleton::Chain& a, const skeleton::Chain& b, skeleton::Role role, Turn align);
  void add_fingers(const skeleton::Chain& a, const skeleton::Chain& b, Turn align);
  void add_limbs();
  void add_second_trunk();
  void add_others();
};

}  // namespace hf_inner::retarget
