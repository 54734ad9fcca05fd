// .stl, binary and text. Triangles stand alone in it: corners at bit-equal places are joined to one vertex, numbered in
// the order of the file. Normals, colours and names are passed over. See mesh_file.h.
#include <cstring>
#include <stdexcept>

#include "common/mesh_file_parts.h"
#include "gltf/file_bytes.h"

namespace samples {

using namespace hf_gltf;
namespace {

constexpr size_t header_bytes = 84, triangle_bytes = 50;

uint32_t load_u32(const uint8_t* bytes) {
  return static_cast<uint32_t>(bytes[0]) | static_cast<uint32_t>(bytes[1]) << 8 |
         static_cast<uint32_t>(bytes[2]) << 16 | static_cast<uint32_t>(bytes[3]) << 24;
}

float load_float(const uint8_t* bytes) {
  const uint32_t bits = load_u32(bytes);
  float out;
  std::memcpy(&out, &bits, sizeof out);
  return out;
}

class StlReader {
 public:
  StlReader(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits)
      : bytes_(bytes), name_(name), limits_(limits) {}

  SurfaceMesh run() {
    const bool says_text = bytes_.size() >= 5 && std::memcmp(bytes_.data(), "solid", 5) == 0;
    const bool fits = bytes_.size() >= header_bytes &&
                      bytes_.size() == header_bytes + uint64_t{triangle_bytes} * load_u32(bytes_.data() + 80);
    // headers of binary files can begin with "solid" too
    if (says_text && !fits) {
      read_text();
    } else {
      read_binary();
    }
    return joined();
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw std::runtime_error(name_ + ": " + printable(message) + ".");
  }

  void read_binary() {
    if (bytes_.size() < header_bytes)
      fail("the header of a binary .stl has 84 bytes, the file " + std::to_string(bytes_.size()));
    const uint64_t count = load_u32(bytes_.data() + 80), held = (bytes_.size() - header_bytes) / triangle_bytes;
    if (count > held) {
      fail("the header says " + std::to_string(count) + " triangles, but the file holds " + std::to_string(held) +
           ": it is cut off or damaged");
    }
    if (count > limits_.max_triangles)
      fail("the file has more than " + std::to_string(limits_.max_triangles) + " triangles");
    corners_.reserve(3 * static_cast<size_t>(count));
    for (size_t t = 0; t < count; ++t) {
      const uint8_t* at = bytes_.data() + header_bytes + triangle_bytes * t + 12;  // behind the normal
      for (size_t c = 0; c < 3; ++c, at += 12)
        corners_.emplace_back(load_float(at), load_float(at + 4), load_float(at + 8));
      sizes_.push_back(3);
    }
  }

  // Any number of solids; each loop is a face.
  void read_text() {
    TextCursor in(bytes_.data(), bytes_.size(), name_, 0);
    size_t first = 0;
    bool open = false;
    std::string_view key;
    while (!(key = in.token()).empty()) {
      if (key == "solid" || key == "endsolid") {
        in.skip_line();  // a name
      } else if (key == "outer") {
        open = true;
        first = corners_.size();
      } else if (key == "vertex") {
        if (!open) in.fail("a vertex is outside of a loop");
        glm::dvec3 p;
        for (int c = 0; c < 3; ++c)
          if (!parse_double(in.token(), p[c])) in.fail("a vertex needs three numbers");
        corners_.push_back(p);
        if (corners_.size() > 3ull * limits_.max_triangles) in.fail("the file has too many corners");
      } else if (key == "endloop") {
        if (!open) in.fail("\"endloop\" stands without \"outer loop\"");
        open = false;
        sizes_.push_back(corners_.size() - first);
      } else if (key == "normal") {
        for (int c = 0; c < 3; ++c) in.token();
      } else if (key != "loop" && key != "facet" && key != "endfacet") {
        in.fail("\"" + std::string(key.substr(0, 40)) + "\" does not belong into an .stl");
      }
    }
    if (open) in.fail("the file ends within a loop: it is cut off");
  }

  SurfaceMesh joined() {
    SurfaceMesh mesh;
    std::vector<uint32_t> number;
    const uint32_t count = weld_positions(corners_, number);
    if (count > limits_.max_vertices)
      fail("the file has more than " + std::to_string(limits_.max_vertices) + " vertices");
    mesh.positions.resize(count);
    for (size_t i = corners_.size(); i-- > 0;) mesh.positions[number[i]] = corners_[i];
    FaceCollector faces(mesh, limits_);
    size_t first = 0;
    for (size_t f = 0; f < sizes_.size(); ++f) {
      faces.add({number.begin() + static_cast<std::ptrdiff_t>(first),
                 number.begin() + static_cast<std::ptrdiff_t>(first + sizes_[f])},
                count, name_ + ": face " + std::to_string(f));
      first += sizes_[f];
    }
    faces.finish();
    return mesh;
  }

  const std::vector<uint8_t>& bytes_;
  const std::string& name_;
  const MeshLimits& limits_;
  std::vector<glm::dvec3> corners_;
  std::vector<size_t> sizes_;
};

}  // namespace

SurfaceMesh read_stl(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits) {
  return StlReader(bytes, name, limits).run();
}

}  // namespace samples
