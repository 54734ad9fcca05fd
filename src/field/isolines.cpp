#include "field/isolines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/index.h"
#include "mesh/around_edge.h"

namespace hf_inner::field {
namespace {

class Tracer {
 public:
  Tracer(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const double> field, Isolines& out,
         Memory& memory)
      : mesh_(mesh),
        topology_(topology),
        field_(field),
        out_(out),
        triangle_edge_(mesh.corners.size(), mesh::Mesh::none, &memory),
        usable_(at(mesh.triangle_count()), 1, &memory),
        visited_(at(mesh.triangle_count()), 0, &memory),
        line_(&memory),
        around_(&memory) {
    for (Index e = 0; e < topology.edge_count(); ++e) {
      for (Index i = begin(e); i < end(e); ++i) {
        const Index t = topology.triangle(i);
        const Index* v = mesh.triangle(t);
        std::size_t k = 0;
        while (k < 2 && (v[k] == topology.first(e) || v[k] == topology.second(e))) ++k;
        triangle_edge_[3 * at(t) + k] = e;
      }
    }
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      for (int k = 0; k < 3; ++k) usable_[at(t)] &= !std::isnan(field[at(mesh.triangle(t)[k])]);
    }
  }

  // Traces all lines of one level. crossed: the edges with one end below the level and the other end not below it.
  void trace(double level, std::uint32_t number, Span<const Index> crossed) {
    level_ = level;
    number_ = number;
    ++stamp_;
    // Traces the open lines first. All lines that are left are closed.
    for (const bool open : {true, false}) {
      for (const Index e : crossed) {
        for (Index i = begin(e); i < end(e); ++i) {
          const Index t = topology_.triangle(i);
          if (!usable_[at(t)] || visited_[at(t)] == stamp_) continue;
          if (open && partner(e, i) != mesh::Mesh::none) continue;
          follow(e, i, !open);
        }
      }
    }
  }

 private:
  Index begin(Index e) const noexcept { return topology_.edge_triangle_start[at(e)]; }
  Index end(Index e) const noexcept { return topology_.edge_triangle_start[at(e) + 1]; }
  bool above(Index v) const noexcept { return field_[at(v)] >= level_; }
  bool crossed(Index e) const noexcept { return above(topology_.first(e)) != above(topology_.second(e)); }

  // Returns the triangle in which a line continues behind edge e, coming from triangle entry i of that edge. The usable
  // triangles of an edge are taken in pairs, of three and more in their order around the edge.
  Index partner(Index e, Index i) {
    around_.clear();
    if (end(e) - begin(e) > 2) {
      mesh::sort_around_edge(mesh_, topology_, e, around_);
      // Pairs begin at the end with the wider gap, so they do not depend on the direction of the edge.
      const auto gap = [&](std::size_t i) { return std::fabs(around_[i + 1].angle - around_[i].angle); };
      if (gap(around_.size() - 2) > gap(0)) std::reverse(around_.begin(), around_.end());
    } else {
      for (Index j = begin(e); j < end(e); ++j) around_.push_back({j, mesh::Mesh::none, 0, 0, 0});
    }
    Index before = mesh::Mesh::none;
    for (const mesh::EdgeSide& around : around_) {
      const Index j = around.side;
      if (!usable_[at(topology_.triangle(j))]) continue;
      if (before == mesh::Mesh::none) {
        before = j;
      } else {
        if (before == i) return j;
        if (j == i) return before;
        before = mesh::Mesh::none;
      }
    }
    return mesh::Mesh::none;
  }

  Index entry_of(Index e, Index t) const noexcept {
    Index i = begin(e);
    while (topology_.triangle(i) != t) ++i;
    return i;
  }

  Isolines::Point point_on(Index e) const noexcept {
    const Index a = topology_.first(e), b = topology_.second(e);
    const double ua = field_[at(a)], ub = field_[at(b)];
    // The values are halved, so that the difference stays finite for values of any size.
    const double t = (0.5 * level_ - 0.5 * ua) / (0.5 * ub - 0.5 * ua);
    return {a, b, std::isfinite(t) ? std::min(1.0, std::max(0.0, t)) : 0.0};
  }

  // Returns the vertex at which a point lies, or none.
  static Index vertex_of(const Isolines::Point& p) noexcept {
    return p.t == 0 ? p.a : p.t == 1 ? p.b : mesh::Mesh::none;
  }
  static bool same_place(const Isolines::Point& p, const Isolines::Point& q) noexcept {
    return vertex_of(p) != mesh::Mesh::none && vertex_of(p) == vertex_of(q);
  }
  void append(Index e) {
    const Isolines::Point p = point_on(e);
    if (line_.empty() || !same_place(line_.back(), p)) line_.push_back(p);
  }

