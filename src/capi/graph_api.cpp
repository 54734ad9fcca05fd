// Implements hf_surface_create_graph of hf/surface.h.
#include "capi/surface_options.h"

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_create_graph(const hf_graph_desc* given, hf_surface* out_surface) {
  return create("hf_surface_create_graph", out_surface, "out_surface", [&] {
    const hf_graph_desc desc = read_struct(given, "desc");
    const hf_surface_desc common = surface::options_of(desc);
    hf_surface_info info = surface::read_info(common);
    info.operator_kind = HF_OPERATOR_GRAPH;
    info.edge_count = desc.edges.count;
    info.edge_limit = desc.edge_limit;
    surface::check_graph_limits(info);
    const mesh::GraphInput input = mesh::read_graph(desc);
    return make_surface(common, info, [&](const std::shared_ptr<Memory>& memory, std::shared_ptr<JobRunner> jobs) {
      return surface::Geometry::make(input, memory, std::move(jobs));
    });
  });
}

}  // extern "C"
