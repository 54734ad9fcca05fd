// The clusters of the paper (Xu, Zhang, Cohen-Or and Xiong 2009, Section 6): iso-levels that correspond.
//
// A cluster is a level band of one field u_h: a hat function of u_h times a power of u_h, the same on both surfaces.
// Its rotation sums over vertices (clusters.h).
#pragma once
#include <memory>

#include "transfer/cluster_scheme.h"

namespace hf_inner::peers {

// The scheme, for TransferOptions::scheme.
std::shared_ptr<const transfer::ClusterScheme> paper_clusters() noexcept;

}  // namespace hf_inner::peers
