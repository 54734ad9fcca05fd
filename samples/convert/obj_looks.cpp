// See obj_looks.h.
#include "convert/obj_looks.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <stdexcept>

#include "common/mesh_file_parts.h"
#include "gltf/file_bytes.h"
#include "gltf/file_write.h"
#include "gltf/json_file.h"

namespace samples {
namespace {

// Bytes of all images of one .obj, as the reader of glTF allows.
constexpr uint64_t image_bytes = 128ull << 20;

class LooksReader {
 public:
  LooksReader(const std::filesystem::path& file, SurfaceMesh& mesh, bool png_or_jpeg)
      : file_(file), mesh_(mesh), png_or_jpeg_(png_or_jpeg) {
    for (const std::string& name : mesh.corners.material_names) {
      numbers_.emplace(name, static_cast<int>(looks_.materials.size()));
      looks_.materials.emplace_back();
      looks_.materials.back().name = as_utf8(name);
      looks_.materials.back().metallic = 0;
    }
    looks_.images_of.assign(looks_.materials.size(), -1);
    found_.assign(looks_.materials.size(), 0);
  }

  PlainLooks run() {
    if (looks_.materials.empty()) return {};
    for (const std::string& library : mesh_.corners.libraries) read_libraries(library);
    const auto missing = std::count(found_.begin(), found_.end(), 0);
    if (missing > 0) warn("materials that no .mtl file describes: " + std::to_string(missing));
    for (size_t m = 0; m < looks_.materials.size(); ++m) {
      // exporters that leave the colour to the image write a Kd of zero
      glm::vec4& color = looks_.materials[m].base_color;
      if (looks_.images_of[m] >= 0 && glm::vec3(color) == glm::vec3(0)) color = glm::vec4(1, 1, 1, color.a);
    }
    return std::move(looks_);
  }

 private:
  void warn(const std::string& message) {
    if (mesh_.warnings.size() < 100) mesh_.warnings.push_back(message);
  }

  // One name with blanks, or several names.
  void read_libraries(const std::string& names) {
    std::string reason;
    if (!resolve_below(file_, names, reason).empty()) return read_library(names);
    TextCursor words(reinterpret_cast<const uint8_t*>(names.data()), names.size(), "mtllib", 0);
    for (std::string_view word; !(word = words.token()).empty();) read_library(std::string(word));
  }

  void read_library(const std::string& name) {
    std::string reason;
    const std::filesystem::path library = resolve_below(file_, name, reason);
    if (library.empty()) return warn(printable(name.substr(0, 120)) + " is not read: " + reason);
    const std::vector<uint8_t> bytes = read_bytes(library, MeshLimits().max_file_bytes);
    TextCursor in(bytes.data(), bytes.size(), library.string(), '#');
    int material = -1;
    while (in.next_line()) {
      const std::string_view key = in.token_on_line();
      if (key == "newmtl") {
        const auto at = numbers_.find(std::string(in.rest_of_line()));
        material = at == numbers_.end() ? -1 : at->second;
        if (material >= 0) found_[static_cast<size_t>(material)] = 1;
      } else if (material >= 0) {
        read_line(in, std::string(key), library, static_cast<size_t>(material));
      }
      in.skip_line();
    }
  }

  void read_line(TextCursor& in, const std::string& key, const std::filesystem::path& library, size_t m) {
    Material& to = looks_.materials[m];
    const auto share = [&](float& value) {
      double number = 0;
      const std::string_view word = in.token_on_line();
      if (parse_double(word, number) && number >= 0) value = static_cast<float>(std::min(number, 1.0));
      return !word.empty();
    };
    if (key == "Kd") {
      if (share(to.base_color.r) && !(share(to.base_color.g) && share(to.base_color.b)))
        to.base_color.g = to.base_color.b = to.base_color.r;  // one number is a grey
    } else if (key == "d") {
      share(to.base_color.a);
    } else if (key == "Tr") {
      float clear = 1 - to.base_color.a;
      share(clear);
      to.base_color.a = 1 - clear;
    } else if (key == "Pr") {
      share(to.roughness);
    } else if (key == "Pm") {
      share(to.metallic);
    } else if (key == "map_Kd") {
      read_image(std::string(in.rest_of_line()), library, m);
    }
  }

  void read_image(std::string name, const std::filesystem::path& library, size_t m) {
    if (!name.empty() && name[0] == '-') {  // options stand before the name
      warn("the options of map_Kd of material \"" + printable(looks_.materials[m].name) + "\" are not read");
      name = name.substr(name.find_last_of(" \t") + 1);
    }
    std::replace(name.begin(), name.end(), '\\', '/');
    std::string reason;
    const std::filesystem::path image = resolve_below(library, name, reason);
    const auto lost = [&](const std::string& why) {
      warn("the image " + printable(name.substr(0, 120)) + " is not read: " + why);
    };
    if (image.empty()) return lost(reason);
    const auto at = images_.find(image);
    if (at != images_.end()) {
      looks_.images_of[m] = at->second;
      return;
    }
    if (std::filesystem::file_size(image) > image_bytes - taken_) return lost("the images are too large");
    std::vector<uint8_t> bytes = read_bytes(image, image_bytes);
    taken_ += std::min<uint64_t>(bytes.size(), image_bytes - taken_);
    const std::string type = image_mime_type(bytes);
    if (type.empty() || (png_or_jpeg_ && type != "image/png" && type != "image/jpeg"))
      return lost("it is neither PNG nor JPEG");
    looks_.images_of[m] = images_[image] = static_cast<int>(looks_.images.size());
    looks_.images.push_back({"", std::move(bytes)});
  }

