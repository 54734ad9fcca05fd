// The discrete Levi-Civita connection of a surface (Knoeppel, Crane, Pinkall and Schroeder 2013, Section 6). It says
// how a tangent direction at one vertex compares to one at the next vertex.
//
// The connection has a frame in the tangent plane of every vertex. For every edge it stores the angle by which a
// direction turns, relative to these frames, when it is carried along the edge.
//
// A vertex is regular when its triangles form one fan of one orientation. There, the angle of an edge is the sum of the
// corner angles between a first edge and this edge. If the fan is closed, the angles are scaled to a full turn of 2 pi.
// An edge is the same straight line seen from both ends i and j. So a direction that is carried from i to j turns by
// angle_j(j -> i) + pi - angle_i(i -> j). The curvature of a triangle is the sum of its scaled angles less pi. Over a
// closed surface the curvatures sum to 2 pi times the Euler characteristic. The frames are turned in space so that
// these angles fit the projected edges best. The frames do not depend on the vertex numbering. At irregular vertices
// (non-manifold, flipped) a direction is carried by the smallest rotation from vertex normal to vertex normal.
//
// Cost: O(n log valence).
#pragma once
#include <complex>

#include "base/elementary.h"
#include "base/hypotenuse.h"
#include "mesh/topology.h"

namespace hf_inner::field {

// Length and angle of a complex number, and a number with both given. The standard library calls functions of the C
// library, which round differently from system to system.
inline double length_of(const std::complex<double>& z) noexcept { return hypotenuse(z.real(), z.imag()); }
inline double angle_of(const std::complex<double>& z) noexcept { return arc_tangent(z.imag(), z.real()); }
inline std::complex<double> at_angle(double length, double angle) noexcept {
  return {length * cosine(angle), length * sine(angle)};
}

struct Connection {
  explicit Connection(Memory& memory)
      : normal(&memory),
        x(&memory),
        y(&memory),
        rotation(&memory),
        curvature(&memory),
        regular(&memory),
        closed(&memory) {}
  static Connection make(const mesh::Mesh& mesh, const mesh::Topology& topology, Memory& memory);

  // to_frame and to_space convert between a vector in space and a complex number z in the frame of v. The number z
  // stands for the vector Re z x + Im z y.
  std::complex<double> to_frame(std::int32_t v, Vec3 vector) const noexcept {
    const std::size_t i = static_cast<std::size_t>(v);
    return {dot(vector, x[i]), dot(vector, y[i])};
  }
  Vec3 to_space(std::int32_t v, std::complex<double> z) const noexcept {
    const std::size_t i = static_cast<std::size_t>(v);
    return z.real() * x[i] + z.imag() * y[i];
  }
  // Returns the angle by which a direction turns when it is carried along edge e to the vertex `to`.
  double turn(const mesh::Topology& topology, std::int32_t e, std::int32_t to) const noexcept {
    const double angle = rotation[static_cast<std::size_t>(e)];
    return to == topology.second(e) ? angle : -angle;
  }

  // An orthonormal frame at every vertex. From x to y is counter-clockwise, seen from the normal.
  Vector<Vec3> normal, x, y;
  // The angle by which a direction turns along each edge, from its first vertex to its second; in (-pi, pi].
  Vector<double> rotation;
  // The curvature of each triangle. If a corner is irregular, it is the turn of a round trip instead, in (-pi, pi].
  Vector<double> curvature;
  // By vertex: 1 if its triangles form one fan of one orientation.
  Vector<std::uint8_t> regular;
  // By component: 1 if every vertex is regular and none is on a border.
  Vector<std::uint8_t> closed;
  std::uint32_t irregular_count = 0;
};

// Throws HF_ERROR_NON_FINITE for an angle of a list that is not a number.
void check_angle(std::uint32_t position, double angle);

// Carries a vector from the plane of one normal to the plane of another normal, by the smallest rotation.
Vec3 carry(Vec3 vector, Vec3 from_normal, Vec3 to_normal) noexcept;

// Returns the edges of a shortest path along mesh edges, in order. The list is empty if `from` is `to`. Both vertices
// must lie in one component. Cost: O(d log d) for the d vertices that are nearer to `from` than `to` is.
Vector<std::int32_t> edge_path(const mesh::Mesh& mesh, const mesh::Topology& topology, std::int32_t from,
                               std::int32_t to, Memory& memory);

}  // namespace hf_inner::field
