// Wavefront .obj: v (with colours), f in all forms (v, v/vt, v//vn, v/vt/vn), negative indices, both continued with a
// backslash, g and o. Normals, texture coordinates and names of materials are read where they are asked for. Lines,
// points and curves are passed over. Indices of vt and vn are always checked. A face may stand before its vertices. See
// mesh_file.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/mesh_file_parts.h"

namespace samples {
namespace {

class ObjReader {
 public:
  ObjReader(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits, bool wants_corners)
      : in_(bytes.data(), bytes.size(), name, '#', true),
        name_(name),
        limits_(limits),
        wants_corners_(wants_corners),
        faces_(mesh_, limits) {}

  SurfaceMesh run() {
    while (in_.next_line()) {
      const std::string_view key = in_.token_on_line();
      if (key == "v") {
        read_vertex();
      } else if (key == "f" || key == "fo") {
        read_face();
      } else if (key == "vt") {
        ++texcoords_;
        if (wants_corners_) read_texcoord();
      } else if (key == "vn") {
        ++normals_;
        if (wants_corners_) read_normal();
      } else if (key == "g" || key == "o") {
        group_ = static_cast<uint32_t>(index_of(mesh_.group_names, std::string(in_.rest_of_line())));
      } else if (key == "usemtl" || key == "mtllib") {
        materials_ = true;
        if (wants_corners_) read_material(key == "usemtl");
      } else if (key == "l" || key == "p" || key == "curv" || key == "surf") {
        lines_ = true;
      }
      in_.skip_line();
    }
    build();
    return std::move(mesh_);
  }

 private:
  // Numbers of the line, as many as there are room for.
  int read_numbers(double* values, int most) {
    int count = 0;
    std::string_view token;
    while (count < most && !(token = in_.token_on_line()).empty()) {
      if (!parse_double(token, values[count])) {
        in_.fail("\"" + std::string(token.substr(0, 40)) + "\" is not a number");
      }
      ++count;
    }
    return count;
  }

  void read_texcoord() {
    double uv[2] = {0, 0};
    if (read_numbers(uv, 2) == 0) in_.fail("a texture coordinate needs a number");
    mesh_.corners.texcoords.emplace_back(uv[0], uv[1]);
  }

  void read_normal() {
    double xyz[3];
    if (read_numbers(xyz, 3) < 3) in_.fail("a normal needs three numbers");
    mesh_.corners.normals.emplace_back(xyz[0], xyz[1], xyz[2]);
  }

  void read_material(bool used) {
    std::vector<std::string>& names = used ? mesh_.corners.material_names : mesh_.corners.libraries;
    const std::string name(in_.rest_of_line());
    const uint32_t index = name.empty() ? Corners::none : static_cast<uint32_t>(index_of(names, name));
    if (used) material_ = index;
  }

  void read_vertex() {
    double values[7];
    const int count = read_numbers(values, 7);
    if (count < 3) in_.fail("a vertex needs three coordinates, this one has " + std::to_string(count));
    if (mesh_.positions.size() >= limits_.max_vertices) {
      in_.fail("the file has more than " + std::to_string(limits_.max_vertices) + " vertices");
    }
    mesh_.positions.emplace_back(values[0], values[1], values[2]);
    if (count < 6) return;
    // x y z r g b, in 0..1
    mesh_.colors.resize(mesh_.positions.size() - 1, glm::vec4(1));
    glm::vec4 color(values[3], values[4], values[5], count == 7 ? values[6] : 1.0);
    for (int c = 0; c < 4; ++c) color[c] = color[c] >= 0 && color[c] <= 1 ? color[c] : (color[c] > 1 ? 1.0f : 0.0f);
    mesh_.colors.push_back(color);
  }

  void read_face() {
    face_lines_.push_back(in_.line());
    face_ends_.push_back(corners_.size());
    group_of_face_.push_back(group_);
    if (wants_corners_) material_of_face_.push_back(material_);
    std::string_view token;
    while (!(token = in_.token_on_line()).empty()) {
      corners_.push_back(read_corner(token));
      if (corners_.size() > 4ull * limits_.max_triangles) in_.fail("the file has too many face corners");
    }
    face_ends_.back() = corners_.size();
  }

  // The vertex, counted from 0, and in corner_parts_ texture coordinate and normal, or -1; negative indices count back
  // from the last element so far.
  int64_t read_corner(std::string_view token) {
    const std::string_view whole = token;
    const size_t counts[3] = {mesh_.positions.size(), texcoords_, normals_};
    int64_t found[3] = {-1, -1, -1};
    for (int part = 0; part < 3; ++part) {
      const size_t slash = token.find('/');
      const std::string_view number = token.substr(0, slash);
      int64_t index = 0;
      if (!number.empty()) {
        if (!parse_integer(number, index) || index == 0) {
          in_.fail("\"" + std::string(whole.substr(0, 40)) + "\" is not a face corner; indices count from 1");
        }
        if (index < 0 && static_cast<uint64_t>(-(index + 1)) >= counts[part]) {
          in_.fail("the index " + std::to_string(index) + " counts back beyond the first element");
        }
        if (index < 0) index += static_cast<int64_t>(counts[part]) + 1;
        highest_[part] = std::max(highest_[part], index);
      } else if (part == 0) {
        in_.fail("\"" + std::string(whole.substr(0, 40)) + "\" names no vertex");
      }
      found[part] = index - 1;
      if (slash == std::string_view::npos) break;
      token.remove_prefix(slash + 1);
      if (part == 2) in_.fail("\"" + std::string(whole.substr(0, 40)) + "\" has too many slashes");
    }
    if (wants_corners_) corner_parts_.push_back({found[1], found[2]});
    return found[0];
  }

