#include "mesh/exact_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/elementary.h"
#include "base/error.h"
#include "base/index.h"
#include "base/progress.h"
#include "mesh/shortest_on_edges.h"

namespace hf_inner::mesh {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;
// Distances that differ by less than this share of the box diagonal count as equal. A window is dropped only where
// another path is shorter by more, so rounding cannot drop both of two equal paths. It is above the 1e-16 of a sum.
// Half and double change no bit of the distances on seven shapes.
constexpr double equal_distance = 1e-13;
// A ray that misses a corner by this share of the edge still reaches it. A smaller one loses rays to rounding, a larger
// one takes rays that miss. Half and double change no bit of the distances on seven shapes.
constexpr double corner_rounding = 1e-12;
// Windows of less than this share of their edge are dropped. Smaller ones cost windows that hold no vertex, larger ones
// could drop a path. Half and double change no bit of the distances on seven shapes.
constexpr double least_window = 1e-13;
// A vertex whose angles sum to more than 2 pi by this is a pseudo-source. Smaller takes flat vertices for saddles and
// costs windows, larger loses paths round them. Half and double change no bit of the distances on seven shapes.
constexpr double saddle_rounding = 1e-11;
// The wedge behind a pseudo-source is wider by this angle on both sides. Narrower ones lose paths to rounding, wider
// ones cost windows. Half and double change no bit of the distances on seven shapes.
constexpr double shadow_rounding = 1e-7;
// A window is left out where its paths to the target are longer than a known one by this share. A smaller one loses
// the path itself to rounding, a larger one keeps windows that lead past it.
constexpr double path_rounding = 1e-9;
// Width of a step of the queue in mean edges. Smaller steps make fewer windows, larger ones read nearer memory. On a
// torus, a sphere and a plane of 100,000 vertices a quarter takes 9 to 36 % longer.
constexpr double queue_step = 1;
// Windows in a block of the queue. Larger blocks waste memory in steps of few windows. In smaller ones the processor
// reads less ahead: windows that lay alone waited for memory, a third of the time.
constexpr std::size_t block_windows = 16;
// Steps of the queue that have stacks of their own. Windows farther away wait in one more stack, which is sorted in
// when they are used up. It trades memory for that sorting. Half and double, and 4, give the same bits on seven shapes.
constexpr std::size_t queue_steps = 4096;
// Width of a step of the queue at least, in box diagonals: meshes without lengths would have steps of 0. It is a guard:
// half and double give the same bits on seven shapes.
constexpr double least_step = 1e-6;
// Triangles are at least so high, in box diagonals, so that a point inside one without area lies on neither of its
// sides and its rays leave by both. Larger moves rays by as much; a smaller one is lost where it is added to the sides.
constexpr double least_height = 1e-15;
// Reports of progress, each after this many vertices. Less reports more often than a host draws, more makes bars jump:
// it is a hundredth of 100,000 vertices.
constexpr std::size_t report_every = 1024;
// A call makes at most this many windows times t sqrt(t), for t triangles, and at least the number below. Ordinary
// meshes take up to 1.5. Less refuses meshes of many needles, more lets a call run on where windows do not end.
constexpr double most_windows = 20, least_most_windows = 1e6;

}  // namespace

