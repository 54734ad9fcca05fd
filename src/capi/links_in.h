// Reads hf_links_desc.
#pragma once
#include "hf/surface.h"
#include "mesh/links.h"

namespace hf_inner::capi {

// The links of a desc as the mesh room takes them. `options` refers to the lists.
struct LinksIn {
  explicit LinksIn(Memory* memory) : list(memory), light(memory), heavy(memory) {}
  LinksIn(const LinksIn&) = delete;
  LinksIn& operator=(const LinksIn&) = delete;
  Vector<Link> list;
  Vector<std::int32_t> light, heavy;
  LinkOptions options;
};

// given: NULL for no links. Throws HF_ERROR_OUT_OF_RANGE, _NON_FINITE and _INVALID_ARGUMENT as hf_surface_create says.
void read_links(const hf_links_desc* given, const Mesh& mesh, LinksIn& out);

}  // namespace hf_inner::capi
