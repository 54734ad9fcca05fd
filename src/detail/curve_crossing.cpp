#include "detail/curve_crossing.h"

#include <algorithm>

#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "detail/constants.h"

namespace hf_inner::detail {
namespace {

constexpr Index nowhere = -1;

// The neighbours of one vertex in their order around it, from any of them, either way round. Empty where the triangles
// of the vertex are not one fan.
class Fan {
 public:
  Fan(const surface::Core& core, Memory& memory)
      : mesh_(core.geometry->unlinked().mesh), topology_(core.geometry->unlinked().topology()), order_(&memory) {}

  bool make(Index vertex) {
    if (vertex == vertex_) return !order_.empty();
    vertex_ = vertex;
    closed_ = false;
    order_.clear();
    const Index begin = topology_.neighbour_start[at(vertex)], end = topology_.neighbour_start[at(vertex) + 1];
    Index first = topology_.neighbour_edge[at(begin)];
    for (Index i = begin; i < end; ++i) {
      const Index e = topology_.neighbour_edge[at(i)];
      if (triangles(e) > 2) return false;
      if (triangles(e) == 1) first = e;
    }
    Index edge = first, triangle = topology_.triangle(topology_.edge_triangle_start[at(edge)]);
    while (true) {
      order_.push_back(other(edge));
      if (triangle == nowhere || order_.size() > at(end - begin)) break;
      const Index far = third(triangle, order_.back());
      edge = topology_.edge_between(vertex_, far);
      if (edge == first) {
        closed_ = true;
        break;
      }
      triangle = beyond(edge, triangle);
    }
    if (order_.size() != at(end - begin) || order_.size() < (closed_ ? 3u : 2u)) order_.clear();
    return !order_.empty();
  }

  Index place(Index neighbour) const noexcept {
    return static_cast<Index>(std::find(order_.begin(), order_.end(), neighbour) - order_.begin());
  }
  Index size() const noexcept { return static_cast<Index>(order_.size()); }
  // The neighbour that comes after a given one, or before it where a border ends the fan.
  Index beside(Index neighbour, bool& after) const noexcept {
    const Index p = place(neighbour);
    after = p + 1 < size() || closed_;
    return after ? order_[at((p + 1) % size())] : order_[at(p - 1)];
  }
  // Tells whether b is the neighbour that comes after a.
  bool follows(Index a, Index b) const noexcept {
    const Index p = place(a);
    return (p + 1 < size() || closed_) && order_[at((p + 1) % size())] == b;
  }

 private:
  Index triangles(Index e) const noexcept {
    return topology_.edge_triangle_start[at(e) + 1] - topology_.edge_triangle_start[at(e)];
  }
  Index other(Index e) const noexcept {
    return topology_.first(e) == vertex_ ? topology_.second(e) : topology_.first(e);
  }
  Index third(Index triangle, Index neighbour) const noexcept {
    const Index* v = mesh_.triangle(triangle);
    return v[0] != vertex_ && v[0] != neighbour ? v[0] : v[1] != vertex_ && v[1] != neighbour ? v[1] : v[2];
  }
  Index beyond(Index e, Index triangle) const noexcept {
    for (Index i = topology_.edge_triangle_start[at(e)]; i < topology_.edge_triangle_start[at(e) + 1]; ++i)
      if (topology_.triangle(i) != triangle) return topology_.triangle(i);
    return nowhere;
  }
  const mesh::Mesh& mesh_;
  const mesh::Topology& topology_;
  Index vertex_ = nowhere;
  Vector<Index> order_;
  bool closed_ = false;
};

// Tells whether b comes before c on the way round from a, in a circle of `size` places.
bool before(Index a, Index b, Index c, Index size) noexcept { return (b - a + size) % size < (c - a + size) % size; }

// The strands of a curve that has no ways out and back.
class Strands {
 public:
  Strands(const surface::Core& core, const ClosedCurve& curve, Memory& memory)
      : core_(core), fan_(core, memory), vertex_(&memory), point_(&memory) {
    for (std::size_t i = 0; i < curve.vertices.size(); ++i) {
      if (vertex_.size() >= 2 && vertex_[vertex_.size() - 2] == curve.vertices[i]) {
        vertex_.pop_back();
        point_.pop_back();
      } else {
        vertex_.push_back(curve.vertices[i]);
        point_.push_back(curve.point_of[i]);
      }
    }
    // A way out and back can end where the list does.
    std::size_t first = 0, last = vertex_.size();
    while (last - first > 2) {
      if (vertex_[first + 1] == vertex_[last - 1]) {
        ++first;
        --last;
      } else if (vertex_[last - 2] == vertex_[first]) {
        last -= 2;
      } else {
        break;
      }
    }
    vertex_.erase(vertex_.begin() + static_cast<std::ptrdiff_t>(last), vertex_.end());
    vertex_.erase(vertex_.begin(), vertex_.begin() + static_cast<std::ptrdiff_t>(first));
    point_.erase(point_.begin(), point_.begin() + static_cast<std::ptrdiff_t>(first));
    size_ = static_cast<Index>(vertex_.size());
  }

