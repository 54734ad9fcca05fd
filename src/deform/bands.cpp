#include "deform/bands.h"

#include <algorithm>
#include <cmath>

#include "deform/cluster_rows.h"

namespace hf_inner {
namespace {

// Finds the handles' fields that are cut into level bands. With two handles in a component it is the second handle's
// field. With more it is every field, with one none.
Vector<FieldPart> find_parts(const Mesh& mesh, const Reach& reach, Memory& memory) {
  Vector<FieldPart> parts(&memory);
  for (std::int32_t c = 0; c < mesh.component_count(); ++c) {
    const Span<const std::int32_t> present = reach.handles_of(c);
    if (present.size() == 2) parts.push_back({c, present[1]});
    if (present.size() > 2) {
      for (const std::int32_t i : present) parts.push_back({c, i});
    }
  }
  return parts;
}

// Union-find over vertices whose representative is the smallest member. So results do not depend on the order of
// unions.
struct Partition {
  Vector<std::int32_t> parent;
  Partition(std::size_t size, Memory& memory) : parent(size, 0, &memory) {}
  std::int32_t find(std::int32_t x) noexcept {
    while (parent[x] != x) x = parent[x] = parent[parent[x]];
    return x;
  }
  void join(std::int32_t a, std::int32_t b) noexcept {
    if (parent[a] == parent[b]) return;  // most pairs
    a = find(a), b = find(b);
    if (a < b) parent[b] = a;
    if (b < a) parent[a] = b;
  }
};

// Cuts the handles' fields, one after the other, into clusters (pieces of overlapping level bands). It collects entries
// (vertex, cluster, weight) in one list per vertex_piece vertices. Threads share these pieces. One thread joins the
// edges between pieces.
class BandCutter {
 public:
  BandCutter(const Core& core, const Rest& rest, const Reach& reach, const HandleFields& fields,
             const BandOptions& options, Memory& memory)
      : core_(core),
        rest_(rest),
        reach_(reach),
        fields_(fields),
        options_(options),
        memory_(memory),
        entries_((core.size() + vertex_piece - 1) / vertex_piece, &memory),
        partition_(3 * static_cast<std::size_t>(core.size()), memory),
        values_(memory, core.size()),
        share_(memory, core.size()),
        floor_(memory, core.size()),
        piece_area_(memory, 3 * static_cast<std::size_t>(core.size())),
        piece_cluster_(memory, 3 * static_cast<std::size_t>(core.size())),
        roots_(&memory),
        others_(core.size(), 0.0, &memory) {}

  // Forgets all entries (vertex, cluster, weight). The first new cluster gets the number first_cluster.
  void begin(std::int32_t first_cluster) noexcept {
    for (auto& list : entries_) list.clear();
    next_cluster_ = first_cluster;
  }
  // Cuts one handle's field on one component into level bands. It drops connected pieces of bands with less than the
  // share `smallest` of the component's area.
  void cut(const FieldPart& part, const Levels& levels, double smallest);
  // Gives each handle its share of the first level band, for all fields of a component.
  void finish_component(std::int32_t component);

  // One list of cluster weights per vertex_piece vertices. The entries of a vertex keep the order in which they were
  // added.
  const Vector<Vector<ClusterEntry>>& entries() const noexcept { return entries_; }
  std::int32_t cluster_count() const noexcept { return next_cluster_; }

 private:
  struct Root {
    std::int32_t index, band;
  };
  template <class Loop>
  void in_pieces(Span<const std::int32_t> vertices, Loop&& loop);
  void find_floor(const FieldPart& part) noexcept;
  void evaluate(const FieldPart& part, const Levels& levels, Span<const std::int32_t> vertices) noexcept;
  void join_edge(std::int32_t v, std::int32_t u) noexcept;
  void join_inside(Span<const std::int32_t> vertices) noexcept;
  void join_across(Span<const std::int32_t> vertices) noexcept;
  void number_pieces(Span<const std::int32_t> vertices, double smallest);
  void emit(const FieldPart& part, Span<const std::int32_t> vertices, Vector<ClusterEntry>& entries);
  bool interior(std::int32_t band) const noexcept { return band > 0 && band <= options_.band_count; }

