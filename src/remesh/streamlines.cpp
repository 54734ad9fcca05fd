#include "remesh/streamlines.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace hf_inner::remesh {

namespace {

// Tells whether an edge carries flux. Edges on a plateau, and edges to an apex (vertex that closes a border), carry
// none.
bool carries(const FluxField& field, std::int32_t h) {
  const FluxSurface& s = field.surface();
  return s.weight[h] > 0 && field.value(s.head(h)) > field.value(s.tail[h]);
}

// Values below this power of two pass as they are, so that their fluxes and sums stay finite. It is far above ordinary
// values and far below the largest double.
constexpr int most_exponent = 400;

// Returns the power of two that values are divided by: 0 for ordinary ones.
int spare_exponent(Span<const double> values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::fabs(value));
  return largest > 0 ? std::max(0, std::ilogb(largest) - most_exponent) : 0;
}

}  // namespace

FlowTracer::FlowTracer(std::shared_ptr<const surface::Core> core)
    : core_(std::move(core)),
      surface_(FluxSurface::make(core_->mesh, core_->topology(), *core_->memory)),
      fan_(core_->size(), -1, *core_->memory) {
  for (std::int32_t v = surface_.first_apex; v-- > 0;) fan_[surface_.mesh_vertex[v]] = v;
}

Vec3 FlowTracer::place(const FluxField& field, FluxPoint p) const noexcept {
  const FluxSurface& s = surface_;
  const std::int32_t h = p.half, a = s.tail[h], b = s.head(h);
  const double c = 0.5 * (field.value(a) + field.value(b));
  const Vec3 middle = 0.5 * (s.position[a] + s.position[b]);
  const double share = std::min(std::max(p.offset / field.flux(h), 0.0), 1.0);
  const bool left = share < 0.5;
  const std::int32_t side = left ? h : s.twin[h];
  if (!s.is_real(side)) return middle;  // on a border
  const std::int32_t x = s.tail[FluxSurface::previous(side)];
  const std::int32_t low = field.value(x) > c ? a : x, high = field.value(x) > c ? x : b;
  const double span = field.value(high) - field.value(low);
  const double t = span > 0 ? std::min(std::max((c - field.value(low)) / span, 0.0), 1.0) : 0.5;
  const Vec3 beside = (1 - t) * s.position[low] + t * s.position[high];
  return middle + std::fabs(share - 0.5) * (beside - middle);
}

// Follows a streamline from the point p on an edge to the line's end, and appends its points to `out`.
void FlowTracer::follow(const FluxField& field, FluxPoint p, bool upward, StreamlineSet& out, std::int32_t& end) const {
  for (std::int32_t steps = 0; p.half >= 0 && steps < surface_.half_count(); ++steps) {
    const std::int32_t a = surface_.tail[p.half], b = surface_.head(p.half);
    if (!carries(field, p.half)) return;
    out.point.push_back(place(field, p));
    out.value.push_back(0.5 * (field.value(a) + field.value(b)));
    end = upward ? b : a;
    p = upward ? field.up(p) : field.down(p);
  }
}

