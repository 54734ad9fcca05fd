#include "mesh/delaunay_patches.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"
#include "mesh/laplacian.h"
#include "mesh/mollify.h"

namespace hf_inner::mesh {
namespace {

// Number of triangles or edges that one thread's job takes. Half and twice the value take the same time within 10 %,
// the noise of the measurement (two threads). No result depends on this number.
constexpr std::size_t patch_piece = 16384;
// Only patches (groups of triangles around edges that are not Delaunay) are retriangulated. After this many attempts to
// grow them, the whole mesh becomes one patch. It bounds the cost; no result depends on it. Half and double change no
// bit on eight shapes with needles, loose pieces and a long ribbon.
constexpr int most_attempts = 4;
// A patch (group of triangles to retriangulate) is an edge that is not Delaunay with this many rings of triangles
// around it. More rings make larger patches but fewer attempts. No result depends on it. With 1 fields on a cylinder
// move by 1e-13 of their range, by rounding; with 4 no bit changes on eight shapes.
constexpr int patch_rings = 2;
// If the patches (groups of triangles to retriangulate) hold more than 1 / patch_share of the mesh, the whole mesh
// becomes one patch. It bounds the cost; no result depends on it. With 2 fields on a cylinder move by 8e-13 of their
// range, by rounding; with 8 no bit changes on eight shapes.
constexpr std::size_t patch_share = 4;
// An edge is not Delaunay if its weight, half of a sum of two cotangents, is below minus this number.
constexpr double rounding = 0.5 * delaunay_rounding;

std::uint32_t pieces_of(std::size_t count) noexcept {
  return static_cast<std::uint32_t>((count + patch_piece - 1) / patch_piece);
}

struct Thinness {
  bool any = false;      // a triangle may be so thin that the triangulation would lengthen its edges; on the safe side
  bool widened = false;  // the cotangents of one are not its own either
};

Thinness find_thin(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs) {
  const std::size_t triangles = at(mesh.triangle_count());
  Vector<ThinCheck> checks(pieces_of(triangles), &memory);
  for_each(jobs, pieces_of(triangles), [&](std::uint32_t p) {
    ThinCheck own;
    for (std::size_t t = p * patch_piece; t < std::min(triangles, (p + std::size_t{1}) * patch_piece); ++t) {
      const Index* v = mesh.triangle(static_cast<Index>(t));
      const Vec3 a = mesh.positions[at(v[0])], b = mesh.positions[at(v[1])], c = mesh.positions[at(v[2])];
      own.add(norm(b - a), norm(c - b), norm(a - c));
    }
    checks[p] = own;
  });
  ThinCheck all;
  for (const ThinCheck& own : checks) all.add(own);
  Thinness thin;
  thin.any = all.may_be_thin(topology.edge_count());
  for (Index t = 0; thin.any && !thin.widened && t < mesh.triangle_count(); ++t) thin.widened = is_widened(mesh, t);
  return thin;
}

double cotangent_opposite(const Mesh& mesh, Index triangle, Index first, Index second) noexcept {
  double cotangent[3];
  corner_cotangents(mesh, triangle, cotangent);
  const Index* v = mesh.triangle(triangle);
  for (int k = 0; k < 3; ++k) {
    if (v[k] != first && v[k] != second) return cotangent[k];
  }
  return 0;
}

// Lists the edges of the given mesh that are not Delaunay. An edge of three or more triangles counts as soon as one
// opposite angle is obtuse. Which of its triangles become neighbours is known only later.
Vector<Index> broken_edges(const Mesh& mesh, const Topology& topology, const Vector<double>& weights, Memory& memory,
                           JobRunner* jobs) {
  Vector<Vector<Index>> lists(pieces_of(weights.size()), &memory);
  for_each(jobs, pieces_of(weights.size()), [&](std::uint32_t p) {
    for (std::size_t e = p * patch_piece; e < std::min(weights.size(), (p + std::size_t{1}) * patch_piece); ++e) {
      const Index begin = topology.edge_triangle_start[e], end = topology.edge_triangle_start[e + 1];
      bool broken = weights[e] < -rounding;
      for (Index i = begin; end - begin > 2 && i < end && !broken; ++i)
        broken = cotangent_opposite(mesh, topology.triangle(i), topology.first(static_cast<Index>(e)),
                                    topology.second(static_cast<Index>(e))) < -rounding;
      if (broken) lists[p].push_back(static_cast<Index>(e));
    }
  });
  Vector<Index> all(&memory);
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

// The triangles around edges that are not Delaunay (patches), their vertices, and their intrinsic triangulation.
class Patches {
 public:
  Patches(const Mesh& mesh, const Topology& topology, Memory& memory)
      : mesh_(mesh),
        topology_(topology),
        memory_(memory),
        in_patch_(at(mesh.triangle_count()), 0, &memory),
        local_(mesh.positions.size(), Mesh::none, &memory),
        triangles_(&memory),
        vertices_(&memory),
        sub_(memory),
        edges_(memory),
        surface_(memory) {}

  // Adds two rings of triangles around these edges to the patches (groups of triangles to retriangulate). Returns false
  // if they then hold a quarter of the mesh or more.
  bool grow(const Vector<Index>& edges) {
    for (const Index e : edges) take_edge(e);
    for (int ring = 0; ring < patch_rings; ++ring) {
      const std::size_t count = triangles_.size();
      for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) take_ring(mesh_.triangle(triangles_[i])[k]);
        if (patch_share * triangles_.size() > in_patch_.size()) return false;
      }
    }
    // Takes all triangles of an edge of three and more, so that such an edge is never on the border of a patch.
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const Index* v = mesh_.triangle(triangles_[i]);
      for (int k = 0; k < 3; ++k) {
        const Index e = edge_between(v[k], v[(k + 1) % 3]);
        if (topology_.edge_triangle_start[at(e) + 1] - topology_.edge_triangle_start[at(e)] > 2) take_edge(e);
      }
    }
    return patch_share * triangles_.size() <= in_patch_.size();
  }

