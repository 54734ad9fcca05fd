#include "detail/edge_paths.h"

#include <algorithm>

#include "base/index.h"
#include "base/progress.h"

namespace hf_inner {

EdgePaths::EdgePaths(const Core& core, Memory& memory)
    : core_(core),
      before_(at(core.size()), Mesh::none, &memory),
      done_(at(core.size()), 0, &memory),
      touched_(&memory),
      heap_(&memory) {}

double EdgePaths::append(Index from, Index to, Vector<Index>& out) {
  if (from == to) return 0;
  const Topology& topology = core_.geometry->unlinked().topology;
  const Vector<Vec3>& position = core_.mesh.positions;
  Poller poller;
  double length = 0;
  // The search runs backwards, so that `before` leads from the start to the end.
  heap_.assign(1, {0.0, to, Mesh::none});
  while (true) {
    poller.due();
    std::pop_heap(heap_.begin(), heap_.end());
    const Reached here = heap_.back();
    heap_.pop_back();
    if (done_[at(here.vertex)]) continue;
    done_[at(here.vertex)] = 1, before_[at(here.vertex)] = here.before, touched_.push_back(here.vertex);
    length = here.distance;
    if (here.vertex == from) break;
    for (Index i = topology.neighbour_start[at(here.vertex)]; i < topology.neighbour_start[at(here.vertex) + 1]; ++i) {
      const Index next = topology.neighbour[at(i)];
      if (done_[at(next)]) continue;
      heap_.push_back({here.distance + norm(position[at(next)] - position[at(here.vertex)]), next, here.vertex});
      std::push_heap(heap_.begin(), heap_.end());
    }
  }
  for (Index v = from; v != to; v = before_[at(v)]) out.push_back(v);
  for (const Index v : touched_) done_[at(v)] = 0;
  touched_.clear();
  return length;
}

}  // namespace hf_inner
