// The components of a mesh after a patch.
#include <algorithm>

#include "mesh/mesh_patch.h"
#include "mesh/union_find.h"

namespace hf_inner::mesh {
namespace {

// Components are numbered by the first of the caller's vertices in them.
void count_components(Mesh& mesh, Memory& memory) {
  UnionFind sets(mesh.positions.size(), memory);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    sets.unite(mesh.triangle(t)[0], mesh.triangle(t)[1]);
    sets.unite(mesh.triangle(t)[1], mesh.triangle(t)[2]);
  }
  mesh.component.assign(mesh.positions.size(), Mesh::none);
  mesh.report.component_count = 0;
  for (const Index v : mesh.inner_of_given) {
    if (v == Mesh::none || mesh.component[at(v)] != Mesh::none) continue;
    Index& of_root = mesh.component[at(sets.find(v))];
    if (of_root == Mesh::none) of_root = static_cast<Index>(mesh.report.component_count++);
    mesh.component[at(v)] = of_root;
  }
}

// Whether the numbers follow the first of the caller's vertices: a component can lose it, or get one before it.
bool is_in_order(const Mesh& mesh) noexcept {
  Index next = 0;
  const auto count = static_cast<Index>(mesh.report.component_count);
  for (const Index v : mesh.inner_of_given) {
    if (v == Mesh::none) continue;
    if (mesh.component[at(v)] > next) return false;
    if (mesh.component[at(v)] == next && ++next == count) return true;
  }
  return true;
}

}  // namespace

void put_components(const Mesh& before, Span<const Index> fresh, PatchedMesh& out, Memory& memory) {
  Mesh& mesh = out.mesh;
  Vector<Index> near(&memory);  // the vertices of the triangles around the patch
  for (const Index t : out.around) near.insert(near.end(), mesh.triangle(t), mesh.triangle(t) + 3);
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  const auto local = [&](Index v) {
    return static_cast<Index>(std::lower_bound(near.begin(), near.end(), v) - near.begin());
  };
  UnionFind sets(near.size(), memory);
  for (const Index t : out.around) {
    const Index* const v = mesh.triangle(t);
    sets.unite(local(v[0]), local(v[1]));
    sets.unite(local(v[1]), local(v[2]));
  }
  Vector<Index> slots(fresh.begin(), fresh.end(), &memory), before_of(&memory);  // before_of: where numbers changed
  std::sort(slots.begin(), slots.end());
  for (std::size_t v = 0; v < out.number.size(); ++v)
    if (out.number[v] != Mesh::none) before_of.push_back(static_cast<Index>(v));
  // every old component near the patch is one set there, and every set holds one old component
  Vector<Index> old(near.size(), Mesh::none, &memory);  // the component before; none for a new vertex
  Vector<Index> set_of(at(before.component_count()), Mesh::none, &memory), of_set(near.size(), Mesh::none, &memory);
  bool same = true;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (std::binary_search(slots.begin(), slots.end(), near[i])) continue;
    old[i] = before.component[at(out.number.empty() ? near[i] : before_of[at(near[i])])];
    const Index set = sets.find(static_cast<Index>(i));
    Index &there = set_of[at(old[i])], &here = of_set[at(set)];
    if (there == Mesh::none) there = set;
    if (here == Mesh::none) here = old[i];
    same = same && there == set && here == old[i];
  }
  for (std::size_t i = 0; i < near.size(); ++i)
    same = same && of_set[at(sets.find(static_cast<Index>(i)))] != Mesh::none;
  for (const Index v : out.went) same = same && set_of[at(before.component[at(v)])] != Mesh::none;
  out.same_components = same;
  if (!same) return count_components(mesh, memory);
  if (out.went.empty()) {
    mesh.component = before.component.grown(mesh.positions.size(), memory);
  } else {
    mesh.component.reserve(mesh.positions.size());
    mesh.component.assign(before.component.begin(), before.component.end());
    for (std::size_t v = 0; v < before_of.size(); ++v) mesh.component[v] = before.component[at(before_of[v])];
    mesh.component.resize(mesh.positions.size());
  }
  for (const Index v : fresh) mesh.component[at(v)] = of_set[at(sets.find(local(v)))];
  if (is_in_order(mesh)) return;
  out.same_components = false;
  mesh.component = SharedVector<Index>(memory);  // the numbers of `before` stay
  count_components(mesh, memory);
}

}  // namespace hf_inner::mesh
