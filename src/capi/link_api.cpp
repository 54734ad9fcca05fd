// Implements the links of hf/surface.h.
#include <algorithm>
#include <cmath>

#include "capi/links_in.h"
#include "capi/objects.h"
#include "capi/vertex_lists.h"

namespace hf_inner::capi {
namespace {

constexpr std::uint32_t most_skin_joints = 64;
// Barycentrics are scaled to sum 1 if they are this near to it.
constexpr double barycentric_slack = 1e-3;

double length_of(float given, double standard, const Mesh& mesh, const char* name) {
  const double length = static_cast<double>(given);
  if (!std::isfinite(length)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "%s is not finite", name);
  return length == 0 ? standard : length / mesh.scale;
}

Link read_link(const hf_link& given, const Mesh& mesh, std::uint32_t i) {
  Link link;
  link.vertex = usable_vertex(mesh, given.vertex, i);
  link.weight = static_cast<double>(given.weight);
  if (!std::isfinite(link.weight)) fail(HF_ERROR_NON_FINITE, i, "the weight of link %u is not finite", i);
  if (!(link.weight > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, i, "the weight of link %u is %g; it must be above 0", i, link.weight);
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = given.barycentrics[k];
    if (!std::isfinite(share)) fail(HF_ERROR_NON_FINITE, i, "a barycentric of link %u is not finite", i);
    if (share < 0)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "a barycentric of link %u is %g; it must not be negative", i, share);
    sum += share;
  }
  if (!(std::fabs(sum - 1) <= barycentric_slack))
    fail(HF_ERROR_INVALID_ARGUMENT, i, "the barycentrics of link %u have the sum %g; it must be 1", i, sum);
  for (std::size_t k = 0; k < 3; ++k) {
    if (given.barycentrics[k] == 0) continue;
    link.share[k] = sum == 1 ? given.barycentrics[k] : given.barycentrics[k] / sum;
    link.corner[k] = usable_vertex(mesh, given.corners[k], i);
    if (link.corner[k] == link.vertex)
      fail(HF_ERROR_INVALID_ARGUMENT, i, "link %u joins vertex %u to itself", i, given.vertex);
  }
  return link;
}

void read_skin(const hf_links_desc& desc, const Mesh& mesh, SkinHint& out) {
  if (desc.influence_count == 0) {
    if (desc.joints || desc.weights)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "joints or weights are set, but influence_count is 0");
    return;
  }
  count_of(desc.influence_count, 0, 1, most_skin_joints, "influence_count");
  require(desc.joints, "joints"), require(desc.weights, "weights");
  for (std::uint32_t v = 0; v < mesh.report.vertex_count; ++v) {
    for (std::size_t i = 0; i < desc.influence_count; ++i) {
      const float w = desc.weights[std::size_t{v} * desc.influence_count + i];
      if (!std::isfinite(w)) fail(HF_ERROR_NON_FINITE, v, "a weight of vertex %u is not finite", v);
    }
  }
  out = {desc.influence_count, desc.joints, desc.weights};
}

void read_pieces(const Mesh& mesh, std::uint32_t count, const std::uint32_t* vertices, const char* count_name,
                 const char* name, Vector<std::int32_t>& out) {
  if (count > 0) read_list(mesh, count, vertices, count_name, name, out);
}

}  // namespace

void read_links(const hf_links_desc* given, const Mesh& mesh, LinksIn& out) {
  if (!given) return;
  const hf_links_desc desc = read_struct(given, "links");
  check_choice(desc.mode, 3, "mode");
  require_zero(desc.reserved);
  LinkOptions& options = out.options;
  options.mode = static_cast<LinkMode>(desc.mode);
  options.distance = length_of(desc.distance, default_link_distance, mesh, "distance");
  options.overlay = length_of(desc.overlay_distance, default_overlay, mesh, "overlay_distance");
  options.stiffness = desc.stiffness == 0 ? 1.0 : static_cast<double>(desc.stiffness);
  if (options.distance < 0) fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "distance is below 0");
  if (!std::isfinite(options.stiffness)) fail(HF_ERROR_NON_FINITE, HF_NO_INDEX, "stiffness is not finite");
  if (!(options.stiffness > 0))
    fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "stiffness is %g; it must be above 0", options.stiffness);
  read_skin(desc, mesh, options.skin);
  if (desc.tags) options.tags = {desc.tags, mesh.report.vertex_count};
  read_pieces(mesh, desc.light_count, desc.light_vertices, "light_count", "light_vertices", out.light);
  read_pieces(mesh, desc.heavy_count, desc.heavy_vertices, "heavy_count", "heavy_vertices", out.heavy);
  options.light = out.light, options.heavy = out.heavy;
  if (options.mode != LinkMode::list) {
    if (desc.link_count > 0)
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "link_count is %u, but mode is not HF_LINK_LIST", desc.link_count);
    return;
  }
  if (desc.link_count > 0) require(desc.links, "links->links");
  for (std::uint32_t i = 0; i < desc.link_count; ++i) out.list.push_back(read_link(desc.links[i], mesh, i));
  options.list = out.list;
}

