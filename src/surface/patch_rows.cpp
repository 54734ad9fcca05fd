#include "surface/patch_rows.h"

#include <algorithm>
#include <cmath>

#include "base/differences.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/delaunay_patches.h"

namespace hf_inner::surface {
namespace {

// Rings of triangles around a patch that are looked at first. Delaunay patches take two rings of their own; with fewer
// than four most edits look twice, with more each costs more.
constexpr int first_rings = 4;
// Entries of two rows that differ by less than this share of the diagonal differ by the order of a sum alone.
constexpr double same_share = 1e-12;
// The share of a mesh up to which more rings are taken; beyond it the whole operator costs less. Meshes below the
// second number are small enough to be taken whole.
constexpr Index largest_share = 4, always_whole = 4096;

// The neighbourhood of a patch as two small meshes with one numbering.
class Neighbourhood {
 public:
  Neighbourhood(const Core& plain, const Geometry& after, PatchRows& out)
      : plain_(plain),
        after_(after),
        out_(out),
        memory_(*plain.memory),
        gone_(&memory_),
        added_(&memory_),
        touched_(&memory_),
        local_(plain.mesh.positions.size(), mesh::Mesh::none, &memory_),
        vertices_(&memory_),
        fresh_(&memory_),
        inside_(&memory_),
        all_(&memory_),
        old_k_(memory_),
        new_k_(memory_) {
    find_changes();
  }

  // Returns false if the rows are not local.
  bool find_rows() {
    for (int rings = first_rings;; rings *= 2) {
      poll();
      const bool whole = take_rings(rings);
      make_operators();
      if (compare()) break;
      const auto limit = static_cast<std::size_t>(std::max(plain_.size() / largest_share, always_whole));
      if (whole || vertices_.size() > limit) return false;
    }
    write_rows();
    return true;
  }

 private:
  void find_changes() {
    const auto &before = plain_.mesh.triangle_of_given, &now = after_.mesh.triangle_of_given;
    Vector<Index>& touched = touched_;
    const auto take = [&](std::size_t g) {
      const Index t = g < before.size() ? before[g] : mesh::Mesh::none;
      if ((t == mesh::Mesh::none) == (now[g] == mesh::Mesh::none)) return;
      if (t == mesh::Mesh::none) return take_added(now[g]);
      gone_.push_back(t);
      touched.insert(touched.end(), plain_.mesh.triangle(t), plain_.mesh.triangle(t) + 3);
    };
    for_differences(before.data(), now.data(), std::min(before.size(), now.size()), take);
    for (std::size_t g = before.size(); g < now.size(); ++g) take(g);
    for (std::size_t i = plain_.mesh.cuts.size(); i < after_.mesh.cuts.size(); ++i) {
      const std::size_t g = at(after_.mesh.cuts[i].triangle);
      if (g >= before.size() || before[g] == mesh::Mesh::none || now[g] == mesh::Mesh::none) continue;
      gone_.push_back(before[g]);
      touched.insert(touched.end(), plain_.mesh.triangle(before[g]), plain_.mesh.triangle(before[g]) + 3);
      take_added(now[g]);
    }
    for (Vector<Index>* list : {&touched_, &fresh_, &gone_, &added_}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }

  void take_added(Index t) {
    added_.push_back(t);
    for (int k = 0; k < 3; ++k) {
      const Index v = after_.mesh.triangle(t)[k], u = out_.map.from(v);
      (u == mesh::Mesh::none ? fresh_ : touched_).push_back(u == mesh::Mesh::none ? v : u);
    }
  }

  // Numbers the vertices within some rings, ascending, and counts their triangles. Returns whether that is every
  // vertex.
  bool take_rings(int rings) {
    const SymmetricMatrix& k = plain_.laplacian;
    std::fill(local_.begin(), local_.end(), mesh::Mesh::none);
    vertices_.assign(touched_.begin(), touched_.end());
    for (const Index v : vertices_) local_[at(v)] = 0;
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = vertices_.size();
      for (; begin < end; ++begin) {
        const Index v = vertices_[begin];
        for (Index i = k.column_start[at(v)]; i < k.column_start[at(v) + 1]; ++i) {
          if (local_[at(k.row[at(i)])] != mesh::Mesh::none) continue;
          local_[at(k.row[at(i)])] = 0;
          vertices_.push_back(k.row[at(i)]);
        }
      }
    }
    const bool whole = begin == vertices_.size() && vertices_.size() == plain_.mesh.positions.size();
    std::sort(vertices_.begin(), vertices_.end());
    for (std::size_t i = 0; i < vertices_.size(); ++i) local_[at(vertices_[i])] = static_cast<Index>(i);
    return whole;
  }

