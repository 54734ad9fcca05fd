#include "mesh/trace_cut.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/progress.h"
#include "mesh/vertex_fan.h"

namespace hf_inner::mesh {
namespace {

class CutTracer {
 public:
  CutTracer(const Mesh& mesh, const Topology& topology, const CutLine& line, Memory& memory)
      : mesh_(mesh),
        topology_(topology),
        line_(line),
        memory_(memory),
        out_(memory),
        on_edges_(&memory),
        inside_(&memory),
        at_vertices_(&memory),
        pieces_(&memory),
        cut_(&memory),
        divided_(&memory),
        whole_(&memory),
        corners_(&memory),
        wings_(&memory),
        number_(&memory),
        division_(memory),
        locals_(&memory),
        by_vertex_(&memory),
        doubled_(&memory) {}

  TracedCut make() {
    list_points();
    require_no_touch();
    list_pieces();
    refuse_touches();
    list_triangles();
    divide();
    require_no_touch();
    list_wings();
    part();
    write();
    list_rims();
    return std::move(out_);
  }

 private:
  static constexpr Index no_conflict = std::numeric_limits<Index>::max();
  // Divided triangles between two reports, each some microseconds; and the share of the progress that dividing takes.
  static constexpr std::size_t reported = 64;
  static constexpr float most_divided = 0.8f;

  // A point of the line by the edge or triangle that it lies on.
  struct On {
    Index where;
    std::int64_t a, b;
    Index point;
    bool operator<(const On& o) const noexcept {
      if (where != o.where) return where < o.where;
      if (a != o.a) return a < o.a;
      return b != o.b ? b < o.b : point < o.point;
    }
  };
  // A straight piece of the line, from point `from` of it to the next: through a triangle, or along an edge.
  struct Piece {
    Index triangle, edge, from;
    bool operator<(const Piece& o) const noexcept {
      return triangle != o.triangle ? triangle < o.triangle : from < o.from;
    }
  };

  const LinePoint& point(Index p) const noexcept { return line_.points[at(p)]; }
  Index point_count() const noexcept { return static_cast<Index>(line_.points.size()); }
  Index piece_count() const noexcept { return point_count() - (line_.closed ? 0 : 1); }
  Index after(Index p) const noexcept { return p + 1 == point_count() ? 0 : p + 1; }
  // The segment by which the line comes to a point.
  Index segment_to(Index p) const noexcept { return point(p > 0 ? p - 1 : 0).segment; }
  void refuse(Index segment) noexcept { conflict_ = std::min(conflict_, segment); }
  void require_no_touch() const {
    if (conflict_ != no_conflict)
      fail(HF_ERROR_CONFLICT, static_cast<std::uint32_t>(conflict_),
           "the line crosses or touches itself between point %d and the next, within the snap share; make several cuts",
           conflict_);
  }

  void list_points() {
    for (Index p = 0; p < point_count(); ++p) {
      const LinePoint& one = point(p);
      if (one.vertex != Mesh::none)
        at_vertices_.push_back({one.vertex, 0, 0, p});
      else if (one.edge != Mesh::none)
        on_edges_.push_back({one.edge, one.in.a, 0, p});
      else
        inside_.push_back({one.triangle, one.in.a, one.in.b, p});
    }
    for (Vector<On>* list : {&at_vertices_, &on_edges_, &inside_}) {
      std::sort(list->begin(), list->end());
      for (std::size_t i = 1; i < list->size(); ++i) {
        const On &one = (*list)[i - 1], &two = (*list)[i];
        if (one.where == two.where && one.a == two.a && one.b == two.b) refuse(segment_to(two.point));
      }
    }
  }

