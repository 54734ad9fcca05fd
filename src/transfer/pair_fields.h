// One side of a transfer: the regions of all pairs on one surface, and the harmonic coordinates they give its vertices.
//
// u_h is harmonic with u_h = 1 on region h and 0 on the other regions; the row U(v) = (u_1 .. u_H)(v) sums to 1: the
// handle fields of a pose (deform/handles.h), with the full rings of the regions as sites, so that nothing leaks into a
// region.
//
// Components that hold no region (eyes, teeth, straps) follow what they lie next to: the third of their vertices that
// is nearest to the reached surface takes U from there, the rest is relaxed between them; a component smaller than 3 %
// of the box gets one row.
//
// Cost: an edit is paid by the engine (paths of the rings); solve() is one sweep for H channels. No factor is touched.
// An edit that fails leaves the object fit for destruction only: Transfer edits copies and swaps them in.
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
