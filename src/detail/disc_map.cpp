#include "detail/disc_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.h"
#include "base/error.h"
#include "base/index.h"
#include "detail/constants.h"
#include "factor/factor.h"

namespace hf_inner::detail {
namespace {

struct HalfEdge {
  Index from, to;
  bool operator<(const HalfEdge& o) const noexcept { return from != o.from ? from < o.from : to < o.to; }
  bool operator==(const HalfEdge& o) const noexcept { return from == o.from && to == o.to; }
};

[[noreturn]] void no_disc(const RegionSurface& surface, const RegionState& state, Index local, const char* what) {
  const Index given = surface.core->mesh.given_of_inner[at(state.shape->vertex(local))];
  fail(HF_ERROR_UNSUPPORTED, static_cast<std::uint32_t>(given), "the region is no disc: %s at vertex %d", what, given);
}

// Returns the cotangent weights of these edges, each raised to a small positive number (disc_least_weight).
Vector<double> positive_weights(const surface::Core& core, Span<const Index> edges, Memory& memory) {
  Vector<double> weights(&memory), magnitude(&memory);
  for (const Index e : edges) {
    weights.push_back(core.geometry->unlinked().weights()[at(e)]);
    magnitude.push_back(std::fabs(weights.back()));
  }
  if (weights.empty()) return weights;
  const auto middle = magnitude.begin() + static_cast<std::ptrdiff_t>(magnitude.size() / 2);
  std::nth_element(magnitude.begin(), middle, magnitude.end());
  const double least = *middle > 0 ? disc_least_weight * *middle : 1.0;
  for (double& w : weights) w = std::max(w, least);
  return weights;
}

// Finds the point of the segment a-b nearest to p. Returns the weight of b in it, from 0 to 1.
double along(DiscPoint a, DiscPoint b, DiscPoint p) noexcept {
  const double u = b.u - a.u, v = b.v - a.v, length = u * u + v * v;
  const double t = length > 0 ? ((p.u - a.u) * u + (p.v - a.v) * v) / length : 0;
  return std::min(std::max(t, 0.0), 1.0);
}

double squared(DiscPoint a, DiscPoint b) noexcept { return (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v); }

// Returns the squared distance from p to a triangle. weights: barycentric weights of the triangle's nearest point.
double nearest(const DiscPoint c[3], DiscPoint p, double weights[3]) noexcept {
  double area[3], whole = 0;
  for (int k = 0; k < 3; ++k) {
    const DiscPoint a = c[(k + 1) % 3], b = c[(k + 2) % 3];
    area[k] = (a.u - p.u) * (b.v - p.v) - (b.u - p.u) * (a.v - p.v);
    whole += area[k];
  }
  if (whole > 0 && area[0] >= 0 && area[1] >= 0 && area[2] >= 0) {
    for (int k = 0; k < 3; ++k) weights[k] = area[k] / whole;
    return 0;
  }
  double best = -1;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3;
    const double t = along(c[k], c[l], p);
    const double d = squared(p, {c[k].u + t * (c[l].u - c[k].u), c[k].v + t * (c[l].v - c[k].v)});
    if (best >= 0 && d >= best) continue;
    best = d;
    weights[k] = 1 - t;
    weights[l] = t;
    weights[(k + 2) % 3] = 0;
  }
  return best;
}

}  // namespace

DiscBoundary::DiscBoundary(const RegionSurface& surface, const RegionState& state, Memory& memory)
    : loop(&memory), arc(&memory), place_(at(state.shape->local_count()), -1, &memory) {
  const RegionShape& shape = *state.shape;
  if (shape.inside.empty()) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "the region has no vertices; edit it first");
  Vector<HalfEdge> half(&memory);
  half.reserve(shape.corners.size());
  for (std::size_t i = 0; i < shape.corners.size(); ++i)
    half.push_back({shape.corners[i], shape.corners[i % 3 == 2 ? i - 2 : i + 1]});
  std::sort(half.begin(), half.end());
  for (std::size_t i = 1; i < half.size(); ++i)
    if (half[i] == half[i - 1]) no_disc(surface, state, half[i].from, "an edge with three triangles or turned ones");
  Vector<Index> next(at(shape.local_count()), -1, &memory);
  std::size_t open = 0;
  Index start = -1;
  for (const HalfEdge& h : half) {
    if (std::binary_search(half.begin(), half.end(), HalfEdge{h.to, h.from})) continue;
    if (next[at(h.from)] >= 0) no_disc(surface, state, h.from, "the rim touches itself");
    next[at(h.from)] = h.to;
    start = h.from;
    ++open;
  }
  if (start < 0) no_disc(surface, state, 0, "no rim");
  for (Index v = start; place_[at(v)] < 0; v = next[at(v)]) {
    place_[at(v)] = static_cast<Index>(loop.size());
    loop.push_back(v);
  }
  if (loop.size() != open) {
    for (Index v = 0; v < shape.local_count(); ++v)
      if (next[at(v)] >= 0 && place_[at(v)] < 0) no_disc(surface, state, v, "a second rim");
  }
  const std::size_t edges = (half.size() + open) / 2, faces = shape.triangles.size();
  if (at(shape.local_count()) + faces != edges + 1) no_disc(surface, state, start, "a handle, or vertices that touch");
  double length = 0;
  for (std::size_t i = 0; i <= loop.size(); ++i) {
    arc.push_back(length);
    if (i == loop.size()) break;
    const Index a = loop[i], b = loop[(i + 1) % loop.size()];
    length += norm(surface.scaled_position(shape.vertex(b)) - surface.scaled_position(shape.vertex(a)));
  }
  if (!(length > 0)) no_disc(surface, state, start, "a rim without length");
}