  bool is_on_edge(const LinePoint& one, Index edge) const noexcept {
    return one.edge == edge ||
           (one.vertex != Mesh::none && (topology_.first(edge) == one.vertex || topology_.second(edge) == one.vertex));
  }
  bool is_in(const LinePoint& one, Index t) const noexcept {
    if (one.triangle != Mesh::none) return one.triangle == t;
    const Index* const v = mesh_.triangle(t);
    const auto has = [&](Index vertex) { return v[0] == vertex || v[1] == vertex || v[2] == vertex; };
    if (one.vertex != Mesh::none) return has(one.vertex);
    return has(topology_.first(one.edge)) && has(topology_.second(one.edge));
  }
  // The edge that both points lie on, or none.
  Index common_edge(const LinePoint& p, const LinePoint& q) const noexcept {
    if (p.edge != Mesh::none) return is_on_edge(q, p.edge) ? p.edge : Mesh::none;
    if (q.edge != Mesh::none) return is_on_edge(p, q.edge) ? q.edge : Mesh::none;
    if (p.vertex == Mesh::none || q.vertex == Mesh::none) return Mesh::none;
    return topology_.edge_between(p.vertex, q.vertex);
  }
  Index common_triangle(const LinePoint& p, const LinePoint& q) const noexcept {
    if (p.triangle != Mesh::none) return is_in(q, p.triangle) ? p.triangle : Mesh::none;
    if (q.triangle != Mesh::none) return is_in(p, q.triangle) ? q.triangle : Mesh::none;
    const Index e = p.edge != Mesh::none ? p.edge : q.edge;
    if (e == Mesh::none) return Mesh::none;
    const LinePoint& other = p.edge != Mesh::none ? q : p;
    for (Index i = topology_.edge_triangle_start[at(e)]; i < topology_.edge_triangle_start[at(e) + 1]; ++i)
      if (is_in(other, topology_.triangle(i))) return topology_.triangle(i);
    return Mesh::none;
  }

  void list_pieces() {
    Poller poller;
    for (Index p = 0; p < piece_count(); ++p) {
      poller.due();
      const Index q = after(p), edge = common_edge(point(p), point(q));
      const Index triangle = edge != Mesh::none ? Mesh::none : common_triangle(point(p), point(q));
      if (edge == Mesh::none && triangle == Mesh::none)
        fail(HF_ERROR_INTERNAL, static_cast<std::uint32_t>(point(p).segment),
             "the path from point %d to the next is not on triangles", point(p).segment);
      pieces_.push_back({triangle, edge, p});
      cut_.push_back({std::min(global(p), global(q)), std::max(global(p), global(q))});
    }
    std::sort(pieces_.begin(), pieces_.end());
    std::sort(cut_.begin(), cut_.end());
  }

  // The position of a point along an edge.
  std::int64_t along(Index edge, const LinePoint& one) const noexcept {
    if (one.edge == edge) return one.in.a;
    return one.vertex == topology_.second(edge) ? GridPoint::grid : 0;
  }
  Span<const On> points_on(const Vector<On>& list, Index where) const noexcept {
    const auto begin = std::lower_bound(list.begin(), list.end(), On{where, 0, 0, 0});
    auto end = begin;
    while (end != list.end() && end->where == where) ++end;
    return {list.data() + (begin - list.begin()), static_cast<std::size_t>(end - begin)};
  }

  // A piece along an edge must not pass another point of the line.
  void refuse_touches() {
    for (const Piece& piece : pieces_) {
      if (piece.edge == Mesh::none) continue;
      const std::int64_t x = along(piece.edge, point(piece.from)), y = along(piece.edge, point(after(piece.from)));
      for (const On& one : points_on(on_edges_, piece.edge))
        if (one.a > std::min(x, y) && one.a < std::max(x, y))
          refuse(std::max(point(piece.from).segment, segment_to(one.point)));
    }
  }

  // The triangles that are divided: those with points on their edges or inside.
  void list_triangles() {
    for (const On& one : on_edges_) {
      for (Index i = topology_.edge_triangle_start[at(one.where)]; i < topology_.edge_triangle_start[at(one.where) + 1];
           ++i)
        divided_.push_back(topology_.triangle(i));
    }
    for (const On& one : inside_) divided_.push_back(one.where);
    std::sort(divided_.begin(), divided_.end());
    divided_.erase(std::unique(divided_.begin(), divided_.end()), divided_.end());
  }

  // The corners of a triangle in ascending order.
  struct Corners {
    explicit Corners(const Index* v) : corner{v[0], v[1], v[2]} { std::sort(corner, corner + 3); }
    bool operator<(const Corners& o) const noexcept {
      return std::lexicographical_compare(corner, corner + 3, o.corner, o.corner + 3);
    }
    Index corner[3];
  };

  // The number of a point of the line among inner vertices and new ones.
  Index global(Index p) const noexcept {
    return point(p).vertex != Mesh::none ? point(p).vertex : mesh_.vertex_count() + p;
  }

