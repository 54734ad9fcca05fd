// Reads hf_links_desc: checks it and turns its vertices into inner ones.
#pragma once
#include "hf/surface.h"
#include "mesh/links.h"

namespace hf_inner::mesh {

// The links of a desc as the mesh room takes them. `options` refers to the lists.
struct LinksIn {
  explicit LinksIn(Memory* given) : memory(*given), list(given), light(given), heavy(given) {}
  LinksIn(const LinksIn&) = delete;
  LinksIn& operator=(const LinksIn&) = delete;
  Memory& memory;
  Vector<Link> list;
  Vector<std::int32_t> light, heavy;
  LinkOptions options;
};

// The next two throw HF_ERROR_OUT_OF_RANGE, _NON_FINITE and _INVALID_ARGUMENT as hf_surface_create says.
void read_link_list(std::uint32_t count, const hf_link* links, const Mesh& mesh, Vector<Link>& out);
void read_links(const hf_links_desc& desc, const Mesh& mesh, LinksIn& out);

}  // namespace hf_inner::mesh
