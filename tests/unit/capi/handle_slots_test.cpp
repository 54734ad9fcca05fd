// The table behind all handles, with numbers of few bits: what 32-bit hosts meet after 134 million objects is met at
// once.
#include "capi/handle_slots.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <vector>

namespace {

template <unsigned bits>
using Slots = hf_inner::capi::HandleSlots<int, bits>;

template <unsigned bits>
void destroy_all(Slots<bits>& slots, const std::vector<std::uintptr_t>& numbers) {
  for (const std::uintptr_t number : numbers) slots.remove(number);
}

TEST(HandleSlots, finds_every_live_object_and_no_other_through_many_rounds_of_numbers) {
  constexpr unsigned bits = 10;
  Slots<bits> slots;
  std::map<std::uintptr_t, std::shared_ptr<int>> live;
  std::mt19937 random(1);
  for (int step = 0; step < 200000; ++step) {
    // phases that fill the table, empty it, and keep it as it is
    const unsigned chance = step / 1000 % 3 == 0 ? 70 : step / 1000 % 3 == 1 ? 25 : 50;
    if (live.empty() || (random() % 100 < chance && live.size() < 300)) {
      const auto object = std::make_shared<int>(step);
      const std::uintptr_t number = slots.add(object);
      ASSERT_NE(number, 0u);
      ASSERT_LT(number, std::uintptr_t{1} << bits);
      ASSERT_TRUE(live.emplace(number, object).second) << "two objects have the number " << number;
    } else {
      auto chosen = live.lower_bound(random() % (1u << bits));
      if (chosen == live.end()) chosen = live.begin();
      ASSERT_EQ(slots.remove(chosen->first), chosen->second);
      live.erase(chosen);
    }
    ASSERT_EQ(slots.size(), live.size());
    if (step % 100 != 0) continue;
    for (std::uintptr_t number = 0; number < std::uintptr_t{1} << bits; ++number) {
      const auto known = live.find(number);
      const std::shared_ptr<int>* found = slots.find(number);
      ASSERT_EQ(found ? *found : nullptr, known == live.end() ? nullptr : known->second) << number;
    }
  }
  while (!live.empty()) {
    slots.remove(live.begin()->first);
    live.erase(live.begin());
  }
}

// However many objects stay, and whichever they are.
TEST(HandleSlots, names_no_new_object_by_a_stale_number_before_half_of_all_numbers_were_used) {
  constexpr unsigned bits = 12;
  const auto object = std::make_shared<int>(0);
  for (const std::size_t kept : {0u, 1u, 7u, 8u, 100u, 255u, 1023u}) {
    for (const bool older : {false, true}) {
      Slots<bits> slots;
      std::vector<std::uintptr_t> numbers;
      for (std::size_t i = 0; i < kept; ++i) numbers.push_back(slots.add(object));
      // or those made last, so that the free slots lie together
      if (!older) {
        for (std::size_t i = 0; i < kept; ++i) numbers.push_back(slots.add(object));
        for (std::size_t i = 0; i < kept; ++i) slots.remove(numbers[i]);
        numbers.erase(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(kept));
      }
      const std::uintptr_t stale = slots.add(object);
      slots.remove(stale);
      std::size_t made = 0;
      for (; !slots.find(stale); ++made) {
        ASSERT_LT(made, std::size_t{1} << bits);
        const std::uintptr_t number = slots.add(object);
        if (number == stale) break;
        slots.remove(number);
      }
      EXPECT_GE(made + 1, std::size_t{1} << (bits - 1)) << kept << " objects stay";
      if (slots.find(stale)) slots.remove(stale);
      destroy_all(slots, numbers);
    }
  }
}

TEST(HandleSlots, refuses_more_objects_than_half_of_all_numbers) {
  Slots<6> slots;
  std::vector<std::uintptr_t> numbers;
  const auto object = std::make_shared<int>(0);
  for (;;) {
    try {
      numbers.push_back(slots.add(object));
    } catch (const hf_inner::Error& error) {
      EXPECT_EQ(error.code(), HF_ERROR_TOO_LARGE);
      break;
    }
  }
  EXPECT_EQ(numbers.size(), 32u);
  for (const std::uintptr_t number : numbers) EXPECT_NE(slots.find(number), nullptr);
  destroy_all(slots, numbers);
}

// Numbers skipped are slots searched: at most one per object made, on average.
TEST(HandleSlots, searches_less_than_two_slots_for_an_object) {
  Slots<56> slots;
  std::vector<std::uintptr_t> numbers;
  const auto object = std::make_shared<int>(0);
  std::size_t made = 0;
  for (; made < 100000; ++made) numbers.push_back(slots.add(object));
  EXPECT_EQ(numbers.back(), made) << "nothing is skipped while all objects stay";
  for (int round = 0; round < 500000; ++round, ++made) slots.remove(slots.add(object));
  const std::uintptr_t last = slots.add(object);
  EXPECT_LE(last, 2 * made);
  slots.remove(last);
  destroy_all(slots, numbers);
}

}  // namespace
