// Finds shortest paths along the edges of a surface (Dijkstra's algorithm).
#pragma once
#include "engine/core.h"

namespace hf_inner {

// All paths share the same arrays. A path costs O(d log d) for the d vertices nearer than its end.
class EdgePaths {
 public:
  EdgePaths(const Core& core, Memory& memory);

  // Appends the vertices of the shortest path from `from` to `to`, which lies in the same component; `to` itself is
  // left out. Returns the length of the path.
  double append(std::int32_t from, std::int32_t to, Vector<std::int32_t>& out);

 private:
  struct Reached {
    double distance;
    std::int32_t vertex, before;
    bool operator<(const Reached& o) const noexcept {  // the nearest on top of the heap
      return distance != o.distance ? distance > o.distance
             : vertex != o.vertex   ? vertex > o.vertex
                                    : before > o.before;
    }
  };
  const Core& core_;
  Vector<std::int32_t> before_;
  Vector<std::uint8_t> done_;
  Vector<std::int32_t> touched_;
  Vector<Reached> heap_;
};

}  // namespace hf_inner
