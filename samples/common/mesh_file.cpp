// See mesh_file.h. Choice of the format, text tokens, faces. Readers: obj_file.cpp, off_file.cpp,
// ply_file.cpp, stl_file.cpp; writers: mesh_write.cpp.
#include "common/mesh_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "common/face_triangles.h"
#include "common/mesh_file_parts.h"
#include "gltf/file_bytes.h"
#include "gltf/file_kind.h"
#include "gltf/gltf_read.h"

namespace samples {

using namespace hf_gltf;
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// Whether CR alone ends the lines. The first line tells; with another end CR is a blank.
bool has_cr_lines(std::string_view text) {
  const size_t end = text.find_first_of("\r\n");
  if (end == std::string_view::npos || text[end] == '\n') return false;
  const size_t behind = text.find_first_not_of('\r', end);
  return behind == std::string_view::npos || text[behind] != '\n';
}

void check_positions(const SurfaceMesh& mesh, const std::string& name) {
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    const glm::dvec3& p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw std::runtime_error(name + ": vertex " + std::to_string(v) + " has a coordinate that is not finite.");
    }
  }
}

}  // namespace

TextCursor::TextCursor(const uint8_t* bytes, size_t size, std::string name, char comment, bool continued_lines)
    : text_(reinterpret_cast<const char*>(bytes)),
      size_(size),
      name_(std::move(name)),
      comment_(comment),
      continued_lines_(continued_lines) {
  const std::string_view text(text_, size_);
  at_ = text_begin(text, name_);
  cr_lines_ = has_cr_lines(text);
}

bool TextCursor::is_line_end(size_t at) const { return text_[at] == '\n' || (cr_lines_ && text_[at] == '\r'); }

size_t TextCursor::behind_blanks(size_t at) const {
  while (at < size_ && is_blank(text_[at]) && !is_line_end(at)) ++at;
  return at;
}

// A backslash that only blanks and a line end follow.
bool TextCursor::is_continued() const {
  if (!continued_lines_ || text_[at_] != '\\') return false;
  const size_t end = behind_blanks(at_ + 1);
  return end >= size_ || is_line_end(end);
}

void TextCursor::skip_to_line_end() {
  while (at_ < size_ && !is_line_end(at_)) ++at_;
}

// Stops before a line end or a token; false at a line end or the end of the text.
bool TextCursor::skip_blanks() {
  for (;;) {
    at_ = behind_blanks(at_);
    if (at_ >= size_ || is_line_end(at_)) return false;
    if (comment_ != 0 && text_[at_] == comment_) {
      skip_to_line_end();
      return false;
    }
    if (!is_continued()) return true;
    at_ = std::min(behind_blanks(at_ + 1) + 1, size_);
    ++line_;
  }
}

std::string_view TextCursor::token_on_line() {
  if (!skip_blanks()) return {};
  const size_t start = at_;
  const auto ends = [&](size_t at) {
    return is_blank(text_[at]) || is_line_end(at) || (comment_ != 0 && text_[at] == comment_) || is_continued();
  };
  while (at_ < size_ && !ends(at_)) ++at_;
  return {text_ + start, at_ - start};
}

std::string_view TextCursor::token() {
  while (!skip_blanks()) {
    if (at_ >= size_) return {};
    ++at_;
    ++line_;
  }
  return token_on_line();
}

void TextCursor::skip_line() {
  skip_to_line_end();
  if (at_ < size_) {
    ++at_;
    ++line_;
  }
}

bool TextCursor::next_line() {
  while (!skip_blanks()) {
    if (at_ >= size_) return false;
    ++at_;
    ++line_;
  }
  return true;
}

std::string_view TextCursor::rest_of_line() {
  const size_t start = behind_blanks(at_);
  skip_to_line_end();
  std::string_view rest(text_ + start, at_ - start);
  if (comment_ != 0) rest = rest.substr(0, rest.find(comment_));
  while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
  return rest;
}

void TextCursor::fail(const std::string& message) const {
  throw std::runtime_error(name_ + ": line " + std::to_string(line_) + ": " + printable(message) + ".");
}

bool parse_double(std::string_view token, double& value) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  const auto result = std::from_chars(token.data(), token.data() + token.size(), value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == token.data() + token.size()) {
    // underflow is zero, overflow is infinity, which the check of the positions finds
    const size_t exponent = token.find_first_of("eE");
    const bool small = exponent != std::string_view::npos && exponent + 1 < token.size() && token[exponent + 1] == '-';
    value = small ? 0 : HUGE_VAL;
    return true;
  }
  return result.ec == std::errc() && result.ptr == token.data() + token.size();
}

bool parse_integer(std::string_view token, int64_t& value) {
  if (!token.empty() && token.front() == '+') token.remove_prefix(1);
  const auto result = std::from_chars(token.data(), token.data() + token.size(), value);
  return result.ec == std::errc() && result.ptr == token.data() + token.size();
}

