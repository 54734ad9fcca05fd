// The two ways to solve a pose, for tests that compare them.
#pragma once
#include "deform/pose_scheme.h"
#include "peers/paper_pose.h"

namespace hf_test {

enum class DeformMode { smooth, paper };

// For PoseOptions::scheme.
inline std::shared_ptr<const hf_inner::deform::PoseScheme> scheme_of(DeformMode mode) {
  return mode == DeformMode::paper ? hf_inner::peers::paper_scheme() : nullptr;
}

}  // namespace hf_test
