// Gives a vertex whose corners have several normals or texture coordinates a copy for each, as glTF wants it.
#ifndef HF_SAMPLES_COMMON_CORNER_SPLIT_H
#define HF_SAMPLES_COMMON_CORNER_SPLIT_H

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "common/mesh_file.h"

namespace samples {

struct SplitMesh {
  std::vector<glm::dvec3> positions;
  std::vector<uint32_t> triangles;   // three each
  std::vector<uint32_t> materials;   // one a triangle, or Corners::none; empty: none has any
  std::vector<uint32_t> origins;     // the vertex of the mesh
  std::vector<glm::vec3> normals;    // zero: none; empty: the corners have none
  std::vector<glm::vec2> texcoords;  // as in glTF, (0, 0) is the upper left; empty: the corners have none
};

// Vertices keep their numbers; copies follow behind the last. Corners with equal values share a copy.
SplitMesh split_corners(const SurfaceMesh& mesh);

}  // namespace samples

#endif
