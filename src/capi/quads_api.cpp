// Implements hf/quads.h: quad meshes and flow lines.
#include <cmath>

#include "capi/boundary.h"
#include "capi/objects.h"
#include "capi/quads_out.h"
#include "capi/scalars.h"
#include "capi/vertex_lists.h"
#include "hf/quads.h"
#include "remesh/constants.h"

namespace hf_inner::capi {
namespace {

struct QuadsObject final : Object {
  static constexpr Kind kind_of = Kind::quads;
  QuadsObject(std::shared_ptr<const Core> shared, QuadResult&& made, double length)
      : Object(kind_of), core(std::move(shared)), result(std::move(made)), edge_length(length) {}
  std::shared_ptr<const Core> core;  // outlives the result, which lies in its memory
  QuadResult result;
  double edge_length;
};

struct FlowObject final : Object {
  static constexpr Kind kind_of = Kind::flow;
  explicit FlowObject(std::shared_ptr<const Core> core)
      : Object(kind_of), memory(core->memory), tracer(std::move(core)) {}
  std::shared_ptr<Memory> memory;  // outlives what follows
  FlowTracer tracer;
};

// Bounds of options, which hf/quads.h states. They refuse mistakes; no result depends on them.
constexpr std::uint32_t most_rounds = 1000, most_flow_lines = 1000000;
constexpr std::int32_t most_site_lines = 100000;
constexpr double least_length = 1e-4, most_length = 1.0;  // edge lengths, as shares of the box diagonal

// The edge length in box diagonals.
double read_edge_length(const Mesh& mesh, float given) {
  const double length = static_cast<double>(given);
  if (!std::isfinite(length)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "edge_length is not finite");
  if (length == 0) return default_edge_length;
  const double share = length / mesh.scale;
  if (share < least_length || share > most_length)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "edge_length is %g; on this mesh it must be %g to %g, or 0", length,
         least_length * mesh.scale, most_length * mesh.scale);
  return share;
}

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

// sites: what options.sites refers to.
QuadOptions read_options(std::shared_ptr<const Core> core, const hf_quads_desc& desc, Vector<FluxSite>& sites) {
  check_choice(desc.kind, 2, "kind");
  check_flag(desc.keep_polygons, "keep_polygons");
  if (desc.relax_count > most_rounds && desc.relax_count != HF_NO_INDEX)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "relax_count is %u; it must be up to %u, or HF_NO_INDEX",
         desc.relax_count, most_rounds);
  QuadOptions options;
  options.edge_length = read_edge_length(core->mesh, desc.edge_length);
  options.uniform = desc.kind == HF_QUADS_UNIFORM, options.split = desc.keep_polygons == 0;
  if (desc.relax_count)
    options.relax = desc.relax_count == HF_NO_INDEX ? 0 : static_cast<std::int32_t>(desc.relax_count);
  read_sites(*core, desc, sites);
  options.sites = sites, options.automatic = sites.empty(), options.scale_lines = !desc.site_lines;
  options.core = std::move(core);
  return options;
}

hf_quads_info info_of(const QuadsObject& object) {
  const QuadResult& result = object.result;
  hf_quads_info info{};
  info.vertex_count = static_cast<std::uint32_t>(result.mesh.position.size());
  info.face_count = static_cast<std::uint32_t>(result.mesh.face_count());
  info.corner_count = static_cast<std::uint32_t>(result.mesh.corner.size());
  info.quad_count = static_cast<std::uint32_t>(result.mesh.quad_count());
  info.polygon_count = static_cast<std::uint32_t>(result.raw_faces);
  info.polygon_quad_count = static_cast<std::uint32_t>(result.raw_quads);
  info.site_count = static_cast<std::uint32_t>(result.sites.size());
  info.saddle_count = static_cast<std::uint32_t>(result.saddles);
  info.euler_characteristic = result.euler_characteristic;
  info.edge_length = static_cast<float>(object.edge_length);
  return info;
}

void check_flow_counts(const hf_flow_lines& lines) {
  if (lines.seed_count > most_flow_lines)
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "seed_count is %u; it must be up to %u", lines.seed_count,
         most_flow_lines);
  if (lines.seed_count == 0 && (lines.wanted_count < 1 || lines.wanted_count > most_flow_lines))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "wanted_count is %u; it must be 1 to %u", lines.wanted_count,
         most_flow_lines);
}

