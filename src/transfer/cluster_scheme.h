// The interface to make clusters otherwise than around centres (clusters.h). A transfer with a scheme has clusters
// alone: no rest alignment, no levers, no slack, no turns towards neighbours and no ground. Transfers of hosts have no
// scheme. The room peers has the scheme of the paper.
#pragma once
#include <cstdint>

#include "surface/core.h"

namespace hf_inner::transfer {

struct SourceKernels;

// The source vertices that one kernel of a cluster covers, with their weights.
struct KernelRow {
  explicit KernelRow(Memory& memory) : vertex(&memory), weight(&memory) {}
  Vector<std::int32_t> vertex;
  Vector<double> weight;
};

struct ClusterRows {
  explicit ClusterRows(Memory& memory) : narrow(memory), broad(memory) {}
  KernelRow narrow, broad;  // the narrow one gives the rotation of the cluster
  std::int32_t support = 0;
};

// Thins both kernels to their most, and scales their weights to sum 1. An empty one takes the vertex `nearest`.
void finish_rows(ClusterRows& rows, std::int32_t nearest);

// Scales a cluster's slopes (vectors g of clusters.h), from index `begin` on, so that the moment matrix (clusters.h)
// has trace 1 at rest. Then marks where the cluster's slopes end.
void close_row(std::size_t begin, double trace, SourceKernels& out);

class ClusterScheme {
 public:
  virtual ~ClusterScheme() = default;
  // Returns the number of clusters. given: as the caller asked; 0 is the default.
  virtual std::int32_t cluster_count(std::int32_t given, std::int32_t field_count) const noexcept = 0;
  // Writes blend_count clusters and weights for each target vertex. field: [vertex][field_count].
  virtual void weigh(std::int32_t cluster_count, std::int32_t field_count, Span<const double> field,
                     std::int32_t* joint, float* weight, Memory& memory) const = 0;
  // Collects the source vertices of one cluster. area: of the source's vertices.
  virtual void collect(std::int32_t cluster, std::int32_t cluster_count, std::int32_t field_count,
                       Span<const double> field, Span<const double> area, ClusterRows& out) const = 0;
  // Adds one cluster's slopes to the kernels of the source.
  virtual void append(const KernelRow& row, const surface::Core& core, SourceKernels& out) const = 0;
};

}  // namespace hf_inner::transfer
