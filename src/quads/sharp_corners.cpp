#include "quads/sharp_corners.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "quads/numbers.h"

namespace hf_inner::quads {
namespace {

constexpr double right_angle = half_turn / 2;
// Where the nearest whole numbers of quads change: below the first a corner is sharp, between the others a feature runs
// straight on.
constexpr double sharp = right_angle / 2, straight_from = 1.5 * right_angle, straight_to = 2.5 * right_angle;

// Two quads side by side need this many edge lengths between two creases. The quads beyond need as many before the next
// corner.
constexpr double two_quads = 2;

// A corner between two feature edges: the triangles on the left of `first`, which leaves the vertex, up to `last`,
// which comes in.
struct Corner {
  std::int32_t first, last;
  double angle;
};

class Opener {
 public:
  Opener(const remesh::FluxSurface& surface, const remesh::Table<std::uint8_t>& features, double edge_length,
         SharpCorners& out, Memory& memory)
      : surface_(surface),
        features_(features),
        room_(two_quads * edge_length),
        out_(out),
        run_(&memory),
        ends_(&memory) {}

  void open(const Corner& corner) {
    const double turn = sharp - corner.angle / 2;
    set_inside(corner, -turn, -turn);
    const auto right = [&](std::int32_t h) { return corner_before(remesh::FluxSurface::next(h)); };
    const auto left = [&](std::int32_t h) { return corner_from(h); };
    // Nothing on the other side of a border asks for more quads along it.
    const bool crease = surface_.is_real(surface_.twin[corner.first]) && surface_.is_real(surface_.twin[corner.last]);
    const bool tooth =
        crease && walk(corner.first, true, right).length >= room_ && walk(corner.last, false, left).length >= room_;
    const double narrow = tooth ? room_ / 2 / sine(corner.angle / 2) : HUGE_VAL;
    turn_run(walk(corner.first, true, right), -turn, narrow, tooth);
    turn_run(walk(corner.last, false, left), turn, narrow, tooth);
  }
  // The corner that begins with feature half-edge `first`. Walks no farther than `most` radians.
  Corner corner_from(std::int32_t first, double most = HUGE_VAL) const {
    Corner out{first, none, 0};
    for (std::int32_t h = first; surface_.is_real(h); h = surface_.turn_left(h)) {
      out.angle += corner_angle(surface_, h);
      out.last = remesh::FluxSurface::previous(h);
      if (features_[out.last] || out.angle > most) break;
    }
    return out;
  }
  // Valleys: where turned feature edges end. All turns are known by now.
  void close() {
    for (std::size_t i = 0; i < ends_.size(); ++i) {
      const Corner corner = corner_from(ends_[i]);
      const double first = out_.turn[corner.first], last = out_.turn[corner.last];
      const double quads = std::max(1.0, std::nearbyint((corner.angle - first + last) / right_angle));
      set_inside(corner, first, corner.angle - quads * right_angle + last);
    }
  }

 private:
  // The corner whose triangles are on the right of h, up to the next feature edge on its right.
  Corner corner_before(std::int32_t h) const {
    double angle = corner_angle(surface_, h);
    for (; !features_[h]; angle += corner_angle(surface_, h)) h = surface_.turn_right(h);
    return {h, none, angle};
  }
  struct Run {
    double length = 0;      // up to the next corner
    std::int32_t end = -1;  // the feature half-edge that this corner begins with; -1 if it is sharp too
  };
  // Follows a feature edge, and those that continue it, to the next corner: on the right, or on the left. Keeps them in
  // run_.
  template <class Next>
  Run walk(std::int32_t h, bool to_right, Next&& next) {
    Run out;
    run_.clear();
    for (;;) {
      run_.push_back(h);
      out.length += length(h);
      const Corner corner = next(h);
      if (corner.angle < sharp) return out;
      if (corner.angle < straight_from || corner.angle > straight_to) {
        out.end = corner.first;
        return out;
      }
      h = to_right ? corner.first : corner.last;
    }
  }
  // Turns the crosses along the edges in run_ away from them: up to the length `narrow`, or up to the next corner where
  // that is not far behind.
  void turn_run(const Run& run, double turn, double narrow, bool tooth) {
    for (std::size_t i = 1; i < run_.size(); ++i)
      out_.passed[surface_.tail[turn < 0 ? run_[i] : remesh::FluxSurface::next(run_[i])]] = 1;
    if (run.end < 0) run_.resize(1);
    const bool all = run.length < narrow + room_;
    if (all && run.end >= 0) ends_.push_back(run.end);
    double from = 0;
    for (std::size_t i = 0; i < run_.size() && (all || from < narrow); ++i) {
      const std::int32_t h = run_[i];
      out_.turn[h] = turn;
      out_.tooth[h] = tooth;
      from += length(h);
    }
  }
  double length(std::int32_t h) const {
    return norm(surface_.position[surface_.head(h)] - surface_.position[surface_.tail[h]]);
  }
  // The triangles of a corner without a feature edge. The turn from `first` goes evenly from `begin` to `end`.
  void set_inside(const Corner& corner, double begin, double end) {
    double angle = 0;
    for (std::int32_t h = corner.first;; h = surface_.turn_left(h)) {
      const double own = corner_angle(surface_, h), middle = (angle + own / 2) / corner.angle;
      if (h != corner.first && remesh::FluxSurface::previous(h) != corner.last)
        out_.inside[h / 3] = {h, begin + middle * (end - begin) - angle};
      if (remesh::FluxSurface::previous(h) == corner.last) return;
      angle += own;
    }
  }

  const remesh::FluxSurface& surface_;
  const remesh::Table<std::uint8_t>& features_;
  const double room_;
  SharpCorners& out_;
  Vector<std::int32_t> run_, ends_;
};

}  // namespace

double corner_angle(const remesh::FluxSurface& s, std::int32_t h) noexcept {
  const Vec3 p = s.position[s.tail[h]], a = s.position[s.head(h)] - p,
             b = s.position[s.tail[remesh::FluxSurface::previous(h)]] - p;
  return arc_tangent(norm(cross(a, b)), dot(a, b));
}

SharpCorners SharpCorners::find(const remesh::FluxSurface& surface, const remesh::Table<std::uint8_t>& features,
                                double edge_length, Memory& memory) {
  SharpCorners out(memory);
  Vector<Corner> corners(&memory);
  Opener opener(surface, features, edge_length, out, memory);
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    if (!features[h]) continue;
    const Corner corner = opener.corner_from(h, sharp);
    if (corner.angle < sharp && features[corner.last]) corners.push_back(corner);
  }
  out.count = static_cast<std::int32_t>(corners.size());
  if (out.empty()) return out;
  out.turn.assign(surface.half_count(), 0.0);
  out.tooth.assign(surface.half_count(), 0);
  out.passed.assign(surface.vertex_count(), 0);
  out.inside.assign(surface.real_triangles, {});
  for (const Corner& corner : corners) opener.open(corner);
  opener.close();
  return out;
}

}  // namespace hf_inner::quads
