// The discrete Levi-Civita connection of a surface (Knoeppel, Crane, Pinkall and Schroeder 2013, Section 6).
//
// It has a frame in the tangent plane of every vertex. For every edge it has the angle by which a direction turns in
// these frames when it is carried along.
//
// A vertex is regular when its triangles form one fan of one orientation. Directions there are measured by the angles
// between the edges, summed around the vertex and, when the fan is closed, scaled to a full turn of 2 pi. An edge is
// the same straight line seen from both ends, so carrying turns by angle_j(j -> i) + pi - angle_i(i -> j). The
// curvature of a triangle is the sum of its scaled angles less pi. Over a closed surface it sums to 2 pi times the
// Euler characteristic. Frames lie in space so that these angles fit the projected edges best, whatever their
// numbering. At other vertices (non-manifold, flipped) directions are carried along edges in space, by the smallest
// rotation from normal to normal.
//
// Cost: O(n log valence).
#pragma once
#include <complex>

#include "mesh/topology.h"

namespace hf_inner {

struct Connection {
  explicit Connection(Memory& memory)
      : normal(&memory),
        x(&memory),
        y(&memory),
        rotation(&memory),
        curvature(&memory),
        regular(&memory),
        closed(&memory) {}
  static Connection make(const Mesh& mesh, const Topology& topology, Memory& memory);

  // A complex number z in the frame of v stands for the vector Re z x + Im z y.
  std::complex<double> to_frame(std::int32_t v, Vec3 vector) const noexcept {
    const std::size_t i = static_cast<std::size_t>(v);
    return {dot(vector, x[i]), dot(vector, y[i])};
  }
  Vec3 to_space(std::int32_t v, std::complex<double> z) const noexcept {
    const std::size_t i = static_cast<std::size_t>(v);
    return z.real() * x[i] + z.imag() * y[i];
  }
  // Turn of a direction that goes along edge e to the vertex `to`.
  double turn(const Topology& topology, std::int32_t e, std::int32_t to) const noexcept {
    const double angle = rotation[static_cast<std::size_t>(e)];
    return to == topology.second(e) ? angle : -angle;
  }

  Vector<Vec3> normal, x, y;     // orthonormal at every vertex, counter-clockwise seen from the normal
  Vector<double> rotation;       // along an edge from its first vertex to its second; in (-pi, pi]
  Vector<double> curvature;      // of a triangle; at irregular corners a round trip, in (-pi, pi]
  Vector<std::uint8_t> regular;  // by vertex
  Vector<std::uint8_t> closed;   // by component: every vertex is regular and inside
  std::uint32_t irregular_count = 0;
};

// The vector carried from the plane of one normal to that of another by the smallest rotation.
Vec3 carry(Vec3 vector, Vec3 from_normal, Vec3 to_normal) noexcept;

// Edges of a shortest path along the edges of the mesh, in order; empty when `from` is `to`. Both in one component.
// Cost: O(d log d) for the d vertices nearer to `from` than `to` is.
Vector<std::int32_t> edge_path(const Mesh& mesh, const Topology& topology, std::int32_t from, std::int32_t to,
                               Memory& memory);

}  // namespace hf_inner