  // The triangles with a corner in the neighbourhood, ascending.
  Vector<Index> triangles_near() const {
    const mesh::Topology* const topology = plain_.geometry->known_topology();
    Vector<Index> out(&memory_);
    for (std::size_t i = 0; topology && i < vertices_.size(); ++i) topology->triangles_at(vertices_[i], out);
    for (Index t = 0; !topology && t < plain_.mesh.triangle_count(); ++t) {
      const Index* const v = plain_.mesh.triangle(t);
      if (std::any_of(v, v + 3, [&](Index u) { return local_[at(u)] != mesh::Mesh::none; })) out.push_back(t);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  void make_operators() {
    const mesh::Mesh& mesh = plain_.mesh;
    mesh::Mesh old_mesh(memory_), new_mesh(memory_);
    Vector<Vec3> positions(&memory_);
    for (const Index v : vertices_) positions.push_back(mesh.positions[at(v)]);
    old_mesh.positions.assign(positions.begin(), positions.end());
    for (const Index v : fresh_) positions.push_back(after_.mesh.positions[at(v)]);
    new_mesh.positions = std::move(positions);
    Vector<Index> old_corners(&memory_), new_corners(&memory_);
    inside_.assign(vertices_.size(), 0);
    all_.assign(vertices_.size(), 0);
    for (const Index t : triangles_near()) {
      const Index* const corner = mesh.triangle(t);
      const bool leaves = std::binary_search(gone_.begin(), gone_.end(), t);
      const Index v[3] = {local_[at(corner[0])], local_[at(corner[1])], local_[at(corner[2])]};
      const bool is_inside = v[0] != mesh::Mesh::none && v[1] != mesh::Mesh::none && v[2] != mesh::Mesh::none;
      for (const Index u : v) {
        if (u == mesh::Mesh::none) continue;
        ++all_[at(u)];
        inside_[at(u)] += is_inside;
      }
      if (!is_inside) continue;
      old_corners.insert(old_corners.end(), v, v + 3);
      if (!leaves) new_corners.insert(new_corners.end(), v, v + 3);
    }
    for (const Index t : added_) {
      for (int k = 0; k < 3; ++k) {
        const Index v = after_.mesh.triangle(t)[k], u = out_.map.from(v);
        const auto there = std::lower_bound(fresh_.begin(), fresh_.end(), v);
        new_corners.push_back(u != mesh::Mesh::none
                                  ? local_[at(u)]
                                  : static_cast<Index>(vertices_.size()) + static_cast<Index>(there - fresh_.begin()));
      }
    }
    old_mesh.corners = std::move(old_corners);
    new_mesh.corners = std::move(new_corners);
    old_k_ = operator_of(old_mesh);
    new_k_ = operator_of(new_mesh);
  }

  SymmetricMatrix operator_of(mesh::Mesh& mesh) {
    mesh.component.assign(mesh.positions.size(), 0);
    mesh.report.component_count = 1;
    mesh::measure_triangles(mesh, mesh.report, nullptr, memory_);
    const mesh::Topology topology = mesh::Topology::make(mesh, memory_);
    const bool delaunay = after_.operator_kind == mesh::OperatorKind::intrinsic_delaunay;
    const Vector<double> weights =
        mesh::edge_weights(mesh, topology, delaunay ? mesh::OperatorKind::cotangent : after_.operator_kind, memory_);
    if (!delaunay) return mesh::laplacian(topology, weights, memory_);
    return std::move(mesh::delaunay_operator(mesh, topology, weights, false, memory_).laplacian);
  }

  // A row of one of the two operators. The old one has no rows for new vertices.
  struct Row {
    const Index* column = nullptr;
    const double* value = nullptr;
    Index size = 0;
  };
  static Row row_of(const SymmetricMatrix& k, Index v) noexcept {
    if (v >= k.size()) return {};
    const std::size_t begin = at(k.column_start[at(v)]);
    return {k.row.data() + begin, k.value.data() + begin, k.column_start[at(v) + 1] - k.column_start[at(v)]};
  }
  static double largest_of(const Row& row) noexcept {
    double most = 0;
    for (Index i = 0; i < row.size; ++i) most = std::max(most, std::fabs(row.value[i]));
    return most;
  }
  static bool same(const Row& a, const Row& b) noexcept {
    const double most = same_share * std::max(largest_of(a), largest_of(b));
    for (Index i = 0, j = 0; i < a.size || j < b.size;) {
      const bool left = j == b.size || (i < a.size && a.column[i] <= b.column[j]);
      const bool right = i == a.size || (j < b.size && b.column[j] <= a.column[i]);
      if (!(std::fabs((left ? a.value[i] : 0.0) - (right ? b.value[j] : 0.0)) <= most)) return false;
      i += left;
      j += right;
    }
    return true;
  }
  // Whether the surface before has the row that the old triangles of the neighbourhood give.
  bool is_known(Index v) const noexcept {
    const Row own = row_of(old_k_, v), there = row_of(plain_.laplacian, vertices_[at(v)]);
    const double most = same_share * std::max(largest_of(own), largest_of(there));
    Index i = 0;
    for (Index j = 0; j < there.size; ++j) {
      const Index u = local_[at(there.column[j])];
      for (; i < own.size && u != mesh::Mesh::none && own.column[i] < u; ++i)
        if (!(std::fabs(own.value[i]) <= most)) return false;
      const bool both = i < own.size && own.column[i] == u;
      if (!(std::fabs(there.value[j] - (both ? own.value[i] : 0.0)) <= most)) return false;
      i += both;
    }
    for (; i < own.size; ++i)
      if (!(std::fabs(own.value[i]) <= most)) return false;
    return true;
  }

  // Finds the rows that differ. Returns false if more rings are needed.
  bool compare() {
    const std::size_t old_count = vertices_.size(), count = old_count + fresh_.size();
    differs_.assign(count, 1);
    for (std::size_t v = 0; v < old_count; ++v)
      differs_[v] = !same(row_of(old_k_, static_cast<Index>(v)), row_of(new_k_, static_cast<Index>(v)));
    for (const Index v : touched_) differs_[at(local_[at(v)])] = 1;
    Vector<std::uint8_t> tested(count, 0, &memory_);
    const auto test = [&](Index v) {
      if (at(v) >= old_count || tested[at(v)]) return true;
      tested[at(v)] = 1;
      return inside_[at(v)] == all_[at(v)] && is_known(v);
    };
    for (std::size_t v = 0; v < count; ++v) {
      if (!differs_[v]) continue;
      for (const SymmetricMatrix* k : {&old_k_, &new_k_}) {
        const Row row = row_of(*k, static_cast<Index>(v));
        for (Index i = 0; i < row.size; ++i)
          if (!test(row.column[i])) return false;
      }
    }
    return true;
  }

  Index number_after(Index v) const noexcept {
    return at(v) < vertices_.size() ? out_.map.to(vertices_[at(v)]) : fresh_[at(v) - vertices_.size()];
  }

  // Entries between two rows that differ are new. Other entries stay as before, so the matrix stays
  // symmetric to the bit.
  void write_rows() {
    struct Entry {
      Index column;
      double value;
      bool operator<(const Entry& o) const noexcept { return column < o.column; }
    };
    Vector<Index> order(&memory_);
    for (std::size_t v = 0; v < differs_.size(); ++v)
      if (differs_[v] && number_after(static_cast<Index>(v)) != mesh::Mesh::none)
        order.push_back(static_cast<Index>(v));
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return number_after(a) < number_after(b); });
    Vector<Entry> row(&memory_);
    for (const Index v : order) {
      row.clear();
      const Row now = row_of(new_k_, v);
      for (Index i = 0; i < now.size; ++i) {
        const Index u = now.column[i];
        if (u != v && differs_[at(u)]) row.push_back({number_after(u), now.value[i]});
      }
      if (at(v) < vertices_.size()) {
        const Row before = row_of(plain_.laplacian, vertices_[at(v)]);
        for (Index i = 0; i < before.size; ++i) {
          const Index u = local_[at(before.column[i])];
          if (u == mesh::Mesh::none || !differs_[at(u)])
            row.push_back({out_.map.to(before.column[i]), before.value[i]});
        }
      }
      double sum = 0;
      for (const Entry& entry : row) sum -= entry.value;
      row.push_back({number_after(v), sum});
      std::sort(row.begin(), row.end());
      out_.vertex.push_back(number_after(v));
      for (const Entry& entry : row) {
        out_.column.push_back(entry.column);
        out_.value.push_back(entry.value);
      }
      out_.start.push_back(static_cast<Index>(out_.column.size()));
    }
  }

