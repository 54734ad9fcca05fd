// Reads the options of quad meshes.
#pragma once
#include "hf/quads.h"
#include "quads/field_quads.h"

namespace hf_inner::quads {

// The lists of the caller, which the options refer to.
struct QuadLists {
  explicit QuadLists(Memory& memory) : guides(&memory), poles(&memory), edges(&memory) {}
  Vector<QuadGuide> guides;
  Vector<QuadPole> poles;
  Vector<Index> edges;
};

// Throws as hf_quads_create says.
FieldQuadOptions read_field_quad_options(std::shared_ptr<const surface::Core> core, const hf_quads_desc& desc,
                                         QuadLists& lists);

}  // namespace hf_inner::quads
