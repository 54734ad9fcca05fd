// Where the weights of vertices come from that no equation reaches: pieces without information, loose vertices.
#pragma once
#include "weights/weights.h"

namespace hf_inner::weights {

struct Carriers {
  explicit Carriers(Memory& memory) : of(&memory), rigid(&memory) {}
  Vector<Index> of;            // by inner vertex: the solved vertex whose weights it takes, itself where solved
  Vector<std::uint8_t> rigid;  // by piece: 1 if all its vertices share one mean
  std::uint32_t carried_pieces = 0, rigid_pieces = 0;
};

// solved: by piece, whether its weights were solved. Without any solved piece no carrier is set (-1).
Carriers find_carriers(const mesh::Mesh& mesh, const Vector<std::uint8_t>& solved, Memory& memory, JobRunner& jobs);
// The inner vertex nearest to each isolated vertex.
Vector<Index> nearest_of_isolated(const mesh::Mesh& mesh, Memory& memory);

}  // namespace hf_inner::weights
