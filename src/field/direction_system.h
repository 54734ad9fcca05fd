// The operator of direction fields of one surface and degree: connection, matrix, factor and the paths of the pins.
// Immutable; every field on the surface shares it.
//
// Unknowns are numbered in the order of the surface's own factor where that is one of the same graph. Where the
// surface's operator has many edges of its own (intrinsic Delaunay on meshes that are not), the mesh's edges are
// ordered for themselves.
#pragma once
#include "engine/core.h"
#include "engine/pinned_operator.h"
#include "field/connection.h"

namespace hf_inner {

class DirectionSystem {
 public:
  // Throws what Factor::make does.
  DirectionSystem(std::shared_ptr<const Core> core, Index degree);
  Index unknown(Index vertex, Index part) const noexcept { return 2 * position[at(vertex)] + part; }
  Index vertex_of(Index unknown) const noexcept { return order[at(unknown / 2)]; }
  // K for a ConstraintSystem: two pins a component.
  PinnedOperator pinned_operator() const noexcept;

  std::shared_ptr<const Core> core;  // first member: outlives what is allocated from its memory
  Index degree;
  Connection connection;
  Vector<Index> position, order;         // of every vertex in the order of elimination, and back
  SymmetricMatrix matrix;                // K, unknowns 2 position + part
  std::shared_ptr<const Factor> factor;  // of A
  Vector<double> beta;                   // by component
  Vector<Index> pins;                    // unknowns, two by component
  PinPaths pin_paths;
  double operator_ms = 0;

 private:
  void make_order();
  void make_matrix();
  void make_pins();
};

}  // namespace hf_inner
