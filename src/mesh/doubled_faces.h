// Faces that lie on one another count once: the first is kept, the others are set aside.
//
// Two faces are doubled if they have the same welded corners in the same order around the face, from any corner on and
// in either direction. A face of the other direction is mirrored: the second side of a two-sided sheet. Everything that
// works on a Mesh sees the kept faces alone. The others stay in Mesh::doubled, so that the caller can still name them.
#pragma once
#include "base/jobs.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Moves doubled faces from the mesh to Mesh::doubled and counts them in the report. The corners can be numbers of any
// kind below `vertex_count`. Cost: O(corners log corners) in the worst case, for a fan of triangles.
void set_doubled_aside(Mesh& mesh, std::size_t vertex_count, Memory& memory);

// Turns kept faces of two-sided sheets round, so that neighbours run the same way. The caller may list the sides in any
// order. Fills Mesh::turned. The mesh has its inner numbers.
void turn_two_sided(const MeshInput& input, Mesh& mesh, Memory& memory, JobRunner* jobs);

}  // namespace hf_inner::mesh
