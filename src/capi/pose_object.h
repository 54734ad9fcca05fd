// The object behind hf_pose.
#pragma once
#include <atomic>

#include "capi/objects.h"
#include "deform/pose_stack.h"
#include "hf/pose.h"

namespace hf_inner::capi {

struct PoseObject final : Object {
  static constexpr Kind kind_of = Kind::pose;
  PoseObject(std::shared_ptr<Memory> owner, std::shared_ptr<deform::PoseStack> given)
      : Object(kind_of, std::move(owner)),
        pose(std::move(given)),
        keeps_order(mesh::keeps_vertices(pose->core().mesh)),
        handle_count(pose->handle_count()) {}
  std::shared_ptr<deform::PoseStack> pose;
  hf_pose_statistics last{};  // of the last deform
  bool keeps_order;           // the library's vertices are the caller's: none welded, none isolated
  // The handle count after the last finished change. Another thread may read it while a change runs.
  std::atomic<std::uint32_t> handle_count;
};

}  // namespace hf_inner::capi
