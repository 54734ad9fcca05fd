#include "detail/intake.h"

#include <algorithm>

#include "base/arguments.h"
#include "mesh/place_reader.h"
#include "mesh/vertex_lists.h"
#include "surface/surface_intake.h"

namespace hf_inner::detail {
namespace {

// A closed curve has an inside from this many points on.
constexpr std::uint32_t least_points = 3;

}  // namespace

RegionOptions read_region_options(const hf_region_desc& desc, std::size_t vertex_count) {
  check_choice(desc.base, 4, "base");
  const mesh::FieldKind kind = desc.base == HF_BASE_MEMBRANE           ? mesh::FieldKind::harmonic
                               : desc.base == HF_BASE_THIN_PLATE_GRAPH ? mesh::FieldKind::biharmonic_graph
                                                                       : mesh::FieldKind::biharmonic;
  return {kind, read_reals(desc.positions, 3, vertex_count, "vertices", "positions")};
}

double read_morph_weight(const hf_morph_desc& desc) {
  require_zero(desc.reserved);
  check_finite(desc.weight, "weight");
  return desc.weight;
}

void read_curve(const surface::Core& core, const hf_curve_desc& curve, RegionEditInput& input) {
  const mesh::Mesh& mesh = core.geometry->unlinked().mesh;
  RegionEdit& edit = input.edit;
  check_choice(curve.side, 3, "side");
  check_choice(curve.kind, 2, "kind");
  require_zero(curve.reserved);
  const mesh::Places places(curve.point_count, curve.vertices, curve.places, curve.points);
  if (curve.point_count < least_points)
    fail(HF_ERROR_EMPTY, curve.point_count, "a closed curve takes %u points or more; %u are given", least_points,
         curve.point_count);
  mesh::check_vertex_count(mesh, curve.point_count, "point_count");
  edit.kind = static_cast<CurveKind>(curve.kind);
  const mesh::PlaceReader reader(mesh, places, *core.memory);
  for (std::uint32_t i = 0; i < curve.point_count; ++i) {
    const mesh::SurfacePlace place = reader.read(i);
    mesh::CurvePoint point;
    std::copy_n(place.vertex, 3, point.corner);
    std::copy_n(place.weight, 3, point.weight);
    if (edit.kind == CurveKind::straight && !mesh::is_on_triangle(mesh, core.geometry->unlinked().topology(), point))
      fail(HF_ERROR_INVALID_ARGUMENT, i,
           "point %u lies between corners of no triangle; take one of them, or join the points along edges "
           "(HF_CURVE_EDGES)",
           i);
    input.points.push_back(point);
  }
  mesh::require_one_component(mesh, input.points);
  edit.curve = input.points;
  edit.side = static_cast<CurveSide>(curve.side);
  if (edit.side == CurveSide::seed)
    edit.seed = mesh::usable_vertex(mesh, curve.seed_vertex, curve.seed_vertex, "seed_vertex");
}

void read_region_lists(const surface::Core& core, const hf_region_edit_desc& desc, RegionEditInput& input) {
  if (desc.remove_count)
    mesh::read_list(core.mesh, desc.remove_count, desc.remove_vertices, "remove_vertices", "remove_vertices",
                    input.remove);
  if (desc.add_count)
    mesh::read_list(core.mesh, desc.add_count, desc.add_vertices, "add_vertices", "add_vertices", input.add);
  input.edit.rings = desc.ring_count;
  input.edit.remove = input.remove;
  input.edit.add = input.add;
}

CarryInput read_carry(const Region& source, const Region& target, const hf_detail_desc& desc) {
  check_finite(desc.scale, "scale");
  if (desc.scale < 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "scale is %g; it must be above 0, or 0", desc.scale);
  CarryInput input(*target.core().memory);
  input.scale = desc.scale;
  if (desc.pair_count == 0) return input;
  mesh::read_list(source.core().mesh, desc.pair_count, desc.source_vertices, "pair_count", "source_vertices",
                  input.source_pins);
  mesh::read_list(target.core().mesh, desc.pair_count, desc.target_vertices, "pair_count", "target_vertices",
                  input.target_pins);
  return input;
}

}  // namespace hf_inner::detail