  // Returns true if higher values lie on the right when the line enters triangle t through edge e.
  bool backward(Index e, Index t) const noexcept {
    const Index* v = mesh_.triangle(t);
    int alone = 0;  // the corner that differs from both others
    for (int k = 0; k < 3; ++k) {
      if (above(v[k]) != above(v[(k + 1) % 3]) && above(v[k]) != above(v[(k + 2) % 3])) alone = k;
    }
    // On the way from its next edge to its previous edge, a corner with a higher value is on the left.
    const bool from_next = triangle_edge_[3 * at(t) + at((alone + 2) % 3)] == e;
    return above(v[alone]) != from_next;
  }

  // Follows a line from triangle entry i of edge e to its end, or once around if it is closed.
  void follow(Index e, Index i, bool closed) {
    line_.clear();
    const bool turn = backward(e, topology_.triangle(i));
    for (;;) {
      const Index t = topology_.triangle(i);
      if (visited_[at(t)] == stamp_) break;  // the line is closed
      append(e);
      visited_[at(t)] = stamp_;
      Index next = e;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index other = triangle_edge_[3 * at(t) + k];
        if (other != e && crossed(other)) next = other;
      }
      const Index entry = entry_of(next, t);
      e = next;
      i = partner(e, entry);
      if (i == mesh::Mesh::none) {
        append(e);
        break;
      }
    }
    while (closed && line_.size() > 1 && same_place(line_.front(), line_.back())) line_.pop_back();
    if (line_.size() < (closed ? 3u : 2u)) return;
    if (turn) std::reverse(line_.begin(), line_.end());
    out_.points.insert(out_.points.end(), line_.begin(), line_.end());
    out_.start.push_back(static_cast<std::uint32_t>(out_.points.size()));
    out_.level.push_back(number_);
    out_.closed.push_back(closed);
  }

  const mesh::Mesh& mesh_;
  const mesh::Topology& topology_;
  const Span<const double> field_;
  Isolines& out_;
  Vector<Index> triangle_edge_;  // 3 t + k: the edge opposite to corner k
  Vector<std::uint8_t> usable_;  // every corner has a value
  Vector<std::uint32_t> visited_;
  Vector<Isolines::Point> line_;
  Vector<mesh::EdgeSide> around_;
  double level_ = 0;
  std::uint32_t number_ = 0, stamp_ = 0;
};

}  // namespace

Vec3 position_of(const mesh::Mesh& mesh, const Isolines::Point& point) noexcept {
  return mesh.to_given((1 - point.t) * mesh.positions[at(point.a)] + point.t * mesh.positions[at(point.b)]);
}

Isolines trace_isolines(const mesh::Mesh& mesh, const mesh::Topology& topology, Span<const double> field,
                        Span<const double> levels, Memory& memory) {
  const std::size_t count = levels.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (!std::isfinite(levels[k]))
      fail(HF_ERROR_NON_FINITE, static_cast<std::uint32_t>(k), "levels[%zu] is not finite", k);
  }
  Isolines out(memory);
  out.start.push_back(0);
  Vector<std::uint32_t> order(count, &memory);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t i, std::uint32_t j) { return levels[i] != levels[j] ? levels[i] < levels[j] : i < j; });
  Vector<double> sorted(count, &memory);
  for (std::size_t k = 0; k < count; ++k) sorted[k] = levels[order[k]];

  // Returns the levels that an edge crosses: low < level <= high.
  struct Range {
    std::size_t first, last;
  };
  const auto range_of = [&](Index e) -> Range {
    double low = field[at(topology.first(e))], high = field[at(topology.second(e))];
    if (std::isnan(low) || std::isnan(high)) return {0, 0};
    if (low > high) std::swap(low, high);
    const auto first = std::upper_bound(sorted.begin(), sorted.end(), low);
    return {static_cast<std::size_t>(first - sorted.begin()),
            static_cast<std::size_t>(std::upper_bound(first, sorted.end(), high) - sorted.begin())};
  };
  Vector<std::size_t> start(count + 1, 0, &memory);  // by position in the caller's list
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const Range range = range_of(e);
    for (std::size_t k = range.first; k < range.last; ++k) ++start[order[k] + 1];
  }
  for (std::size_t k = 0; k < count; ++k) start[k + 1] += start[k];
  Vector<Index> crossed(start[count], &memory);
  Vector<std::size_t> cursor(start.begin(), start.end() - 1, &memory);
  for (Index e = 0; e < topology.edge_count(); ++e) {
    const Range range = range_of(e);
    for (std::size_t k = range.first; k < range.last; ++k) crossed[cursor[order[k]]++] = e;
  }

  Tracer tracer(mesh, topology, field, out, memory);
  for (std::size_t k = 0; k < count; ++k) {
    tracer.trace(levels[k], static_cast<std::uint32_t>(k),
                 Span<const Index>(crossed.data() + start[k], start[k + 1] - start[k]));
  }
  return out;
}

}  // namespace hf_inner::field
