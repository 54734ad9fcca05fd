// Finds shortest paths along the edges of a surface (Dijkstra's algorithm).
#pragma once
#include "mesh/mesh.h"
#include "mesh/topology.h"

namespace hf_inner::mesh {

// All paths share the same arrays. A path costs O(d log d) for the d vertices nearer than its end.
class EdgePaths {
 public:
  EdgePaths(const Mesh& mesh, const Topology& topology, Memory& memory);

  // Appends the vertices of the shortest path from `from` to `to`; `to` itself is left out. Returns the length of the
  // path: infinite, and nothing is appended, where no path leads there.
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
  const Mesh& mesh_;
  const Topology& topology_;
  Vector<std::int32_t> before_;
  Vector<std::uint8_t> done_;
  Vector<std::int32_t> touched_;
  Vector<Reached> heap_;
};

}  // namespace hf_inner::mesh
