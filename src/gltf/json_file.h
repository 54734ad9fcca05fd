// Reading and writing the samples' own small JSON files (handle lists, settings) with errors that say where.
//
// JsonReader remembers the file and the key path, so that a wrong value is reported as
//   "pairs.json: handles[3].vertex: expected a whole number from 0 to 4399, found \"nose\"". Text is parsed with a
//   limit on size and depth; nothing is allocated for a file above the limit.
#ifndef HF_GLTF_JSON_FILE_H
#define HF_GLTF_JSON_FILE_H

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hf_gltf {

// Text as JSON holds it. Bytes that are not UTF-8 are read as Latin-1, as older programs write names.
std::string as_utf8(const std::string& text);

// One place in a JSON file. Cheap to copy; the root JsonFile must outlive it.
class JsonReader {
 public:
  JsonReader(const nlohmann::json& value, std::string file, std::string path)
      : value_(&value), file_(std::move(file)), path_(std::move(path)) {}

  const nlohmann::json& value() const { return *value_; }
  const std::string& path() const { return path_; }

  // Members of an object.
  bool has(const std::string& key) const;
  JsonReader at(const std::string& key) const;
  // Keys that are not in the list are an error that names the first one: misspelt settings must not pass silently.
  void expect_only(const std::vector<std::string>& keys) const;

  // Elements of an array.
  size_t size() const;
  JsonReader at(size_t index) const;

  // The value itself, checked.
  double number(double low, double high) const;
  double number() const;
  int64_t integer(int64_t low, int64_t high) const;
  bool boolean() const;
  std::string string() const;
  std::vector<double> numbers(size_t count) const;

  // The member, or the given default where it is absent.
  double number_or(const std::string& key, double otherwise) const;
  int64_t integer_or(const std::string& key, int64_t low, int64_t high, int64_t otherwise) const;
  bool boolean_or(const std::string& key, bool otherwise) const;
  std::string string_or(const std::string& key, const std::string& otherwise) const;

  // Throws std::runtime_error "file: path: message".
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string found() const;

  const nlohmann::json* value_;
  std::string file_, path_;
};

class JsonFile {
 public:
  // Reads the file; throws std::runtime_error when it is absent, above max_bytes, too deep or not JSON.
  explicit JsonFile(const std::filesystem::path& file, uint64_t max_bytes = 64u << 20);
  JsonReader root() const { return JsonReader(value_, name_, ""); }

 private:
  nlohmann::json value_;
  std::string name_;
};

// Checks text before a JSON parser sees it: depth of nesting, number of values, closed strings and brackets. Linear in
// the text, no allocation, no recursion. Returns an empty string or one sentence.
std::string scan_json(const char* text, size_t size, size_t max_depth, size_t max_values);

// scan_json, then the parse; what names the text in the error.
nlohmann::json parse_json(const char* text, size_t size, const std::string& what, size_t max_depth = 64,
                          size_t max_values = 1000000);

// Writes to a temporary name in the same folder, then renames.
void write_json(const std::filesystem::path& file, const nlohmann::json& value);

}  // namespace hf_gltf

#endif
