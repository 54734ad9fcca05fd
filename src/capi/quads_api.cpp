// Implements hf/quads.h: quad meshes and streamlines.
#include "capi/objects.h"
#include "capi/quads_out.h"
#include "field/scalars.h"
#include "hf/quads.h"
#include "quads/intake.h"
#include "remesh/intake.h"

namespace hf_inner::capi {
namespace {

struct QuadsObject final : Object {
  static constexpr Kind kind_of = Kind::quads;
  QuadsObject(std::shared_ptr<const surface::Core> shared, quads::QuadResult&& made, double length)
      : Object(kind_of, shared->memory), core(std::move(shared)), result(std::move(made)), edge_length(length) {}
  std::shared_ptr<const surface::Core> core;  // outlives the result, which lies in its memory
  quads::QuadResult result;
  double edge_length;
  quads::QuadKeeper kept;  // by updates
};

struct FlowObject final : Object {
  static constexpr Kind kind_of = Kind::flow;
  explicit FlowObject(std::shared_ptr<const surface::Core> core)
      : Object(kind_of, core->memory), tracer(std::move(core)) {}
  remesh::FlowTracer tracer;
};

hf_quads_info info_of(const QuadsObject& object) {
  const quads::QuadResult& result = object.result;
  hf_quads_info info{};
  info.vertex_count = static_cast<std::uint32_t>(result.mesh.position.size());
  info.face_count = static_cast<std::uint32_t>(result.mesh.face_count());
  info.euler_characteristic = result.euler_characteristic;
  info.edge_length = object.edge_length;
  return info;
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_quads_create(hf_surface handle, const hf_quads_desc* given, hf_quads* out_quads) {
  return create("hf_quads_create", out_quads, "out_quads", [&] {
    const std::shared_ptr<const surface::Core> core = unlinked_core(handle, "quads");
    const hf_quads_desc desc = read_optional(given, "desc");
    quads::QuadLists lists(*core->memory);
    const quads::FieldQuadOptions options = quads::read_field_quad_options(core, desc, lists);
    return with_progress(desc.progress, [&] {
      quads::FieldQuadReport report;
      quads::QuadResult result = quads::make_field_quads(options, &report);
      return make_owner_in<QuadsObject>(core->memory, core, std::move(result), report.edge_length * core->mesh.scale);
    });
  });
}

hf_result hf_quads_update(hf_quads handle, const hf_quads_desc* given) {
  return guarded("hf_quads_update", [&] {
    const auto object = get<QuadsObject>(handle, "quads");
    const hf_quads_desc desc = read_struct(given, "desc");
    const Changing changing(*object);
    const surface::Core& core = *object->core;
    quads::QuadLists lists(*core.memory);
    const quads::FieldQuadOptions options = quads::read_field_quad_options(object->core, desc, lists);
    with_progress(desc.progress, [&] {
      quads::FieldQuadReport report;
      object->result = quads::make_field_quads(options, &report, &object->kept);
      object->edge_length = report.edge_length * core.mesh.scale;
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
    out.vertex_count = info.vertex_count;
    out.face_count = info.face_count;
    write_struct(inout_mesh, out);
    check_capacity(out.positions || out.triangles || out.barycentrics || out.corners, out.vertex_capacity,
                   out.vertex_count, "vertex_capacity");
    check_capacity(out.faces, out.face_capacity, out.face_count, "face_capacity");
    write_mesh(*object->core, object->result, out);
  });
}

hf_result hf_flow_create(hf_surface surface, hf_flow* out_flow) {
  return create("hf_flow_create", out_flow, "out_flow", [&] {
    const std::shared_ptr<const surface::Core> core = unlinked_core(surface, "streamlines");
    return make_owner_in<FlowObject>(core->memory, core);
  });
}

void hf_flow_destroy(hf_flow flow) { destroy<FlowObject>(flow); }

hf_result hf_flow_trace(hf_flow handle, const hf_array* given, hf_streamlines* inout_lines) {
  return guarded("hf_flow_trace", [&] {
    const auto object = get<FlowObject>(handle, "flow");
    hf_streamlines out = read_struct(inout_lines, "inout_lines");
    require_zero(out.reserved);
    const Reading reading(*object);
    const surface::Core& core = object->tracer.core();
    const Vector<std::int32_t> seeds = remesh::read_seeds(core.mesh, out, *core.memory);
    const Vector<double> field = field::read_scalars(*core.geometry, given);
    field::require_values(core.mesh, field);
    const remesh::StreamlineSet lines = object->tracer.trace(field, out.wanted_count, seeds);
    out.point_count = static_cast<std::uint32_t>(lines.point.size());
    out.line_count = static_cast<std::uint32_t>(lines.from.size());
    write_struct(inout_lines, out);
    check_capacity(out.positions || out.values, out.point_capacity, out.point_count, "point_capacity");
    check_capacity(out.line_starts || out.line_ends, out.line_capacity, out.line_count, "line_capacity");
    write_lines(core.mesh, lines, out);
  });
}

}  // extern "C"
