// Finds bones that look like helpers: roots, targets and controls that carry no skin. They are proposed, not dropped.
#pragma once
#include "weights/solution.h"

namespace hf_inner::weights {

// Why a bone looks like a helper. Bits.
enum HelperReason : std::uint32_t {
  helper_proposed = 1,      // the reasons together are enough
  helper_name_root = 2,     // the name says root
  helper_name_control = 4,  // the name says pole, target, IK or control
  helper_name_end = 8,      // the name says end, tip or slot
  helper_root = 16,         // it has no parent, but children
  helper_apart = 32,        // it has no child, and its parent is a root with other bones
  helper_no_length = 64,
  helper_coincident = 128,
  helper_outside = 256,
  helper_informs_none = 512,
};

// How much a reason counts.
struct HelperPoints {
  std::uint32_t reason;
  int points;
};

// Writes the reasons of every bone that deforms, 0 for the others. names: one line for each bone, or empty.
Vector<std::uint32_t> helper_reasons(const Bones& bones, const Vector<std::uint32_t>& faults, Span<const char> names,
                                     Memory& memory);

}  // namespace hf_inner::weights
