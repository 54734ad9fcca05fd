// Makes quad meshes from harmonic fields, from the choice of sites to the fitted mesh.
#pragma once
#include "engine/core.h"
#include "remesh/constants.h"
#include "remesh/flux_sites.h"
#include "remesh/quad_mesh.h"

namespace hf_inner {

struct QuadOptions {
  std::shared_ptr<const Core> core;
  double edge_length = default_edge_length;  // inner units
  bool uniform = false;
  bool split = true;
  std::int32_t relax = default_relax_rounds;  // rounds that even out the mesh
  Span<const FluxSite> sites;  // FluxSite::vertex is an inner vertex of the core; every border is a site too
  bool automatic = true;
  // Without `uniform`: scales the numbers of lines to the edge length; off: keeps the caller's.
  bool scale_lines = true;
};

struct QuadResult {
  explicit QuadResult(Memory& memory) : mesh(memory), sites(&memory) {}
  QuadMesh mesh;
  Vector<FluxSite> sites;  // FluxSite::vertex is an inner vertex, or none for a border
  std::int32_t raw_faces = 0, raw_quads = 0, saddles = 0, euler_characteristic = 0;
  std::int32_t extra_extrema = 0;
  double imbalance = 0;  // the largest imbalance of flux at a vertex that is no site
};

// Throws HF_ERROR_UNSUPPORTED for surfaces that are not manifold or cannot be oriented. Also throws HF_ERROR_CANCELLED
// and std::bad_alloc.
QuadResult make_quads(const QuadOptions& options);

// Changes the weights of all places to the order of the Mesh's corners: FluxSurface may have turned triangles.
void locate_in_mesh(const FluxSurface& surface, const Mesh& mesh, QuadMesh& quads);

}  // namespace hf_inner