  void triangulate(JobRunner* jobs) {
    number_vertices();
    find_components();
    edges_ = Topology::make(sub_, memory_, jobs);
    Vector<std::uint8_t> held(at(edges_.edge_count()), 0, &memory_);
    for (Index e = 0; e < edges_.edge_count(); ++e) {
      const Index whole = edge_between(vertices_[at(edges_.first(e))], vertices_[at(edges_.second(e))]);
      held[at(e)] = edges_.edge_triangle_start[at(e) + 1] - edges_.edge_triangle_start[at(e)] <
                    topology_.edge_triangle_start[at(whole) + 1] - topology_.edge_triangle_start[at(whole)];
    }
    surface_ = IntrinsicTriangulation::make(sub_, edges_, memory_, jobs, &held);
    surface_.flip_to_delaunay(0, jobs);
  }

  // Lists those border edges of the patches (groups of retriangulated triangles) that are not Delaunay together with
  // the triangle outside, by the mesh's numbers.
  Vector<Index> broken_border() const {
    Vector<Index> broken(&memory_);
    for (Index h = 0; h < 3 * surface_.face_count(); ++h) {
      if (surface_.twin(h) != h) continue;
      const Index i = vertices_[at(surface_.tail(h))], j = vertices_[at(surface_.head(h))], e = edge_between(i, j);
      if (surface_.cotangent(h) + outer_cotangent(e) < -2 * rounding) broken.push_back(e);
    }
    return broken;
  }

  std::size_t triangle_count() const noexcept { return triangles_.size(); }
  bool holds(Index triangle) const noexcept { return in_patch_[at(triangle)] != 0; }
  Index local(Index vertex) const noexcept { return local_[at(vertex)]; }
  const Vector<Index>& vertices() const noexcept { return vertices_; }
  const IntrinsicTriangulation& surface() const noexcept { return surface_; }
  Vector<double> areas() const { return surface_.vertex_areas(sub_, edges_, memory_); }

  // Returns half the sum of the cotangents in the edge's triangles outside the patches (groups of retriangulated
  // triangles). Sets `count` to the number of these triangles.
  double outer_weight(Index e, const Vector<double>& weights, Index& count) const noexcept {
    count = 0;
    const Index begin = topology_.edge_triangle_start[at(e)], end = topology_.edge_triangle_start[at(e) + 1];
    for (Index i = begin; i < end; ++i) count += !holds(topology_.triangle(i));
    return count == end - begin ? weights[at(e)] : 0.5 * outer_cotangent(e);
  }

 private:
  double outer_cotangent(Index e) const noexcept {
    double sum = 0;
    for (Index i = topology_.edge_triangle_start[at(e)]; i < topology_.edge_triangle_start[at(e) + 1]; ++i) {
      const Index t = topology_.triangle(i);
      if (!holds(t)) sum += cotangent_opposite(mesh_, t, topology_.first(e), topology_.second(e));
    }
    return sum;
  }

  Index edge_between(Index a, Index b) const noexcept { return topology_.edge_between(a, b); }

  void take_edge(Index e) {
    for (Index i = topology_.edge_triangle_start[at(e)]; i < topology_.edge_triangle_start[at(e) + 1]; ++i) {
      const Index t = topology_.triangle(i);
      if (holds(t)) continue;
      in_patch_[at(t)] = 1;
      triangles_.push_back(t);
    }
  }
  void take_ring(Index vertex) {
    for (Index i = topology_.neighbour_start[at(vertex)]; i < topology_.neighbour_start[at(vertex) + 1]; ++i)
      take_edge(topology_.neighbour_edge[at(i)]);
  }