  void check(Memory& memory) {
    if (size_ < 3) return;
    Vector<Index> visits(at(size_), 0, &memory);
    for (Index i = 0; i < size_; ++i) visits[at(i)] = i;
    std::sort(visits.begin(), visits.end(), [&](Index i, Index j) {
      return vertex_[at(i)] != vertex_[at(j)] ? vertex_[at(i)] < vertex_[at(j)] : i < j;
    });
    Index worst = size_, with = nowhere;  // the first place that crosses an earlier one
    for (Index begin = 0, end; begin < size_; begin = end) {
      poll();
      const Index v = vertex_[at(visits[at(begin)])];
      for (end = begin; end < size_ && vertex_[at(visits[at(end)])] == v; ++end) continue;
      if (end - begin > most_visits) {
        const Index given = core_.mesh.given_of_inner[at(v)], point = point_[at(visits[at(begin + most_visits)])];
        fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(point),
             "the curve passes vertex %d more than %d times, after point %d again; give points that do not lead back "
             "to it",
             given, most_visits, point);
      }
      for (Index a = begin; a < end; ++a) {
        for (Index b = a + 1; b < end && visits[at(b)] < worst; ++b) {
          if (cross(visits[at(a)], visits[at(b)]) || cross(visits[at(b)], visits[at(a)])) {
            worst = visits[at(b)];
            with = visits[at(a)];
          }
        }
      }
    }
    if (with == nowhere) return;
    const Index given = core_.mesh.given_of_inner[at(vertex_[at(worst)])];
    fail(HF_ERROR_INVALID_ARGUMENT, static_cast<std::uint32_t>(point_[at(worst)]),
         "the curve crosses itself at vertex %d: the part after point %d meets the part after point %d; give the "
         "points in "
         "the order in which they lie round the region",
         given, point_[at(worst)], point_[at(with)]);
  }

 private:
  Index vertex(Index i) const noexcept { return vertex_[at((i % size_ + size_) % size_)]; }

  // Two places i and j of one vertex: do the strands change sides there? A run of shared vertices is judged where it
  // begins, as seen from i; `step` is the direction in which j goes along it. Both orders of the two are asked: the
  // list can begin within a run.
  bool cross(Index i, Index j) {
    const Index here = vertex(i);
    const Index before_i = vertex(i - 1), after_i = vertex(i + 1), before_j = vertex(j - 1), after_j = vertex(j + 1);
    for (const Index step : {1, -1}) {
      if (after_i == vertex(j + step) && before_i != vertex(j - step)) return run_crosses(i, j, step);
    }
    if (before_i == before_j || before_i == after_j || after_i == before_j || after_i == after_j) return false;
    if (!fan_.make(here)) return false;
    const Index from = fan_.place(before_i), to = fan_.place(after_i), n = fan_.size();
    return before(from, fan_.place(before_j), to, n) != before(from, fan_.place(after_j), to, n);
  }

  bool run_crosses(Index i, Index j, Index step) {
    // Fans of neighbouring vertices can run opposite ways round; `turned` follows that along the run.
    if (!fan_.make(vertex(i))) return false;
    const bool begins = side(i + 1, i - 1, j - step);
    bool turned = false;
    Index length = 1;
    for (; length < size_; ++length) {
      bool after = false, after_there = false;
      const Index beside = fan_.beside(vertex(i + length), after);
      const Index from = vertex(i + length - 1);
      if (!fan_.make(vertex(i + length))) return false;
      // A triangle left of the edge as seen from one end is right of it as seen from the other.
      after_there = fan_.follows(from, beside);
      turned = turned != (after == after_there);
      if (vertex(i + length + 1) != vertex(j + step * (length + 1))) break;
    }
    const bool ends = side(i + length - 1, i + length + 1, j + step * (length + 1));
    return (begins != turned) == ends;
  }

  // On the way round the fan from place `from` of the curve: does place a come before place b?
  bool side(Index from, Index a, Index b) const noexcept {
    return before(fan_.place(vertex(from)), fan_.place(vertex(a)), fan_.place(vertex(b)), fan_.size());
  }

  const surface::Core& core_;
  Fan fan_;
  Vector<Index> vertex_, point_;
  Index size_ = 0;
};

}  // namespace

void require_no_crossing(const surface::Core& core, const ClosedCurve& curve, Memory& memory) {
  Strands(core, curve, memory).check(memory);
}

}  // namespace hf_inner::detail
