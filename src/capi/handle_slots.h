// Gives every object a number and finds it again: the table behind all handles.
//
// Numbers count up from 1 and skip those whose slot is taken. The slot is the number modulo the size of the table. The
// table is at most half full, so at least every second number makes an object. A stale number names a new object only
// after 2^(number_bits - 1) more objects, whatever the host keeps. Adding costs O(1) on average, finding and removing
// always. An empty table holds no memory. The caller locks.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "base/error.h"

namespace hf_inner::capi {

template <class Object, unsigned number_bits>
class HandleSlots {
 public:
  using Number = std::uintptr_t;
  static_assert(number_bits > 4 && number_bits < 8 * sizeof(Number));

  HandleSlots() = default;  // nothing to destroy while no object is held
  HandleSlots(const HandleSlots&) = delete;
  HandleSlots& operator=(const HandleSlots&) = delete;

  // Throws std::bad_alloc, or HF_ERROR_TOO_LARGE when half of all numbers are taken.
  Number add(std::shared_ptr<Object> object) {
    if (2 * (used_ + 1) > capacity_) grow();
    do last_ = (last_ + 1) & mask;
    while (last_ == 0 || slot_of(last_).object);
    Slot& slot = slot_of(last_);
    slot.object = std::move(object);
    slot.number = last_;
    ++used_;
    return last_;
  }
  // The object's place, or null for a number that names none.
  const std::shared_ptr<Object>* find(Number number) const noexcept {
    if (capacity_ == 0) return nullptr;
    const Slot& slot = slot_of(number);
    return slot.object && slot.number == number ? &slot.object : nullptr;
  }
  // number: one that find() knows.
  std::shared_ptr<Object> remove(Number number) noexcept {
    std::shared_ptr<Object> object = std::move(slot_of(number).object);
    slot_of(number).object.reset();
    if (--used_ == 0) {
      delete[] slots_;
      slots_ = nullptr;
      capacity_ = 0;
    }
    return object;
  }
  std::size_t size() const noexcept { return used_; }

 private:
  struct Slot {
    std::shared_ptr<Object> object;
    Number number = 0;
  };
  static constexpr Number mask = (Number{1} << number_bits) - 1;
  static constexpr std::size_t least_capacity = 16;  // below 512 bytes; a larger table only costs a first create more

  Slot& slot_of(Number number) const noexcept { return slots_[number & (capacity_ - 1)]; }
  // Doubles the table. Numbers that differ modulo the old size differ modulo the new one.
  void grow() {
    const std::size_t capacity = capacity_ ? 2 * capacity_ : least_capacity;
    if (capacity - 1 > mask) fail(HF_ERROR_TOO_LARGE, HF_NO_INDEX, "%zu objects are alive; destroy some", used_);
    Slot* const slots = new Slot[capacity];
    for (std::size_t i = 0; i < capacity_; ++i) {
      if (slots_[i].object) slots[slots_[i].number & (capacity - 1)] = std::move(slots_[i]);
    }
    delete[] slots_;
    slots_ = slots;
    capacity_ = capacity;
  }

  Slot* slots_ = nullptr;
  std::size_t capacity_ = 0, used_ = 0;
  Number last_ = 0;
};

}  // namespace hf_inner::capi
