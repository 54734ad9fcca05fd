#include "mesh/line_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/index.h"
#include "base/progress.h"
#include "mesh/kept_faces.h"

namespace hf_inner::mesh {
namespace {

// A face lies on a line if no corner is farther from it than this share of its length. Without such a face a path is
// longer by the square of this share at most. Three points of a line that are rounded to floats, an edge of 1 % of the
// box apart, are nearer. More would take thin borders away; less leaves flaps that a file has rounded.
constexpr double line_share = 1e-5;
// Number of faces that one thread's job takes. Half and twice the value take the same time. No result depends on it.
constexpr std::size_t line_piece = 32768;

// The longest line between two corners of a face, if the face is thin.
struct Line {
  Vec3 from, along;
};

class LineFaces {
 public:
  LineFaces(const MeshInput& input, const Mesh& mesh, Memory& memory)
      : input_(input), mesh_(mesh), memory_(memory), edges_(&memory), sides_(&memory), faces_(&memory) {}

  // Lists the faces on a line whose corners all have a face with area. Returns whether there are any.
  bool find(JobRunner* jobs) {
    const std::size_t count = at(face_count(mesh_)), pieces = (count + line_piece - 1) / line_piece;
    Vector<Vector<Index>> found(pieces, &memory_);
    for_each(jobs, static_cast<std::uint32_t>(pieces), [&](std::uint32_t p) {
      for (std::size_t f = p * line_piece; f < std::min(count, (p + std::size_t{1}) * line_piece); ++f) {
        if (is_on_line(static_cast<Index>(f))) found[p].push_back(static_cast<Index>(f));
      }
    });
    for (const auto& list : found) faces_.insert(faces_.end(), list.begin(), list.end());
    if (faces_.empty()) return false;
    Vector<std::uint8_t> has_area(input_.vertex_count, 0, &memory_);
    std::size_t next = 0;
    for (Index f = 0; f < static_cast<Index>(count); ++f) {
      if (next < faces_.size() && faces_[next] == f)
        ++next;
      else
        for (const Index v : corners_of(mesh_, f)) has_area[at(v)] = 1;
    }
    const auto has_lone_corner = [&](Index f) {
      const Span<const Index> own = corners_of(mesh_, f);
      return std::any_of(own.begin(), own.end(), [&](Index v) { return !has_area[at(v)]; });
    };
    faces_.erase(std::remove_if(faces_.begin(), faces_.end(), has_lone_corner), faces_.end());
    return !faces_.empty();
  }

  // By face of the mesh: 0 for those that are left out. One that goes can free an edge of another.
  Vector<std::uint8_t> kept() {
    list_edges();
    Vector<std::uint8_t> kept(at(face_count(mesh_)), 1, &memory_);
    Vector<Index> queue(faces_.begin(), faces_.end(), &memory_);
    Poller poller;
    for (std::size_t head = 0; head < queue.size(); ++head) {
      poller.due();
      const Index face = queue[head];
      if (!kept[at(face)] || joins(face)) continue;
      kept[at(face)] = 0;
      each_side(face, [&](Index a, Index b) {
        // the last face on an edge may join nothing now
        Edge* const edge = edge_between(a, b);
        if (--edge->uses != 1) return;
        for (std::size_t i = edge->first; i < edge[1].first; ++i) {
          if (kept[at(sides_[i].face)]) queue.push_back(sides_[i].face);
        }
      });
    }
    return kept;
  }

 private:
  // A side of a face on a line.
  struct Side {
    Index a, b, face;
    bool operator<(const Side& o) const noexcept {
      if (a != o.a) return a < o.a;
      return b != o.b ? b < o.b : face < o.face;
    }
  };
  // An edge of faces on a line: its sides begin with number `first`. uses: sides of all kept faces.
  struct Edge {
    Index a, b;
    std::size_t first, uses;
  };

  Vec3 position(Index v) const noexcept {
    const std::size_t row = at(v);
    return mesh_.to_inner({input_.positions.get(row, 0), input_.positions.get(row, 1), input_.positions.get(row, 2)});
  }
  // From the corner that is farthest from the first one to the corner that is farthest from there.
  Line longest_line(Span<const Index> corner) const noexcept {
    Line line{position(corner[0]), {}};
    for (int end = 0; end < 2; ++end) {
      const Vec3 from = end == 0 ? line.from : line.from + line.along;
      line = {from, {}};
      for (const Index v : corner) {
        const Vec3 to = position(v) - from;
        if (dot(to, to) > dot(line.along, line.along)) line.along = to;
      }
    }
    return line;
  }
  // A face whose corners are at one place is no line: it shuts the hole where seams meet that are not welded.
  bool is_on_line(Index face) const noexcept {
    const Span<const Index> corner = corners_of(mesh_, face);
    if (corner.size() == 3) return is_thin(position(corner[0]), position(corner[1]), position(corner[2]));
    const Line line = longest_line(corner);
    const double squared = dot(line.along, line.along), limit = line_share * squared;
    return squared > 0 && std::all_of(corner.begin(), corner.end(), [&](Index v) {
             return norm(cross(line.along, position(v) - line.from)) <= limit;
           });
  }
  static bool is_thin(Vec3 a, Vec3 b, Vec3 c) noexcept {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    const double squared = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
    return squared > 0 && norm(cross(ab, bc)) <= line_share * squared;
  }

