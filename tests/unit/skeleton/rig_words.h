// The names that tools give to the parts of a human body.
#pragma once
#include <map>

#include "rig_family.h"

namespace hf_test {

// The parts of the body, in the words of each tool; # is the side, % the number of the spine joint.
struct Words {
  std::string left, right;
  std::map<std::string, std::string> parts;
};

const Words& words_of(const std::string& convention);

}  // namespace hf_test