  struct Corner {
    Index vertex;  // global
    GridPoint in;  // its place in the triangle
  };

  void divide() {
    std::size_t count = 0;
    auto piece = std::lower_bound(pieces_.begin(), pieces_.end(), Piece{0, 0, 0});
    for (const Index t : divided_) {
      if (++count % reported == 0)
        report(most_divided * static_cast<float>(count) / static_cast<float>(divided_.size()));
      const Index* const v = mesh_.triangle(t);
      division_.begin(mesh_.positions[at(v[0])], mesh_.positions[at(v[1])], mesh_.positions[at(v[2])]);
      locals_.clear();
      for (int k = 0; k < 3; ++k) locals_.push_back({v[k], k});
      for (int k = 0; k < 3; ++k) add_side(v, k);
      for (const On& one : points_on(inside_, t)) add(one.point, {one.a, one.b});
      by_vertex_.assign(locals_.begin(), locals_.end());
      std::sort(by_vertex_.begin(), by_vertex_.end());
      for (; piece != pieces_.end() && piece->triangle == t; ++piece) {
        if (!division_.join(local(global(piece->from)), local(global(after(piece->from)))))
          refuse(point(piece->from).segment);
      }
      for (std::size_t i = 0; i < division_.triangle_count(); ++i) {
        for (int k = 0; k < 3; ++k) {
          const Index p = division_.corners(i)[k];
          corners_.push_back({locals_[at(p)].vertex, division_.point(p)});
        }
        out_.sources.push_back(mesh_.given_of_triangle(t));
      }
    }
  }
  void add_side(const Index* v, int k) {
    const Index edge = topology_.edge_between(v[k], v[(k + 1) % 3]);
    const bool forward = topology_.first(edge) == v[k];
    for (const On& one : points_on(on_edges_, edge)) {
      const std::int64_t second = forward ? one.a : GridPoint::grid - one.a, first = GridPoint::grid - second;
      add(one.point, k == 0 ? GridPoint{first, second} : k == 1 ? GridPoint{0, first} : GridPoint{second, 0});
    }
  }
  void add(Index p, GridPoint place) { locals_.push_back({global(p), division_.add(place)}); }
  Index local(Index vertex) const noexcept {
    return std::lower_bound(by_vertex_.begin(), by_vertex_.end(), Local{vertex, 0})->number;
  }

  // The point of the line at a global number, or none.
  Index point_at(Index vertex) const noexcept {
    if (vertex >= mesh_.vertex_count()) return vertex - mesh_.vertex_count();
    const Span<const On> found = points_on(at_vertices_, vertex);
    return found.empty() ? Mesh::none : found[0].point;
  }

  // Lists the corners of triangles at points of the line. Triangles at its vertices that are not divided come last.
  void list_wings() {
    for (const On& one : at_vertices_) topology_.triangles_at(one.where, whole_);
    std::sort(whole_.begin(), whole_.end());
    whole_.erase(std::unique(whole_.begin(), whole_.end()), whole_.end());
    whole_.erase(std::remove_if(whole_.begin(), whole_.end(),
                                [&](Index t) { return std::binary_search(divided_.begin(), divided_.end(), t); }),
                 whole_.end());
    divided_count_ = corners_.size() / 3;
    for (const Index t : whole_) {
      const Index* const v = mesh_.triangle(t);
      for (int k = 0; k < 3; ++k)
        corners_.push_back({v[k], {k == 0 ? GridPoint::grid : 0, k == 1 ? GridPoint::grid : 0}});
    }
    Poller poller;
    for (std::size_t c = 0; c < corners_.size(); ++c) {
      poller.due();
      const Index p = point_at(corners_[c].vertex);
      if (p == Mesh::none) continue;
      const std::size_t t = c / 3, k = c % 3;
      wings_.push_back({p, static_cast<Index>(t), static_cast<Index>(k), corners_[3 * t + (k + 1) % 3].vertex,
                        corners_[3 * t + (k + 2) % 3].vertex});
    }
    std::sort(wings_.begin(), wings_.end(), [](const Wing& a, const Wing& b) {
      return a.vertex != b.vertex ? a.vertex < b.vertex : a.triangle < b.triangle;
    });
  }

