// Turns triangles of a seamless map back that are turned over (foldover-free maps: Garanzha, Kaporin, Kudryavtseva,
// Protais, Ray and Sokolov 2021).
//
// With J the Jacobian of the map in a triangle, times the edge length, and D = det J, the map of its surroundings
// minimises
//
//     sum of area (|J|^2 / 2 + 1 + D^2) / chi(D),    chi(D) = (D + sqrt(e^2 + D^2)) / 2.
//
// chi is positive, and goes to D where D > 0 and to 0 elsewhere as e falls. So triangles leave D < 0. Vertices move one
// after the other, each by a Newton step in its two coordinates. Whole numbers stay. So a triangle stays turned over
// where they leave no room: both ends of an edge at one place of the grid, or two singularities that changed places.
// Cost: O(triangles) a round and the Newton steps of the vertices near triangles that are turned over.
#pragma once
#include "quads/seams.h"

namespace hf_inner::quads {

// whole: by vertex and part, coordinates that stay. z: by vertex, the map, which is changed. offset: of the seams.
void untangle(const remesh::FluxSurface& surface, const FaceCross& crosses, const Seams& seams, double edge_length,
              Span<const std::complex<double>> offset, const remesh::Table<std::uint8_t>& whole,
              remesh::Table<std::complex<double>>& z, Memory& memory);

}  // namespace hf_inner::quads
