#include "mesh/contact_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/link_constants.h"
#include "mesh/nearest_triangle.h"

namespace hf_inner::mesh {
namespace {

Vector<Index> pieces_of_triangles(const Mesh& mesh, Memory& memory) {
  Vector<Index> out(&memory);
  out.reserve(at(mesh.triangle_count()));
  for (Index t = 0; t < mesh.triangle_count(); ++t) out.push_back(mesh.component[at(mesh.triangle(t)[0])]);
  return out;
}

}  // namespace

ContactSearch::ContactSearch(const Mesh& mesh, const SkinHint& skin, Memory& memory)
    : mesh_(mesh),
      skin_(skin),
      memory_(memory),
      boxes_(triangle_boxes(mesh.positions, mesh.corners, memory)),
      group_(pieces_of_triangles(mesh, memory)),
      tree_(boxes_, group_, mesh.component_count(), memory),
      start_(at(mesh.component_count()) + 1, 0, &memory),
      vertex_(mesh.positions.size(), &memory),
      chunk_start_(&memory),
      chunk_vertex_(&memory),
      chunk_(&memory),
      joint_start_(&memory),
      joint_(&memory),
      heaviest_(&memory) {
  for (const Index p : mesh.component) ++start_[at(p) + 1];
  for (std::size_t p = 0; p + 1 < start_.size(); ++p) start_[p + 1] += start_[p];
  Vector<Index> next(start_.begin(), start_.end() - 1, &memory);
  for (std::size_t v = 0; v < mesh.component.size(); ++v)
    vertex_[at(next[at(mesh.component[v])]++)] = static_cast<Index>(v);
  make_chunks();
  if (skin.influence_count > 0) list_joints();
  if (!skin.parents.empty()) read_skeleton();
}

void ContactSearch::make_chunks() {
  Vector<std::uint8_t> seen(mesh_.positions.size(), 0, &memory_);
  chunk_vertex_.reserve(seen.size());
  for (Index piece = 0; piece < mesh_.component_count(); ++piece) {
    chunk_start_.push_back(static_cast<Index>(chunk_.size()));
    Index left = 0;  // room in the last chunk
    for (const Index t : tree_.items(piece)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index v = mesh_.triangle(t)[k], here = static_cast<Index>(chunk_vertex_.size());
        if (seen[at(v)]) continue;
        seen[at(v)] = 1;
        if (left == 0) {
          chunk_.push_back({ItemBox::of(mesh_.positions[at(v)]), here, here});
          left = chunk_vertices;
        }
        chunk_.back().box.take(mesh_.positions[at(v)]);
        chunk_.back().last = here + 1;
        --left;
        chunk_vertex_.push_back(v);
      }
    }
  }
  chunk_start_.push_back(static_cast<Index>(chunk_.size()));
}

void ContactSearch::list_joints() {
  const std::size_t count = skin_.influence_count;
  Vector<double> largest(&memory_);      // by joint
  Vector<std::uint16_t> seen(&memory_);  // joints of the piece
  for (Index piece = 0; piece < mesh_.component_count(); ++piece) {
    joint_start_.push_back(static_cast<Index>(joint_.size()));
    for (const Index v : vertices_of(piece)) {
      const std::size_t row = count * at(mesh_.given_of_inner[at(v)]);
      for (std::size_t i = row; i < row + count; ++i) {
        if (!(skin_.weights[i] > 0)) continue;
        double weight = 0;  // a joint may be named twice
        for (std::size_t j = row; j < row + count; ++j)
          weight += skin_.joints[j] == skin_.joints[i] ? static_cast<double>(skin_.weights[j]) : 0.0;
        const std::size_t joint = skin_.joints[i];
        if (joint >= largest.size()) largest.resize(joint + 1, 0.0);
        if (largest[joint] == 0 && weight > 0) seen.push_back(skin_.joints[i]);
        largest[joint] = std::max(largest[joint], weight);
      }
    }
    std::sort(seen.begin(), seen.end());
    for (const std::uint16_t joint : seen) {
      joint_.push_back({joint, largest[joint]});
      largest[joint] = 0;
    }
    seen.clear();
  }
  joint_start_.push_back(static_cast<Index>(joint_.size()));
}

void ContactSearch::read_skeleton() {
  const std::size_t count = skin_.influence_count;
  Vector<std::uint8_t> owns(skin_.parents.size(), 0, &memory_);
  for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
    const std::size_t row = count * at(mesh_.given_of_inner[v]);
    const auto most = std::max_element(skin_.weights + row, skin_.weights + row + count);
    heaviest_.push_back(*most > 0 ? skin_.joints[most - skin_.weights] : Mesh::none);
    if (*most > 0) owns[at(heaviest_[v])] = 1;
  }
  tree_of_joints_.emplace(skin_.parents, owns, memory_);
}

bool ContactSearch::are_kin(Index a, Index b) const noexcept {
  if (!tree_of_joints_) return false;
  constexpr double owned = 0.5;  // more than half of a vertex
  const auto carries = [&](Index above, Index below) {
    const auto first = joint_.begin() + joint_start_[at(above)], last = joint_.begin() + joint_start_[at(above) + 1];
    for (Index j = joint_start_[at(below)]; j < joint_start_[at(below) + 1]; ++j) {
      if (!(joint_[at(j)].weight > owned)) continue;
      const std::uint32_t parent = tree_of_joints_->above(joint_[at(j)].joint);
      const auto found =
          std::lower_bound(first, last, parent, [](const JointWeight& x, std::uint32_t y) { return x.joint < y; });
      if (found != last && found->joint == parent && found->weight > owned) return true;
    }
    return false;
  };
  return carries(a, b) || carries(b, a);
}

