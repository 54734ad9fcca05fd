#include "remesh/flux_field.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "remesh/constants.h"

namespace hf_inner::remesh {
namespace {

constexpr std::int32_t none = -1;

}  // namespace

FluxField::FluxField(const FluxSurface& surface, Span<const double> u, Memory& memory)
    : surface_(&surface),
      memory_(&memory),
      u_(memory),
      rank_(surface.vertex_count(), 0, memory),
      matches_(&memory),
      match_start_(memory),
      saddle_of_(surface.vertex_count(), none, memory),
      saddle_scale_(memory) {
  const std::int32_t n = surface.vertex_count();
  Table<std::int32_t> order(memory);
  u_.reserve(n);
  order.reserve(n);
  for (std::int32_t v = 0; v < n; ++v) {
    u_.push_back(u[static_cast<std::size_t>(v)]);
    order.push_back(v);
  }
  std::sort(order.begin(), order.end(),
            [&](std::int32_t a, std::int32_t b) { return u_[a] != u_[b] ? u_[a] < u_[b] : a < b; });
  for (std::int32_t r = 0; r < n; ++r) rank_[order[r]] = r;
  match_start_.push_back(0);
  for (std::int32_t v = 0; v < n; ++v)
    if (sign_changes(v) > 2) match(v);
}

double FluxField::flux(std::int32_t h) const noexcept {
  const double f = surface_->weight[h] * (u_[surface_->head(h)] - u_[surface_->tail[h]]);
  return f > least_flux ? f : least_flux;
}

std::int32_t FluxField::sign_changes(std::int32_t v) const noexcept {
  const std::int32_t begin = surface_->out[v];
  std::int32_t changes = 0;
  bool before = rises(surface_->turn_right(begin));
  for (std::int32_t g = begin;;) {
    const bool now = rises(g);
    changes += now != before;
    before = now;
    g = surface_->turn_left(g);
    if (g == begin) return changes;
  }
}

void FluxField::match(std::int32_t v) {
  // Lists the edges around the vertex, counter-clockwise. Offsets within the flux of incoming edges grow with this
  // order, offsets of outgoing edges against it.
  struct Segment {
    std::int32_t half;  // the half-edge that points uphill
    bool in;
    double low, high;  // the flux not matched yet; for outgoing edges in units of the inflow
  };
  Vector<Segment> ring(memory_);
  double in = 0, out = 0;
  const std::int32_t begin = surface_->out[v];
  for (std::int32_t g = begin;;) {
    const bool outgoing = rises(g);
    const std::int32_t half = outgoing ? g : surface_->twin[g];
    const double f = flux(half);
    (outgoing ? out : in) += f;
    ring.push_back({half, !outgoing, 0.0, f});
    g = surface_->turn_left(g);
    if (g == begin) break;
  }
  for (Segment& s : ring)
    if (!s.in) s.high *= in / out;
  while (true) {
    const std::size_t size = ring.size();
    // A boundary lies between an incoming and an outgoing segment. `step` is the largest amount that every boundary can
    // match at once. A segment between two boundaries gives half of its flux to each.
    double step = -1;
    for (std::size_t i = 0; i < size; ++i) {
      const Segment& s = ring[i];
      const int ends = (ring[(i + size - 1) % size].in != s.in) + (ring[(i + 1) % size].in != s.in);
      if (ends == 0) continue;
      const double most = (s.high - s.low) / ends;
      if (step < 0 || most < step) step = most;
    }
    if (step < 0) break;  // only incoming or only outgoing segments are left, with rounding errors
    for (std::size_t i = 0; i < size && step > 0; ++i) {
      Segment &a = ring[i], &b = ring[(i + 1) % size];
      if (a.in == b.in) continue;
      if (a.in) {  // right end of the inflow beside the right end of the outflow
        matches_.push_back({v, a.half, b.half, a.high - step, b.high - step, step});
        a.high -= step;
        b.high -= step;
      } else {  // left end beside left end
        matches_.push_back({v, b.half, a.half, b.low, a.low, step});
        a.low += step;
        b.low += step;
      }
    }
    // Segments (parts of an edge's flux) that are fully matched are removed. Each round removes at least one, so the
    // loop ends.
    std::size_t kept = 0;
    double least = 0;
    for (std::size_t i = 0; i < size; ++i)
      least = i == 0 ? ring[i].high - ring[i].low : std::min(least, ring[i].high - ring[i].low);
    const double floor = std::max(least, least_segment * in);
    for (std::size_t i = 0; i < size; ++i)
      if (ring[i].high - ring[i].low > floor) ring[kept++] = ring[i];
    ring.resize(kept);
    if (kept < 2) break;
  }
  saddle_of_[v] = saddle_scale_.push_back(out / in);
  match_start_.push_back(static_cast<std::int32_t>(matches_.size()));
}

FluxPoint FluxField::through_saddle(std::int32_t v, FluxPoint p, bool upward) const {
  const std::int32_t k = saddle_of_[v];
  const double scale = saddle_scale_[k];
  const double offset = upward ? p.offset : p.offset / scale;
  const Match* best = nullptr;
  double missed = 0;
  for (std::int32_t i = match_start_[k]; i < match_start_[k + 1]; ++i) {
    const Match& m = matches_[static_cast<std::size_t>(i)];
    if ((upward ? m.in : m.out) != p.half) continue;
    const double from = upward ? m.in_offset : m.out_offset;
    const double miss = offset < from ? from - offset : offset > from + m.length ? offset - from - m.length : 0;
    if (!best || miss < missed) {
      best = &m;
      missed = miss;
    }
    if (miss == 0) break;
  }
  if (!best) return {};  // the edge carries no flux
  const double from = upward ? best->in_offset : best->out_offset, to = upward ? best->out_offset : best->in_offset;
  const double t = std::min(std::max(offset - from, 0.0), best->length);
  return {upward ? best->out : best->in, (to + t) * (upward ? scale : 1.0)};
}

FluxPoint FluxField::up(FluxPoint p) const {
  const FluxSurface& s = *surface_;
  const std::int32_t v = s.head(p.half);
  if (saddle_of_[v] != none) return through_saddle(v, p, true);
  // Incoming edges run counter-clockwise from left to right. This loop sums up the flux left of the line and finds the
  // left end.
  std::int32_t g = s.twin[p.half];  // leaves v
  double left = p.offset, in = flux(p.half);
  std::int32_t a = s.turn_right(g);
  for (; !rises(a); a = s.turn_right(a)) {
    if (a == g) return {};  // a maximum
    const double f = flux(s.twin[a]);
    left += f;
    in += f;
  }
  for (std::int32_t b = s.turn_left(g); !rises(b); b = s.turn_left(b)) in += flux(s.twin[b]);
  // Clockwise from there, the outgoing edges again run from left to right.
  double out = 0;
  for (std::int32_t b = a; rises(b); b = s.turn_right(b)) out += flux(b);
  double rest = left * (out / in);
  for (std::int32_t b = a;; b = s.turn_right(b)) {
    const double f = flux(b);
    if (rest <= f || !rises(s.turn_right(b))) return {b, std::min(rest, f)};
    rest -= f;
  }
}

FluxPoint FluxField::down(FluxPoint p) const {
  const FluxSurface& s = *surface_;
  const std::int32_t v = s.tail[p.half];
  if (saddle_of_[v] != none) return through_saddle(v, p, false);
  double left = p.offset, out = flux(p.half);
  std::int32_t a = s.turn_left(p.half);  // sum up the outflow left of the line, then find the leftmost inflow
  for (; rises(a); a = s.turn_left(a)) {
    if (a == p.half) return {};  // a minimum
    const double f = flux(a);
    left += f;
    out += f;
  }
  for (std::int32_t b = s.turn_right(p.half); rises(b); b = s.turn_right(b)) out += flux(b);
  double in = 0;
  for (std::int32_t b = a; !rises(b); b = s.turn_left(b)) in += flux(s.twin[b]);
  double rest = left * (in / out);
  for (std::int32_t b = a;; b = s.turn_left(b)) {
    const double f = flux(s.twin[b]);
    if (rest <= f || rises(s.turn_left(b))) return {s.twin[b], std::min(rest, f)};
    rest -= f;
  }
}

}  // namespace hf_inner::remesh