void FaceCollector::add(const std::vector<int64_t>& corners, size_t vertex_count, const std::string& where) {
  for (const int64_t corner : corners) {
    if (corner < 0 || static_cast<uint64_t>(corner) >= vertex_count) {
      throw std::runtime_error(where + ": a face names vertex " + std::to_string(corner) + " (counted from 0) of " +
                               std::to_string(vertex_count) + ".");
    }
  }
  left_out_ = corners.size() < 3;
  if (left_out_) {
    ++skipped_;
    return;
  }
  triangles_ += corners.size() - 2;
  if (triangles_ > limits_.max_triangles) {
    throw std::runtime_error(where + ": the file has more than " + std::to_string(limits_.max_triangles) +
                             " triangles; raise the limit if that is meant.");
  }
  mesh_.face_sizes.push_back(static_cast<uint32_t>(corners.size()));
  for (const int64_t corner : corners) mesh_.face_vertices.push_back(static_cast<uint32_t>(corner));
}

void FaceCollector::finish() {
  mesh_.triangles.reserve(static_cast<size_t>(triangles_) * 3);
  FaceTriangles cut;
  size_t first = 0;
  for (const uint32_t size : mesh_.face_sizes) {
    cut.append(mesh_.positions, mesh_.face_vertices.data() + first, size, mesh_.triangles);
    first += size;
  }
  if (mesh_.triangles.size() == mesh_.face_vertices.size()) {
    mesh_.face_sizes.clear();
    mesh_.face_vertices.clear();
  }
  if (skipped_ > 0) {
    mesh_.warnings.push_back(std::to_string(skipped_) + " faces with fewer than three corners are left out");
  }
}

SurfaceMesh read_mesh_bytes(const std::vector<uint8_t>& bytes, const std::string& extension, const std::string& name,
                            const MeshLimits& limits, bool corners) {
  SurfaceMesh mesh;
  const FileKind kind = kind_of(bytes.data(), bytes.size(), bytes.size(), extension);
  if (kind == FileKind::obj) {
    mesh = read_obj(bytes, name, limits, corners);
  } else if (kind == FileKind::off) {
    mesh = read_off(bytes, name, limits);
  } else if (kind == FileKind::ply) {
    mesh = read_ply(bytes, name, limits);
  } else if (kind == FileKind::stl) {
    mesh = read_stl(bytes, name, limits);
  } else {
    const std::string advice = advice_on(kind), read = ".obj, .off, .ply, .stl, " + model_endings("and");
    if (kind == FileKind::unknown) throw std::runtime_error(name + " is of no known format; " + read + " are read");
    throw std::runtime_error(name + " is " + name_of(kind) + ", which is not read; " + read + " are" +
                             (advice.empty() ? "" : ": " + advice));
  }
  check_positions(mesh, name);
  return mesh;
}

SurfaceMesh read_mesh_file(const std::filesystem::path& file, const MeshLimits& limits, bool corners) {
  const FileKind kind = kind_of_file(file);
  if (is_model(kind)) {
    Model model = read_gltf(file);
    FlattenOptions options;
    options.max_vertices = std::min(options.max_vertices, limits.max_vertices);
    options.max_triangles = std::min(options.max_triangles, limits.max_triangles);
    SurfaceMesh mesh = to_surface_mesh(flatten(model, options));
    mesh.warnings = std::move(model.warnings);
    return mesh;
  }
  const bool is_read = kind == FileKind::obj || kind == FileKind::off || kind == FileKind::ply || kind == FileKind::stl;
  // a file that is not there is refused by name
  const bool reads = is_read || !std::filesystem::exists(file);
  return read_mesh_bytes(reads ? read_bytes(file, limits.max_file_bytes) : std::vector<uint8_t>(),
                         file.extension().string(), file.string(), limits, corners);
}

FlatMesh to_flat_mesh(const SurfaceMesh& mesh) {
  FlatMesh flat;
  flat.positions = mesh.positions;
  flat.triangles = mesh.triangles;
  flat.colors = mesh.colors;
  flat.normals = mesh.normals;
  flat.normals.resize(flat.positions.size(), glm::vec3(0));
  FlatPart part;
  part.node = part.mesh = part.primitive = 0;
  part.vertex_count = flat.vertex_count();
  part.triangle_count = flat.triangle_count();
  flat.parts.push_back(part);
  flat.weld();
  return flat;
}

SurfaceMesh to_surface_mesh(const FlatMesh& mesh) {
  SurfaceMesh surface;
  surface.positions = mesh.positions;
  surface.triangles = mesh.triangles;
  surface.colors = mesh.colors;
  const bool none =
      std::all_of(mesh.normals.begin(), mesh.normals.end(), [](const glm::vec3& n) { return n == glm::vec3(0); });
  if (!none) surface.normals = mesh.normals;
  return surface;
}

}  // namespace samples