  // The place of a name in a list, which gets it. Finding a name costs the number of names, so that is bounded.
  static size_t index_of(std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    const auto index = static_cast<size_t>(found - names.begin());
    if (found != names.end()) return index;
    if (names.size() >= 4096) return 4095;
    names.push_back(name);
    return index;
  }

  // What the corners from `first` to `end` say; that of a face that is kept.
  void add_corners(size_t face, size_t first, size_t end) {
    Corners& corners = mesh_.corners;
    const auto index = [](int64_t i, size_t count) {
      return i >= 0 && static_cast<uint64_t>(i) < count ? static_cast<uint32_t>(i) : Corners::none;
    };
    for (size_t c = first; c < end; ++c) {
      corners.texcoord_of.push_back(index(corner_parts_[c][0], texcoords_));
      corners.normal_of.push_back(index(corner_parts_[c][1], normals_));
    }
    corners.material_of.push_back(material_of_face_[face]);
  }

  // Lists that say nothing are emptied; a normal that is no direction counts as none.
  void finish_corners() {
    Corners& corners = mesh_.corners;
    size_t odd = 0;
    const auto clean = [&](std::vector<uint32_t>& of, auto is_good) {
      bool any = false;
      for (uint32_t& i : of) {
        if (i != Corners::none && !is_good(i)) {
          i = Corners::none;
          ++odd;
        }
        any = any || i != Corners::none;
      }
      if (!any) of.clear();
    };
    clean(corners.texcoord_of, [&](uint32_t i) {
      const glm::vec2 uv(corners.texcoords[i]);
      return std::isfinite(uv.x) && std::isfinite(uv.y);
    });
    clean(corners.normal_of, [&](uint32_t i) {
      const double length = glm::length(glm::dvec3(corners.normals[i]));
      return length > 0 && std::isfinite(length);
    });
    clean(corners.material_of, [](uint32_t) { return true; });
    if (odd > 0)
      mesh_.warnings.push_back(std::to_string(odd) +
                               " corners have a texture coordinate or normal that is zero or not finite, left out");
    if (corners.texcoord_of.empty()) corners.texcoords.clear();
    if (corners.normal_of.empty()) corners.normals.clear();
    if (!corners.normal_of.empty()) share_normals();
  }

  // Normals become those of vertices where all corners of each vertex have one.
  void share_normals() {
    Corners& corners = mesh_.corners;
    std::vector<glm::vec3> shared(mesh_.positions.size(), glm::vec3(0));
    const std::vector<uint32_t>& vertices = mesh_.face_sizes.empty() ? mesh_.triangles : mesh_.face_vertices;
    for (size_t c = 0; c < vertices.size(); ++c) {
      if (corners.normal_of[c] == Corners::none) return;
      const glm::vec3& normal = corners.normals[corners.normal_of[c]];
      glm::vec3& to = shared[vertices[c]];
      if (to != glm::vec3(0) && to != normal) return;
      to = normal;
    }
    mesh_.normals = std::move(shared);
    corners.normals.clear();
    corners.normal_of.clear();
  }

  void build() {
    if (texcoords_ > 0 && !wants_corners_) mesh_.ignored.push_back("texture coordinates");
    if (normals_ > 0 && !wants_corners_) mesh_.ignored.push_back("normals of corners");
    if (materials_ && !wants_corners_) mesh_.ignored.push_back("materials");
    if (lines_) mesh_.ignored.push_back("lines, points or curves");
    if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.positions.size(), glm::vec4(1));
    if (highest_[1] > static_cast<int64_t>(texcoords_) || highest_[2] > static_cast<int64_t>(normals_)) {
      mesh_.warnings.push_back("some faces name texture coordinates or normals that do not exist");
    }
    // faces before the first group stand in an unnamed one
    const bool grouped = mesh_.group_names.size() > 1;
    std::vector<int64_t> face;
    size_t first = 0;
    for (size_t f = 0; f < face_ends_.size(); ++f) {
      face.assign(corners_.begin() + static_cast<std::ptrdiff_t>(first),
                  corners_.begin() + static_cast<std::ptrdiff_t>(face_ends_[f]));
      faces_.add(face, mesh_.positions.size(), name_ + ": line " + std::to_string(face_lines_[f]));
      if (grouped && !faces_.left_out()) mesh_.face_groups.push_back(group_of_face_[f]);
      if (wants_corners_ && !faces_.left_out()) add_corners(f, first, face_ends_[f]);
      first = face_ends_[f];
    }
    if (!grouped) mesh_.group_names.clear();
    faces_.finish();
    if (wants_corners_) finish_corners();
  }

  TextCursor in_;
  const std::string& name_;
  const MeshLimits& limits_;
  const bool wants_corners_;
  SurfaceMesh mesh_;
  FaceCollector faces_;
  size_t texcoords_ = 0, normals_ = 0;
  bool materials_ = false, lines_ = false;
  int64_t highest_[3] = {0, 0, 0};
  uint32_t group_ = 0, material_ = Corners::none;
  std::vector<int64_t> corners_;
  std::vector<size_t> face_ends_, face_lines_;
  std::vector<std::array<int64_t, 2>> corner_parts_;
  std::vector<uint32_t> group_of_face_, material_of_face_;
};

}  // namespace

SurfaceMesh read_obj(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits,
                     bool corners) {
  return ObjReader(bytes, name, limits, corners).run();
}

}  // namespace samples
