// Strokes and irregular vertices of an artist: lines over a surface that quads follow, and irregular vertices at chosen places.
#pragma once
#include <filesystem>

#include "hf/hf.hpp"

namespace samples {

// The guides of hf_quads_desc: one for every step of an edge along the strokes, at the nearest vertex.
struct Guides {
  std::vector<uint32_t> vertices;
  std::vector<double> vectors;  // three each
  std::vector<float> weights;
};

// Reads {"strokes": [{"points": [[x, y, z], ...], "weight": 1}]}: two points or more, in the frame of the surface; the
// weight is above 0 to 1, and 1 if there is none. edge: the mean length of an edge. Throws std::runtime_error with the
// file and the place in it.
Guides read_strokes(const std::filesystem::path& file, const hf::Surface& surface, double edge);

// The irregular vertices of hf_quads_desc.
struct IrregularVertices {
  std::vector<double> points;  // three each
  std::vector<uint32_t> valences;
  std::vector<double> directions;  // three each; 0 0 0: any
};

// Reads {"irregular": [{"point": [x, y, z], "valence": 3, "direction": [x, y, z]}]}: in the frame of the surface; the valence is 3
// or 5, and the direction may be missing. Throws std::runtime_error with the file and the place in it.
IrregularVertices read_irregular(const std::filesystem::path& file);

}  // namespace samples