double ContactSearch::least_skin_cost(Index a, Index b) const noexcept {
  if (joint_start_.empty()) return 0;
  constexpr double rounding = 1e-9;  // far above the rounding of the sums
  double common = rounding;
  for (Index i = joint_start_[at(a)], j = joint_start_[at(b)];
       i < joint_start_[at(a) + 1] && j < joint_start_[at(b) + 1];) {
    const JointWeight &x = joint_[at(i)], &y = joint_[at(j)];
    if (x.joint == y.joint) common += std::min(x.weight, y.weight);
    i += x.joint <= y.joint;
    j += y.joint <= x.joint;
  }
  return skin_distance * std::max(1 - common, 0.0);
}

double ContactSearch::squared(const Vec3& p, Index t, double* weights) const noexcept {
  const Index* c = mesh_.triangle(t);
  return squared_to_triangle(p, mesh_.positions[at(c[0])], mesh_.positions[at(c[1])], mesh_.positions[at(c[2])],
                             weights);
}

void ContactSearch::weights(const Contact& contact, double* out) const noexcept {
  squared(mesh_.positions[at(contact.vertex)], contact.triangle, out);
}

double ContactSearch::nearest(Index piece, const Vec3& p, double within, double enough, Index hint,
                              Index& triangle) const noexcept {
  double found = within;
  triangle = -1;
  const auto test = [&](Index t) {
    const double d = squared(p, t);
    if (d < found || (triangle >= 0 && t < triangle && d <= found)) {
      found = d;
      triangle = t;
    }
  };
  if (hint >= 0 && squared_distance(p, boxes_[at(hint)]) < found) test(hint);
  const auto reach = [&] { return triangle >= 0 && found <= enough ? -1.0 : found; };
  tree_.near(piece, p, reach, [&](Index t) {
    if (t != hint) test(t);
  });
  return found;
}

bool ContactSearch::contact_of(Index v, Index piece, double reach, Index& hint, Contact& out) const {
  Index triangle;
  const double found = nearest(piece, mesh_.positions[at(v)], reach * reach, -1, hint, triangle);
  if (triangle < 0) return false;
  hint = triangle;
  out = contact(v, triangle, found);
  return true;
}

Contact ContactSearch::contact(Index v, Index triangle, double squared_length) const {
  Contact out{v, triangle, std::sqrt(squared_length), std::sqrt(squared_length)};
  if (skin_.influence_count > 0) {
    double share[3];
    squared(mesh_.positions[at(v)], triangle, share);
    const Index* corner = mesh_.triangle(triangle);
    if (tree_of_joints_) {
      const Index a = heaviest_[at(v)], b = heaviest_[at(corner[std::max_element(share, share + 3) - share])];
      if (a != Mesh::none && b != Mesh::none)
        out.steps = tree_of_joints_->steps(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b));
    }
    out.cost += skin_distance * difference(skin_, mesh_, v, corner, share) * std::max(1, out.steps);
  }
  return out;
}

void ContactSearch::find(Index from, Index to, double depth, double& reach, Vector<Contact>& out,
                         std::size_t most) const {
  const std::size_t first = out.size();
  const double least_skin = least_skin_cost(from, to);
  const auto is_near = [&](const Chunk& chunk) { return squared_distance(chunk.box, box(to)) < reach * reach; };
  std::size_t step = 1;
  if (most < SIZE_MAX) {
    std::size_t count = 0;
    for (const Chunk& chunk : chunks_of(from)) count += is_near(chunk) ? at(chunk.last - chunk.first) : 0;
    step = std::max<std::size_t>(1, count / most);
  }
  Index hint = -1;
  for (const Chunk& chunk : chunks_of(from)) {
    if (!is_near(chunk) || !tree_.is_near(to, chunk.box, reach * reach)) continue;
    for (std::size_t i = at(chunk.first); i < at(chunk.last); i += step) {
      Contact made;
      if (!contact_of(chunk_vertex_[i], to, reach, hint, made)) continue;
      out.push_back(made);
      reach = std::min(reach, made.cost - least_skin + depth);
    }
  }
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
            [](const Contact& a, const Contact& b) { return a.vertex < b.vertex; });
}

void ContactSearch::improve(Index from, Index to, double range, Vector<Contact>& best) const {
  const double least_skin = least_skin_cost(from, to);
  Index hint = -1;
  for (const Chunk& chunk : chunks_of(from)) {
    double reach = 0;
    for (Index i = chunk.first; i < chunk.last; ++i) reach = std::max(reach, best[at(chunk_vertex_[at(i)])].cost);
    reach = std::min(reach - least_skin, range);
    if (!(reach > 0)) continue;
    if (!(squared_distance(chunk.box, box(to)) < reach * reach)) continue;
    if (!tree_.is_near(to, chunk.box, reach * reach)) continue;
    for (Index i = chunk.first; i < chunk.last; ++i) {
      const Index v = chunk_vertex_[at(i)];
      const double bound = std::min(best[at(v)].cost - least_skin, range);
      if (!(bound > 0)) continue;
      Contact made;
      if (contact_of(v, to, bound, hint, made) && made.cost < best[at(v)].cost) best[at(v)] = made;
    }
  }
}

}  // namespace hf_inner::mesh