namespace {

hf_link written(const Link& link, const Mesh& mesh) noexcept {
  hf_link out{};
  out.vertex = given_vertex(mesh, link.vertex);
  for (std::size_t k = 0; k < 3; ++k)
    out.corners[k] = given_vertex(mesh, link.corner[k]), out.barycentrics[k] = link.share[k];
  out.length = mesh.scale * link.length, out.weight = static_cast<float>(link.weight), out.in_tree = link.tree;
  return out;
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_surface_get_links(hf_surface surface, uint32_t capacity, hf_link* out_links, uint32_t* out_count) {
  return guarded("hf_surface_get_links", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_links, out_count, "out_links and out_count");
    const Geometry& shape = object->surface.geometry();
    const std::size_t count = shape.links ? shape.links->links.size() : 0;
    write_count(out_count, count);
    check_capacity(out_links, capacity, count, "capacity");
    for (std::size_t i = 0; out_links && i < count; ++i) out_links[i] = written(shape.links->links[i], shape.mesh);
  });
}

hf_result hf_surface_get_pieces(hf_surface surface, uint32_t capacity, uint32_t* out_pieces, int32_t* out_light,
                                uint32_t* out_count) {
  return guarded("hf_surface_get_pieces", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    if (!out_pieces && !out_light) require(out_count, "out_pieces, out_light and out_count");
    const Geometry& shape = object->surface.geometry();
    const Mesh& mesh = shape.unlinked().mesh;
    write_count(out_count, mesh.report.vertex_count);
    check_capacity(out_pieces || out_light, capacity, mesh.report.vertex_count, "capacity");
    for (std::uint32_t v = 0; (out_pieces || out_light) && v < mesh.report.vertex_count; ++v) {
      const std::int32_t inner = mesh.inner_of_given[v];
      const std::int32_t piece = inner == Mesh::none ? Mesh::none : mesh.component[at(inner)];
      if (out_pieces) out_pieces[v] = piece == Mesh::none ? HF_NO_INDEX : static_cast<std::uint32_t>(piece);
      if (out_light) out_light[v] = piece != Mesh::none && shape.links && shape.links->light[at(piece)];
    }
  });
}

hf_result hf_surface_measure_gaps(hf_surface surface, const hf_gaps_desc* given, uint32_t capacity, double* out_gaps,
                                  hf_gaps_info* out_info) {
  return guarded("hf_surface_measure_gaps", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    const hf_gaps_desc desc = read_struct(given, "desc");
    require_either(out_gaps, out_info, "out_gaps and out_info");
    if (out_info) check_struct(out_info, "out_info");
    check_one(desc.positions, desc.positions_f64, "positions");
    require_either(desc.positions, desc.positions_f64, "positions and positions_f64");
    const ConstRows posed = rows_of(desc.positions, desc.positions_f64, 3, desc.position_stride, "position_stride");
    const Geometry& shape = object->surface.geometry();
    const std::size_t count = shape.links ? shape.links->links.size() : 0;
    hf_gaps_info info{};
    info.link_count = static_cast<std::uint32_t>(count), info.worst_link = HF_NO_INDEX;
    if (out_gaps && capacity < count && out_info) write_struct(out_info, info);
    check_capacity(out_gaps, capacity, count, "capacity");
    Vector<double> gaps(count, 0.0, object->memory.get());
    if (count > 0) measure_gaps(shape.mesh, *shape.links, posed, gaps);
    if (out_gaps) std::copy(gaps.begin(), gaps.end(), out_gaps);
    if (count > 0) {
      const auto worst = std::max_element(gaps.begin(), gaps.end());
      info.worst = *worst, info.worst_link = static_cast<std::uint32_t>(worst - gaps.begin());
      const auto share = gaps.begin() + static_cast<std::ptrdiff_t>((95 * count + 99) / 100 - 1);
      std::nth_element(gaps.begin(), share, gaps.end());
      info.percentile_95 = *share;
    }
    if (out_info) write_struct(out_info, info);
  });
}

hf_result hf_surface_relink(hf_surface handle, const hf_links_desc* links, hf_progress progress,
                            hf_surface* out_surface) {
  return create("hf_surface_relink", out_surface, "out_surface", [&] {
    const auto object = mesh_surface(handle, "links");
    const Surface& old = object->surface;
    return with_progress(progress, [&] {
      const Geometry& shape = old.geometry();
      std::shared_ptr<const Geometry> plain = shape.plain ? shape.plain : old.own().geometry;
      LinksIn in(object->memory.get());
      read_links(links, plain->mesh, in);
      CoreOptions options;
      options.operator_kind = plain->operator_kind, options.field_kind = old.field_kind();
      options.ordering = old.own().ordering, options.flop_limit = old.own().flop_limit, options.like = &old.own();
      auto geometry = Geometry::linked(std::move(plain), in.options);
      return make_owner_in<SurfaceObject>(object->memory, std::move(geometry), options, object->info);
    });
  });
}

}  // extern "C"
