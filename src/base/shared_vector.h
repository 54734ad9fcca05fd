// A vector whose copies share its elements. A copy costs one counter, not the elements.
//
// Any number of threads may read a SharedVector and its copies. Change it only before it is copied: a copy reads the
// same elements, and a change may move them.
//
// A vector with room can grow without a copy: grown() returns a longer one, and both share the elements of the shorter
// one. One vector alone has the room behind it. It is free again when that vector and its copies are gone.
#pragma once
#include <algorithm>
#include <atomic>

#include "base/memory.h"

namespace hf_inner {

template <class T>
class SharedVector {
 public:
  explicit SharedVector(Memory& memory) : block_(make_shared_in<Block>(memory, &memory)) {}

  SharedVector& operator=(Vector<T>&& other) {
    change([&](Vector<T>& v) { v = std::move(other); });
    return *this;
  }
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
    Vector<T>& values = block_->values;
    if (values.size() > size_) values.resize(size_);
    change(values);
    data_ = values.data();
    size_ = values.size();
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

  // Leaves room for a sixteenth more: about as many vertices as a dozen edits bring.
  void leave_room() {
    Vector<T>& values = block_->values;
    values.resize(size_ + size_ / 16);
    data_ = values.data();
    block_->used = size_;
  }
  // Returns `count` elements, at least size(). The first size() are these, and the caller writes the others before
  // somebody else reads them. All are copied if there is no room.
  SharedVector grown(std::size_t count, Memory& memory) const {
    if (count == size_) return *this;
    const std::size_t depth = claim_ ? claim_->depth + 1 : 1;
    if (count <= block_->values.size() && depth <= most_claims) {
      const std::shared_ptr<Claim> claim = make_shared_in<Claim>(memory, block_, claim_, size_, depth);
      std::size_t mine = size_;
      if (block_->used.compare_exchange_strong(mine, count)) {
        claim->end = count;
        SharedVector out(*this);
        out.claim_ = claim;
        out.size_ = count;
        return out;
      }
    }
    SharedVector out(memory);
    out.reserve(count + count / 16);
    out.append(begin(), end());
    out.resize(count);
    out.leave_room();
    return out;
  }

 private:
  struct Block {
    explicit Block(Memory* memory) : values(memory) {}
    Vector<T> values;                   // with the room
    std::atomic<std::size_t> used = 0;  // elements that belong to a vector, where there is room
  };
  // The elements that one vector has more than another.
  struct Claim {
    Claim(std::shared_ptr<Block> of, std::shared_ptr<const Claim> from, std::size_t first, std::size_t number)
        : block(std::move(of)), before(std::move(from)), begin(first), depth(number) {}
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;
    ~Claim() {
      if (end > begin) block->used = begin;
    }
    std::shared_ptr<Block> block;
    std::shared_ptr<const Claim> before;  // which outlives this one
    std::size_t begin, end = 0, depth;
  };
  static constexpr std::size_t most_claims = 256;  // they end one inside the other, on the stack

  std::shared_ptr<Block> block_;
  std::shared_ptr<const Claim> claim_;  // null: none was before
  T* data_ = nullptr;                   // of block_, so that a reader takes one step
  std::size_t size_ = 0;
};

}  // namespace hf_inner
