#include "field/levels.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/index.h"

namespace hf_inner::field {
namespace {

// A triangle's field values u in ascending order, its area, and its area times |grad u|.
struct Part {
  double low, middle, high, area, rise;

  // Returns the area of that part of the triangle where the field is below c.
  double area_below(double c) const noexcept {
    if (c <= low) return 0;
    if (c >= high) return area;
    if (c <= middle) return area * ((c - low) / (middle - low)) * ((c - low) / (high - low));
    return area * (1 - ((high - c) / (high - middle)) * ((high - c) / (high - low)));
  }
};

// Returns the triangles whose corners all have field values. The values are scaled so that the range of the field is 0
// to 1.
Vector<Part> parts_of(const mesh::Mesh& mesh, Span<const double> field, double& low, double& high, Memory& memory) {
  Vector<Part> parts(&memory);
  parts.reserve(at(mesh.triangle_count()));
  bool first = true;
  for (const bool measure : {true, false}) {
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
      const Index* v = mesh.triangle(t);
      double u[3] = {field[at(v[0])], field[at(v[1])], field[at(v[2])]};
      if (std::isnan(u[0]) || std::isnan(u[1]) || std::isnan(u[2])) continue;
      if (measure) {
        for (const double value : u) {
          low = first ? value : std::min(low, value);
          high = first ? value : std::max(high, value);
          first = false;
        }
        continue;
      }
      for (double& value : u) value = (0.5 * value - 0.5 * low) / (0.5 * high - 0.5 * low);
      const Vec3 a = mesh.positions[at(v[0])], e1 = mesh.positions[at(v[1])] - a, e2 = mesh.positions[at(v[2])] - a;
      Part part;
      part.area = 0.5 * norm(cross(e1, e2));
      // With the normal n, |grad u| area = |(u1 - u0) n x (p0 - p2) + (u2 - u0) n x (p1 - p0)| / 2. The product n x
      // does not change lengths in the plane, so it is left out.
      part.rise = 0.5 * norm((u[2] - u[0]) * e1 - (u[1] - u[0]) * e2);
      std::sort(u, u + 3);
      part.low = u[0];
      part.middle = u[1];
      part.high = u[2];
      parts.push_back(part);
    }
    if (first) fail(HF_ERROR_EMPTY, HF_NO_INDEX, "no triangle has a value at each of its corners");
    if (!(high > low))
      fail(HF_ERROR_INVALID_ARGUMENT, HF_NO_INDEX, "the field is constant (%g); it has no levels to space", low);
  }
  return parts;
}

// Number of bisections of [0, 1]: one for each bit of a double. Fewer would leave the levels inexact, and more would
// change nothing.
constexpr int bisections = 52;

// Bisects all levels at once. The trial levels stay in order because their target areas are in order.
void equal_areas(const Vector<Part>& parts, Span<double> out, Memory& memory) {
  const std::size_t count = out.size();
  double total = 0;
  for (const Part& part : parts) total += part.area;
  Vector<double> below(count, 0.0, &memory), above(count, 1.0, &memory), partial(count, &memory),
      whole(count + 1, &memory);
  for (int pass = 0; pass < bisections; ++pass) {
    for (std::size_t k = 0; k < count; ++k) out[k] = 0.5 * (below[k] + above[k]);
    std::fill(partial.begin(), partial.end(), 0.0);
    std::fill(whole.begin(), whole.end(), 0.0);
    for (const Part& part : parts) {
      const double* level = std::upper_bound(out.begin(), out.end(), part.low);
      for (; level != out.end() && *level < part.high; ++level)
        partial[static_cast<std::size_t>(level - out.begin())] += part.area_below(*level);
      whole[static_cast<std::size_t>(level - out.begin())] += part.area;
    }
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      sum += whole[k];
      const double target = total * static_cast<double>(k + 1) / static_cast<double>(count + 1);
      (sum + partial[k] < target ? below[k] : above[k]) = out[k];
    }
  }
}

