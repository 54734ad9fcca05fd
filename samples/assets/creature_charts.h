// UV charts of a creature's base mesh.
//
// Every triangle goes to the chart group of its nearest bone and to one side of that bone; connected triangles of one
// label are a chart. A chart starts as its projection along the group's axis, an artist's side view; the outline stays,
// the inside is spread by Tutte's embedding with mean value weights (Floater 2003), holes bridged by one extra vertex.
// Charts keep their relative size in metres and are packed into the unit square on shelves. Cost: O(150 x vertices).
#ifndef HF_SAMPLES_ASSETS_CREATURE_CHARTS_H
#define HF_SAMPLES_ASSETS_CREATURE_CHARTS_H

#include "creature_design.h"
#include "even_mesh.h"

namespace samples {

struct ChartMesh {
  TriangleMesh flat;              // points (u, v, 0); triangles parallel to the surface's
  std::vector<uint32_t> surface;  // surface vertex of each flat point
  uint32_t chart_count = 0;
};

ChartMesh make_charts(const Design& design, const TriangleMesh& mesh);

}  // namespace samples

#endif
