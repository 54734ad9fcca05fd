// Poses that retargets give back, for golden.cpp.
#pragma once
#include <vector>

namespace reliability {

// A man walks, waves and sits down; a man with longer legs follows with each set of options, and a copy of the first
// retarget goes on from its state.
std::vector<float> retargeted_poses();

}  // namespace reliability
