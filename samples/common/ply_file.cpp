// Stanford .ply: text, binary in both byte orders; any elements and properties in any order. Used are vertex x y z,
// nx ny nz, red green blue alpha; face vertex_indices (or vertex_index) and tristrips. Everything else is passed over.
//
// Before an element is read, its count times the least size of a row is checked against the bytes left, and every list
// length against them too. See mesh_file.h.
#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "common/mesh_file_parts.h"
#include "gltf/file_bytes.h"

namespace samples {

using namespace hf_gltf;
namespace {

enum class Type { none, i8, u8, i16, u16, i32, u32, f32, f64 };

Type type_of(std::string_view name) {
  static constexpr struct {
    const char* name;
    Type type;
  } names[] = {{"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
               {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
               {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
               {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}};
  for (const auto& o : names) {
    if (name == o.name) return o.type;
  }
  return Type::none;
}

size_t size_of(Type type) {
  switch (type) {
    case Type::none:
      return 0;
    case Type::i8:
    case Type::u8:
      return 1;
    case Type::i16:
    case Type::u16:
      return 2;
    case Type::i32:
    case Type::u32:
    case Type::f32:
      return 4;
    case Type::f64:
      return 8;
  }
  return 0;
}

struct Property {
  std::string name;
  Type type = Type::none;
  Type count_type = Type::none;  // of a list
};

struct Element {
  std::string name;
  uint64_t count = 0;
  std::vector<Property> properties;
};

template <typename T>
double load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(value));
  return static_cast<double>(value);
}

class PlyReader {
 public:
  PlyReader(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits)
      : bytes_(bytes), in_(bytes.data(), bytes.size(), name, 0), name_(name), limits_(limits), faces_(mesh_, limits) {}

  SurfaceMesh run() {
    read_header();
    for (const Element& element : elements_) {
      check_count(element);
      if (element.properties.empty()) continue;
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        read_others(element);
      }
    }
    // faces may stand before the vertices
    for (size_t f = 0; f < rows_.size(); ++f) {
      faces_.add(rows_[f], mesh_.positions.size(), name_ + ": face " + std::to_string(f));
    }
    faces_.finish();
    return std::move(mesh_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw std::runtime_error(name_ + ": " + printable(message) + ".");
  }

  void read_header() {
    if (in_.token() != "ply") fail("the file does not begin with \"ply\"");
    bool formatted = false;
    in_.skip_line();
    // header lines of LF CR: the CR of the last one is not data
    const size_t second = in_.position();
    const bool lf_cr = bytes_[second - 1] == '\n' && second + 1 < bytes_.size() && bytes_[second] == '\r' &&
                       bytes_[second + 1] != '\n';
    for (;; in_.skip_line()) {
      if (!in_.next_line()) fail("the header has no end_header");
      const std::string word(in_.token_on_line());
      if (word == "end_header") break;
      if (word == "format") {
        read_format();
        formatted = true;
      } else if (word == "element") {
        read_element();
      } else if (word == "property") {
        read_property();
      } else if (word != "comment" && word != "obj_info") {
        in_.fail("\"" + word.substr(0, 40) + "\" does not belong into the header");
      }
    }
    if (!formatted) fail("the header has no format");
    in_.skip_line();
    at_ = in_.position();
    if (lf_cr && at_ < bytes_.size() && bytes_[at_] == '\r') ++at_;
  }

  void read_format() {
    const std::string_view kind = in_.token_on_line();
    text_ = kind == "ascii";
    swap_ = kind == "binary_big_endian";
    if (!text_ && !swap_ && kind != "binary_little_endian") in_.fail("the format is not known");
    if (in_.token_on_line() != "1.0") in_.fail("only version 1.0 is read");
  }

  void read_element() {
    Element element;
    element.name = std::string(in_.token_on_line());
    int64_t count = 0;
    if (!parse_integer(in_.token_on_line(), count) || count < 0) in_.fail("the element has no count");
    element.count = static_cast<uint64_t>(count);
    elements_.push_back(std::move(element));
    if (elements_.size() > 1000) in_.fail("the header has more than 1000 elements");
  }

  void read_property() {
    if (elements_.empty()) in_.fail("a property is before the first element");
    Property property;
    std::string_view word = in_.token_on_line();
    if (word == "list") {
      property.count_type = type_of(in_.token_on_line());
      if (property.count_type == Type::none || property.count_type == Type::f32 || property.count_type == Type::f64) {
        in_.fail("the list has no whole-number count type");
      }
      word = in_.token_on_line();
    }
    property.type = type_of(word);
    if (property.type == Type::none) in_.fail("the type \"" + std::string(word.substr(0, 40)) + "\" is not known");
    property.name = std::string(in_.token_on_line());
    if (property.name.empty()) in_.fail("a property has no name");
    elements_.back().properties.push_back(std::move(property));
    if (elements_.back().properties.size() > 1000) in_.fail("an element has more than 1000 properties");
  }

  size_t left() const { return text_ ? in_.left() : bytes_.size() - at_; }

  void check_count(const Element& element) const {
    uint64_t least = 0;
    for (const Property& o : element.properties) {
      least += text_ ? 2 : o.count_type == Type::none ? size_of(o.type) : size_of(o.count_type);
    }
    const uint64_t available = left() + (text_ ? 1 : 0);
    if (least > 0 && element.count > available / least) {
      fail("the header says " + std::to_string(element.count) + " of \"" + element.name.substr(0, 40) +
           "\", but only " + std::to_string(left()) + " bytes are left: the file is cut off or damaged");
    }
    const uint64_t limit = element.name == "vertex" ? limits_.max_vertices : limits_.max_triangles;
    if (element.count > limit && !element.properties.empty()) {
      fail(std::to_string(element.count) + " of \"" + element.name.substr(0, 40) + "\" are above the limit of " +
           std::to_string(limit));
    }
  }

  double scalar(Type type, const Element& element, uint64_t row) {
    if (text_) {
      double value = 0;
      const std::string_view token = in_.token();
      if (token.empty() || !parse_double(token, value)) {
        in_.fail(element.name.substr(0, 40) + " " + std::to_string(row) + ": " +
                 (token.empty() ? "the file ends" : "\"" + std::string(token.substr(0, 40)) + "\" is not a number"));
      }
      return value;
    }
    const size_t size = size_of(type);
    if (size > bytes_.size() - at_) {
      fail("the file ends within " + element.name.substr(0, 40) + " " + std::to_string(row) + " of " +
           std::to_string(element.count));
    }
    unsigned char raw[8];
    std::memcpy(raw, bytes_.data() + at_, size);
    at_ += size;
    if (swap_) std::reverse(raw, raw + size);
    switch (type) {
      case Type::i8:
        return load<int8_t>(raw);
      case Type::u8:
        return load<uint8_t>(raw);
      case Type::i16:
        return load<int16_t>(raw);
      case Type::u16:
        return load<uint16_t>(raw);
      case Type::i32:
        return load<int32_t>(raw);
      case Type::u32:
        return load<uint32_t>(raw);
      case Type::f32:
        return load<float>(raw);
      default:
        return load<double>(raw);
    }
  }

  uint64_t list_length(const Property& property, const Element& element, uint64_t row) {
    const double length = scalar(property.count_type, element, row);
    const double least = text_ ? 2.0 : static_cast<double>(size_of(property.type));
    // NaN fails too
    if (!(length >= 0 && length * least <= static_cast<double>(left()) + 1) ||
        length != static_cast<double>(static_cast<uint64_t>(length))) {
      fail(element.name.substr(0, 40) + " " + std::to_string(row) + " has a list of length " + std::to_string(length) +
           " where " + std::to_string(left()) + " bytes are left");
    }
    return static_cast<uint64_t>(length);
  }

  void pass_over(const Property& property, const Element& element, uint64_t row) {
    const uint64_t count = property.count_type == Type::none ? 1 : list_length(property, element, row);
    for (uint64_t i = 0; i < count; ++i) scalar(property.type, element, row);
  }

  static float unit_color(Type type, double value) {
    if (type == Type::u8) return static_cast<float>(value / 255);
    if (type == Type::u16) return static_cast<float>(value / 65535);
    return static_cast<float>(value >= 0 ? (value <= 1 ? value : 1.0) : 0.0);
  }

  void read_vertices(const Element& element) {
    static constexpr const char* names[] = {"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue", "alpha"};
    std::vector<int> slots;
    bool has[10] = {};
    for (const Property& o : element.properties) {
      int slot = -1;
      for (int n = 0; n < 10; ++n) {
        if (o.name == names[n] && o.count_type == Type::none && !has[n]) slot = n;
      }
      slots.push_back(slot);
      if (slot >= 0) has[slot] = true;
      if (slot < 0) ignore(element, o);
    }
    if (!has[0] || !has[1] || !has[2]) fail("the vertices have no x, y and z");
    if (!mesh_.positions.empty()) fail("the header has two vertex elements");
    const bool normals = has[3] && has[4] && has[5], colors = has[6] && has[7] && has[8];
    for (uint64_t v = 0; v < element.count; ++v) {
      double values[10] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
      for (size_t p = 0; p < slots.size(); ++p) {
        const Property& o = element.properties[p];
        if (slots[p] < 0) {
          pass_over(o, element, v);
          continue;
        }
        const double value = scalar(o.type, element, v);
        values[slots[p]] = slots[p] < 6 ? value : static_cast<double>(unit_color(o.type, value));
      }
      mesh_.positions.emplace_back(values[0], values[1], values[2]);
      if (normals) mesh_.normals.emplace_back(values[3], values[4], values[5]);
      if (colors) mesh_.colors.emplace_back(values[6], values[7], values[8], values[9]);
    }
  }

  static bool is_corners(const Property& o) {
    return o.count_type != Type::none && (o.name == "vertex_indices" || o.name == "vertex_index");
  }

  std::vector<int64_t> read_list(const Property& property, const Element& element, uint64_t row) {
    std::vector<int64_t> list(static_cast<size_t>(list_length(property, element, row)));
    for (int64_t& item : list) {
      const double value = scalar(property.type, element, row);
      if (!(value >= -1 && value <= 4294967295.0)) fail("face " + std::to_string(row) + " holds a bad index");
      item = static_cast<int64_t>(value);
    }
    return list;
  }

  void ignore(const Element& element, const Property& property) {
    mesh_.ignored.push_back("\"" + printable(property.name) + "\" of " + printable(element.name));
  }

  void read_faces(const Element& element) {
    for (const Property& o : element.properties) {
      if (!is_corners(o)) ignore(element, o);
    }
    for (uint64_t f = 0; f < element.count; ++f) {
      for (const Property& o : element.properties) {
        if (is_corners(o)) {
          rows_.push_back(read_list(o, element, f));
        } else {
          pass_over(o, element, f);
        }
      }
    }
  }

  void read_others(const Element& element) {
    for (const Property& o : element.properties) {
      if (element.name != "tristrips" || !is_corners(o)) ignore(element, o);
    }
    for (uint64_t row = 0; row < element.count; ++row) {
      for (const Property& o : element.properties) {
        if (element.name == "tristrips" && is_corners(o)) {
          add_strip(read_list(o, element, row));
        } else {
          pass_over(o, element, row);
        }
      }
    }
  }

  // -1 begins a new strip; every second triangle is turned round.
  void add_strip(const std::vector<int64_t>& strip) {
    size_t start = 0;
    for (size_t i = 0; i < strip.size(); ++i) {
      if (strip[i] < 0) {
        start = i + 1;
      } else if (i >= start + 2) {
        const bool odd = (i - start) % 2 != 0;
        rows_.push_back({strip[i - 2], strip[odd ? i : i - 1], strip[odd ? i - 1 : i]});
      }
    }
  }

  const std::vector<uint8_t>& bytes_;
  TextCursor in_;
  const std::string& name_;
  const MeshLimits& limits_;
  SurfaceMesh mesh_;
  FaceCollector faces_;
  std::vector<Element> elements_;
  std::vector<std::vector<int64_t>> rows_;
  bool text_ = true, swap_ = false;
  size_t at_ = 0;
};

}  // namespace

SurfaceMesh read_ply(const std::vector<uint8_t>& bytes, const std::string& name, const MeshLimits& limits) {
  return PlyReader(bytes, name, limits).run();
}

}  // namespace samples