TriangleSides::TriangleSides(const Mesh& given, const Topology& edges, Memory& memory)
    : mesh(given),
      topology(edges),
      edge(given.corners.size(), Mesh::none, &memory),
      twin(given.corners.size(), border, &memory),
      frame(given.corners.size(), &memory),
      angle(given.positions.size(), 0.0, &memory) {
  Poller poller;
  Vector<Index> seen(given.positions.size(), Mesh::none, &memory);  // by vertex: the last edge with a triangle to it
  for (Index e = 0; e < edges.edge_count(); ++e) {
    poller.due();
    const Index first = edges.first(e), second = edges.second(e);
    Index sides[2] = {-1, -1}, count = 0;
    for (Index i = edges.edge_triangle_start[at(e)]; i < edges.edge_triangle_start[at(e) + 1]; ++i) {
      const Index side = edges.corner(i);
      Index& other = seen[at(start(last(side)))];
      if (other == e) continue;  // a copy of an earlier triangle
      other = e;
      edge[at(side)] = e;
      if (count < 2) sides[count] = side;
      ++count;
    }
    if (count == 2) {
      twin[at(sides[0])] = sides[1];
      twin[at(sides[1])] = sides[0];
    }
    for (Index i = edges.edge_triangle_start[at(e)]; count > 2 && i < edges.edge_triangle_start[at(e) + 1]; ++i) {
      if (edge[at(edges.corner(i))] == e) twin[at(edges.corner(i))] = several;
    }
    const double length = norm(mesh.positions[at(first)] - mesh.positions[at(second)]);
    // Angles beside an edge of length 0 are not known, so paths may bend at its ends.
    if (count != 2 || !(length > 0)) angle[at(first)] = angle[at(second)] = infinite;
    mean_length += length;
  }
  mean_length /= std::max(1, edges.edge_count());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    poller.due();
    if (is_copy(t)) continue;
    const Index* v = mesh.triangle(t);
    for (Index k = 0; k < 3; ++k) {
      const Vec3 a = mesh.positions[at(v[k])], ab = mesh.positions[at(v[(k + 1) % 3])] - a,
                 ac = mesh.positions[at(v[(k + 2) % 3])] - a;
      const double length = norm(ab), scale = length > 0 ? 1 / length : 0.0;
      // beside a side of length 0 the corner lies at its distance, in no direction
      const double height = length > 0 ? scale * norm(cross(ab, ac)) : norm(ac);
      const double x = scale * dot(ab, ac), y = std::max(height, least_height);
      frame[at(3 * t + k)] = {length, x, y};
      angle[at(v[k])] += arc_tangent(y, x);
    }
  }
  mark_several_fans(memory);
}

// Marks the vertices where several closed fans meet: a walk around one of them does not see every triangle.
void TriangleSides::mark_several_fans(Memory& memory) {
  const std::size_t n = mesh.positions.size();
  Vector<Index> count(n, 0, &memory), first(n, Index{-1}, &memory);
  for (Index s = 0; s < static_cast<Index>(mesh.corners.size()); ++s) {
    if (!is_copy(s / 3)) {
      ++count[at(start(s))];
      first[at(start(s))] = s;
    }
  }
  Poller poller;
  for (Index v = 0; v < static_cast<Index>(n); ++v) {
    poller.due();
    if (std::isinf(angle[at(v)]) || first[at(v)] < 0) continue;
    Index side = first[at(v)], seen = 0;
    do {
      const Index leave = start(side) == v ? last(side) : next(side);
      side = twin[at(leave)];
      ++seen;
    } while (side / 3 != first[at(v)] / 3 && seen <= count[at(v)]);
    if (seen != count[at(v)]) angle[at(v)] = infinite;
  }
}

double TriangleSides::opposite_angle(Index side) const noexcept {
  const Frame& f = frame[at(side)];
  // the corner lies at (x, y), the ends of the side at 0 and length
  return arc_tangent(f.length * f.y, f.x * (f.x - f.length) + f.y * f.y);
}

Index TriangleSides::side_between(Index v, Index w) const noexcept {
  const Index e = topology.edge_between(v, w);
  const Index t = topology.triangle(topology.edge_triangle_start[at(e)]);
  for (Index s = 3 * t; s < 3 * t + 2; ++s) {
    if (edge[at(s)] == e) return s;
  }
  return 3 * t + 2;
}

namespace {

struct Window {
  double begin, end;  // on the side it enters, from the side's start
  double x, y;        // the pseudo-source lies at (x, -y)
  double sigma;       // distance of the pseudo-source
  Index side;         // it enters the triangle of this side; for a vertex: -1 - vertex
  Index from;         // pseudo-source; -1: the source point
};

// The frame of a side at the source: a ray at angle a in the frame leaves the source at angle + sign a.
struct Turn {
  double angle, sign;
};

class Propagation {
 public:
  Propagation(const TriangleSides& sides, const ExactTask& task, Memory& memory)
      : sides_(sides),
        mesh_(sides.mesh),
        task_(task),
        memory_(memory),
        windows_(&memory),
        turns_(&memory),
        below_(&memory),
        stacks_(queue_steps + 1, Stack(), &memory),
        best_(sides.frame.size(), Best{infinite, 0}, &memory),
        shortest_(sides.topology.edge_count(), memory),
        parts_(&memory),
        result_(memory) {
    const std::size_t n = mesh_.positions.size();
    result_.distance.assign(n, infinite);
    result_.end.assign(n, PathEnd());
    if (task.directions) result_.direction.assign(n, 0.0);
    const double t = static_cast<double>(sides.frame.size()) / 3;
    most_ = task.most_windows > 0 ? task.most_windows
                                  : static_cast<std::uint64_t>(most_windows * t * std::sqrt(t) + least_most_windows);
    step_ = queue_step * std::max(sides.mean_length, least_step);
    if (task.to) target_ = task.to->position(mesh_);
    if (task.to && task.at_most > 0) longest_ = (1 + path_rounding) * task.at_most;
  }

