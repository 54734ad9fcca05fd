#include "deform/band_patches.h"

#include <algorithm>
#include <cmath>

namespace hf_inner {
namespace {

// Lists the fields that count at a vertex, with their B-splines.
void read_vertex(const BandSource& source, std::int32_t v, PieceBands& out) {
  const std::int32_t component = source.core.mesh.component[v];
  const std::int32_t begin = source.part_start[component], end = source.part_start[component + 1];
  if (begin == end || source.reach.owner[v] >= 0) return;
  const bool several = source.reach.handles_of(component).size() > 2;
  const double* const fields = source.fields.at(v);
  double floor = 0;
  if (several) {
    for (std::int32_t p = begin; p < end; ++p) {
      const double phi = fields[source.parts[p].handle];
      floor += phi * phi;
    }
    floor = field_prune * std::sqrt(floor);
  }
  for (std::int32_t p = begin; p < end; ++p) {
    const double phi = fields[source.parts[p].handle], share = several ? phi - floor : 1.0;
    if (!(share > 0)) continue;  // this field does not count here
    double level = source.levels[p](phi);
    if (several && source.degree == 2) level = eased_level(level, source.band_count);
    const BandValues bands = band_values(level, source.band_count, source.degree);
    // Bands 1 .. K become clusters. Band 0 is shared among the handles, and band K + 1 is the handle.
    unsigned open = 0;
    for (int a = 0; a <= source.degree; ++a) {
      const std::int32_t band = bands.first + a;
      open |= (band > 0 && band <= source.band_count && bands.value[a] > 0 ? 1u : 0u) << a;
    }
    out.slot.push_back({p,
                        static_cast<std::int16_t>(bands.first),
                        static_cast<std::uint16_t>(open),
                        share,
                        {bands.value[0], bands.value[1], bands.value[2]}});
  }
}

std::int32_t find(std::int32_t* parent, std::int32_t x) noexcept {
  while (parent[x] != x) x = parent[x] = parent[parent[x]];
  return x;
}

// Joins two bands. The smaller number becomes the root, so that results do not depend on the order.
void join(std::int32_t* parent, std::int32_t a, std::int32_t b) noexcept {
  if (parent[a] == parent[b]) return;  // most pairs
  a = find(parent, a);
  b = find(parent, b);
  if (a < b) parent[b] = a;
  if (b < a) parent[a] = b;
}

// The union-find forest of the bands in a piece: band a of slot k has the number 4 k + a.
constexpr std::int32_t bands_a_slot = 4;

// Says whether all bands of two slots of one field have the same parents, as most neighbours do.
bool joined(const BandSlot& own, const BandSlot& other, const std::int32_t* a, const std::int32_t* b) noexcept {
  return own.first == other.first && own.open == other.open && a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// Joins the bands at the two ends of an edge inside the piece. Both lists of slots are ascending by part.
void join_edge(const PieceBands& bands, std::int32_t v, std::int32_t u, std::int32_t* parent) noexcept {
  std::int32_t i = bands.start[v - bands.first], k = bands.start[u - bands.first];
  const std::int32_t i_end = bands.start[v - bands.first + 1], k_end = bands.start[u - bands.first + 1];
  while (i < i_end && k < k_end) {
    const BandSlot &own = bands.slot[i], &other = bands.slot[k];
    const std::int32_t own_band = bands_a_slot * i, other_band = bands_a_slot * k;
    if (own.part == other.part && !joined(own, other, parent + own_band, parent + other_band))
      for_common_bands(own, other, [&](int a, int b) { join(parent, own_band + a, other_band + b); });
    const std::int32_t step = own.part - other.part;
    i += step <= 0;
    k += step >= 0;
  }
}

}  // namespace

void read_bands(const BandSource& source, std::int32_t first, std::int32_t last, PieceBands& out, Memory& memory) {
  const Topology& topology = source.core.topology();
  out.first = first;
  out.start.reserve(static_cast<std::size_t>(last - first) + 1);
  out.slot.reserve(slots_a_vertex * static_cast<std::size_t>(last - first));
  out.start.push_back(0);
  for (std::int32_t v = first; v < last; ++v) {
    read_vertex(source, v, out);
    out.start.push_back(static_cast<std::int32_t>(out.slot.size()));
  }
  Buffer<std::int32_t> parent(memory, bands_a_slot * out.slot.size());
  for (std::size_t k = 0; k < parent.size(); ++k) parent[k] = static_cast<std::int32_t>(k);
  // Neighbours are sorted, so each edge is handled once, from its larger end.
  for (std::int32_t v = first; v < last; ++v) {
    if (out.slots_of(v).empty()) continue;
    std::int32_t k = topology.neighbour_start[v];
    const std::int32_t end = topology.neighbour_start[v + 1];
    if (k < end && topology.neighbour[k] < first) out.border.push_back(v);
    for (; k < end && topology.neighbour[k] < v; ++k) {
      if (topology.neighbour[k] >= first) join_edge(out, v, topology.neighbour[k], parent.data());
    }
  }
  Buffer<std::int32_t> patch_of_root(memory, parent.size());
  out.patch_of.assign(3 * out.slot.size(), -1);
  for (std::int32_t v = first; v < last; ++v) {
    const double area = source.rest.area[v];
    for (std::int32_t k = out.start[v - first]; k < out.start[v - first + 1]; ++k) {
      const BandSlot& slot = out.slot[k];
      for (int a = 0; a < 3; ++a) {
        if (!(slot.open >> a & 1)) continue;
        // The root is the smallest member of its patch, so the loop has met it before.
        const std::int32_t own = bands_a_slot * k + a, root = find(parent.data(), own);
        if (root == own) {
          patch_of_root[own] = static_cast<std::int32_t>(out.patch.size());
          out.patch.push_back({slot.part, slot.first + a, 0.0});
        }
        const std::int32_t patch = out.patch_of[3 * k + a] = patch_of_root[root];
        out.patch[patch].area += slot.share * slot.value[a] * area;
      }
    }
  }
}

}  // namespace hf_inner
