// Shading of the samples the rasteriser found, and their mean per pixel.
//
// Light: hemisphere ambient, a key light from the upper left of the camera, a weak fill light, a Blinn-Phong highlight,
// and screen-space occlusion (Mittring 2007: the share of neighbours in front of the tangent plane). Iso-strips take
// the scalar interpolated inside the triangle, so their borders are straight in a triangle and crisp at any zoom; the
// iso-line's width is kept in pixels by the scalar's gradient on the page.
#include "picture.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <unordered_map>

#include "picture_raster.h"

namespace samples {

using raster::Camera;
using raster::dvec2;
using raster::dvec3;
using raster::Sample;
using raster::SampleBuffer;

namespace {

constexpr double pi = 3.14159265358979323846;

dvec3 to_dvec(const Color& c) { return {c.r, c.g, c.b}; }
// Shading is done in linear light, display values are its square root-like encoding.
dvec3 to_linear(const dvec3& c) { return pow(max(c, dvec3(0)), dvec3(2.2)); }

double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

void check_surface(const Surface& s, const SurfaceLook& look, size_t layer) {
  const std::string where = "render: layer " + std::to_string(layer) + ": ";
  const size_t count = s.positions.size() / 3;
  if (s.positions.size() % 3 != 0 || s.triangles.size() % 3 != 0) {
    throw std::runtime_error(where + "positions and triangles must hold three numbers per element");
  }
  for (size_t i = 0; i < s.triangles.size(); ++i) {
    if (s.triangles[i] >= count) {
      throw std::runtime_error(where + "triangle " + std::to_string(i / 3) + " names vertex " +
                               std::to_string(s.triangles[i]) + " of " + std::to_string(count));
    }
  }
  if (!s.normals.empty() && s.normals.size() != 3 * count) throw std::runtime_error(where + "normals: wrong length");
  if (look.fill == Fill::colors && s.colors.size() != 3 * count) {
    throw std::runtime_error(where + "Fill::colors needs three colour components per vertex");
  }
  if ((look.fill == Fill::palette || look.fill == Fill::iso_strips) && s.scalars.size() != count) {
    throw std::runtime_error(where + "this fill needs one scalar per vertex");
  }
  if (look.fill == Fill::iso_strips && look.strips < 1) throw std::runtime_error(where + "strips must be positive");
}

// Angle-weighted vertex normals (Thurmer and Wuthrich 1998), shared between vertices at bit-equal positions.
std::vector<dvec3> vertex_normals(const Surface& s) {
  const size_t count = s.positions.size() / 3;
  std::vector<uint32_t> owner(count);
  struct Key {
    uint64_t x, y, z;
    bool operator==(const Key& o) const { return x == o.x && y == o.y && z == o.z; }
  };
  struct Hash {
    size_t operator()(const Key& k) const {
      uint64_t h = k.x * 0x9E3779B97F4A7C15ull;
      h = (h ^ (h >> 29) ^ k.y) * 0xBF58476D1CE4E5B9ull;
      h = (h ^ (h >> 32) ^ k.z) * 0x94D049BB133111EBull;
      return size_t(h ^ (h >> 31));
    }
  };
  std::unordered_map<Key, uint32_t, Hash> first;
  first.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    Key key;
    std::memcpy(&key, &s.positions[3 * i], sizeof key);
    owner[i] = first.emplace(key, static_cast<uint32_t>(i)).first->second;
  }
  std::vector<dvec3> normals(count, dvec3(0));
  const auto at = [&](uint32_t v) { return dvec3(s.positions[3 * v], s.positions[3 * v + 1], s.positions[3 * v + 2]); };
  for (size_t t = 0; t < s.triangles.size(); t += 3) {
    const dvec3 p[3] = {at(s.triangles[t]), at(s.triangles[t + 1]), at(s.triangles[t + 2])};
    const dvec3 area = cross(p[1] - p[0], p[2] - p[0]);
    const double size = length(area);
    if (!(size > 0)) continue;
    for (size_t i = 0; i < 3; ++i) {
      const dvec3 a = p[(i + 1) % 3] - p[i], b = p[(i + 2) % 3] - p[i];
      const double angle = std::atan2(length(cross(a, b)), dot(a, b));
      normals[owner[s.triangles[t + i]]] += angle / size * area;
    }
  }
  for (size_t i = 0; i < count; ++i) normals[i] = normals[owner[i]];
  return normals;
}

// One layer with what shading needs at hand.
struct ShadedLayer {
  const Surface* surface;
  const SurfaceLook* look;
  std::vector<dvec3> local;    // positions, camera coordinates
  std::vector<dvec3> page;     // positions, samples
  std::vector<dvec3> normals;  // camera coordinates
  dvec3 plain{0};              // the look's colour, linear
  double low = 0, high = 1;
};

ShadedLayer prepare(const Layer& layer, const Camera& camera) {
  ShadedLayer result;
  const Surface& s = layer.surface;
  result.surface = &s;
  result.look = &layer.look;
  result.plain = to_linear(to_dvec(layer.look.color));
  result.local = raster::to_camera(camera, s);
  result.page.reserve(result.local.size());
  for (const dvec3& q : result.local) result.page.push_back(camera.page(q));
  if (!layer.look.flat) {
    if (s.normals.empty()) {
      result.normals = vertex_normals(s);
    } else {
      for (size_t i = 0; i < s.normals.size(); i += 3) {
        result.normals.push_back({s.normals[i], s.normals[i + 1], s.normals[i + 2]});
      }
    }
    for (dvec3& n : result.normals) n = {dot(n, camera.right), dot(n, camera.up), dot(n, camera.back)};
  }
  result.low = layer.look.scalar_low;
  result.high = layer.look.scalar_high;
  if (result.low == result.high) {
    bool first = true;
    for (double value : s.scalars) {
      if (!std::isfinite(value)) continue;
      result.low = first ? value : std::min(result.low, value);
      result.high = first ? value : std::max(result.high, value);
      first = false;
    }
    if (result.low == result.high) result.high = result.low + 1;
  }
  return result;
}

// Barycentric gradients on the page, for line widths in samples.
struct PageGradient {
  dvec2 d0{0}, d1{0}, d2{0};
};

PageGradient page_gradient(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  PageGradient g;
  if (area == 0) return g;
  g.d0 = dvec2(b.y - c.y, c.x - b.x) / area;
  g.d1 = dvec2(c.y - a.y, a.x - c.x) / area;
  g.d2 = dvec2(a.y - b.y, b.x - a.x) / area;
  return g;
}

// Display colour of the strips at one sample.
dvec3 strip_color(const ShadedLayer& layer, double scalar, double page_slope, double samples_per_pixel) {
  const SurfaceLook& look = *layer.look;
  const double t = (scalar - layer.low) / (layer.high - layer.low);
  const double position = t * look.strips, strip = std::clamp(std::floor(position), 0.0, look.strips - 1.0);
  dvec3 color = to_dvec(palette_color(look.palette, (strip + 0.5) / look.strips));
  // every other strip a little darker
  if (static_cast<int>(strip) % 2 == 0) color *= 0.87;
  if (look.iso_lines && page_slope > 0) {
    const double slope = page_slope * look.strips / (layer.high - layer.low);  // strips per sample
    const double nearest = std::round(position);
    if (nearest > 0.5 && nearest < look.strips - 0.5) {
      const double pixels = std::abs(position - nearest) / (slope * samples_per_pixel);
      const double crowd = 1 - smooth_step(0.18, 0.40, slope * samples_per_pixel);
      color = mix(color, 0.25 * color, 0.85 * crowd * (1 - smooth_step(0.35, 0.75, pixels)));
    }
  }
  return color;
}

dvec3 stripe_color(const dvec3& n, int count) {
  // reflect the viewing ray (0,0,-1) and look up a room with horizontal stripes
  const dvec3 r = 2 * n.z * n - dvec3(0, 0, 1);
  const double height = std::asin(std::clamp(r.y, -1.0, 1.0)) / pi + 0.5;
  const double wave = std::sin(2 * pi * count * height);
  return mix(dvec3(0.10, 0.11, 0.14), dvec3(0.96), smooth_step(-0.12, 0.12, wave));
}

double wire_cover(const SurfaceLook& look, const Sample& sample, const PageGradient& g, double samples_per_pixel) {
  const double b[3] = {1.0 - double(sample.b1) - double(sample.b2), double(sample.b1), double(sample.b2)};
  const dvec2* d[3] = {&g.d0, &g.d1, &g.d2};
  double nearest = 1e30, height = 1e30;
  for (int i = 0; i < 3; ++i) {
    const double slope = length(*d[i]) * samples_per_pixel;
    if (!(slope > 0)) continue;
    nearest = std::min(nearest, std::max(b[i], 0.0) / slope);
    height = std::min(height, 1 / slope);
  }
  const double half = 0.5 * look.wire_width;
  // triangles smaller than a few pixels would turn black
  return (1 - smooth_step(0.6 * half, 1.6 * half, nearest)) * (0.15 + 0.7 * smooth_step(1.5, 7.0, height));
}

// Linear light leaving a surface of linear colour `albedo` with camera-space normal n.
dvec3 light_surface(const dvec3& albedo, const dvec3& n, double shininess, double open) {
  static const dvec3 key = normalize(dvec3(-0.42, 0.66, 0.62)), fill = normalize(dvec3(0.75, 0.05, 0.45));
  const double sky = 0.5 + 0.5 * n.y;
  const dvec3 ambient = mix(dvec3(0.20, 0.185, 0.17), dvec3(0.40, 0.43, 0.47), sky) * open;
  const double lambert = std::max(0.0, dot(n, key)), second = std::max(0.0, dot(n, fill));
  const dvec3 half = normalize(key + dvec3(0, 0, 1));
  const double gloss = std::max(0.0, dot(n, half)), edge = 1 - std::clamp(n.z, 0.0, 1.0);
  const double gloss4 = gloss * gloss * gloss * gloss, gloss12 = gloss4 * gloss4 * gloss4;
  const double highlight = shininess * gloss12 * gloss12 * gloss12;
  const double rim = 0.10 * edge * edge * edge * sky;
  const double kept = 0.45 + 0.55 * open;
  return albedo * (ambient + kept * (0.74 * lambert * dvec3(1.0, 0.98, 0.94) + 0.13 * second * dvec3(0.9, 0.95, 1.0))) +
         dvec3(highlight * kept + rim * 0.5);
}

dvec3 shade_sample(const ShadedLayer& layer, const Sample& sample, double open, double samples_per_pixel) {
  const Surface& s = *layer.surface;
  const SurfaceLook& look = *layer.look;
  const uint32_t v[3] = {s.triangles[3 * size_t(sample.triangle)], s.triangles[3 * size_t(sample.triangle) + 1],
                         s.triangles[3 * size_t(sample.triangle) + 2]};
  const double b1 = double(sample.b1), b2 = double(sample.b2), b0 = 1 - b1 - b2;
  const dvec3 face = cross(layer.local[v[1]] - layer.local[v[0]], layer.local[v[2]] - layer.local[v[0]]);
  dvec3 n = face;
  if (!look.flat) n = b0 * layer.normals[v[0]] + b1 * layer.normals[v[1]] + b2 * layer.normals[v[2]];
  if (!(dot(n, n) > 0)) n = dot(face, face) > 0 ? face : dvec3(0, 0, 1);
  n = normalize(n);
  const PageGradient gradient = page_gradient(layer.page[v[0]], layer.page[v[1]], layer.page[v[2]]);
  // page y points down, so a triangle that faces the camera has negative page area
  const dvec3& pa = layer.page[v[0]];
  const dvec3& pb = layer.page[v[1]];
  const dvec3& pc = layer.page[v[2]];
  const bool back_side = (pb.x - pa.x) * (pc.y - pa.y) - (pb.y - pa.y) * (pc.x - pa.x) > 0;
  if (back_side) n = -n;
  if (n.z < 0.02 && !look.flat) n = normalize(dvec3(n.x, n.y, 0.02));

  dvec3 color = to_dvec(look.color);
  if (look.fill == Fill::colors) {
    const auto at = [&](uint32_t i) { return dvec3(s.colors[3 * i], s.colors[3 * i + 1], s.colors[3 * i + 2]); };
    color = b0 * at(v[0]) + b1 * at(v[1]) + b2 * at(v[2]);
  } else if (look.fill == Fill::palette || look.fill == Fill::iso_strips) {
    const double scalar = b0 * s.scalars[v[0]] + b1 * s.scalars[v[1]] + b2 * s.scalars[v[2]];
    if (!std::isfinite(scalar)) {
      color = dvec3(0.55);
    } else if (look.fill == Fill::palette) {
      color = to_dvec(palette_color(look.palette, (scalar - layer.low) / (layer.high - layer.low)));
    } else {
      const dvec2 slope = s.scalars[v[0]] * gradient.d0 + s.scalars[v[1]] * gradient.d1 + s.scalars[v[2]] * gradient.d2;
      color = strip_color(layer, scalar, length(slope), samples_per_pixel);
    }
  } else if (look.fill == Fill::stripes) {
    color = stripe_color(n, look.stripe_count);
  }
  if (back_side) color = mix(color, dvec3(0.55, 0.30, 0.28), 0.6);
  if (look.wireframe) {
    color = mix(color, to_dvec(look.wire_color), wire_cover(look, sample, gradient, samples_per_pixel));
  }
  const bool plain = look.fill == Fill::plain && !back_side && !look.wireframe;
  return light_surface(plain ? layer.plain : to_linear(color), n, back_side ? 0.0 : look.shininess, open);
}

// Share of light that reaches each pixel's nearest surface, 1 = open. Taps lie on a fixed sunflower pattern.
std::vector<float> occlusion(const SampleBuffer& buffer, const Camera& camera, const View& view) {
  const int n = view.samples, width = view.width, height = view.height;
  std::vector<float> open(size_t(width) * size_t(height), 1.0f);
  if (view.occlusion <= 0) return open;
  constexpr int taps = 32;
  const double reach = 0.045 * camera.diagonal;
  dvec2 pattern[taps];
  double spread[taps];
  for (int i = 0; i < taps; ++i) {
    const double radius = (i + 0.5) / taps, angle = 2.399963229728653 * i;
    pattern[i] = radius * dvec2(std::cos(angle), std::sin(angle));
    spread[i] = reach * length(pattern[i]);
  }
  const auto depth_at = [&](double x, double y) {
    if (x < 0 || y < 0 || x >= buffer.width || y >= buffer.height) return -1e300;
    return buffer.at(int(x), int(y)).depth;
  };
  std::vector<float> raw(open.size(), 1.0f);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double cx = (x + 0.5) * n, cy = (y + 0.5) * n;
      const double here = depth_at(cx, cy);
      if (here < -1e200) continue;
      const double samples = reach * camera.scale / camera.shrink(here);
      double blocked = 0, weight = 0;
      for (int i = 0; i < taps; i += 1) {
        // opposite taps together: a plane, however steep, is not occluded
        const dvec2 d = samples * pattern[i];
        const double one = depth_at(cx + d.x, cy + d.y), two = depth_at(cx - d.x, cy - d.y);
        weight += 1;
        if (one < -1e200 && two < -1e200) continue;
        const double rise_one = one < -1e200 ? -reach : std::clamp(one - here, -reach, reach);
        const double rise_two = two < -1e200 ? -reach : std::clamp(two - here, -reach, reach);
        const double far_one = one - here > 2 * reach ? 0 : 1, far_two = two - here > 2 * reach ? 0 : 1;
        const double bend = 0.5 * (rise_one + rise_two) * far_one * far_two;
        if (bend > 0) blocked += std::min(bend / spread[i], 1.0);
      }
      raw[size_t(y) * size_t(width) + size_t(x)] = float(1 - view.occlusion * std::min(1.0, 1.6 * blocked / weight));
    }
  }
  // a small blur that stays on the same surface hides the pattern
  const double same = 0.02 * camera.diagonal;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double here = depth_at((x + 0.5) * n, (y + 0.5) * n);
      if (here < -1e200) continue;
      double sum = 0, weight = 0;
      for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
          const int px = x + dx, py = y + dy;
          if (px < 0 || py < 0 || px >= width || py >= height) continue;
          if (std::abs(depth_at((px + 0.5) * n, (py + 0.5) * n) - here) > same) continue;
          sum += double(raw[size_t(py) * size_t(width) + size_t(px)]);
          weight += 1;
        }
      }
      open[size_t(y) * size_t(width) + size_t(x)] = float(sum / weight);
    }
  }
  return open;
}

