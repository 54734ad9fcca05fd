// The operator of the direction fields of one surface and degree. It is immutable: DirectionMatrix has connection and
// matrix; DirectionSystem has also the factor and the elimination paths of the pinned unknowns, and all direction
// fields of that degree on the surface share it.
//
// The unknowns have the order of the surface's own factor if that factor has the edges of the mesh. The intrinsic
// Delaunay operator can have many other edges. In that case the unknowns get an ordering computed from the edges of the
// mesh.
#pragma once
#include "field/connection.h"
#include "solve/pinned_operator.h"
#include "surface/core.h"

namespace hf_inner::field {

class DirectionMatrix {
 public:
  // Throws what computing an ordering throws.
  DirectionMatrix(std::shared_ptr<const surface::Core> core, Index degree);
  Index unknown(Index vertex, Index part) const noexcept { return 2 * position[at(vertex)] + part; }
  Index vertex_of(Index unknown) const noexcept { return order[at(unknown / 2)]; }
  // Factorises a matrix of this pattern and order.
  std::shared_ptr<const factor::Factor> factorise(const SymmetricMatrix& like) const;

  std::shared_ptr<const surface::Core> core;  // first member: outlives everything that is allocated from its memory
  Index degree;
  Connection connection;
  Vector<Index> position, order;  // of every vertex in the order of elimination, and back
  SymmetricMatrix matrix;         // K, unknowns 2 position + part
  double operator_ms = 0;

 private:
  void make_order();
  void make_matrix();
};

class DirectionSystem : public DirectionMatrix {
 public:
  // Throws what Factor::make throws.
  DirectionSystem(std::shared_ptr<const surface::Core> core, Index degree);
  // Returns the operator K for a ConstraintSystem. Each component has two pinned unknowns (raised diagonals).
  solve::PinnedOperator pinned_operator() const noexcept;

  std::shared_ptr<const factor::Factor> factor;  // of K with raised diagonals at `pins`
  Vector<double> beta;                           // by component: how much the diagonals are raised
  Vector<Index> pins;                            // unknowns with raised diagonals, two by component
  solve::PinPaths pin_paths;

 private:
  void make_pins();
};

}  // namespace hf_inner::field