// A triangle whose values differ by less than this share of the range counts as flat. It gets no lines and no width,
// because a whole component may be constant. Half and double change no level on eight shapes with needles, loose pieces
// and a long ribbon.
constexpr double flat = 1e-9;
// The field's range is cut into cells to sum areas: at most this many equal steps, and as many quantiles. Time grows
// with their number. Half and double move levels of distances by 9e-4 and 4e-4 of the range on a machine of 47 pieces,
// and by at most 9e-6 on six other shapes.
constexpr std::size_t most = 2048;
// A cell (part of the field's range) has at least this height. Thinner cells would collect rounding errors, as values
// are exact to 1e-16 of the range. Half and double change no level on seven shapes.
constexpr double least_cell = 1e-9;

void equal_widths(const Vector<Part>& parts, Span<double> out, Memory& memory) {
  // The limits of the cells (parts of the field's range) are equal steps of the value, and quantiles of the triangles'
  // middle values. The quantiles put more cells where most of the surface is.
  Vector<double> middle(&memory), edge(&memory);
  middle.reserve(parts.size());
  for (const Part& part : parts) {
    if (part.high - part.low > flat) middle.push_back(part.middle);
  }
  if (middle.empty()) {  // no triangle rises by more than rounding: equal values
    for (std::size_t i = 0; i < out.size(); ++i)
      out[i] = static_cast<double>(i + 1) / static_cast<double>(out.size() + 1);
    return;
  }
  std::sort(middle.begin(), middle.end());
  for (std::size_t k = 0; k <= most; ++k) {
    edge.push_back(static_cast<double>(k) / most);
    edge.push_back(middle[(middle.size() - 1) * k / most]);
  }
  std::sort(edge.begin(), edge.end());
  Vector<double> kept(&memory);
  for (const double c : edge) {
    if (kept.empty() || c - kept.back() > least_cell) kept.push_back(c);
  }
  kept.back() = 1;
  edge.swap(kept);
  const std::size_t cells = edge.size() - 1;
  Vector<double> area(cells, 0.0, &memory), rise(cells, 0.0, &memory), width(cells + 1, 0.0, &memory);
  for (const Part& part : parts) {
    if (!(part.high - part.low > flat)) continue;
    std::size_t k = static_cast<std::size_t>(std::upper_bound(edge.begin(), edge.end(), part.low) - edge.begin());
    k = std::min(std::max<std::size_t>(k, 1), cells) - 1;
    double before = 0;
    for (; k < cells && edge[k] < part.high; ++k) {
      const double below = k + 1 == cells ? part.area : part.area_below(edge[k + 1]);
      const double inside = below - before;
      area[k] += inside;
      if (part.area > 0) rise[k] += part.rise * (inside / part.area);
      before = below;
    }
  }
  for (std::size_t k = 0; k < cells; ++k) {
    // The width of a cell (part of the field's range) is its area over the mean length of its iso-lines. That mean
    // length is rise[k] over the height of the cell, where rise[k] sums area times |grad u| in the cell.
    width[k + 1] = width[k] + (rise[k] > 0 ? area[k] * (edge[k + 1] - edge[k]) / rise[k] : 0.0);
  }
  std::size_t k = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double target = width[cells] * static_cast<double>(i + 1) / static_cast<double>(out.size() + 1);
    while (k + 1 < cells && width[k + 1] < target) ++k;
    const double step = width[k + 1] - width[k];
    out[i] = edge[k] + (step > 0 ? (target - width[k]) / step : 0.0) * (edge[k + 1] - edge[k]);
  }
}

}  // namespace

void space_levels(const mesh::Mesh& mesh, Span<const double> field, LevelSpacing spacing, Span<double> out,
                  Memory& memory) {
  double low = 0, high = 0;
  const Vector<Part> parts = parts_of(mesh, field, low, high, memory);
  switch (spacing) {
    case LevelSpacing::value:
      for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = static_cast<double>(k + 1) / static_cast<double>(out.size() + 1);
      break;
    case LevelSpacing::area:
      equal_areas(parts, out, memory);
      break;
    case LevelSpacing::length:
      equal_widths(parts, out, memory);
      break;
  }
  for (double& level : out) level = (1 - level) * low + level * high;
}

}  // namespace hf_inner::field
