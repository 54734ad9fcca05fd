// Components of a surface, moved apart while its quads are made.
//
// Quads are fitted where they are too far from the surface. If two components lie beside each other, the quads of one
// hide places that the quads of the other miss. A thin limb inside a sleeve could lose its half. So the components
// stand in a row along x meanwhile, each farther from all others than it is long.
#pragma once
#include "remesh/quad_mesh.h"

namespace hf_inner::quads {

class Apart {
 public:
  // Moves the positions of the surface. The first component stays where it is.
  Apart(remesh::FluxSurface& surface, Memory& memory);
  // Returns where a place beside the surface as it was has gone: it moves with the nearest vertex.
  Vec3 moved(const remesh::FluxSurface& surface, Vec3 place) const noexcept;
  // Moves quads back to the surface as it was. Vertices that are exactly on it before are so afterwards.
  void bring_home(const remesh::FluxSurface& surface, const mesh::Mesh& mesh, remesh::QuadMesh& quads) const noexcept;

 private:
  remesh::Table<Vec3> offset_;  // by component
};

}  // namespace hf_inner::quads
