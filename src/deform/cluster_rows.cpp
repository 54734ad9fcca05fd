#include "deform/cluster_rows.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"

namespace hf_inner::deform {
namespace {

struct Weight {
  std::int32_t cluster;
  double weight;
};

// Makes the row of one vertex: weights by ascending cluster.
class RowMaker {
 public:
  RowMaker(const BandSource& source, Memory& memory)
      : source_(source), row_(memory, 2 * source.fields.leak.size() + 3 * source.parts.size()) {}

  // The weights of a vertex between handles: small ones removed, sum 1. The row is empty when no weight remains.
  Span<const Weight> between(std::int32_t v, const PieceBands& bands, Span<const std::int32_t> clusters) noexcept {
    const Span<const BandSlot> slots = bands.slots_of(v);
    const std::size_t first = add_handles(v, slots);
    for (const BandSlot& slot : slots) {
      const std::int32_t* patch = bands.patch_of.data() + 3 * (&slot - bands.slot.data());
      const std::size_t own = count_;
      for (int a = 0; a < 3; ++a) {
        if (!(slot.open >> a & 1) || clusters[patch[a]] < 0) continue;
        row_[count_++] = {clusters[patch[a]], slot.share * slot.value[a]};
        // The clusters of one field ascend from field to field, but not from band to band.
        for (std::size_t k = count_ - 1; k > own && row_[k].cluster < row_[k - 1].cluster; --k)
          std::swap(row_[k], row_[k - 1]);
      }
    }
    return finished(first);
  }
  // The row of a vertex that belongs to one handle.
  Span<const Weight> whole(std::int32_t handle) noexcept {
    row_[0] = {handle, 1.0};
    return {row_.data(), 1};
  }
  // The row of a vertex whose clusters were all dropped: its handles, weighted by their fields.
  Span<const Weight> by_fields(std::int32_t v) noexcept {
    count_ = 0;
    for (const std::int32_t j : source_.reach.handles_of(source_.core.mesh.component[v])) {
      if (const double phi = source_.fields.of(j)[v]; phi > 0) row_[count_++] = {j, phi};
    }
    return {row_.data(), count_};
  }

 private:
  // Adds the weights of the handles: the last band of each field, and all handles' parts of the first bands. Returns
  // where the row begins.
  std::size_t add_handles(std::int32_t v, Span<const BandSlot> slots) noexcept {
    const std::int32_t top = source_.band_count + 1;
    const double* const fields = source_.fields.at(v);
    count_ = 0;
    double others = 0;  // sum over fields phi of share times B_0 / (1 - phi), B_0 the first band
    for (const BandSlot& slot : slots) {
      const std::int32_t handle = source_.parts[slot.part].handle;
      double own = top - slot.first <= source_.degree ? slot.share * slot.value[top - slot.first] : 0.0;
      const double phi = slot.first == 0 ? fields[handle] : 1.0;
      if (phi < 1) {
        // The sum below gives the handle a part of its own first band, which is taken off here.
        const double part = slot.share * slot.value[0] / (1.0 - phi);
        others += part;
        own -= part * phi;
      }
      if (own != 0) row_[count_++] = {handle, own};
    }
    if (!(others > 0)) return 0;
    // Both lists ascend. The handles with weights of their own stand in the row already.
    const std::size_t first = count_;
    std::size_t next = 0;
    for (const std::int32_t j : source_.reach.handles_of(source_.core.mesh.component[v])) {
      const double weight = others * fields[j];
      const bool own = next < first && row_[next].cluster == j;
      if (!own && !(weight > 0)) continue;
      const double before = own ? row_[next++].weight : 0.0;
      row_[count_++] = {j, weight > 0 ? before + weight : before};
    }
    return first;
  }
  Span<const Weight> finished(std::size_t first) noexcept {
    double square = 0, sum = 0;
    for (std::size_t k = first; k < count_; ++k) square += row_[k].weight * row_[k].weight;
    const double floor = weight_prune * std::sqrt(square);
    std::size_t kept = 0;
    for (std::size_t k = first; k < count_; ++k) {
      const double weight = row_[k].weight - floor;
      if (!(weight > 0)) continue;
      sum += weight;
      row_[kept++] = {row_[k].cluster, weight};
    }
    for (std::size_t k = 0; k < kept; ++k) row_[k].weight /= sum;
    return {row_.data(), kept};
  }

