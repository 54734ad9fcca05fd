// Camera fit and z-buffer. Triangles are filled by edge functions (Pineda 1988) with perspective-correct barycentric
// coordinates; of two triangles at equal depth the first one drawn stays, so the result does not depend on anything
// but the order of the input. Cost: O(triangles + samples inside their bounding boxes).
#include "picture_raster.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace samples::raster {
namespace {

constexpr double infinity = 1e300;

dvec3 to_dvec(const Point& p) { return {p[0], p[1], p[2]}; }

bool finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// The points the camera must show: the corners of all triangles, all points where there are none, or the corners of the
// fixed box.
std::vector<dvec3> points_to_fit(const View& view, const std::vector<Layer>& layers) {
  std::vector<dvec3> points;
  if (view.fixed_box) {
    const dvec3 low = to_dvec(view.box.lower), high = to_dvec(view.box.upper);
    for (int i = 0; i < 8; ++i) {
      points.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    }
  } else {
    for (const Layer& layer : layers) {
      const std::vector<double>& p = layer.surface.positions;
      std::vector<char> shown(p.size() / 3, layer.surface.triangles.empty());
      for (const uint32_t v : layer.surface.triangles) shown[v] = 1;
      for (size_t v = 0; v < shown.size(); ++v)
        if (shown[v]) points.push_back({p[3 * v], p[3 * v + 1], p[3 * v + 2]});
    }
  }
  points.erase(std::remove_if(points.begin(), points.end(), [](const dvec3& p) { return !finite(p); }), points.end());
  if (points.empty()) throw std::runtime_error("render: nothing finite to look at; give positions or a fixed box");
  return points;
}

// Calls visit(x, y, w0, w1, w2) for every sample centre inside the page triangle; weights sum to one.
template <typename Visit>
void for_each_sample(int width, int height, const dvec3& a, const dvec3& b, const dvec3& c, Visit visit) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (area == 0 || !std::isfinite(area)) return;
  const double x_low = std::min({a.x, b.x, c.x}), x_high = std::max({a.x, b.x, c.x});
  const double y_low = std::min({a.y, b.y, c.y}), y_high = std::max({a.y, b.y, c.y});
  if (x_high < 0 || y_high < 0 || x_low > width || y_low > height) return;
  const int x0 = int(std::max(0.0, std::ceil(x_low - 0.5))), x1 = int(std::min(width - 1.0, std::floor(x_high - 0.5)));
  const int y0 = int(std::max(0.0, std::ceil(y_low - 0.5))), y1 = int(std::min(height - 1.0, std::floor(y_high - 0.5)));
  for (int y = y0; y <= y1; ++y) {
    const double py = y + 0.5;
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5;
      const double of_a = (b.x - px) * (c.y - py) - (b.y - py) * (c.x - px);
      const double of_b = (c.x - px) * (a.y - py) - (c.y - py) * (a.x - px);
      // most samples of the box lie outside: they need no division
      if (area > 0 ? of_a < 0 || of_b < 0 : of_a > 0 || of_b > 0) continue;
      const double w0 = of_a / area, w1 = of_b / area;
      const double w2 = 1 - w0 - w1;
      if (w0 >= 0 && w1 >= 0 && w2 >= 0) visit(x, y, w0, w1, w2);
    }
  }
}

void put_flat(SampleBuffer& buffer, int x, int y, double depth, const Color& color) {
  Sample& sample = buffer.at(x, y);
  if (depth <= sample.depth) return;
  sample.depth = depth;
  sample.layer = -2;
  sample.triangle = uint32_t(buffer.marks.size());
  buffer.marks.push_back({float(color.r), float(color.g), float(color.b)});
}

