// Reads from the words in the name of a joint the part of the body and its side.
#pragma once
#include <cstddef>
#include <cstdint>

namespace hf_inner::skeleton {

// The first class that one of the words of a name belongs to decides; digit before arm, and so on.
enum class NameClass : std::uint8_t {
  none,
  digit,
  loose,
  wing,
  fin,
  eye,
  ear,
  antenna,
  jaw,
  leg,
  arm,
  tail,
  neck,
  head,
  trunk
};
constexpr std::size_t class_count = 15;

struct JointName {
  NameClass named = NameClass::none;
  std::int8_t side = 0;                                                         // 1 left, -1 right
  std::int8_t along = 0;                                                        // 1 front, -1 back
  bool collar = false, hand = false, foot = false, toe = false, lower = false;  // parts of limbs
  bool hip = false;                                                             // a hip with a side is a leg
  bool twist = false;                                                           // it lies along the bone before it
  std::uint64_t key = 0;                                                        // the same for the names of a pair
};

}  // namespace hf_inner::skeleton
