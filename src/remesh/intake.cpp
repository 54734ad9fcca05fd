#include "remesh/intake.h"

#include <algorithm>

#include "base/arguments.h"
#include "mesh/vertex_lists.h"
#include "remesh/constants.h"

namespace hf_inner {
namespace {

void read_sites(const Core& core, const hf_quads_desc& desc, Vector<FluxSite>& sites) {
  if (desc.site_count == 0) {
    if (desc.site_vertices || desc.site_lines)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "site_count is 0, but arrays of sites are given");
    return;
  }
  Vector<std::int32_t> inner(core.memory.get());
  read_list(core.mesh, desc.site_count, desc.site_vertices, "site_count", "site_vertices", inner);
  Vector<std::uint8_t> taken(static_cast<std::size_t>(core.size()), std::uint8_t{0}, core.memory.get());
  for (std::uint32_t i = 0; i < desc.site_count; ++i) {
    if (taken[static_cast<std::size_t>(inner[i])]++)
      fail(HF_ERROR_DUPLICATE_SITE, i, "entry %u of site_vertices: vertex %u is named twice", i, desc.site_vertices[i]);
    const std::int32_t lines = desc.site_lines ? desc.site_lines[i] : 0;
    if (desc.site_lines && (lines == 0 || lines > most_site_lines || lines < -most_site_lines))
      fail(HF_ERROR_INVALID_ARGUMENT, i, "site_lines[%u] is %d; it must be -%d to %d and not 0", i, lines,
           most_site_lines, most_site_lines);
    sites.push_back({inner[i], static_cast<double>(lines)});
  }
}

}  // namespace

double read_edge_length(const Mesh& mesh, float given) {
  const double length = static_cast<double>(given);
  check_finite(length, "edge_length");
  if (length == 0) return default_edge_length;
  const double share = length / mesh.scale;
  if (share < least_edge_length || share > most_edge_length)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "edge_length is %g; on this mesh it must be %g to %g, or 0", length,
         least_edge_length * mesh.scale, most_edge_length * mesh.scale);
  return share;
}

std::int32_t read_relax_count(std::uint32_t given) {
  if (given > most_relax_count && given != HF_NO_INDEX)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "relax_count is %u; it must be up to %u, or HF_NO_INDEX", given,
         most_relax_count);
  return given == 0 ? default_relax_rounds : given == HF_NO_INDEX ? 0 : static_cast<std::int32_t>(given);
}

void check_quad_options(const hf_quads_desc& desc) {
  check_choice(desc.kind, 3, "kind");
  check_flag(desc.keep_polygons, "keep_polygons");
  check_finite(static_cast<double>(desc.crease_angle), "crease_angle");
}

QuadOptions read_quad_options(std::shared_ptr<const Core> core, const hf_quads_desc& desc, Vector<FluxSite>& sites) {
  if (desc.face_count)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "face_count is %u; only the kind HF_QUADS_FIELD takes it",
         desc.face_count);
  if (desc.crease_angle != 0)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "crease_angle is %g; only the kind HF_QUADS_FIELD takes it",
         static_cast<double>(desc.crease_angle));
  if (desc.crease_count || desc.guide_count || desc.crease_edges || desc.guide_vertices || desc.guide_vectors ||
      desc.guide_weights || std::any_of(desc.symmetry_plane, desc.symmetry_plane + 4, [](double d) { return d != 0; }))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX,
         "crease edges, guides or a symmetry_plane are given; only the kind HF_QUADS_FIELD takes them");
  QuadOptions options;
  options.relax = read_relax_count(desc.relax_count);
  options.edge_length = read_edge_length(core->mesh, desc.edge_length);
  options.uniform = desc.kind == HF_QUADS_UNIFORM, options.split = desc.keep_polygons == 0;
  read_sites(*core, desc, sites);
  options.sites = sites, options.automatic = sites.empty(), options.scale_lines = !desc.site_lines;
  options.core = std::move(core);
  return options;
}

Vector<std::int32_t> read_seeds(const Mesh& mesh, const hf_flow_lines& lines, Memory& memory) {
  if (lines.seed_count > most_flow_lines)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "seed_count is %u; it must be up to %u", lines.seed_count,
         most_flow_lines);
  if (lines.seed_count == 0 && (lines.wanted_count < 1 || lines.wanted_count > most_flow_lines))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "wanted_count is %u; it must be 1 to %u", lines.wanted_count,
         most_flow_lines);
  Vector<std::int32_t> seeds(&memory);
  if (lines.seed_count) {
    require(lines.seeds, "inout_lines->seeds");
    append_usable(mesh, lines.seed_count, lines.seeds, "seeds", seeds);
  }
  return seeds;
}

}  // namespace hf_inner