  void number_vertices() {
    std::sort(triangles_.begin(), triangles_.end());
    for (const Index v : vertices_) local_[at(v)] = Mesh::none;
    vertices_.clear();
    sub_.positions.clear();
    sub_.corners.clear();
    for (const Index t : triangles_) {
      for (int k = 0; k < 3; ++k) {
        const Index v = mesh_.triangle(t)[k];
        if (local_[at(v)] == Mesh::none) {
          local_[at(v)] = static_cast<Index>(vertices_.size());
          vertices_.push_back(v);
          sub_.positions.push_back(mesh_.positions[at(v)]);
        }
        sub_.corners.push_back(local_[at(v)]);
      }
    }
  }

  void find_components() {
    SharedVector<Index>& root = sub_.component;
    root.resize(vertices_.size());
    for (std::size_t v = 0; v < root.size(); ++v) root[v] = static_cast<Index>(v);
    const auto find = [&](Index v) {
      while (root[at(v)] != v) v = root[at(v)] = root[at(root[at(v)])];
      return v;
    };
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      for (std::size_t k = 1; k < 3; ++k) {
        const Index a = find(sub_.corners[3 * t]), b = find(sub_.corners[3 * t + k]);
        root[at(std::max(a, b))] = std::min(a, b);  // the root is the smallest number of its set
      }
    }
    Index count = 0;
    for (std::size_t v = 0; v < root.size(); ++v)
      root[v] = root[v] == static_cast<Index>(v) ? count++ : root[at(root[v])];
    sub_.report.component_count = static_cast<std::uint32_t>(count);
  }

  const Mesh& mesh_;
  const Topology& topology_;
  Memory& memory_;
  Vector<std::uint8_t> in_patch_;  // by triangle of the mesh: 1 if it is in a patch (retriangulated group)
  Vector<Index> local_;            // by vertex of the mesh: its number in the patches, or none
  Vector<Index> triangles_, vertices_;
  Mesh sub_;
  Topology edges_;
  IntrinsicTriangulation surface_;
};

// The matrix rows of the vertices in patches (groups of retriangulated triangles). Each entry is a sum of weights that
// edges contribute.
class PatchRows {
 public:
  struct Entry {
    Index column, key;  // by column, then in an order that is the same seen from both ends
    double weight;
    bool operator<(const Entry& o) const noexcept { return column != o.column ? column < o.column : key < o.key; }
  };

  PatchRows(const Patches& patches, const Topology& topology, const Vector<double>& weights, Memory& memory)
      : start_(patches.vertices().size() + 1, 0, &memory), end_(&memory), entries_(&memory) {
    const auto each = [&](auto&& put) {
      for (std::size_t i = 0; i < patches.vertices().size(); ++i) {
        const Index v = patches.vertices()[i];
        for (Index k = topology.neighbour_start[at(v)]; k < topology.neighbour_start[at(v) + 1]; ++k) {
          Index outside = 0;
          const double weight = patches.outer_weight(topology.neighbour_edge[at(k)], weights, outside);
          if (outside > 0) put(i, Entry{topology.neighbour[at(k)], -1, weight});
        }
      }
      const IntrinsicTriangulation& surface = patches.surface();
      for (Index h = 0; h < 3 * surface.face_count(); ++h) {
        const Index i = surface.tail(h), j = surface.head(h);
        if (i == j) continue;
        const double weight = 0.5 * surface.share(h / 3) * surface.cotangent(h);
        put(at(i), Entry{patches.vertices()[at(j)], h, weight});
        put(at(j), Entry{patches.vertices()[at(i)], h, weight});
      }
    };
    each([&](std::size_t i, const Entry&) { ++start_[i + 1]; });
    for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
    entries_.resize(start_.back());
    end_.assign(start_.begin(), start_.end() - 1);
    each([&](std::size_t i, const Entry& entry) { entries_[end_[i]++] = entry; });
    for (std::size_t i = 0; i + 1 < start_.size(); ++i) {
      Entry *const begin = entries_.data() + start_[i], *const end = entries_.data() + start_[i + 1], *last = begin;
      std::sort(begin, end);
      for (Entry* entry = begin; entry != end; ++entry) {
        if (entry == begin) continue;
        if (entry->column == last->column) {
          last->weight += entry->weight;
        } else {
          *++last = *entry;
        }
      }
      end_[i] = begin == end ? start_[i] : static_cast<std::size_t>(last + 1 - entries_.data());
    }
  }
  Span<const Entry> row(Index local) const noexcept {
    return {entries_.data() + start_[at(local)], end_[at(local)] - start_[at(local)]};
  }

