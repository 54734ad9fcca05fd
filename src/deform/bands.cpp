#include "deform/bands.h"

#include <algorithm>
#include <cmath>

namespace hf {
namespace {

constexpr double field_prune = 0.3;     // of |phi|: fields that count at a vertex
constexpr double weight_prune = 1e-3;   // of |W|: clusters that count at a vertex
constexpr double piece_share = 0.02;    // of its band: smaller pieces of a band are dropped, never the largest
constexpr double smallest_area = 2e-4;  // of its component: smaller clusters are dropped

struct Entry {
  std::int32_t vertex, cluster;
  double weight;
};

// Fields that carry bands: of two handles in a component the second's, of more all, of one none.
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

// Union-find with the smallest member as representative, so that results do not depend on the order of unions.
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

// Cuts one field after the other into clusters and collects entries (vertex, cluster, weight).
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
        entries_(&memory),
        partition_(3 * static_cast<std::size_t>(core.size()), memory),
        values_(memory, core.size()),
        share_(memory, core.size()),
        floor_(memory, core.size()),
        piece_area_(memory, 3 * static_cast<std::size_t>(core.size())),
        piece_cluster_(memory, 3 * static_cast<std::size_t>(core.size())),
        others_(core.size(), 0.0, &memory) {
    entries_.reserve(8 * static_cast<std::size_t>(core.size()));
  }

  // Forgets all entries; the first cluster gets this number.
  void begin(std::int32_t first_cluster) noexcept { entries_.clear(), next_cluster_ = first_cluster; }
  // One field on one component. Pieces below `smallest` of the component's area are dropped.
  void cut(const FieldPart& part, const Levels& levels, double smallest);
  // Hands out the share of B_0 of all fields of a component to the other handles.
  void finish_component(std::int32_t component);

  const Vector<Entry>& entries() const noexcept { return entries_; }
  std::int32_t cluster_count() const noexcept { return next_cluster_; }

 private:
  void evaluate(const FieldPart& part, const Levels& levels) noexcept;
  void join_neighbours(Span<const std::int32_t> vertices) noexcept;
  void number_pieces(Span<const std::int32_t> vertices, double smallest);
  bool interior(std::int32_t band) const noexcept { return band > 0 && band <= options_.band_count; }

