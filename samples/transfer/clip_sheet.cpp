// See clip_sheet.h.
#include "transfer/clip_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/picture.h"
#include "gltf/file_name.h"
#include "transfer/texture_colors.h"

namespace samples {

using namespace hf_gltf;
namespace {

constexpr int columns = 6;  // frames beside the rest pose

// The coat: vertex colours times the material's colour and texture, as a display shows them.
std::vector<float> colours_of(const Model& model, const FlatMesh& mesh) {
  std::vector<float> out;
  TextureColors textures(model);
  for (const FlatPart& part : mesh.parts) {
    const Primitive& primitive =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    const int material = primitive.material;
    const std::vector<glm::vec3> texture = textures.of(primitive);
    const glm::vec4 base = material >= 0 && static_cast<size_t>(material) < model.materials.size()
                               ? model.materials[static_cast<size_t>(material)].base_color
                               : glm::vec4(0.6f);
    for (uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      for (int c = 0; c < 3; ++c) {
        const float vertex = mesh.colors.empty() ? 1.0f : mesh.colors[v][c];
        const float sampled = texture[v - part.first_vertex][c];
        out.push_back(std::pow(std::clamp(base[c] * vertex * sampled, 0.02f, 1.0f), 1 / 2.2f));
      }
    }
  }
  return out;
}

struct Row {
  const FlatMesh* mesh;
  std::vector<float> colours;
  Axes axes;
};

std::string short_name(const Model& model) { return file_named(model.name).stem().string(); }

Point point(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

void add_row(const Row& row, const glm::dvec3& from, const std::vector<std::vector<double>>& frames,
             std::vector<Picture>& tiles) {
  View view;
  view.width = 300;
  view.height = 250;
  view.direction = point(from);
  view.up = point(row.axes.up);
  view.fixed_box = true;
  view.ground = true;
  view.ground_height = 1e300;
  const std::vector<double> rest = double_positions(row.mesh->positions);
  for (size_t v = 0; v < row.mesh->positions.size(); ++v)
    if (!row.mesh->loose[v])
      view.ground_height = std::min(view.ground_height, glm::dot(row.mesh->positions[v], row.axes.up));
  std::vector<const std::vector<double>*> shown = {&rest};
  for (int k = 0; k < columns; ++k)
    shown.push_back(&frames[static_cast<size_t>(k) * (frames.size() - 1) / static_cast<size_t>(columns)]);
  bool empty = true;
  for (const std::vector<double>* positions : shown) extend(view.box, empty, *positions, row.mesh->triangles);
  SurfaceLook look;
  look.fill = Fill::colors;
  for (const std::vector<double>* positions : shown) {
    Surface surface = make_surface(*positions, row.mesh->triangles);
    surface.colors = row.colours;
    tiles.push_back(render(surface, view, look));
  }
}

// Tiles of one surface: its rest pose, then these frames.
void add_shapes(const Row& row, const std::vector<std::vector<double>>& frames, const std::vector<size_t>& chosen,
                std::vector<Picture>& tiles) {
  View view;
  view.width = 300;
  view.height = 300;
  view.direction = point(row.axes.forward + 0.12 * row.axes.up - 0.3 * row.axes.right);
  view.up = point(row.axes.up);
  view.fixed_box = true;
  std::vector<const std::vector<double>*> shown;
  const std::vector<double> rest = double_positions(row.mesh->positions);
  shown.push_back(&rest);
  for (const size_t f : chosen) shown.push_back(&frames[f]);
  bool empty = true;
  for (const std::vector<double>* positions : shown) extend(view.box, empty, *positions, row.mesh->triangles);
  SurfaceLook look;
  look.fill = Fill::colors;
  for (const std::vector<double>* positions : shown) {
    Surface surface = make_surface(*positions, row.mesh->triangles);
    surface.colors = row.colours;
    tiles.push_back(render(surface, view, look));
  }
}

}  // namespace

void write_shape_sheet(const std::filesystem::path& file, const Session& session, const Model& source,
                       const Model& target, const PlayedClip& shapes, const std::vector<std::string>& names) {
  const Row from{&session.source_flat(), colours_of(source, session.source_flat()), session.source_axes()};
  const Row to{&session.target_flat(), colours_of(target, session.target_flat()), session.target_axes()};
  const size_t count = shapes.target_frames.size(), shown = std::min<size_t>(count, columns);
  std::vector<size_t> chosen;
  for (size_t k = 0; k < shown; ++k) chosen.push_back(shown < 2 ? 0 : k * (count - 1) / (shown - 1));
  std::vector<Picture> tiles;
  std::vector<std::string> labels;
  add_shapes(from, shapes.source_frames, chosen, tiles);
  add_shapes(to, shapes.target_frames, chosen, tiles);
  for (const std::string& name : {short_name(source), short_name(target)}) {
    labels.push_back(name + ", rest");
    for (const size_t f : chosen) labels.push_back(names[f]);
  }
  write_png(file.string(), contact_sheet(tiles, static_cast<int>(shown) + 1, labels,
                                         "shapes of " + short_name(source) + " on " + short_name(target)));
}

void write_clip_sheet(const std::filesystem::path& file, const SheetBody& source, const SheetBody& target,
                      const std::vector<PlayedClip>& clips) {
  std::vector<Picture> tiles;
  std::vector<std::string> labels;
  for (const PlayedClip& clip : clips) {
    for (const SheetBody* body : {&source, &target}) {
      if (body->mesh.triangles.empty()) continue;
      const Row row{&body->mesh, colours_of(body->model, body->mesh), body->axes};
      const Axes& axes = body->axes;
      for (const bool side : {true, false}) {
        add_row(row, side ? axes.right + 0.22 * axes.up + 0.45 * axes.forward : axes.forward + 0.12 * axes.up,
                body == &source ? clip.source_frames : clip.target_frames, tiles);
        labels.push_back(short_name(body->model) + (side ? ", rest" : ", from the front"));
        for (int k = 0; k < columns; ++k) {
          char label[64];
          std::snprintf(
              label, sizeof label, "%.2f s",
              clip.clip.times[static_cast<size_t>(k) * (clip.clip.times.size() - 1) / static_cast<size_t>(columns)]);
          labels.emplace_back(label);
        }
      }
    }
  }
  std::string title = short_name(source.model) + " on " + short_name(target.model) + ":";
  for (const PlayedClip& clip : clips) title += " " + clip.clip.name;
  write_png(file.string(), contact_sheet(tiles, columns + 1, labels, title));
}

}  // namespace samples
