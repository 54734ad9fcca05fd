// Lengthens edges until every triangle fulfils the triangle inequality with a margin.
//
// For edge lengths a >= b >= c, the margin is b + c - a >= mollify_closing a. If the edge a is shorter than
// mollify_floor mean edges, that length replaces a on the right. In one round, every triangle that violates the margin
// lengthens each of its two shorter edges by half of the missing length. This may open a neighbouring triangle, so the
// rounds repeat. After the last round, one length added to every edge closes the triangles that are left (Sharp and
// Crane 2020, Section 4.5). The result does not depend on the numbering. Cost: O(n) for each round. A mesh without thin
// triangles needs one round.
#pragma once
#include "mesh/topology.h"

namespace hf_inner {

// In a triangle with edges a >= b >= c, b + c - a must be at least this share of a. A flat triangle then gets
// cotangents of 3,500. Less leaves larger cotangents and fewer digits, more moves fields. On a triceratops with angles
// of 0.0002 degrees half and double move a field of 300 sites by 6e-6 and 8e-6 of its range; on seven other shapes by
// 7e-7.
constexpr double mollify_closing = 1e-8;
// The longest edge of a triangle counts as at least this share of the mean edge. It gives triangles with three equal
// positions a size. It is a guard. Half and double change no bit on eight shapes with needles, loose pieces and a long
// ribbon.
constexpr double mollify_floor = 1e-3;

struct MollifiedLengths {
  explicit MollifiedLengths(Memory& memory) : length(&memory), edge_of_side(&memory), changed(&memory) {}
  static MollifiedLengths make(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs = nullptr);

  Vector<double> length;              // by edge
  Vector<std::int32_t> edge_of_side;  // 3 t + k: the edge from corner k of triangle t to the next
  Vector<std::uint8_t> changed;       // by edge: 1 if it was lengthened; empty: none was
  std::uint32_t thin_count = 0;       // triangles that were too thin
};

}  // namespace hf_inner