// A straight stroke with round ends between two page points.
void draw_stroke(SampleBuffer& buffer, const dvec3& a, const dvec3& b, double width, double bias, const Color& color) {
  const double radius = 0.5 * width;
  const double far = 4.0 * (buffer.width + buffer.height);
  for (const dvec3& end : {a, b}) {
    if (!finite(end) || std::abs(end.x) > far || std::abs(end.y) > far) return;
  }
  const int x0 = std::max(0, int(std::floor(std::min(a.x, b.x) - radius)));
  const int x1 = std::min(buffer.width - 1, int(std::ceil(std::max(a.x, b.x) + radius)));
  const int y0 = std::max(0, int(std::floor(std::min(a.y, b.y) - radius)));
  const int y1 = std::min(buffer.height - 1, int(std::ceil(std::max(a.y, b.y) + radius)));
  const dvec2 d{b.x - a.x, b.y - a.y};
  const double length2 = dot(d, d);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const dvec2 p{x + 0.5 - a.x, y + 0.5 - a.y};
      const double t = length2 > 0 ? std::clamp(dot(p, d) / length2, 0.0, 1.0) : 0.0;
      const dvec2 off = p - t * d;
      if (dot(off, off) <= radius * radius) put_flat(buffer, x, y, a.z + t * (b.z - a.z) + bias, color);
    }
  }
}

void draw_dot(SampleBuffer& buffer, const Camera& camera, const Dot& mark) {
  const dvec3 centre = camera.local(to_dvec(mark.position));
  const double w = camera.shrink(centre.z);
  if (!finite(centre) || w <= 0) return;
  const dvec3 page = camera.page(centre);
  const double world_radius = mark.radius * camera.diagonal, radius = world_radius * camera.scale / w;
  const int x0 = int(std::max(0.0, std::floor(page.x - radius)));
  const int x1 = int(std::min(buffer.width - 1.0, std::ceil(page.x + radius)));
  const int y0 = int(std::max(0.0, std::floor(page.y - radius)));
  const int y1 = int(std::min(buffer.height - 1.0, std::ceil(page.y + radius)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double nx = (x + 0.5 - page.x) / radius, ny = -(y + 0.5 - page.y) / radius;
      const double rest = 1 - nx * nx - ny * ny;
      if (rest < 0) continue;
      const double nz = std::sqrt(rest), depth = centre.z + nz * world_radius;
      Sample& sample = buffer.at(x, y);
      if (depth <= sample.depth) continue;
      sample.depth = depth;
      sample.layer = -3;
      sample.triangle = uint32_t(buffer.marks.size());
      buffer.marks.push_back(
          {float(mark.color.r), float(mark.color.g), float(mark.color.b), float(nx), float(ny), float(nz)});
    }
  }
}

void draw_arrow(SampleBuffer& buffer, const Camera& camera, const Arrow& arrow, double pixel, double bias) {
  const dvec3 from = camera.local(to_dvec(arrow.from)), to = camera.local(to_dvec(arrow.to));
  if (camera.shrink(from.z) <= 0 || camera.shrink(to.z) <= 0) return;
  const dvec3 a = camera.page(from), b = camera.page(to);
  const dvec2 d{b.x - a.x, b.y - a.y};
  const double length = glm::length(d), width = arrow.width * pixel;
  if (!(length > 0)) return;
  // the head: as long as four stroke widths, at most half the arrow
  const double head = std::min(4.5 * width, 0.5 * length);
  const dvec2 along = d / length, across{-along.y, along.x};
  const double t = 1 - head / length;
  const dvec3 neck{a.x + t * d.x, a.y + t * d.y, a.z + t * (b.z - a.z)};
  draw_stroke(buffer, a, neck, width, bias, arrow.color);
  const dvec3 left{neck.x + 0.45 * head * across.x, neck.y + 0.45 * head * across.y, neck.z};
  const dvec3 right{neck.x - 0.45 * head * across.x, neck.y - 0.45 * head * across.y, neck.z};
  for_each_sample(buffer.width, buffer.height, left, right, b, [&](int x, int y, double w0, double w1, double w2) {
    put_flat(buffer, x, y, w0 * left.z + w1 * right.z + w2 * b.z + bias, arrow.color);
  });
}

