// Inner header of gltf_check.cpp and gltf_check_compressed.cpp: typed access to a JSON tree that is not trusted yet.
#ifndef HF_GLTF_GLTF_CHECK_PARTS_H
#define HF_GLTF_GLTF_CHECK_PARTS_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "gltf/file_bytes.h"
#include "gltf/gltf_read.h"

namespace hf_gltf {

constexpr uint64_t max_json_integer = 1ull << 53;  // beyond it a JSON number need not be a whole one

class TreeCheck {
 public:
  using json = nlohmann::json;
  using Where = const std::string&;

  TreeCheck(json& document, const std::string& name, const ReadLimits& limits)
      : document_(document), name_(name), limits_(limits) {}

  [[noreturn]] void fail(Where where, const std::string& message) const {
    throw std::runtime_error(name_ + ": " + printable(where + " " + message) + ".");
  }

  template <typename Function>
  void each(const char* collection, Function check) {
    const auto found = document_.find(collection);
    if (found == document_.end()) return;
    for (size_t i = 0; i < found->size(); ++i) {
      const std::string where = std::string(collection) + "[" + std::to_string(i) + "]";
      json& object = (*found)[i];
      if (!object.is_object()) fail(where, "is not an object");
      const auto name = object.find("name");
      if (name != object.end() && !name->is_string()) object.erase(name);
      check(object, where);
    }
  }

  size_t size(const char* collection) const {
    const auto found = document_.find(collection);
    return found == document_.end() ? 0 : found->size();
  }

  // A whole number in [low, high]; 5126.0 is one. Left in the tree as an integer.
  uint64_t whole(json& value, Where where, uint64_t low, uint64_t high) const {
    uint64_t number = 0;
    bool good = false;
    if (value.is_number_unsigned()) {
      number = value.get<uint64_t>();
      good = true;
    } else if (value.is_number_float()) {
      const double real = value.get<double>();
      good = real >= 0 && real <= static_cast<double>(max_json_integer) && real == std::floor(real);
      if (good) number = static_cast<uint64_t>(real);
    }
    if (!good || number < low || number > high) {
      fail(where, "is " + shown(value) + ", which is not a whole number from " + std::to_string(low) + " to " +
                      std::to_string(high));
    }
    value = number;
    return number;
  }

  static std::string shown(const json& value) {
    if (value.is_structured()) return value.is_array() ? "an array" : "an object";
    return value.dump(-1, ' ', false, json::error_handler_t::replace).substr(0, 40);
  }

  uint64_t whole(json& object, const char* key, Where where, uint64_t low, uint64_t high, bool required,
                 uint64_t otherwise = 0) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return otherwise;
    }
    return whole(*found, where + "." + key, low, high);
  }

  // An index into a collection, checked; -1 where absent.
  int index(json& value, Where where, const char* collection) const {
    const size_t count = size(collection);
    if (count == 0) fail(where, "names an element of \"" + std::string(collection) + "\", which is empty");
    return static_cast<int>(whole(value, where, 0, count - 1));
  }
  int index(json& object, const char* key, Where where, const char* collection, bool required) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return -1;
    }
    return index(*found, where + "." + key, collection);
  }

  // The member, which must be an array (object) if it is there.
  json* array(json& object, const char* key, Where where, bool required) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return nullptr;
    }
    if (!found->is_array()) fail(where + "." + key, "is not an array");
    if (found->empty() && required) fail(where + "." + key, "is empty");
    return &*found;
  }
  json* object(json& parent, const char* key, Where where, bool required) const {
    const auto found = parent.find(key);
    if (found == parent.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return nullptr;
    }
    if (!found->is_object()) fail(where + "." + key, "is not an object");
    return &*found;
  }

  // An array of finite numbers that fit a float; expected = 0: any length.
  void numbers(json& object, const char* key, Where where, size_t expected) const {
    json* values = array(object, key, where, false);
    if (!values) return;
    if (expected != 0 && values->size() != expected) {
      fail(where + "." + key, "has " + std::to_string(values->size()) + " numbers, not " + std::to_string(expected));
    }
    for (size_t i = 0; i < values->size(); ++i) {
      const json& value = (*values)[i];
      if (!value.is_number() || !(std::abs(value.get<double>()) <= std::numeric_limits<float>::max())) {
        fail(where + "." + key + "[" + std::to_string(i) + "]", "is " + shown(value) + ", which is not a finite float");
      }
    }
  }

  bool text(const json& object, const char* key, Where where, bool required) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      if (required) fail(where, "has no \"" + std::string(key) + "\"");
      return false;
    }
    if (!found->is_string()) fail(where + "." + key, "is not a string");
    return true;
  }

  static void keep_only(json& object, std::initializer_list<const char*> keys) {
    json kept = json::object();
    for (const char* key : keys) {
      const auto found = object.find(key);
      if (found != object.end()) kept[key] = std::move(*found);
    }
    object = std::move(kept);
  }

  static bool has_extension(const json& object, const char* name) {
    const auto found = object.find("extensions");
    return found != object.end() && found->is_object() && found->contains(name);
  }
  const ReadLimits& limits() const { return limits_; }
  const json& document() const { return document_; }

 protected:
  json& document_;
  const std::string& name_;
  const ReadLimits& limits_;
};

// Checks the compressed form of a view (EXT_meshopt_compression, KHR_meshopt_compression) and leaves it under
// "meshopt". stored: whether the view's own buffer has bytes. False: the view is not compressed, or its own bytes are
// used.
bool check_meshopt(const TreeCheck& check, nlohmann::json& view, bool stored, const std::string& where);

// Checks KHR_draco_mesh_compression of a primitive, whose attributes are checked, and leaves it under "draco" where it
// has to be decoded.
void check_draco(const TreeCheck& check, nlohmann::json& primitive, const std::string& where);

}  // namespace hf_gltf

#endif