  ExactDistance run() {
    for (const Index s : task_.sources) start_at(s);
    if (task_.from && task_.from->vertex >= 0) start_at(task_.from->vertex);
    if (task_.from && task_.from->vertex < 0) start_at(*task_.from);
    while (live_ > 0 && !finished()) {
      if (stacks_[step_now_].block == Mesh::none) {
        advance();
        continue;
      }
      const auto [w, turn] = pop(stacks_[step_now_]);
      --live_;
      poller_.due();
      if (w.side < 0)
        visit_vertex(-1 - w.side, w.sigma);
      else
        cross_triangle(w, turn);
    }
    for (double& d : result_.distance) {
      if (task_.reach > 0 && d > task_.reach) d = infinite;
    }
    return std::move(result_);
  }

 private:
  void start_at(Index v) {
    result_.distance[at(v)] = 0;
    result_.end[at(v)].side = PathEnd::at_source;
    push_vertex(v);
  }

  // Returns the angles of the sides of a triangle from its first.
  void side_angles(Index t, double* angle) const noexcept {
    angle[0] = 0;
    angle[1] = pi - sides_.opposite_angle(3 * t + 2);
    angle[2] = angle[1] + pi - sides_.opposite_angle(3 * t);
  }

  // Starts at a point inside a triangle or on an edge.
  void start_at(const GeodesicPoint& point) {
    double first_angle[3];  // of the sides of the first triangle
    Index first_edge_side = 0;
    for (const GeodesicPoint::Place& place : point.places) {
      const Index t = place.triangle;
      const bool is_first = &place == point.places.begin().operator->();
      double angle[3], base = 0, flip = 1;
      side_angles(t, angle);
      if (is_first) {
        std::copy_n(angle, 3, first_angle);
        result_.first_triangle = t;
        for (Index k = 0; k < 3; ++k) first_edge_side = place.weight[(k + 2) % 3] == 0 ? k : first_edge_side;
      } else {
        const Index shared = 3 * point.places[0].triangle + first_edge_side;
        for (Index k = 0; k < 3; ++k) {
          if (sides_.edge[at(3 * t + k)] != sides_.edge[at(shared)]) continue;
          const bool same = sides_.start(3 * t + k) == sides_.start(shared);
          flip = same ? -1 : 1;
          base = same ? first_angle[first_edge_side] + angle[k] : first_angle[first_edge_side] + pi - angle[k];
        }
      }
      for (Index k = 0; k < 3; ++k) {
        const Index s = 3 * t + k, c = sides_.start(TriangleSides::last(s));
        const TriangleSides::Frame& f = sides_.frame[at(s)];
        const double x = place.weight[(k + 1) % 3] * f.length + place.weight[(k + 2) % 3] * f.x,
                     y = place.weight[(k + 2) % 3] * f.y;
        reach(c, length_of(f.x - x, f.y - y), {s, -1, x, -y}, base + flip * (angle[k] + arc_tangent(f.y - y, f.x - x)));
        if (y > 0) emit(s, 0, f.length, x, y, 0, -1, {base + flip * angle[k], -flip});
        offer_from_source(t, s, x, y);
      }
    }
  }

  // The path to a target in the triangle of the source is straight.
  void offer_from_source(Index t, Index s, double x, double y) {
    for (std::size_t p = 0; task_.to && p < task_.to->places.size(); ++p) {
      if (task_.to->places[p].triangle != t) continue;
      const auto [px, py] = place_in(task_.to->places[p], s);
      offer_target(length_of(px - x, py - y), {PathEnd::at_source, -1, 0, 0}, p);
    }
  }

  // Returns the coordinates of a place in the frame of a side of its triangle.
  std::pair<double, double> place_in(const GeodesicPoint::Place& place, Index s) const noexcept {
    const TriangleSides::Frame& f = sides_.frame[at(s)];
    const Index k = s % 3;
    const double next = place.weight[(k + 1) % 3], opposite = place.weight[(k + 2) % 3];
    return {next * f.length + opposite * f.x, opposite * f.y};
  }
  void offer_target(double d, const PathEnd& end, std::size_t place) {
    if (result_.to_distance >= 0 && !(d < result_.to_distance)) return;
    longest_ = std::min(longest_, (1 + path_rounding) * d);
    result_.to_distance = d;
    result_.to_end = end;
    result_.to_place = static_cast<Index>(place);
  }