// Running mean of `radius` cells to each side along rows (stride 1) or columns.
void blur_lines(std::vector<float>& mask, int count, int length, size_t line_stride, size_t stride, int radius) {
  std::vector<float> line(static_cast<size_t>(length));
  for (int l = 0; l < count; ++l) {
    float* data = mask.data() + size_t(l) * line_stride;
    for (int i = 0; i < length; ++i) line[size_t(i)] = data[size_t(i) * stride];
    double sum = 0;
    for (int i = -radius; i < length; ++i) {
      if (i + radius < length) sum += line[size_t(i + radius)];
      if (i - radius - 1 >= 0) sum -= line[size_t(i - radius - 1)];
      if (i >= 0) data[size_t(i) * stride] = float(sum / (2 * radius + 1));
    }
  }
}

}  // namespace

Camera fit_camera(const View& view, const std::vector<Layer>& layers) {
  Camera camera;
  const dvec3 direction = to_dvec(view.direction), up = to_dvec(view.up);
  if (!finite(direction) || !finite(up) || length(direction) == 0 || length(cross(up, direction)) == 0) {
    throw std::runtime_error("render: View::direction and View::up must be finite, non-zero and not parallel");
  }
  camera.back = normalize(direction);
  camera.right = normalize(cross(up, camera.back));
  camera.up = cross(camera.back, camera.right);
  const std::vector<dvec3> points = points_to_fit(view, layers);
  dvec3 low(infinity), high(-infinity), world_low(infinity), world_high(-infinity);
  for (const dvec3& p : points) {
    const dvec3 q{dot(p, camera.right), dot(p, camera.up), dot(p, camera.back)};
    low = min(low, q);
    high = max(high, q);
    world_low = min(world_low, p);
    world_high = max(world_high, p);
  }
  const dvec3 centre = 0.5 * (low + high);
  camera.target = centre.x * camera.right + centre.y * camera.up + centre.z * camera.back;
  camera.diagonal = std::max(length(world_high - world_low), 1e-30);
  const int n = view.samples;
  camera.half_width = 0.5 * view.width * n;
  camera.half_height = 0.5 * view.height * n;
  const double room_x = camera.half_width * (1 - 2 * view.margin), room_y = camera.half_height * (1 - 2 * view.margin);
  if (view.perspective > 0) {
    const double slope_y =
        std::tan(0.5 * view.perspective * 3.14159265358979323846 / 180) * room_y / camera.half_height;
    const double slope_x = slope_y * room_x / room_y;
    for (const dvec3& p : points) {
      const dvec3 q = camera.local(p);
      camera.distance = std::max({camera.distance, q.z + std::abs(q.x) / slope_x, q.z + std::abs(q.y) / slope_y});
    }
    camera.distance = std::max(camera.distance, 1e-3 * camera.diagonal);
    camera.scale = room_y / (slope_y * camera.distance);
  } else {
    const double extent_x = std::max(0.5 * (high.x - low.x), 1e-12 * camera.diagonal);
    const double extent_y = std::max(0.5 * (high.y - low.y), 1e-12 * camera.diagonal);
    camera.scale = std::min(room_x / extent_x, room_y / extent_y);
  }
  return camera;
}

std::vector<dvec3> to_camera(const Camera& camera, const Surface& surface) {
  std::vector<dvec3> local(surface.positions.size() / 3);
  for (size_t i = 0; i < local.size(); ++i) {
    local[i] = camera.local({surface.positions[3 * i], surface.positions[3 * i + 1], surface.positions[3 * i + 2]});
  }
  return local;
}

