#include "detail/detail_sheet.h"

#include <algorithm>
#include <cmath>

#include "gltf/flat_mesh.h"

namespace samples {

using namespace hf_gltf;
namespace {

Point point_of(const std::vector<float>& positions, size_t v) {
  return {static_cast<double>(positions[3 * v]), static_cast<double>(positions[3 * v + 1]),
          static_cast<double>(positions[3 * v + 2])};
}

// From the region outwards, a little from above and aside.
Point direction_of(const SheetScene& scene, const std::vector<uint8_t>& in) {
  Point sum{0, 0, 0};
  for (size_t t = 0; t < scene.triangles.size(); t += 3) {
    const uint32_t* v = &scene.triangles[t];
    if (!in[v[0]] && !in[v[1]] && !in[v[2]]) continue;
    const Point a = point_of(scene.surface, v[0]), b = point_of(scene.surface, v[1]), c = point_of(scene.surface, v[2]);
    for (size_t k = 0; k < 3; ++k) {
      const size_t l = (k + 1) % 3, m = (k + 2) % 3;
      sum[k] += (b[l] - a[l]) * (c[m] - a[m]) - (b[m] - a[m]) * (c[l] - a[l]);
    }
  }
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  // a rim's area vector points where the region looks; turned by some 50 degrees, detail is seen in profile
  const Point n = length > 0 ? Point{sum[0] / length, sum[1] / length, sum[2] / length} : Point{0, 0, 1};
  const Point side{n[2] + 0.3, 0.15, -n[0] + 0.3};
  return {n[0] + 1.2 * side[0], n[1] + 0.35 + 1.2 * side[1], n[2] + 1.2 * side[2]};
}

}  // namespace

void write_sheet(const std::string& file, const SheetScene& scene, const std::vector<SheetTile>& tiles,
                 const std::string& title) {
  // copies of a vertex at a seam are coloured alike
  std::vector<uint32_t> welded;
  std::vector<uint8_t> chosen(weld_positions(to_points(scene.surface), welded), 0), in(welded.size());
  for (const uint32_t v : scene.inside) chosen[welded[v]] = 1;
  for (size_t v = 0; v < in.size(); ++v) in[v] = chosen[welded[v]];
  View view;
  view.width = 520;
  view.height = 460;
  view.direction = direction_of(scene, in);
  view.fixed_box = true;
  bool empty = true;
  std::vector<double> region;
  for (const uint32_t v : scene.inside) {
    const Point p = point_of(scene.surface, v);
    region.insert(region.end(), p.begin(), p.end());
  }
  extend(view.box, empty, region);
  for (size_t k = 0; k < 3; ++k) {
    const double middle = (view.box.lower[k] + view.box.upper[k]) / 2;
    const double half = (view.box.upper[k] - view.box.lower[k]) / 2 * scene.zoom;
    view.box.lower[k] = middle - half;
    view.box.upper[k] = middle + half;
  }
  std::vector<Picture> pictures;
  std::vector<std::string> labels;
  for (const SheetTile& tile : tiles) {
    Surface surface = make_surface(tile.positions, scene.triangles);
    for (const uint8_t i : in) {
      const float plain[3] = {0.80f, 0.78f, 0.74f}, blue[3] = {0.52f, 0.66f, 0.80f};
      surface.colors.insert(surface.colors.end(), i ? blue : plain, (i ? blue : plain) + 3);
    }
    SurfaceLook look;
    look.fill = Fill::colors;
    Marks marks;
    if (pictures.empty())
      for (const uint32_t v : scene.points)
        marks.dots.push_back({point_of(tile.positions, v), 0.009, {0.86, 0.1, 0.1}});
    if (pictures.empty() && !scene.curve.empty()) {
      Polyline line;
      line.color = {0.86, 0.1, 0.1};
      line.width = 2;
      for (size_t i = 0; i <= scene.curve.size(); i += 3) {
        const double* p = &scene.curve[i % scene.curve.size()];
        line.points.push_back({p[0], p[1], p[2]});
      }
      marks.lines.push_back(std::move(line));
    }
    pictures.push_back(render(surface, view, look, marks));
    labels.push_back(tile.label);
  }
  write_png(file, contact_sheet(pictures, 3, labels, title));
}

}  // namespace samples
