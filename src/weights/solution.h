// The smooth weights of all bones before pins, locks and pruning: one solve of a screened operator.
#pragma once
#include "solve/screened.h"
#include "weights/informants.h"

namespace hf_inner::weights {

// A surface prepared for weights of any skeleton. Immutable.
struct SkinSurface {
  explicit SkinSurface(std::shared_ptr<const surface::Core> harmonic);
  std::shared_ptr<const surface::Core> core;  // first member: its memory outlives the rest
  mesh::SkinShape skin;
};

// How the weights of a vertex were found.
enum class Origin : std::uint8_t {
  informed = 0,  // from bones that it sees
  solved = 1,    // from the vertices around it
  pinned = 2,    // given
  carried = 3,   // from the nearest vertices of other pieces
  rigid = 4,     // as carried, one mean for all of a small piece
  isolated = 5,  // it has no triangle: from the nearest vertex
  matched = 6,   // carried or mirrored: from a near point whose normal agrees
  kept = 7,      // mirrored: as it was
};

struct Solution {
  Solution(std::shared_ptr<const SkinSurface> shape);
  // Throws HF_ERROR_EMPTY if no bone deforms.
  static std::shared_ptr<const Solution> make(std::shared_ptr<const SkinSurface> shape, const Bones& bones);
  std::size_t width() const noexcept { return bone_of.size(); }

  std::shared_ptr<const SkinSurface> surface;  // first member
  Vector<std::uint32_t> faults;                // BoneFault by bone
  Vector<std::uint32_t> informs;               // by bone: vertices that it informs
  Informants informants;
  std::shared_ptr<const solve::ScreenedOperator> screened;
  Vector<Index> bone_of;    // bones with information, ascending
  Vector<Index> column_of;  // by bone: its number in bone_of, or -1
  Buffer<double> field;     // [vertex][bone_of]; sums to 1 on pieces with information
};

}  // namespace hf_inner::weights
