// Tangent vector fields by components (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.3): three harmonic channels, then
// v <- v - (n . v) n with the area-weighted vertex normal n.
#pragma once
#include "mesh/topology.h"

namespace hf_inner {

// Unit area-weighted normals of the inner vertices; zero where the triangles around cancel out.
Vector<Vec3> vertex_normals(const Mesh& mesh, Memory& memory);

// That of one vertex, at the cost of its ring.
Vec3 vertex_normal(const Mesh& mesh, const Topology& topology, std::int32_t vertex) noexcept;

// vectors[v * 3 + c], in place. Projected twice, so that n . v is zero to rounding even for nearly normal vectors.
void project_on_tangent_planes(const Vector<Vec3>& normals, double* vectors) noexcept;

}  // namespace hf_inner
