// Reads the edits of regions and the options of carried detail.
#pragma once
#include "detail/carried_detail.h"
#include "detail/region.h"
#include "hf/region.h"

namespace hf_inner::detail {

struct RegionOptions {
  mesh::FieldKind field_kind;
  ConstRows positions;  // null: the positions of the surface
};
// Throws HF_ERROR_INVALID_ARGUMENT, HF_ERROR_INVALID_DESC or HF_ERROR_TOO_SMALL (stride).
RegionOptions read_region_options(const hf_region_desc& desc, std::size_t vertex_count);

// Returns the weight of a morph. Throws HF_ERROR_NON_FINITE or HF_ERROR_INVALID_DESC.
double read_morph_weight(const hf_morph_desc& desc);

// An edit and the lists that it refers to.
struct RegionEditInput {
  explicit RegionEditInput(Memory* memory) : points(memory), remove(memory), add(memory) {}
  RegionEditInput(const RegionEditInput&) = delete;
  RegionEditInput& operator=(const RegionEditInput&) = delete;
  Vector<mesh::CurvePoint> points;
  Vector<std::int32_t> remove, add;
  RegionEdit edit;
};
// Read the curve, and the other parts of the edit. Throw as hf_region_edit says.
void read_curve(const surface::Core& core, const hf_curve_desc& curve, RegionEditInput& input);
void read_region_lists(const surface::Core& core, const hf_region_edit_desc& desc, RegionEditInput& input);

// Which boundary vertices match, and the scale.
struct CarryInput {
  explicit CarryInput(Memory& memory) : source_pins(&memory), target_pins(&memory) {}
  CarryOptions options() const noexcept { return {source_pins, target_pins, scale}; }
  Vector<std::int32_t> source_pins, target_pins;
  double scale = 0;
};
// Throws HF_ERROR_NON_FINITE, HF_ERROR_INVALID_ARGUMENT, HF_ERROR_NULL_POINTER, HF_ERROR_OUT_OF_RANGE as
// hf_detail_create says.
CarryInput read_carry(const Region& source, const Region& target, const hf_detail_desc& desc);

}  // namespace hf_inner::detail
