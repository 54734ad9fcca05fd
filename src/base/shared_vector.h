// A vector whose copies share its elements. A copy costs one counter, not the elements.
//
// Any number of threads may read a SharedVector and its copies. Change it only before it is copied: a copy reads the
// same elements, and a change may move them.
#pragma once
#include <algorithm>

#include "base/memory.h"

namespace hf_inner {

template <class T>
class SharedVector {
 public:
  explicit SharedVector(Memory& memory) : values_(make_shared_in<Vector<T>>(memory)) {}

  SharedVector& operator=(Vector<T>&& other) {
    change([&](Vector<T>& v) { v = std::move(other); });
    return *this;
  }
  operator const Vector<T>&() const noexcept { return *values_; }
  const T* data() const noexcept { return data_; }
  T* data() noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  const T* begin() const noexcept { return data_; }
  const T* end() const noexcept { return data_ + size_; }
  T* begin() noexcept { return data_; }
  T* end() noexcept { return data_ + size_; }
  const T& operator[](std::size_t i) const noexcept { return data_[i]; }
  T& operator[](std::size_t i) noexcept { return data_[i]; }
  const T& front() const noexcept { return *data_; }
  const T& back() const noexcept { return data_[size_ - 1]; }

  // Calls change(vector), which may change the vector in any way.
  template <class Change>
  void change(Change&& change) {
    change(*values_);
    data_ = values_->data();
    size_ = values_->size();
  }
  void push_back(const T& value) {
    change([&](Vector<T>& v) { v.push_back(value); });
  }
  void reserve(std::size_t count) {
    change([&](Vector<T>& v) { v.reserve(count); });
  }
  void resize(std::size_t count) {
    change([&](Vector<T>& v) { v.resize(count); });
  }
  void clear() {
    change([](Vector<T>& v) { v.clear(); });
  }
  template <class... Arguments>
  void assign(Arguments&&... arguments) {
    change([&](Vector<T>& v) { v.assign(std::forward<Arguments>(arguments)...); });
  }
  template <class Iterator>
  void append(Iterator first, Iterator last) {
    change([&](Vector<T>& v) { v.insert(v.end(), first, last); });
  }
  template <class Gone>
  void remove_if(Gone&& gone) {
    change([&](Vector<T>& v) { v.erase(std::remove_if(v.begin(), v.end(), gone), v.end()); });
  }

 private:
  std::shared_ptr<Vector<T>> values_;
  T* data_ = nullptr;  // of values_, so that a reader takes one step
  std::size_t size_ = 0;
};

}  // namespace hf_inner
