#include "surface/link_change.h"

#include <algorithm>

#include "mesh/touching.h"

namespace hf_inner::surface {
namespace {

bool ascends(Index a, Index b, Index c, Index d) noexcept { return a != c ? a < c : b < d; }

bool same_link(const mesh::Link& a, const mesh::Link& b) noexcept {
  return a.vertex == b.vertex && std::equal(a.corner, a.corner + 3, b.corner) && a.weight == b.weight &&
         std::equal(a.share, a.share + 3, b.share);
}

}  // namespace

std::shared_ptr<const LinkChange> LinkChange::make(const mesh::Links* before, const mesh::Links& after,
                                                   mesh::OperatorKind operator_kind, Memory& memory) {
  const auto made = make_shared_in<LinkChange>(memory, memory);
  Vector<mesh::LinkEdge> old(&memory);
  if (before) old = mesh::link_edges(*before, operator_kind, memory);
  const Vector<mesh::LinkEdge> edges = mesh::link_edges(after, operator_kind, memory);
  const auto take = [&](Index a, Index b, double weight_before, double weight_after) {
    if (weight_before == weight_after) return;
    const bool crosses = after.piece[at(a)] != after.piece[at(b)];
    made->ends.push_back({a, b, weight_before, weight_after, crosses});
    made->ends.push_back({b, a, weight_before, weight_after, crosses});
  };
  for (std::size_t i = 0, j = 0; i < old.size() || j < edges.size();) {
    const bool is_old =
        j == edges.size() || (i < old.size() && !ascends(edges[j].first, edges[j].second, old[i].first, old[i].second));
    const bool is_new =
        i == old.size() || (j < edges.size() && !ascends(old[i].first, old[i].second, edges[j].first, edges[j].second));
    const mesh::LinkEdge& edge = is_old ? old[i] : edges[j];
    take(edge.first, edge.second, is_old ? old[i].weight : 0.0, is_new ? edges[j].weight : 0.0);
    i += is_old;
    j += is_new;
  }
  std::sort(made->ends.begin(), made->ends.end(),
            [](const LinkEnd& a, const LinkEnd& b) { return ascends(a.vertex, a.other, b.vertex, b.other); });
  return made;
}

Span<const LinkEnd> LinkChange::at_vertex(Index v) const noexcept {
  const auto first = std::lower_bound(ends.begin(), ends.end(), v,
                                      [](const LinkEnd& end, Index vertex) { return end.vertex < vertex; });
  const auto last =
      std::upper_bound(first, ends.end(), v, [](Index vertex, const LinkEnd& end) { return vertex < end.vertex; });
  return {ends.data() + (first - ends.begin()), static_cast<std::size_t>(last - first)};
}

std::shared_ptr<const mesh::Links> edited_links(const mesh::Mesh& mesh, const mesh::Links* links,
                                                Span<const std::uint8_t> removed, Span<const mesh::Link> added,
                                                Memory& memory) {
  const auto made = make_shared_in<mesh::Links>(memory, memory);
  made->piece = mesh.component;
  if (links) {
    made->stiffness = links->stiffness;
    made->open.assign(links->open.begin(), links->open.end());
    made->light.assign(links->light.begin(), links->light.end());
    for (std::size_t i = 0; i < links->links.size(); ++i)
      if (!removed[i]) made->links.push_back(links->links[i]);
    mesh::keep_touching(*links, mesh, memory, *made);
  } else {
    made->light.assign(at(mesh.component_count()), 0);
  }
  for (mesh::Link link : added) {
    link.length = mesh::rest_length(link, mesh);
    made->links.push_back(link);
  }
  mesh::find_groups(*made, memory);
  for (const mesh::Link& link : made->links)
    if (link.tree) made->longest_tree_link = std::max(made->longest_tree_link, link.length);
  return made;
}

bool same_links(const mesh::Links* a, const mesh::Links* b) noexcept {
  const std::size_t count = a ? a->links.size() : 0;
  if (count != (b ? b->links.size() : 0)) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (!same_link(a->links[i], b->links[i])) return false;
  return true;
}

}  // namespace hf_inner::surface
