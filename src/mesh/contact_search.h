// Finds contacts between the pieces of a mesh: vertices of one piece near triangles of another.
//
// Each piece has a tree of boxes over its triangles. Its vertices are cut into chunks that are neighbours in space, and
// a chunk that is far from the other piece is left out. Cost: O(log n) per vertex near the other piece.
#pragma once
#include <optional>

#include "mesh/joint_tree.h"
#include "mesh/links.h"
#include "mesh/piece_tree.h"

namespace hf_inner::mesh {

struct Contact {
  Index vertex, triangle;
  double distance, cost;  // cost: with the difference of skin weights
  Index steps = 0;        // between the joints of both ends in the skeleton; 0: the same joint, or one is not known
  // The part of the cost that skin weights add, for one step in the skeleton.
  double unlike() const noexcept { return (cost - distance) / std::max(1, steps); }
};

class ContactSearch {
 public:
  // mesh and skin must outlive this object.
  ContactSearch(const Mesh& mesh, const SkinHint& skin, Memory& memory);

  const ItemBox& box(Index piece) const noexcept { return tree_.box(piece); }
  // The vertices of a piece, ascending.
  Span<const Index> vertices_of(Index piece) const noexcept {
    return {vertex_.data() + start_[at(piece)], at(start_[at(piece) + 1] - start_[at(piece)])};
  }
  // Returns the squared distance from p to a piece if it is below `within`, else `within`. enough: a squared distance.
  // The search ends at the first triangle that is at least that near. hint: a triangle that may be near, or -1.
  // triangle: the nearest, of equal ones the first, or -1.
  double nearest(Index piece, const Vec3& p, double within, double enough, Index hint, Index& triangle) const noexcept;
  // A lower bound of the amount that the difference of skin weights adds to the cost of contacts between two pieces.
  double least_skin_cost(Index a, Index b) const noexcept;
  // Whether joints that own the pieces are parent and child. Without a skeleton none are.
  bool are_kin(Index a, Index b) const noexcept;
  // Appends the contacts of piece `from` with piece `to` that are nearer than reach, in ascending order of the
  // vertices. The call lowers reach to the distance at which a contact costs `depth` more than the cheapest, or more.
  // Contacts that cost more are not needed, but some are found. most: where more vertices may have contacts, about so
  // many are tried, spread over all of them.
  void find(Index from, Index to, double depth, double& reach, Vector<Contact>& out, std::size_t most) const;
  // Keeps for each vertex of piece `from` its cheapest contact. best: by vertex; the cost of none is unbounded.
  void improve(Index from, Index to, double range, Vector<Contact>& best) const;
  // The barycentric weights of the point of a contact's triangle nearest to its vertex.
  void weights(const Contact& contact, double* out) const noexcept;

 private:
  struct Chunk {
    ItemBox box;
    Index first, last;  // of chunk_vertex_
  };
  // The largest weight of a joint in a piece.
  struct JointWeight {
    std::uint16_t joint;
    double weight;
  };
  void make_chunks();
  void list_joints();
  void read_skeleton();
  Span<const Chunk> chunks_of(Index piece) const noexcept {
    return {chunk_.data() + chunk_start_[at(piece)], at(chunk_start_[at(piece) + 1] - chunk_start_[at(piece)])};
  }
  // Finds the contact of a vertex with a piece. hint: the triangle of the vertex before, or -1; consecutive vertices
  // are near each other. It receives the triangle found.
  bool contact_of(Index v, Index piece, double reach, Index& hint, Contact& out) const;
  Contact contact(Index v, Index triangle, double squared_length) const;
  double squared(const Vec3& p, Index t, double* weights = nullptr) const noexcept;

  const Mesh& mesh_;
  const SkinHint& skin_;
  Memory& memory_;
  Vector<ItemBox> boxes_;  // by triangle
  Vector<Index> group_;    // piece by triangle
  PieceTree tree_;
  Vector<Index> start_, vertex_;              // the vertices of piece p: vertex_[start_[p] .. start_[p + 1])
  Vector<Index> chunk_start_, chunk_vertex_;  // the chunks of piece p: chunk_[chunk_start_[p] .. chunk_start_[p + 1])
  Vector<Chunk> chunk_;
  Vector<Index> joint_start_;  // the joints of piece p: joint_[joint_start_[p] .. joint_start_[p + 1]), ascending
  Vector<JointWeight> joint_;
  Vector<Index> heaviest_;  // joint by vertex, Mesh::none where all weights are 0; empty without a skeleton
  std::optional<JointTree> tree_of_joints_;
};

}  // namespace hf_inner::mesh
