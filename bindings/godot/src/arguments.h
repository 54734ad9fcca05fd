// Reading a script's arguments, for surface*.cpp.
#pragma once
#include "surface.h"

namespace hf_godot {

using hf::check;
using hf::make;

inline const Argument& at(const Arguments& arguments, size_t i) {
  static const Argument missing;
  return i < arguments.size() ? arguments[i] : missing;
}

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
  value.kind = Value::integers, value.whole = std::move(list);
  return value;
}
inline Value done() {
  Value value;
  value.kind = Value::truth, value.real = 1;
  return value;
}

inline Value named(std::map<std::string, double> fields) {
  Value value;
  value.kind = Value::named, value.fields = std::move(fields);
  return value;
}

// xyz in double precision as Godot's vectors.
inline Value vectors(const Doubles& numbers) {
  Value value;
  value.kind = Value::vectors, value.floats.assign(numbers.begin(), numbers.end());
  return value;
}

}  // namespace hf_godot
