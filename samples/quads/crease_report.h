// Which creases of a surface are edges of its quads, for the report of hf_quads.
#ifndef HF_SAMPLES_QUADS_CREASE_REPORT_H
#define HF_SAMPLES_QUADS_CREASE_REPORT_H

#include <glm/glm.hpp>

#include "common/mesh_file.h"

namespace samples {

struct CreaseReport {
  uint32_t edges = 0;         // edges of the surface that bend by more degrees
  uint32_t released = 0;      // of them, those with a point farther than 0.1 edge lengths from every edge of a quad
  double farthest = 0;        // the largest of these distances, in edge lengths
  glm::dvec3 place{0, 0, 0};  // and where it is
};
// edge_length: of the quads. Positions that are equal count as one vertex.
CreaseReport measure_creases(const SurfaceMesh& surface, double degrees, const SurfaceMesh& quads, double edge_length);

}  // namespace samples

#endif
