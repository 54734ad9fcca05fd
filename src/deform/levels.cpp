#include "deform/levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/compiler.h"

namespace hf_inner::deform {
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

// Adds the part of a triangle to the bins of its values. length: of the gradient.
void add_gradient(double low, double high, double length, double area, Histogram& histogram) noexcept {
  if (!(high - low > least_step) || !(length < steepest_gradient)) return;
  const int first = std::min(static_cast<int>(low * Levels::bins), Levels::bins - 1);
  const int last = std::min(static_cast<int>(high * Levels::bins), Levels::bins - 1);
  const double squared = area * length * length, cubed = squared * length;
  for (int b = first; b <= last; ++b) {
    histogram.squared[b] += squared;
    histogram.cubed[b] += cubed;
  }
}

// Adds a triangle to the histogram of a field. The gradient on it is n x (sum of phi_k times the edge opposite k) / (2
// area), with the normal n.
void add_triangle(const Rest::SampledTriangle& t, const double (&values)[3], Histogram& histogram) noexcept {
  const double low = std::min({values[0], values[1], values[2]}), high = std::max({values[0], values[1], values[2]});
  if (!(high - low > least_step)) return;
  const Vec3 sum = values[0] * t.opposite[0] + values[1] * t.opposite[1] + values[2] * t.opposite[2];
  add_gradient(low, high, norm(sum) / t.twice_area, 0.5 * t.twice_area, histogram);
}

HF_VECTOR(Four, double, 4);  // compiled to two halves without AVX

// Does the same for four fields whose values lie side by side, from phi[k] on at corner k.
HF_FOUR_LANES
void add_triangle_to_four(const Rest::SampledTriangle& t, const double* const (&phi)[3],
                          Histogram* histograms) noexcept {
  Four value[3], x = {}, y = {}, z = {};
  for (int k = 0; k < 3; ++k) std::memcpy(&value[k], phi[k], sizeof value[k]);
  x = value[0] * t.opposite[0].x + value[1] * t.opposite[1].x + value[2] * t.opposite[2].x;
  y = value[0] * t.opposite[0].y + value[1] * t.opposite[1].y + value[2] * t.opposite[2].y;
  z = value[0] * t.opposite[0].z + value[1] * t.opposite[1].z + value[2] * t.opposite[2].z;
  const Four square = x * x + y * y + z * z;
  double length[4];
  for (int l = 0; l < 4; ++l) length[l] = std::sqrt(square[l]) / t.twice_area;
  const double area = 0.5 * t.twice_area;
  for (int l = 0; l < 4; ++l) {
    const double a = phi[0][l], b = phi[1][l], c = phi[2][l];
    add_gradient(std::min(std::min(a, b), c), std::max(std::max(a, b), c), length[l], area, histograms[l]);
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

Vector<Levels> make_levels(const surface::Core& core, const Rest& rest, const HandleFields& fields,
                           const Vector<FieldPart>& parts, const Vector<std::int32_t>& part_start, BandSpacing spacing,
                           Memory& memory) {
  const mesh::Mesh& mesh = core.mesh;
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
        if (p + 3 < part_start[c + 1] && parts[p + 3].handle == handle + 3) {
          const double* const from[3] = {phi[0] + handle, phi[1] + handle, phi[2] + handle};
          add_triangle_to_four(triangle, from, &histograms[share * parts.size() + p]);
          p += 3;
          continue;
        }
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

}  // namespace hf_inner::deform