  bool finished() const noexcept {
    const double level = base_ + step_ * static_cast<double>(step_now_);
    if (task_.reach > 0 && level > task_.reach) return true;
    if (!task_.to) return false;
    return task_.to->vertex >= 0 ? distance(task_.to->vertex) < level
                                 : result_.to_distance >= 0 && result_.to_distance < level;
  }

  // Starts at a vertex, with directions: fan by fan, those that end at a border first.
  void start_fans(Index v) {
    Vector<Index> done(&memory_);
    double turned = 0;
    const auto walk = [&](Index entry) {
      while (entry >= 0 && std::find(done.begin(), done.end(), entry / 3) == done.end()) {
        done.push_back(entry / 3);
        const bool starts = sides_.start(entry) == v;
        const Index leave = starts ? TriangleSides::last(entry) : TriangleSides::next(entry);
        const Index opposite = starts ? TriangleSides::next(entry) : TriangleSides::last(entry);
        const Index a = starts ? sides_.start(opposite) : sides_.start(entry);
        const Index b = starts ? sides_.start(TriangleSides::next(opposite)) : sides_.start(opposite);
        const TriangleSides::Frame& f = sides_.frame[at(opposite)];
        if (result_.first_corner < 0) {
          result_.first_corner = a;
          result_.first_triangle = entry / 3;
        }
        reach(a, sides_.frame[at(entry)].length, {PathEnd::along_edge, v, 0, 0}, turned);
        const Turn turn =
            starts ? Turn{turned + arc_tangent(f.y, -f.x), -1.0} : Turn{turned - arc_tangent(f.y, f.length - f.x), 1.0};
        emit(opposite, 0, f.length, f.x, f.y, 0, v, turn);
        turned += sides_.opposite_angle(opposite);
        reach(b, sides_.frame[at(leave)].length, {PathEnd::along_edge, v, 0, 0}, turned);
        entry = sides_.twin[at(leave)];
      }
    };
    // Walks from sides that start at the vertex turn to the left, seen from outside.
    for_corners(v, [&](Index s) {
      if (sides_.twin[at(s)] < 0) walk(s);
    });
    for_corners(v, [&](Index s) {
      if (sides_.twin[at(TriangleSides::last(s))] < 0) walk(TriangleSides::last(s));
    });
    for_corners(v, [&](Index s) { walk(s); });
    result_.fan_angle = turned;
    result_.closed_fan = sides_.angle[at(v)] < infinite;
  }

  struct Best {
    double distance, crossing;
  };
  double distance(Index v) const noexcept { return result_.distance[at(v)]; }

  // A stack holds the windows of a step of the queue, from base_ on; the last one holds the windows beyond. Windows
  // that follow each other lie in one block, so that the processor reads ahead.
  struct Stack {
    Index block = Mesh::none, count = 0;  // the one on top, and its windows
  };

  std::pair<Window, Turn> pop(Stack& stack) noexcept {
    const std::size_t i = at(stack.block) * block_windows + at(--stack.count);
    if (stack.count == 0) {
      const Index below = below_[at(stack.block)];
      below_[at(stack.block)] = free_;
      free_ = stack.block;
      stack = {below, below == Mesh::none ? 0 : static_cast<Index>(block_windows)};
    }
    return {windows_[i], task_.directions ? turns_[i] : Turn{0, 1}};
  }

