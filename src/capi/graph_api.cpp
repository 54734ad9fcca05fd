// Implements hf_surface_create_graph of hf/surface.h.
#include "capi/boundary.h"
#include "capi/surface_options.h"

namespace hf_inner::capi {
namespace {

// Most edges per vertex of the vertex limit without an edge_limit. Tetrahedra have 7, neighbours of points 5 to 10.
constexpr std::uint32_t edges_per_vertex = 16;

// The options of the graph as those of a surface.
hf_surface_desc surface_desc_of(const hf_graph_desc& desc) {
  hf_surface_desc out{};
  out.vertex_count = desc.vertex_count, out.weld = HF_WELD_NONE;
  out.field_kind = desc.field_kind, out.ordering = desc.ordering, out.thread_count = desc.thread_count;
  out.vertex_limit = desc.vertex_limit, out.memory_limit_mb = desc.memory_limit_mb;
  out.work_limit_gflop = desc.work_limit_gflop, out.reserved = desc.reserved;
  out.allocator = desc.allocator, out.job_runner = desc.job_runner, out.progress = desc.progress;
  out.saved_factor = desc.saved_factor;
  return out;
}

GraphInput read_graph(const hf_graph_desc& desc) {
  check_flag(desc.allow_negative, "allow_negative");
  if (desc.edge_count > 0) require(desc.edges, "edges"), require(desc.weights, "weights");
  GraphInput input;
  input.vertex_count = desc.vertex_count, input.edge_count = desc.edge_count;
  input.edges = desc.edges, input.weights = desc.weights, input.masses = desc.masses;
  input.allow_negative = desc.allow_negative == 1;
  return input;
}

void check_limits(const hf_surface_info& info) {
  if (info.vertex_count > info.vertex_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u vertices; the vertex_limit is %u", info.vertex_count, info.vertex_limit);
  if (info.edge_limit != 0 && info.edge_count > info.edge_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%u edges; the edge_limit is %u", info.edge_count, info.edge_limit);
  if (info.edge_limit == 0 && info.edge_count / edges_per_vertex > info.vertex_limit)
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "%u edges; without an edge_limit at most sixteen per vertex of the vertex_limit %u are taken", info.edge_count,
         info.vertex_limit);
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_create_graph(const hf_graph_desc* given, hf_surface* out_surface) {
  return create("hf_surface_create_graph", out_surface, "out_surface", [&] {
    const hf_graph_desc desc = read_struct(given, "desc");
    const hf_surface_desc common = surface_desc_of(desc);
    hf_surface_info info = read_info(common);
    info.operator_kind = HF_OPERATOR_GRAPH, info.edge_count = desc.edge_count, info.edge_limit = desc.edge_limit;
    check_limits(info);
    const GraphInput input = read_graph(desc);
    return make_surface(common, info, [&](const std::shared_ptr<Memory>& memory, std::shared_ptr<JobRunner> jobs) {
      return Geometry::make(input, memory, std::move(jobs));
    });
  });
}

}  // extern "C"
