// The geometry of a surface: welded mesh, edges, areas and edge weights. It has no factor.
//
// Links make a second geometry from a plain one. Its components are groups of linked pieces. Its topology has the links
// as edges without triangles. A computation on triangles alone takes the plain geometry.
//
// A geometry is immutable, so any number of threads may read it. Only its workspace pools have a lock.
#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

#include "base/jobs.h"
#include "base/memory.h"
#include "base/progress.h"
#include "mesh/graph.h"
#include "mesh/laplacian.h"
#include "mesh/links.h"
#include "mesh/mesh.h"
#include "mesh/mesh_patch.h"
#include "mesh/topology.h"
#include "surface/workspaces.h"

namespace hf_inner::surface {

struct Geometry {
  Geometry(std::shared_ptr<Memory> owner, std::shared_ptr<JobRunner> runner);
  // Welds and checks the input (Mesh::make), then computes edges, areas and weights. Throws what Mesh::make throws, and
  // HF_ERROR_CANCELLED. Progress runs from 0 to 0.15.
  static std::shared_ptr<const Geometry> make(const mesh::MeshInput& input, mesh::OperatorKind operator_kind,
                                              std::shared_ptr<Memory> memory, std::shared_ptr<JobRunner> jobs);
  // Returns a geometry whose pieces are linked, or `plain` itself where no link is found. Throws what make_links
  // throws.
  static std::shared_ptr<const Geometry> linked(std::shared_ptr<const Geometry> plain,
                                                const mesh::LinkOptions& options);
  // Returns a geometry of the same pieces with other links, which shares all but them. Links of equal groups keep the
  // components. Cost: O(n) only where components change; edges are made when they are first asked for.
  static std::shared_ptr<const Geometry> relinked(std::shared_ptr<const Geometry> from,
                                                  std::shared_ptr<const mesh::Links> links);
  // Returns a geometry with other triangles (mesh_patch.h). Throws what patched_mesh throws, and HF_ERROR_UNSUPPORTED
  // for a geometry with links. Cost: O(n); edges and counts of the report are made when they are first asked for.
  static std::shared_ptr<const Geometry> patched(std::shared_ptr<const Geometry> from, const mesh::MeshPatch& patch);
  // Returns a geometry with the edges, areas and weights of another one, and other positions. The links of that
  // one are among its edges.
  static std::shared_ptr<const Geometry> moved(const Geometry& from, Span<const Vec3> positions);
  // The geometry without links: of the triangles alone.
  const Geometry& unlinked() const noexcept { return plain ? *plain : *this; }

  // Whether two geometries come from one mesh by links and patches: the caller's numbers mean the same in both.
  bool is_kin(const Geometry& other) const noexcept { return family == other.family; }

  // Reads a graph of the caller (WeightedGraph::make), for OperatorKind::graph. Throws what that throws.
  static std::shared_ptr<const Geometry> make(const mesh::GraphInput& input, std::shared_ptr<Memory> memory,
                                              std::shared_ptr<JobRunner> jobs);
  // The weight, in the caller's unit, that a weight of 1 stands for in a component: 1 unless made of a graph.
  double weight_unit(std::int32_t component) const noexcept {
    return weight_units.empty() ? 1.0 : weight_units[static_cast<std::size_t>(component)];
  }

  std::shared_ptr<Memory> memory;  // first member: outlives everything that is allocated from it
  std::shared_ptr<JobRunner> jobs;
  // The edges of triangles and links, and the weights of the Laplacian per edge. Thread safety: any thread.
  const mesh::Topology& topology() const { return edges().topology; }
  const Vector<double>& weights() const { return edges().weights; }
  // The edges if they are there; else null, and nothing is made.
  const mesh::Topology* known_topology() const noexcept {
    return edges_made_.load(std::memory_order_acquire) ? &edges_.topology : nullptr;
  }
  // The report of the mesh; the counts of a patched mesh are made when a caller first asks. Thread safety: any thread.
  const mesh::MeshReport& mesh_report() const;

  mesh::Mesh mesh;
  SharedVector<double> areas;         // per vertex, a third of the triangles around it; the masses of a graph
  Vector<std::uint32_t> given_count;  // vertices as given, by component
  Vector<double> weight_units;        // of a graph, by component (graph.h); else empty
  Vector<std::uint8_t> limited;       // of a graph, by vertex (graph.h); else empty
  mesh::OperatorKind operator_kind = mesh::OperatorKind::intrinsic_delaunay;
  std::shared_ptr<const Geometry> plain;     // null: no links
  std::shared_ptr<const mesh::Links> links;  // null: no links
  std::shared_ptr<const char> family;        // one for all that is made of one mesh
  bool is_patched = false;
  // Counts the report of a patched mesh; null for others: a program that patches nothing links nothing of it.
  mesh::MeshReport (*count_report)(const Geometry&) = nullptr;
  double weld_ms = 0, weights_ms = 0, links_ms = 0;
  mutable WorkspacePool workspaces;
  mutable WorkspacePool zeroed_workspaces;

 private:
  struct Edges {
    explicit Edges(Memory& memory) : topology(memory), weights(&memory) {}
    mesh::Topology topology;
    Vector<double> weights;
  };
  const Edges& edges() const;

  mutable Edges edges_;
  mutable std::mutex edges_guard_;
  mutable std::atomic<bool> edges_made_{false}, report_made_{false};
  mutable mesh::MeshReport report_;
};

}  // namespace hf_inner::surface
