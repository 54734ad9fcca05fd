#include "remesh/ring_levels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "remesh/constants.h"
#include "remesh/loop_line.h"

namespace hf_inner {
namespace {

// The mean distance s from the first level loop of an arc (annulus between critical points), by the field's value.
class Scale {
 public:
  Scale(const FluxField& field, const ArcGraph& graph, const Arc& arc, Memory& memory) : samples_(memory) {
    const FluxSurface& surface = field.surface();
    const std::int32_t m = arc.last - arc.first;
    const double low = field.value(arc.lower), high = field.value(arc.upper), span = high - low;
    auto value_at = [&](std::int32_t k) {
      return k < 0 ? low : k >= m ? high : field.value(graph.vertices[arc.first + k]);
    };
    LoopLine line(memory);
    const std::int32_t steps = std::min(m, loops_an_arc);
    std::int32_t before = -1;
    for (std::int32_t i = 0; i <= steps; ++i) {
      const std::int32_t k = steps ? static_cast<std::int32_t>(std::int64_t{m} * i / steps) : 0;
      if (k == before) continue;
      before = k;
      const double a = value_at(k - 1), b = value_at(k);
      const std::int32_t pieces = b - a > long_step * span ? long_step_pieces : 1;
      for (std::int32_t p = 0; p < pieces; ++p) {
        const double c = a + (b - a) * (p + 0.5) / pieces;
        line.build(field, graph.loop(field, arc, k), c, false);
        samples_.push_back({c, line.length(), 0});
      }
    }
    auto end_length = [&](std::int32_t v, double beside) {
      return field.sign_changes(v) == 0 && !surface.is_apex(v) ? 0.0 : beside;
    };
    samples_.insert(0, {low, end_length(arc.lower, samples_[0].length), 0});
    samples_.push_back({high, end_length(arc.upper, samples_.back().length), 0});
    const double flux = std::max(arc.flux, least_arc_flux);
    for (std::int32_t i = 1; i < samples_.size(); ++i) {
      const Sample &a = samples_[i - 1], &b = samples_[i];
      samples_[i].distance = a.distance + 0.5 * (a.length + b.length) * std::max(b.value - a.value, 0.0) / flux;
    }
  }
  double total() const noexcept { return samples_.back().distance; }
  double value(double distance) const noexcept { return interpolate(&Sample::distance, distance, &Sample::value); }
  double distance(double value) const noexcept { return interpolate(&Sample::value, value, &Sample::distance); }

 private:
  struct Sample {
    double value, length, distance;
  };
  // `out` where `in` is x, between the samples around it.
  double interpolate(double Sample::*in, double x, double Sample::*out) const noexcept {
    std::int32_t i = 1;
    while (i + 1 < samples_.size() && samples_[i].*in < x) ++i;
    const Sample &a = samples_[i - 1], &b = samples_[i];
    const double width = b.*in - a.*in;
    const double t = width > 0 ? std::min(std::max((x - a.*in) / width, 0.0), 1.0) : 0.5;
    return a.*out + t * (b.*out - a.*out);
  }
  Table<Sample> samples_;
};

// Returns the extreme value of a border's vertices: the highest at a source, the lowest at a sink.
double rim_value(const FluxField& field, std::int32_t apex, bool highest) {
  const FluxSurface& s = field.surface();
  const std::int32_t begin = s.out[apex];
  double value = field.value(s.head(begin));
  for (std::int32_t g = begin;;) {
    const double u = field.value(s.head(g));
    value = highest ? std::max(value, u) : std::min(value, u);
    g = s.turn_left(g);
    if (g == begin) return value;
  }
}

}  // namespace

void place_rings(const FluxField& field, const ArcGraph& graph, const RingOptions& options, Memory& memory,
                 RingMesh& out) {
  const FluxSurface& surface = field.surface();
  const double h = options.edge_length;
  out.ring_start.push_back(0);
  for (std::int32_t index = 0; index < graph.arcs.size(); ++index) {
    const Arc& arc = graph.arcs[index];
    const std::int32_t m = arc.last - arc.first;
    const bool border_below = surface.is_apex(arc.lower), border_above = surface.is_apex(arc.upper);
    const bool site_below = !border_below && field.sign_changes(arc.lower) == 0,
               site_above = !border_above && field.sign_changes(arc.upper) == 0;
    auto add = [&](double value) {
      std::int32_t low = 0, high = m;  // vertices below the value, by bisection
      while (low < high) {
        const std::int32_t middle = (low + high) / 2;
        if (field.value(graph.vertices[arc.first + middle]) < value) {
          low = middle + 1;
        } else {
          high = middle;
        }
      }
      const Loop loop = graph.loop(field, arc, low);
      Ring ring;
      ring.arc = index, ring.threshold = loop.threshold, ring.seed = loop.seed, ring.value = value;
      out.rings.push_back(ring);
    };
    auto add_border = [&](bool below) {
      const Loop loop = graph.loop(field, arc, below ? 0 : m);
      Ring ring;
      ring.arc = index, ring.threshold = loop.threshold, ring.seed = loop.seed, ring.border = true;
      ring.value = field.value(below ? arc.lower : arc.upper);
      out.rings.push_back(ring);
    };

    const Scale scale(field, graph, arc, memory);
    double from = 0, to = scale.total();
    if (border_below) from = std::min(scale.distance(rim_value(field, arc.lower, true)), to);
    if (border_above) to = std::max(scale.distance(rim_value(field, arc.upper, false)), from);
    const double first = border_below ? 0 : h * (site_below ? ring_at_site : ring_at_saddle),
                 last = border_above ? 0 : h * (site_above ? ring_at_site : ring_at_saddle);
    const double room = to - from - first - last;
    if (border_below) add_border(true);
    if (room <= 0) {
      if (!border_below && !border_above) add(scale.value(from + (to - from) * first / (first + last)));
    } else {
      const double steps = std::round(room / h);
      if (static_cast<double>(out.rings.size()) + steps > most_rings)
        fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "more than %g rings; take a larger edge_length", most_rings);
      const std::int32_t n = static_cast<std::int32_t>(steps);
      // Rings of nodes are placed evenly from one end of the free range to the other. An end at a border already has
      // its ring.
      for (std::int32_t k = 0; k <= n; ++k) {
        if ((k == 0 && border_below) || (k == n && border_above && (n > 0 || !border_below))) continue;
        if (n == 0 && (border_below || border_above)) continue;
        const double t = n ? static_cast<double>(k) / n : 0.5;
        add(scale.value(from + first + t * room));
      }
    }
    if (border_above) add_border(false);
    out.ring_start.push_back(out.rings.size());
  }
}

}  // namespace hf_inner
