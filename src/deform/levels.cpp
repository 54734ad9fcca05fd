#include "deform/levels.h"

#include <algorithm>
#include <cmath>

namespace hf_inner {
namespace {

struct Histogram {
  double cubed[Levels::bins], squared[Levels::bins];
  void add(const Histogram& other) noexcept {
    for (int b = 0; b < Levels::bins; ++b) {
      cubed[b] += other.cubed[b];
      squared[b] += other.squared[b];
    }
  }
};

// Adds a triangle to the histogram of a field. The gradient on it is n x (sum of phi_k times the edge opposite k) / (2
// area), with the normal n.
void add_triangle(const Rest::SampledTriangle& t, const double (&values)[3], Histogram& histogram) noexcept {
  const double low = std::min({values[0], values[1], values[2]}), high = std::max({values[0], values[1], values[2]});
  if (!(high > low)) return;
  const Vec3 sum = values[0] * t.opposite[0] + values[1] * t.opposite[1] + values[2] * t.opposite[2];
  const double length = norm(sum) / t.twice_area, area = 0.5 * t.twice_area;
  if (!(length > 0) || !(length < steepest_gradient)) return;
  const int first = std::min(static_cast<int>(low * Levels::bins), Levels::bins - 1);
  const int last = std::min(static_cast<int>(high * Levels::bins), Levels::bins - 1);
  const double squared = area * length * length, cubed = squared * length;
  for (int b = first; b <= last; ++b) {
    histogram.squared[b] += squared;
    histogram.cubed[b] += cubed;
  }
}

void set_equal_value(Levels& levels) noexcept {
  for (int b = 0; b <= Levels::bins; ++b) levels.level[b] = static_cast<double>(b) / Levels::bins;
}

// Computes a field's mean gradient length per bin of field values. A bin without triangles takes the value of the
// nearest bin. Then a running mean smooths the bins.
bool mean_gradients(const Histogram& histogram, double (&smooth)[Levels::bins]) noexcept {
  double mean[Levels::bins];
  int last_full = -1;
  for (int b = 0; b < Levels::bins; ++b) {
    if (!(histogram.squared[b] > 0)) continue;
    mean[b] = histogram.cubed[b] / histogram.squared[b];
    for (int k = last_full + 1; k < b; ++k)
      mean[k] = last_full < 0 || b - k < k - last_full ? mean[b] : mean[last_full];
    last_full = b;
  }
  if (last_full < 0) return false;
  for (int k = last_full + 1; k < Levels::bins; ++k) mean[k] = mean[last_full];
  for (int b = 0; b < Levels::bins; ++b) {
    double sum = 0;
    const int low = std::max(0, b - smoothed_bins), high = std::min(Levels::bins - 1, b + smoothed_bins);
    for (int k = low; k <= high; ++k) sum += mean[k];
    smooth[b] = sum / (high - low + 1);
  }
  return true;
}

void set_equal_length(const Histogram& histogram, Levels& levels) noexcept {
  double g[Levels::bins];
  if (!mean_gradients(histogram, g)) return set_equal_value(levels);
  double largest = 0;
  for (const double x : g) largest = std::max(largest, x);
  levels.level[0] = 0;
  for (int b = 0; b < Levels::bins; ++b)
    levels.level[b + 1] = levels.level[b] + 1.0 / std::max(g[b], least_gradient * largest);
  const double total = levels.level[Levels::bins];
  for (double& s : levels.level) s /= total;
}

}  // namespace

double Levels::operator()(double phi) const noexcept {
  if (phi >= 1) return 1;
  if (!(phi > 0)) return 0;
  const double x = phi * bins;
  const int b = std::min(static_cast<int>(x), bins - 1);
  return level[b] + (x - b) * (level[b + 1] - level[b]);
}

Vector<Levels> make_levels(const Core& core, const Rest& rest, const HandleFields& fields,
                           const Vector<FieldPart>& parts, const Vector<std::int32_t>& part_start, BandSpacing spacing,
                           Memory& memory) {
  const Mesh& mesh = core.mesh;
  Vector<Levels> levels(parts.size(), Levels(), &memory);
  if (spacing == BandSpacing::equal_value) {
    for (Levels& l : levels) set_equal_value(l);
    return levels;
  }
  // The triangles are split into a fixed number of jobs. Their histograms of gradient lengths are summed in the order
  // of the jobs.
  Vector<Histogram> histograms(histogram_shares * parts.size(), Histogram{}, &memory);
  core.jobs->for_each(histogram_shares, [&](std::uint32_t share) {
    for (std::int32_t k = rest.sampled_start[share]; k < rest.sampled_start[share + 1]; ++k) {
      const Rest::SampledTriangle& triangle = rest.sampled[k];
      const std::int32_t c = mesh.component[triangle.corner[0]];
      const double* phi[3];
      for (int j = 0; j < 3; ++j) phi[j] = fields.at(triangle.corner[j]);
      for (std::int32_t p = part_start[c]; p < part_start[c + 1]; ++p) {
        const std::int32_t handle = parts[p].handle;
        add_triangle(triangle, {phi[0][handle], phi[1][handle], phi[2][handle]}, histograms[share * parts.size() + p]);
      }
    }
  });
  for (std::size_t share = 1; share < histogram_shares; ++share) {
    for (std::size_t p = 0; p < parts.size(); ++p) histograms[p].add(histograms[share * parts.size() + p]);
  }
  for (std::size_t p = 0; p < parts.size(); ++p) set_equal_length(histograms[p], levels[p]);
  return levels;
}

double eased_level(double level, std::int32_t band_count) noexcept {
  // Spans (knot intervals) of the basis of degree 2.
  const double spans = band_count, x = std::clamp(level, 0.0, 1.0) * spans;
  const auto eased = [](double d) { return 0.5 * (d + d * d * (2 - d)); };
  if (x < 1) return eased(x) / spans;
  return x > spans - 1 ? 1 - eased(spans - x) / spans : level;
}

BandValues band_values(double level, std::int32_t band_count, int degree) noexcept {
  // K + 2 B-spline functions of degree p take K + 2 - p spans between knots. The knots are clamped at both ends.
  const std::int32_t spans = band_count + 2 - degree;
  const double x = std::clamp(level, 0.0, 1.0) * spans;
  const std::int32_t span = std::min(static_cast<std::int32_t>(x), spans - 1);
  BandValues b{span, {0, 0, 0}};
  const double u = x - span;
  if (degree == 1) {
    b.value[0] = 1 - u;
    b.value[1] = u;
    return b;
  }
  const double low = span == 0 ? 1.0 : 2.0,
               high = span == spans - 1 ? 1.0 : 2.0;  // widths of the neighbouring pairs of spans
  b.value[0] = (1 - u) * (1 - u) / low;
  b.value[2] = u * u / high;
  b.value[1] = 1 - b.value[0] - b.value[2];
  return b;
}

}  // namespace hf_inner
