// Pictures of a region: the surface with its curve and rim, and the results of the morph.
#ifndef HF_SAMPLES_DETAIL_DETAIL_SHEET_H
#define HF_SAMPLES_DETAIL_DETAIL_SHEET_H

#include <string>
#include <vector>

#include "common/picture.h"

namespace samples {

struct SheetTile {
  std::string label;
  std::vector<float> positions;
};

// Settings that all tiles share. The camera shows the region and a margin round it.
struct SheetScene {
  std::vector<uint32_t> triangles;
  std::vector<float> surface;    // positions before any morph
  std::vector<uint32_t> inside;  // drawn in colour
  std::vector<uint32_t> points;  // of the curve, as dots on the first tile; may be empty
  std::vector<double> curve;     // its corners, drawn as a closed line; may be empty
  double zoom = 1.45;            // size of the page over the size of the region
};

void write_sheet(const std::string& file, const SheetScene& scene, const std::vector<SheetTile>& tiles,
                 const std::string& title);

}  // namespace samples

#endif
