// The plain peer: joints of equal roles turn since rest alike, the hips move by the ratio of leg lengths. No goals.
#pragma once
#include <vector>

#include "skeleton/character.h"

namespace hf_test {

class PlainRetarget {
 public:
  PlainRetarget(const hf_inner::CharacterInput& source, const hf_inner::Character& source_character,
                const hf_inner::CharacterInput& target, const hf_inner::Character& target_character);
  // 10 numbers a joint, in and out.
  void frame(const double* source, double* target) const;

 private:
  std::vector<std::int32_t> source_parents_, target_parents_, partners_;
  std::vector<double> source_rest_, target_rest_;
  double across_[9], scale_ = 1;
  std::vector<double> align_;  // 9 numbers a joint of the target
  int source_hips_ = -1, target_hips_ = -1;
};

// Local transforms of an input as 10 numbers a joint.
std::vector<double> rest_trs(const hf_inner::CharacterInput& input);
// World matrices of a pose: 12 numbers a joint, three columns and the place.
std::vector<double> world_of(const std::vector<std::int32_t>& parents, const double* trs);

}  // namespace hf_test
