// Reads the caller's faces into a Mesh: checks, welded corners, the cut into triangles, counts.
#pragma once
#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

// Returns the number of triangles that the faces are cut into, before anything is allocated. Throws
// HF_ERROR_OUT_OF_RANGE, HF_ERROR_INVALID_ARGUMENT (fewer than three corners), HF_ERROR_TOO_LARGE (index = face).
std::uint64_t count_cut_triangles(const FaceRows& faces);

// Throws HF_ERROR_OUT_OF_RANGE (index = face) for a corner that is no vertex.
void check_face_corners(const FaceRows& faces, std::uint32_t vertex_count);

// Marks the corners of the faces that have three or more after welding, by given vertex.
void mark_corners(const MeshInput& input, const Vector<std::int32_t>& representative, Vector<std::uint8_t>& is_corner,
                  Memory& memory);

// Cuts the faces and fills mesh.corners, mesh.triangle_of_given and mesh.faces with numbers of given vertices.
// representative: by given vertex, the one it is welded with. The mesh has its frame already.
void take_faces(const MeshInput& input, const Vector<std::int32_t>& representative, Mesh& mesh, Memory& memory);

// By edge of the cut, whether it is a side of a face and not only a line of the cut.
Vector<std::uint8_t> face_sides(const Faces& faces, const Topology& topology, Memory& memory);

// Counts boundary, non-manifold and flipped sides of faces in the report, as count_edges does for triangles.
void count_face_sides(const Faces& faces, const Topology& topology, MeshReport& report, Memory& memory);

}  // namespace hf_inner::mesh
