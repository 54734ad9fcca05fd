// Steps of regions and the detail on them.
#include "golden_scene.h"

namespace golden {

using hf::check;
using hf::make;

Result Scene::run_region(const Json& step, const std::string& what) {
  Result result;
  if (what == "detail") {
    const Object &source = objects_[step["source"]], &target = objects_[step["target"]];
    auto desc = make<hf_detail_desc>();
    set_options(step, {{"scale", &desc.scale}});
    hf_detail raw = nullptr;
    check(hf_detail_create(source.region.get(), target.region.get(), &desc, &raw));
    const size_t n = target.vertex_count;
    Object& made = objects_[step["as"]];
    made.detail = hf::Handle<hf_detail, hf_detail_destroy>(raw);
    made.vertex_count = n;
    return result;
  }
  Object& on = objects_[step["on"]];
  hf_region region = on.region.get();
  if (what == "region") {
    auto desc = make<hf_region_desc>();
    set_options(step, {{"base", &desc.base}});
    const auto positions = doubles(step, "positions", 3 * on.vertex_count);
    desc.positions_f64 = data(positions);
    hf_region raw = nullptr;
    check(hf_region_create(on.surface.get(), &desc, &raw));
    const size_t n = on.vertex_count;
    Object& made = objects_[step["as"]];
    made.region = hf::Handle<hf_region, hf_region_destroy>(raw);
    made.vertex_count = n;
  } else if (what == "region_edit") {
    const auto curve = numbers(step, "curve"), add = numbers(step, "add"), removed = numbers(step, "remove");
    auto desc = make<hf_region_edit_desc>();
    auto line = make<hf_curve_desc>();
    desc.ring_count = step.value("rings", 0);
    line.kind = step.value("curve_kind", 0);
    if (curve) {
      line.point_count = count(curve);
      line.vertices = data(curve);
      desc.curve = &line;
    }
    if (add) {
      desc.add_count = count(add);
      desc.add_vertices = data(add);
    }
    if (removed) {
      desc.remove_count = count(removed);
      desc.remove_vertices = data(removed);
    }
    check(hf_region_edit(region, &desc));
  } else if (what == "region_info") {
    auto info = make<hf_region_info>();
    check(hf_region_get_info(region, &info));
    result.fields = {
        {"field_kind", info.field_kind}, {"vertex_count", info.vertex_count}, {"rim_count", info.rim_count}};
  } else if (what == "region_vertices") {
    const int32_t list = step.value("list", 0);
    uint32_t size = 0;
    check(hf_region_get_vertices(region, list, 0, nullptr, &size));
    Numbers found(size);
    check(hf_region_get_vertices(region, list, size, found.data(), &size));
    result.array.emplace(found.begin(), found.end());
  } else if (what == "region_curve") {
    uint32_t size = 0;
    check(hf_region_get_curve(region, 0, nullptr, &size));
    std::vector<double> found(3 * size_t{size});
    if (size > 0) check(hf_region_get_curve(region, size, found.data(), &size));
    result.array = found;
  } else if (what == "record_region") {
    on.region_history.record(hf::clone_of(on.region, hf_region_clone));
  } else if (what == "undo_region") {
    on.region_history.undo(on.region);
  } else if (what == "redo_region") {
    on.region_history.redo(on.region);
  } else {
    auto desc = make<hf_morph_desc>();
    result.array.emplace(3 * on.vertex_count);
    desc.weight = number(step["weight"]);
    desc.positions_f64 = result.array->data();
    check(on.detail ? hf_detail_morph(on.detail.get(), &desc) : hf_region_morph(region, &desc));
  }
  return result;
}

}  // namespace golden
