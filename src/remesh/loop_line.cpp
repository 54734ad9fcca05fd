#include "remesh/loop_line.h"

#include <algorithm>
#include <cmath>

namespace hf_inner {

void LoopLine::build(const FluxField& field, Loop loop, double value, bool border) {
  field_ = &field;
  const FluxSurface& s = field.surface();
  walk_loop(field, loop, edges_);
  points_.clear(), starts_.clear();
  for (const std::int32_t h : edges_) {
    const std::int32_t a = s.tail[h], b = s.head(h);
    double t = 0.5;
    if (s.is_apex(a)) {
      t = 1;
    } else if (s.is_apex(b)) {
      t = 0;
    } else if (!border) {
      const double span = field.value(b) - field.value(a);
      if (span > 0) t = std::min(std::max((value - field.value(a)) / span, 0.0), 1.0);
    }
    points_.push_back({(1 - t) * s.position[a] + t * s.position[b], t});
  }
  length_ = 0;
  for (std::int32_t i = 0; i < edges_.size(); ++i) starts_.push_back(length_), length_ += segment(i);
}

double LoopLine::segment(std::int32_t i) const noexcept { return norm(points_[around(i + 1)].p - points_[i].p); }

double LoopLine::place(std::int32_t i, double offset) const noexcept {
  const double share = std::min(std::max(offset / field_->flux(edges_[i]), 0.0), 1.0);
  if (share < 0.5) {
    const double place = starts_[i] - (0.5 - share) * segment(around(i - 1));
    return place < 0 ? place + length_ : place;
  }
  return starts_[i] + (share - 0.5) * segment(i);
}

double LoopLine::place_of(FluxPoint p) const noexcept {
  for (std::int32_t i = 0; i < edges_.size(); ++i)
    if (edges_[i] == p.half) return place(i, p.offset);
  return 0;
}

LoopLine::Spot LoopLine::spot(double place) const noexcept {
  if (!(length_ > 0)) return {0, 0.5};
  place -= length_ * std::floor(place / length_);
  const auto behind = std::upper_bound(starts_.begin(), starts_.end(), place);
  const std::int32_t i = static_cast<std::int32_t>(behind - starts_.begin()) - 1;
  const double full = segment(i), rest = full > 0 ? (place - starts_[i]) / full : 0.0;
  if (rest <= 0.5) return {i, 0.5 + rest};
  return {around(i + 1), rest - 0.5};
}

FluxPoint LoopLine::at(double place) const noexcept {
  const Spot found = spot(place);
  return {edges_[found.edge], found.share * field_->flux(edges_[found.edge])};
}

// Adds point i of the loop, weighted by `share`, to a location given by barycentric weights in the triangle.
void LoopLine::add(std::int32_t i, double share, std::int32_t triangle, SurfacePoint& out) const noexcept {
  const FluxSurface& s = field_->surface();
  const std::int32_t a = s.tail[edges_[i]], b = s.head(edges_[i]);
  for (int k = 0; k < 3; ++k) {
    const std::int32_t corner = s.tail[3 * triangle + k];
    if (corner == a) out.weight[k] += share * (1 - points_[i].t);
    if (corner == b) out.weight[k] += share * points_[i].t;
  }
}

SurfacePoint LoopLine::location(double place) const noexcept {
  const FluxSurface& s = field_->surface();
  const Spot found = spot(place);
  const std::int32_t h = edges_[found.edge];
  const bool left = found.share < 0.5;
  std::int32_t triangle = (left ? h : s.twin[h]) / 3;
  // A triangle at an apex closes a border and is not on the surface, so the triangle across the border is taken.
  if (triangle >= s.real_triangles) triangle = s.twin[3 * triangle] / 3;
  SurfacePoint out;
  out.triangle = triangle;
  const double beside = std::fabs(found.share - 0.5);
  add(found.edge, 1 - beside, triangle, out);
  add(around(found.edge + (left ? -1 : 1)), beside, triangle, out);
  return out;
}

}  // namespace hf_inner