  const Core& core_;
  const Rest& rest_;
  const Reach& reach_;
  const HandleFields& fields_;
  const BandOptions& options_;
  Memory& memory_;
  Vector<Vector<ClusterEntry>> entries_;
  std::int32_t next_cluster_ = 0;
  // These arrays are scratch memory for the field that is being cut into level bands. They have one entry per vertex,
  // or three per vertex (one per band).
  Partition partition_;
  Buffer<BandValues> values_;
  Buffer<double> share_;        // share of the field at the vertex (beta)
  Buffer<double> floor_;        // smallest field value that makes bands at a vertex
  std::int32_t floor_of_ = -1;  // the component that floor_ belongs to
  Buffer<double> piece_area_;   // area of a connected piece, by the root of its partition
  Buffer<std::int32_t> piece_cluster_;
  Vector<Root> roots_;     // roots of the union-find partition, ascending
  Vector<double> others_;  // by vertex: sum over fields phi of share times B_0 / (1 - phi), B_0 the first band
};

// Splits an ascending vertex list into pieces, and calls loop(piece, its vertices). Long lists run on several threads.
template <class Loop>
void BandCutter::in_pieces(Span<const std::int32_t> vertices, Loop&& loop) {
  const std::int32_t *const begin = vertices.begin(), *const end = vertices.end();
  const auto part_from = [&](const std::int32_t* first, std::int32_t piece) {
    const std::int32_t* last = std::lower_bound(first, end, (piece + 1) * vertex_piece);
    loop(piece, Span<const std::int32_t>(first, static_cast<std::size_t>(last - first)));
    return last;
  };
  if (vertices.size() < 2 * static_cast<std::size_t>(vertex_piece)) {
    for (const std::int32_t* first = begin; first != end;) first = part_from(first, *first / vertex_piece);
    return;
  }
  const std::int32_t first_piece = *begin / vertex_piece, last_piece = *(end - 1) / vertex_piece;
  core_.jobs->for_each(static_cast<std::uint32_t>(last_piece - first_piece + 1), [&](std::uint32_t k) {
    const std::int32_t piece = first_piece + static_cast<std::int32_t>(k);
    part_from(std::lower_bound(begin, end, piece * vertex_piece), piece);
  });
}

// Computes the smallest field value that still makes bands at each vertex. It runs once per component with more than
// two handles.
void BandCutter::find_floor(const FieldPart& part) noexcept {
  const Span<const std::int32_t> present = reach_.handles_of(part.component);
  if (present.size() <= 2 || floor_of_ == part.component) return;
  const Span<const std::int32_t> vertices = rest_.vertices_of(part.component);
  for (const std::int32_t v : vertices) floor_[v] = 0;
  for (const std::int32_t j : present) {
    const double* field = fields_.of(j);
    for (const std::int32_t v : vertices) floor_[v] += field[v] * field[v];
  }
  for (const std::int32_t v : vertices) floor_[v] = field_prune * std::sqrt(floor_[v]);
  floor_of_ = part.component;
}

void BandCutter::evaluate(const FieldPart& part, const Levels& levels, Span<const std::int32_t> vertices) noexcept {
  const double* phi = fields_.of(part.handle);
  const bool several = reach_.handles_of(part.component).size() > 2, eased = several && options_.degree == 2;
  for (const std::int32_t v : vertices) {
    share_[v] = several ? std::max(0.0, phi[v] - floor_[v]) : 1.0;
    if (share_[v] <= 0) continue;  // this field does not count here
    const double level = levels(phi[v]);
    values_[v] =
        band_values(eased ? eased_level(level, options_.band_count) : level, options_.band_count, options_.degree);
  }
}

// Joins the two ends of an edge in every level band that contains both.
inline void BandCutter::join_edge(std::int32_t v, std::int32_t u) noexcept {
  if (share_[u] <= 0) return;
  const int width = options_.degree + 1;
  for (int a = 0; a < width; ++a) {
    const std::int32_t b = values_[v].first + a - values_[u].first;
    if (b < 0 || b >= width || values_[v].value[a] <= 0 || values_[u].value[b] <= 0) continue;
    if (interior(values_[v].first + a)) partition_.join(3 * v + a, 3 * u + b);
  }
}

// Joins all edges inside one piece of vertices. Neighbours are sorted, so each edge is handled once, from its larger
// end.
void BandCutter::join_inside(Span<const std::int32_t> vertices) noexcept {
  const Topology& topology = core_.topology;
  const std::int32_t first = vertices[0] / vertex_piece * vertex_piece;
  for (const std::int32_t v : vertices) {
    for (int k = 0; k < 3; ++k) partition_.parent[3 * v + k] = 3 * v + k;
    if (share_[v] <= 0) continue;
    for (std::int32_t k = topology.neighbour_start[v]; k < topology.neighbour_start[v + 1]; ++k) {
      const std::int32_t u = topology.neighbour[k];
      if (u > v) break;
      if (u >= first) join_edge(v, u);
    }
  }
}

void BandCutter::join_across(Span<const std::int32_t> vertices) noexcept {
  const Topology& topology = core_.topology;
  for (const std::int32_t v : vertices) {
    const std::int32_t first = v / vertex_piece * vertex_piece;
    std::int32_t k = topology.neighbour_start[v];
    const std::int32_t end = topology.neighbour_start[v + 1];
    if (k == end || topology.neighbour[k] >= first || share_[v] <= 0) continue;
    for (; k < end && topology.neighbour[k] < first; ++k) join_edge(v, topology.neighbour[k]);
  }
}

void BandCutter::number_pieces(Span<const std::int32_t> vertices, double smallest) {
  Vector<double> band_area(options_.band_count + 2, 0.0, &memory_), largest(options_.band_count + 2, 0.0, &memory_);
  const int width = options_.degree + 1;
  roots_.clear();
  for (const std::int32_t v : vertices) {
    if (share_[v] <= 0) continue;
    for (int a = 0; a < width; ++a) {
      const std::int32_t band = values_[v].first + a, own = 3 * v + a;
      if (!interior(band) || !(values_[v].value[a] > 0)) continue;
      // The root is the smallest member of its connected piece, so the loop has met it before.
      const std::int32_t root = partition_.parent[own] = partition_.parent[partition_.parent[own]];
      if (root == own) roots_.push_back({own, band}), piece_area_[own] = 0;
      const double area = share_[v] * values_[v].value[a] * rest_.area[v];
      piece_area_[root] += area, band_area[band] += area;
    }
  }
  for (const Root& root : roots_) largest[root.band] = std::max(largest[root.band], piece_area_[root.index]);
  for (const Root& root : roots_) {
    const double area = piece_area_[root.index];
    const bool dropped = area < smallest || (area < largest[root.band] && area < piece_share * band_area[root.band]);
    piece_cluster_[root.index] = dropped ? -1 : next_cluster_++;
  }
}

// Adds the weights of the vertices in clusters and in the handle itself. The first level band is only summed up here;
// finish_component gives it to all handles. The handle's own part of that band is therefore subtracted here.
void BandCutter::emit(const FieldPart& part, Span<const std::int32_t> vertices, Vector<ClusterEntry>& entries) {
  const double* phi = fields_.of(part.handle);
  const std::int32_t last = options_.band_count + 1;
  if (entries.empty()) entries.reserve(entries_a_vertex * vertices.size());
  for (const std::int32_t v : vertices) {
    if (share_[v] <= 0) continue;
    const BandValues& b = values_[v];
    for (int a = 0; a <= options_.degree; ++a) {
      if (!interior(b.first + a) || !(b.value[a] > 0)) continue;
      const std::int32_t cluster = piece_cluster_[partition_.parent[3 * v + a]];
      if (cluster >= 0) entries.push_back({v, cluster, share_[v] * b.value[a]});
    }
    const int top = last - b.first;
    double own = top <= options_.degree ? share_[v] * b.value[top] : 0.0;
    if (b.first == 0 && phi[v] < 1) {
      const double others = share_[v] * b.value[0] / (1.0 - phi[v]);
      others_[v] += others;
      own -= others * phi[v];
    }
    if (own != 0) entries.push_back({v, part.handle, own});
  }
}

void BandCutter::cut(const FieldPart& part, const Levels& levels, double smallest) {
  const Span<const std::int32_t> vertices = rest_.vertices_of(part.component);
  find_floor(part);
  in_pieces(vertices, [&](std::int32_t, Span<const std::int32_t> own) {
    evaluate(part, levels, own);
    join_inside(own);
  });
  join_across(vertices);
  number_pieces(vertices, smallest * rest_.component_area[part.component]);
  in_pieces(vertices, [&](std::int32_t piece, Span<const std::int32_t> own) { emit(part, own, entries_[piece]); });
}

void BandCutter::finish_component(std::int32_t component) {
  in_pieces(rest_.vertices_of(component), [&](std::int32_t piece, Span<const std::int32_t> own) {
    for (const std::int32_t v : own) {
      if (others_[v] <= 0) continue;
      for (const std::int32_t j : reach_.handles_of(component)) {
        const double weight = others_[v] * fields_.of(j)[v];
        if (weight > 0) entries_[piece].push_back({v, j, weight});
      }
      others_[v] = 0;
    }
  });
}

void find_elastic(const Mesh& mesh, const Reach& reach, ClusterWeights& weights, Memory& memory) {
  Vector<std::uint8_t> elastic(mesh.component_count(), 0, &memory);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    // The clusters of a vertex are sorted, and the free ones (not handles) come last.
    const std::int32_t end = weights.start[v + 1];
    if (end > weights.start[v] && weights.cluster[end - 1] >= weights.handle_count) elastic[mesh.component[v]] = 1;
  }
  for (std::int32_t c = 0; c < mesh.component_count(); ++c) {
    if (!elastic[c]) continue;
    weights.elastic_components.push_back(c);
    weights.shared.push_back(reach.handles_of(c).size() > 2);
  }
}

}  // namespace

