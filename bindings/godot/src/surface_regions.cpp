// Methods of regions (hf/region.h): a region of the surface, its smooth base, the morph between them, and the detail of
// another surface's region carried to it.
#include "arguments.h"

namespace hf_godot {
namespace {

// region_create(positions = null, base = 0): HF_BASE_*. An empty region, of a pose of the surface or of its rest
// positions
Value region_create(Surface& s, const Arguments& a) {
  auto desc = make<hf_region_desc>();
  desc.positions = rows_of(at(a, 0), 3, s.vertex_count, "positions");
  desc.base = signed_whole(at(a, 1).number, "base");
  make_again(s.region, [&](hf_region* out) { return hf_region_create(s.get(), &desc, out); });
  s.detail = {};
  return done();
}

// region_edit(add = null, remove = null, rings = 0, curve = null, side = 0, seed vertex = 0, curve kind = 0): a batch.
// The region becomes what a closed curve through these vertices encloses (kind: HF_CURVE_*), grows by rings (below 0 it
// shrinks), loses and gains vertices.
Value region_edit(Surface& s, const Arguments& a) {
  const List add = integers(at(a, 0), "add"), remove = integers(at(a, 1), "remove"),
             along = integers(at(a, 3), "curve");
  auto edit = make<hf_region_edit_desc>();
  auto curve = make<hf_curve_desc>();
  edit.ring_count = signed_whole(at(a, 2).number, "rings");
  edit.add_count = static_cast<uint32_t>(add.values.size());
  edit.add_vertices = add.data();
  edit.remove_count = static_cast<uint32_t>(remove.values.size());
  edit.remove_vertices = remove.data();
  if (!along.null) {
    curve.point_count = along.count();
    curve.vertices = along.data();
    curve.side = signed_whole(at(a, 4).number, "side");
    curve.seed_vertex = whole(at(a, 5).number, "seed vertex");
    curve.kind = signed_whole(at(a, 6).number, "curve kind");
    edit.curve = &curve;
  }
  check(hf_region_edit(s.region.get(), &edit));
  return done();
}

Value region_record(Surface& s, const Arguments&) {
  return s.region_history.record(hf::clone_of(s.region, hf_region_clone)), done();
}
Value region_undo(Surface& s, const Arguments&) { return s.region_history.undo(s.region), done(); }
Value region_redo(Surface& s, const Arguments&) { return s.region_history.redo(s.region), done(); }

hf_region_info region_info_of(const Surface& s) {
  auto info = make<hf_region_info>();
  check(hf_region_get_info(s.region.get(), &info));
  return info;
}

Value region_info(Surface& s, const Arguments&) {
  const hf_region_info info = region_info_of(s);
  auto work = make<hf_region_statistics>();
  check(hf_region_get_statistics(s.region.get(), &work));
  return named({{"vertex_count", info.vertex_count},
                {"rim_count", info.rim_count},
                {"site_count", info.site_count},
                {"inserted_count", work.inserted_count},
                {"removed_count", work.removed_count},
                {"factorisation_count", work.factorisation_count},
                {"field_kind", info.field_kind},
                {"area", info.area},
                {"base_area", info.base_area}});
}

// region_vertices(list = 0): HF_REGION_INSIDE, _RIM or _SITES
Value region_vertices(Surface& s, const Arguments& a) {
  const int32_t list = signed_whole(at(a, 0).number, "list");
  uint32_t count = 0;
  check(hf_region_get_vertices(s.region.get(), list, 0, nullptr, &count));
  Numbers found(count);
  check(hf_region_get_vertices(s.region.get(), list, count, found.data(), &count));
  return numbers(std::move(found));
}

// region_curve(): corners of the last closed curve; the last is joined to the first
Value region_curve(Surface& s, const Arguments&) {
  uint32_t count = 0;
  check(hf_region_get_curve(s.region.get(), 0, nullptr, &count));
  Doubles points(3 * size_t{count});
  check(hf_region_get_curve(s.region.get(), count, points.data(), &count));
  return vectors(points);
}

template <class Raw>
Value morph(Surface& s, const Arguments& a, Raw from, hf_result (*write)(Raw, const hf_morph_desc*)) {
  Value value;
  value.kind = Value::vectors;
  value.floats.resize(3 * s.vertex_count + 1);
  auto desc = make<hf_morph_desc>();
  desc.weight = at(a, 0).number;
  desc.positions = HF_ARRAY_OUT(value.floats.data(), s.vertex_count);
  check(write(from, &desc));
  value.floats.pop_back();
  return value;
}

// region_morph(weight): 0 the surface, 1 its base
Value region_morph(Surface& s, const Arguments& a) { return morph(s, a, s.region.get(), hf_region_morph); }

// detail_from(surface with a region, its rim vertices = null, ours = null, scale = 0): its detail on our region
Value detail_from(Surface& s, const Arguments& a) {
  if (!at(a, 0).surface) fail("detail_from needs a surface");
  const List source = integers(at(a, 1), "source vertices"), target = integers(at(a, 2), "target vertices");
  if (source.values.size() != target.values.size()) fail("source and target vertices must be of one length");
  auto desc = make<hf_detail_desc>();
  desc.pair_count = static_cast<uint32_t>(source.values.size());
  desc.scale = at(a, 3).number;
  desc.source_vertices = source.data();
  desc.target_vertices = target.data();
  const hf_region from = a[0].surface->region.get();
  make_again(s.detail, [&](hf_detail* out) { return hf_detail_create(from, s.region.get(), &desc, out); });
  return done();
}

// detail_morph(weight): 0 the base, 1 the detail carried here
Value detail_morph(Surface& s, const Arguments& a) { return morph(s, a, s.detail.get(), hf_detail_morph); }

}  // namespace

const std::vector<Entry>& region_methods() {
  static const std::vector<Entry> all = {
      {"region_create", 0, 2, region_create},     {"region_edit", 0, 7, region_edit},
      {"region_record", 0, 0, region_record},     {"region_undo", 0, 0, region_undo},
      {"region_redo", 0, 0, region_redo},         {"region_info", 0, 0, region_info},
      {"region_vertices", 0, 1, region_vertices}, {"region_curve", 0, 0, region_curve},
      {"region_morph", 1, 1, region_morph},       {"detail_from", 1, 4, detail_from},
      {"detail_morph", 1, 1, detail_morph},
  };
  return all;
}

}  // namespace hf_godot
