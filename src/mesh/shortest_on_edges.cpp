#include "mesh/shortest_on_edges.h"

#include <algorithm>
#include <cmath>

#include "base/index.h"

namespace hf_inner::mesh {
namespace {

// Paths that are shorter by less than this share of the box diagonal count as equal; the later one is dropped. It is
// above the rounding of a sum and of a root. Smaller keeps windows of equal paths, larger adds to the error at each
// edge.
constexpr double equal_paths = 1e-13;

// Writes the places where two families of paths are as long, at most two and perhaps more than there are.
Index crossings(const EdgeRays& p, const EdgeRays& q, double place[2]) noexcept {
  // sqrt(P) = sqrt(Q) + d, with P - Q = a u + b linear: (a u + b - d^2)^2 = 4 d^2 Q
  const double d = q.sigma - p.sigma, a = 2 * (q.x - p.x);
  const double c = p.x * p.x + p.y * p.y - q.x * q.x - q.y * q.y - d * d;
  const double square = a * a - 4 * d * d, half = a * c + 4 * d * d * q.x;
  const double constant = c * c - 4 * d * d * (q.x * q.x + q.y * q.y);
  const double root = half * half - square * constant;
  if (!(root >= 0)) return 0;
  const double sum = -(half + std::copysign(std::sqrt(root), half));
  Index count = 0;
  if (square != 0) place[count++] = sum / square;
  if (sum != 0) place[count++] = constant / sum;
  return count;
}

// Appends the parts of an interval where the new paths are shorter than the old ones.
void subtract(const EdgeRays& old, const EdgeRays& rays, Interval interval, Vector<Interval>& out) {
  const auto append = [&](double begin, double end) {
    if (!(end > begin)) return;
    if (!out.empty() && out.back().end == begin)
      out.back().end = end;
    else
      out.push_back({begin, end});
  };
  const double begin = std::max(interval.begin, old.part.begin), end = std::min(interval.end, old.part.end);
  if (!(end > begin)) return append(interval.begin, interval.end);
  EdgeRays known = old;
  known.sigma -= equal_paths;
  double cut[4] = {begin, 0, 0, end}, place[2];
  Index cuts = 1;
  const Index count = crossings(known, rays, place);
  if (count == 2 && place[0] > place[1]) std::swap(place[0], place[1]);
  for (Index k = 0; k < count; ++k) {
    if (place[k] > cut[cuts - 1] && place[k] < end) cut[cuts++] = place[k];
  }
  cut[cuts] = end;
  const auto as_short = [&](double u, double rounding) { return known.length_to(u) <= rays.length_to(u) + rounding; };
  append(interval.begin, begin);
  for (Index k = 0; k < cuts; ++k) {
    const double from = cut[k], to = cut[k + 1];
    const bool covered = as_short(0.5 * (from + to), 0) && as_short(from, equal_paths) && as_short(to, equal_paths);
    if (!covered) append(from, to);
  }
  append(end, interval.end);
}

}  // namespace

double EdgeRays::length_to(double u) const noexcept { return sigma + std::sqrt((u - x) * (u - x) + y * y); }

void ShortestOnEdges::keep(Index edge, const EdgeRays& rays, Vector<Interval>& parts) {
  if (last_.empty()) last_.assign(at(edge_count_), Index{-1});
  parts.assign(1, rays.part);
  for (Index k = last_[at(edge)]; k >= 0 && !parts.empty(); k = known_[at(k)].before) {
    rest_.clear();
    for (const Interval& part : parts) subtract(known_[at(k)].rays, rays, part, rest_);
    parts.swap(rest_);
  }
  for (const Interval& part : parts) {
    known_.push_back({{part, rays.x, rays.y, rays.sigma}, last_[at(edge)]});
    last_[at(edge)] = static_cast<Index>(known_.size()) - 1;
  }
}

}  // namespace hf_inner::mesh
