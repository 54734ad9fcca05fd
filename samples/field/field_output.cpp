#include "field/field_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "gltf/file_name.h"
#include "gltf/file_write.h"
#include "gltf/flat_mesh.h"
#include "gltf/gltf_write.h"

namespace samples {

using namespace hf_gltf;
namespace {

struct Corner {
  glm::dvec3 position, normal;
  double value;
};

// The part of a convex polygon with value >= level (side > 0) or <= level (side < 0).
std::vector<Corner> clip(const std::vector<Corner>& polygon, double level, double side) {
  std::vector<Corner> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = side * (a.value - level), db = side * (b.value - level);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const double t = da / (da - db);
      kept.push_back({glm::mix(a.position, b.position, t), glm::mix(a.normal, b.normal, t), level});
    }
  }
  return kept;
}

// The surface cut along the levels; one colour (sRGB) per strip, hatched in grey where it has no value.
struct Strips {
  std::vector<glm::dvec3> positions, normals;
  std::vector<Color> colors;
  std::vector<uint32_t> triangles;
};

void add_part(const std::vector<Corner>& part, const Color& color, Strips& strips) {
  if (part.size() < 3) return;
  const uint32_t base = static_cast<uint32_t>(strips.positions.size());
  for (const Corner& corner : part) {
    strips.positions.push_back(corner.position);
    strips.normals.push_back(corner.normal);
    strips.colors.push_back(color);
  }
  for (uint32_t k = 2; k < part.size(); ++k)
    strips.triangles.insert(strips.triangles.end(), {base, base + k - 1, base + k});
}

std::vector<glm::vec3> normals_of(const SurfaceMesh& mesh) {
  return welded_normals(to_flat_mesh(mesh), mesh.positions);
}

double diagonal_of(const SurfaceMesh& mesh) {
  glm::dvec3 low(1e300), high(-1e300);
  for (const uint32_t v : mesh.triangles) {
    low = glm::min(low, mesh.positions[v]);
    high = glm::max(high, mesh.positions[v]);
  }
  return mesh.triangles.empty() ? 1 : glm::length(high - low);
}

// Cuts a triangle without a value into stripes of two greys. The stripes are slabs of space, so they go on over edges.
void hatch(std::vector<Corner> triangle, double width, Strips& strips) {
  const glm::dvec3 across = glm::normalize(glm::dvec3(1, 1, 0.6));
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (Corner& corner : triangle) {
    corner.value = glm::dot(corner.position, across) / width;
    low = std::min(low, corner.value);
    high = std::max(high, corner.value);
  }
  for (double stripe = std::floor(low); stripe < high || stripe == std::floor(low); ++stripe) {
    std::vector<Corner> part = triangle;
    if (stripe > low) part = clip(part, stripe, 1);
    if (stripe + 1 < high) part = clip(part, stripe + 1, -1);
    const double grey = std::fmod(std::abs(stripe), 2) == 0 ? 0.84 : 0.50;
    add_part(part, {grey, grey, grey}, strips);
  }
}

Strips cut_into_strips(const FieldView& view) {
  const SurfaceMesh& mesh = *view.mesh;
  const std::vector<glm::vec3> normals = normals_of(mesh);
  const std::vector<double>& levels = view.levels;
  // Stripes of this width can be told apart in a picture of 300 pixels.
  const double width = 0.012 * diagonal_of(mesh);
  Strips strips;
  for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    std::vector<Corner> triangle;
    bool whole = true;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t v = mesh.triangles[t + k];
      const double value = view.components == 1 ? view.values[v] : view.values[3 * size_t{v}];
      whole = whole && std::isfinite(value);
      triangle.push_back({mesh.positions[v], glm::dvec3(normals[v]), view.components == 1 ? value : 0});
    }
    if (!whole) {
      hatch(std::move(triangle), width, strips);
      continue;
    }
    const auto [a, b] = std::minmax({triangle[0].value, triangle[1].value, triangle[2].value});
    const auto first = static_cast<size_t>(std::upper_bound(levels.begin(), levels.end(), a) - levels.begin());
    const auto last = static_cast<size_t>(std::lower_bound(levels.begin(), levels.end(), b) - levels.begin());
    for (size_t strip = first; strip <= std::max(first, last); ++strip) {
      std::vector<Corner> part = triangle;
      if (strip > first) part = clip(part, levels[strip - 1], 1);
      if (strip < last) part = clip(part, levels[strip], -1);
      Color color{0.86, 0.82, 0.74};
      if (view.components == 1) {
        color = palette_color(Palette::blue_yellow,
                              (static_cast<double>(strip) + 0.5) / static_cast<double>(levels.size() + 1));
        const double shade = strip % 2 ? 1.0 : 0.87;  // every other strip a little darker
        color = {shade * color.r, shade * color.g, shade * color.b};
      }
      add_part(part, color, strips);
    }
  }
  return strips;
}

