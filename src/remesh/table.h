// A Vector indexed by signed numbers (half-edges, nodes, arcs), so that code reads like the formulas.
#pragma once
#include <cstdint>

#include "base/memory.h"
#include "base/span.h"

namespace hf_inner::remesh {

template <class T>
class Table {
 public:
  explicit Table(Memory& memory) : data_(&memory) {}
  Table(std::int32_t size, const T& value, Memory& memory) : data_(static_cast<std::size_t>(size), value, &memory) {}
  // A copy allocates from the same memory resource. A copy of a std::pmr container would take the default resource.
  Table(const Table& other) : data_(other.data_, other.data_.get_allocator()) {}
  Table(Table&&) = default;
  Table& operator=(const Table&) = default;
  Table& operator=(Table&&) = default;
  ~Table() = default;
  T& operator[](std::int32_t i) noexcept { return data_[static_cast<std::size_t>(i)]; }
  const T& operator[](std::int32_t i) const noexcept { return data_[static_cast<std::size_t>(i)]; }
  std::int32_t size() const noexcept { return static_cast<std::int32_t>(data_.size()); }
  bool empty() const noexcept { return data_.empty(); }
  void clear() noexcept { data_.clear(); }
  void reserve(std::int32_t size) { data_.reserve(static_cast<std::size_t>(size)); }
  void assign(std::int32_t size, const T& value) { data_.assign(static_cast<std::size_t>(size), value); }
  void resize(std::int32_t size, const T& value) { data_.resize(static_cast<std::size_t>(size), value); }
  std::int32_t push_back(const T& value) {
    data_.push_back(value);
    return size() - 1;
  }
  void insert(std::int32_t position, const T& value) { data_.insert(data_.begin() + position, value); }
  void pop_back() noexcept { data_.pop_back(); }
  T& back() noexcept { return data_.back(); }
  const T& back() const noexcept { return data_.back(); }
  auto begin() noexcept { return data_.begin(); }
  auto end() noexcept { return data_.end(); }
  auto begin() const noexcept { return data_.begin(); }
  auto end() const noexcept { return data_.end(); }
  T* data() noexcept { return data_.data(); }
  const T* data() const noexcept { return data_.data(); }
  void swap(Table& other) noexcept { data_.swap(other.data_); }

 private:
  Vector<T> data_;
};

template <class T>
Span<const T> span_of(const Table<T>& table) noexcept {
  return {table.data(), static_cast<std::size_t>(table.size())};
}

}  // namespace hf_inner::remesh
