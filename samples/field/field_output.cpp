#include "field/field_output.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "common/gltf_write.h"
#include "common/picture.h"

namespace samples {
namespace {

struct Corner {
  glm::dvec3 position;
  double value;
};

// The part of a convex polygon with value >= level (side > 0) or <= level (side < 0).
std::vector<Corner> clip(const std::vector<Corner>& polygon, double level, double side) {
  std::vector<Corner> kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = side * (a.value - level), db = side * (b.value - level);
    if (da >= 0) kept.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0))
      kept.push_back({glm::mix(a.position, b.position, da / (da - db)), level});
  }
  return kept;
}

float linear(double srgb) {
  return static_cast<float>(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

}  // namespace

void write_field_text(const std::string& file, const std::vector<double>& field) {
  const std::string temporary = file + ".part";
  std::unique_ptr<FILE, int (*)(FILE*)> stream(std::fopen(temporary.c_str(), "w"), &std::fclose);
  if (!stream) throw std::runtime_error(file + ": cannot be written");
  for (const double value : field) {
    if (std::fprintf(stream.get(), "%.17g\n", value) < 0)
      throw std::runtime_error(file + ": cannot be written; is the disk full?");
  }
  if (std::fclose(stream.release()) != 0) throw std::runtime_error(file + ": cannot be written; is the disk full?");
  std::filesystem::rename(temporary, file);
}

void write_field_glb(const std::string& file, const SurfaceMesh& mesh, const std::vector<double>& field, int strips) {
  const auto [low, high] = std::minmax_element(field.begin(), field.end());
  const double range = std::max(*high - *low, 1e-300), width = range / strips;
  Primitive surface;
  for (size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
    std::vector<Corner> triangle;
    for (size_t k = 0; k < 3; ++k)
      triangle.push_back({mesh.positions[mesh.triangles[t + k]], field[mesh.triangles[t + k]]});
    const auto [a, b] = std::minmax_element(triangle.begin(), triangle.end(),
                                            [](const Corner& x, const Corner& y) { return x.value < y.value; });
    const auto strip_of = [&](double value) {
      return std::clamp(static_cast<int>(std::floor((value - *low) / width)), 0, strips - 1);
    };
    const int first = strip_of(a->value), last = strip_of(b->value);
    const glm::dvec3 cross =
        glm::cross(triangle[1].position - triangle[0].position, triangle[2].position - triangle[0].position);
    const glm::vec3 normal = glm::length(cross) > 0 ? glm::vec3(glm::normalize(cross)) : glm::vec3(0, 1, 0);
    for (int strip = first; strip <= last; ++strip) {
      std::vector<Corner> part = triangle;
      if (strip > first) part = clip(part, *low + strip * width, 1);
      if (strip < last) part = clip(part, *low + (strip + 1) * width, -1);
      if (part.size() < 3) continue;
      const Color color = palette_color(Palette::blue_yellow, (strip + 0.5) / strips);
      const uint32_t base = static_cast<uint32_t>(surface.positions.size());
      for (const Corner& corner : part) {
        surface.positions.push_back(glm::vec3(corner.position));
        surface.normals.push_back(normal);
        surface.colors.push_back({linear(color.r), linear(color.g), linear(color.b), 1.0f});
      }
      for (uint32_t k = 2; k < part.size(); ++k)
        surface.indices.insert(surface.indices.end(), {base, base + k - 1, base + k});
    }
  }
  Model model;
  model.name = file;
  Material material;
  material.name = "strips", material.metallic = 0, material.roughness = 0.9f, material.double_sided = true;
  surface.material = 0;
  model.materials.push_back(material);
  MeshData data;
  data.name = "field";
  data.primitives.push_back(std::move(surface));
  model.meshes.push_back(std::move(data));
  Node node;
  node.name = "field", node.mesh = 0;
  model.nodes.push_back(node);
  model.scene_roots = {0};
  write_gltf(model, file);
}

void write_field_picture(const std::string& file, const SurfaceMesh& mesh, const std::vector<double>& field, int strips,
                         const std::vector<glm::dvec3>& sites, const std::array<double, 3>& direction) {
  Surface surface;
  for (const glm::dvec3& p : mesh.positions) surface.positions.insert(surface.positions.end(), {p.x, p.y, p.z});
  surface.triangles = mesh.triangles;
  surface.scalars = field;
  SurfaceLook look;
  look.fill = Fill::iso_strips, look.strips = strips;
  Marks marks;
  for (const glm::dvec3& p : sites) marks.dots.push_back({{p.x, p.y, p.z}});
  View view;
  view.width = 900, view.height = 760, view.direction = direction;
  write_png(file, render(surface, view, look, marks));
}

}  // namespace samples
