// Implements the links of hf/surface.h.
#include <algorithm>

#include "capi/objects.h"
#include "mesh/link_intake.h"
#include "mesh/touching.h"
#include "surface/surface_intake.h"

namespace hf_inner::capi {
namespace {

hf_link written(const mesh::Link& link, const mesh::Mesh& mesh) noexcept {
  hf_link out{};
  out.vertex = mesh::given_vertex(mesh, link.vertex);
  for (std::size_t k = 0; k < 3; ++k) {
    out.corners[k] = mesh::given_vertex(mesh, link.corner[k]);
    out.barycentrics[k] = link.share[k];
  }
  out.length = mesh.scale * link.length;
  out.weight = link.weight;
  out.in_tree = link.tree;
  return out;
}

void measure_contacts(const mesh::Mesh& mesh, Span<const mesh::Link> contacts, const ConstRows& posed, Memory& memory,
                      hf_gaps_info& info) {
  Vector<double> gaps(contacts.size(), 0.0, &memory);
  mesh::measure_gaps(mesh, contacts, posed, gaps);
  const mesh::GapSummary found = mesh::summarise_gaps(gaps);
  info.contact_count = static_cast<std::uint32_t>(contacts.size());
  info.worst_contact = found.worst;
  info.contact_vertex = mesh::given_vertex(mesh, contacts[found.worst_link].vertex);
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
    const surface::Geometry& shape = object->surface.geometry();
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
    const surface::Geometry& shape = object->surface.geometry();
    const mesh::Mesh& mesh = shape.unlinked().mesh;
    write_count(out_count, mesh.report.vertex_count);
    check_capacity(out_pieces || out_light, capacity, mesh.report.vertex_count, "capacity");
    if (!out_pieces && !out_light) return;
    mesh::visit_given(mesh, [&](std::size_t v, std::int32_t inner) {
      const std::uint32_t piece = mesh::component_of(mesh, inner);
      if (out_pieces) out_pieces[v] = piece;
      if (out_light) out_light[v] = piece != HF_NO_INDEX && shape.links && shape.links->light[piece];
    });
  });
}

hf_result hf_surface_measure_gaps(hf_surface surface, const hf_array* positions, uint32_t capacity, double* out_gaps,
                                  hf_gaps_info* out_info) {
  return guarded("hf_surface_measure_gaps", [&] {
    const auto object = get<SurfaceObject>(surface, "surface");
    require_either(out_gaps, out_info, "out_gaps and out_info");
    if (out_info) check_struct(out_info, "out_info");
    const surface::Geometry& shape = object->surface.geometry();
    const ConstRows posed = need_reals(positions, 3, shape.mesh.report.vertex_count, "vertices", "positions");
    const std::size_t count = shape.links ? shape.links->links.size() : 0;
    hf_gaps_info info{};
    info.link_count = static_cast<std::uint32_t>(count);
    info.worst_link = info.contact_vertex = info.opening_vertex = HF_NO_INDEX;
    if (out_gaps && capacity < count && out_info) write_struct(out_info, info);
    check_capacity(out_gaps, capacity, count, "capacity");
    Vector<double> gaps(count, 0.0, object->memory.get());
    if (count > 0) mesh::measure_gaps(shape.mesh, shape.links->links, posed, gaps);
    if (shape.links && !shape.links->open.empty())
      measure_contacts(shape.mesh, shape.links->open, posed, *object->memory, info);
    if (shape.links) {
      const mesh::Opening opening = mesh::measure_opening(shape.mesh, *shape.links, posed, *object->memory);
      info.touching_count = static_cast<std::uint32_t>(shape.links->touching.size());
      info.worst_opening = opening.worst;
      info.opening_vertex = mesh::given_vertex(shape.mesh, opening.vertex);
    }
    if (out_gaps) std::copy(gaps.begin(), gaps.end(), out_gaps);
    const mesh::GapSummary found = mesh::summarise_gaps(gaps);
    info.worst = found.worst;
    info.worst_link = found.worst_link;
    info.percentile_95 = found.percentile_95;
    if (out_info) write_struct(out_info, info);
  });
}

hf_result hf_surface_relink(hf_surface handle, const hf_links_desc* links, hf_progress progress,
                            hf_surface* out_surface) {
  return create("hf_surface_relink", out_surface, "out_surface", [&] {
    const auto object = mesh_surface(handle, "links");
    const surface::Surface& old = object->surface;
    return with_progress(progress, [&] {
      const surface::Geometry& shape = old.geometry();
      std::shared_ptr<const surface::Geometry> plain = shape.plain ? shape.plain : old.own().geometry;
      mesh::LinksIn in(object->memory.get());
      if (links) mesh::read_links(read_struct(links, "links"), plain->mesh, in);
      auto geometry = surface::Geometry::linked(std::move(plain), in.options);
      auto unedited = make_owner_in<SurfaceObject>(object->memory, std::move(geometry),
                                                   surface::options_like(old.unedited()), object->info);
      if (!old.stiffness()) return unedited;
      const std::shared_ptr<const surface::Surface> from(unedited, &unedited->surface);
      return make_owner_in<SurfaceObject>(object->memory, from, surface::SurfaceEdit{old.own().stiffness, nullptr},
                                          object->info);
    });
  });
}

}  // extern "C"