// Background display colour with shadow and the ground's line.
dvec3 background(const View& view, const std::vector<float>& shadow, double ground_row, int x, int y) {
  const double t = (y + 0.5) / view.height;
  dvec3 color = mix(to_dvec(view.background_top), to_dvec(view.background_bottom), t * t);
  if (!view.ground) return color;
  if (!shadow.empty()) {
    color *= 1 - 0.34 * double(shadow[size_t(y) * size_t(view.width) + size_t(x)]);
  } else {
    const double off = std::abs(y + 0.5 - ground_row);
    color *= 1 - 0.45 * (1 - smooth_step(0.4, 1.1, off));
    if (y + 0.5 > ground_row) color *= 0.96;
  }
  return color;
}

void check_view(const View& view) {
  if (view.width < 1 || view.height < 1 || view.width > 16384 || view.height > 16384) {
    throw std::runtime_error("render: View::width and height must be between 1 and 16384");
  }
  if (view.samples < 1 || view.samples > 8) throw std::runtime_error("render: View::samples must be between 1 and 8");
  if (!(view.margin >= 0 && view.margin < 0.5)) throw std::runtime_error("render: View::margin must be in [0, 0.5)");
  if (!(view.perspective >= 0 && view.perspective < 150)) {
    throw std::runtime_error("render: View::perspective must be in [0, 150) degrees");
  }
}

