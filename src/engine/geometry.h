// The geometry of a surface: welded mesh, edges, areas and edge weights. It has no factor.
//
// A geometry is immutable, so any number of threads may read it. Only its workspace pools have a lock.
#pragma once
#include <cstdint>
#include <memory>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "engine/workspaces.h"
#include "mesh/laplacian.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace hf_inner {

struct Geometry {
  Geometry(std::shared_ptr<Memory> owner, std::shared_ptr<JobRunner> runner);
  // Welds and checks the input (Mesh::make), then computes edges, areas and weights. Throws what Mesh::make throws, and
  // HF_ERROR_CANCELLED. Progress runs from 0 to 0.15.
  static std::shared_ptr<const Geometry> make(const MeshInput& input, OperatorKind operator_kind,
                                              std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs);

  std::shared_ptr<Memory> memory;  // first member: outlives what is allocated from it
  std::shared_ptr<JobRunner> jobs;
  Mesh mesh;
  Topology topology;
  Vector<double> areas;               // per vertex, a third of the triangles around it
  Vector<double> weights;             // of the Laplacian, per edge of the mesh
  Vector<std::uint32_t> given_count;  // vertices as given, by component
  OperatorKind operator_kind = OperatorKind::intrinsic_delaunay;
  double weld_ms = 0, weights_ms = 0;
  mutable WorkspacePool workspaces;
  mutable WorkspacePool zeroed_workspaces;
};

}  // namespace hf_inner