  Span<const Wing> wings_at(Index p) const noexcept {
    const auto begin = std::lower_bound(wings_.begin(), wings_.end(), p,
                                        [](const Wing& wing, Index vertex) { return wing.vertex < vertex; });
    auto end = begin;
    while (end != wings_.end() && end->vertex == p) ++end;
    return {wings_.data() + (begin - wings_.begin()), static_cast<std::size_t>(end - begin)};
  }

  // Gives corners their numbers in the caller's mesh, and parts along the line.
  void part() {
    number_.assign(corners_.size(), 0);
    for (std::size_t c = 0; c < corners_.size(); ++c)
      if (corners_[c].vertex < mesh_.vertex_count()) number_[c] = given_vertex(mesh_, corners_[c].vertex);
    bool parted = false;
    Poller poller(64);
    Vector<Wing> fan(&memory_);
    for (Index p = 0; p < point_count(); ++p) {
      poller.due();
      fan.assign(wings_at(p).begin(), wings_at(p).end());
      for (Wing& wing : fan) wing.vertex = global(p);
      if (point(p).vertex == Mesh::none) {
        const std::uint32_t own = new_vertex(p);
        for (const Wing& wing : fan) number_[3 * at(wing.triangle) + at(wing.corner)] = own;
      }
      const Vector<FanPart> parts = fan_parts(fan, cut_, memory_);
      std::uint32_t copy = 0;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (i == 0 || parts[i].part != parts[i - 1].part) copy = new_vertex(p);
        const Wing& wing = fan[at(parts[i].wing)];
        number_[3 * at(wing.triangle) + at(wing.corner)] = copy;
      }
      parted = parted || !parts.empty();
    }
    if (!parted)
      fail(HF_ERROR_EMPTY, HF_NO_INDEX,
           "the line parts nothing: inside a surface it takes a point or an edge between its ends");
  }
  std::uint32_t new_vertex(Index p) {
    const LinePoint& one = point(p);
    const double step = 1.0 / static_cast<double>(GridPoint::grid);
    SurfacePlace place;
    if (one.vertex != Mesh::none) {
      place = SurfacePlace::at_vertex(one.vertex);
    } else if (one.edge != Mesh::none) {
      const double t = step * static_cast<double>(one.in.a);
      place = {{topology_.first(one.edge), topology_.second(one.edge), Mesh::none}, {1 - t, t, 0}};
    } else {
      for (int k = 0; k < 3; ++k) {
        place.vertex[k] = mesh_.triangle(one.triangle)[k];
        place.weight[k] = step * static_cast<double>(one.in.weight(k));
      }
    }
    out_.vertices.push_back(place);
    return mesh_.report.vertex_count + static_cast<std::uint32_t>(out_.vertices.size()) - 1;
  }

  // Whole triangles go and come in again where a corner has another vertex.
  void write() {
    for (const Mesh::Doubled& one : mesh_.doubled) doubled_.push_back(Corners(one.corner));
    std::sort(doubled_.begin(), doubled_.end());
    for (const Index t : divided_) remove(t);
    for (std::size_t t = 0; t < corners_.size() / 3; ++t) {
      const Index inner = t < divided_count_ ? Mesh::none : whole_[t - divided_count_];
      bool changed = inner == Mesh::none;
      for (std::size_t k = 0; !changed && k < 3; ++k)
        changed = number_[3 * t + k] != given_vertex(mesh_, mesh_.triangle(inner)[k]);
      if (!changed) continue;
      if (inner != Mesh::none) {
        remove(inner);
        out_.sources.push_back(mesh_.given_of_triangle(inner));
      }
      out_.triangles.insert(out_.triangles.end(), &number_[3 * t], &number_[3 * t] + 3);
      for (std::size_t k = 0; k < 3; ++k) {
        for (int w = 0; w < 3; ++w)
          out_.weights.push_back(static_cast<double>(corners_[3 * t + k].in.weight(w)) /
                                 static_cast<double>(GridPoint::grid));
      }
    }
    std::sort(out_.removed.begin(), out_.removed.end());
  }
  void remove(Index t) {
    const std::uint32_t given = mesh_.given_of_triangle(t);
    if (std::binary_search(doubled_.begin(), doubled_.end(), Corners(mesh_.triangle(t))))
      fail(HF_ERROR_UNSUPPORTED, given,
           "the line cuts triangle %u, which lies on another one; leave one of them out of the mesh", given);
    out_.removed.push_back(given);
  }

