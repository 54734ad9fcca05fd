#include "weights/pieces.h"

#include <algorithm>
#include <cmath>

#include "weights/constants.h"

namespace hf_inner::weights {
namespace {

// Vertices with a tree over them.
class Cloud {
 public:
  template <class Takes>
  Cloud(const mesh::Mesh& mesh, Memory& memory, Takes&& takes)
      : mesh_(mesh), vertices_(&memory), tree_(collect(takes, memory), memory) {}
  bool empty() const noexcept { return vertices_.empty(); }
  // The nearest vertex; among equal ones the lowest number.
  Index nearest(const Vec3& p) const {
    double best = HUGE_VAL;
    Index found = -1;
    tree_.near(
        p, [&] { return best; },
        [&](Index i) {
          const Vec3 away = mesh_.positions[at(vertices_[at(i)])] - p;
          const double squared = dot(away, away);
          if (squared < best || (squared == best && vertices_[at(i)] < found)) {
            best = squared;
            found = vertices_[at(i)];
          }
        });
    return found;
  }

 private:
  template <class Takes>
  Vector<mesh::ItemBox> collect(Takes&& takes, Memory& memory) {
    Vector<mesh::ItemBox> boxes(&memory);
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (takes(v)) {
        vertices_.push_back(v);
        boxes.push_back(mesh::ItemBox::of(mesh_.positions[at(v)]));
      }
    }
    return boxes;
  }
  const mesh::Mesh& mesh_;
  Vector<Index> vertices_;
  mesh::BoxTree tree_;
};

Vec3 clamped(const Vec3& p) noexcept {
  const auto one = [](double x) { return std::min(std::max(x, -farthest), farthest); };
  return {one(p.x), one(p.y), one(p.z)};
}

}  // namespace

Carriers find_carriers(const mesh::Mesh& mesh, const Vector<std::uint8_t>& solved, Memory& memory, JobRunner& jobs) {
  const std::size_t n = at(mesh.vertex_count()), pieces = solved.size();
  Carriers out(memory);
  out.of.assign(n, -1);
  out.rigid.assign(pieces, 0);
  const auto is_solved = [&](Index v) { return solved[at(mesh.component[at(v)])] != 0; };
  for (Index v = 0; at(v) < n; ++v) out.of[at(v)] = is_solved(v) ? v : -1;
  const auto left = static_cast<std::size_t>(std::count(solved.begin(), solved.end(), 0));
  if (left == 0 || left == pieces) return out;
  const Cloud cloud(mesh, memory, is_solved);
  for_ranges(jobs, n, vertex_piece, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (out.of[v] < 0) out.of[v] = cloud.nearest(mesh.positions[v]);
    }
  });
  Vector<mesh::ItemBox> box(pieces, &memory);
  Vector<std::uint8_t> seen(pieces, 0, &memory);
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t c = at(mesh.component[v]);
    if (!seen[c]) {
      box[c] = mesh::ItemBox::of(mesh.positions[v]);
      seen[c] = 1;
    }
    box[c].take(mesh.positions[v]);
  }
  for (std::size_t c = 0; c < pieces; ++c) {
    if (solved[c]) continue;
    out.rigid[c] = norm(box[c].high - box[c].low) < rigid_size;
    out.rigid_pieces += out.rigid[c];
    out.carried_pieces += !out.rigid[c];
  }
  return out;
}

Vector<Index> nearest_of_isolated(const mesh::Mesh& mesh, Memory& memory) {
  Vector<Index> out(&memory);
  if (mesh.isolated.empty()) return out;
  const Cloud cloud(mesh, memory, [](Index) { return true; });
  Poller poller;
  for (const mesh::Mesh::Isolated& vertex : mesh.isolated) {
    poller.due();
    out.push_back(cloud.nearest(clamped(mesh.to_inner(vertex.position))));
  }
  return out;
}

}  // namespace hf_inner::weights