void check_values(const Mesh& mesh, Span<const double> field) {
  for (std::size_t v = 0; v < field.size(); ++v) {
    const std::uint32_t given = given_vertex(mesh, static_cast<std::int32_t>(v));
    if (std::isnan(field[v])) fail(HF_ERROR_NON_FINITE, given, "the value of vertex %u is NaN", given);
  }
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_quads_create(hf_surface handle, const hf_quads_desc* given, hf_quads* out_quads) {
  return create("hf_quads_create", out_quads, "out_quads", [&] {
    const std::shared_ptr<const Core> core = unlinked_core(handle, "quads");
    const hf_quads_desc desc = read_optional(given, "desc");
    Vector<FluxSite> sites(core->memory.get());
    QuadOptions options = read_options(core, desc, sites);
    return with_progress(desc.progress, [&] {
      return make_owner_in<QuadsObject>(core->memory, core, make_quads(options),
                                        options.edge_length * core->mesh.scale);
    });
  });
}

void hf_quads_destroy(hf_quads quads) { destroy<QuadsObject>(quads); }

hf_result hf_quads_get_info(hf_quads quads, hf_quads_info* out_info) {
  return guarded("hf_quads_get_info", [&] {
    const auto object = get<QuadsObject>(quads, "quads");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    write_struct(out_info, info_of(*object));
  });
}

hf_result hf_quads_get_mesh(hf_quads handle, hf_quads_mesh* inout_mesh) {
  return guarded("hf_quads_get_mesh", [&] {
    const auto object = get<QuadsObject>(handle, "quads");
    hf_quads_mesh out = read_struct(inout_mesh, "inout_mesh");
    require_zero(out.reserved);
    const Reading reading(*object);
    const hf_quads_info info = info_of(*object);
    out.vertex_count = info.vertex_count, out.face_count = info.face_count, out.corner_count = info.corner_count;
    out.site_count = info.site_count;
    write_struct(inout_mesh, out);
    check_capacity(out.positions || out.triangles || out.barycentrics || out.corners, out.vertex_capacity,
                   out.vertex_count, "vertex_capacity");
    check_capacity(out.face_starts, out.face_capacity, out.face_count, "face_capacity");
    check_capacity(out.face_corners, out.corner_capacity, out.corner_count, "corner_capacity");
    check_capacity(out.site_vertices || out.site_lines, out.site_capacity, out.site_count, "site_capacity");
    write_mesh(*object->core, object->result, out);
  });
}

hf_result hf_flow_create(hf_surface surface, hf_flow* out_flow) {
  return create("hf_flow_create", out_flow, "out_flow", [&] {
    const std::shared_ptr<const Core> core = unlinked_core(surface, "flow lines");
    return make_owner_in<FlowObject>(core->memory, core);
  });
}

void hf_flow_destroy(hf_flow flow) { destroy<FlowObject>(flow); }

hf_result hf_flow_trace(hf_flow handle, const hf_scalars* given, hf_flow_lines* inout_lines) {
  return guarded("hf_flow_trace", [&] {
    const auto object = get<FlowObject>(handle, "flow");
    hf_flow_lines out = read_struct(inout_lines, "inout_lines");
    require_zero(out.reserved);
    check_flow_counts(out);
    const Reading reading(*object);
    const Core& core = object->tracer.core();
    const Mesh& mesh = core.mesh;
    Vector<std::int32_t> seeds(core.memory.get());
    if (out.seed_count) {
      require(out.seeds, "inout_lines->seeds");
      append_usable(mesh, out.seed_count, out.seeds, "seeds", seeds);
    }
    const Vector<double> field = read_scalars(*core.geometry, given);
    check_values(mesh, field);
    const FlowLineSet lines = object->tracer.trace(field, out.wanted_count, seeds);
    if (lines.point.size() >= HF_NO_INDEX) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the lines have 2^32 points or more");
    out.point_count = static_cast<std::uint32_t>(lines.point.size());
    out.line_count = static_cast<std::uint32_t>(lines.from.size());
    write_struct(inout_lines, out);
    check_capacity(out.positions || out.values, out.point_capacity, out.point_count, "point_capacity");
    check_capacity(out.line_starts || out.line_ends, out.line_capacity, out.line_count, "line_capacity");
    write_lines(mesh, lines, out);
  });
}

}  // extern "C"
