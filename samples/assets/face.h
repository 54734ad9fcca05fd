// Two heads of different form and mesh with the same 52 face shapes, for the transfer of morph targets.
//
// A head is a grid over azimuth and elevation with a nose, a jaw, an open neck and crown, and two slit eyes. The lids
// of an eye are two rows of vertices. Shapes 0 and 1 close one eye each, by the upper lid alone; the others move the
// skin about 25 places, outwards or along the face. The second head is the first one bent and stretched, so each of its
// shapes is known exactly. Deterministic: the same arguments give the same bits.
#ifndef HF_SAMPLES_ASSETS_FACE_H
#define HF_SAMPLES_ASSETS_FACE_H

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "assets/shapes.h"

namespace samples {

// The vertices of one place that an artist would mark on every head.
struct FaceMark {
  std::string name;
  std::vector<uint32_t> vertices;
};

struct Face {
  ShapeMesh mesh;                                   // at rest, eyes open
  std::vector<std::pair<uint32_t, uint32_t>> lids;  // vertices of the upper and the lower lid above one another
  std::vector<double> lid_azimuth;                  // of each; positive: the left eye
  std::vector<std::string> shape_names;
  std::vector<std::vector<double>> shapes;  // xyz of all vertices in each shape
  std::vector<FaceMark> marks;              // 17, in the same order on every head
};

// columns: vertices around the head; rows: from neck to crown. At least 40 and 30.
Face make_face(uint32_t columns, uint32_t rows, bool second_head);

}  // namespace samples

#endif
