// Where islands touch: samples of some islands, and the nearest places of others.
#pragma once
#include "engine/core.h"

namespace hf_inner {

struct PieceContact {
  Index island;     // whose sample it is
  Index vertex;     // the nearest one of the other island
  double strength;  // grows with the area of the sample and falls with the distance
};

// The contacts of the islands that are marked.
struct PieceContacts {
  PieceContacts(const Core& core, const Vector<std::uint8_t>& marked, Memory& memory);
  // Numbers of contacts: of an island, and with it as the other one.
  Span<const Index> from(Index island) const noexcept { return part(from_start_, from_, island); }
  Span<const Index> to(Index island) const noexcept { return part(to_start_, to_, island); }
  Vector<PieceContact> all;

 private:
  static Span<const Index> part(const Vector<Index>& start, const Vector<Index>& list, Index island) noexcept {
    return {list.data() + start[at(island)], at(start[at(island) + 1] - start[at(island)])};
  }
  Vector<Index> from_start_, from_, to_start_, to_;
};

}  // namespace hf_inner
