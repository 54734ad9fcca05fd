#include "mesh/front_distance.h"

#include <algorithm>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/intrinsic.h"
#include "mesh/unfold.h"

namespace hf_inner::mesh {
namespace {

// A vertex is visited again if its distance falls by at least this share. The number exceeds rounding errors, which
// could otherwise keep the loop running for ever. Half and double move distances on two of seven shapes by at most
// 9e-14 of the largest.
constexpr double least_shortening = 1e-13;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t report_each = 8192;  // vertices between reports of progress

}  // namespace

FrontDistance::FrontDistance(const Mesh& mesh, const Topology& topology, Memory& memory, JobRunner* jobs)
    : mesh_(&mesh), memory_(&memory), start_(mesh.positions.size() + 1, 0, &memory), corner_(&memory) {
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

// Follows the fronts of all sources at once. Every vertex knows its nearest source, and no distance is below the
// straight line to it.
class FrontDistance::Fronts {
 public:
  Fronts(const FrontDistance& shape, Span<const Index> sources, double* out)
      : shape_(shape), out_(out), source_of_(shape.start_.size() - 1, Mesh::none, shape.memory_), heap_(shape.memory_) {
    std::fill_n(out, source_of_.size(), infinite);
    for (const Index s : sources) offer(s, 0, s);
  }

  void run() {
    for (std::size_t visited = 1; !heap_.empty(); ++visited) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Entry here = heap_.back();
      heap_.pop_back();
      if (here.distance > out_[here.vertex]) continue;
      if (visited % report_each == 0) report(static_cast<float>(reached_) / static_cast<float>(source_of_.size()));
      for (Index i = shape_.start_[at(here.vertex)]; i < shape_.start_[at(here.vertex) + 1]; ++i) {
        const Corner& c = shape_.corner_[at(i)];
        const Index source = source_of_[at(here.vertex)];
        offer(c.a, here.distance + c.to_a, source);
        offer(c.b, here.distance + c.to_b, source);
        cross(here.vertex, c.a, c.b, c.to_a, c.to_b, c.across);
        cross(here.vertex, c.b, c.a, c.to_b, c.to_a, c.across);
      }
    }
  }

 private:
  struct Entry {
    double distance;
    Index vertex;
    // The heap's largest is the nearest.
    bool operator<(const Entry& o) const noexcept {
      return distance != o.distance ? distance > o.distance : vertex > o.vertex;
    }
  };

  void offer(Index v, double d, Index source) {
    if (!(d < out_[v] * (1 - least_shortening))) return;
    d = std::max(d, line(v, source));
    if (!(d < out_[v] * (1 - least_shortening))) return;
    reached_ += out_[v] == infinite;
    out_[v] = d;
    source_of_[at(v)] = source;
    heap_.push_back({d, v});
    std::push_heap(heap_.begin(), heap_.end());
  }

  // Carries the front of each source across the triangle of a, b and c, from the edge of a and b to c.
  void cross(Index a, Index b, Index c, double ab, double ac, double bc) {
    if (source_of_[at(b)] == Mesh::none) return;
    if (source_of_[at(a)] == source_of_[at(b)])
      return offer(c, distance_across(out_[a], out_[b], ab, ac, bc), source_of_[at(a)]);
    // Two distances from two sources give the place of neither.
    carry(a, b, c, ab, ac, bc);
    carry(b, a, c, ab, bc, ac);
  }

  // Carries the front of the source of a, which is not the source of b, if it can be nearer to c than the known source.
  void carry(Index a, Index b, Index c, double ab, double ac, double bc) {
    const Index source = source_of_[at(a)];
    if (line(c, source) < out_[c]) offer(c, distance_across(out_[a], guess(a, b, ab), ab, ac, bc), source);
  }

  // Guesses the distance of b from the source of its neighbour a, which is not the nearest source to b. It exceeds the
  // straight line by the same factor as the distance of a.
  double guess(Index a, Index b, double ab) const noexcept {
    const Index source = source_of_[at(a)];
    const double straight = line(a, source), factor = straight > 0 ? out_[a] / straight : 1.0;
    return std::min(std::max(factor * line(b, source), out_[b]), out_[a] + ab);
  }

  double line(Index v, Index source) const noexcept {
    return norm(shape_.mesh_->positions[at(v)] - shape_.mesh_->positions[at(source)]);
  }

  const FrontDistance& shape_;
  double* out_;
  Vector<Index> source_of_;  // by vertex: the nearest source
  Vector<Entry> heap_;
  std::size_t reached_ = 0;
};

void FrontDistance::distance(Span<const Index> sources, double* out) const { Fronts(*this, sources, out).run(); }

}  // namespace hf_inner::mesh