  void advance() {
    if (++step_now_ < queue_steps) return;
    Stack beyond = stacks_[queue_steps];
    stacks_[queue_steps] = Stack();
    base_ += step_ * queue_steps;
    step_now_ = 0;
    while (beyond.block != Mesh::none) {
      const auto [w, turn] = pop(beyond);
      put(w, key(w), turn);
    }
  }
  static double key(const Window& w) noexcept {
    if (w.side < 0) return w.sigma;
    const double x = std::min(std::max(w.x, w.begin), w.end) - w.x;
    return w.sigma + std::sqrt(x * x + w.y * w.y);
  }
  void put(const Window& w, double key, const Turn& turn) {
    const double place = (key - base_) / step_;
    Stack& stack = stacks_[place < static_cast<double>(queue_steps)
                               ? std::max(step_now_, static_cast<std::size_t>(std::max(0.0, place)))
                               : queue_steps];
    if (stack.block == Mesh::none || at(stack.count) == block_windows) {
      Index block = free_;
      if (block == Mesh::none) {
        block = static_cast<Index>(below_.size());
        windows_.resize(windows_.size() + block_windows);
        if (task_.directions) turns_.resize(windows_.size());
        below_.push_back(Mesh::none);
      } else {
        free_ = below_[at(block)];
      }
      below_[at(block)] = stack.block;
      stack = {block, 0};
    }
    const std::size_t i = at(stack.block) * block_windows + at(stack.count++);
    windows_[i] = w;
    if (task_.directions) turns_[i] = turn;
  }
  void push(const Window& w, double key, const Turn& turn = {0, 1}) {
    if (++result_.window_count > most_) refuse_count();
    put(w, key, turn);
    ++live_;
  }
  [[noreturn]] void refuse_count() const {
    fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX,
         "exact paths take more than %llu windows on these %zu triangles; take HF_GEODESICS_FRONT for distances, or "
         "leave out triangles where many share an edge",
         static_cast<unsigned long long>(most_), sides_.frame.size() / 3);
  }
  void push_vertex(Index v) {
    if (distance(v) + norm(mesh_.positions[at(v)] - target_) > longest_) return;
    Window w{};
    w.side = -1 - v;
    w.sigma = distance(v);
    push(w, w.sigma);
  }

  void reach(Index v, double d, const PathEnd& end, double direction = 0) {
    if (!(d < distance(v))) return;
    result_.distance[at(v)] = d;
    result_.end[at(v)] = end;
    if (task_.to && task_.to->vertex == v) longest_ = std::min(longest_, (1 + path_rounding) * d);
    if (task_.directions) result_.direction[at(v)] = direction;
    push_vertex(v);
  }

