// Reads the level bands of the handles' fields at the vertices of one piece, and joins them along edges into patches.
//
// A vertex has a slot for each field that counts there (share beta > 0, bands.h), with its B-splines. A patch is an
// edge-connected part of one level band of one field inside the piece. Every piece is read by itself, so pieces run on
// several threads. Cost: O(handles) per vertex, and O(1) per edge and slot.
#pragma once
#include "deform/bands.h"

namespace hf_inner::deform {

// One field at one vertex.
struct BandSlot {
  std::int32_t part;   // the field (index of FieldPart)
  std::int16_t first;  // value[a] belongs to the band first + a
  std::uint16_t open;  // bit a: the band first + a is interior, and value[a] > 0
  double share;        // how much the field counts (beta)
  double value[3];     // B-splines of the field's level
};

// The bands of one piece of vertices, from `first` on.
struct PieceBands {
  struct Patch {
    std::int32_t part, band;
    double area;  // sum of vertex areas times beta times B-spline
  };
  explicit PieceBands(const std::pmr::polymorphic_allocator<std::byte>& allocator)
      : start(allocator), slot(allocator), patch_of(allocator), patch(allocator), border(allocator) {}
  Span<const BandSlot> slots_of(std::int32_t v) const noexcept {
    const auto i = static_cast<std::size_t>(v - first);
    return {slot.data() + start[i], static_cast<std::size_t>(start[i + 1] - start[i])};
  }
  std::int32_t first = 0;
  Vector<std::int32_t> start;     // slots of vertex first + i: [start[i], start[i + 1]), by part
  Vector<BandSlot> slot;          // none on handles and in components with less than two handles
  Vector<std::int32_t> patch_of;  // of band a of slot k: patch_of[3 k + a], or -1 where there is no band to join
  Vector<Patch> patch;            // ascending by their first vertex
  Vector<std::int32_t> border;    // vertices with slots and with a neighbour in an earlier piece
};

// The tables from which the bands of all pieces are read.
struct BandSource {
  const surface::Core& core;
  const Rest& rest;
  const Reach& reach;
  const HandleFields& fields;
  const Vector<FieldPart>& parts;
  const Vector<std::int32_t>& part_start;  // fields of component c: parts[part_start[c] .. part_start[c + 1])
  const Vector<Levels>& levels;            // by part
  std::int32_t band_count;                 // K
  int degree;
};

// Calls join(a, b) for every interior band in which two slots of one field are both positive: band a of the first slot
// is band b of the second.
template <class Join>
inline void for_common_bands(const BandSlot& first, const BandSlot& second, Join&& join) {
  const int up = first.first - second.first;
  if (up < -2 || up > 2) return;
  const unsigned common = first.open & (up < 0 ? second.open << -up : second.open >> up);
  for (int a = 0; a < 3; ++a) {
    if (common >> a & 1) join(a, a + up);
  }
}

// Reads the bands of the vertices [first, last).
void read_bands(const BandSource& source, std::int32_t first, std::int32_t last, PieceBands& out, Memory& memory);

}  // namespace hf_inner::deform
