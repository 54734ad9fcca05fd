// Intrinsic Delaunay triangulations and their Laplacian. Its weights are never negative, so harmonic fields stay within
// the range of their site values on any set of triangles.
//
// An edge of two triangles is Delaunay when the opposite angles a and b sum to at most pi, or cot a + cot b >= 0. An
// edge that is not Delaunay is flipped on the surface itself. The two triangles are unfolded into a plane, and the new
// edge gets the length of the other diagonal there. No vertex moves; only the geodesic edges between vertices change.
// The flips end (Bobenko and Springborn 2007; Sharp, Soliman and Crane 2019).
//
// An edge of one triangle, or of three and more, has no pair to unfold. The tufted cover (Sharp and Crane 2020) solves
// this. It has a front and a back face for every triangle. Around such an edge it glues each face to the next face, in
// the order of their angles. Every edge of the cover then has two faces. The Laplacian of the surface is half the
// Laplacian of the cover. A component where every edge joins two triangles of one orientation needs no cover: its
// triangles are taken once, with their full weight.
//
// Degenerate triangles, whose edge lengths violate the triangle inequality, are mollified (mollify.h): their two
// shorter edges grow. Cost: O(n) for gluing and angles, in parallel. The flips, a few per cent of the edges, run one
// after the other. The result is the same for any number of threads. Another numbering of vertices and triangles
// changes it only by rounding.
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/symmetric_matrix.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

// Sums of cotangents above minus this number count as zero. Otherwise rounding could flip co-circular pairs of
// triangles for ever. More leaves edges that should flip. Half and double change no bit on eight shapes with needles,
// loose pieces and a long ribbon.
constexpr double delaunay_rounding = 1e-10;

class IntrinsicTriangulation {
 public:
  // Makes an empty triangulation.
  explicit IntrinsicTriangulation(Memory& memory)
      : memory_(&memory), flipped_(&memory), doubled_(&memory), changed_(&memory) {}
  // Makes the tufted cover (see above) of a mesh, with the mesh's own edges. held: null, or for each edge whether the
  // surface continues beyond it. A held edge is no border and is never flipped; each of its half-edges is its own twin.
  // Throws std::bad_alloc.
  static IntrinsicTriangulation make(const Mesh& mesh, const Topology& topology, Memory& memory,
                                     JobRunner* jobs = nullptr, const Vector<std::uint8_t>* held = nullptr);

  // Flips edges until every edge is Delaunay. Returns the number of flips. After flip_limit flips (0: 64 per edge) it
  // stops, and weights that are still negative count as zero. The field then still keeps within its site values, but
  // loses accuracy.
  std::uint64_t flip_to_delaunay(std::uint64_t flip_limit = 0, JobRunner* jobs = nullptr);

  std::int32_t face_count() const noexcept { return static_cast<std::int32_t>(tail_.size() / 3); }
  // The half-edge 3 f + k of face f runs from its corner k to its next corner.
  std::int32_t tail(std::int32_t half) const noexcept { return tail_[at(half)]; }
  std::int32_t head(std::int32_t half) const noexcept { return tail_[at(next(half))]; }
  std::int32_t twin(std::int32_t half) const noexcept { return twin_[at(half)]; }
  double length(std::int32_t half) const noexcept { return length_[at(half)]; }
  // Returns the cotangent of the angle opposite the half-edge.
  double cotangent(std::int32_t half) const noexcept { return cotangent_[at(half)]; }
  // Returns (cot a + cot b) / 2 for an edge with opposite angles a and b. Where triangles have front and back faces,
  // the weight is not yet halved.
  double edge_weight(std::int32_t half) const noexcept {
    return 0.5 * (cotangent_[at(half)] + cotangent_[at(twin_[at(half)])]);
  }
  // Returns how much a face counts: one half for the front or back face of a triangle, one for a triangle that is taken
  // once.
  double share(std::int32_t face) const noexcept { return doubled_.empty() || !doubled_[at(face)] ? 1.0 : 0.5; }
  std::uint32_t mollified_count() const noexcept { return mollified_; }  // triangles of the mesh that were too thin
  // By vertex of the mesh, whether a triangle there was mollified or widened; empty: none was.
  const Vector<std::uint8_t>& changed() const noexcept { return changed_; }

  // Returns the Laplacian K. K_ij is minus the sum of the weights of the edges between i and j, with sums below zero
  // set to zero. Each diagonal entry is minus the sum of the rest of its row.
  SymmetricMatrix laplacian(std::int32_t vertex_count, Memory& memory, JobRunner* jobs = nullptr) const;
  // Returns for every vertex one third of the area of the intrinsic triangles around it. mesh, topology: as in make.
  Vector<double> vertex_areas(const Mesh& mesh, const Topology& topology, Memory& memory) const;

 private:
  static std::int32_t next(std::int32_t half) noexcept { return half % 3 == 2 ? half - 2 : half + 1; }

  // Joins the faces at their edges. back: for every triangle of the mesh, the number of its back face. It is the
  // triangle's own number where the component needs no cover.
  void glue(const Mesh& mesh, const Topology& topology, const Vector<std::int32_t>& back,
            const Vector<std::uint8_t>* held, JobRunner* jobs);
  // Computes lengths and cotangents of the faces as they stand in the mesh. Returns whether a triangle may be so thin
  // that its edges must grow; then measure_mollified is to be called.
  bool measure(const Mesh& mesh, const Topology& topology, const Vector<std::int32_t>& back, JobRunner* jobs);
  void measure_mollified(const Mesh& mesh, const Topology& topology, const Vector<std::int32_t>& back, JobRunner* jobs);
  void set_face(const double length[3], const double cotangent[3], std::size_t face, std::size_t back) noexcept;
  bool is_delaunay(std::int32_t half) const noexcept;
  void flip(std::int32_t half) noexcept;
  void measure_face(std::int32_t face) noexcept;
  void even_out(const Mesh& mesh, const Topology& topology, std::int32_t half, Vector<double>& areas) const;

  Memory* memory_;
  Buffer<std::int32_t> tail_, twin_;
  Buffer<double> length_, cotangent_;
  Vector<std::uint8_t> flipped_;  // by half-edge: 1 if a flip made it; empty: none was made
  Vector<std::uint8_t> doubled_;  // by face: 1 if its component has front and back faces; empty: none has
  Vector<std::uint8_t> changed_;
  std::uint32_t mollified_ = 0;
};

}  // namespace hf_inner::mesh
