// One side of a transfer: the regions of all pairs on one surface, and harmonic coordinates of its vertices.
//
// The field u_h is harmonic, 1 on region h and 0 on the other regions, as in a pose (deform/handles.h). The row U(v) =
// (u_1 .. u_H)(v) of a vertex v sums to 1. The full rings of the regions are sites, so that no field leaks into a
// region.
//
// A component without a region (an eye, a strap) follows the surface beside it. One third of its vertices, those
// nearest to that surface, copy its rows. The other vertices relax between them. A small component gets one row.
//
// Cost: an edit solves the elimination paths of the rings' sites, and a call of solve() makes one sweep for H channels.
// The factor never changes. After a failed edit the object can only be destroyed: Transfer edits copies and swaps them
// in.
#pragma once
#include <cstdint>
#include <memory>

#include "base/span.h"
#include "deform/handles.h"

namespace hf_inner::transfer {

class PairFields {
 public:
  explicit PairFields(std::shared_ptr<const surface::Core> core);
  PairFields(const PairFields& other);
  PairFields(PairFields&&) = default;
  PairFields& operator=(const PairFields&) = delete;
  PairFields& operator=(PairFields&&) = default;

  // regions[i] becomes the region of pair numbers[i], a number not in use. Vertices may repeat inside a region. `side`
  // names the surface in messages. Throws HF_ERROR_EMPTY (index: pair in the batch). Throws HF_ERROR_OUT_OF_RANGE and
  // HF_ERROR_CONFLICT (index: position in the list of all regions, one after the other).
  void add(Span<const std::uint32_t> numbers, Span<const Span<const std::int32_t>> regions, const char* side);
  // Removes the regions of these pairs. Every number must be in use.
  void remove(Span<const std::uint32_t> numbers);

  // Fills field[v * H + i] with u of pair numbers[i] at vertex v, H the number of pairs. The number leaks[i] is the
  // largest deviation before clipping: from 1 on region i, or from 0 on the others.
  void solve(Span<const std::uint32_t> numbers, double* field, double* leaks) const;

  bool in_use(std::uint32_t number) const noexcept { return number < regions_.size() && regions_[number]; }
  Span<const std::int32_t> region(std::uint32_t number) const noexcept { return regions_[number]->vertices; }
  solve::EngineCounters counters() const noexcept { return solver_->counters(); }

 private:
  deform::Handles listed() const;  // the regions by ascending number: the order of their sites

  std::shared_ptr<const surface::Core> core_;
  std::shared_ptr<solve::SiteSolver> solver_;
  Vector<std::int32_t> owner_;                                   // per inner vertex: its pair, or -1
  Vector<std::shared_ptr<const deform::HandleRegion>> regions_;  // by pair number; null: number not in use
};

// Fills the field values of vertices in components without a region (an eye, a strap). reached: by component, 1 if it
// has a region. It is declared here so that its test can call it.
void attach_islands(const surface::Core& core, Span<const std::uint8_t> reached, std::int32_t channels, double* field);

}  // namespace hf_inner::transfer