  const Core& plain_;
  const Geometry& after_;
  PatchRows& out_;
  Memory& memory_;
  Vector<Index> gone_, added_;  // triangles before and after
  Vector<Index> touched_;       // vertices before with other triangles, ascending
  Vector<Index> local_;         // by vertex before: its number in the neighbourhood, or none
  Vector<Index> vertices_;      // before, by number in the neighbourhood
  Vector<Index> fresh_;         // new vertices, after; they follow
  Vector<Index> inside_, all_;  // triangles of a vertex: in the neighbourhood, and in the mesh
  Vector<std::uint8_t> differs_{&memory_};
  SymmetricMatrix old_k_, new_k_;
};

}  // namespace

std::shared_ptr<const PatchRows> PatchRows::make(const Core& plain, const Geometry& after) {
  if (after.operator_kind == mesh::OperatorKind::clamped) return nullptr;
  const auto made = make_shared_in<PatchRows>(*plain.memory, plain.mesh, after.mesh, *plain.memory);
  if (!Neighbourhood(plain, after, *made).find_rows()) return nullptr;
  return made;
}

Index PatchRows::find(Index v) const noexcept {
  const auto there = std::lower_bound(vertex.begin(), vertex.end(), v);
  return there != vertex.end() && *there == v ? static_cast<Index>(there - vertex.begin()) : -1;
}

double PatchRows::diagonal(Index i) const noexcept {
  const auto end = column.begin() + start[at(i) + 1];
  return value[static_cast<std::size_t>(std::lower_bound(column.begin() + start[at(i)], end, vertex[at(i)]) -
                                        column.begin())];
}

}  // namespace hf_inner::surface