 private:
  Vector<std::size_t> start_, end_;
  Vector<Entry> entries_;
};

SymmetricMatrix assemble(const Patches& patches, const PatchRows& rows, const Topology& topology,
                         const Vector<double>& weights, std::size_t n, Memory& memory, JobRunner* jobs) {
  SymmetricMatrix matrix(memory);
  matrix.column_start.assign(n + 1, 0);
  for (std::size_t v = 0; v < n; ++v) {
    const Index local = patches.local(static_cast<Index>(v));
    const Index length = local == Mesh::none ? topology.neighbour_start[v + 1] - topology.neighbour_start[v]
                                             : static_cast<Index>(rows.row(local).size());
    matrix.column_start[v + 1] = matrix.column_start[v] + length + 1;
  }
  matrix.row.resize(at(matrix.column_start[n]));
  matrix.value.resize(at(matrix.column_start[n]));
  for_each(jobs, pieces_of(n), [&](std::uint32_t p) {
    for (std::size_t v = p * patch_piece; v < std::min(n, (p + std::size_t{1}) * patch_piece); ++v) {
      std::size_t to = at(matrix.column_start[v]), diagonal = 0;
      double sum = 0;
      bool placed = false;
      const auto place = [&] {
        diagonal = to;
        matrix.row[to++] = static_cast<Index>(v);
        placed = true;
      };
      const auto put = [&](Index column, double weight) {
        if (!placed && at(column) > v) place();
        const double w = std::max(weight, 0.0);
        matrix.row[to] = column;
        matrix.value[to++] = -w;
        sum += w;
      };
      const Index local = patches.local(static_cast<Index>(v));
      if (local == Mesh::none) {
        for (Index i = topology.neighbour_start[v]; i < topology.neighbour_start[v + 1]; ++i)
          put(topology.neighbour[at(i)], weights[at(topology.neighbour_edge[at(i)])]);
      } else {
        for (const PatchRows::Entry& entry : rows.row(local)) put(entry.column, entry.weight);
      }
      if (!placed) place();
      matrix.value[diagonal] = sum;
    }
  });
  return matrix;
}

void add_areas(const Mesh& mesh, const Patches& patches, Vector<double>& areas) {
  areas.assign(mesh.positions.size(), 0.0);
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    if (patches.holds(t)) continue;
    const Index* v = mesh.triangle(t);
    const Vec3 a = mesh.positions[at(v[0])];
    const double third = norm(cross(mesh.positions[at(v[1])] - a, mesh.positions[at(v[2])] - a)) / 6.0;
    for (int k = 0; k < 3; ++k) areas[at(v[k])] += third;
  }
  const Vector<double> inside = patches.areas();
  for (Index i = 0; i < static_cast<Index>(inside.size()); ++i) areas[at(patches.vertices()[at(i)])] += inside[at(i)];
}

}  // namespace

DelaunayOperator delaunay_operator(const Mesh& mesh, const Topology& topology, const Vector<double>& weights,
                                   bool with_areas, Memory& memory, JobRunner* jobs) {
  DelaunayOperator out(memory);
  {
    Patches patches(mesh, topology, memory);
    Vector<Index> broken = broken_edges(mesh, topology, weights, memory, jobs);
    bool whole = !broken.empty() && !patches.grow(broken);
    if (!whole) {
      // thin triangles that are Delaunay as they stand keep their cotangents
      const Thinness thin = find_thin(mesh, topology, memory, jobs);
      whole = thin.widened || (thin.any && !broken.empty());
    }
    for (int attempt = 1; !broken.empty() && !whole; ++attempt) {
      patches.triangulate(jobs);
      broken = patches.broken_border();
      whole = !broken.empty() && (attempt == most_attempts || !patches.grow(broken));
    }
    if (!whole) {
      const PatchRows rows(patches, topology, weights, memory);
      out.laplacian = assemble(patches, rows, topology, weights, mesh.positions.size(), memory, jobs);
      if (with_areas) add_areas(mesh, patches, out.areas);
      out.patch_triangles = static_cast<Index>(patches.triangle_count());
      return out;
    }
  }
  IntrinsicTriangulation surface = IntrinsicTriangulation::make(mesh, topology, memory, jobs);
  surface.flip_to_delaunay(0, jobs);
  out.laplacian = surface.laplacian(mesh.vertex_count(), memory, jobs);
  if (with_areas) out.areas = surface.vertex_areas(mesh, topology, memory);
  out.changed.assign(surface.changed().begin(), surface.changed().end());
  out.patch_triangles = mesh.triangle_count();
  return out;
}

}  // namespace hf_inner::mesh