void draw_triangles(SampleBuffer& buffer, const Camera& camera, const std::vector<dvec3>& local,
                    const std::vector<uint32_t>& triangles, int layer) {
  for (size_t t = 0; 3 * t < triangles.size(); ++t) {
    const dvec3 corner[3] = {local[triangles[3 * t]], local[triangles[3 * t + 1]], local[triangles[3 * t + 2]]};
    double w[3];
    dvec3 page[3];
    bool visible = true;
    for (int i = 0; i < 3; ++i) {
      w[i] = camera.shrink(corner[i].z);
      visible = visible && finite(corner[i]) && w[i] > 1e-6;
      if (visible) page[i] = camera.page(corner[i]);
    }
    if (!visible) continue;
    for_each_sample(buffer.width, buffer.height, page[0], page[1], page[2],
                    [&](int x, int y, double s0, double s1, double s2) {
                      const double c0 = s0 / w[0], c1 = s1 / w[1], c2 = s2 / w[2], sum = c0 + c1 + c2;
                      const double depth = (c0 * corner[0].z + c1 * corner[1].z + c2 * corner[2].z) / sum;
                      Sample& sample = buffer.at(x, y);
                      if (depth <= sample.depth) return;
                      sample.depth = depth;
                      sample.layer = layer;
                      sample.triangle = static_cast<uint32_t>(t);
                      sample.b1 = float(c1 / sum);
                      sample.b2 = float(c2 / sum);
                    });
  }
}

void draw_marks(SampleBuffer& buffer, const Camera& camera, const Marks& marks, double samples_per_pixel) {
  const double bias = 0.004 * camera.diagonal;
  for (const Polyline& line : marks.lines) {
    for (size_t i = 0; i + 1 < line.points.size(); ++i) {
      const dvec3 a = camera.local(to_dvec(line.points[i])), b = camera.local(to_dvec(line.points[i + 1]));
      if (camera.shrink(a.z) <= 0 || camera.shrink(b.z) <= 0) continue;
      draw_stroke(buffer, camera.page(a), camera.page(b), line.width * samples_per_pixel, bias, line.color);
    }
  }
  for (const Arrow& arrow : marks.arrows) draw_arrow(buffer, camera, arrow, samples_per_pixel, bias);
  for (const Dot& mark : marks.dots) draw_dot(buffer, camera, mark);
}

std::vector<float> ground_shadow(const Camera& camera, const View& view, const std::vector<Layer>& layers, int width,
                                 int height) {
  const dvec3 up = normalize(to_dvec(view.up));
  // light from above, a little from the camera's left, so that the shadow shows the pose
  const dvec3 light = normalize(up - 0.25 * camera.right * 0.6 + 0.12 * (camera.back - dot(camera.back, up) * up));
  const dvec3 fall = camera.local(camera.target - light);
  if (std::abs(dot(camera.back, up)) < 0.02) return {};
  std::vector<float> mask(size_t(width) * size_t(height), 0.0f);
  const double per_pixel = view.samples, sink = dot(light, up);
  for (const Layer& layer : layers) {
    std::vector<dvec3> page(layer.surface.positions.size() / 3);
    for (size_t i = 0; i < page.size(); ++i) {
      const double* p = &layer.surface.positions[3 * i];
      const dvec3 world{p[0], p[1], p[2]};
      const double rise = std::max(0.0, dot(world, up) - view.ground_height) / sink;
      const dvec3 on_ground = camera.local(world) + rise * fall;
      page[i] = camera.page(on_ground) / per_pixel;
      if (camera.shrink(on_ground.z) <= 1e-6) page[i].x = std::nan("");
    }
    const std::vector<uint32_t>& t = layer.surface.triangles;
    for (size_t i = 0; i < t.size(); i += 3) {
      for_each_sample(width, height, page[t[i]], page[t[i + 1]], page[t[i + 2]],
                      [&](int x, int y, double, double, double) { mask[size_t(y) * size_t(width) + size_t(x)] = 1; });
    }
  }
  // three running means make a smooth blur; flattened like the ground plane
  const double reach = 0.009 * camera.diagonal * camera.scale / per_pixel;
  const int radius_x = std::max(1, int(reach));
  const int radius_y = std::max(1, int(reach * std::abs(dot(camera.back, up))));
  for (int pass = 0; pass < 3; ++pass) {
    blur_lines(mask, height, width, size_t(width), 1, radius_x);
    blur_lines(mask, width, height, 1, size_t(width), radius_y);
  }
  return mask;
}

}  // namespace samples::raster