  void visit_vertex(Index v, double d) {
    if (d != distance(v)) return;  // a shorter path was found later
    if (++visited_ % report_every == 0)
      report(std::min(1.0f, static_cast<float>(visited_) / static_cast<float>(mesh_.positions.size())));
    const PathEnd end = result_.end[at(v)];
    if (end.side == PathEnd::at_source && task_.directions) return start_fans(v);
    const Topology& topology = sides_.topology;
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const Index w = topology.neighbour[at(i)];
      reach(w, d + norm(mesh_.positions[at(w)] - mesh_.positions[at(v)]), {PathEnd::along_edge, v, 0, 0},
            direction_of(v));
    }
    for (std::size_t p = 0; task_.to && p < task_.to->places.size(); ++p) {
      for (Index k = 0; k < 3; ++k) {
        const Index s = 3 * task_.to->places[p].triangle + k;
        if (sides_.start(s) != v) continue;
        const auto [x, y] = place_in(task_.to->places[p], s);
        offer_target(d + length_of(x, y), {PathEnd::along_edge, v, 0, 0}, p);
      }
    }
    if (end.side == PathEnd::at_source || sides_.angle[at(v)] == infinite) {
      for_corners(v, [&](Index side) {
        const Index opposite = TriangleSides::next(side);
        const TriangleSides::Frame& f = sides_.frame[at(opposite)];
        emit(opposite, 0, f.length, f.x, f.y, d, v);
      });
    } else if (sides_.angle[at(v)] > 2 * pi + saddle_rounding) {
      shadow(v, d, end);
    }
  }

  double direction_of(Index v) const noexcept { return task_.directions ? result_.direction[at(v)] : 0.0; }

  // Calls visit(side) for every side that starts at the vertex.
  template <class Visit>
  void for_corners(Index v, Visit&& visit) {
    const Topology& topology = sides_.topology;
    for (Index i = topology.neighbour_start[at(v)]; i < topology.neighbour_start[at(v) + 1]; ++i) {
      const Index e = topology.neighbour_edge[at(i)];
      for (Index k = topology.edge_triangle_start[at(e)]; k < topology.edge_triangle_start[at(e) + 1]; ++k) {
        const Index t = topology.triangle(k);
        for (Index s = 3 * t; s < 3 * t + 3; ++s) {
          if (mesh_.corners[at(s)] == v && sides_.edge[at(s)] == e) visit(s);
        }
      }
    }
  }

  // Emits windows from a pseudo-source, in the directions at an angle of at least pi to both sides of the path to it.
  void shadow(Index v, double d, const PathEnd& end) {
    const double total = sides_.angle[at(v)];
    Index side = end.side;  // by which the walk around the vertex leaves a triangle
    double turned = 0;      // from the path to that side
    if (side == PathEnd::along_edge) {
      side = sides_.side_between(v, end.from);
    } else {
      const TriangleSides::Frame& f = sides_.frame[at(side)];
      // the angle at the corner between the pseudo-source and the end of side k + 1, which leads to the corner
      const double ax = f.length - f.x, ay = -f.y, bx = end.x - f.x, by = -end.y - f.y;
      turned = arc_tangent(std::fabs(ax * by - ay * bx), ax * bx + ay * by);
      side = TriangleSides::next(side);
    }
    const double first = pi - shadow_rounding, last = total - pi + shadow_rounding;
    while (turned < last) {
      const Index entry = sides_.twin[at(side)];
      if (entry < 0) return;  // never: the angles of such vertices are infinite
      const bool starts = mesh_.corners[at(entry)] == v;
      const Index leave = starts ? TriangleSides::last(entry) : TriangleSides::next(entry);
      const Index opposite = starts ? TriangleSides::next(entry) : TriangleSides::last(entry);
      const TriangleSides::Frame& f = sides_.frame[at(opposite)];
      // from the start of `opposite` if the walk comes from there
      const bool from_start = starts;
      const double px = from_start ? f.x : f.length - f.x;
      const double corner = sides_.opposite_angle(opposite);
      if (turned + corner > first) {
        const auto place = [&](double angle) {
          const double c = cosine(angle), s = sine(angle);
          const double dx = -px * c + f.y * s, down = f.y * c + px * s;  // direction (dx, -down)
          return down > 0 ? std::min(f.length, px + dx * f.y / down) : f.length;
        };
        const double begin = turned < first ? std::max(0.0, place(first - turned)) : 0.0;
        const double stop = turned + corner > last ? place(last - turned) : f.length;
        if (from_start)
          emit(opposite, begin, stop, f.x, f.y, d, v);
        else
          emit(opposite, f.length - stop, f.length - begin, f.x, f.y, d, v);
      }
      turned += corner;
      side = leave;
    }
  }

  // Calls visit(side) for every side of another triangle on the edge of this one.
  template <class Visit>
  void for_twins(Index side, Visit&& visit) const {
    const Index other = sides_.twin[at(side)];
    if (other >= 0) return visit(other);
    if (other == TriangleSides::border) return;
    const Topology& topology = sides_.topology;
    const Index e = sides_.edge[at(side)];
    for (Index i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i) {
      const Index t = topology.triangle(i);
      for (Index s = 3 * t; s < 3 * t + 3; ++s) {
        if (sides_.edge[at(s)] == e && s != side) visit(s);
      }
    }
  }

  // A window leaves a triangle through a side. Coordinates belong to that side; (x, y) is the pseudo-source, on the
  // side of the triangle. turn: of the frame of the side, seen from beyond it.
  void emit(Index side, double begin, double end, double x, double y, double sigma, Index from,
            const Turn& turn = {0, 1}) {
    const double length = sides_.frame[at(side)].length;
    if (!(end - begin > least_window * length)) return;
    const Window w{begin, end, x, y, sigma, side, from};
    if (longest_ < infinite && leads_past(w)) return;
    if (sides_.twin[at(side)] != TriangleSides::several) return pass(w, turn);
    if (is_shorter_along(w)) return;
    const Index e = sides_.edge[at(side)];
    const bool along = sides_.start(side) == sides_.topology.first(e);
    const auto turned = [&](Interval i) { return along ? i : Interval{length - i.end, length - i.begin}; };
    shortest_.keep(e, {turned({begin, end}), along ? x : length - x, y, sigma}, parts_);
    for (const Interval& part : parts_) {
      const Interval here = turned(part);
      if (here.end - here.begin > least_window * length) pass({here.begin, here.end, x, y, sigma, side, from}, turn);
    }
  }

  // Tells whether a path along the side from one of its ends is shorter to every point of a window.
  bool is_shorter_along(const Window& w) const noexcept {
    const Index right = TriangleSides::next(w.side);
    const double length = sides_.frame[at(w.side)].length;
    return distance(sides_.start(w.side)) + w.end < w.sigma + length_of(w.end - w.x, w.y) - equal_distance ||
           distance(sides_.start(right)) + (length - w.begin) <
               w.sigma + length_of(w.begin - w.x, w.y) - equal_distance;
  }

  // Passes a window on to the other triangles of its side.
  void pass(const Window& window, const Turn& turn) {
    const double length = sides_.frame[at(window.side)].length;
    for_twins(window.side, [&](Index twin) {
      poller_.due();
      Window w = window;
      w.side = twin;
      if (sides_.start(twin) == sides_.start(window.side)) return push(w, key(w), turn);
      w.begin = length - window.end;
      w.end = length - window.begin;
      w.x = length - window.x;
      push(w, key(w), {turn.angle + turn.sign * pi, -turn.sign});
    });
  }

  // Tells whether every path through a window is longer than one that is known. The rest of such a path is no
  // shorter than the straight line from the window to the target.
  bool leads_past(const Window& w) const noexcept {
    const Vec3 start = mesh_.positions[at(mesh_.corners[at(w.side)])];
    const Vec3 along = (1 / sides_.frame[at(w.side)].length) *
                       (mesh_.positions[at(mesh_.corners[at(TriangleSides::next(w.side))])] - start);
    const double foot = std::min(std::max(dot(target_ - start, along), w.begin), w.end);
    return key(w) + norm(start + foot * along - target_) > longest_;
  }

  // Returns whether the rays of a window come from the source itself, not from a vertex where paths bend.
  bool from_source(const Window& w) const noexcept {
    return w.from < 0 || result_.end[at(w.from)].side == PathEnd::at_source;
  }

  void cross_triangle(const Window& w, const Turn& turn) {
    const Index s = w.side, right = TriangleSides::next(s), left = TriangleSides::last(s);
    const TriangleSides::Frame& f = sides_.frame[at(s)];
    const Index v0 = mesh_.corners[at(s)], v1 = mesh_.corners[at(right)], c = mesh_.corners[at(left)];
    // The source at (x, -y) sees the corner through the side at `crossing`.
    const double straight = w.sigma + length_of(f.x - w.x, f.y + w.y);
    const double crossing = f.y + w.y > 0 ? w.x + (f.x - w.x) * w.y / (f.y + w.y) : w.x;
    for (std::size_t p = 0; task_.to && p < task_.to->places.size(); ++p) {
      if (task_.to->places[p].triangle != s / 3) continue;
      const auto [x, y] = place_in(task_.to->places[p], s);
      const double through = y + w.y > 0 ? w.x + (x - w.x) * w.y / (y + w.y) : w.x;
      if (through >= w.begin - corner_rounding * f.length && through <= w.end + corner_rounding * f.length)
        offer_target(w.sigma + length_of(x - w.x, y + w.y), {s, w.from, w.x, w.y}, p);
    }
    if (is_shorter_along(w)) return;  // now; not when the window was made
    const double rounding = corner_rounding * f.length;
    double left_end = std::min(w.end, crossing), right_begin = std::max(w.begin, crossing);
    Best& best = best_[at(s)];
    if (straight < best.distance) {
      if (crossing >= w.begin - rounding && crossing <= w.end + rounding) {
        best = {straight, crossing};
        const bool straight_from = task_.directions && from_source(w);
        reach(c, straight, {s, w.from, w.x, w.y},
              straight_from      ? turn.angle + turn.sign * arc_tangent(f.y + w.y, f.x - w.x)
              : task_.directions ? direction_of(w.from)
                                 : 0.0);
      }
    } else {
      if (best.crossing < crossing)
        left_end = std::min(left_end, best.crossing);
      else
        right_begin = std::max(right_begin, best.crossing);
    }
    if (left_end > w.begin) child(w, f, left_end >= crossing, w.begin, left_end, left, v0, v1, c, false, turn);
    if (w.end > right_begin)
      child(w, f, right_begin <= crossing, f.length - w.end, f.length - right_begin, right, v1, v0, c, true, turn);
  }

  static double length_of(double x, double y) noexcept { return std::sqrt(x * x + y * y); }

  // The part of a window that crosses the edge from `near` to the corner c. Coordinates run from `near` along the side.
  void child(const Window& w, const TriangleSides::Frame& f, bool to_corner, double begin, double end, Index side,
             Index near, Index far, Index c, bool mirrored, const Turn& turn) {
    const double length = sides_.frame[at(side)].length;
    if (!(length > 0)) return;
    const double px = mirrored ? f.length - f.x : f.x, sx = mirrored ? f.length - w.x : w.x;
    const double ex = px / length, ey = f.y / length;
    const double h = ex * w.y + ey * sx;  // distance of the source from the edge
    if (!(h > 0)) return;
    const double a = ex * sx - ey * w.y;  // its foot, from `near`
    const auto meet = [&](double b) {
      const double below = w.y * ex - (b - sx) * ey;
      return below > 0 ? std::min(length, b * w.y / below) : length;
    };
    const double u0 = begin > 0 ? meet(begin) : 0.0, u1 = to_corner ? length : meet(end);
    if (!(u1 - u0 > least_window * length)) return;
    const double to_u0 = w.sigma + length_of(u0 - a, h), to_u1 = w.sigma + length_of(u1 - a, h);
    if (distance(near) + u1 < to_u1 - equal_distance) return;
    if (distance(c) + (length - u0) < to_u0 - equal_distance) return;
    if (distance(far) + length_of(f.length - u0 * ex, u0 * ey) < to_u0 - equal_distance) return;
    // The sides run around the triangle: the right one from `near` to c, the left one from c to `near`.
    Turn own = turn;
    if (task_.directions) {
      const double along = mirrored ? arc_tangent(ey, -ex) : arc_tangent(ey, ex) + pi;
      own = {turn.angle + turn.sign * along, -turn.sign};
    }
    if (mirrored)
      emit(side, u0, u1, a, h, w.sigma, w.from, own);
    else
      emit(side, length - u1, length - u0, length - a, h, w.sigma, w.from, own);
  }

  const TriangleSides& sides_;
  const Mesh& mesh_;
  const ExactTask& task_;
  Memory& memory_;
  Vector<Window> windows_;
  Vector<Turn> turns_;       // by window, if directions are asked for
  Vector<Index> below_;      // by block: the next one in its stack, or of those that no stack uses
  Index free_ = Mesh::none;  // the first of these
  Vector<Stack> stacks_;
  Vector<Best> best_;
  ShortestOnEdges shortest_;
  Vector<Interval> parts_;  // of the window that is emitted
  ExactDistance result_;
  double step_ = 1, base_ = 0, longest_ = infinite;
  Vec3 target_;
  std::size_t step_now_ = 0, live_ = 0, visited_ = 0;
  std::uint64_t most_ = 0;
  Poller poller_;
};

}  // namespace

