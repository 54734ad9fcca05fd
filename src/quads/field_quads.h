// Quad meshes from smooth crosses: crosses along the curvature, a seamless map to the grid, its quads, evened out and
// fitted to the surface.
//
// The crosses decide where irregular vertices lie: one at each singularity. Everything but the rounding of the map is
// independent of the edge length, so several edge lengths cost little more than one.
#pragma once
#include "quads/chords.h"
#include "quads/cross_field.h"
#include "quads/extract.h"
#include "remesh/quads.h"

namespace hf_inner {

struct FieldQuadOptions {
  std::shared_ptr<const Core> core;
  double edge_length = default_edge_length;  // inner units
  std::int32_t faces = 0;                    // wanted number of quads, which replaces the edge length; 0: none
  std::int32_t relax = default_relax_rounds;
  double crease = 0;  // degrees: edges that bend more are kept; 0: none
};

struct FieldQuadReport {
  std::int32_t singularities = 0, parameters = 0, roundings = 0, cut_edges = 0;
  std::int32_t left_out = 0;     // equations of feature edges
  std::int32_t turned_over = 0;  // triangles of the map
  std::int32_t backward = 0;     // crossings of the map
  std::int32_t removed = 0;      // quads of folds
  std::int32_t added = 0;        // quads around thin parts
  std::int32_t chords = 0;       // that were removed
  std::int32_t substitutes = 0;  // components with quads of shorter edges
  std::int32_t split = 0;        // components with quads of their triangles
  std::int32_t tries = 0;
  double edge_length = 0;
  double field_ms = 0, map_ms = 0, quads_ms = 0, fit_ms = 0;
};

// Throws HF_ERROR_UNSUPPORTED for surfaces that are not manifold or cannot be oriented, and where no try gives a mesh
// of discs; HF_ERROR_CANCELLED.
QuadResult make_field_quads(const FieldQuadOptions& options, FieldQuadReport* report = nullptr);

}  // namespace hf_inner
