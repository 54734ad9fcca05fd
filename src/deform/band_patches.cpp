#include "deform/band_patches.h"

#include <algorithm>
#include <cmath>

namespace hf_inner::deform {
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
    BandSlot& slot = out.slot.emplace_back();  // written where it lies
    slot.part = p;
    slot.first = static_cast<std::int16_t>(bands.first);
    slot.open = static_cast<std::uint16_t>(open);
    slot.share = share;
    for (int a = 0; a < 3; ++a) slot.value[a] = bands.value[a];
  }
}

std::int32_t find(std::int32_t* parent, std::int32_t x) noexcept {
  while (parent[x] != x) x = parent[x] = parent[parent[x]];
  return x;
}

// Joins two sets. The smaller number becomes the root, so that results do not depend on the order.
void join(std::int32_t* parent, std::int32_t a, std::int32_t b) noexcept {
  if (parent[a] == parent[b]) return;  // most pairs
  a = find(parent, a);
  b = find(parent, b);
  if (a < b) parent[b] = a;
  if (b < a) parent[a] = b;
}

// Neighbouring slots of one field that have the same bands are joined as a whole, into cells: most are. Then the bands
// of cells are joined. Band a of cell k has the number 4 k + a; a cell has the number of its first slot.
constexpr std::int32_t bands_a_cell = 4;

// Two neighbouring slots of one field with other bands.
struct Beside {
  std::int32_t slot, other;
};

class Cells {
 public:
  Cells(const PieceBands& bands, Memory& memory)
      : bands_(bands), key_(memory, bands.slot.size()), cell_(memory, bands.slot.size()), beside_(&memory) {
    for (std::size_t k = 0; k < key_.size(); ++k) {
      const BandSlot& slot = bands.slot[k];
      key_[k] = static_cast<std::uint64_t>(static_cast<std::uint32_t>(slot.part)) << 32 |
                static_cast<std::uint64_t>(static_cast<std::uint16_t>(slot.first)) << 16 | slot.open;
      cell_[k] = static_cast<std::int32_t>(k);
    }
  }
  // Joins the slots at the two ends of an edge inside the piece. Both lists of slots are ascending by part.
  void join_edge(std::int32_t v, std::int32_t u) {
    std::int32_t i = bands_.start[v - bands_.first], k = bands_.start[u - bands_.first];
    const std::int32_t i_end = bands_.start[v - bands_.first + 1], k_end = bands_.start[u - bands_.first + 1];
    while (i < i_end && k < k_end) {
      if (key_[i] == key_[k]) {
        join(cell_.data(), i++, k++);
        continue;
      }
      const std::int32_t step = bands_.slot[i].part - bands_.slot[k].part;
      if (step == 0) beside_.push_back({i, k});
      i += step <= 0;
      k += step >= 0;
    }
  }
  // Joins the bands of cells. Afterwards of(k) is the cell of slot k.
  void join_bands(Buffer<std::int32_t>& parent) noexcept {
    for (std::size_t k = 0; k < cell_.size(); ++k) {
      cell_[k] = cell_[cell_[k]];  // the parent is before k, and its parent is a root by now
      for (std::size_t a = bands_a_cell * k; a < bands_a_cell * (k + 1); ++a) parent[a] = static_cast<std::int32_t>(a);
    }
    for (const Beside& pair : beside_) {
      const std::int32_t own = bands_a_cell * cell_[pair.slot], other = bands_a_cell * cell_[pair.other];
      for_common_bands(bands_.slot[pair.slot], bands_.slot[pair.other],
                       [&](int a, int b) { join(parent.data(), own + a, other + b); });
    }
  }
  std::int32_t of(std::int32_t slot) const noexcept { return cell_[slot]; }

 private:
  const PieceBands& bands_;
  Buffer<std::uint64_t> key_;  // by slot: field, first band and open bands
  Buffer<std::int32_t> cell_;  // by slot: a slot of its cell, at last the first
  Vector<Beside> beside_;
};

}  // namespace

void read_bands(const BandSource& source, std::int32_t first, std::int32_t last, PieceBands& out, Memory& memory) {
  const mesh::Topology& topology = source.core.topology();
  out.first = first;
  out.start.reserve(static_cast<std::size_t>(last - first) + 1);
  out.slot.reserve(slots_a_vertex * static_cast<std::size_t>(last - first));
  out.start.push_back(0);
  for (std::int32_t v = first; v < last; ++v) {
    read_vertex(source, v, out);
    out.start.push_back(static_cast<std::int32_t>(out.slot.size()));
  }
  Cells cells(out, memory);
  // Neighbours are sorted, so each edge is handled once, from its larger end.
  for (std::int32_t v = first; v < last; ++v) {
    if (out.slots_of(v).empty()) continue;
    std::int32_t k = topology.neighbour_start[v];
    const std::int32_t end = topology.neighbour_start[v + 1];
    if (k < end && topology.neighbour[k] < first) out.border.push_back(v);
    for (; k < end && topology.neighbour[k] < v; ++k) {
      if (topology.neighbour[k] >= first) cells.join_edge(v, topology.neighbour[k]);
    }
  }
  Buffer<std::int32_t> parent(memory, bands_a_cell * out.slot.size()), patch_of_band(memory, parent.size());
  cells.join_bands(parent);
  out.patch_of.assign(3 * out.slot.size(), -1);
  for (std::int32_t v = first; v < last; ++v) {
    const double area = source.rest.area[v];
    for (std::int32_t k = out.start[v - first]; k < out.start[v - first + 1]; ++k) {
      const BandSlot& slot = out.slot[k];
      for (int a = 0; a < 3; ++a) {
        if (!(slot.open >> a & 1)) continue;
        const std::int32_t own = bands_a_cell * cells.of(k) + a;
        if (cells.of(k) == k) {
          // The root is the smallest band of its patch, so the loop has met it before.
          const std::int32_t root = find(parent.data(), own);
          if (root == own) {
            patch_of_band[own] = static_cast<std::int32_t>(out.patch.size());
            out.patch.push_back({slot.part, slot.first + a, 0.0});
          }
          patch_of_band[own] = patch_of_band[root];
        }
        const std::int32_t patch = out.patch_of[3 * k + a] = patch_of_band[own];
        out.patch[patch].area += slot.share * slot.value[a] * area;
      }
    }
  }
}

}  // namespace hf_inner::deform
