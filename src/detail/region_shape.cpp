#include "detail/region_shape.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::detail {
namespace {

// Calls use(u) for every neighbour u of the vertex v.
template <class Use>
void for_neighbours(const mesh::Topology& topology, Index v, Use&& use) {
  for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i)
    use(topology.neighbour[at(i)]);
}

// Calls use(u) for every entry of column v that is not 0.
template <class Use>
void for_entries(const SymmetricMatrix& k, Index v, Use&& use) {
  for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i)
    if (k.value[at(i)] != 0) use(k.row[at(i)]);
}

void check_held(const surface::Core& core, Span<const Index> inside, Memory& memory) {
  Vector<Index> free(core.mesh.report.component_count, 0, &memory);
  for (const Index c : core.mesh.component) ++free[at(c)];
  for (const Index v : inside) {
    if (--free[at(core.mesh.component[at(v)])] > 0) continue;
    const Index given = core.mesh.given_of_inner[at(v)];
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(given),
         "the component of vertex %d would lie in the region as a whole; leave vertices out that hold it", given);
  }
}

}  // namespace

RegionShape::RegionShape(const surface::Core& core, Span<const std::int32_t> given, Memory& memory)
    : inside(given.begin(), given.end(), &memory),
      rim(&memory),
      sites(&memory),
      local(at(core.size()), -1, &memory),
      triangles(&memory),
      corners(&memory) {
  check_held(core, inside, memory);
  for (std::size_t i = 0; i < inside.size(); ++i) local[at(inside[i])] = static_cast<Index>(i);
  constexpr Index taken = -2;
  const auto take = [&](Index v, Vector<Index>& list) {
    if (local[at(v)] == -1) {
      local[at(v)] = taken;
      list.push_back(v);
    }
  };
  const mesh::Topology& surface = core.geometry->unlinked().topology();
  for (const Index v : inside) for_neighbours(surface, v, [&](Index u) { take(u, rim); });
  sites.assign(rim.begin(), rim.end());
  // Linked vertices outside hold the base, but they are no rim: they lie on other pieces.
  for (const Index v : inside) for_neighbours(core.topology(), v, [&](Index u) { take(u, sites); });
  if (core.root) {
    // K couples the vertices within two edges of L. Each vertex next to the region is read once.
    const SymmetricMatrix& l = core.root->matrix();
    Vector<std::uint8_t> is_next(at(core.size()), 0, &memory);
    for (const Index v : inside) {
      for_entries(l, v, [&](Index u) { is_next[at(u)] = 1; });
    }
    for (Index u = 0; u < core.size(); ++u) {
      if (is_next[at(u)]) for_entries(l, u, [&](Index w) { take(w, sites); });
    }
  } else if (core.refinements > 0) {
    for (const Index v : inside) for_entries(core.matrix(), v, [&](Index u) { take(u, sites); });
  }
  for (const Index v : sites) local[at(v)] = -1;
  std::sort(rim.begin(), rim.end());
  std::sort(sites.begin(), sites.end());
  for (std::size_t i = 0; i < rim.size(); ++i) local[at(rim[i])] = static_cast<Index>(inside.size() + i);
  if (inside.empty()) return;
  const Index inside_count = static_cast<Index>(inside.size());
  for (Index t = 0; t < core.mesh.triangle_count(); ++t) {
    const Index* v = core.mesh.triangle(t);
    const Index l[3] = {local[at(v[0])], local[at(v[1])], local[at(v[2])]};
    const auto moves = [&](Index i) { return i >= 0 && i < inside_count; };
    if (!moves(l[0]) && !moves(l[1]) && !moves(l[2])) continue;
    triangles.push_back(t);
    corners.insert(corners.end(), l, l + 3);
  }
}

Vector<std::int32_t> grown(const surface::Core& core, Span<const std::int32_t> inside, std::int32_t rings,
                           Memory& memory) {
  const mesh::Topology& surface = core.geometry->unlinked().topology();
  Vector<std::uint8_t> in(at(core.size()), 0, &memory);
  for (const Index v : inside) in[at(v)] = 1;
  Vector<Index> front(&memory), next(&memory);
  // A ring of vertices starts at the region's boundary. It moves outwards if the region grows, and inwards if it
  // shrinks.
  const std::uint8_t joins = rings > 0;
  for (const Index v : inside) {
    if (joins) {
      for_neighbours(surface, v, [&](Index u) {
        if (!in[at(u)]) {
          in[at(u)] = 1;
          front.push_back(u);
        }
      });
    } else {
      bool edge = false;
      for_neighbours(surface, v, [&](Index u) { edge = edge || in[at(u)] == 0; });
      if (edge) front.push_back(v);
    }
  }
  if (!joins)
    for (const Index v : front) in[at(v)] = 0;
  const std::int64_t steps = rings > 0 ? rings : -std::int64_t{rings};
  for (std::int64_t step = 1; step < steps && !front.empty(); ++step) {
    next.clear();
    for (const Index v : front) {
      for_neighbours(surface, v, [&](Index u) {
        if (in[at(u)] != joins) {
          in[at(u)] = joins;
          next.push_back(u);
        }
      });
    }
    front.swap(next);
  }
  Vector<Index> result(&memory);
  for (Index v = 0; v < core.size(); ++v)
    if (in[at(v)]) result.push_back(v);
  return result;
}

}  // namespace hf_inner::detail
