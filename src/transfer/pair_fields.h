// One side of a transfer: regions of all pairs on one surface, and harmonic coordinates of its vertices.
//
// u_h is harmonic, 1 on region h and 0 on the other regions, as in a pose (deform/handles.h). The row
// U(v) = (u_1 .. u_H)(v) sums to 1. The full rings of the regions are sites, so that nothing leaks into a region.
//
// A component without a region (an eye, a strap) follows the surface beside it. The third of its vertices that is
// nearest takes the rows of that surface; the rest is relaxed between them. A small component gets one row.
//
// Cost: the engine pays for an edit by the elimination paths of the rings. solve() is one sweep for H channels. No
// factor changes. After an edit that fails the object can only be destroyed: Transfer edits copies and swaps them in.
#pragma once
#include <cstdint>
#include <memory>

#include "base/span.h"
#include "deform/handles.h"

namespace hf_inner {

class PairFields {
 public:
  explicit PairFields(std::shared_ptr<const Core> core);
  PairFields(const PairFields& other);
  PairFields(PairFields&&) = default;
  PairFields& operator=(const PairFields&) = delete;
  PairFields& operator=(PairFields&&) = default;

  // regions[i] becomes the region of pair numbers[i], which must be free. Vertices may repeat inside a region.
  // Throws HF_ERROR_EMPTY (index = pair in the batch), HF_ERROR_OUT_OF_RANGE and HF_ERROR_OVERLAP (index = position in
  // all regions one after the other). `side` names the surface in messages.
  void add(Span<const std::uint32_t> numbers, Span<const Span<const std::int32_t>> regions, const char* side);
  // The numbers must be in use.
  void remove(Span<const std::uint32_t> numbers);

  // field[v * H + i] = U of pair numbers[i]; leaks[i] = largest deviation from 1 on region i or from 0 on the others
  // before clipping.
  void solve(Span<const std::uint32_t> numbers, double* field, double* leaks) const;

  bool in_use(std::uint32_t number) const noexcept { return number < regions_.size() && regions_[number]; }
  Span<const std::int32_t> region(std::uint32_t number) const noexcept { return regions_[number]->vertices; }
  EngineCounters counters() const noexcept { return solver_->counters(); }

 private:
  std::shared_ptr<const Core> core_;
  std::shared_ptr<SiteSolver> solver_;
  Vector<std::int32_t> owner_;                           // per inner vertex: its pair, or -1
  Vector<std::shared_ptr<const HandleRegion>> regions_;  // by pair number; null = free
  Vector<std::uint8_t> slot_used_;
};

// Rows of vertices in components without a region; `reached` per component. Declared here for its test.
void attach_islands(const Core& core, Span<const std::uint8_t> reached, std::int32_t channels, double* field);

}  // namespace hf_inner