  // Calls visit(smaller vertex, larger vertex) for every side of a face.
  template <class Visit>
  void each_side(Index face, Visit&& visit) const {
    const Span<const Index> corner = corners_of(mesh_, face);
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Index a = corner[k], b = corner[(k + 1) % corner.size()];
      visit(std::min(a, b), std::max(a, b));
    }
  }
  // The edge of faces on a line between two vertices, a < b, or null.
  Edge* edge_between(Index a, Index b) noexcept {
    const auto found =
        std::lower_bound(edges_.begin(), edges_.end(), Edge{a, b, 0, 0},
                         [](const Edge& x, const Edge& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    return found != edges_.end() && found->a == a && found->b == b ? &*found : nullptr;
  }
  void list_edges() {
    Vector<std::uint8_t> touched(input_.vertex_count, 0, &memory_);
    for (const Index face : faces_) {
      each_side(face, [&](Index a, Index b) {
        sides_.push_back({a, b, face});
        touched[at(a)] = touched[at(b)] = 1;
      });
    }
    std::sort(sides_.begin(), sides_.end());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (i == 0 || sides_[i].a != sides_[i - 1].a || sides_[i].b != sides_[i - 1].b)
        edges_.push_back({sides_[i].a, sides_[i].b, i, 0});
    }
    edges_.push_back({std::numeric_limits<Index>::max(), 0, sides_.size(), 0});  // ends the last one
    Poller poller;
    for (Index f = 0; f < face_count(mesh_); ++f) {
      poller.due();
      each_side(f, [&](Index a, Index b) {
        Edge* const edge = touched[at(a)] && touched[at(b)] ? edge_between(a, b) : nullptr;
        if (edge) ++edge->uses;
      });
    }
  }

  // Whether two shared sides of a face overlap on its line. Then the face joins the triangles beyond them.
  bool joins(Index face) {
    struct Part {
      double begin, end;
      bool operator<(const Part& o) const noexcept { return begin < o.begin; }
    };
    const Line line = longest_line(corners_of(mesh_, face));
    Vector<Part> shared(&memory_);
    each_side(face, [&](Index a, Index b) {
      if (edge_between(a, b)->uses < 2) return;
      const double s = dot(position(a), line.along), t = dot(position(b), line.along);
      if (s != t) shared.push_back({std::min(s, t), std::max(s, t)});
    });
    std::sort(shared.begin(), shared.end());
    double reached = -std::numeric_limits<double>::infinity();
    for (const Part& part : shared) {
      if (part.begin < reached) return true;
      reached = part.end;
    }
    return false;
  }

  const MeshInput& input_;
  const Mesh& mesh_;
  Memory& memory_;
  Vector<Edge> edges_;  // sorted, one more
  Vector<Side> sides_;  // sorted
  Vector<Index> faces_;
};

}  // namespace

void leave_line_faces_out(const MeshInput& input, Mesh& mesh, Memory& memory, JobRunner* jobs) {
  LineFaces found(input, mesh, memory);
  if (!found.find(jobs)) return;
  poll();
  const Vector<std::uint8_t> kept = found.kept();
  if (std::find(kept.begin(), kept.end(), 0) == kept.end()) return;
  // by triangle of the mesh that begins a face: the face's new first triangle
  Vector<Index> number(at(mesh.triangle_count()), Mesh::none, &memory);
  {
    const Vector<Index> by_face = kept_numbers(kept, mesh, memory);
    for (Index f = 0; f < face_count(mesh); ++f) number[at(triangles_begin(mesh, f))] = by_face[at(f)];
  }
  for (Index& triangle : mesh.triangle_of_given) {
    if (triangle == Mesh::none) continue;
    triangle = number[at(triangle)];
    mesh.report.collapsed_triangle_count += triangle == Mesh::none;
  }
  // a doubled face goes with the one that it lies on, and counts as collapsed too
  const auto is_gone = [&](const Mesh::Doubled& entry) {
    return mesh.triangle_of_given[at(entry.given)] == Mesh::none;
  };
  Index last = Mesh::none;
  for (const Mesh::Doubled& entry : mesh.doubled) {
    if (is_gone(entry) && entry.given != last) --mesh.report.duplicate_triangle_count;
    last = entry.given;
  }
  mesh.doubled.remove_if(is_gone);
  keep_faces(kept, mesh);
}

}  // namespace hf_inner::mesh
