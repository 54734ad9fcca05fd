// Writers of mesh_file.h. Numbers take the shortest text that reads back to the same double; .ply holds doubles.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <map>
#include <stdexcept>
#include <utility>

#include "common/corner_split.h"
#include "common/mesh_file.h"
#include "gltf/file_name.h"
#include "gltf/file_write.h"
#include "gltf/gltf_write.h"
#include "gltf/json_file.h"

namespace samples {

using namespace hf_gltf;
namespace {

class Text {
 public:
  Text& operator<<(const char* text) {
    out_ += text;
    return *this;
  }
  Text& operator<<(const std::string& text) {
    out_ += text;
    return *this;
  }
  template <typename Number>
  Text& number(Number value) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof(buffer), value);
    out_.append(buffer, end.ptr);
    return *this;
  }
  template <typename Vector>
  Text& vector(const Vector& v) {
    for (int c = 0; c < Vector::length(); ++c) {
      out_ += ' ';
      number(v[c]);
    }
    return *this;
  }
  template <typename T>
  void raw(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out_.append(bytes, sizeof(T));
  }
  const std::string& str() const { return out_; }

 private:
  std::string out_;
};

void check(const SurfaceMesh& mesh, const std::string& name) {
  const auto fail = [&](const std::string& message) { throw std::runtime_error(name + ": " + message + "."); };
  const size_t count = mesh.positions.size();
  for (size_t v = 0; v < count; ++v) {
    const glm::dvec3& p = mesh.positions[v];
    if (!std::isfinite(p.x + p.y + p.z)) fail("vertex " + std::to_string(v) + " is not finite");
  }
  if (mesh.triangles.size() % 3 != 0) fail("the triangles have indices left over");
  for (const uint32_t v : mesh.triangles) {
    if (v >= count) fail("a triangle names vertex " + std::to_string(v) + " of " + std::to_string(count));
  }
  size_t corners = 0;
  for (const uint32_t size : mesh.face_sizes) corners += size;
  if (corners != mesh.face_vertices.size()) fail("the faces' sizes and corners do not fit");
  for (const uint32_t v : mesh.face_vertices) {
    if (v >= count) fail("a face names vertex " + std::to_string(v) + " of " + std::to_string(count));
  }
  if (!mesh.normals.empty() && mesh.normals.size() != count) fail("there is not one normal per vertex");
  if (!mesh.colors.empty() && mesh.colors.size() != count) fail("there is not one colour per vertex");
  if (!mesh.face_groups.empty() && mesh.face_groups.size() != mesh.face_count())
    fail("there is not one group per face");
  for (const uint32_t group : mesh.face_groups) {
    if (group >= mesh.group_names.size()) fail("a face belongs to a group without a name");
  }
  const Corners& of = mesh.corners;
  const size_t face_corners = mesh.face_sizes.empty() ? mesh.triangles.size() : corners;
  const auto check_list = [&](const std::vector<uint32_t>& list, size_t values, size_t length, const char* what) {
    if (!list.empty() && list.size() != length) fail(std::string("there is not one ") + what);
    for (const uint32_t i : list) {
      if (i >= values && i != Corners::none) fail(std::string("there is no such ") + what);
    }
  };
  check_list(of.texcoord_of, of.texcoords.size(), face_corners, "texture coordinate per corner");
  check_list(of.normal_of, of.normals.size(), face_corners, "normal per corner");
  check_list(of.material_of, of.material_names.size(), mesh.face_count(), "material per face");
}

template <typename Function>
void each_face(const SurfaceMesh& mesh, Function function) {
  size_t first = 0;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    const bool polygons = !mesh.face_sizes.empty();
    const uint32_t size = polygons ? mesh.face_sizes[f] : 3;
    function(f, (polygons ? mesh.face_vertices : mesh.triangles).data() + first, size);
    first += size;
  }
}