// A place for an arrow: a point in a triangle.
struct Spot {
  uint32_t corner[3];
  double weight[3];
};

glm::dvec3 at(const SurfaceMesh& mesh, const Spot& spot) {
  glm::dvec3 p(0);
  for (int k = 0; k < 3; ++k) p += spot.weight[k] * mesh.positions[spot.corner[k]];
  return p;
}

// Places at least `gap` apart, all over the surface: the middles of triangles, and lattices on those longer than the
// gap, kept when a grid of cells as wide as the gap knows of none near.
std::vector<Spot> spread_spots(const SurfaceMesh& mesh, double gap) {
  std::unordered_map<uint64_t, std::vector<glm::dvec3>> cells;
  const auto key = [&](const glm::dvec3& p, int dx, int dy, int dz) {
    const auto part = [&](double x, int d) {
      return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / gap)) + d) & 0x1FFFFF;
    };
    return part(p.x, dx) << 42 | part(p.y, dy) << 21 | part(p.z, dz);
  };
  std::vector<Spot> chosen;
  const auto offer = [&](const Spot& spot) {
    const glm::dvec3 p = at(mesh, spot);
    for (int d = 0; d < 27; ++d) {
      const auto cell = cells.find(key(p, d % 3 - 1, d / 3 % 3 - 1, d / 9 - 1));
      if (cell == cells.end()) continue;
      for (const glm::dvec3& q : cell->second) {
        if (glm::distance(p, q) < gap) return;
      }
    }
    cells[key(p, 0, 0, 0)].push_back(p);
    chosen.push_back(spot);
  };
  for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    const uint32_t* v = &mesh.triangles[t];
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, glm::distance(mesh.positions[v[k]], mesh.positions[v[(k + 1) % 3]]));
    const int n = std::min(100, std::max(1, static_cast<int>(std::ceil(longest / gap))));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const double a = (i + 1.0 / 3) / n, b = (j + 1.0 / 3) / n;
        offer({{v[0], v[1], v[2]}, {1 - a - b, a, b}});
      }
    }
  }
  return chosen;
}

// Arrows along the vectors, a little above the surface; the longest as long as the gap between them.
std::vector<Arrow> arrows_of(const FieldView& view) {
  const SurfaceMesh& mesh = *view.mesh;
  const std::vector<glm::vec3> normals = normals_of(mesh);
  const double diagonal = diagonal_of(mesh), gap = 0.028 * diagonal;
  const std::vector<Spot> spots = spread_spots(mesh, gap);
  std::vector<glm::dvec3> vectors;
  double longest = 0;
  for (const Spot& spot : spots) {
    glm::dvec3 sum(0);
    for (int k = 0; k < 3; ++k) {
      const double* v = &view.values[3 * size_t(spot.corner[k])];
      sum += spot.weight[k] * glm::dvec3(v[0], v[1], v[2]);
    }
    vectors.push_back(sum);
    longest = std::max(longest, glm::length(sum));
  }
  std::vector<Arrow> arrows;
  for (size_t i = 0; i < spots.size(); ++i) {
    const double length = glm::length(vectors[i]);
    if (!(length > 1e-9 * longest)) continue;
    glm::dvec3 normal(0);
    for (int k = 0; k < 3; ++k) normal += spots[i].weight[k] * glm::dvec3(normals[spots[i].corner[k]]);
    // square root: weak places still show where the field points
    const glm::dvec3 along = 0.95 * gap * std::sqrt(length / longest) / length * vectors[i];
    const glm::dvec3 from = at(mesh, spots[i]) + 0.006 * diagonal * normal - 0.5 * along, to = from + along;
    Arrow arrow;
    arrow.from = {from.x, from.y, from.z};
    arrow.to = {to.x, to.y, to.z};
    arrow.color = {0.08, 0.20, 0.55};
    arrow.width = 1.5;
    arrows.push_back(arrow);
  }
  return arrows;
}

float linear(double srgb) {
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

}  // namespace

void write_field_text(const std::string& file, const std::vector<double>& field, size_t components) {
  std::string text;
  text.reserve(field.size() * 24);
  char number[32];
  for (size_t i = 0; i < field.size(); ++i) {
    const int length = std::snprintf(number, sizeof number, "%.17g", field[i]);
    text.append(number, static_cast<size_t>(length)) += (i + 1) % components ? ' ' : '\n';
  }
  write_bytes(file_named(file), text);
}

