#include "mesh/cut_intake.h"

#include <algorithm>

#include "base/arguments.h"
#include "base/progress.h"
#include "mesh/place_reader.h"

namespace hf_inner::mesh {
namespace {

// The narrowest new triangle has this share of the old one's height, so angles stay within a factor of about 20. Half
// gives slivers of 2.5 %; double moves lines by a tenth of an edge, which a viewer sees.
constexpr double default_snap_share = 0.05;
// A line of so many points takes 1 GB. Half and double bound less or more.
constexpr std::uint32_t default_crossing_limit = 1000000, most_crossings = 10000000;

}  // namespace

CutOptions read_cut_options(const hf_cut_desc& desc) {
  require_zero(desc.reserved);
  check_finite(desc.snap_share, "snap_share");
  if (desc.snap_share != 0 && !(desc.snap_share >= least_snap_share && desc.snap_share <= most_snap_share))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "snap_share is %g; it must be %g to %g, or 0 for %g", desc.snap_share,
         least_snap_share, most_snap_share, default_snap_share);
  CutOptions options;
  options.snap_share = desc.snap_share > 0 ? desc.snap_share : default_snap_share;
  options.most_points = desc.crossing_limit > 0 ? desc.crossing_limit : default_crossing_limit;
  return options;
}

Vector<CurvePoint> read_cut_points(const hf_cut_desc& desc, const Mesh& mesh, const Topology& topology,
                                   Memory& memory) {
  if (desc.point_count < 2)
    fail(HF_ERROR_EMPTY, desc.point_count, "point_count is %u; a line takes at least 2 points", desc.point_count);
  if (desc.point_count > most_crossings)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "point_count is %u; at most %u are taken", desc.point_count, most_crossings);
  const Places places(desc.point_count, desc.vertices, desc.places, desc.points);
  const PlaceReader reader(mesh, places, memory);
  Vector<CurvePoint> points(&memory);
  Poller poller;
  for (std::uint32_t i = 0; i < desc.point_count; ++i) {
    poller.due();
    const SurfacePlace place = reader.read(i);
    CurvePoint point;
    std::copy_n(place.vertex, 3, point.corner);
    std::copy_n(place.weight, 3, point.weight);
    if (!is_on_triangle(mesh, topology, point))
      fail(HF_ERROR_INVALID_ARGUMENT, i, "point %u lies between corners of no triangle; take corners of one triangle",
           i);
    const auto component = [&](const CurvePoint& one) { return mesh.component[at(nearest_corner(one))]; };
    if (i > 0 && component(point) != component(points.back()))
      fail(HF_ERROR_NOT_FOUND, i - 1,
           "the line leaves the surface between points %u and %u: they are in different "
           "components; end the line before, or link the parts after the cut",
           i - 1, i);
    points.push_back(point);
  }
  return points;
}

}  // namespace hf_inner::mesh