std::string obj_text(const SurfaceMesh& mesh) {
  Text out;
  const Corners& of = mesh.corners;
  for (const std::string& library : of.libraries) out << "mtllib " << library << "\n";
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    (out << "v").vector(mesh.positions[v]);
    if (!mesh.colors.empty()) out.vector(glm::vec3(mesh.colors[v]));
    out << "\n";
  }
  for (const glm::dvec2& uv : of.texcoords) (out << "vt").vector(uv) << "\n";
  const bool by_corner = !of.normal_of.empty();
  for (const glm::vec3& n : by_corner ? of.normals : mesh.normals) (out << "vn").vector(n) << "\n";
  uint32_t group = UINT32_MAX, material = Corners::none;
  size_t corner = 0;
  each_face(mesh, [&](size_t f, const uint32_t* corners, uint32_t size) {
    if (!mesh.face_groups.empty() && mesh.face_groups[f] != group) {
      group = mesh.face_groups[f];
      out << "g " << mesh.group_names[group] << "\n";
    }
    if (!of.material_of.empty() && of.material_of[f] != material) {
      material = of.material_of[f];
      out << "usemtl" << (material == Corners::none ? "" : " " + of.material_names[material]) << "\n";
    }
    out << "f";
    for (uint32_t c = 0; c < size; ++c, ++corner) {
      (out << " ").number(corners[c] + 1ull);
      const uint32_t uv = of.texcoord_of.empty() ? Corners::none : of.texcoord_of[corner];
      const uint32_t normal = by_corner ? of.normal_of[corner] : mesh.normals.empty() ? Corners::none : corners[c];
      if (uv != Corners::none) (out << "/").number(uv + 1ull);
      if (normal != Corners::none) (out << (uv == Corners::none ? "//" : "/")).number(normal + 1ull);
    }
    out << "\n";
  });
  return out.str();
}

std::string off_text(const SurfaceMesh& mesh) {
  Text out;
  out << (mesh.colors.empty() ? "" : "C") << (mesh.normals.empty() ? "" : "N") << "OFF\n";
  (out.number(mesh.positions.size()) << " ").number(mesh.face_count()) << " 0\n";
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3& p = mesh.positions[v];
    out.number(p.x).vector(glm::dvec2(p.y, p.z));
    if (!mesh.normals.empty()) out.vector(mesh.normals[v]);
    for (int c = 0; c < 4 && !mesh.colors.empty(); ++c) {
      // a decimal point tells 0..1 from 0..255
      const double value = std::clamp(static_cast<double>(mesh.colors[v][c]), 0.0, 1.0);
      out << " ";
      if (value == 0 || value == 1) {
        out << (value == 0 ? "0.0" : "1.0");
      } else {
        out.number(static_cast<float>(value));
      }
    }
    out << "\n";
  }
  each_face(mesh, [&](size_t, const uint32_t* corners, uint32_t size) {
    out.number(size);
    for (uint32_t c = 0; c < size; ++c) (out << " ").number(corners[c]);
    out << "\n";
  });
  return out.str();
}

std::string ply_bytes(const SurfaceMesh& mesh) {
  Text out;
  (out << "ply\nformat binary_little_endian 1.0\nelement vertex ").number(mesh.positions.size());
  out << "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!mesh.normals.empty()) out << "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.colors.empty()) {
    out << "property float red\nproperty float green\nproperty float blue\nproperty float alpha\n";
  }
  (out << "element face ").number(mesh.face_count()) << "\nproperty list uint uint vertex_indices\nend_header\n";
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int c = 0; c < 3; ++c) out.raw(mesh.positions[v][c]);
    for (int c = 0; c < 3 && !mesh.normals.empty(); ++c) out.raw(mesh.normals[v][c]);
    for (int c = 0; c < 4 && !mesh.colors.empty(); ++c) out.raw(mesh.colors[v][c]);
  }
  each_face(mesh, [&](size_t, const uint32_t* corners, uint32_t size) {
    out.raw(size);
    for (uint32_t c = 0; c < size; ++c) out.raw(corners[c]);
  });
  return out.str();
}

// Binary. A triangle has a normal of its own, and three corners that it shares with no other.
std::string stl_bytes(const SurfaceMesh& mesh) {
  Text out;
  out << std::string(80, ' ');
  out.raw(static_cast<uint32_t>(mesh.triangles.size() / 3));
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const glm::dvec3 corners[3] = {mesh.positions[mesh.triangles[t]], mesh.positions[mesh.triangles[t + 1]],
                                   mesh.positions[mesh.triangles[t + 2]]};
    const glm::dvec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double twice_area = length(normal);
    const auto add = [&](const glm::dvec3& v) {
      for (int c = 0; c < 3; ++c) {
        const float value = static_cast<float>(v[c]);
        if (!std::isfinite(value))
          throw std::runtime_error("a position is too large for .stl, which has floats; write .ply");
        out.raw(value);
      }
    };
    add(twice_area > 0 && std::isfinite(twice_area) ? normal / twice_area : glm::dvec3(0));
    for (const glm::dvec3& corner : corners) add(corner);
    out.raw(uint16_t{0});
  }
  return out.str();
}