void write_field_glb(const std::string& file, const FieldView& view) {
  const Strips strips = cut_into_strips(view);
  Primitive surface;
  const glm::dvec3 offset = node_offset(strips.positions);
  for (const glm::dvec3& p : strips.positions) surface.positions.push_back(glm::vec3(p - offset));
  for (const glm::dvec3& n : strips.normals) surface.normals.push_back(glm::vec3(n));
  for (const Color& c : strips.colors) surface.colors.push_back({linear(c.r), linear(c.g), linear(c.b), 1.0f});
  surface.indices = strips.triangles;
  Model model;
  model.name = file;
  Material material;
  material.name = "strips";
  material.metallic = 0;
  material.roughness = 0.9f;
  material.double_sided = true;
  surface.material = 0;
  model.materials.push_back(material);
  MeshData data;
  data.name = "field";
  data.primitives.push_back(std::move(surface));
  model.meshes.push_back(std::move(data));
  Node node;
  node.name = "field";
  node.mesh = 0;
  node.translation = offset;
  model.nodes.push_back(node);
  model.scene_roots = {0};
  std::vector<glm::dvec3> ends;
  for (const IsoLine& line : view.lines) {
    const size_t count = line.points.size();
    for (size_t i = 0; i + (line.closed ? 0 : 1) < count; ++i)
      ends.insert(ends.end(), {line.points[i], line.points[(i + 1) % count]});
  }
  if (!ends.empty()) add_lines(model, "iso-lines", ends, {0.02f, 0.02f, 0.03f, 1.0f});
  if (view.components == 3) {
    ends.clear();
    const auto point = [](const Point& p) { return glm::dvec3(p[0], p[1], p[2]); };
    for (const Arrow& arrow : arrows_of(view)) {
      // shaft and two barbs
      const glm::dvec3 from = point(arrow.from), to = point(arrow.to), along = to - from;
      const glm::dvec3 side = glm::length(glm::cross(along, glm::dvec3(0, 1, 0))) > 1e-6 * glm::length(along)
                                  ? glm::normalize(glm::cross(along, glm::dvec3(0, 1, 0)))
                                  : glm::dvec3(1, 0, 0);
      const glm::dvec3 wing = 0.15 * glm::length(along) * side, back = to - 0.3 * along;
      ends.insert(ends.end(), {from, to, to, back + wing, to, back - wing});
    }
    if (!ends.empty()) add_lines(model, "vectors", ends, {0.01f, 0.04f, 0.3f, 1.0f});
  }
  write_gltf(model, file_named(file));
}

Picture field_picture(const FieldView& view) {
  const Strips strips = cut_into_strips(view);
  Surface surface;
  for (const glm::dvec3& p : strips.positions) surface.positions.insert(surface.positions.end(), {p.x, p.y, p.z});
  for (const glm::dvec3& n : strips.normals) surface.normals.insert(surface.normals.end(), {n.x, n.y, n.z});
  for (const Color& c : strips.colors) {
    surface.colors.insert(surface.colors.end(),
                          {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)});
  }
  surface.triangles = strips.triangles;
  SurfaceLook look;
  look.fill = Fill::colors;
  Marks marks;
  for (const IsoLine& line : view.lines) {
    Polyline polyline;
    for (const glm::dvec3& p : line.points) polyline.points.push_back({p.x, p.y, p.z});
    if (line.closed && !line.points.empty()) polyline.points.push_back(polyline.points.front());
    polyline.width = 1.2;
    marks.lines.push_back(std::move(polyline));
  }
  const bool critical = !view.critical.empty() || !view.singular.empty();
  for (const glm::dvec3& p : view.sites) {
    Dot dot;
    dot.position = {p.x, p.y, p.z};
    if (critical) {
      dot.radius = 0.006;
      dot.color = {0.05, 0.05, 0.05};
    }
    marks.dots.push_back(dot);
  }
  for (const hf_critical_point& point : view.critical) {
    const glm::dvec3 p = view.mesh->positions[point.vertex];
    Dot dot;
    dot.position = {p.x, p.y, p.z};
    dot.radius = 0.010;
    dot.color = point.kind == HF_CRITICAL_MINIMUM   ? Color{0.10, 0.25, 0.90}
                : point.kind == HF_CRITICAL_MAXIMUM ? Color{0.88, 0.08, 0.08}
                                                    : Color{0.10, 0.75, 0.20};
    marks.dots.push_back(dot);
  }
  for (const hf_singularity& point : view.singular) {
    const glm::dvec3 p = view.mesh->positions[point.vertex];
    Dot dot;
    dot.position = {p.x, p.y, p.z};
    dot.color = point.index > 0 ? Color{0.88, 0.08, 0.08} : Color{0.10, 0.25, 0.90};
    marks.dots.push_back(dot);
  }
  if (view.components == 3) marks.arrows = arrows_of(view);
  View page;
  page.width = view.width;
  page.height = view.height;
  page.direction = view.direction;
  return render(surface, page, look, marks);
}

}  // namespace samples