void extend(Box& box, bool& empty, const double* point) {
  for (size_t k = 0; k < 3; ++k) {
    box.lower[k] = empty ? point[k] : std::min(box.lower[k], point[k]);
    box.upper[k] = empty ? point[k] : std::max(box.upper[k], point[k]);
  }
  empty = false;
}

}  // namespace

void extend(Box& box, bool& empty, const std::vector<double>& positions) {
  for (size_t i = 0; i + 2 < positions.size(); i += 3) extend(box, empty, &positions[i]);
}

void extend(Box& box, bool& empty, const std::vector<double>& positions, const std::vector<uint32_t>& triangles) {
  for (const uint32_t v : triangles) extend(box, empty, &positions[3 * size_t{v}]);
}

Color palette_color(Palette palette, double t) {
  // display colours at equal steps, linear in between
  static const Color blue_yellow[] = {{0.11, 0.18, 0.47}, {0.13, 0.34, 0.63}, {0.12, 0.52, 0.66}, {0.26, 0.68, 0.60},
                                      {0.53, 0.79, 0.46}, {0.80, 0.86, 0.33}, {0.98, 0.90, 0.25}};
  static const Color blue_white_red[] = {
      {0.16, 0.30, 0.66}, {0.45, 0.62, 0.86}, {0.93, 0.93, 0.93}, {0.90, 0.53, 0.42}, {0.70, 0.11, 0.15}};
  const bool sequential = palette == Palette::blue_yellow;
  const Color* stops = sequential ? blue_yellow : blue_white_red;
  const int last = sequential ? 6 : 4;
  const double position = std::clamp(std::isfinite(t) ? t : 0.0, 0.0, 1.0) * last;
  const int i = std::min(static_cast<int>(position), last - 1);
  const double f = position - i;
  const Color &a = stops[i], &b = stops[i + 1];
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)};
}

