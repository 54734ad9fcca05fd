// Implements the part of hf/region.h that carries detail to another region.
#include "capi/morph_out.h"
#include "capi/region_object.h"
#include "detail/intake.h"

namespace hf_inner::capi {
namespace {

struct DetailObject final : Object {
  static constexpr Kind kind_of = Kind::detail;
  explicit DetailObject(detail::CarriedDetail&& made)
      : Object(kind_of, made.surface->core->memory), detail(std::move(made)) {}
  detail::CarriedDetail detail;
};

}  // namespace
}  // namespace hf_inner::capi

using namespace hf_inner;
using namespace hf_inner::capi;

extern "C" {

hf_result hf_detail_create(hf_region source_handle, hf_region target_handle, const hf_detail_desc* given,
                           hf_detail* out_detail) {
  return create("hf_detail_create", out_detail, "out_detail", [&] {
    const auto source = get<RegionObject>(source_handle, "source");
    const auto target = get<RegionObject>(target_handle, "target");
    const hf_detail_desc desc = read_optional(given, "desc");
    const Reading reading_source(*source), reading_target(*target);
    const detail::CarryInput input = detail::read_carry(source->region, target->region, desc);
    return with_progress(desc.progress, [&] {
      return make_owner_in<DetailObject>(
          target->memory, detail::carry_detail(source->region, target->region, input.options(), *target->memory));
    });
  });
}

void hf_detail_destroy(hf_detail detail) { destroy<DetailObject>(detail); }

hf_result hf_detail_morph(hf_detail handle, const hf_morph_desc* given) {
  return guarded("hf_detail_morph", [&] {
    const auto object = get<DetailObject>(handle, "detail");
    const Reading reading(*object);
    const detail::CarriedDetail& carried = object->detail;
    const MorphOut out = read_morph(given, carried.surface->core->mesh.report.vertex_count);
    write_morph(*carried.surface, *carried.state, out,
                [&](std::size_t, std::size_t i) { return carried.position(i, out.weight); });
  });
}

}  // extern "C"
