// Figures of a quad mesh, as hf_quads prints them.
#ifndef HF_SAMPLES_QUADS_QUAD_REPORT_H
#define HF_SAMPLES_QUADS_QUAD_REPORT_H

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/mesh_file.h"

namespace samples {

struct QuadReport {
  uint32_t vertices = 0, edges = 0, faces = 0, quads = 0;
  uint32_t turned_over = 0;  // corners of quads that face away from the mean normal of their quad
  int euler_characteristic = 0;
  bool each_directed_edge_once = true, no_repeated_corner = true;
  uint32_t irregular = 0;                 // inner vertices of not 4 faces, border vertices of not 2
  std::map<uint32_t, uint32_t> valences;  // faces around a vertex: how many vertices have so many
  // 5th, 50th and 95th percentiles of three figures: edge length over the wanted length, longest over shortest edge of
  // a quad, and degrees by which a corner of a quad differs from 90.
  double edge[3] = {0, 0, 0}, aspect[3] = {0, 0, 0}, angle[3] = {0, 0, 0};
};

QuadReport measure_quads(const SurfaceMesh& mesh, double edge_length);
std::string to_text(const std::map<uint32_t, uint32_t>& histogram);

}  // namespace samples

#endif
