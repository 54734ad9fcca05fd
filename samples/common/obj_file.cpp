// Wavefront .obj: v (with colours), f in all forms (v, v/vt, v//vn, v/vt/vn), negative indices, both continued with a
// backslash, g and o. Materials, normals, texture coordinates, lines, points and curves are passed over; indices of vt
// and vn are checked all the same. A face may stand before its vertices. See mesh_file.h.
#include <algorithm>
#include <stdexcept>

#include "common/mesh_file_parts.h"

namespace samples {
namespace {

class ObjReader {
 public:
  ObjReader(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits)
      : in_(bytes.data(), bytes.size(), name, '#', true), name_(name), limits_(limits), faces_(mesh_, limits) {}

  SurfaceMesh run() {
    while (in_.next_line()) {
      const std::string_view key = in_.token_on_line();
      if (key == "v") {
        read_vertex();
      } else if (key == "f" || key == "fo") {
        read_face();
      } else if (key == "vt") {
        ++texcoords_;
      } else if (key == "vn") {
        ++normals_;
      } else if (key == "g" || key == "o") {
        begin_group(std::string(in_.rest_of_line()));
      } else if (key == "usemtl" || key == "mtllib") {
        materials_ = true;
      } else if (key == "l" || key == "p" || key == "curv" || key == "surf") {
        lines_ = true;
      }
      in_.skip_line();
    }
    build();
    return std::move(mesh_);
  }

 private:
  void read_vertex() {
    double values[7];
    int count = 0;
    std::string_view token;
    while (count < 7 && !(token = in_.token_on_line()).empty()) {
      if (!parse_double(token, values[count])) {
        in_.fail("\"" + std::string(token.substr(0, 40)) + "\" is not a number");
      }
      ++count;
    }
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
    std::string_view token;
    while (!(token = in_.token_on_line()).empty()) {
      corners_.push_back(read_corner(token));
      if (corners_.size() > 4ull * limits_.max_triangles) in_.fail("the file has too many face corners");
    }
    face_ends_.back() = corners_.size();
  }

  // The vertex, counted from 0; negative indices count back from the last element so far.
  int64_t read_corner(std::string_view token) {
    const std::string_view whole = token;
    const size_t counts[3] = {mesh_.positions.size(), texcoords_, normals_};
    int64_t vertex = -1;
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
      if (part == 0) vertex = index - 1;
      if (slash == std::string_view::npos) break;
      token.remove_prefix(slash + 1);
      if (part == 2) in_.fail("\"" + std::string(whole.substr(0, 40)) + "\" has too many slashes");
    }
    return vertex;
  }

  void begin_group(const std::string& name) {
    const auto found = std::find(mesh_.group_names.begin(), mesh_.group_names.end(), name);
    group_ = static_cast<uint32_t>(found - mesh_.group_names.begin());
    if (found != mesh_.group_names.end()) return;
    // finding a name costs the number of names, so that is bounded
    if (mesh_.group_names.size() >= 4096) {
      group_ = 4095;
      return;
    }
    mesh_.group_names.push_back(name);
  }

  void build() {
    if (texcoords_ > 0) mesh_.ignored.push_back("texture coordinates");
    if (normals_ > 0) mesh_.ignored.push_back("normals of corners");
    if (materials_) mesh_.ignored.push_back("materials");
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
      first = face_ends_[f];
      faces_.add(face, mesh_.positions.size(), name_ + ": line " + std::to_string(face_lines_[f]));
      if (grouped && !faces_.left_out()) mesh_.face_groups.push_back(group_of_face_[f]);
    }
    if (!grouped) mesh_.group_names.clear();
    faces_.finish();
  }

  TextCursor in_;
  const std::string& name_;
  const MeshLimits& limits_;
  SurfaceMesh mesh_;
  FaceCollector faces_;
  size_t texcoords_ = 0, normals_ = 0;
  bool materials_ = false, lines_ = false;
  int64_t highest_[3] = {0, 0, 0};
  uint32_t group_ = 0;
  std::vector<int64_t> corners_;
  std::vector<size_t> face_ends_, face_lines_;
  std::vector<uint32_t> group_of_face_;
};

}  // namespace

SurfaceMesh read_obj(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits) {
  return ObjReader(bytes, name, limits).run();
}

}  // namespace samples
