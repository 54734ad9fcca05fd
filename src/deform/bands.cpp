#include "deform/bands.h"

#include <algorithm>

#include "deform/band_patches.h"
#include "deform/cluster_rows.h"

namespace hf_inner::deform {
namespace {

// Finds the handles' fields that are cut into level bands. With two handles in a component it is the second handle's
// field. With more it is every field, with one none.
Vector<FieldPart> find_parts(const mesh::Mesh& mesh, const Reach& reach, Memory& memory) {
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

// Joins the patches of all pieces into connected pieces of level bands, and numbers those as clusters.
class ClusterNumbers {
 public:
  ClusterNumbers(const BandSource& source, const Vector<PieceBands>& pieces, Memory& memory)
      : source_(source),
        pieces_(pieces),
        base_(&memory),
        parent_(&memory),
        band_(&memory),
        area_(&memory),
        by_part_(&memory),
        part_end_(&memory),
        cluster_(&memory) {
    base_.push_back(0);
    for (const PieceBands& piece : pieces) {
      for (const PieceBands::Patch& own : piece.patch) band_.push_back(own.band);
      base_.push_back(static_cast<std::int32_t>(band_.size()));
    }
    parent_.resize(band_.size());
    area_.assign(band_.size(), 0.0);
    cluster_.resize(band_.size());
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = static_cast<std::int32_t>(i);
    for (const PieceBands& piece : pieces) {
      poll();
      for (const std::int32_t v : piece.border) join_vertex(piece, v);
    }
    sort_by_part();
  }

  // Numbers the clusters from `first` on, field by field. It drops connected pieces of bands with less than the share
  // `smallest` of their component's area, and small ones beside a large one of the same band. Returns the number of
  // the last one plus 1.
  std::int32_t number(std::int32_t first, double smallest, Memory& memory) {
    std::int32_t next = first;
    for (std::size_t p = 0; p < part_end_.size(); ++p) {
      const double least = smallest * source_.rest.component_area[source_.parts[p].component];
      const Span<const std::int32_t> roots = roots_of(p);
      Vector<double> band_area(source_.band_count + 2, 0.0, &memory), largest(band_area, &memory);
      for (const std::int32_t root : roots) {
        const std::int32_t band = band_[root];
        band_area[band] += area_[root];
        largest[band] = std::max(largest[band], area_[root]);
      }
      for (const std::int32_t root : roots) {
        const std::int32_t band = band_[root];
        const bool dropped =
            area_[root] < least || (area_[root] < largest[band] && area_[root] < piece_share * band_area[band]);
        cluster_[root] = dropped ? -1 : next++;
      }
    }
    return next;
  }

  // The cluster of each patch of piece k, or -1 for patches that were dropped.
  Span<const std::int32_t> clusters_of(std::size_t k) noexcept {
    for (std::int32_t i = base_[k]; i < base_[k + 1]; ++i) cluster_[i] = cluster_[parent_[i]];
    return {cluster_.data() + base_[k], static_cast<std::size_t>(base_[k + 1] - base_[k])};
  }

 private:
  std::int32_t find(std::int32_t x) noexcept {
    while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
    return x;
  }
  // Joins the bands of a vertex with the bands of its neighbours in earlier pieces.
  void join_vertex(const PieceBands& piece, std::int32_t v) noexcept {
    const mesh::Topology& topology = source_.core.topology();
    const auto patch_at = [&](const PieceBands& at, const BandSlot& slot, int a) {
      return base_[at.first / vertex_piece] + at.patch_of[3 * (&slot - at.slot.data()) + a];
    };
    const std::int32_t end = topology.neighbour_start[v + 1];
    for (std::int32_t k = topology.neighbour_start[v]; k < end && topology.neighbour[k] < piece.first; ++k) {
      const PieceBands& other = pieces_[topology.neighbour[k] / vertex_piece];
      for (const BandSlot& slot : piece.slots_of(v)) {
        for (const BandSlot& beside : other.slots_of(topology.neighbour[k])) {
          if (beside.part != slot.part) continue;
          for_common_bands(slot, beside, [&](int a, int b) {
            const std::int32_t own = find(patch_at(piece, slot, a)), root = find(patch_at(other, beside, b));
            // The smallest number is the root, so numbers do not depend on the order.
            parent_[std::max(own, root)] = std::min(own, root);
          });
        }
      }
    }
  }
  // Sums the areas of connected pieces at their roots, and sorts the roots by field.
  void sort_by_part() {
    part_end_.assign(source_.parts.size(), 0);
    std::int32_t i = 0;
    for (const PieceBands& piece : pieces_) {
      for (const PieceBands::Patch& own : piece.patch) {
        const std::int32_t root = parent_[i] = find(i);
        area_[root] += own.area;
        part_end_[own.part] += root == i;
        ++i;
      }
    }
    for (std::size_t p = 1; p < part_end_.size(); ++p) part_end_[p] += part_end_[p - 1];
    by_part_.resize(part_end_.empty() ? 0 : part_end_.back());
    Vector<std::int32_t> next(part_end_, part_end_.get_allocator());
    for (std::size_t k = pieces_.size(); k-- > 0;) {
      for (std::size_t own = pieces_[k].patch.size(); own-- > 0;) {
        const std::int32_t root = base_[k] + static_cast<std::int32_t>(own);
        if (parent_[root] == root) by_part_[--next[pieces_[k].patch[own].part]] = root;
      }
    }
  }
  Span<const std::int32_t> roots_of(std::size_t part) const noexcept {
    const std::int32_t first = part == 0 ? 0 : part_end_[part - 1];
    return {by_part_.data() + first, static_cast<std::size_t>(part_end_[part] - first)};
  }

  const BandSource& source_;
  const Vector<PieceBands>& pieces_;
  Vector<std::int32_t> base_;      // patch i of piece k has the number base_[k] + i
  Vector<std::int32_t> parent_;    // by patch: a patch that it is connected with, at last the root
  Vector<std::int32_t> band_;      // by patch
  Vector<double> area_;            // by root
  Vector<std::int32_t> by_part_;   // the roots, field by field
  Vector<std::int32_t> part_end_;  // by field: the end of its roots in by_part_
  Vector<std::int32_t> cluster_;   // by patch
};

void find_elastic(const mesh::Mesh& mesh, const Reach& reach, ClusterWeights& weights, Memory& memory) {
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

ClusterWeights make_cluster_weights(const surface::Core& core, const Rest& rest, const Reach& reach,
                                    const HandleFields& fields, const BandOptions& options, Memory& memory) {
  const std::int32_t handle_count = static_cast<std::int32_t>(fields.leak.size());
  const Vector<FieldPart> parts = find_parts(core.mesh, reach, memory);
  Vector<std::int32_t> part_start(core.mesh.component_count() + 1, 0, &memory);
  for (const FieldPart& part : parts) ++part_start[part.component + 1];
  for (std::int32_t c = 0; c < core.mesh.component_count(); ++c) part_start[c + 1] += part_start[c];
  const std::int32_t band_count = bands_for(options.band_count, static_cast<std::int32_t>(parts.size()));
  const Vector<Levels> levels = make_levels(core, rest, fields, parts, part_start, options.spacing, memory);
  const BandSource source{core, rest, reach, fields, parts, part_start, levels, band_count, options.degree};
  Vector<PieceBands> pieces(&memory);
  pieces.reserve((core.size() + vertex_piece - 1) / vertex_piece);
  for (std::int32_t first = 0; first < core.size(); first += vertex_piece) pieces.emplace_back(&memory);
  for_vertex_pieces(*core.jobs, core.size(), [&](std::int32_t first, std::int32_t last) {
    read_bands(source, first, last, pieces[first / vertex_piece], memory);
  });
  ClusterWeights weights(memory);
  weights.handle_count = handle_count;
  weights.band_count = band_count;
  ClusterNumbers numbers(source, pieces, memory);
  for (double area = smallest_area;; area *= area_growth) {
    weights.cluster_count = numbers.number(handle_count, area, memory);
    if (weights.free_count() <= free_cluster_limit || area > 1) break;
  }
  Vector<Span<const std::int32_t>> clusters(&memory);
  for (std::size_t k = 0; k < pieces.size(); ++k) clusters.push_back(numbers.clusters_of(k));
  write_rows(source, pieces, clusters, weights, memory);
  find_elastic(core.mesh, reach, weights, memory);
  return weights;
}

}  // namespace hf_inner::deform