StreamlineSet FlowTracer::trace(Span<const double> u, std::uint32_t line_count, Span<const std::int32_t> seeds) const {
  const FluxSurface& s = surface_;
  Memory& memory = *core_->memory;
  // An apex (a vertex that closes a border) gets the value of a vertex on its border. Its edges have no weight here, so
  // it is no extremum.
  Vector<double> values(&memory);
  values.reserve(static_cast<std::size_t>(s.vertex_count()));
  for (std::int32_t v = 0; v < s.vertex_count(); ++v) {
    const std::int32_t w = s.is_apex(v) ? s.head(s.out[v]) : v;
    values.push_back(u[static_cast<std::size_t>(s.mesh_vertex[w])]);
  }
  const int exponent = spare_exponent(values);
  for (double& value : values) value = std::ldexp(value, -exponent);
  const FluxField field(s, values, memory);
  StreamlineSet out(memory);
  const auto finished = [&]() -> StreamlineSet&& {
    for (double& value : out.value) value = std::ldexp(value, exponent);
    return std::move(out);
  };
  out.start.push_back(0);
  auto vertex = [&](std::int32_t v) {
    out.point.push_back(s.position[v]);
    out.value.push_back(field.value(v));
    return s.mesh_vertex[v];
  };
  auto finish = [&](std::int32_t from, std::int32_t to) {
    if (out.point.size() >= HF_NO_INDEX) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "the lines have 2^32 points or more");
    out.from.push_back(from);
    out.to.push_back(to);
    out.start.push_back(static_cast<std::uint32_t>(out.point.size()));
  };

  for (const std::int32_t seed : seeds) {
    const std::int32_t v = fan_[seed], begin = s.out[v];
    std::int32_t best_up = -1, best_down = -1;
    for (std::int32_t g = begin;;) {
      if (carries(field, g) && (best_up < 0 || field.flux(g) > field.flux(best_up))) best_up = g;
      if (carries(field, s.twin[g]) && (best_down < 0 || field.flux(s.twin[g]) > field.flux(best_down)))
        best_down = s.twin[g];
      g = s.turn_left(g);
      if (g == begin) break;
    }
    // The streamline is traced down from the seed and reversed; then it is traced up from the seed. Where the field is
    // flat around the seed, no edge carries flux: the line is the seed alone.
    std::int32_t low = v, high = v;
    const std::size_t first = out.point.size();
    FluxPoint p, below;
    if (best_up >= 0) {
      p = {best_up, 0.5 * field.flux(best_up)};
      below = field.down(p);
    } else if (best_down >= 0) {
      below = {best_down, 0.5 * field.flux(best_down)};
    }
    follow(field, below, false, out, low);
    if (low != v) vertex(low);
    std::reverse(out.point.begin() + static_cast<std::ptrdiff_t>(first), out.point.end());
    std::reverse(out.value.begin() + static_cast<std::ptrdiff_t>(first), out.value.end());
    if (low == v) vertex(v);
    follow(field, p, true, out, high);
    if (high != v) vertex(high);
    finish(s.mesh_vertex[low], s.mesh_vertex[high]);
  }
  if (!seeds.empty()) return finished();

  // Finds the minima, also those on plateaus, with the flux that leaves them.
  struct Source {
    std::int32_t vertex;
    double flux;
  };
  Vector<Source> sources(&memory);
  double total = 0;
  for (std::int32_t v = 0; v < s.first_apex; ++v) {
    const std::int32_t begin = s.out[v];
    double flux = 0;
    bool minimum = true;
    for (std::int32_t g = begin; minimum;) {
      minimum = !carries(field, s.twin[g]);
      if (carries(field, g)) flux += field.flux(g);
      g = s.turn_left(g);
      if (g == begin) break;
    }
    if (minimum && flux > 0) {
      sources.push_back({v, flux});
      total += flux;
    }
  }
  double given = 0, passed = 0;
  for (const Source& source : sources) {
    // Rounding the running sum keeps every partial sum within one line of its exact share.
    passed += source.flux;
    const std::int64_t count = std::llround(passed / total * line_count) - std::llround(given);
    given += static_cast<double>(count);
    const std::int32_t begin = s.out[source.vertex];
    double sum = 0;
    std::int64_t k = 0;
    for (std::int32_t g = begin; k < count;) {
      const double f = carries(field, g) ? field.flux(g) : 0.0;
      // The offsets of lines within an edge's flux grow clockwise around a source.
      for (; k < count && source.flux * (static_cast<double>(k) + 0.5) / static_cast<double>(count) <= sum + f; ++k) {
        const double offset = source.flux * (static_cast<double>(k) + 0.5) / static_cast<double>(count) - sum;
        std::int32_t high = source.vertex;
        vertex(source.vertex);
        follow(field, {g, std::min(std::max(offset, 0.0), f)}, true, out, high);
        vertex(high);
        finish(s.mesh_vertex[source.vertex], s.mesh_vertex[high]);
      }
      sum += f;
      g = s.turn_right(g);
      if (g == begin) break;
    }
  }
  return finished();
}

}  // namespace hf_inner::remesh
