// Leaves out pairs of opposite singularities that the crosses can do without.
//
// Where the curvature changes within a few edges of quads, crosses that follow it have two singularities of opposite
// index beside each other. Without a wish around them they often cancel. So the wish is left out around each such pair,
// and stays out where the crosses then have fewer singularities. Cost: twice the cost of smoothing.
#pragma once
#include "quads/cross_field.h"
#include "quads/face_cross.h"

namespace hf_inner::quads {

// edge_length: of the quads, or of the surface where its edges are longer. wish, hard: as CrossSmoother has them.
// features: by half-edge.
void leave_out_pairs(const remesh::FluxSurface& surface, const field::DirectionMatrix& system, CrossSmoother& smoother,
                     Span<const HardCross> hard, const remesh::Table<std::uint8_t>& features,
                     const SharpCorners& corners, double edge_length, Vector<std::complex<double>>& wish);

}  // namespace hf_inner::quads
