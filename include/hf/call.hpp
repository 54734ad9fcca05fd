// hf/call.hpp - what hf.hpp stands on: errors, handles, undo, and vectors as pointers and counts.
#ifndef HF_CALL_HPP
#define HF_CALL_HPP

#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hf/hf.h"

namespace hf {

// Thrown when a call of hf fails. what() returns "function: message (HF_ERROR_...)".
class Error : public std::runtime_error {
 public:
  explicit Error(const hf_error_detail& detail)
      : std::runtime_error(std::string(detail.function) + ": " + detail.message + " (" +
                           hf_result_get_name(detail.code) + ")"),
        code_(detail.code),
        index_(detail.index) {}
  hf_result code() const noexcept { return code_; }
  uint32_t index() const noexcept { return index_; }

 private:
  hf_result code_;
  uint32_t index_;
};

inline void check(hf_result result) {
  if (result == HF_OK) return;
  hf_error_detail detail;
  hf_error_get_detail(&detail);
  throw Error(detail);
}

// Makes a struct of defaults: every field is zero except struct_size.
template <class Desc>
Desc make() {
  Desc desc = Desc();
  desc.struct_size = static_cast<uint32_t>(sizeof(Desc));
  return desc;
}

// Owns one handle. It can be moved but not copied.
template <class Raw, void (*destroy)(Raw)>
class Handle {
 public:
  Handle() noexcept = default;
  explicit Handle(Raw raw) noexcept : raw_(raw) {}
  Handle(Handle&& other) noexcept : raw_(std::exchange(other.raw_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      destroy(raw_);
      raw_ = std::exchange(other.raw_, nullptr);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { destroy(raw_); }
  Raw get() const noexcept { return raw_; }
  explicit operator bool() const noexcept { return raw_ != nullptr; }

 private:
  Raw raw_ = nullptr;
};

// Undo and redo of one object. A state is a clone, so it shares memory with the object: history.record(solver.clone()).
template <class State>
class History {
 public:
  // Keeps a state. Call it before an edit. It forgets what was undone.
  void record(State state) {
    past_.push_back(std::move(state));
    undone_.clear();
  }
  // Exchanges the object with the last record. Throws Error (HF_ERROR_EMPTY) without one.
  void undo(State& object) { exchange(past_, undone_, object, "nothing is recorded; call record before the edits"); }
  // Exchanges the object with what the last undo took away.
  void redo(State& object) { exchange(undone_, past_, object, "nothing was undone since the last record"); }

 private:
  static void exchange(std::vector<State>& from, std::vector<State>& to, State& object, const char* nothing) {
    if (from.empty()) {
      hf_error_detail detail{};
      detail.code = HF_ERROR_EMPTY;
      detail.index = HF_NO_INDEX;
      std::snprintf(detail.message, sizeof detail.message, "%s", nothing);
      throw Error(detail);
    }
    to.push_back(std::exchange(object, std::move(from.back())));
    from.pop_back();
  }
  std::vector<State> past_, undone_;
};

// A handle of a clone: clone_of(handle, hf_solver_clone).
template <class Raw, void (*destroy)(Raw)>
Handle<Raw, destroy> clone_of(const Handle<Raw, destroy>& handle, hf_result (*clone)(Raw, Raw*)) {
  Raw raw = nullptr;
  check(clone(handle.get(), &raw));
  return Handle<Raw, destroy>(raw);
}

// Refuses an array of another length.
inline void need(size_t size, size_t wanted, const std::string& name) {
  if (size == wanted) return;
  throw std::invalid_argument(name + " must hold " + std::to_string(wanted) + " numbers, not " + std::to_string(size));
}

// A view of floats or of doubles that live elsewhere.
class Reals {
 public:
  Reals() noexcept = default;
  Reals(const std::vector<float>& values) noexcept : Reals(values.data(), values.size()) {}
  Reals(const std::vector<double>& values) noexcept : Reals(values.data(), values.size()) {}
  Reals(const float* values, size_t size) noexcept : data_(values), size_(size), given_(true) {}
  Reals(const double* values, size_t size) noexcept
      : data_(values), size_(size), type_(HF_TYPE_DOUBLE), given_(true) {}
  const void* data() const noexcept { return data_; }
  int32_t type() const noexcept { return type_; }
  size_t size() const noexcept { return size_; }
  bool given() const noexcept { return given_; }

 private:
  const void* data_ = nullptr;
  size_t size_ = 0;
  int32_t type_ = HF_TYPE_PLAIN;
  bool given_ = false;
};

// A view of indices in 32 or in 16 bits that live elsewhere.
class Indices {
 public:
  Indices() noexcept = default;
  Indices(const std::vector<uint32_t>& values) noexcept : data_(values.data()), size_(values.size()), given_(true) {}
  Indices(const std::vector<uint16_t>& values) noexcept
      : data_(values.data()), size_(values.size()), type_(HF_TYPE_UINT16), given_(true) {}
  const void* data() const noexcept { return data_; }
  int32_t type() const noexcept { return type_; }
  size_t size() const noexcept { return size_; }
  bool given() const noexcept { return given_; }

 private:
  const void* data_ = nullptr;
  size_t size_ = 0;
  int32_t type_ = HF_TYPE_PLAIN;
  bool given_ = false;
};

using Counts = std::vector<std::pair<std::string, size_t>>;
using Dims = std::vector<std::string>;

inline uint32_t known(const Counts& counts, const std::string& key) noexcept {
  for (const auto& [name, size] : counts)
    if (name == key) return static_cast<uint32_t>(size);
  return 0;
}

// One call of the library: the counts that follow from arrays and objects, and what must live until it is over.
class Call {
 public:
  explicit Call(Counts counts = {}) : sizes_(std::move(counts)) {}

  void parent(const std::string& name, const Counts& counts) {
    for (const auto& [key, size] : counts) {
      learn(name + "." + key, size);
      learn(key, size);
    }
  }
  void learn(const std::string& key, size_t size) {
    forget(key);
    sizes_.emplace_back(key, size);
  }
  void forget(const std::string& key) {
    for (size_t i = sizes_.size(); i-- > 0;)
      if (sizes_[i].first == key) sizes_.erase(sizes_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  void known(const std::string& key, size_t size) {
    if (size > 0) learn(key, size);
  }
  // What the object that was made keeps.
  Counts counts(const Dims& keys) const {
    Counts kept;
    for (const auto& entry : sizes_)
      for (const std::string& key : keys)
        if (entry.first.substr(entry.first.rfind('.') + 1) == key) kept.push_back(entry);
    return kept;
  }
  uint32_t count(const std::string& key, size_t least) {
    const int64_t found = size(key);
    if (found < 0) learn(key, least);
    return static_cast<uint32_t>(found < 0 ? least : static_cast<size_t>(found));
  }
  // What a dimension such as "face_count + 1" is; -1: not known yet.
  int64_t size(const std::string& dim) const {
    if (dim[0] >= '0' && dim[0] <= '9') return std::stoll(dim);
    const auto [base, more] = split(dim);
    for (const auto& [name, size] : sizes_)
      if (name == base) return static_cast<int64_t>(size) + more;
    return -1;
  }
  size_t product(const Dims& dims) const {
    size_t product = 1;
    for (const std::string& dim : dims) product *= static_cast<size_t>(size(dim) < 0 ? 0 : size(dim));
    return product;
  }

  template <class T>
  const T* array(const std::vector<T>& values, bool required, const std::string& name, const Dims& dims) {
    if (values.empty() && !required) return nullptr;
    fit(values.size(), name, dims);
    return values.empty() ? nullptr : values.data();
  }
  template <class View>
  hf_array view(const View& values, bool required, const std::string& name, const Dims& dims) {
    hf_array array{};
    if (values.given() && (values.size() > 0 || required)) fit(values.size(), name, dims);
    if (values.size() == 0) return array;
    array.data = values.data();
    array.count = static_cast<uint32_t>(size(dims[0]));
    array.type = values.type();
    return array;
  }
  hf_array view(const std::vector<uint32_t>& values, bool required, const std::string& name, const Dims& dims) {
    return view(Indices(values), required, name, dims);
  }
  // An array for the library to fill; none where it has no place.
  template <class T>
  hf_array_out out(T* place, const std::string& rows) const {
    hf_array_out array{};
    if (!place) return array;
    array.data = place;
    array.count = static_cast<uint32_t>(size(rows));
    array.type = sizeof(T) == sizeof(double) ? HF_TYPE_DOUBLE : HF_TYPE_PLAIN;
    return array;
  }
  // Lists of different lengths, one after the other.
  void lists(const std::vector<std::vector<uint32_t>>& lists, bool required, const uint32_t** counts,
             const uint32_t** all, const std::string& name, const Dims& dims) {
    if (lists.empty() && !required) return;
    fit(lists.size(), name, dims);
    auto kept = std::make_shared<std::pair<std::vector<uint32_t>, std::vector<uint32_t>>>();
    for (const auto& list : lists) {
      kept->first.push_back(static_cast<uint32_t>(list.size()));
      kept->second.insert(kept->second.end(), list.begin(), list.end());
    }
    if (!lists.empty()) *counts = kept->first.data();
    if (!kept->second.empty()) *all = kept->second.data();
    kept_.push_back(kept);
  }
  // Lines in UTF-8, one for each.
  const char* text(const std::vector<std::string>& lines) {
    if (lines.empty()) return nullptr;
    auto kept = std::make_shared<std::string>();
    for (const std::string& line : lines) *kept += line + "\n";
    kept_.push_back(kept);
    return kept->c_str();
  }
  template <class Desc>
  const Desc* keep(const Desc& desc) {
    auto kept = std::make_shared<Desc>(desc);
    kept_.push_back(kept);
    return kept.get();
  }

 private:
  static std::pair<std::string, int64_t> split(const std::string& dim) {
    const size_t plus = dim.find(" + ");
    if (plus == std::string::npos) return {dim, 0};
    return {dim.substr(0, plus), std::stoll(dim.substr(plus + 3))};
  }
  // Checks how many numbers there are; a dimension that is not known yet becomes known.
  void fit(size_t length, const std::string& name, const Dims& dims) {
    size_t each = 1;
    const std::string* loose = nullptr;
    for (const std::string& dim : dims) {
      const int64_t found = size(dim);
      if (found >= 0)
        each *= static_cast<size_t>(found);
      else if (!loose)
        loose = &dim;
      else
        throw std::invalid_argument(name + " cannot be read without what it belongs to");
    }
    if (!loose) return need(length, each, name);
    if (each == 0 ? length > 0 : length % each != 0)
      throw std::invalid_argument(name + " must hold " + std::to_string(each) + " numbers for each, not " +
                                  std::to_string(length));
    const auto [base, more] = split(*loose);
    const size_t rows = each == 0 ? 0 : length / each;
    learn(base, rows > static_cast<size_t>(more) ? rows - static_cast<size_t>(more) : 0);
  }

  Counts sizes_;
  std::vector<std::shared_ptr<void>> kept_;
};

// Room for arrays of lengths that the library tells: called again with more when that was too little.
class Room {
 public:
  explicit Room(std::vector<std::pair<std::string, int64_t>> rooms) : rooms_(std::move(rooms)) {
    for (auto& [key, size] : rooms_)
      if (size < 0) size = kFirst;
  }
  // An array to fill. place: where the struct of C has it.
  template <class T>
  void array(std::vector<T>& rows, Dims dims, T** place = nullptr, bool wanted = true) {
    arrays_.push_back({std::move(dims), wanted, [&rows, place](size_t size, bool keep) {
                         if (!keep) rows.clear();
                         rows.resize(size);
                         if (place) *place = rows.empty() ? nullptr : rows.data();
                       }});
  }
  void begin(Call& c) {
    for (const auto& [key, size] : rooms_) c.learn(key, static_cast<size_t>(size));
    blind_ = false;
    for (const Array& array : arrays_)
      for (const std::string& dim : array.dims) blind_ = blind_ || c.size(dim) < 0;
    fit(c, false);
  }
  uint32_t get(const std::string& name) const {
    for (const auto& [key, size] : rooms_)
      if (key == name && !blind_) return static_cast<uint32_t>(size);
    return 0;
  }
  template <class T>
  T* at(std::vector<T>& array) const {
    return array.empty() ? nullptr : array.data();
  }
  // Whether the arrays are full and right.
  bool enough(Call& c, const std::vector<std::pair<std::string, uint32_t>>& told) {
    bool fits = true;
    for (const auto& [key, size] : rooms_) fits = fits && of(told, key) <= size;
    if (code != HF_ERROR_TOO_SMALL || fits) check(code);
    const bool done = code == HF_OK && fits && !blind_;
    for (const auto& [key, size] : told)
      if (done || !is_room(key)) c.learn(key, size);
    for (auto& [key, size] : rooms_) size = blind_ || of(told, key) > size ? of(told, key) : size;
    if (done) fit(c, true);
    return done;
  }
  hf_result code = HF_OK;

 private:
  struct Array {
    Dims dims;
    bool wanted;
    std::function<void(size_t, bool)> resize;
  };
  static constexpr int64_t kFirst = 1024;  // rows to try first; double clears more memory, half asks twice more often
  static int64_t of(const std::vector<std::pair<std::string, uint32_t>>& told, const std::string& name) {
    for (const auto& [key, size] : told)
      if (key == name) return size;
    return 0;
  }
  bool is_room(const std::string& name) const {
    for (const auto& [key, size] : rooms_)
      if (key == name) return true;
    return false;
  }
  void fit(const Call& c, bool keep) {
    for (const Array& array : arrays_)
      if (array.wanted) array.resize(blind_ ? 0 : c.product(array.dims), keep);
  }
  std::vector<std::pair<std::string, int64_t>> rooms_;
  std::vector<Array> arrays_;
  bool blind_ = false;  // asks for counts alone
};

}  // namespace hf

#endif
