#include "deform/cluster_rows.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"

namespace hf_inner {
namespace {

// The weights in clusters of the vertices [first, last), sorted by vertex.
class WeightTable {
 public:
  struct Item {
    std::int32_t cluster;
    double weight;
  };
  WeightTable(const Vector<ClusterEntry>& entries, std::int32_t first, std::int32_t last, Memory& memory)
      : first_(first), start_(last - first + 1, 0, &memory), items_(memory, entries.size()) {
    for (const ClusterEntry& entry : entries) ++start_[entry.vertex - first + 1];
    for (std::int32_t v = 0; v < last - first; ++v) start_[v + 1] += start_[v];
    Vector<std::int32_t> next(start_, &memory);
    for (const ClusterEntry& entry : entries) items_[next[entry.vertex - first]++] = {entry.cluster, entry.weight};
  }

  // Returns a vertex's row of cluster weights: clusters ascending, small weights removed, sum 1. The row is empty when
  // no weight remains.
  Span<const Item> finish(std::int32_t v) noexcept {
    Item* items = items_.data() + start_[v - first_];
    std::int32_t count = join_equal(items, start_[v - first_ + 1] - start_[v - first_]);
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

  std::int32_t first_;
  Vector<std::int32_t> start_;
  Buffer<Item> items_;
};

// The finished rows of cluster weights of vertex_piece vertices.
struct PieceRows {
  explicit PieceRows(const std::pmr::polymorphic_allocator<std::byte>& allocator)
      : length(allocator), cluster(allocator), weight(allocator) {}
  Vector<std::int32_t> length;  // number of weights per vertex
  Vector<std::uint16_t> cluster;
  Vector<float> weight;
  std::int32_t unreached = 0;

  // Appends a vertex's row of cluster weights that sum to 1, rounded to multiples of 2^-24. The largest weight takes
  // the remainder.
  void append(Span<const WeightTable::Item> row) {
    constexpr double steps = 16777216;  // 2^24: a float holds all whole numbers up to it
    double left = steps;
    std::size_t largest = 0;
    for (std::size_t k = 1; k < row.size(); ++k) largest = row[k].weight > row[largest].weight ? k : largest;
    const std::size_t first = weight.size();
    for (const WeightTable::Item& item : row) {
      const double whole = std::max(1.0, std::floor(steps * item.weight + 0.5));
      left -= whole;
      cluster.push_back(static_cast<std::uint16_t>(item.cluster));
      weight.push_back(static_cast<float>(whole / steps));
    }
    float& largest_weight = weight[first + largest];
    largest_weight = static_cast<float>(largest_weight + left / steps);
  }
};

// Makes the rows of cluster weights of the vertices [first, last). If all clusters of a vertex were dropped, it gets
// the handles, weighted by their fields.
void make_rows(const Vector<ClusterEntry>& entries, std::int32_t first, std::int32_t last, const Mesh& mesh,
               const Reach& reach, const HandleFields& fields, PieceRows& out, Memory& memory) {
  WeightTable table(entries, first, last, memory);
  Vector<WeightTable::Item> own(fields.leak.size(), WeightTable::Item{0, 0.0}, &memory);
  out.length.reserve(static_cast<std::size_t>(last - first));
  out.cluster.reserve(entries.size() + own.size()), out.weight.reserve(entries.size() + own.size());
  for (std::int32_t v = first; v < last; ++v) {
    const std::size_t before = out.cluster.size();
    const Span<const std::int32_t> present = reach.handles_of(mesh.component[v]);
    if (present.empty()) {
      ++out.unreached;
    } else if (reach.owner[v] >= 0 || present.size() == 1) {
      own[0] = {reach.owner[v] >= 0 ? reach.owner[v] : present[0], 1.0};
      out.append({own.data(), 1});
    } else if (const Span<const WeightTable::Item> row = table.finish(v); !row.empty()) {
      out.append(row);
    } else {
      std::size_t count = 0;
      for (const std::int32_t j : present) {
        if (fields.of(j)[v] > 0) own[count++] = {j, fields.of(j)[v]};
      }
      out.append({own.data(), count});
    }
    out.length.push_back(static_cast<std::int32_t>(out.cluster.size() - before));
  }
}

}  // namespace

void write_rows(const Core& core, const Reach& reach, const HandleFields& fields,
                const Vector<Vector<ClusterEntry>>& entries, ClusterWeights& out, Memory& memory) {
  const std::int32_t n = core.size();
  Vector<PieceRows> rows(&memory);
  rows.reserve(entries.size());
  for (std::size_t p = 0; p < entries.size(); ++p) rows.emplace_back(&memory);
  for_vertex_pieces(*core.jobs, n, [&](std::int32_t first, std::int32_t last) {
    const std::size_t p = static_cast<std::size_t>(first / vertex_piece);
    make_rows(entries[p], first, last, core.mesh, reach, fields, rows[p], memory);
  });
  out.start.resize(n + 1);
  out.start[0] = 0;
  for (std::int32_t v = 0; v < n; ++v)
    out.start[v + 1] = out.start[v] + rows[v / vertex_piece].length[v % vertex_piece];
  poll();
  out.cluster.resize(out.start[n]), out.weight.resize(out.start[n]);
  for_vertex_pieces(*core.jobs, n, [&](std::int32_t first, std::int32_t) {
    const PieceRows& own = rows[first / vertex_piece];
    std::copy(own.cluster.begin(), own.cluster.end(), out.cluster.begin() + out.start[first]);
    std::copy(own.weight.begin(), own.weight.end(), out.weight.begin() + out.start[first]);
  });
  for (const PieceRows& own : rows) out.unreached_vertex_count += own.unreached;
}

}  // namespace hf_inner
