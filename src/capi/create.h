// Makes poses and transfers with options that their descs do not show. hf/peers.h has such options.
#pragma once
#include "deform/pose.h"
#include "hf/pose.h"
#include "hf/transfer.h"
#include "transfer/transfer.h"

namespace hf_inner::capi {

// given: the options that the desc does not hold.
hf_result create_pose(const char* function, hf_surface surface, const hf_pose_desc* desc, deform::PoseOptions given,
                      hf_pose* out_pose);
hf_result create_transfer(const char* function, hf_surface source, hf_surface target, const hf_transfer_desc* desc,
                          transfer::TransferOptions given, hf_transfer* out_transfer);

}  // namespace hf_inner::capi
