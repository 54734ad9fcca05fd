#include "mesh/front_distance.h"

#include <algorithm>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/intrinsic.h"
#include "mesh/unfold.h"

namespace hf_inner {
namespace {

// A vertex is visited again if its distance falls by at least this share. The number exceeds rounding errors, which
// could otherwise keep the loop running for ever. Half and double move distances on two of seven shapes by at most
// 9e-14 of the largest.
constexpr double least_shortening = 1e-13;
constexpr std::size_t report_each = 8192;  // vertices between reports of progress

}  // namespace

FrontDistance::FrontDistance(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs)
    : memory_(&memory), start_(mesh.positions.size() + 1, 0, &memory), corner_(&memory) {
  IntrinsicTriangulation cover = IntrinsicTriangulation::make(mesh, topology, memory, jobs);
  poll();
  cover.flip_to_delaunay(0, jobs);
  const Index halves = 3 * cover.face_count();
  poll();
  for (Index h = 0; h < halves; ++h) ++start_[at(cover.tail(h)) + 1];
  for (std::size_t v = 0; v + 1 < start_.size(); ++v) start_[v + 1] += start_[v];
  corner_.resize(at(halves));
  Vector<Index> cursor(start_.begin(), start_.end() - 1, &memory);
  Poller poller;
  for (Index f = 0; f < cover.face_count(); ++f) {
    poller.due();
    for (Index k = 0; k < 3; ++k) {
      const Index h = 3 * f + k, opposite = 3 * f + (k + 1) % 3, back = 3 * f + (k + 2) % 3;
      corner_[at(cursor[at(cover.tail(h))]++)] = {cover.length(h), cover.length(back), cover.length(opposite),
                                                  cover.tail(opposite), cover.tail(back)};
    }
  }
}

void FrontDistance::distance(Span<const Index> sources, double* out) const {
  struct Entry {
    double distance;
    Index vertex;
    // The heap's largest is the nearest.
    bool operator<(const Entry& o) const noexcept {
      return distance != o.distance ? distance > o.distance : vertex > o.vertex;
    }
  };
  const std::size_t n = start_.size() - 1;
  std::fill_n(out, n, std::numeric_limits<double>::infinity());
  Vector<Entry> heap(memory_);
  std::size_t reached = 0;
  const auto offer = [&](Index v, double d) {
    if (!(d < out[v] * (1 - least_shortening))) return;
    reached += out[v] == std::numeric_limits<double>::infinity();
    out[v] = d;
    heap.push_back({d, v});
    std::push_heap(heap.begin(), heap.end());
  };
  for (const Index s : sources) offer(s, 0);
  for (std::size_t visited = 1; !heap.empty(); ++visited) {
    std::pop_heap(heap.begin(), heap.end());
    const Entry here = heap.back();
    heap.pop_back();
    if (here.distance > out[here.vertex]) continue;
    if (visited % report_each == 0) report(static_cast<float>(reached) / static_cast<float>(n));
    for (Index i = start_[at(here.vertex)]; i < start_[at(here.vertex) + 1]; ++i) {
      const Corner& c = corner_[at(i)];
      offer(c.a, here.distance + c.to_a), offer(c.b, here.distance + c.to_b);
      offer(c.b, distance_across(here.distance, out[c.a], c.to_a, c.to_b, c.across));
      offer(c.a, distance_across(here.distance, out[c.b], c.to_b, c.to_a, c.across));
    }
  }
}

}  // namespace hf_inner
