// Poses of a test: local transforms as 10 numbers a joint, and where the joints stand.
#pragma once
#include <vector>

#include "skeleton/character.h"

namespace hf_test {

// Local transforms of an input as 10 numbers a joint.
std::vector<double> rest_trs(const hf_inner::skeleton::CharacterInput& input);
// World matrices of a pose: 12 numbers a joint, three columns and the place.
std::vector<double> world_of(const std::vector<std::int32_t>& parents, const double* trs);

}  // namespace hf_test
