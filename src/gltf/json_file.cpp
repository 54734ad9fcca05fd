// See json_file.h.
#include "gltf/json_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "gltf/file_bytes.h"
#include "gltf/file_write.h"

namespace hf_gltf {
using nlohmann::json;

std::string as_utf8(const std::string& text) {
  try {
    (void)json(text).dump();
    return text;
  } catch (const json::exception&) {
  }
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) out += static_cast<char>(0xC0 | (byte >> 6));
    out += byte >= 0x80 ? static_cast<char>(0x80 | (byte & 0x3F)) : c;
  }
  return out;
}

std::string scan_json(const char* text, size_t size, size_t max_depth, size_t max_values) {
  size_t depth = 0, values = 0;
  bool in_string = false;
  for (size_t i = 0; i < size; ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    switch (c) {
      case '"':
        in_string = true;
        break;
      case '[':
      case '{':
        if (++depth > max_depth) {
          return "the JSON is nested deeper than " + std::to_string(max_depth) + " levels at byte " + std::to_string(i);
        }
        ++values;
        break;
      case ']':
      case '}':
        if (depth == 0) return "the JSON closes a bracket that was not opened at byte " + std::to_string(i);
        --depth;
        break;
      case ',':
        ++values;
        break;
      default:
        break;
    }
    if (values > max_values) return "the JSON holds more than " + std::to_string(max_values) + " values";
  }
  if (in_string) return "the JSON ends inside a string";
  if (depth != 0) return "the JSON ends with " + std::to_string(depth) + " brackets open";
  return "";
}

json parse_json(const char* text, size_t size, const std::string& what, size_t max_depth, size_t max_values) {
  const size_t begin = text_begin({text, size}, what);
  const std::string fault = scan_json(text + begin, size - begin, max_depth, max_values);
  if (!fault.empty()) throw std::runtime_error(what + ": " + fault + ".");
  try {
    return json::parse(text + begin, text + size);
  } catch (const json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." -> the text behind the bracket
    const std::string message = error.what();
    const size_t bracket = message.find("] ");
    throw std::runtime_error(
        what + ": is not JSON: " + (bracket == std::string::npos ? message : message.substr(bracket + 2, 300)) + ".");
  }
}

JsonFile::JsonFile(const std::filesystem::path& file, uint64_t max_bytes) : name_(file.string()) {
  const std::vector<uint8_t> bytes = read_bytes(file, max_bytes);
  value_ = parse_json(reinterpret_cast<const char*>(bytes.data()), bytes.size(), name_);
}

void write_json(const std::filesystem::path& file, const json& value) { write_bytes(file, value.dump(2) + "\n"); }

void JsonReader::fail(const std::string& message) const {
  throw std::runtime_error(file_ + ": " + (path_.empty() ? "the top level" : path_) + ": " + message + ".");
}

std::string JsonReader::found() const {
  std::string text = value_->dump(-1, ' ', false, json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

bool JsonReader::has(const std::string& key) const { return value_->is_object() && value_->contains(key); }

JsonReader JsonReader::at(const std::string& key) const {
  if (!value_->is_object()) fail("expected an object with the key \"" + key + "\", found " + found());
  const auto it = value_->find(key);
  if (it == value_->end()) fail("the key \"" + key + "\" is missing");
  return {*it, file_, path_.empty() ? key : path_ + "." + key};
}

void JsonReader::expect_only(const std::vector<std::string>& keys) const {
  if (!value_->is_object()) fail("expected an object, found " + found());
  for (const auto& item : value_->items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
    std::string known;
    for (const std::string& key : keys) known += (known.empty() ? "" : ", ") + key;
    fail("the key \"" + item.key() + "\" is not known; known are " + known);
  }
}

size_t JsonReader::size() const {
  if (!value_->is_array()) fail("expected an array, found " + found());
  return value_->size();
}

JsonReader JsonReader::at(size_t index) const {
  if (index >= size()) fail("has no element " + std::to_string(index));
  return {(*value_)[index], file_, path_ + "[" + std::to_string(index) + "]"};
}

double JsonReader::number(double low, double high) const {
  const double value = value_->is_number() ? value_->get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (!(value >= low && value <= high)) {
    fail("expected a number from " + json(low).dump() + " to " + json(high).dump() + ", found " + found());
  }
  return value;
}

double JsonReader::number() const {
  if (!value_->is_number()) fail("expected a number, found " + found());
  return value_->get<double>();
}

int64_t JsonReader::integer(int64_t low, int64_t high) const {
  const auto refuse = [&]() {
    fail("expected a whole number from " + std::to_string(low) + " to " + std::to_string(high) + ", found " + found());
  };
  if (!value_->is_number_integer()) refuse();
  if (value_->is_number_unsigned() && value_->get<uint64_t>() > static_cast<uint64_t>(std::max<int64_t>(high, 0))) {
    refuse();
  }
  const auto value = value_->get<int64_t>();
  if (value < low || value > high) refuse();
  return value;
}

bool JsonReader::boolean() const {
  if (!value_->is_boolean()) fail("expected true or false, found " + found());
  return value_->get<bool>();
}

std::string JsonReader::string() const {
  if (!value_->is_string()) fail("expected a string, found " + found());
  return value_->get<std::string>();
}

std::vector<double> JsonReader::numbers(size_t count) const {
  if (size() != count) fail("expected " + std::to_string(count) + " numbers, found " + std::to_string(size()));
  std::vector<double> values(count);
  for (size_t i = 0; i < count; ++i) values[i] = at(i).number();
  return values;
}

double JsonReader::number_or(const std::string& key, double otherwise) const {
  return has(key) ? at(key).number() : otherwise;
}

int64_t JsonReader::integer_or(const std::string& key, int64_t low, int64_t high, int64_t otherwise) const {
  return has(key) ? at(key).integer(low, high) : otherwise;
}

bool JsonReader::boolean_or(const std::string& key, bool otherwise) const {
  return has(key) ? at(key).boolean() : otherwise;
}

std::string JsonReader::string_or(const std::string& key, const std::string& otherwise) const {
  return has(key) ? at(key).string() : otherwise;
}

}  // namespace hf_gltf