Picture render(const std::vector<Layer>& layers, const View& view) {
  check_view(view);
  for (size_t i = 0; i < layers.size(); ++i) check_surface(layers[i].surface, layers[i].look, i);
  const Camera camera = raster::fit_camera(view, layers);
  const int n = view.samples;
  SampleBuffer buffer;
  buffer.width = view.width * n;
  buffer.height = view.height * n;
  buffer.samples.resize(size_t(buffer.width) * size_t(buffer.height));
  std::vector<ShadedLayer> shaded;
  for (size_t i = 0; i < layers.size(); ++i) {
    shaded.push_back(prepare(layers[i], camera));
    raster::draw_triangles(buffer, camera, shaded[i].local, layers[i].surface.triangles, static_cast<int>(i));
  }
  const std::vector<float> open = occlusion(buffer, camera, view);
  for (const Layer& layer : layers) raster::draw_marks(buffer, camera, layer.marks, n);
  std::vector<float> shadow;
  double ground_row = 0;
  if (view.ground) {
    shadow = raster::ground_shadow(camera, view, layers, view.width, view.height);
    const dvec3 up = normalize(dvec3(view.up[0], view.up[1], view.up[2]));
    const dvec3 foot = camera.target + (view.ground_height - dot(camera.target, up)) * up;
    ground_row = camera.page(camera.local(foot)).y / n;
  }
  Picture picture;
  picture.width = view.width;
  picture.height = view.height;
  picture.rgb.resize(3 * size_t(view.width) * size_t(view.height));
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const size_t pixel = size_t(y) * size_t(view.width) + size_t(x);
      const dvec3 shown_back = background(view, shadow, ground_row, x, y);
      const auto put = [&](const dvec3& display) {
        for (int k = 0; k < 3; ++k) picture.rgb[3 * pixel + size_t(k)] = static_cast<uint8_t>(display[k] * 255.0 + 0.5);
      };
      bool drawn = false;
      for (int j = 0; j < n && !drawn; ++j) {
        for (int i = 0; i < n; ++i) drawn |= buffer.at(x * n + i, y * n + j).layer != -1;
      }
      if (!drawn) {
        put(min(max(shown_back, dvec3(0)), dvec3(1)));
        continue;
      }
      const dvec3 back = to_linear(shown_back);
      dvec3 sum(0);
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          const Sample& sample = buffer.at(x * n + i, y * n + j);
          if (sample.layer >= 0) {
            sum += shade_sample(shaded[size_t(sample.layer)], sample, double(open[pixel]), n);
          } else if (sample.layer == -1) {
            sum += back;
          } else {
            const raster::Mark& mark = buffer.marks[sample.triangle];
            const dvec3 color = to_linear({double(mark.r), double(mark.g), double(mark.b)});
            const dvec3 normal{double(mark.nx), double(mark.ny), double(mark.nz)};
            sum += sample.layer == -2 ? color : light_surface(color * 1.15, normal, 0.5, 1.0);
          }
        }
      }
      put(pow(min(max(sum / double(n * n), dvec3(0)), dvec3(1)), dvec3(1 / 2.2)));
    }
  }
  return picture;
}

Picture render(const Surface& surface, const View& view, const SurfaceLook& look, const Marks& marks) {
  return render(std::vector<Layer>{{surface, look, marks}}, view);
}

}  // namespace samples
