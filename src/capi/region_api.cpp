// Implements hf/region.h: regions.
#include <algorithm>

#include "capi/morph_out.h"
#include "capi/region_object.h"
#include "detail/intake.h"

namespace hf_inner::capi {
namespace {

template <class Work>
hf_result change(const char* function, hf_region handle, Work&& work) {
  return guarded(function, [&] {
    const auto object = get<RegionObject>(handle, "region");
    const Changing changing(*object);
    work(object->region);
  });
}

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_region_create(hf_surface handle, const hf_region_desc* given, hf_region* out_region) {
  return create("hf_region_create", out_region, "out_region", [&] {
    const auto surface = mesh_surface(handle, "a region");
    const hf_region_desc desc = read_optional(given, "desc");
    const detail::RegionOptions options =
        detail::read_region_options(desc, surface->surface.geometry().mesh.report.vertex_count);
    return with_progress(desc.progress, [&] {
      const auto core = surface->surface.unedited().core(options.field_kind);
      return make_owner_in<RegionObject>(
          core->memory,
          make_owner_in<detail::RegionSurface>(core->memory, core, detail::positions_of(*core, options.positions)));
    });
  });
}

hf_result hf_region_clone(hf_region handle, hf_region* out_region) {
  return clone_object<RegionObject>("hf_region_clone", handle, "region", out_region, "out_region");
}

void hf_region_destroy(hf_region region) { destroy<RegionObject>(region); }

hf_result hf_region_edit(hf_region handle, const hf_region_edit_desc* given) {
  return guarded("hf_region_edit", [&] {
    const auto object = get<RegionObject>(handle, "region");
    const hf_region_edit_desc desc = read_struct(given, "edit");
    const Changing changing(*object);
    detail::RegionEditInput input(object->memory.get());
    if (desc.curve) detail::read_curve(object->region.core(), read_struct(desc.curve, "curve"), input);
    detail::read_region_lists(object->region.core(), desc, input);
    with_progress(desc.progress, [&] { object->region.edit(input.edit); });
  });
}

hf_result hf_region_get_info(hf_region region, hf_region_info* out_info) {
  return guarded("hf_region_get_info", [&] {
    const auto object = get<RegionObject>(region, "region");
    check_struct(out_info, "out_info");
    const Reading reading(*object);
    const detail::RegionState& state = *object->region.state();
    hf_region_info info{};
    info.field_kind = static_cast<std::int32_t>(object->region.core().field_kind);
    info.vertex_count = static_cast<std::uint32_t>(state.shape->inside.size());
    info.rim_count = static_cast<std::uint32_t>(state.shape->rim.size());
    info.site_count = static_cast<std::uint32_t>(state.shape->sites.size());
    const double scale = object->region.core().mesh.scale;
    info.area = state.area * scale * scale;
    info.base_area = state.base_area * scale * scale;
    write_struct(out_info, info);
  });
}

hf_result hf_region_get_statistics(hf_region region, hf_region_statistics* out_statistics) {
  return guarded("hf_region_get_statistics", [&] {
    const auto object = get<RegionObject>(region, "region");
    check_struct(out_statistics, "out_statistics");
    const Reading reading(*object);
    const detail::RegionState& state = *object->region.state();
    const solve::EngineCounters counters = state.engine->counters();
    hf_region_statistics statistics{};
    statistics.inserted_count = state.inserted;
    statistics.removed_count = state.removed;
    statistics.kept_count = state.kept;
    statistics.factorisation_count = counters.factorisations - 1;  // the surface's own factor counts as one
    statistics.path_solve_count = counters.path_solves;
    statistics.last_route = static_cast<std::uint32_t>(counters.last_route);
    statistics.whole_sweep = state.whole_sweep;
    write_struct(out_statistics, statistics);
  });
}

hf_result hf_region_get_vertices(hf_region handle, int32_t list, uint32_t capacity, uint32_t* out_vertices,
                                 uint32_t* out_count) {
  return guarded("hf_region_get_vertices", [&] {
    const auto object = get<RegionObject>(handle, "region");
    check_choice(list, 3, "list");
    require_either(out_vertices, out_count, "out_vertices and out_count");
    const Reading reading(*object);
    const detail::RegionShape& shape = *object->region.state()->shape;
    const Vector<std::int32_t>& vertices = list == HF_REGION_INSIDE ? shape.inside
                                           : list == HF_REGION_RIM  ? shape.rim
                                                                    : shape.sites;
    write_count(out_count, vertices.size());
    check_capacity(out_vertices, capacity, vertices.size(), "capacity");
    if (!out_vertices) return;
    const mesh::Mesh& mesh = object->region.core().mesh;
    for (std::size_t i = 0; i < vertices.size(); ++i) out_vertices[i] = mesh::given_vertex(mesh, vertices[i]);
    std::sort(out_vertices, out_vertices + vertices.size());
  });
}

hf_result hf_region_get_curve(hf_region handle, uint32_t capacity, double* out_points, uint32_t* out_count) {
  return guarded("hf_region_get_curve", [&] {
    const auto object = get<RegionObject>(handle, "region");
    require_either(out_points, out_count, "out_points and out_count");
    const Reading reading(*object);
    const Vector<Vec3>* const curve = object->region.state()->curve.get();
    const std::size_t count = curve ? curve->size() : 0;
    write_count(out_count, count);
    check_capacity(out_points, capacity, count, "capacity");
    for (std::size_t i = 0; out_points && i < count; ++i) put((*curve)[i], out_points + 3 * i);
  });
}

hf_result hf_region_morph(hf_region handle, const hf_morph_desc* given) {
  return guarded("hf_region_morph", [&] {
    const auto object = get<RegionObject>(handle, "region");
    const MorphOut out = read_morph(given, object->region.core().mesh.report.vertex_count);
    const Reading reading(*object);
    const detail::RegionSurface& surface = *object->region.surface();
    const detail::RegionState& state = *object->region.state();
    write_morph(surface, state, out, [&](std::size_t v, std::size_t i) {
      return detail::morphed(surface.positions[v], state.base[i], out.weight);
    });
  });
}

}  // extern "C"