Vector<DiscPoint> map_to_disc(const RegionSurface& surface, const RegionState& state, const DiscBoundary& boundary,
                              const DiscPins& pins, Memory& memory) {
  const surface::Core& core = *surface.core;
  const RegionShape& shape = *state.shape;
  Vector<DiscPoint> points(at(shape.local_count()), &memory);
  constexpr double two_pi = 6.283185307179586476925;
  const std::size_t size = boundary.loop.size(), count = pins.place.size();
  for (std::size_t p = 0; p < count; ++p) {
    const std::size_t first = at(pins.place[p]), last = at(pins.place[(p + 1) % count]);
    const std::size_t steps = count == 1 ? size : (last + size - first) % size;
    const double begin = pins.turn[p], end = p + 1 < count ? pins.turn[p + 1] : 1.0;
    const auto arc_from_first = [&](std::size_t i) {
      const double s = boundary.arc[i % size] - boundary.arc[first];
      return s < 0 || (i != first && i % size == first) ? s + boundary.arc[size] : s;
    };
    const double whole = arc_from_first(first + steps);
    for (std::size_t i = first; i < first + steps; ++i) {
      // If a stretch of the boundary loop has no length, its vertices are spread evenly.
      const double share =
          whole > 0 ? arc_from_first(i) / whole : static_cast<double>(i - first) / static_cast<double>(steps);
      const double angle = two_pi * (begin + (end - begin) * share);
      points[at(boundary.loop[i % size])] = {cosine(angle), sine(angle)};
    }
  }

  // The unknowns are all vertices that are not on the boundary loop.
  Vector<Index> number(at(shape.local_count()), -1, &memory), unknown(&memory), edges(&memory);
  for (Index l = 0; l < shape.local_count(); ++l)
    if (boundary.place(l) < 0) {
      number[at(l)] = static_cast<Index>(unknown.size());
      unknown.push_back(l);
    }
  if (unknown.empty()) return points;
  const mesh::Topology& topology = core.geometry->unlinked().topology();
  for (const Index l : unknown) {
    const Index v = shape.vertex(l);
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i)
      edges.push_back(topology.neighbour_edge[at(i)]);
  }
  const Vector<double> weights = positive_weights(core, edges, memory);
  SymmetricMatrix matrix(memory);
  Vector<double> right(unknown.size() * 2, 0.0, &memory);
  Vector<float> coordinates(&memory);
  struct Entry {
    Index row;
    double value;
  };
  Vector<Entry> column(&memory);
  std::size_t edge = 0;
  matrix.column_start.push_back(0);
  for (std::size_t c = 0; c < unknown.size(); ++c) {
    const Index v = shape.vertex(unknown[c]);
    double diagonal = 0;
    column.clear();
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i, ++edge) {
      const Index l = shape.local[at(topology.neighbour[at(i)])];
      if (l < 0) continue;  // this neighbour belongs to triangles outside that touch the region here
      const double w = weights[edge];
      diagonal += w;
      if (number[at(l)] >= 0) {
        column.push_back({number[at(l)], -w});
      } else {
        right[2 * c] += w * points[at(l)].u;
        right[2 * c + 1] += w * points[at(l)].v;
      }
    }
    column.push_back({static_cast<Index>(c), diagonal});
    std::sort(column.begin(), column.end(), [](const Entry& a, const Entry& b) { return a.row < b.row; });
    for (const Entry& entry : column) {
      matrix.row.push_back(entry.row);
      matrix.value.push_back(entry.value);
    }
    matrix.column_start.push_back(static_cast<Index>(matrix.row.size()));
    const Vec3 p = core.mesh.positions[at(v)];
    for (const double x : {p.x, p.y, p.z}) coordinates.push_back(static_cast<float>(x));
  }
  factor::FactorOptions options;
  options.ordering = core.ordering;
  options.flop_limit = core.flop_limit;
  const std::shared_ptr<const factor::Factor> factor =
      factor::Factor::make(matrix, coordinates, options, memory, *core.jobs);
  Vector<double> z(right.size(), &memory);
  factor->solve(right.data(), right.data(), 2, z.data(), *core.jobs);
  for (std::size_t c = 0; c < unknown.size(); ++c) points[at(unknown[c])] = {right[2 * c], right[2 * c + 1]};
  return points;
}

