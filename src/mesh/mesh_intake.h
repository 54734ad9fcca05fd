// Reads the mesh of a hf_surface_desc: which arrays are set, and their strides. Mesh::make checks their contents.
#pragma once
#include "hf/surface.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Returns the faces, or none where triangles are set. Throws HF_ERROR_EMPTY, _INVALID_ARGUMENT, _NULL_POINTER or
// _TOO_SMALL (a stride).
FaceRows read_faces(const hf_surface_desc& desc);

// Returns the number of triangles that the faces are cut into, for the limits. A number that 32 bits do not hold
// becomes the largest that they hold, which every limit refuses.
std::uint32_t cut_size(const FaceRows& faces);

// faces: from the desc. Throws as read_faces does.
MeshInput read_mesh(const hf_surface_desc& desc, const FaceRows& faces);

}  // namespace hf_inner::mesh