GeodesicPoint::GeodesicPoint(const TriangleSides& sides, const Index* corners, const double* weights, Memory& memory)
    : places(&memory) {
  // Distinct corners whose weight counts. Two corners of a collapsed triangle can be one vertex; their weights add up.
  Index support[3], count = 0;
  const double least = least_weight * (weights[0] + weights[1] + weights[2]);
  double weight[3], sum = 0;
  for (Index k = 0; k < 3; ++k) {
    if (!(weights[k] > least)) continue;
    const Index same = static_cast<Index>(std::find(support, support + count, corners[k]) - support);
    if (same == count) {
      support[count] = corners[k];
      weight[count] = 0;
      ++count;
    }
    weight[same] += weights[k];
    sum += weights[k];
  }
  if (count == 1) {
    vertex = support[0];
    return;
  }
  if (count < 2) return;
  const Topology& topology = sides.topology;
  const Index e = topology.edge_between(support[0], support[1]);
  if (e == Mesh::none) return;
  for (Index i = topology.edge_triangle_start[at(e)]; i < topology.edge_triangle_start[at(e) + 1]; ++i) {
    Place place{topology.triangle(i), {0, 0, 0}};
    if (sides.is_copy(place.triangle)) continue;
    Index matched = 0;
    for (Index c = 0; c < 3; ++c) {
      for (Index k = 0; k < count; ++k) {
        if (sides.start(3 * place.triangle + c) != support[k]) continue;
        place.weight[c] = weight[k] / sum;
        ++matched;
      }
    }
    if (matched == count) places.push_back(place);
  }
  if (count == 3 && places.size() > 1) places.resize(1);
}

Vec3 GeodesicPoint::position(const Mesh& mesh) const noexcept {
  if (vertex >= 0) return mesh.positions[at(vertex)];
  Vec3 sum;
  for (Index k = 0; k < 3; ++k)
    sum = sum + places[0].weight[k] * mesh.positions[at(mesh.triangle(places[0].triangle)[k])];
  return sum;
}

ExactDistance exact_distance(const TriangleSides& sides, const ExactTask& task, Memory& memory) {
  return Propagation(sides, task, memory).run();
}

}  // namespace hf_inner::mesh
