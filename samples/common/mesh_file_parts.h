// Inner header of the mesh file readers: a cursor over text and the faces collected so far.
#ifndef HF_SAMPLES_COMMON_MESH_FILE_PARTS_H
#define HF_SAMPLES_COMMON_MESH_FILE_PARTS_H

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh_file.h"

namespace samples {

// Tokens of a text, with line numbers for messages. '#' (or the character given) starts a comment to the end of a line.
// Lines end with LF, CR LF or CR. A byte order mark is passed over; UTF-16 is refused.
class TextCursor {
 public:
  TextCursor(const uint8_t* bytes, size_t size, std::string name, char comment, bool continued_lines = false);

  // The next token on this line; empty at its end.
  std::string_view token_on_line();
  // The next token on this or a later line; empty at the end of the text.
  std::string_view token();
  // To the first token of the next line that has one; false at the end.
  bool next_line();
  // To behind the line's end. Only tokens take a continued line into account: what a backslash ends, a name or a path
  // perhaps, must not swallow the line below.
  void skip_line();
  // The rest of the line, without surrounding blanks; a backslash belongs to it.
  std::string_view rest_of_line();

  bool at_end() const { return at_ >= size_; }
  size_t left() const { return size_ - at_; }
  size_t position() const { return at_; }
  size_t line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;

 private:
  bool is_line_end(size_t at) const;
  size_t behind_blanks(size_t at) const;
  bool is_continued() const;
  void skip_to_line_end();
  bool skip_blanks();

  const char* text_;
  size_t size_, at_ = 0, line_ = 1;
  std::string name_;
  char comment_;
  bool continued_lines_, cr_lines_ = false;
};

// Whole tokens only, independent of the locale; "+1" is a number, "1x" is none.
bool parse_double(std::string_view token, double& value);
bool parse_integer(std::string_view token, int64_t& value);

// Appends faces and their triangles; checks corners and limits.
class FaceCollector {
 public:
  FaceCollector(SurfaceMesh& mesh, const MeshLimits& limits) : mesh_(mesh), limits_(limits) {}

  // where stands in front of messages ("cube.off: line 12"). Corners are checked against the vertex count.
  void add(const std::vector<int64_t>& corners, size_t vertex_count, const std::string& where);
  // Triangulates; to be called when all positions are known.
  void finish();
  // Whether the last add() left the face out.
  bool left_out() const { return left_out_; }

 private:
  SurfaceMesh& mesh_;
  const MeshLimits& limits_;
  size_t skipped_ = 0;
  uint64_t triangles_ = 0;
  bool left_out_ = false;
};

SurfaceMesh read_obj(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits,
                     bool corners);
SurfaceMesh read_off(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits);
SurfaceMesh read_ply(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits);
SurfaceMesh read_stl(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits);

}  // namespace samples

#endif
