// Leaves out faces that lie on a line and join nothing, as faces with equal corners are left out.
//
// A face without area covers nothing. It can still join others: a sliver that shuts a T-junction joins the face at its
// long edge to those at its short edges. So a face on a line stays if two of its shared edges overlap on that line. It
// also stays if a corner is in no face with area: such a vertex would have no surface. The kept faces do not depend on
// the order of faces or vertices.
#pragma once
#include "base/jobs.h"
#include "mesh/mesh.h"

namespace hf_inner::mesh {

// Removes these faces from the mesh and counts them as collapsed. The mesh has the caller's vertex numbers, its frame,
// and no doubled faces. Cost: a pass over all triangles, in parallel; O(k log k) for k faces on a line.
void leave_line_faces_out(const MeshInput& input, Mesh& mesh, Memory& memory, JobRunner* jobs);

}  // namespace hf_inner::mesh