  const Core& core_;
  const Rest& rest_;
  const Reach& reach_;
  const HandleFields& fields_;
  const BandOptions& options_;
  Memory& memory_;
  Vector<Entry> entries_;
  std::int32_t next_cluster_ = 0;
  // of the field at hand, per vertex or per vertex and band
  Partition partition_;
  Buffer<BandValues> values_;
  Buffer<double> share_;        // beta
  Buffer<double> floor_;        // below, a field does not count at a vertex
  std::int32_t floor_of_ = -1;  // the component floor_ was made for
  Buffer<double> piece_area_;
  Buffer<std::int32_t> piece_cluster_;
  Vector<double> others_;  // sum over the fields of beta_i B_0 / (1 - phi_i)
};

void BandCutter::evaluate(const FieldPart& part, const Levels& levels) noexcept {
  const double* phi = fields_.of(part.handle);
  const Span<const std::int32_t> present = reach_.handles_of(part.component);
  if (present.size() > 2 && floor_of_ != part.component) {  // once per component
    const Span<const std::int32_t> vertices = rest_.vertices_of(part.component);
    for (const std::int32_t v : vertices) floor_[v] = 0;
    for (const std::int32_t j : present) {
      const double* field = fields_.of(j);
      for (const std::int32_t v : vertices) floor_[v] += field[v] * field[v];
    }
    for (const std::int32_t v : vertices) floor_[v] = field_prune * std::sqrt(floor_[v]);
    floor_of_ = part.component;
  }
  for (const std::int32_t v : rest_.vertices_of(part.component)) {
    share_[v] = present.size() > 2 ? std::max(0.0, phi[v] - floor_[v]) : 1.0;
    if (share_[v] <= 0) continue;  // nothing of this field counts here
    values_[v] = band_values(levels(phi[v]), options_.band_count, options_.degree);
  }
}

void BandCutter::join_neighbours(Span<const std::int32_t> vertices) noexcept {
  const Topology& topology = core_.topology;
  const int width = options_.degree + 1;
  for (const std::int32_t v : vertices) {
    for (int k = 0; k < 3; ++k) {
      partition_.parent[3 * v + k] = 3 * v + k;
      piece_area_[3 * v + k] = 0, piece_cluster_[3 * v + k] = -1;
    }
  }
  for (const std::int32_t v : vertices) {
    if (share_[v] <= 0) continue;
    for (std::int32_t k = topology.neighbour_start[v]; k < topology.neighbour_start[v + 1]; ++k) {
      const std::int32_t u = topology.neighbour[k];
      if (u > v) break;  // ascending: each edge once
      if (share_[u] <= 0) continue;
      for (int a = 0; a < width; ++a) {
        const std::int32_t b = values_[v].first + a - values_[u].first;
        if (b < 0 || b >= width || values_[v].value[a] <= 0 || values_[u].value[b] <= 0) continue;
        if (interior(values_[v].first + a)) partition_.join(3 * v + a, 3 * u + b);
      }
    }
  }
}

void BandCutter::number_pieces(Span<const std::int32_t> vertices, double smallest) {
  Vector<double> band_area(options_.band_count + 2, 0.0, &memory_), largest(options_.band_count + 2, 0.0, &memory_);
  const int width = options_.degree + 1;
  const auto for_members = [&](auto&& use) {
    for (const std::int32_t v : vertices) {
      if (share_[v] <= 0) continue;
      for (int a = 0; a < width; ++a) {
        const std::int32_t band = values_[v].first + a;
        if (interior(band) && values_[v].value[a] > 0) use(v, a, band, partition_.find(3 * v + a));
      }
    }
  };
  for_members([&](std::int32_t v, int a, std::int32_t band, std::int32_t root) {
    const double area = share_[v] * values_[v].value[a] * rest_.area[v];
    piece_area_[root] += area, band_area[band] += area;
    largest[band] = std::max(largest[band], piece_area_[root]);
  });
  for_members([&](std::int32_t v, int a, std::int32_t band, std::int32_t root) {
    const double area = piece_area_[root];
    if (area < smallest || (area < largest[band] && area < piece_share * band_area[band])) return;
    if (piece_cluster_[root] < 0) piece_cluster_[root] = next_cluster_++;
    entries_.push_back({v, piece_cluster_[root], share_[v] * values_[v].value[a]});
  });
}

void BandCutter::cut(const FieldPart& part, const Levels& levels, double smallest) {
  const Span<const std::int32_t> vertices = rest_.vertices_of(part.component);
  evaluate(part, levels);
  join_neighbours(vertices);
  number_pieces(vertices, smallest * rest_.component_area[part.component]);
  // the handle itself, and the others: the whole share is handed out in finish_component, without the handle's own part
  const double* phi = fields_.of(part.handle);
  const std::int32_t last = options_.band_count + 1;
  for (const std::int32_t v : vertices) {
    if (share_[v] <= 0) continue;
    const BandValues& b = values_[v];
    const int top = last - b.first;
    double own = top <= options_.degree ? share_[v] * b.value[top] : 0.0;
    if (b.first == 0 && phi[v] < 1) {
      const double others = share_[v] * b.value[0] / (1.0 - phi[v]);
      others_[v] += others;
      own -= others * phi[v];
    }
    if (own != 0) entries_.push_back({v, part.handle, own});
  }
}

void BandCutter::finish_component(std::int32_t component) {
  for (const std::int32_t v : rest_.vertices_of(component)) {
    if (others_[v] <= 0) continue;
    for (const std::int32_t j : reach_.handles_of(component)) {
      const double weight = others_[v] * fields_.of(j)[v];
      if (weight > 0) entries_.push_back({v, j, weight});
    }
    others_[v] = 0;
  }
}

// The entries sorted by vertex.
class WeightTable {
 public:
  struct Item {
    std::int32_t cluster;
    double weight;
  };
  WeightTable(const Vector<Entry>& entries, std::int32_t vertex_count, Memory& memory)
      : start_(vertex_count + 1, 0, &memory), items_(entries.size(), Item{0, 0.0}, &memory) {
    for (const Entry& entry : entries) ++start_[entry.vertex + 1];
    for (std::int32_t v = 0; v < vertex_count; ++v) start_[v + 1] += start_[v];
    Vector<std::int32_t> next(start_, &memory);
    for (const Entry& entry : entries) items_[next[entry.vertex]++] = {entry.cluster, entry.weight};
  }

  // The row of a vertex, clusters ascending, small weights pruned, sum 1. Empty when nothing is left.
  Span<const Item> finish(std::int32_t v) noexcept {
    Item* items = items_.data() + start_[v];
    std::int32_t count = join_equal(items, start_[v + 1] - start_[v]);
    double square = 0, sum = 0;
    for (std::int32_t k = 0; k < count; ++k) square += items[k].weight * items[k].weight;
    const double floor = weight_prune * std::sqrt(square);
    std::int32_t kept = 0;
    for (std::int32_t k = 0; k < count; ++k) {
      const double weight = items[k].weight - floor;
      if (!(weight > 0)) continue;
      sum += weight;
      items[kept++] = {items[k].cluster, weight};
    }
    for (std::int32_t k = 0; k < kept; ++k) items[k].weight /= sum;
    return {items, static_cast<std::size_t>(kept)};
  }