DiscSearch::DiscSearch(Span<const std::int32_t> corners, Span<const DiscPoint> points, Memory& memory)
    : corners_(corners), points_(points), order_(&memory), boxes_(&memory) {
  const Index triangles = static_cast<Index>(corners.size() / 3);
  Vector<DiscPoint> centre(&memory);
  for (Index t = 0; t < triangles; ++t) {
    DiscPoint sum;
    for (std::size_t k = 0; k < 3; ++k) {
      const DiscPoint p = points[at(corners[3 * at(t) + k])];
      sum.u += p.u;
      sum.v += p.v;
    }
    centre.push_back(sum);
    order_.push_back(t);
  }
  boxes_.push_back(box_of(0, triangles));
  for (std::size_t b = 0; b < boxes_.size(); ++b) split(static_cast<Index>(b), centre);
}

DiscSearch::Box DiscSearch::box_of(std::int32_t first, std::int32_t count) const {
  Box box{{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, first, count};
  for (Index i = first; i < first + count; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const DiscPoint p = points_[at(corners_[3 * at(order_[at(i)]) + k])];
      const double x[2] = {p.u, p.v};
      for (int d = 0; d < 2; ++d) {
        box.low[d] = std::min(box.low[d], x[d]);
        box.high[d] = std::max(box.high[d], x[d]);
      }
    }
  }
  return box;
}

void DiscSearch::split(std::int32_t number, Vector<DiscPoint>& centre) {
  const Box box = boxes_[at(number)];
  if (box.count <= disc_leaf) return;
  const bool wide = box.high[0] - box.low[0] > box.high[1] - box.low[1];
  const auto key = [&](Index t) { return wide ? centre[at(t)].u : centre[at(t)].v; };
  const auto begin = order_.begin() + box.first, middle = begin + box.count / 2;
  std::nth_element(begin, middle, begin + box.count,
                   [&](Index a, Index b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  boxes_[at(number)].first = static_cast<Index>(boxes_.size());
  boxes_[at(number)].count = 0;
  boxes_.push_back(box_of(box.first, box.count / 2));
  boxes_.push_back(box_of(box.first + box.count / 2, box.count - box.count / 2));
}

std::int32_t DiscSearch::find(DiscPoint point, double weights[3]) const {
  const double x[2] = {point.u, point.v};
  const auto distance = [&](Index b) {
    double sum = 0;
    for (int d = 0; d < 2; ++d) {
      const double out = std::max(std::max(boxes_[at(b)].low[d] - x[d], x[d] - boxes_[at(b)].high[d]), 0.0);
      sum += out * out;
    }
    return sum;
  };
  Index best = -1, stack[disc_stack], depth = 0;
  double least = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Index b = stack[--depth];
    if (best >= 0 && distance(b) >= least) continue;
    const Box& box = boxes_[at(b)];
    if (box.count == 0) {
      // The search visits the nearer half first.
      const bool swap = distance(box.first) > distance(box.first + 1);
      stack[depth++] = box.first + (swap ? 0 : 1);
      stack[depth++] = box.first + (swap ? 1 : 0);
      continue;
    }
    for (Index i = box.first; i < box.first + box.count; ++i) {
      const Index* corner = corners_.data() + 3 * at(order_[at(i)]);
      const DiscPoint c[3] = {points_[at(corner[0])], points_[at(corner[1])], points_[at(corner[2])]};
      double w[3] = {0, 0, 0};
      const double d = nearest(c, point, w);
      if (best >= 0 && d >= least) continue;
      best = order_[at(i)];
      least = d;
      std::copy(w, w + 3, weights);
      if (d == 0) return best;
    }
  }
  return best;
}

}  // namespace hf_inner::detail
