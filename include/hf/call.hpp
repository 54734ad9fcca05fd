// hf/call.hpp - what hf.hpp stands on: errors, handles, undo, and vectors as pointers and counts.
#ifndef HF_CALL_HPP
#define HF_CALL_HPP

#include <cstdint>
#include <cstdio>
#include <map>
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

// A view of numbers of either of two types that live elsewhere.
template <class First, class Second>
class View {
 public:
  View() noexcept = default;
  View(const std::vector<First>& values) noexcept : View(values.data(), values.size()) {}
  View(const std::vector<Second>& values) noexcept : View(values.data(), values.size()) {}
  View(const First* values, size_t size) noexcept : data_(values), size_(size), given_(true) {}
  View(const Second* values, size_t size) noexcept
      : data_(values), size_(size), type_(sizeof(Second) == 8 ? HF_TYPE_DOUBLE : HF_TYPE_UINT16), given_(true) {}
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
using Reals = View<float, double>;
using Indices = View<uint32_t, uint16_t>;

using Counts = std::map<std::string, size_t>;
using Dims = std::vector<std::string>;

inline uint32_t known(const Counts& counts, const std::string& key) noexcept {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : static_cast<uint32_t>(found->second);
}

// One call of the library: the counts that follow from arrays and objects, and what must live until it is over.
class Call {
 public:
  // Rows to try for an array that grows. Double clears more memory, half asks twice more often.
  static constexpr size_t kFirst = 1024;

  explicit Call(Counts counts = {}) : sizes(std::move(counts)) {}

  void parent(const std::string& name, const Counts& counts) {
    for (const auto& [key, size] : counts) sizes[name + "." + key] = sizes[key] = size;
  }
  void known(const std::string& key, size_t size) {
    if (size > 0) sizes[key] = size;
  }
  // What the object that was made keeps.
  Counts counts(const Dims& keys) const {
    Counts kept;
    for (const auto& [name, size] : sizes)
      for (const std::string& key : keys)
        if (name.substr(name.rfind('.') + 1) == key) kept[name] = size;
    return kept;
  }
  // A count; `least` where no array says.
  uint32_t count(const std::string& key, size_t least) {
    return static_cast<uint32_t>(sizes.emplace(key, least).first->second);
  }
  // What a dimension such as "face_count + 1" is; -1: not known yet.
  int64_t size(const std::string& dim) const {
    if (dim[0] >= '0' && dim[0] <= '9') return std::stoll(dim);
    const auto [base, more] = split(dim);
    const auto found = sizes.find(base);
    return found == sizes.end() ? -1 : static_cast<int64_t>(found->second) + more;
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
  template <class Numbers>
  hf_array view(const Numbers& values, bool required, const std::string& name, const Dims& dims) {
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
  // Room for an array whose length the library tells.
  template <class T>
  T* room(std::vector<T>& array, const Dims& dims) const {
    array.assign(product(dims), T());
    return array.empty() ? nullptr : array.data();
  }
  // Whether the room sufficed and all counts were known. If not, they are now, and the call is made again.
  bool enough(hf_result code, const std::vector<std::pair<std::string, uint32_t>>& told) {
    bool fits = true;
    bool were_known = true;
    for (const auto& [key, count] : told)
      if (key.find("capacity") != std::string::npos)
        fits = fits && size(key) >= count;
      else
        were_known = were_known && size(key) == count;
    if (code != HF_ERROR_TOO_SMALL || fits) check(code);
    for (const auto& [key, count] : told) sizes[key] = count;
    return fits && were_known;
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

  Counts sizes;

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
    const int64_t rows = each == 0 ? 0 : static_cast<int64_t>(length / each) - more;
    sizes[base] = rows > 0 ? static_cast<size_t>(rows) : 0;
  }

  std::vector<std::shared_ptr<void>> kept_;
};

}  // namespace hf

#endif
