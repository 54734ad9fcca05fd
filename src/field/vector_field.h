// Makes tangent vector fields from three harmonic channels (Xu, Zhang, Cohen-Or and Xiong 2009, Section 3.3). Each
// vector v is projected on the tangent plane: v - (n . v) n, with n the area-weighted vertex normal.
#pragma once
#include "mesh/topology.h"

namespace hf_inner::field {

// Returns the unit area-weighted normals of the welded vertices. A normal is zero where the triangles around it cancel
// out.
Vector<Vec3> vertex_normals(const mesh::Mesh& mesh, Memory& memory);

// Returns the normal of one vertex. The cost is proportional to the number of its triangles.
Vec3 vertex_normal(const mesh::Mesh& mesh, const mesh::Topology& topology, std::int32_t vertex) noexcept;

// Projects vectors[v * 3 + c] in place. It projects twice, so that n . v is zero up to rounding even for vectors that
// are nearly normal.
void project_on_tangent_planes(const Vector<Vec3>& normals, double* vectors) noexcept;

}  // namespace hf_inner::field
