#include "quads/sharp_corners.h"

#include <algorithm>
#include <cmath>

#include "quads/numbers.h"

namespace hf_inner {
namespace {

constexpr double right_angle = half_turn / 2;
// Where the nearest whole numbers of quads change: below the first a corner is sharp, between the others a feature runs
// straight on.
constexpr double sharp = right_angle / 2, straight_from = 1.5 * right_angle, straight_to = 2.5 * right_angle;

// A corner between two feature edges: the triangles on the left of `first`, which leaves the vertex, up to `last`,
// which comes in.
struct Corner {
  std::int32_t first, last;
  double angle;
};

class Opener {
 public:
  Opener(const FluxSurface& surface, const Table<std::uint8_t>& features, SharpCorners& out, Memory& memory)
      : surface_(surface), features_(features), out_(out), run_(&memory), ends_(&memory) {}

  void open(const Corner& corner) {
    const double turn = sharp - corner.angle / 2;
    set_inside(corner, -turn, -turn);
    run(corner.first, -turn, [&](std::int32_t h) { return corner_before(FluxSurface::next(h)); });
    run(corner.last, turn, [&](std::int32_t h) { return corner_from(h); });
  }
  // The corner that begins with feature half-edge `first`. Walks no farther than `most` radians.
  Corner corner_from(std::int32_t first, double most = HUGE_VAL) const {
    Corner out{first, none, 0};
    for (std::int32_t h = first; surface_.is_real(h); h = surface_.turn_left(h)) {
      out.angle += corner_angle(surface_, h);
      out.last = FluxSurface::previous(h);
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
  // Turns the crosses along a feature edge, and along those that continue it, away from it.
  template <class Next>
  void run(std::int32_t h, double turn, Next&& next) {
    run_.clear();
    for (;;) {
      run_.push_back(h);
      const Corner corner = next(h);
      if (corner.angle < sharp) return set_turn(run_.front(), turn);
      if (corner.angle < straight_from || corner.angle > straight_to) {
        ends_.push_back(corner.first);
        break;
      }
      h = turn < 0 ? corner.first : corner.last;
      out_.passed[surface_.tail[corner.first]] = 1;
    }
    for (const std::int32_t own : run_) set_turn(own, turn);
  }
  void set_turn(std::int32_t h, double turn) { out_.turn[h] = turn; }
  // The triangles of a corner without a feature edge. The turn from `first` goes evenly from `begin` to `end`.
  void set_inside(const Corner& corner, double begin, double end) {
    double angle = 0;
    for (std::int32_t h = corner.first;; h = surface_.turn_left(h)) {
      const double own = corner_angle(surface_, h), middle = (angle + own / 2) / corner.angle;
      if (h != corner.first && FluxSurface::previous(h) != corner.last)
        out_.inside[h / 3] = {h, begin + middle * (end - begin) - angle};
      if (FluxSurface::previous(h) == corner.last) return;
      angle += own;
    }
  }

  const FluxSurface& surface_;
  const Table<std::uint8_t>& features_;
  SharpCorners& out_;
  Vector<std::int32_t> run_, ends_;
};

}  // namespace

double corner_angle(const FluxSurface& s, std::int32_t h) noexcept {
  const Vec3 p = s.position[s.tail[h]], a = s.position[s.head(h)] - p,
             b = s.position[s.tail[FluxSurface::previous(h)]] - p;
  return arc_tangent(norm(cross(a, b)), dot(a, b));
}

SharpCorners SharpCorners::find(const FluxSurface& surface, const Table<std::uint8_t>& features, Memory& memory) {
  SharpCorners out(memory);
  Vector<Corner> corners(&memory);
  Opener opener(surface, features, out, memory);
  for (std::int32_t h = 0; h < 3 * surface.real_triangles; ++h) {
    if (!features[h]) continue;
    const Corner corner = opener.corner_from(h, sharp);
    if (corner.angle < sharp && features[corner.last]) corners.push_back(corner);
  }
  out.count = static_cast<std::int32_t>(corners.size());
  if (out.empty()) return out;
  out.turn.assign(surface.half_count(), 0.0);
  out.passed.assign(surface.vertex_count(), 0);
  out.inside.assign(surface.real_triangles, {});
  for (const Corner& corner : corners) opener.open(corner);
  opener.close();
  return out;
}

}  // namespace hf_inner