 private:
  static std::int32_t join_equal(Item* items, std::int32_t count) noexcept {
    for (std::int32_t k = 1; k < count; ++k) {  // rows are short
      for (std::int32_t j = k; j > 0 && items[j].cluster < items[j - 1].cluster; --j) std::swap(items[j], items[j - 1]);
    }
    std::int32_t kept = 0;
    for (std::int32_t k = 0; k < count; ++k) {
      if (kept > 0 && items[kept - 1].cluster == items[k].cluster) {
        items[kept - 1].weight += items[k].weight;
      } else {
        items[kept++] = items[k];
      }
    }
    return kept;
  }

  Vector<std::int32_t> start_;
  Vector<Item> items_;
};

// Appends a row of weights that sum to 1, rounded to whole steps; the largest takes up what is left.
void append_row(Span<const WeightTable::Item> row, ClusterWeights& out) {
  constexpr double steps = 16777216;  // 2^24: whole numbers up to it are floats
  double left = steps;
  std::size_t largest = 0;
  for (std::size_t k = 1; k < row.size(); ++k) largest = row[k].weight > row[largest].weight ? k : largest;
  const std::size_t first = out.weight.size();
  for (const WeightTable::Item& item : row) {
    const double whole = std::max(1.0, std::floor(steps * item.weight + 0.5));
    left -= whole;
    out.cluster.push_back(static_cast<std::uint16_t>(item.cluster));
    out.weight.push_back(static_cast<float>(whole / steps));
  }
  float& largest_weight = out.weight[first + largest];
  largest_weight = static_cast<float>(largest_weight + left / steps);
}

// Rows of all vertices. A vertex whose pieces were all dropped takes the fields themselves as weights of the handles.
void write_rows(WeightTable& table, const Mesh& mesh, const Reach& reach, const HandleFields& fields,
                ClusterWeights& out, Memory& memory) {
  const std::int32_t n = mesh.vertex_count();
  Vector<WeightTable::Item> own(out.handle_count, WeightTable::Item{0, 0.0}, &memory);
  out.start.resize(n + 1);
  out.start[0] = 0;
  for (std::int32_t v = 0; v < n; ++v) {
    const Span<const std::int32_t> present = reach.handles_of(mesh.component[v]);
    if (present.empty()) {
      ++out.unreached_vertex_count;
    } else if (reach.owner[v] >= 0 || present.size() == 1) {
      own[0] = {reach.owner[v] >= 0 ? reach.owner[v] : present[0], 1.0};
      append_row({own.data(), 1}, out);
    } else if (const Span<const WeightTable::Item> row = table.finish(v); !row.empty()) {
      append_row(row, out);
    } else {
      std::size_t count = 0;
      for (const std::int32_t j : present) {
        if (fields.of(j)[v] > 0) own[count++] = {j, fields.of(j)[v]};
      }
      append_row({own.data(), count}, out);
    }
    out.start[v + 1] = static_cast<std::int32_t>(out.cluster.size());
  }
}

void find_elastic(const Mesh& mesh, ClusterWeights& weights, Memory& memory) {
  Vector<std::uint8_t> elastic(mesh.component_count(), 0, &memory);
  for (std::int32_t v = 0; v < mesh.vertex_count(); ++v) {
    // clusters ascend, free ones come last
    const std::int32_t end = weights.start[v + 1];
    if (end > weights.start[v] && weights.cluster[end - 1] >= weights.handle_count) elastic[mesh.component[v]] = 1;
  }
  for (std::int32_t c = 0; c < mesh.component_count(); ++c) {
    if (elastic[c]) weights.elastic_components.push_back(c);
  }
}

}  // namespace

std::int32_t bands_for(std::int32_t wished, std::int32_t field_count) noexcept {
  const std::int32_t fit = field_count > 0 ? free_cluster_target / field_count : wished;
  return std::max(2, std::min(wished, fit));
}

ClusterWeights make_cluster_weights(const Core& core, const Rest& rest, const Reach& reach, const HandleFields& fields,
                                    const BandOptions& options, Memory& memory) {
  const std::int32_t handle_count = static_cast<std::int32_t>(fields.leak.size());
  const Vector<FieldPart> parts = find_parts(core.mesh, reach, memory);
  BandOptions used = options;
  used.band_count = bands_for(options.band_count, static_cast<std::int32_t>(parts.size()));
  const Vector<Levels> levels = make_levels(core, rest, fields, parts, used.spacing, memory);
  BandCutter cutter(core, rest, reach, fields, used, memory);
  for (double area = smallest_area;; area *= 4) {
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
  weights.cluster.reserve(cutter.entries().size() + static_cast<std::size_t>(core.size()));
  weights.weight.reserve(cutter.entries().size() + static_cast<std::size_t>(core.size()));
  WeightTable table(cutter.entries(), core.size(), memory);
  write_rows(table, core.mesh, reach, fields, weights, memory);
  find_elastic(core.mesh, weights, memory);
  return weights;
}

}  // namespace hf
