// Geomview .off in text: OFF, and COFF, NOFF, STOFF and their combinations; comments, blank lines, counts on the first
// line, a missing keyword, colours behind faces. The first numbers of an element may be spread over lines; what stands
// behind them on the last line is colour or is passed over. See mesh_file.h.
#include <stdexcept>

#include "common/mesh_file_parts.h"

namespace samples {
namespace {

class OffReader {
 public:
  OffReader(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits)
      : in_(bytes.data(), bytes.size(), name, '#'), name_(name), limits_(limits), faces_(mesh_, limits) {}

  SurfaceMesh run() {
    read_header();
    // "0 0 0" and a line end, and "3 0 1 2": what an element takes at the least
    check_count(vertex_count_, 5, limits_.max_vertices, "vertices");
    mesh_.positions.reserve(static_cast<size_t>(vertex_count_));
    for (int64_t v = 0; v < vertex_count_; ++v) read_vertex(v);
    check_count(face_count_, 1, limits_.max_triangles, "faces");
    for (int64_t f = 0; f < face_count_; ++f) read_face(f);
    if (texcoords_) mesh_.ignored.push_back("texture coordinates");
    if (face_colors_) mesh_.ignored.push_back("colours of faces");
    faces_.finish();
    return std::move(mesh_);
  }

 private:
  void read_header() {
    if (!in_.next_line()) in_.fail("the file holds nothing");
    std::string word(in_.token_on_line());
    const size_t keyword = word.find("OFF");
    if (keyword != std::string::npos) {
      const std::string flags = word.substr(0, keyword);
      for (size_t i = 0; i < flags.size(); ++i) {
        if (flags.compare(i, 2, "ST") == 0) {
          texcoords_ = true;
          ++i;
        } else if (flags[i] == 'C') {
          colors_ = true;
        } else if (flags[i] == 'N') {
          normals_ = true;
        } else {
          in_.fail("the header \"" + word.substr(0, 20) + "\" is not read; points must have three coordinates");
        }
      }
      word = word.substr(keyword + 3);
      if (word.empty()) word = std::string(in_.token());
    }
    if (word == "BINARY") in_.fail("binary .off is not read; save the mesh as text or as .ply");
    if (!parse_integer(word, vertex_count_))
      in_.fail("expected the number of vertices, found \"" + word.substr(0, 40) + "\"");
    face_count_ = integer("the number of faces");
    in_.skip_line();
  }

  void check_count(int64_t count, uint64_t bytes_each, uint64_t limit, const char* what) const {
    if (count < 0 || static_cast<uint64_t>(count) > limit) {
      in_.fail("the header says " + std::to_string(count) + " " + what + ", the limit is " + std::to_string(limit));
    }
    if (static_cast<uint64_t>(count) * bytes_each > in_.left() + bytes_each) {
      in_.fail("the header says " + std::to_string(count) + " " + what + ", but only " + std::to_string(in_.left()) +
               " bytes are left: the file is cut off or damaged");
    }
  }

  int64_t integer(const char* what) {
    const std::string_view token = in_.token();
    int64_t value = 0;
    if (token.empty()) in_.fail(std::string("the file ends where ") + what + " should stand");
    if (!parse_integer(token, value)) {
      in_.fail(std::string("expected ") + what + ", found \"" + std::string(token.substr(0, 40)) + "\"");
    }
    return value;
  }

  double number(int64_t v) {
    const std::string_view token = in_.token();
    double value = 0;
    if (token.empty())
      in_.fail("the file ends within vertex " + std::to_string(v) + " of " + std::to_string(vertex_count_));
    if (!parse_double(token, value)) in_.fail("\"" + std::string(token.substr(0, 40)) + "\" is not a number");
    return value;
  }

  void read_vertex(int64_t v) {
    const double x = number(v), y = number(v), z = number(v);
    mesh_.positions.emplace_back(x, y, z);
    if (normals_) {
      const double nx = number(v), ny = number(v), nz = number(v);
      mesh_.normals.emplace_back(nx, ny, nz);
    }
    if (colors_) mesh_.colors.push_back(read_color());
    in_.skip_line();
  }

  // Up to four numbers on the line: whole ones count to 255, others to 1.
  glm::vec4 read_color() {
    glm::vec4 color(1);
    bool whole = true;
    int count = 0;
    std::string_view token;
    for (; count < 4 && !(token = in_.token_on_line()).empty(); ++count) {
      double value = 0;
      if (!parse_double(token, value)) in_.fail("\"" + std::string(token.substr(0, 40)) + "\" is not a colour");
      whole = whole && token.find_first_not_of("0123456789") == std::string_view::npos;
      color[count] = static_cast<float>(value);
    }
    for (int c = 0; c < count; ++c) {
      if (whole) color[c] /= 255.0f;
      color[c] = color[c] >= 0 ? (color[c] <= 1 ? color[c] : 1.0f) : 0.0f;
    }
    return color;
  }

  void read_face(int64_t f) {
    const int64_t size = integer("a face");
    if (size < 0 || static_cast<uint64_t>(size) > in_.left()) {
      in_.fail("face " + std::to_string(f) + " says it has " + std::to_string(size) + " corners, but only " +
               std::to_string(in_.left()) + " bytes are left");
    }
    corners_.clear();
    for (int64_t c = 0; c < size; ++c) corners_.push_back(integer("a face corner"));
    face_colors_ = face_colors_ || !in_.token_on_line().empty();
    faces_.add(corners_, mesh_.positions.size(), name_ + ": line " + std::to_string(in_.line()));
    in_.skip_line();
  }

  TextCursor in_;
  const std::string& name_;
  const MeshLimits& limits_;
  SurfaceMesh mesh_;
  FaceCollector faces_;
  int64_t vertex_count_ = 0, face_count_ = 0;
  bool normals_ = false, colors_ = false, texcoords_ = false, face_colors_ = false;
  std::vector<int64_t> corners_;
};

}  // namespace

SurfaceMesh read_off(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits) {
  return OffReader(bytes, name, limits).run();
}

}  // namespace samples
