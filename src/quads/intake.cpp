#include "quads/intake.h"

#include "base/arguments.h"
#include "remesh/intake.h"

namespace hf_inner {
namespace {

// Refuses mistakes; no result depends on it. hf/quads.h states it.
constexpr std::uint32_t most_wanted_faces = 10000000;
constexpr double most_crease = 180;  // degrees

}  // namespace

FieldQuadOptions read_field_quad_options(std::shared_ptr<const Core> core, const hf_quads_desc& desc) {
  if (desc.keep_polygons)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "keep_polygons is 1, but HF_QUADS_FIELD makes quads only");
  if (desc.site_count || desc.site_vertices || desc.site_lines)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "sites are given, but HF_QUADS_FIELD takes none");
  if (desc.face_count > most_wanted_faces)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "face_count is %u; it must be up to %u", desc.face_count,
         most_wanted_faces);
  const double crease = static_cast<double>(desc.crease_angle);
  if (crease < 0 || crease > most_crease)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "crease_angle is %g; it must be 0 to %g", crease, most_crease);
  FieldQuadOptions options;
  options.crease = crease;
  options.relax = read_relax_count(desc.relax_count);
  options.edge_length = read_edge_length(core->mesh, desc.edge_length);
  options.faces = static_cast<std::int32_t>(desc.face_count);
  options.core = std::move(core);
  return options;
}

}  // namespace hf_inner
