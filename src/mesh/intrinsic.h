// Intrinsic Delaunay triangulations and their Laplacian: non-negative weights, hence the maximum principle, on any
// triangle soup.
//
// Two triangles at an edge are Delaunay when the angles opposite it sum to at most pi, cot a + cot b >= 0. An edge that
// is not is flipped in the surface itself: the pair is unfolded into the plane, the other diagonal has the length it
// has there. Nothing moves; only which geodesic edges join the vertices changes, and the flips end (Bobenko and
// Springborn 2007; Sharp, Soliman and Crane 2019 for the walk on edge lengths alone).
//
// Edges of one, or of three and more triangles have no pair to unfold. The tufted cover (Sharp and Crane 2020) takes
// every triangle twice, front and back. Around an edge, in the order of the angles, it glues the side of each triangle
// to the side of the next that faces it. Every edge then has two triangles. The Laplacian of the surface is half that
// of the cover. A component where every edge joins two triangles of one orientation is its own cover and is
// taken once, unhalved.
//
// Triangles that do not close are mollified (mollify.h): their two shorter edges grow until they do.
//
// Cost: O(n) for gluing and angles, in parallel; the flips, a few per cent of the edges, one after the other. The same
// result for any number of threads, and up to rounding under any numbering of vertices and triangles.
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/symmetric_matrix.h"
#include "mesh/topology.h"

namespace hf_inner {

// Negative sums of cotangents that count as zero: co-circular pairs would flip for ever.
constexpr double delaunay_rounding = 1e-10;

class IntrinsicTriangulation {
 public:
  // Empty, without a mesh.
  explicit IntrinsicTriangulation(Memory& memory)
      : memory_(&memory),
        tail_(&memory),
        twin_(&memory),
        length_(&memory),
        cotangent_(&memory),
        doubled_(&memory),
        changed_(&memory) {}
  // The cover of the mesh with its own edges. held: null, or by edge whether more of the surface lies beyond it. A held
  // edge is no border and is never flipped; its half-edges are their own twins. Throws std::bad_alloc.
  static IntrinsicTriangulation make(const Mesh& mesh, const Topology& topology, Memory& memory,
                                     JobRunner* jobs = nullptr, const Vector<std::uint8_t>* held = nullptr);

  // Flips until every edge is Delaunay. Stops at flip_limit flips (0: 64 per edge), where the weights that are still
  // negative count as zero: that keeps the maximum principle and gives up some accuracy. Returns the number of flips.
  std::uint64_t flip_to_delaunay(std::uint64_t flip_limit = 0);

  std::int32_t face_count() const noexcept { return static_cast<std::int32_t>(tail_.size() / 3); }
  // Half-edge 3 f + k of face f runs from its corner k to the next.
  std::int32_t tail(std::int32_t half) const noexcept { return tail_[at(half)]; }
  std::int32_t head(std::int32_t half) const noexcept { return tail_[at(next(half))]; }
  std::int32_t twin(std::int32_t half) const noexcept { return twin_[at(half)]; }
  double length(std::int32_t half) const noexcept { return length_[at(half)]; }
  // Cotangent of the angle opposite the half-edge.
  double cotangent(std::int32_t half) const noexcept { return cotangent_[at(half)]; }
  // (cot a + cot b) / 2 of the edge, before the halving of a cover.
  double edge_weight(std::int32_t half) const noexcept {
    return 0.5 * (cotangent_[at(half)] + cotangent_[at(twin_[at(half)])]);
  }
  // One half on a cover, one on a component that is its own.
  double share(std::int32_t face) const noexcept { return doubled_.empty() || !doubled_[at(face)] ? 1.0 : 0.5; }
  std::uint32_t mollified_count() const noexcept { return mollified_; }  // triangles of the mesh
  // By vertex of the mesh, whether a triangle there was mollified or widened; empty: none was.
  const Vector<std::uint8_t>& changed() const noexcept { return changed_; }

  // K_ij = -sum of the weights of the edges between i and j, rounding below zero cut off; diagonal = minus the rest.
  SymmetricMatrix laplacian(std::int32_t vertex_count, Memory& memory, JobRunner* jobs = nullptr) const;
  // One third of the intrinsic triangles around every vertex.
  Vector<double> vertex_areas(std::int32_t vertex_count, Memory& memory) const;

 private:
  static std::int32_t next(std::int32_t half) noexcept { return half % 3 == 2 ? half - 2 : half + 1; }

  // back: of every triangle of the mesh, the face of its back; its own number where the component is its own cover.
  void glue(const Mesh& mesh, const Topology& topology, const Vector<std::int32_t>& back,
            const Vector<std::uint8_t>* held, JobRunner* jobs);
  void measure(const Mesh& mesh, const Topology& topology, const Vector<std::int32_t>& back, JobRunner* jobs);
  bool is_delaunay(std::int32_t half) const noexcept;
  void flip(std::int32_t half) noexcept;
  void measure_face(std::int32_t face) noexcept;

  Memory* memory_;
  Vector<std::int32_t> tail_, twin_;
  Vector<double> length_, cotangent_;
  Vector<std::uint8_t> doubled_;  // by face; empty: none is
  Vector<std::uint8_t> changed_;
  std::uint32_t mollified_ = 0;
};

}  // namespace hf_inner
