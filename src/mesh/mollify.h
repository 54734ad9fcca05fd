// Lengthens edges until every triangle fulfils the triangle inequality with a margin.
//
// For edge lengths a >= b >= c, the margin is b + c - a >= mollify_closing a. If the edge a is shorter than
// mollify_floor mean edges, that length replaces a on the right. In one round, every triangle that violates the margin
// lengthens each of its two shorter edges by half of the missing length. This may open a neighbouring triangle, so the
// rounds repeat. After the last round, one length added to every edge closes the triangles that are left (Sharp and
// Crane 2020, Section 4.5). The result does not depend on the numbering. Cost: O(n) for each round. A mesh without thin
// triangles needs one round.
#pragma once
#include <cstdint>
#include <limits>

#include "mesh/topology.h"

namespace hf_inner::mesh {

// In a triangle with edges a >= b >= c, b + c - a must be at least this share of a. A flat triangle then gets
// cotangents of 3,500. Less leaves larger cotangents and fewer digits, more moves fields. On a triceratops with angles
// of 0.0002 degrees half and double move a field of 300 sites by at most 8e-6 of its range. On seven other shapes they
// move it by 7e-7.
constexpr double mollify_closing = 1e-8;
// The longest edge of a triangle counts as at least this share of the mean edge. It gives triangles with three equal
// positions a size. It is a guard. Half and double change no bit on eight shapes with needles, loose pieces and a long
// ribbon.
constexpr double mollify_floor = 1e-3;

// Tells from the lengths of all triangles whether some edge may have to grow. It is on the safe side: the limits are
// twice those above, so rounding hides no thin triangle.
class ThinCheck {
 public:
  void add(double a, double b, double c) noexcept {
    const double longest = a > b ? (a > c ? a : c) : (b > c ? b : c), gap = a + b + c - 2 * longest;
    sum_ += a + b + c;
    gap_ = gap < gap_ ? gap : gap_;
    const double share = gap / (longest > least_length_share ? longest : least_length_share);
    share_ = share < share_ ? share : share_;
  }
  void add(const ThinCheck& part) noexcept {
    sum_ += part.sum_;
    gap_ = part.gap_ < gap_ ? part.gap_ : gap_;
    share_ = part.share_ < share_ ? part.share_ : share_;
  }
  // edge_count: of the mesh. An edge between two triangles was added twice, so the mean is on the safe side too.
  bool may_be_thin(std::int32_t edge_count) const noexcept {
    const double mean = sum_ / (edge_count > 0 ? edge_count : 1), closing = 2 * mollify_closing;
    return !(share_ > closing && gap_ > closing * mollify_floor * mean);
  }

 private:
  // A length that divides counts as at least this, so that triangles with three equal positions do not divide by zero.
  static constexpr double least_length_share = 1e-300;
  double sum_ = 0, share_ = std::numeric_limits<double>::infinity(), gap_ = std::numeric_limits<double>::infinity();
};

struct MollifiedLengths {
  explicit MollifiedLengths(Memory& memory) : length(&memory), edge_of_side(&memory), changed(&memory) {}
  static MollifiedLengths make(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs = nullptr);

  Vector<double> length;              // by edge
  Vector<std::int32_t> edge_of_side;  // 3 t + k: the edge from corner k of triangle t to the next
  Vector<std::uint8_t> changed;       // by edge: 1 if it was lengthened; empty: none was
  std::uint32_t thin_count = 0;       // triangles that were too thin
};

}  // namespace hf_inner::mesh
