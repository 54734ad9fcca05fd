#include "field/spread.h"

#include <algorithm>
#include <limits>

namespace hf {
namespace {

using Index = std::int32_t;
std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
constexpr double far = std::numeric_limits<double>::infinity();

// Shortest edge paths by corrections in steps of the distance: vertices nearer than the limit are worked off first come
// first served, those beyond it wait for the limit to rise (delta-stepping; Meyer and Sanders 2003, on one thread). The
// distances are the same as by a heap, at a third of the time.
class Search {
 public:
  Search(const Mesh& mesh, const Topology& topology, Memory& memory)
      : distance(mesh.positions.size(), far, &memory),
        owner(mesh.positions.size(), Mesh::none, &memory),
        topology_(topology),
        length_(topology.neighbour.size(), &memory),
        near_(&memory),
        waiting_(&memory) {
    double sum = 0;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
        length_[at(i)] = norm(mesh.positions[at(v)] - mesh.positions[at(topology.neighbour[at(i)])]);
        sum += length_[at(i)];
      }
    }
    step_ = 2 * sum / static_cast<double>(std::max<std::size_t>(1, length_.size()));
  }

  // Vertices nearer to `source` than to all before become its own.
  void grow(Index source, Index name) {
    distance[at(source)] = 0, owner[at(source)] = name;
    near_.assign(1, source), waiting_.clear();
    for (double limit = step_; !near_.empty(); limit = work_off(limit, name)) {
    }
  }

  Vector<double> distance;
  Vector<Index> owner;

 private:
  // Empties the near list; returns the next limit with the vertices below it in the list.
  double work_off(double limit, Index name) {
    for (std::size_t head = 0; head < near_.size(); ++head) {
      const Index v = near_[head];
      const double here = distance[at(v)];
      for (Index i = topology_.neighbour_start[at(v)]; i < topology_.neighbour_start[at(v) + 1]; ++i) {
        const Index w = topology_.neighbour[at(i)];
        const double through = here + length_[at(i)];
        if (!(through < distance[at(w)])) continue;
        distance[at(w)] = through, owner[at(w)] = name;
        (through < limit ? near_ : waiting_).push_back(w);
      }
    }
    near_.clear();
    double nearest = far;
    for (const Index v : waiting_) {
      if (distance[at(v)] >= limit) nearest = std::min(nearest, distance[at(v)]);
    }
    const double next = nearest + step_;
    std::size_t kept = 0;
    for (const Index v : waiting_) {
      if (distance[at(v)] < limit) continue;  // was worked off after a nearer way was found
      if (distance[at(v)] < next)
        near_.push_back(v);
      else
        waiting_[kept++] = v;
    }
    waiting_.resize(kept);
    return next;
  }

  const Topology& topology_;
  Vector<double> length_;  // of the edge to each neighbour
  Vector<Index> near_, waiting_;
  double step_ = 1;
};

}  // namespace

SpreadSamples spread_samples(const Mesh& mesh, const Topology& topology, const Vector<double>& areas, Index count,
                             Memory& memory) {
  const std::size_t components = at(mesh.component_count());
  SpreadSamples samples(memory);
  samples.count = count;
  samples.vertex.assign(components * at(count), Mesh::none);
  samples.share.assign(components * at(count), 0.0);
  Search search(mesh, topology, memory);
  Vector<Index> farthest(components, &memory);
  const auto find_farthest = [&] {
    std::fill(farthest.begin(), farthest.end(), Mesh::none);
    if (components == 1) {
      double most = -1;
      Index best = Mesh::none;
      for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (search.distance[at(v)] > most) most = search.distance[at(v)], best = v;
      }
      farthest[0] = best;
      return;
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      Index& best = farthest[at(mesh.component[at(v)])];
      if (best == Mesh::none || search.distance[at(v)] > search.distance[at(best)]) best = v;
    }
  };
  find_farthest();  // everything is far: the first vertex of each component
  for (const Index v : farthest) search.grow(v, 0);
  find_farthest();
  std::fill(search.distance.begin(), search.distance.end(), far);
  for (Index round = 0; round < count; ++round) {
    for (std::size_t c = 0; c < components; ++c) {
      const Index v = farthest[c];
      if (!(search.distance[at(v)] > 0)) continue;
      samples.vertex[c * at(count) + at(round)] = v;
      search.grow(v, round);
    }
    find_farthest();
  }
  Vector<double> total(components, 0.0, &memory);
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const std::size_t c = at(mesh.component[v]);
    samples.share[c * at(count) + at(search.owner[v])] += areas[v];
    total[c] += areas[v];
  }
  for (std::size_t i = 0; i < samples.share.size(); ++i) {
    if (total[i / at(count)] > 0) samples.share[i] /= total[i / at(count)];
  }
  return samples;
}

}  // namespace hf