  const std::filesystem::path& file_;
  SurfaceMesh& mesh_;
  const bool png_or_jpeg_;
  PlainLooks looks_;
  std::map<std::string, int> numbers_;
  std::map<std::filesystem::path, int> images_;
  std::vector<uint8_t> found_;
  uint64_t taken_ = 0;
};

// Names without blanks, each once, as readers of .mtl want them.
std::vector<std::string> plain_names(const std::vector<Material>& materials) {
  std::vector<std::string> out;
  std::set<std::string> taken;
  for (const Material& material : materials) {
    std::string name = material.name.empty() ? "material" : material.name;
    for (char& c : name)
      if (static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\') c = '_';
    const std::string stem = name;
    for (int n = 2; !taken.insert(name).second; ++n) name = stem + "_" + std::to_string(n);
    out.push_back(name);
  }
  return out;
}

std::string number(float value) {
  char text[40];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

}  // namespace

PlainLooks read_obj_looks(const std::filesystem::path& file, SurfaceMesh& mesh, bool png_or_jpeg) {
  return LooksReader(file, mesh, png_or_jpeg).run();
}

void write_obj_looks(const PlainLooks& looks, const std::filesystem::path& file, SurfaceMesh& mesh) {
  mesh.corners.libraries.clear();
  if (looks.materials.empty()) return;
  const std::string stem = file.stem().string();
  std::vector<std::string> images;
  for (const PlainImage& image : looks.images) {
    images.push_back(image.uri);
    if (image.bytes.empty()) continue;
    const std::string type = image_mime_type(image.bytes);
    const std::string ending = type == "image/jpeg" ? "jpg" : type.empty() ? "bin" : type.substr(type.find('/') + 1);
    images.back() = stem + "_" + std::to_string(images.size() - 1) + "." + ending;
    write_bytes(file.parent_path() / images.back(), std::string(image.bytes.begin(), image.bytes.end()));
  }
  const std::vector<std::string> names = plain_names(looks.materials);
  std::string text;
  for (size_t m = 0; m < names.size(); ++m) {
    const Material& from = looks.materials[m];
    text += "newmtl " + names[m] + "\nKd";
    for (int c = 0; c < 3; ++c) text += " " + number(from.base_color[c]);
    text +=
        "\nd " + number(from.base_color.a) + "\nPr " + number(from.roughness) + "\nPm " + number(from.metallic) + "\n";
    if (const int image = looks.images_of[m]; image >= 0) text += "map_Kd " + images[static_cast<size_t>(image)] + "\n";
  }
  write_bytes(file.parent_path() / (stem + ".mtl"), text);
  mesh.corners.material_names = names;
  mesh.corners.libraries = {stem + ".mtl"};
}

SurfaceMesh to_obj_mesh(const Model& model, const FlatMesh& flat) {
  SurfaceMesh mesh = to_surface_mesh(flat);
  Corners& to = mesh.corners;
  for (const Material& material : model.materials) to.material_names.push_back(material.name);
  to.material_of.assign(flat.triangle_count(), Corners::none);
  to.texcoord_of.assign(flat.triangles.size(), Corners::none);
  bool any_material = false;
  for (const FlatPart& part : flat.parts) {
    const Primitive& from =
        model.meshes[static_cast<size_t>(part.mesh)].primitives[static_cast<size_t>(part.primitive)];
    const uint32_t end = part.first_triangle + part.triangle_count;
    if (from.material >= 0) {
      any_material = true;
      std::fill(to.material_of.begin() + part.first_triangle, to.material_of.begin() + end,
                static_cast<uint32_t>(from.material));
    }
    if (from.texcoords.empty() || from.texcoords[0].empty()) continue;
    const auto first = static_cast<uint32_t>(to.texcoords.size());
    for (const glm::vec2& uv : from.texcoords[0]) to.texcoords.emplace_back(uv.x, 1 - static_cast<double>(uv.y));
    for (size_t c = 3 * static_cast<size_t>(part.first_triangle); c < 3 * static_cast<size_t>(end); ++c)
      to.texcoord_of[c] = flat.triangles[c] - part.first_vertex + first;
  }
  if (!any_material) to.material_of.clear();
  if (to.texcoords.empty()) to.texcoord_of.clear();
  return mesh;
}

}  // namespace samples