  const BandSource& source_;
  Buffer<Weight> row_;  // the handles' weights twice, and three bands of every field
  std::size_t count_ = 0;
};

// The finished rows of cluster weights of vertex_piece vertices.
struct PieceRows {
  explicit PieceRows(const std::pmr::polymorphic_allocator<std::byte>& allocator)
      : length(allocator), cluster(allocator), weight(allocator) {}
  Vector<std::int32_t> length;  // number of weights per vertex
  Vector<std::uint16_t> cluster;
  Vector<float> weight;
  std::size_t size = 0;  // of both in use
  std::int32_t unreached = 0;

  // Appends a vertex's row of cluster weights that sum to 1, rounded to multiples of 2^-24. The largest weight takes
  // the remainder.
  void append(Span<const Weight> row) {
    constexpr double steps = 16777216;  // 2^24: a float holds all whole numbers up to it
    double left = steps;
    std::size_t largest = 0;
    for (std::size_t k = 1; k < row.size(); ++k) largest = row[k].weight > row[largest].weight ? k : largest;
    const std::size_t first = size;
    size += row.size();
    if (size > cluster.size()) {
      cluster.resize(2 * size);
      weight.resize(2 * size);
    }
    for (std::size_t k = 0; k < row.size(); ++k) {
      const double whole = std::max(1, static_cast<std::int32_t>(steps * row[k].weight + 0.5));
      left -= whole;
      cluster[first + k] = static_cast<std::uint16_t>(row[k].cluster);
      weight[first + k] = static_cast<float>(whole / steps);
    }
    float& largest_weight = weight[first + largest];
    largest_weight = static_cast<float>(largest_weight + left / steps);
  }
};

// Makes the rows of cluster weights of the vertices [first, last).
void make_rows(const BandSource& source, std::int32_t first, std::int32_t last, const PieceBands& bands,
               Span<const std::int32_t> clusters, PieceRows& out, Memory& memory) {
  RowMaker maker(source, memory);
  const std::size_t room = static_cast<std::size_t>(last - first) + (source.degree + 1) * bands.slot.size();
  out.length.reserve(static_cast<std::size_t>(last - first));
  out.cluster.resize(room);
  out.weight.resize(room);
  for (std::int32_t v = first; v < last; ++v) {
    const std::size_t before = out.size;
    const Span<const std::int32_t> present = source.reach.handles_of(source.core.mesh.component[v]);
    const std::int32_t owner = source.reach.owner[v];
    if (present.empty()) {
      ++out.unreached;
    } else if (owner >= 0 || present.size() == 1) {
      out.append(maker.whole(owner >= 0 ? owner : present[0]));
    } else if (const Span<const Weight> row = maker.between(v, bands, clusters); !row.empty()) {
      out.append(row);
    } else {
      out.append(maker.by_fields(v));
    }
    out.length.push_back(static_cast<std::int32_t>(out.size - before));
  }
}

}  // namespace

void write_rows(const BandSource& source, const Vector<PieceBands>& pieces,
                const Vector<Span<const std::int32_t>>& clusters, ClusterWeights& out, Memory& memory) {
  const std::int32_t n = source.core.size();
  JobRunner& jobs = *source.core.jobs;
  Vector<PieceRows> rows(&memory);
  rows.reserve(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) rows.emplace_back(&memory);
  for_vertex_pieces(jobs, n, [&](std::int32_t first, std::int32_t last) {
    const std::size_t p = static_cast<std::size_t>(first / vertex_piece);
    make_rows(source, first, last, pieces[p], clusters[p], rows[p], memory);
  });
  out.start.resize(n + 1);
  out.start[0] = 0;
  for (std::int32_t v = 0; v < n; ++v)
    out.start[v + 1] = out.start[v] + rows[v / vertex_piece].length[v % vertex_piece];
  poll();
  out.cluster.resize(out.start[n]);
  out.weight.resize(out.start[n]);
  for_vertex_pieces(jobs, n, [&](std::int32_t first, std::int32_t) {
    const PieceRows& own = rows[first / vertex_piece];
    std::copy_n(own.cluster.begin(), own.size, out.cluster.begin() + out.start[first]);
    std::copy_n(own.weight.begin(), own.size, out.weight.begin() + out.start[first]);
  });
  for (const PieceRows& own : rows) out.unreached_vertex_count += own.unreached;
}

}  // namespace hf_inner::deform
