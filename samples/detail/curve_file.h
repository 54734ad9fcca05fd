// A closed curve from a JSON file:
//   {"points": [{"near": [0.1, 1.2, 0.3]}, {"vertex": 80}, ...], "side": "smaller" | "larger", "seed": 7, "grow": 2,
//    "edges": true}
// or all points as {"triangle": 5, "barycentrics": [0.2, 0.3, 0.5]}. near: the vertex nearest to that point.
#ifndef HF_SAMPLES_DETAIL_CURVE_FILE_H
#define HF_SAMPLES_DETAIL_CURVE_FILE_H

#include <filesystem>
#include <string>
#include <vector>

#include "common/mesh_file.h"
#include "hf/hf.hpp"

namespace samples {

struct CurveFile {
  std::vector<uint32_t> vertices;
  std::vector<hf_place> places;  // instead of vertices
  int32_t side = HF_SIDE_SMALLER;
  uint32_t seed = 0;
  int32_t grow = 0;
  bool edges = false;  // else the points are joined straight through triangles
};

// Throws std::runtime_error naming file and place.
CurveFile read_curve_file(const std::filesystem::path& file, const SurfaceMesh& mesh);

// Returns the region that the curve encloses, with `grow` more rings.
void enclose(hf::Region& region, const CurveFile& curve, int32_t grow);

}  // namespace samples

#endif
