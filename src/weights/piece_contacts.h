// Where pieces touch: samples of some pieces, and the nearest places of others.
#pragma once
#include "surface/core.h"

namespace hf_inner::weights {

struct PieceContact {
  Index piece;      // whose sample it is
  Index vertex;     // the nearest one of the other piece
  double strength;  // grows with the area of the sample and falls with the distance
};

// The contacts of the pieces that are marked.
struct PieceContacts {
  PieceContacts(const surface::Core& core, const Vector<std::uint8_t>& marked, Memory& memory);
  // Numbers of contacts: of a piece, and with it as the other one.
  Span<const Index> from(Index piece) const noexcept { return part(from_start_, from_, piece); }
  Span<const Index> to(Index piece) const noexcept { return part(to_start_, to_, piece); }
  Vector<PieceContact> all;

 private:
  static Span<const Index> part(const Vector<Index>& start, const Vector<Index>& list, Index piece) noexcept {
    return {list.data() + start[at(piece)], at(start[at(piece) + 1] - start[at(piece)])};
  }
  Vector<Index> from_start_, from_, to_start_, to_;
};

}  // namespace hf_inner::weights
