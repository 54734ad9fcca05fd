// Bisects one part of a nested dissection on a multilevel hierarchy; see dissection.h.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "factor/separator.h"

namespace hf_inner::factor {

class MultilevelBisection {
 public:
  explicit MultilevelBisection(Memory& memory)
      : memory_(memory), search_(memory), levels_(&memory), cluster_start_(&memory), mark_(&memory), queue_(&memory) {}

  // Splits a graph into two sides and a separator. Writes side[v]: left, right or between. Returns an unusable cut when
  // the graph cannot be split.
  Cut run(const GraphView& graph, std::uint8_t* side);

 private:
  struct Level {
    explicit Level(Memory& memory)
        : start(&memory), neighbour(&memory), cluster(&memory), weight(&memory), point(&memory), side(&memory) {}
    GraphView view;
    Vector<std::int32_t> start, neighbour;
    Vector<std::int32_t> cluster;  // from a vertex of the finer graph to its vertex on this level
    Vector<std::int32_t> weight;
    Vector<float> point;
    Vector<std::uint8_t> side;
  };
  static std::int32_t make_clusters(const GraphView& fine, std::int32_t* cluster);
  void coarsen(const GraphView& fine, Level& coarse);
  Cut carry_back(const GraphView& fine, const Level& coarse, std::uint8_t* side);
  void widen(const GraphView& graph, std::uint8_t* side, int rings);

  Memory& memory_;
  SeparatorSearch search_;
  std::pmr::vector<Level> levels_;
  Vector<std::int32_t> cluster_start_, mark_, queue_;
};

}  // namespace hf_inner::factor
