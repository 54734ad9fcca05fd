#include "mesh/edge_paths.h"

#include <algorithm>
#include <limits>

#include "base/index.h"
#include "base/progress.h"

namespace hf_inner::mesh {

EdgePaths::EdgePaths(const Mesh& mesh, const Topology& topology, Memory& memory)
    : mesh_(mesh),
      topology_(topology),
      before_(mesh.positions.size(), Mesh::none, &memory),
      done_(mesh.positions.size(), 0, &memory),
      touched_(&memory),
      heap_(&memory) {}

double EdgePaths::append(Index from, Index to, Vector<Index>& out) {
  if (from == to) return 0;
  const SharedVector<Vec3>& position = mesh_.positions;
  Poller poller;
  double length = std::numeric_limits<double>::infinity();
  // The search runs backwards, so that `before` leads from the start to the end.
  heap_.assign(1, {0.0, to, Mesh::none});
  while (!heap_.empty()) {
    poller.due();
    std::pop_heap(heap_.begin(), heap_.end());
    const Reached here = heap_.back();
    heap_.pop_back();
    if (done_[at(here.vertex)]) continue;
    done_[at(here.vertex)] = 1;
    before_[at(here.vertex)] = here.before;
    touched_.push_back(here.vertex);
    if (here.vertex == from) {
      length = here.distance;
      break;
    }
    for (Index i = topology_.neighbour_start[at(here.vertex)]; i < topology_.neighbour_start[at(here.vertex) + 1];
         ++i) {
      const Index next = topology_.neighbour[at(i)];
      if (done_[at(next)]) continue;
      heap_.push_back({here.distance + norm(position[at(next)] - position[at(here.vertex)]), next, here.vertex});
      std::push_heap(heap_.begin(), heap_.end());
    }
  }
  for (Index v = from; done_[at(from)] && v != to; v = before_[at(v)]) out.push_back(v);
  for (const Index v : touched_) done_[at(v)] = 0;
  touched_.clear();
  return length;
}

}  // namespace hf_inner::mesh
