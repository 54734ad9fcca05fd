// Finds minimum vertex separators of a graph, for nested dissection.
//
// A bisection fixes two sides and leaves a band between them. The smallest set of band vertices that separates the
// sides is as large as the largest set of vertex-disjoint paths through the band (Menger). Dinic's algorithm finds
// these paths on split vertices of capacity 1, stored as predecessors and successors on the paths. The residual graph
// gives both extreme minimum cuts, and the better balanced one is taken. Cost: O(band edges) per phase, with a handful
// of phases. Deterministic.
#pragma once
#include <cstdint>

#include "base/memory.h"

namespace hf_inner::factor {

// A graph without loops. Both directions of every edge are stored.
struct GraphView {
  std::int32_t size = 0;
  const std::int32_t* start = nullptr;
  const std::int32_t* neighbour = nullptr;
  const float* point = nullptr;          // xyz per vertex, or null
  const std::int32_t* weight = nullptr;  // number of original vertices in a vertex, or null for 1 each
  std::int32_t weight_of(std::int32_t v) const noexcept { return weight ? weight[v] : 1; }
};

enum : std::uint8_t { side_left = 0, side_right = 1, side_between = 2 };

struct Cut {
  std::int32_t separator = 0;        // number of vertices between the sides
  std::int64_t left = 0, right = 0;  // number of vertices on the two sides
  bool usable() const noexcept { return left > 0 && right > 0; }
  double score() const noexcept;  // smaller is better: size times (1 + squared imbalance)
};

class SeparatorSearch {
 public:
  explicit SeparatorSearch(Memory& memory)
      : band_(&memory),
        slot_(&memory),
        band_start_(&memory),
        band_neighbour_(&memory),
        flags_(&memory),
        level_(&memory),
        previous_(&memory),
        next_(&memory),
        queue_(&memory),
        stack_(&memory),
        iterator_(&memory),
        reach_(&memory),
        ranked_(&memory),
        trial_(&memory),
        key_(&memory) {}

  // Replaces the band by a minimum separator inside it. side[v] is left, right or between. On entry, the vertices
  // between are the band, which must separate the sides.
  Cut refine(const GraphView& graph, std::uint8_t* side);

  // Bisects a small graph by keys: positions along its principal axes, or a breadth-first order when the positions have
  // no extent. `thorough` tries diagonal axes too. Returns an unusable cut when the graph cannot be split.
  Cut bisect(const GraphView& graph, std::uint8_t* side, bool thorough);

 private:
  void collect_band(const GraphView& graph, const std::uint8_t* side);
  bool label_phase();
  std::int32_t augment_phase();
  void apply_path();
  void mark_reaching_sink();
  Cut choose_cut(const GraphView& graph, std::uint8_t* side);
  bool try_keys(const GraphView& graph, std::uint8_t* side, Cut& best, double share);
  void breadth_first_keys(const GraphView& graph);
  void projection_keys(const GraphView& graph, const double* axis);

  Vector<std::int32_t> band_, slot_, band_start_, band_neighbour_;
  Vector<std::uint8_t> flags_;
  Vector<std::int32_t> level_, previous_, next_, queue_, stack_, iterator_;
  Vector<std::uint8_t> reach_;
  Vector<std::uint64_t> ranked_;
  Vector<std::uint8_t> trial_;
  Vector<float> key_;
};

}  // namespace hf_inner::factor