std::int32_t bands_for(std::int32_t wished, std::int32_t field_count) noexcept {
  const std::int32_t fit = field_count > 0 ? free_cluster_target / field_count : wished;
  return std::max(static_cast<std::int32_t>(least_bands), std::min(wished, fit));
}

ClusterWeights make_cluster_weights(const Core& core, const Rest& rest, const Reach& reach, const HandleFields& fields,
                                    const BandOptions& options, Memory& memory) {
  const std::int32_t handle_count = static_cast<std::int32_t>(fields.leak.size());
  const Vector<FieldPart> parts = find_parts(core.mesh, reach, memory);
  BandOptions used = options;
  used.band_count = bands_for(options.band_count, static_cast<std::int32_t>(parts.size()));
  const Vector<Levels> levels = make_levels(core, rest, fields, parts, used.spacing, memory);
  BandCutter cutter(core, rest, reach, fields, used, memory);
  for (double area = smallest_area;; area *= area_growth) {
    cutter.begin(handle_count);
    for (std::size_t p = 0; p < parts.size(); ++p) {
      cutter.cut(parts[p], levels[p], area);
      if (p + 1 == parts.size() || parts[p + 1].component != parts[p].component)
        cutter.finish_component(parts[p].component);
    }
    if (cutter.cluster_count() - handle_count <= free_cluster_limit || area > 1) break;
  }
  ClusterWeights weights(memory);
  weights.handle_count = handle_count, weights.cluster_count = cutter.cluster_count(),
  weights.band_count = used.band_count;
  write_rows(core, reach, fields, cutter.entries(), weights, memory);
  find_elastic(core.mesh, reach, weights, memory);
  return weights;
}

}  // namespace hf_inner
