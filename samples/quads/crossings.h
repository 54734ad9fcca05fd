// Faces of a mesh that run through each other, for the report of hf_quads.
#ifndef HF_SAMPLES_QUADS_CROSSINGS_H
#define HF_SAMPLES_QUADS_CROSSINGS_H

#include <cstdint>
#include <optional>

#include "common/mesh_file.h"

namespace samples {

// Counts the faces that another face crosses which shares no vertex with them. A face is crossed if an edge of the one
// passes through a triangle of the other, by its inside. Faces that only touch, or lie in one plane, do not count.
// Cost: about n^1.5 for n triangles that are spread evenly. Gives nothing if long triangles lie side by side, so that
// it would cost several times as much.
std::optional<uint32_t> count_crossing_faces(const SurfaceMesh& mesh);

}  // namespace samples

#endif
