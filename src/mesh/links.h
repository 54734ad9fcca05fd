// Links join the pieces of a mesh (its edge-connected components) into one domain by springs.
//
// A link is a point-to-triangle spring: vertex a to the point sum_k s_k b_k of another piece. In the operator it is up
// to three edges (a, b_k) of weight stiffness * s_k * unit. All are positive, so an M-matrix stays one and a field
// keeps to the range of its sites. The unit is the edge weight between two equilateral triangles, or 1 for uniform
// weights.
//
// A light piece is a sheet over another piece, such as cloth or armour. Its edges and links count light_share times, so
// it follows the piece below and hardly pulls it.
#pragma once
#include <cstdint>

#include "base/index.h"
#include "base/jobs.h"
#include "base/memory.h"
#include "base/symmetric_matrix.h"
#include "mesh/laplacian.h"
#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

enum class LinkMode : std::int32_t { none = 0, pieces = 1, list = 2 };

struct Link {
  Index vertex = Mesh::none;
  Index corner[3] = {Mesh::none, Mesh::none, Mesh::none};  // none where the share is 0
  double share[3] = {0, 0, 0};                             // barycentrics, of sum 1
  double weight = 1;                                       // relative to the stiffness
  double length = 0;                                       // at rest, in the unit of the inner mesh
  bool tree = false;                                       // a link of the tree over the pieces
};

// Skin weights as a hint: pieces that move with the same joints rather link to each other.
struct SkinHint {
  std::uint32_t influence_count = 0;      // per vertex; 0: no hint
  const std::uint16_t* joints = nullptr;  // [vertex as given][influence_count]
  const float* weights = nullptr;
  Span<const std::uint32_t> parents;  // by joint, HF_NO_INDEX of a root; empty: the skeleton is not known
};

// Lengths are in the unit of the inner mesh: shares of the diagonal of the bounding box.
struct LinkOptions {
  LinkMode mode = LinkMode::none;
  double distance = 0;             // longest link
  double stiffness = 1;            // of every link
  double overlay = 0;              // a sheet at most this far from a larger piece is light; 0: none is
  Span<const std::uint32_t> tags;  // by vertex as given, or empty: pieces with different tags do not link
  SkinHint skin;
  Span<const Link> list;           // for LinkMode::list, without lengths
  Span<const Index> light, heavy;  // inner vertices whose pieces are light, or not
};

// A vertex that touches a piece linked to its own, and the nearest triangle of that piece at rest.
struct Touch {
  Index vertex, triangle;
  double length;  // at rest, in the unit of the inner mesh
};

struct Links {
  explicit Links(Memory& memory)
      : links(&memory), open(&memory), touching(&memory), piece(memory), light(&memory), group(&memory) {}
  Vector<Link> links;
  Vector<Link> open;           // contacts of joints far apart in the skeleton: measured, but no springs
  Vector<Touch> touching;      // of linked pieces, by pair
  SharedVector<Index> piece;   // by vertex: the components of the mesh without links
  Vector<std::uint8_t> light;  // by piece
  Vector<Index> group;         // by piece, numbered by their first pieces
  Index group_count = 0;
  Index alone_count = 0;  // pieces without a link, if there are several
  double longest_tree_link = 0;
  double stiffness = 1;
};

// Returns how much the skin weights of a vertex and of a point in a triangle differ: 0 for equal ones, 1 without a
// common joint. corner, share: the triangle and its barycentrics.
double difference(const SkinHint& skin, const Mesh& mesh, Index vertex, const Index* corner, const double* share);

// Returns the distance of a link's ends at rest.
double rest_length(const Link& link, const Mesh& mesh) noexcept;

// Finds or takes the links of a mesh. areas: by vertex. Throws HF_ERROR_TOO_LARGE above most_linked_pieces pieces, and
// HF_ERROR_INVALID_ARGUMENT if the heavy and light vertices share a piece (index: position in `heavy`).
std::shared_ptr<const Links> make_links(const Mesh& mesh, Span<const double> areas, const LinkOptions& options,
                                        Memory& memory, JobRunner* jobs);

// Numbers the groups of linked pieces, and counts pieces without a link. Needs links, pieces and light ones.
void find_groups(Links& links, Memory& memory);

// The links as edges of the operator, sorted by (first, second), with first < second. No edge is listed twice.
struct LinkEdge {
  Index first, second;
  double weight;
};
Vector<LinkEdge> link_edges(const Links& links, OperatorKind operator_kind, Memory& memory);

// Numbers the groups of linked pieces by their lowest vertices, as components of a copy of the mesh.
Mesh linked_mesh(const Mesh& mesh, const Links& links, Memory& memory);

// Returns the topology with the links as edges without triangles. weights: by edge, of the topology; receives the
// weights of the returned topology, with edges of light pieces scaled.
Topology linked_topology(const Topology& topology, const Links& links, Span<const LinkEdge> edges,
                         Vector<double>& weights, Memory& memory);

// Adds the links to a Laplacian, and scales the edges of light pieces. Rows sum to 0 as before.
void add_links(SymmetricMatrix& laplacian, const Links& links, Span<const LinkEdge> edges, Memory& memory);

// The widest gap and the 95th percentile; they reorder the gaps. worst_link: HF_NO_INDEX without gaps.
struct GapSummary {
  double worst = 0, percentile_95 = 0;
  std::uint32_t worst_link = HF_NO_INDEX;
};
GapSummary summarise_gaps(Span<double> gaps);

// Writes for every link how much farther its ends are apart than at rest, or 0. posed: positions by vertex as given, in
// the unit of the mesh. Throws HF_ERROR_NON_FINITE or HF_ERROR_TOO_LARGE (index = vertex as given).
void measure_gaps(const Mesh& mesh, Span<const Link> links, const ConstRows& posed, Span<double> gaps);

}  // namespace hf_inner::mesh