  std::uint32_t number_at(Index triangle, Index p) const noexcept {
    for (std::size_t c = 3 * at(triangle);; ++c)
      if (corners_[c].vertex == global(p)) return number_[c];
  }
  // A piece along a border has one side. The vertex on the other side is then the one of the piece before.
  void list_rims() {
    std::uint32_t before[2] = {HF_NO_INDEX, HF_NO_INDEX};
    Index first[2] = {Mesh::none, Mesh::none};
    for (Index p = 0; p < piece_count(); ++p) {
      const Index q = after(p);
      Index side[2] = {Mesh::none, Mesh::none};  // triangles on the left and on the right
      for (const Wing& wing : wings_at(p))
        if (wing.next == global(q)) side[side[0] == Mesh::none ? 0 : 1] = wing.triangle;
      for (const Wing& wing : wings_at(p))
        if (wing.last == global(q)) side[side[1] == Mesh::none ? 1 : 0] = wing.triangle;
      for (const Wing& wing : wings_at(p)) {  // where more than two triangles meet, those that go on
        if (wing.next != global(q) && wing.last != global(q)) continue;
        for (int s = 0; s < 2; ++s) {
          const bool goes_on = side[s] != Mesh::none && number_at(side[s], p) == before[s];
          if (!goes_on && wing.triangle != side[1 - s] && number_at(wing.triangle, p) == before[s])
            side[s] = wing.triangle;
        }
      }
      std::uint32_t here[2] = {HF_NO_INDEX, HF_NO_INDEX};
      bool turned = false;  // triangles may be turned round: the left stays where it was
      for (int s = 0; s < 2; ++s) {
        if (side[s] == Mesh::none) continue;
        here[s] = number_at(side[s], p);
        turned = turned || (here[s] == before[1 - s] && here[s] != before[s]);
      }
      if (turned) {
        std::swap(side[0], side[1]);
        std::swap(here[0], here[1]);
      }
      if (p == 0) std::copy_n(side, 2, first);
      for (int s = 0; s < 2; ++s)
        if (here[s] == HF_NO_INDEX) here[s] = before[s] != HF_NO_INDEX ? before[s] : here[1 - s];
      out_.rims.insert(out_.rims.end(), here, here + 2);
      for (int s = 0; s < 2; ++s) before[s] = number_at(side[s] != Mesh::none ? side[s] : side[1 - s], q);
    }
    if (!line_.closed) out_.rims.insert(out_.rims.end(), before, before + 2);
    for (std::size_t s = 0; line_.closed && s < 2; ++s)
      if (first[s] == Mesh::none) out_.rims[s] = before[s];
  }

  const Mesh& mesh_;
  const Topology& topology_;
  const CutLine& line_;
  Memory& memory_;
  TracedCut out_;
  Index conflict_ = no_conflict;
  Vector<On> on_edges_, inside_, at_vertices_;  // points of the line, sorted
  Vector<Piece> pieces_;                        // by triangle
  Vector<CutEdge> cut_;                         // the pieces by their ends, sorted
  Vector<Index> divided_, whole_;               // triangles, ascending
  Vector<Corner> corners_;  // of the parts of divided triangles, then of the whole ones at vertices of the line
  std::size_t divided_count_ = 0;
  Vector<Wing> wings_;            // by point of the line, then by triangle of corners_
  Vector<std::uint32_t> number_;  // by corner: its vertex in the caller's mesh
  TriangleDivision division_;
  struct Local {
    Index vertex, number;
    bool operator<(const Local& o) const noexcept { return vertex != o.vertex ? vertex < o.vertex : number < o.number; }
  };
  Vector<Local> locals_, by_vertex_;  // the points of the present triangle
  Vector<Corners> doubled_;           // of the triangles that lie on others, sorted
};

}  // namespace

TracedCut trace_cut(const Mesh& mesh, const Topology& topology, Span<const CurvePoint> points,
                    const CutOptions& options, Memory& memory) {
  // the paths of a line take about as long as all that follows
  std::optional<ProgressRange> range(std::in_place, 0.0f, 0.5f);
  const CutLine line = cut_line(mesh, topology, points, options, memory);
  range.emplace(0.5f, 1.0f);
  return CutTracer(mesh, topology, line, memory).make();
}

}  // namespace hf_inner::mesh
