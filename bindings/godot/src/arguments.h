// Reading a script's arguments, for surface*.cpp.
#pragma once
#include <utility>
#include <variant>

#include "surface.h"

namespace hf_godot {

using hf::check;
using hf::make;

inline const Argument& at(const Arguments& arguments, size_t i) {
  static const Argument missing;
  return i < arguments.size() ? arguments[i] : missing;
}

// Six numbers for each place: three corners of a triangle, three weights.
std::vector<hf_place> places_of(const Argument& argument);

struct List {  // uint32 numbers; a missing list counts one, so that the library says what is missing
  Numbers values;
  bool null = true;
  uint32_t count() const { return null ? 1u : static_cast<uint32_t>(values.size()); }
  const uint32_t* data() const { return values.empty() ? nullptr : values.data(); }
};

inline uint32_t whole(double value, const char* name) {
  if (!(value >= 0 && value <= 4294967295.0))
    fail(std::string(name) + " must be whole numbers from 0", HF_ERROR_OUT_OF_RANGE);
  if (value != static_cast<uint32_t>(value)) fail(std::string(name) + " must be whole numbers");
  return static_cast<uint32_t>(value);
}

inline int32_t signed_whole(double value, const char* name) {
  if (!(value >= -2147483648.0 && value <= 2147483647.0) || value != static_cast<int32_t>(value))
    fail(std::string(name) + " must be a whole number");
  return static_cast<int32_t>(value);
}

using Option = std::pair<const char*, std::variant<int32_t*, uint32_t*, float*, double*>>;

// Writes a script's named numbers to the fields of a desc; an unknown name is an error.
inline void read_options(const Argument& argument, const std::vector<Option>& known) {
  for (const auto& [name, value] : argument.named) {
    const Option* found = nullptr;
    for (const Option& option : known)
      if (name == option.first) found = &option;
    if (!found) fail("no option '" + name + "'");
    if (auto* const* i = std::get_if<int32_t*>(&found->second)) **i = signed_whole(value, found->first);
    if (auto* const* u = std::get_if<uint32_t*>(&found->second)) **u = whole(value, found->first);
    if (auto* const* f = std::get_if<float*>(&found->second)) **f = static_cast<float>(value);
    if (auto* const* d = std::get_if<double*>(&found->second)) **d = value;
  }
}

inline List integers(const Argument& argument, const char* name) {
  List list;
  list.null = argument.null;
  for (double value : argument.list) list.values.push_back(whole(value, name));
  return list;
}

inline const double* doubles(const Argument& argument, size_t count, const char* name) {
  if (argument.null) return nullptr;
  if (argument.list.size() != count)
    fail(std::string(name) + " must hold " + std::to_string(count) + " numbers, not " +
         std::to_string(argument.list.size()));
  return argument.list.empty() ? nullptr : argument.list.data();
}

// Rows of `width` numbers; none for null.
inline hf_array rows_of(const Argument& argument, size_t width, size_t rows, const char* name) {
  const double* const numbers = doubles(argument, width * rows, name);
  return HF_ARRAY(numbers, numbers ? rows : 0);
}

// Lists of vertices one after the other.
struct Regions {
  Numbers counts, vertices;
  bool null;
  Regions(const Argument& argument, const char* name) : null(argument.null) {
    for (const Doubles& region : argument.lists) {
      counts.push_back(static_cast<uint32_t>(region.size()));
      for (double vertex : region) vertices.push_back(whole(vertex, name));
    }
  }
  uint32_t count() const { return null ? 1u : static_cast<uint32_t>(counts.size()); }
};

inline Value numbers(Numbers list) {
  Value value;
  value.kind = Value::integers;
  value.whole = std::move(list);
  return value;
}
inline Value number(double real) {
  Value value;
  value.kind = Value::number;
  value.real = real;
  return value;
}
inline Value done() {
  Value value;
  value.kind = Value::truth;
  value.real = 1;
  return value;
}

inline Value named(std::map<std::string, double> fields) {
  Value value;
  value.kind = Value::named;
  value.fields = std::move(fields);
  return value;
}

// Makes a handle by `create` when the slot is empty.
template <class Raw, void (*destroy)(Raw), class Create>
Raw make_once(hf::Handle<Raw, destroy>& slot, Create&& create) {
  if (!slot) {
    Raw raw = nullptr;
    check(create(&raw));
    slot = hf::Handle<Raw, destroy>(raw);
  }
  return slot.get();
}

// Replaces a handle by a new one; the old one stays when `create` fails.
template <class Raw, void (*destroy)(Raw), class Create>
void make_again(hf::Handle<Raw, destroy>& slot, Create&& create) {
  Raw raw = nullptr;
  check(create(&raw));
  slot = hf::Handle<Raw, destroy>(raw);
}

// xyz in double precision as Godot's vectors.
inline Value vectors(const Doubles& numbers) {
  Value value;
  value.kind = Value::vectors;
  value.floats.assign(numbers.begin(), numbers.end());
  return value;
}

// A skeleton of a script's names (a line for each joint), parents (-1: none) and rest (10 numbers for each joint).
// skin: of the mesh, or null.
inline hf::Handle<hf_skeleton, hf_skeleton_destroy> skeleton_of(const Argument& names, const Argument& parents,
                                                                const Argument& rest,
                                                                const hf_skin_desc* skin = nullptr) {
  auto desc = make<hf_skeleton_desc>();
  Numbers above;
  for (double parent : parents.list) above.push_back(parent == -1 ? HF_NO_INDEX : whole(parent, "parents"));
  if (rest.list.size() != 10 * above.size()) fail("rest must hold 10 numbers for each joint");
  const std::vector<float> joints(rest.list.begin(), rest.list.end());
  desc.joint_count = static_cast<uint32_t>(above.size());
  desc.names = names.null ? nullptr : names.text.c_str();
  desc.parents = above.data();
  desc.rest = joints.data();
  desc.skin = skin;
  hf_skeleton raw = nullptr;
  check(hf_skeleton_create(&desc, &raw));
  return hf::Handle<hf_skeleton, hf_skeleton_destroy>(raw);
}

}  // namespace hf_godot