// Some triangles as a primitive, with their vertices in order. alone: vertices that it has beside.
Primitive part_of(const Primitive& whole, const std::vector<uint32_t>& corners, std::vector<uint32_t> alone,
                  std::vector<uint32_t>& number) {
  std::vector<uint32_t>& vertices = alone;
  vertices.insert(vertices.end(), corners.begin(), corners.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Primitive part;
  part.texcoords.resize(whole.texcoords.size());
  for (const uint32_t v : vertices) {
    number[v] = static_cast<uint32_t>(part.positions.size());
    part.positions.push_back(whole.positions[v]);
    part.normals.push_back(whole.normals[v]);
    if (!whole.colors.empty()) part.colors.push_back(whole.colors[v]);
    for (size_t set = 0; set < whole.texcoords.size(); ++set) part.texcoords[set].push_back(whole.texcoords[set][v]);
  }
  for (const uint32_t v : corners) part.indices.push_back(number[v]);
  return part;
}

// A primitive for each material, in the order of the faces. Isolated vertices stand in the first.
std::vector<Primitive> parts_of(const Primitive& whole, const SplitMesh& split) {
  std::vector<uint32_t> order, number(whole.positions.size());
  std::map<uint32_t, std::vector<uint32_t>> corners;
  std::vector<uint8_t> used(whole.positions.size(), 0);
  for (size_t i = 0; i < split.triangles.size(); ++i) {
    std::vector<uint32_t>& here = corners[split.materials[i / 3]];
    if (here.empty()) order.push_back(split.materials[i / 3]);
    here.push_back(split.triangles[i]);
    used[split.triangles[i]] = 1;
  }
  std::vector<uint32_t> isolated;
  for (uint32_t v = 0; v < used.size(); ++v)
    if (!used[v]) isolated.push_back(v);
  std::vector<Primitive> out;
  for (const uint32_t material : order) {
    out.push_back(part_of(whole, corners[material], std::exchange(isolated, {}), number));
    out.back().material = material == Corners::none ? -1 : static_cast<int>(material);
  }
  return out;
}

}  // namespace

Model to_model(const SurfaceMesh& mesh, const std::string& name) {
  const SplitMesh split = split_corners(mesh);
  Model model = make_model(as_utf8(name), split.positions, split.triangles);
  std::vector<Primitive>& parts = model.meshes[0].primitives;
  Primitive& whole = parts[0];
  for (size_t v = 0; v < split.positions.size(); ++v) {
    if (!mesh.normals.empty()) whole.normals[v] = mesh.normals[split.origins[v]];
    if (!split.normals.empty() && split.normals[v] != glm::vec3(0)) whole.normals[v] = split.normals[v];
    if (!mesh.colors.empty()) whole.colors.push_back(mesh.colors[split.origins[v]]);
  }
  if (!split.texcoords.empty()) whole.texcoords.push_back(split.texcoords);
  if (split.materials.empty()) return model;
  for (const std::string& material : mesh.corners.material_names) {
    model.materials.emplace_back();
    model.materials.back().name = as_utf8(material);
    model.materials.back().metallic = 0;
  }
  parts = parts_of(whole, split);
  return model;
}

void write_mesh_file(const SurfaceMesh& mesh, const std::filesystem::path& file) {
  check(mesh, file.string());
  const std::string extension = ending_of(file);
  if (extension == ".obj") {
    write_bytes(file, obj_text(mesh));
  } else if (extension == ".off") {
    write_bytes(file, off_text(mesh));
  } else if (extension == ".ply") {
    write_bytes(file, ply_bytes(mesh));
  } else if (extension == ".stl") {
    write_bytes(file, stl_bytes(mesh));
  } else if (extension == ".glb" || extension == ".gltf" || extension == ".vrm") {
    write_gltf(to_model(mesh, file.stem().string()), file);
  } else {
    throw std::runtime_error(file.string() +
                             ": the format is not written; .obj, .off, .ply, .stl, .gltf and .glb are.");
  }
}

}  // namespace samples
